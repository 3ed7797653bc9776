/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * vector.h -- vectors of unknowns: updates, and the only sums over them in this folder.
 *
 * A "dof" vector has an entry for every unknown [n_dof], a "free" vector one for every row of the matrix
 * [n_free] (space.h).  Where unknowns are spread over processes these sums become reductions; what calls
 * them need not know.  They add in a fixed order, whatever the number of threads, so that a run gives the same bits
 * every time. */
#ifndef SOLVE_VECTOR_H
#define SOLVE_VECTOR_H

#include "space/space.h"

#include <math.h>

/* Entries of a vector or of a matrix from which threads are worth their start. */
#define VECTOR_THREADED (1 << 17)

/* --- plain vectors of n entries --- */

double vector_dot(int64_t n, const double *restrict a, const double *restrict b);
double vector_norm(int64_t n, const double *a);
void vector_divide(int64_t n, double c, const double *a, double *y); /* y = a / c       */
void vector_add(int64_t n, double c, const double *a, double *y);    /* y = y + c a     */
void vector_subtract(int64_t n, const double *a, double *y);         /* y = a - y       */

/* --- between dof and free vectors --- */

void vector_negative(const space *s, const double *dof, double *free_);            /* free = -dof      */
void vector_step(const space *s, double length, const double *free_, double *dof); /* dof += length free */

/* --- per field, over its free unknowns; out[s->n_field] --- */

void vector_count(const space *s, int64_t *out);
void vector_squares(const space *s, const double *dof, double *out); /* sum of squares */
void vector_squares_free(const space *s, const double *free_, double *out);
/* The largest |entry|; NaN is passed over. */
void vector_largest_free(const space *s, const double *free_, double *out);

int vector_field_prescribed(const space *s, int field); /* whether any of its unknowns is */

/* --- of one field, over all its unknowns that take part (idle[n_dof] is 0), prescribed ones too --- */

double vector_field_sum(const space *s, const uint8_t *idle, int field, const double *dof);
double vector_field_dot(const space *s, const uint8_t *idle, int field, const double *a, const double *b);
/* The same over those that are prescribed. */
double vector_prescribed_dot(const space *s, int field, const double *a, const double *b);
/* y += c a; a NULL: 1 */
void vector_field_add(const space *s, const uint8_t *idle, int field, double c, const double *a, double *y);

/* The larger one; NaN is larger than any number, so that it cannot hide behind one. */
static inline double vector_worse(double a, double b)
{
    return isnan(a) || a > b ? a : b;
}

#endif
