/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * block.h -- comparing Jacobian blocks of a point function, [row][column][ld]. */
#ifndef TERM_BLOCK_H
#define TERM_BLOCK_H

#include <math.h>
#include <stddef.h>

static inline double block_norm(const double *a, size_t n)
{
    double s = 0;

    for (size_t i = 0; i < n; i++)
        s += a[i] * a[i];
    return sqrt(s);
}

/* |a - factor b| */
static inline double block_distance(const double *a, const double *b, double factor, size_t n)
{
    double s = 0;

    for (size_t i = 0; i < n; i++)
        s += (a[i] - factor * b[i]) * (a[i] - factor * b[i]);
    return sqrt(s);
}

/* |a - b^T| of square blocks */
static inline double block_transposed_distance(const double *a, const double *b, int n, size_t ld)
{
    double s = 0;

    for (int r = 0; r < n; r++)
        for (int c = 0; c < n; c++)
            for (size_t l = 0; l < ld; l++) {
                double d = a[(size_t)(r * n + c) * ld + l] - b[(size_t)(c * n + r) * ld + l];

                s += d * d;
            }
    return sqrt(s);
}

/* The columns are a tensor, dim x dim, whose two indices a' exchanges: |a' - b|; with kept = 1
 * |a' + a - b|, which vanishes if a forgets the second half of D(u). */
static inline double block_exchanged_distance(const double *a, const double *b, int rows, int dim, size_t ld,
                                              int kept)
{
    double s = 0;

    for (int r = 0; r < rows; r++)
        for (int i = 0; i < dim; i++)
            for (int k = 0; k < dim; k++)
                for (size_t l = 0; l < ld; l++) {
                    size_t ik = (size_t)((r * dim + i) * dim + k) * ld + l;
                    size_t ki = (size_t)((r * dim + k) * dim + i) * ld + l;
                    double d = a[ik] + kept * a[ki] - b[ki];

                    s += d * d;
                }
    return sqrt(s);
}

/* What turns the given block (rows x cols, [row][col][ld]) into the true one: "sign", "factor 2", "transpose",
 * "missing", or "" -- into text. */
void block_diagnose(const double *given, const double *truth, int rows, int cols, size_t ld, char *text, size_t n);

#endif
