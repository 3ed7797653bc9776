/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * ilu.h -- incomplete factorisation without fill, ILU(0), of a matrix of small blocks. */
#ifndef SOLVER_BLOCK_ILU_H
#define SOLVER_BLOCK_ILU_H

#include "parts.h"

/* L U = A on the pattern of A: L below the diagonal (unit diagonal), U on and above, diagonal blocks inverted.
 * Parts of the matrix are factored and solved by different threads; the result depends on the parts only. */
typedef struct ilu {
    const block_matrix *a;
    float *value;    /* [row[n]][b * b] */
    int32_t **where; /* [n_part + 1][n] room of each part */
    float **room;    /* [n_part + 1][longest row][4 * b] */
} ilu;

/* Room for the factors of a pattern. */
void ilu_create(ilu *f, const block_matrix *a, pool *p);
void ilu_factor(ilu *f, int n_thread);
/* x = U^-1 L^-1 b, of blocks; x may be b. */
void ilu_solve(const ilu *f, int n_thread, const float *b, float *x);

#endif
