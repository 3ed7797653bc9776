/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A row of blocks is spread over a padded copy, four numbers a column, where it is reduced by the rows above. */
#include "ilu.h"

#include <math.h>
#include <string.h>

typedef float f4 __attribute__((vector_size(16), aligned(4)));

void ilu_create(ilu *f, const block_matrix *a, pool *p)
{
    int64_t longest = 0;

    f->a = a;
    for (int32_t i = 0; i < a->n; i++)
        longest = a->row[i + 1] - a->row[i] > longest ? a->row[i + 1] - a->row[i] : longest;
    TAKE(p, f->value, a->row[a->n] * a->b * a->b);
    TAKE(p, f->where, a->n_part + 1);
    TAKE(p, f->room, a->n_part + 1);
    for (int k = 0; k <= a->n_part && !p->failed; k++) {
        TAKE(p, f->where[k], a->n);
        TAKE(p, f->room[k], longest * 4 * a->b);
        if (!p->failed)
            memset(f->where[k], 0xff, (size_t)a->n * sizeof **f->where);
    }
}

/* The inverse of a block, columns of 4 numbers, in place; rows and columns whose pivot vanishes become those of the
 * identity, so that what is wrong shows in the iteration and not as infinities. */
static void invert(float *v, int b)
{
    double a[3][6] = {{0}};

    for (int r = 0; r < b; r++)
        for (int c = 0; c < b; c++)
            a[r][c] = v[4 * c + r];
    for (int r = 0; r < b; r++)
        a[r][b + r] = 1;
    for (int c = 0; c < b; c++) {
        int p = c;

        for (int r = c + 1; r < b; r++)
            p = fabs(a[r][c]) > fabs(a[p][c]) ? r : p;
        for (int k = 0; p != c && k < 2 * b; k++) {
            double t = a[p][k];

            a[p][k] = a[c][k];
            a[c][k] = t;
        }
        if (!(fabs(a[c][c]) > 1e-30))
            a[c][c] = 1;
        for (int k = 2 * b - 1; k >= c; k--)
            a[c][k] /= a[c][c];
        for (int r = 0; r < b; r++)
            for (int k = 2 * b - 1; r != c && k >= c; k--)
                a[r][k] -= a[r][c] * a[c][k];
    }
    for (int r = 0; r < b; r++)
        for (int c = 0; c < b; c++)
            v[4 * c + r] = (float)a[r][b + c];
}

/* w = w d: columns of 4 numbers times a block of b x b. */
static inline void times_block(f4 *w, const float *d, int b)
{
    f4 p[3];

    for (int c = 0; c < b; c++) {
        p[c] = w[0] * d[c * b];
        for (int k = 1; k < b; k++)
            p[c] += w[k] * d[c * b + k];
    }
    for (int c = 0; c < b; c++)
        w[c] = p[c];
}

/* w -= l u */
static inline void subtract_product(f4 *restrict w, const f4 *restrict l, const float *restrict u, int b)
{
    for (int c = 0; c < b; c++)
        for (int k = 0; k < b; k++)
            w[c] -= l[k] * u[c * b + k];
}

static inline void factor_row(ilu *f, int32_t i, int b, int32_t *where, float *room)
{
    const block_matrix *a = f->a;
    int64_t first = a->row[i], last = a->row[i + 1];

    for (int64_t k = first; k < last; k++) {
        where[a->col[k]] = (int32_t)(k - first);
        for (int c = 0; c < b; c++)
            for (int r = 0; r < b; r++)
                room[(k - first) * 4 * b + 4 * c + r] = a->value[k * b * b + c * b + r];
    }
    for (int64_t k = first; k < a->diagonal[i]; k++) {
        int32_t j = a->col[k];
        f4 *w = (f4 *)(room + (k - first) * 4 * b);
        f4 l[3];

        times_block(w, f->value + a->diagonal[j] * b * b, b);
        for (int c = 0; c < b; c++)
            l[c] = w[c];
        for (int64_t m = a->diagonal[j] + 1; m < a->row[j + 1]; m++) {
            int32_t at = where[a->col[m]];

            if (at >= 0)
                subtract_product((f4 *)(room + (int64_t)at * 4 * b), l, f->value + m * b * b, b);
        }
    }
    invert(room + (a->diagonal[i] - first) * 4 * b, b);
    for (int64_t k = first; k < last; k++) {
        where[a->col[k]] = -1;
        for (int c = 0; c < b; c++)
            for (int r = 0; r < b; r++)
                f->value[k * b * b + c * b + r] = room[(k - first) * 4 * b + 4 * c + r];
    }
}

static void factor_rows(ilu *f, int32_t low, int32_t high, int part)
{
    for (int32_t i = low; i < high; i++)
        if (f->a->b == 3)
            factor_row(f, i, 3, f->where[part], f->room[part]);
        else
            factor_row(f, i, 2, f->where[part], f->room[part]);
}

void ilu_factor(ilu *f, int n_thread)
{
    const block_matrix *a = f->a;

#pragma omp parallel for num_threads(n_thread) schedule(static, 1)
    for (int p = 0; p < a->n_part; p++)
        factor_rows(f, a->part[p], a->part[p + 1], p);
    factor_rows(f, a->part[a->n_part], a->n, a->n_part);
}

/* Sum of the entries low .. high - 1 of a row times x. */
static inline f4 reduce(const ilu *f, int64_t low, int64_t high, const float *x, int b)
{
    const int32_t *col = f->a->col;
    f4 s = {0}, t = {0}, u = {0};

    for (int64_t k = low; k < high; k++) {
        const float *v = f->value + k * b * b, *xj = x + b * (int64_t)col[k];

        if (b == 3) {
            s += *(const f4 *)v * xj[0];
            t += *(const f4 *)(v + 3) * xj[1];
            u += *(const f4 *)(v + 6) * xj[2];
        } else {
            s += *(const f4 *)v * (f4){xj[0], xj[0], xj[1], xj[1]};
        }
    }
    return b == 3 ? s + t + u : (f4){s[0] + s[2], s[1] + s[3], 0, 0};
}

static inline void forward(const ilu *f, int32_t low, int32_t high, float *x, int b)
{
    for (int32_t i = low; i < high; i++) {
        f4 s = reduce(f, f->a->row[i], f->a->diagonal[i], x, b);

        for (int c = 0; c < b; c++)
            x[b * (int64_t)i + c] -= s[c];
    }
}

static inline void backward(const ilu *f, int32_t low, int32_t high, float *x, int b)
{
    for (int32_t i = high; i-- > low;) {
        f4 s = reduce(f, f->a->diagonal[i] + 1, f->a->row[i + 1], x, b);
        const float *d = f->value + f->a->diagonal[i] * b * b;
        float *xi = x + b * (int64_t)i, t[3];

        for (int c = 0; c < b; c++)
            t[c] = xi[c] - s[c];
        for (int r = 0; r < b; r++) {
            xi[r] = 0;
            for (int c = 0; c < b; c++)
                xi[r] += d[c * b + r] * t[c];
        }
    }
}

static void sweep(const ilu *f, int part, int back, float *x)
{
    const block_matrix *a = f->a;
    int32_t low = a->part[part], high = part < a->n_part ? a->part[part + 1] : a->n;

    if (back && a->b == 3)
        backward(f, low, high, x, 3);
    else if (back)
        backward(f, low, high, x, 2);
    else if (a->b == 3)
        forward(f, low, high, x, 3);
    else
        forward(f, low, high, x, 2);
}

void ilu_solve(const ilu *f, int n_thread, const float *b, float *x)
{
    const block_matrix *a = f->a;

    if (x != b)
        memcpy(x, b, (size_t)a->n * (size_t)a->b * sizeof *x);
#pragma omp parallel for num_threads(n_thread) schedule(static, 1)
    for (int p = 0; p < a->n_part; p++)
        sweep(f, p, 0, x);
    sweep(f, a->n_part, 0, x);
    sweep(f, a->n_part, 1, x);
#pragma omp parallel for num_threads(n_thread) schedule(static, 1)
    for (int p = 0; p < a->n_part; p++)
        sweep(f, p, 1, x);
}
