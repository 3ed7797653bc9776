/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * galerkin.h -- the matrix of a coarser level. */
#ifndef SOLVER_BLOCK_GALERKIN_H
#define SOLVER_BLOCK_GALERKIN_H

#include "parts.h"

/* C = R A P by blocks, where R is the transpose of the prolongation P; the columns of a row do not ascend.
 * Places of A that are not active have a row and a column of the identity, and give nothing. */
void galerkin(const block_matrix *a, const uint8_t *active, const sparse *prolong, const sparse *restrict_,
              int n_thread, block_matrix *c, pool *p);

#endif
