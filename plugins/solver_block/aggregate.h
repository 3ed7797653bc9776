/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * aggregate.h -- prolongation by smoothed aggregation (Vanek, Mandel and Brezina 1996), and products of sparse
 * matrices. */
#ifndef SOLVER_BLOCK_AGGREGATE_H
#define SOLVER_BLOCK_AGGREGATE_H

#include "parts.h"

/* Prolongation to the rows of a symmetric (or nearly) matrix with positive diagonal from aggregates of strongly
 * coupled rows: n x n_col.  Rows without strong neighbours and those not in `active` (unless NULL) belong to none.
 */
void aggregate(const sparse *a, const uint8_t *active, double strength, sparse *prolong, pool *p);
void sparse_transpose(const sparse *a, sparse *t, pool *p);
/* c = a b */
void sparse_product(const sparse *a, const sparse *b, int n_thread, sparse *c, pool *p);

#endif
