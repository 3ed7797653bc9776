/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * value.h -- a number, vector or tensor that a case gives: constant, or a function of x and t. */
#ifndef BASE_VALUE_H
#define BASE_VALUE_H

#include "base/error.h"

enum { VALUE_MAX = 9 };

typedef struct value {
    int n;                      /* components                                         */
    double constant[VALUE_MAX]; /* if f is NULL                                       */
    int free[VALUE_MAX];        /* component is left free (boundary conditions)       */
    int of_time;                /* f may depend on t                                  */
    int (*f)(const void *ctx, const double *x, double t, double *out, error *err);
    const void *ctx;
} value;

static inline int value_at(const value *v, const double *x, double t, double *out, error *err)
{
    if (v->f)
        return v->f(v->ctx, x, t, out, err);
    for (int i = 0; i < v->n; i++)
        out[i] = v->constant[i];
    return 0;
}

#endif
