/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "parts.h"

#include <stdlib.h>
#include <string.h>

enum { HEAD = 64, SPARE = 64 };

void *pool_take(pool *p, int64_t count, size_t size)
{
    size_t bytes;
    char *at = NULL;

    if (!__builtin_mul_overflow((size_t)count, size, &bytes) && bytes < SIZE_MAX / 2) {
        bytes = (bytes + HEAD + SPARE + 63) & ~(size_t)63;
        at = aligned_alloc(64, bytes);
    }
    if (!at) {
        p->failed = 1;
        return NULL;
    }
    memset(at, 0, bytes);
    memcpy(at, &p->last, sizeof p->last);
    p->last = at;
    return at + HEAD;
}

void pool_free(pool *p)
{
    while (p->last) {
        void *before;

        memcpy(&before, p->last, sizeof before);
        free(p->last);
        p->last = before;
    }
    p->failed = 0;
}

int64_t **pool_markers(pool *p, int n_thread, int64_t n)
{
    int64_t **where;

    TAKE(p, where, n_thread);
    for (int t = 0; t < n_thread && !p->failed; t++)
        TAKE(p, where[t], n + 1);
    return p->failed ? NULL : where;
}

void rows_begin(int32_t n, int64_t *row)
{
    for (int32_t i = 0; i < n; i++)
        row[i + 1] += row[i];
}

typedef float f4 __attribute__((vector_size(16), aligned(4)));

/* Rows low .. high - 1.  A column of a 3 x 3 block is read as four numbers, the last of which is not used. */
static void multiply3(const block_matrix *a, int32_t low, int32_t high, const float *x, float *y)
{
    for (int32_t i = low; i < high; i++) {
        f4 s = {0}, t = {0}, u = {0};

        for (int64_t k = a->row[i]; k < a->row[i + 1]; k++) {
            const float *v = a->value + 9 * k, *xj = x + 3 * (int64_t)a->col[k];

            s += *(const f4 *)v * xj[0];
            t += *(const f4 *)(v + 3) * xj[1];
            u += *(const f4 *)(v + 6) * xj[2];
        }
        s += t + u;
        for (int c = 0; c < 3; c++)
            y[3 * (int64_t)i + c] = s[c];
    }
}

static void multiply2(const block_matrix *a, int32_t low, int32_t high, const float *x, float *y)
{
    for (int32_t i = low; i < high; i++) {
        f4 s = {0};

        for (int64_t k = a->row[i]; k < a->row[i + 1]; k++) {
            const float *xj = x + 2 * (int64_t)a->col[k];

            s += *(const f4 *)(a->value + 4 * k) * (f4){xj[0], xj[0], xj[1], xj[1]};
        }
        y[2 * (int64_t)i] = s[0] + s[2];
        y[2 * (int64_t)i + 1] = s[1] + s[3];
    }
}

void block_multiply(const block_matrix *a, int n_thread, const float *x, float *y)
{
    enum { CHUNK = 256 };

#pragma omp parallel for num_threads(n_thread) if (a->row[a->n] > THREADED / 9) schedule(static)
    for (int32_t c = 0; c < (a->n + CHUNK - 1) / CHUNK; c++) {
        int32_t low = c * CHUNK, high = low + CHUNK < a->n ? low + CHUNK : a->n;

        (a->b == 3 ? multiply3 : multiply2)(a, low, high, x, y);
    }
}

void sparse_multiply(const sparse *a, int n_thread, const double *x, double *y)
{
#pragma omp parallel for num_threads(n_thread) if (a->row[a->n] > THREADED) schedule(static)
    for (int32_t i = 0; i < a->n; i++) {
        double s = 0;

        for (int64_t k = a->row[i]; k < a->row[i + 1]; k++)
            s += a->value[k] * x[a->col[k]];
        y[i] = s;
    }
}
