/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/dense.h"

#include <gsl/gsl_linalg.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

int dense_solve(int n, double *a, double *b)
{
    double *row[DENSE_MAX];
    double x[DENSE_MAX];

    for (int i = 0; i < n; i++)
        row[i] = a + i * n;
    for (int i = 0; i < n; i++) {
        int best = i;
        double *pivot, swap = b[i];

        for (int r = i + 1; r < n; r++)
            best = fabs(row[r][i]) > fabs(row[best][i]) ? r : best;
        pivot = row[best], row[best] = row[i], row[i] = pivot;
        b[i] = b[best], b[best] = swap;
        if (!(fabs(pivot[i]) > 0) || !isfinite(pivot[i]))
            return 1;
        for (int r = i + 1; r < n; r++) {
            double f = row[r][i] / pivot[i];

            for (int c = i; c < n; c++)
                row[r][c] -= f * pivot[c];
            b[r] -= f * b[i];
        }
    }
    for (int i = n - 1; i >= 0; i--) {
        x[i] = b[i];
        for (int c = i + 1; c < n; c++)
            x[i] -= row[i][c] * x[c];
        x[i] /= row[i][i];
    }
    memcpy(b, x, (size_t)n * sizeof *b);
    return 0;
}

int dense_solve_symmetric(int n, double *a, int n_rhs, double *b)
{
    for (int j = 0; j < n; j++)
        for (int i = j; i < n; i++) {
            for (int k = 0; k < j; k++)
                a[i * n + j] -= a[i * n + k] * a[j * n + k];
            if (i == j && !(a[j * n + j] > 0))
                return 1;
            a[i * n + j] = i == j ? sqrt(a[j * n + j]) : a[i * n + j] / a[j * n + j];
        }
    for (int r = 0; r < n_rhs; r++, b += n) {
        for (int i = 0; i < n; i++) {
            for (int k = 0; k < i; k++)
                b[i] -= a[i * n + k] * b[k];
            b[i] /= a[i * n + i];
        }
        for (int i = n - 1; i >= 0; i--) {
            for (int k = i + 1; k < n; k++)
                b[i] -= a[k * n + i] * b[k];
            b[i] /= a[i * n + i];
        }
    }
    return 0;
}

int dense_invert(int n, double *a, error *err)
{
    size_t size = (size_t)n * (size_t)n;
    double *factors = malloc(size * sizeof *factors);
    size_t *row = malloc((size_t)n * sizeof *row);
    int status = 0, sign;

    if (!factors || !row) {
        status = error_memory(err, "inverse matrix", 8.0 * (double)size);
    } else {
        gsl_matrix_view lu = gsl_matrix_view_array(factors, (size_t)n, (size_t)n);
        gsl_matrix_view inverse = gsl_matrix_view_array(a, (size_t)n, (size_t)n);
        gsl_permutation order = {(size_t)n, row};

        memcpy(factors, a, size * sizeof *factors);
        gsl_permutation_init(&order);
        gsl_linalg_LU_decomp(&lu.matrix, &order, &sign);
        for (int i = 0; i < n && !status; i++)
            if (!(fabs(factors[i * n + i]) > 0))
                status = error_set(err, ERR_USAGE, "a matrix of %d rows is singular: it has no inverse", n);
        if (!status)
            gsl_linalg_LU_invert(&lu.matrix, &order, &inverse.matrix);
    }
    free(factors);
    free(row);
    return status;
}
