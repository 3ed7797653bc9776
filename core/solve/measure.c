/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * How residuals of different fields compare while an iteration makes them small: each is divided by the root of
 * the mean of its diagonal, so that squares are energies.  A field without a diagonal of its own, as the pressure,
 * has that of its Schur complement instead, sum_j a_ij^2 / a_jj.  This needs no solution, which may vanish. */
#include "solve/linear.h"

#include <math.h>

static double diagonal(const pf_csr *a, int64_t i)
{
    int64_t low = a->row[i], high = a->row[i + 1];

    while (high - low > 1) {
        int64_t middle = (low + high) / 2;

        if (pf_column(a, i, middle) <= i)
            low = middle;
        else
            high = middle;
    }
    return pf_column(a, i, low) == i ? fabs(a->value[low]) : 0;
}

int linear_measure(linear *l, error *err)
{
    const pf_unknowns *u = &l->rows.view;
    int64_t n[SPACE_MAX_FIELDS] = {0}, empty[SPACE_MAX_FIELDS] = {0};
    double sum[SPACE_MAX_FIELDS] = {0}, *d = l->r;

    if (!l->row_scale)
        ARENA_NEW(&l->memory, l->row_scale, l->a.n, err);
    for (int64_t i = 0; i < l->a.n; i++) {
        d[i] = diagonal(&l->a, i);
        n[u->field_of[i]] += !u->idle[i];
        empty[u->field_of[i]] += !u->idle[i] && d[i] == 0;
        sum[u->field_of[i]] += u->idle[i] ? 0 : d[i];
    }
    for (int f = 0; f < u->n_field; f++)
        if (2 * empty[f] > n[f])
            sum[f] = 0;
    for (int64_t i = 0; i < l->a.n; i++) {
        int f = u->field_of[i];

        if (u->idle[i] || 2 * empty[f] <= n[f])
            continue;
        for (int64_t k = l->a.row[i]; k < l->a.row[i + 1]; k++)
            if (u->field_of[pf_column(&l->a, i, k)] != f && d[pf_column(&l->a, i, k)] > 0)
                sum[f] += l->a.value[k] * l->a.value[k] / d[pf_column(&l->a, i, k)];
    }
    for (int64_t i = 0; i < l->a.n; i++) {
        int f = u->field_of[i];

        l->row_scale[i] = sum[f] > 0 ? 1 / sqrt(sum[f] / (double)n[f]) : 1;
    }
    return 0;
}
