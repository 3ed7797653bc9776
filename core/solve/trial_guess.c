/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What a wrong answer looks like: the mistakes that are made when a solver is fitted to an interface. */
#include "solve/trial.h"

#include "solve/vector.h"

#include <math.h>
#include <stdio.h>

/* An answer is that of another system if it leaves this of its right-hand side. */
#define IS_OF 1e-8

const char *trial_guess(const trial *t, const trial *before, const trial *beside, const double *x, char *text,
                        size_t size)
{
    const int64_t n = t->a.n;
    const double length = vector_norm(n, x), c = vector_dot(n, x, t->x) / vector_dot(n, t->x, t->x);
    double off = 0, copied = 0;

    for (int64_t i = 0; i < n; i++) {
        off += (x[i] - c * t->x[i]) * (x[i] - c * t->x[i]);
        copied += (x[i] - t->b[i]) * (x[i] - t->b[i]);
    }
    *text = 0;
    if (!isfinite(length))
        snprintf(text, size,
                 "it returns what is no number, or leaves x as it was: x is not assigned, or the matrix is read in "
                 "solve (its values are valid in setup only)");
    else if (length == 0)
        snprintf(text, size, "it returns zeros");
    else if (copied == 0)
        snprintf(text, size, "it returns the right-hand side");
    else if (sqrt(off) <= 1e-6 * length)
        snprintf(text, size, "it is %.6g times the solution: a wrong scale", c);
    else if (trial_residual(t, t, 1, x) <= IS_OF)
        snprintf(
            text, size,
            "it solves with the transposed matrix: entries come by rows, and are taken by columns, or the other "
            "way round");
    else if (before && trial_residual(t, before, 0, x) <= IS_OF)
        snprintf(text, size, "it solves with the values of the setup before: the new ones are ignored");
    else if (beside && trial_residual(t, beside, 0, x) <= IS_OF)
        snprintf(text, size, "it solves with the matrix of another instance: they share what should be their own");
    return text;
}
