/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * coarse.h -- the last level: factors by UMFPACK, or none where it is too large or singular. */
#ifndef SOLVER_BLOCK_COARSE_H
#define SOLVER_BLOCK_COARSE_H

#include "parts.h"

typedef struct coarse {
    int32_t n;
    void *factors; /* NULL: there are none */
    int32_t *row, *col;
    double *value; /* by columns */
} coarse;

/* 0, also where there are no factors, or PF_SOLVER_MEMORY. */
int coarse_factor(coarse *c, const sparse *a, pool *p);
/* x = A^-1 b; 0: there are no factors, and x = 0. */
int coarse_solve(const coarse *c, const double *b, double *x);
void coarse_destroy(coarse *c);

#endif
