/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "aggregate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Entry k of row i couples strongly. */
static int is_strong(const sparse *a, const double *diagonal, double strength, int32_t i, int64_t k)
{
    int32_t j = a->col[k];

    return j != i && a->value[k] < 0 && a->value[k] * a->value[k] > strength * strength * diagonal[i] * diagonal[j];
}

/* Aggregates: first whole neighbourhoods, then what is left joins one of a strong neighbour. */
static int32_t gather(const sparse *a, const uint8_t *active, const double *diagonal, double strength, int32_t *of)
{
    int32_t n = 0;

    for (int32_t i = 0; i < a->n; i++)
        of[i] = -1;
    for (int32_t i = 0; i < a->n; i++) {
        int alone = 1, clear = of[i] < 0 && (!active || active[i]);

        for (int64_t k = a->row[i]; k < a->row[i + 1] && clear; k++)
            if (is_strong(a, diagonal, strength, i, k)) {
                alone = 0;
                clear = of[a->col[k]] < 0;
            }
        if (!clear || alone)
            continue;
        of[i] = n;
        for (int64_t k = a->row[i]; k < a->row[i + 1]; k++)
            if (is_strong(a, diagonal, strength, i, k))
                of[a->col[k]] = n;
        n++;
    }
    for (int32_t i = 0; i < a->n; i++) {
        double most = 0;

        if (of[i] != -1 || (active && !active[i]))
            continue;
        for (int64_t k = a->row[i]; k < a->row[i + 1]; k++)
            if (is_strong(a, diagonal, strength, i, k) && of[a->col[k]] >= 0 && -a->value[k] > most) {
                most = -a->value[k];
                of[i] = -2 - of[a->col[k]]; /* no chain of those that joined late */
            }
    }
    for (int32_t i = 0; i < a->n; i++)
        of[i] = of[i] < -1 ? -2 - of[i] : of[i];
    return n;
}

/* The matrix with weak couplings added to the diagonal, over its diagonal; returns a bound of its spectral radius.
 */
static double scale_filtered(const sparse *a, const double *diagonal, double strength, double *value)
{
    double radius = 0;

    for (int32_t i = 0; i < a->n; i++) {
        double d = diagonal[i], size = 0;
        int64_t own = -1;

        for (int64_t k = a->row[i]; k < a->row[i + 1]; k++) {
            int strong = is_strong(a, diagonal, strength, i, k);

            own = a->col[k] == i ? k : own;
            value[k] = strong ? a->value[k] : 0;
            d += strong || a->col[k] == i ? 0 : a->value[k];
        }
        d = d > 0.1 * diagonal[i] ? d : diagonal[i];
        for (int64_t k = a->row[i]; k < a->row[i + 1]; k++) {
            value[k] /= d;
            size += fabs(value[k]);
        }
        if (own >= 0)
            value[own] = 1;
        radius = fmax(radius, 1 + size);
    }
    return radius;
}

/* (I - omega D^-1 A) of the aggregates' constants. */
static void smooth(const sparse *a, const int32_t *of, const double *value, double omega, sparse *prolong, pool *p)
{
    int64_t *where;
    pool scratch = {0};

    TAKE(&scratch, where, prolong->n_col + 1);
    TAKE(p, prolong->row, a->n + 1);
    p->failed |= scratch.failed;
    for (int pass = 0; pass < 2 && !p->failed; pass++) {
        int64_t n = 0;

        memset(where, 0xff, (size_t)prolong->n_col * sizeof *where);
        for (int32_t i = 0; i < a->n; i++) {
            int64_t first = n;

            for (int64_t k = a->row[i]; k < a->row[i + 1]; k++) {
                int32_t j = of[a->col[k]];
                double v = (a->col[k] == i) - omega * value[k];

                if (j < 0 || of[i] < 0 || value[k] == 0)
                    continue;
                if (where[j] < first) {
                    where[j] = n;
                    if (pass) {
                        prolong->col[n] = j;
                        prolong->value[n] = 0;
                    }
                    n++;
                }
                if (pass)
                    prolong->value[where[j]] += v;
            }
            prolong->row[i + 1] = n;
        }
        if (!pass) {
            TAKE(p, prolong->col, n + 1);
            TAKE(p, prolong->value, n + 1);
        }
    }
    pool_free(&scratch);
}

void aggregate(const sparse *a, const uint8_t *active, double strength, sparse *prolong, pool *p)
{
    pool scratch = {0};
    double *diagonal, *value, radius;
    int32_t *of;

    memset(prolong, 0, sizeof *prolong);
    TAKE(&scratch, diagonal, a->n + 1);
    TAKE(&scratch, of, a->n + 1);
    TAKE(&scratch, value, a->row[a->n] + 1);
    p->failed |= scratch.failed;
    if (!p->failed) {
        for (int32_t i = 0; i < a->n; i++)
            for (int64_t k = a->row[i]; k < a->row[i + 1]; k++)
                diagonal[i] += a->col[k] == i ? a->value[k] : 0;
        for (int32_t i = 0; active && i < a->n; i++)
            diagonal[i] = active[i] ? diagonal[i] : INFINITY; /* nothing couples strongly to it */
        prolong->n = a->n;
        prolong->n_col = gather(a, active, diagonal, strength, of);
        radius = scale_filtered(a, diagonal, strength, value);
        smooth(a, of, value, 4. / 3 / radius, prolong, p);
    }
    pool_free(&scratch);
}

void sparse_transpose(const sparse *a, sparse *t, pool *p)
{
    *t = (sparse){.n = a->n_col, .n_col = a->n};
    TAKE(p, t->row, t->n + 2);
    TAKE(p, t->col, a->row[a->n] + 1);
    TAKE(p, t->value, a->row[a->n] + 1);
    if (p->failed)
        return;
    for (int64_t k = 0; k < a->row[a->n]; k++)
        t->row[a->col[k] + 2]++;
    for (int32_t i = 0; i < t->n; i++)
        t->row[i + 2] += t->row[i + 1];
    for (int32_t i = 0; i < a->n; i++)
        for (int64_t k = a->row[i]; k < a->row[i + 1]; k++) {
            int64_t at = t->row[a->col[k] + 1]++;

            t->col[at] = i;
            t->value[at] = a->value[k];
        }
}

/* Row i of a b; where[] finds columns from `first` on. */
static int64_t product_row(const sparse *a, const sparse *b, int32_t i, int64_t first, int64_t *where, int32_t *col,
                           double *value)
{
    int64_t n = first;

    for (int64_t k = a->row[i]; k < a->row[i + 1]; k++)
        for (int64_t m = b->row[a->col[k]]; m < b->row[a->col[k] + 1]; m++) {
            int32_t j = b->col[m];

            if (where[j] < first) {
                where[j] = n;
                if (col) {
                    col[n] = j;
                    value[n] = 0;
                }
                n++;
            }
            if (col)
                value[where[j]] += a->value[k] * b->value[m];
        }
    return n;
}

void sparse_product(const sparse *a, const sparse *b, int n_thread, sparse *c, pool *p)
{
    pool scratch = {0};
    int64_t **where = pool_markers(&scratch, n_thread, b->n_col);

    *c = (sparse){.n = a->n, .n_col = b->n_col};
    TAKE(p, c->row, a->n + 1);
    p->failed |= scratch.failed;
    for (int pass = 0; pass < 2 && !p->failed; pass++) {
#pragma omp parallel for num_threads(n_thread) schedule(static, 1)
        for (int t = 0; t < n_thread; t++) {
            int64_t n = 0;

            memset(where[t], 0xff, (size_t)b->n_col * sizeof **where);
            for (ROWS_OF_THREAD(i, a->n, t, n_thread)) {
                int64_t first = pass ? c->row[i] : n;

                n = product_row(a, b, i, first, where[t], c->col, c->value);
                if (!pass)
                    c->row[i + 1] = n - first;
            }
        }
        if (pass)
            break;
        rows_begin(c->n, c->row);
        TAKE(p, c->col, c->row[c->n] + 1);
        TAKE(p, c->value, c->row[c->n] + 1);
    }
    pool_free(&scratch);
}
