/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "pressure.h"

#include <math.h>
#include <string.h>

enum { COARSEST = 600 };

/* A constant pressure that is free leaves T singular. */
#define SHIFT 1e-8

/* Row i of T, over the blocks of the fluid: columns are found by where[] >= first. */
static int64_t row_of_t(const split *s, int32_t i, int64_t first, int64_t *where, int32_t *col, double *value)
{
    int b = s->b;
    int64_t n = first;

    for (int64_t k = s->c.row[i]; k < s->c.row[i + 1]; k++) {
        int32_t j = s->c.col[k];

        where[j] = n;
        if (col) {
            col[n] = j;
            value[n] = s->active_p[i] && s->active_p[j] ? s->c.value[k] : i == j;
        }
        n++;
    }
    for (int64_t k = s->d_row[i]; k < s->d_row[i + 1]; k++) {
        int32_t block = s->d_col[k];
        double dd[3];

        if (s->is_global[block])
            continue;
        for (int c = 0; col && c < b; c++)
            dd[c] = (double)s->d[k * b + c] * s->inverse_diagonal[(int64_t)block * b + c];
        for (int64_t m = s->g_row[block]; m < s->g_row[block + 1]; m++) {
            int32_t j = s->g_col[m];

            if (where[j] < first) {
                where[j] = n;
                if (col) {
                    col[n] = j;
                    value[n] = 0;
                }
                n++;
            }
            for (int c = 0; col && c < b && s->active_p[i] && s->active_p[j]; c++)
                value[where[j]] -= dd[c] * s->g[m * b + c];
        }
    }
    return n;
}

static void make_t(pressure *q, const split *s)
{
    sparse *t = &q->t;
    pool scratch = {0};
    int64_t **where = pool_markers(&scratch, s->n_thread, s->n_p);
    double trace = 0;

    *t = (sparse){.n = s->n_p, .n_col = s->n_p};
    TAKE(&q->memory, t->row, s->n_p + 1);
    q->memory.failed |= scratch.failed;
    for (int pass = 0; pass < 2 && !q->memory.failed; pass++) {
#pragma omp parallel for num_threads(s->n_thread) schedule(static, 1)
        for (int k = 0; k < s->n_thread; k++) {
            int64_t n = 0;

            memset(where[k], 0xff, (size_t)s->n_p * sizeof **where);
            for (ROWS_OF_THREAD(i, s->n_p, k, s->n_thread)) {
                int64_t first = pass ? t->row[i] : n;

                n = row_of_t(s, i, first, where[k], t->col, t->value);
                if (!pass)
                    t->row[i + 1] = n - first;
            }
        }
        if (!pass) {
            rows_begin(t->n, t->row);
            TAKE(&q->memory, t->col, t->row[t->n] + 1);
            TAKE(&q->memory, t->value, t->row[t->n] + 1);
        }
    }
    pool_free(&scratch);
    for (int32_t i = 0; i < t->n && !q->memory.failed; i++)
        for (int64_t k = t->row[i]; k < t->row[i + 1]; k++)
            trace += t->col[k] == i && s->active_p[i] ? t->value[k] : 0;
    q->sign = trace < 0 ? -1 : 1;
    for (int32_t i = 0; i < t->n && !q->memory.failed; i++)
        for (int64_t k = t->row[i]; k < t->row[i + 1]; k++)
            t->value[k] *= s->active_p[i] ? q->sign * (1 + (t->col[k] == i) * SHIFT) : 1;
}

static int make_levels(pressure *q, const split *s)
{
    pool *p = &q->memory;

    q->n_level = 0;
    for (;;) {
        pressure_level *l = &q->level[q->n_level];
        sparse ap;

        if (q->n_level == 0)
            l->a = q->t;
        TAKE(p, l->diagonal, l->a.n + 1);
        TAKE(p, l->x, l->a.n + 1);
        TAKE(p, l->b, l->a.n + 1);
        TAKE(p, l->r, l->a.n + 1);
        if (p->failed)
            return PF_SOLVER_MEMORY;
        for (int32_t i = 0; i < l->a.n; i++)
            for (int64_t k = l->a.row[i]; k < l->a.row[i + 1]; k++)
                l->diagonal[i] += l->a.col[k] == i ? l->a.value[k] : 0;
        q->n_level++;
        if (l->a.n <= COARSEST || q->n_level == PRESSURE_LEVELS)
            break;
        aggregate(&l->a, q->n_level == 1 ? s->active_p : NULL, q->o->strength, &l->prolong, p);
        if (p->failed)
            return PF_SOLVER_MEMORY;
        if (l->prolong.n_col == 0 || l->prolong.n_col > 0.8 * l->a.n)
            break;
        sparse_transpose(&l->prolong, &l->restrict_, p);
        if (!p->failed)
            sparse_product(&l->a, &l->prolong, s->n_thread, &ap, p);
        if (!p->failed)
            sparse_product(&l->restrict_, &ap, s->n_thread, &q->level[q->n_level].a, p);
        if (p->failed)
            return PF_SOLVER_MEMORY;
    }
    return coarse_factor(&q->coarse, &q->level[q->n_level - 1].a, p);
}

int pressure_create(pressure *q, const split *s, const options *o)
{
    pool *p = &q->memory;

    memset(q, 0, sizeof *q);
    q->s = s;
    q->o = o;
    make_t(q, s);
    TAKE(p, q->r, s->n_p + 1);
    TAKE(p, q->z, s->n_p + 1);
    TAKE(p, q->d, s->n_p + 1);
    TAKE(p, q->w, s->n_p + 1);
    TAKE(p, q->y, s->n_p + 1);
    TAKE(p, q->f, (int64_t)s->f.n * s->b);
    TAKE(p, q->g, (int64_t)s->f.n * s->b);
    TAKE(p, q->body, s->f.n + 1);
    if (p->failed)
        return PF_SOLVER_MEMORY;
    for (int32_t i = 0; i < s->f.n; i++)
        if (s->is_global[i])
            q->body[q->n_body++] = i;
    return make_levels(q, s);
}

void pressure_destroy(pressure *q)
{
    coarse_destroy(&q->coarse);
    pool_free(&q->memory);
    memset(q, 0, sizeof *q);
}

/* Gauss-Seidel. */
static void relax(const pressure_level *l, int back)
{
    const sparse *a = &l->a;

    for (int32_t m = 0; m < a->n; m++) {
        int32_t i = back ? a->n - 1 - m : m;
        double s = l->b[i];

        for (int64_t k = a->row[i]; k < a->row[i + 1]; k++)
            s -= a->value[k] * l->x[a->col[k]];
        if (l->diagonal[i] > 0)
            l->x[i] += s / l->diagonal[i];
    }
}

/* level[k].x = a V-cycle for level[k].b. */
static void cycle(pressure *q, int k)
{
    pressure_level *l = &q->level[k];
    double *next;

    if (k == q->n_level - 1) {
        if (!coarse_solve(&q->coarse, l->b, l->x)) {
            relax(l, 0);
            relax(l, 1);
        }
        return;
    }
    memset(l->x, 0, (size_t)l->a.n * sizeof *l->x);
    for (int m = 0; m < q->o->sweeps; m++)
        relax(l, 0);
    sparse_multiply(&l->a, 1, l->x, l->r);
    for (int32_t i = 0; i < l->a.n; i++)
        l->r[i] = l->b[i] - l->r[i];
    sparse_multiply(&l->restrict_, 1, l->r, q->level[k + 1].b);
    cycle(q, k + 1);
    next = q->level[k + 1].x;
    for (int32_t i = 0; i < l->a.n; i++)
        for (int64_t m = l->prolong.row[i]; m < l->prolong.row[i + 1]; m++)
            l->x[i] += l->prolong.value[m] * next[l->prolong.col[m]];
    for (int m = 0; m < q->o->sweeps; m++)
        relax(l, 1);
}

/* Takes the mean off, where a constant pressure is free. */
static void level_out(const pressure *q, double *x)
{
    double sum = 0;
    int32_t n = 0;

    for (int32_t i = 0; q->s->gauge && i < q->s->n_p; i++) {
        sum += q->s->active_p[i] ? x[i] : 0;
        n += q->s->active_p[i];
    }
    for (int32_t i = 0; q->s->gauge && i < q->s->n_p; i++)
        x[i] -= q->s->active_p[i] ? sum / n : 0;
}

static double dot(int32_t n, const double *a, const double *b)
{
    double s = 0;

    for (int32_t i = 0; i < n; i++)
        s += a[i] * b[i];
    return s;
}

/* y = T x, the bodies' part included: -D_b dF_b^-1 G_b x. */
static void multiply_t(const pressure *q, const double *x, double *y)
{
    const split *s = q->s;
    int b = s->b;

    sparse_multiply(&q->t, s->n_thread, x, y);
    for (int32_t n = 0; n < q->n_body; n++) {
        int32_t i = q->body[n];
        double v[3] = {0};

        for (int64_t k = s->g_row[i]; k < s->g_row[i + 1]; k++)
            for (int c = 0; c < b; c++)
                v[c] += s->g[k * b + c] * (s->active_p[s->g_col[k]] ? x[s->g_col[k]] : 0);
        for (int c = 0; c < b; c++)
            v[c] *= s->inverse_diagonal[(int64_t)i * b + c];
        for (int64_t k = s->g_row[i]; k < s->g_row[i + 1]; k++) { /* there D is -G^T, or G^T with a sign of -1 */
            int32_t j = s->g_col[k];

            for (int c = 0; c < b && s->active_p[j]; c++)
                y[j] += s->g[k * b + c] * v[c];
        }
    }
}

/* x = T^-1 b by conjugate gradients with a V-cycle. */
static void solve_t(pressure *q, const double *b, double *x)
{
    int32_t n = q->s->n_p;
    double start, rz = 0;

    memset(x, 0, (size_t)n * sizeof *x);
    memcpy(q->r, b, (size_t)n * sizeof *x);
    level_out(q, q->r);
    start = sqrt(dot(n, q->r, q->r));
    for (int k = 0; k < q->o->inner_iterations && start > 0; k++) {
        double before = rz, a;

        memcpy(q->level[0].b, q->r, (size_t)n * sizeof *x);
        cycle(q, 0);
        memcpy(q->z, q->level[0].x, (size_t)n * sizeof *x);
        level_out(q, q->z);
        rz = dot(n, q->r, q->z);
        for (int32_t i = 0; i < n; i++)
            q->d[i] = q->z[i] + (k ? rz / before * q->d[i] : 0);
        multiply_t(q, q->d, q->w);
        a = rz / dot(n, q->d, q->w);
        if (!(a > 0) || !isfinite(a))
            break;
        for (int32_t i = 0; i < n; i++) {
            x[i] += a * q->d[i];
            q->r[i] -= a * q->w[i];
        }
        if (sqrt(dot(n, q->r, q->r)) <= q->o->inner * start)
            break;
    }
    for (int32_t i = 0; i < n; i++)
        x[i] = q->s->active_p[i] ? x[i] : 0;
    level_out(q, x);
}

void pressure_solve(pressure *q, const double *r, double *p)
{
    const split *s = q->s;
    int b = s->b;

    for (int32_t i = 0; i < s->n_p; i++)
        q->y[i] = s->active_p[i] ? q->sign * r[i] : 0;
    solve_t(q, q->y, p); /* p: y of the recipe */
    memcpy(q->y, p, (size_t)s->n_p * sizeof *p);
    split_gradient(s, q->y, 1, q->f);
    for (int64_t i = 0; i < (int64_t)s->f.n * b; i++)
        q->f[i] *= s->inverse_diagonal[i];
    block_multiply(&s->f, s->n_thread, q->f, q->g);
    for (int64_t i = 0; i < (int64_t)s->f.n * b; i++)
        q->g[i] *= s->inverse_diagonal[i];
    split_divergence(s, q->g, q->w);
    sparse_multiply(&s->c, s->n_thread, q->y, q->z);
    for (int32_t i = 0; i < s->n_p; i++)
        q->y[i] = s->active_p[i] ? q->sign * (q->z[i] - q->w[i]) : 0;
    solve_t(q, q->y, p);
    for (int32_t i = 0; i < s->n_p; i++)
        p[i] = s->active_p[i] ? p[i] : r[i];
}
