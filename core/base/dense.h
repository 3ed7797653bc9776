/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * dense.h -- algebra of small dense matrices: Jacobian matrices of mappings, and systems of a few unknowns.
 *
 * A Jacobian matrix is 3 x 3 in 2D, too, with the identity in the unused direction (see mesh_map). */
#ifndef BASE_DENSE_H
#define BASE_DENSE_H

#include "base/error.h"

enum { DENSE_MAX = 16 };

/* Determinant of a 3 x 3 matrix. */
static inline double dense_determinant(const double a[3][3])
{
    return a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1]) - a[0][1] * (a[1][0] * a[2][2] - a[1][2] * a[2][0]) +
           a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0]);
}

/* Inverse of a 3 x 3 matrix by cofactors; returns the determinant (if it is 0, inverse is not finite). */
static inline double dense_inverse3(const double a[3][3], double inverse[3][3])
{
    double det = dense_determinant(a);

    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            int p = (j + 1) % 3, q = (j + 2) % 3, r = (i + 1) % 3, s = (i + 2) % 3;

            inverse[i][j] = (a[p][r] * a[q][s] - a[p][s] * a[q][r]) / det;
        }
    return det;
}

/* b <- a^-1 b by elimination with row pivoting, n <= DENSE_MAX; a[n][n], rows one after the other, is overwritten.
 * 0, or 1 if a is singular to the last bit or not finite (b is then worthless). */
int dense_solve(int n, double *a, double *b);

/* b[k] <- a^-1 b[k] for n_rhs right-hand sides b[n_rhs][n], a symmetric and positive definite (of it the lower half
 * is read), by Cholesky's factors, which take its place.  0, or 1 if it is not. */
int dense_solve_symmetric(int n, double *a, int n_rhs, double *b);

/* a <- a^-1, a[n][n] of any size, by GSL's LU factors.  ERR_USAGE if it is singular, ERR_MEMORY. */
int dense_invert(int n, double *a, error *err);

#endif
