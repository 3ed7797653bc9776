/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "solve/gmres.h"

#include "solve/vector.h"

#include <math.h>
#include <string.h>

void gmres_multiply(const gmres *g, const double *x, double *y)
{
    const int64_t *row = g->a->row, *shift = g->a->shared_shift;
    const int32_t *col = g->a->shared_col;
    const double *value = g->a->value;

#pragma omp parallel for num_threads(g->n_thread) if (row[g->a->n] >= VECTOR_THREADED) schedule(static)
    for (int64_t i = 0; i < g->a->n; i++) {
        double s = 0;

        for (int64_t k = row[i]; k < row[i + 1]; k++)
            s += value[k] * x[col[k + shift[i]]];
        y[i] = s;
    }
}

/* y = P A L x with the projections; x is levelled in place.  exact: not by an approximate product. */
static void operate(const gmres *g, int exact, double *x, double *y)
{
    if (g->level)
        g->level(g->ctx, x);
    if (g->multiply && !exact)
        g->multiply(g->ctx, x, y);
    else
        gmres_multiply(g, x, y);
    if (g->project)
        g->project(g->ctx, y);
}

/* Least-squares update: Givens rotations on column k of the Hessenberg matrix. */
static void rotate(double *h, double *c, double *s, double *e, int k)
{
    double d;

    for (int i = 0; i < k; i++) {
        double a = c[i] * h[i] + s[i] * h[i + 1];

        h[i + 1] = -s[i] * h[i] + c[i] * h[i + 1];
        h[i] = a;
    }
    d = hypot(h[k], h[k + 1]);
    c[k] = d > 0 ? h[k] / d : 1;
    s[k] = d > 0 ? h[k + 1] / d : 0;
    h[k] = d;
    e[k + 1] = -s[k] * e[k];
    e[k] = c[k] * e[k];
}

static int make_room(gmres *g, int k, error *err)
{
    if (!g->h)
        ARENA_NEW(&g->memory, g->h, GMRES_MOST, err);
    if (!g->r)
        ARENA_NEW(&g->memory, g->r, g->a->n, err);
    if (!g->v[k])
        ARENA_NEW(&g->memory, g->v[k], g->a->n, err);
    if (!g->v[k + 1])
        ARENA_NEW(&g->memory, g->v[k + 1], g->a->n, err);
    if (!g->z[k])
        ARENA_NEW(&g->memory, g->z[k], g->a->n, err);
    return 0;
}

static void scale_rows(const gmres *g, double *y)
{
    for (int64_t i = 0; g->scale && i < g->a->n; i++)
        y[i] *= g->scale[i];
}

/* z = M^-1 (v / scale), w = scale A z, orthogonal to those before; h: its column of the Hessenberg matrix. */
static int extend(gmres *g, int k, double *h, error *err)
{
    int64_t n = g->a->n;
    double *w = g->v[k + 1], *unscaled = g->r;

    for (int64_t i = 0; i < n; i++)
        unscaled[i] = g->scale ? g->v[k][i] / g->scale[i] : g->v[k][i];
    TRY(g->apply(g->ctx, unscaled, g->z[k], err));
    operate(g, 0, g->z[k], w);
    scale_rows(g, w);
    for (int i = 0; i <= k; i++) {
        h[i] = vector_dot(n, w, g->v[i]);
        vector_add(n, -h[i], g->v[i], w);
    }
    h[k + 1] = vector_norm(n, w);
    if (h[k + 1] > 0)
        vector_divide(n, h[k + 1], w, w);
    return 0;
}

int gmres_solve(gmres *g, const double *b, double *x, double tol, int limit, double *reached, int *n_iteration,
                error *err)
{
    int64_t n = g->a->n;
    double c[GMRES_MOST], s[GMRES_MOST], e[GMRES_MOST + 1] = {0}, y[GMRES_MOST], size;
    double(*h)[GMRES_MOST + 1];
    int k = 0;

    memset(x, 0, (size_t)n * sizeof *x);
    *reached = 0;
    *n_iteration = 0;
    TRY(make_room(g, 0, err));
    h = g->h;
    memcpy(g->v[0], b, (size_t)n * sizeof *b);
    memcpy(g->r, b, (size_t)n * sizeof *b);
    scale_rows(g, g->v[0]);
    size = vector_norm(n, g->v[0]);
    if (size == 0)
        return 0;
    e[0] = size;
    vector_divide(n, size, g->v[0], g->v[0]);
    while (k < limit && k < GMRES_MOST && fabs(e[k]) > tol * size) {
        double next;

        TRY(make_room(g, k, err));
        TRY(extend(g, k, h[k], err));
        next = h[k][k + 1];
        rotate(h[k], c, s, e, k);
        k++;
        if (!(next > 0)) /* done, or not a number */
            break;
    }
    for (int i = k - 1; i >= 0; i--) {
        y[i] = e[i];
        for (int j = i + 1; j < k; j++)
            y[i] -= h[j][i] * y[j];
        y[i] = h[i][i] != 0 ? y[i] / h[i][i] : 0;
        vector_add(n, y[i], g->z[i], x);
    }
    operate(g, 1, x, g->r);
    vector_subtract(n, b, g->r);
    memcpy(g->v[0], g->r, (size_t)n * sizeof *b);
    scale_rows(g, g->v[0]);
    *reached = vector_norm(n, g->v[0]) / size;
    *n_iteration = k;
    return 0;
}

void gmres_destroy(gmres *g)
{
    arena_free(&g->memory);
    memset(g, 0, sizeof *g);
}
