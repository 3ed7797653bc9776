/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "galerkin.h"

#include <string.h>

/* What a thread makes a row of R A P in. */
typedef struct product_room {
    int64_t *fine, *coarse; /* where columns are found */
    int32_t *col;           /* [n fine] columns of the row of R A, */
    float *value;           /* and its blocks                      */
} product_room;

/* Row i of R A: its columns; places that do not take part, which have a one on the diagonal alone, are left out. */
static inline int32_t restrict_row(const block_matrix *a, int b, const uint8_t *active, const sparse *restrict_,
                                   int32_t i, int values, product_room *q)
{
    int bb = b * b;
    int32_t n = 0;

    for (int64_t m = restrict_->row[i]; m < restrict_->row[i + 1]; m++) {
        int32_t f = restrict_->col[m];
        float share = (float)restrict_->value[m];

        for (int64_t k = a->row[f]; k < a->row[f + 1]; k++) {
            int32_t g = a->col[k];
            float *to;

            if (q->fine[g] < 0) {
                q->fine[g] = n;
                q->col[n] = g;
                for (int e = 0; e < bb; e++)
                    q->value[(int64_t)n * bb + e] = 0;
                n++;
            }
            if (!values)
                continue;
            to = q->value + q->fine[g] * bb;
            for (int e = 0; e < bb; e++)
                to[e] += share * a->value[k * bb + e];
            for (int e = 0; e < b && g == f; e++)
                if (!active[(int64_t)f * b + e])
                    to[e * b + e] -= share;
        }
    }
    for (int32_t k = 0; k < n; k++)
        q->fine[q->col[k]] = -1;
    return n;
}

/* Row i of R A P from that of R A; its columns from `first` on. */
static inline int64_t prolong_row(const product_room *q, int32_t n_fine, const sparse *prolong, int bb,
                                  int64_t first, int32_t *col, float *value)
{
    int64_t n = first;

    for (int32_t k = 0; k < n_fine; k++)
        for (int64_t h = prolong->row[q->col[k]]; h < prolong->row[q->col[k] + 1]; h++) {
            int32_t j = prolong->col[h];
            float share = (float)prolong->value[h], *to;

            if (q->coarse[j] < first) {
                q->coarse[j] = n;
                if (col) {
                    col[n] = j;
                    for (int e = 0; e < bb; e++)
                        value[n * bb + e] = 0;
                }
                n++;
            }
            to = value ? value + q->coarse[j] * bb : NULL;
            for (int e = 0; value && e < bb; e++)
                to[e] += share * q->value[(int64_t)k * bb + e];
        }
    return n;
}

/* Row i; returns where the next one begins. */
static inline int64_t product_row(const block_matrix *a, int b, const uint8_t *active, const sparse *prolong,
                                  const sparse *restrict_, int32_t i, int64_t first, product_room *q,
                                  block_matrix *c)
{
    int32_t n = restrict_row(a, b, active, restrict_, i, c->value != NULL, q);

    return prolong_row(q, n, prolong, b * b, first, c->col, c->value);
}

static product_room *make_room(const block_matrix *a, int32_t n_coarse, int n_thread, pool *p)
{
    product_room *q;

    TAKE(p, q, n_thread);
    for (int t = 0; t < n_thread && !p->failed; t++) {
        TAKE(p, q[t].fine, a->n + 1);
        TAKE(p, q[t].coarse, n_coarse + 1);
        TAKE(p, q[t].col, a->n + 1);
        TAKE(p, q[t].value, (int64_t)a->n * a->b * a->b);
        if (!p->failed)
            memset(q[t].fine, 0xff, (size_t)a->n * sizeof *q[t].fine);
    }
    return q;
}

void galerkin(const block_matrix *a, const uint8_t *active, const sparse *prolong, const sparse *restrict_,
              int n_thread, block_matrix *c, pool *p)
{
    pool scratch = {0};
    product_room *room = make_room(a, prolong->n_col, n_thread, &scratch);

    *c = (block_matrix){.n = prolong->n_col, .b = a->b};
    TAKE(p, c->row, c->n + 1);
    TAKE(p, c->diagonal, c->n + 1);
    p->failed |= scratch.failed;
    for (int pass = 0; pass < 2 && !p->failed; pass++) {
#pragma omp parallel for num_threads(n_thread) schedule(static, 1)
        for (int t = 0; t < n_thread; t++) {
            int64_t n = 0;

            memset(room[t].coarse, 0xff, (size_t)c->n * sizeof *room[t].coarse);
            for (ROWS_OF_THREAD(i, c->n, t, n_thread)) {
                int64_t first = pass ? c->row[i] : n;

                n = a->b == 3 ? product_row(a, 3, active, prolong, restrict_, i, first, &room[t], c)
                              : product_row(a, 2, active, prolong, restrict_, i, first, &room[t], c);
                if (!pass)
                    c->row[i + 1] = n - first;
            }
        }
        if (pass)
            break;
        rows_begin(c->n, c->row);
        TAKE(p, c->col, c->row[c->n] + 1);
        TAKE(p, c->value, c->row[c->n] * a->b * a->b + 1);
    }
    pool_free(&scratch);
}
