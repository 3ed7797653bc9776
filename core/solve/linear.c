/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Linear systems: a fresh factorisation, or GMRES (right preconditioned, no restart) with the
 * factors of an earlier matrix.  Old factors are kept while the iterations spent on them cost
 * less than new ones, by predicted operations, so that the choice is the same in every run. */
#include "solve/solve.h"
#include "base/clock.h"
#include "solve/vector.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

double solve_seconds(void)
{
    struct timespec t;

    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Part of the largest right-hand side of a run below which a solution is a correction in the last digits. */
#define ROUND_OFF 1e-8

/* Backward error above which a solution is none: that of a stable factorisation is round-off and growth of pivots.
 */
#define BACKWARD_ERROR 1e-8

/* Relative residual of fresh factors above which a solution is useless. */
#define USELESS 1e-6

/* y = A x */
static void multiply(const linear *l, const double *x, double *y)
{
    for (int64_t i = 0; i < l->a.n; i++) {
        double s = 0;

        for (int64_t k = l->a.row[i]; k < l->a.row[i + 1]; k++)
            s += l->value[k] * x[l->a.col[k]];
        y[i] = s;
    }
}

static double available_memory(void)
{
    FILE *f = fopen("/proc/meminfo", "r");
    char line[200];
    double kb = 0;

    while (f && fgets(line, sizeof line, f))
        if (sscanf(line, "MemAvailable: %lf kB", &kb) == 1)
            break;
    if (f)
        fclose(f);
    return kb > 0 ? 1024 * kb : (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGESIZE);
}

int linear_create(linear *l, const pf_solver *solver, const space *s, int n_thread, error *err)
{
    char why[400] = "";

    l->solver = solver;
    TRY(band_create(&l->band, solver, s, n_thread, err));
    TRY(linear_renew(l, err));
    if (solver->create(&l->self, n_thread, why, sizeof why))
        return error_set(err, ERR_MEMORY, "linear solver %s: %s", solver->name, why);
    return 0;
}

int linear_renew(linear *l, error *err)
{
    const space *s = l->band.space;

    arena_free(&l->memory);
    l->analyzed = l->factored = l->fresh = l->kept = 0;
    l->a = (pf_csr){.n = s->n_free, .row = s->row, .col = s->col, .n_node = s->n_row_node, .node = s->row_node};
    l->max_iterations = s->mesh->dim == 2 ? 12 : LINEAR_MAX_ITERATIONS;
    ARENA_NEW(&l->memory, l->value, s->row[s->n_free], err);
    l->a.value = l->value;
    ARENA_NEW(&l->memory, l->r, s->n_free, err);
    ARENA_NEW(&l->memory, l->v, (l->max_iterations + 1) * s->n_free, err);
    ARENA_NEW(&l->memory, l->z, l->max_iterations * s->n_free, err);
    return 0;
}

void linear_destroy(linear *l)
{
    if (l->self)
        l->solver->destroy(l->self);
    band_destroy(&l->band);
    arena_free(&l->memory);
    memset(l, 0, sizeof *l);
}

void linear_forget(linear *l)
{
    l->factored = l->fresh = l->has_factors = 0;
}

void linear_move(linear *l, const body_points *now)
{
    band_place(&l->band, now);
    l->factored = l->fresh = 0;
}

void linear_keep(linear *l)
{
    l->kept = 1;
}

int linear_predict(linear *l, error *err)
{
    char why[400] = "";
    double t = clock_seconds(), memory;
    int status = l->solver->analyze(l->self, &l->a, &l->stats.cost, why, sizeof why);

    l->stats.analyze_seconds += clock_seconds() - t;
    if (status)
        return error_set(err, status == PF_SOLVER_MEMORY ? ERR_MEMORY : ERR_CONVERGE, "linear solver %s: %s",
                         l->solver->name, why);
    memory = available_memory();
    if (l->memory_limit > 0 && l->memory_limit < memory)
        memory = l->memory_limit;
    if (l->stats.cost.bytes > memory)
        return error_set(
            err, ERR_MEMORY,
            "the factors of %lld unknowns will need %.3g GB and there are %.3g GB: take fewer cells (%.0f %% in "
            "each direction would fit), a 2D or symmetric part of the problem, or a machine with more memory",
            (long long)l->a.n, l->stats.cost.bytes / 1e9, memory / 1e9,
            100 * pow(memory / l->stats.cost.bytes, 0.25));
    l->analyzed = 1;
    return 0;
}

int linear_apply(linear *l, const double *b, double *x, error *err)
{
    char why[400] = "";

    if (l->band.placed)
        return band_apply(&l->band, &l->a, l->self, b, x, err);
    if (l->solver->solve(l->self, b, x, why, sizeof why))
        return error_set(err, ERR_CONVERGE, "linear solver %s: %s", l->solver->name, why);
    return 0;
}

/* Least-squares update of GMRES: Givens rotations on column k of the Hessenberg matrix. */
static void rotate(double *h, double *c, double *s, double *g, int k)
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
    g[k + 1] = -s[k] * g[k];
    g[k] = c[k] * g[k];
}

/* GMRES from x = 0, at most `limit` iterations; *reached = relative residual, l->r = b - A x. */
static int gmres(linear *l, const double *b, double *x, double tol, int limit, double *reached, error *err)
{
    enum { MOST = LINEAR_MAX_ITERATIONS };
    int64_t n = l->a.n;
    double h[MOST][MOST + 1], c[MOST], s[MOST], g[MOST + 1] = {0}, y[MOST], size = vector_norm(n, b);
    int k = 0;

    memset(x, 0, (size_t)n * sizeof *x);
    memset(l->r, 0, (size_t)n * sizeof *l->r);
    *reached = 0;
    if (size == 0)
        return 0;
    g[0] = size;
    vector_divide(n, size, b, l->v);
    while (k < limit && fabs(g[k]) > tol * size) {
        double *w = l->v + (k + 1) * n, *z = l->z + k * n, next;

        TRY(linear_apply(l, l->v + k * n, z, err));
        multiply(l, z, w);
        for (int i = 0; i <= k; i++) {
            h[k][i] = vector_dot(n, w, l->v + i * n);
            vector_add(n, -h[k][i], l->v + i * n, w);
        }
        next = h[k][k + 1] = vector_norm(n, w);
        if (next > 0)
            vector_divide(n, next, w, w);
        rotate(h[k], c, s, g, k);
        k++;
        l->stats.gmres_iterations++;
        l->spent++;
        if (next == 0)
            break;
    }
    for (int i = k - 1; i >= 0; i--) {
        y[i] = g[i];
        for (int j = i + 1; j < k; j++)
            y[i] -= h[j][i] * y[j];
        y[i] /= h[i][i];
        vector_add(n, y[i], l->z + i * n, x);
    }
    multiply(l, x, l->r);
    vector_subtract(n, b, l->r);
    *reached = vector_norm(n, l->r) / size;
    return 0;
}

/* Operations of a solve: one on an entry of the factors takes twice as long as in the factorisation. */
static double solve_flops(const linear *l)
{
    return 4 * l->stats.cost.fill;
}

static int factor(linear *l, error *err)
{
    char why[400] = "";
    double t;
    int status;

    if (!l->analyzed)
        TRY(linear_predict(l, err));
    t = clock_seconds();
    status = l->solver->setup(l->self, &l->a, why, sizeof why);
    l->stats.factor_seconds += clock_seconds() - t;
    l->stats.factorisations++;
    l->spent = 0;
    l->factored = l->fresh = l->has_factors = status == PF_SOLVER_OK;
    l->moved_solves = 1;
    l->moved_flops = l->stats.cost.flops + BAND_ANALYSIS_FLOPS * (double)l->a.row[l->a.n];
    l->last_flops = 0;
    band_remember(&l->band);
    if (status == PF_SOLVER_SINGULAR) {
        error_set(err, ERR_CONVERGE, "the linear system is singular");
        err->retry = 1;
        return ERR_CONVERGE;
    }
    if (status)
        return error_set(err, status == PF_SOLVER_MEMORY ? ERR_MEMORY : ERR_CONVERGE, "linear solver %s: %s",
                         l->solver->name, why);
    return 0;
}

/* Backward error |b - A z| / (| |A||z| | + |b|) of what the solver returns (Oettli and Prager 1964); infinite if
 * it is not a number.  A sound solver keeps it at round-off, however nearly singular A is. */
static int backward_error(linear *l, const double *b, double *z, double *backward, error *err)
{
    int64_t n = l->a.n;
    double *size = l->v, left;

    TRY(linear_apply(l, b, z, err));
    for (int64_t i = 0; i < n; i++) {
        size[i] = 0;
        for (int64_t k = l->a.row[i]; k < l->a.row[i + 1]; k++)
            size[i] += fabs(l->value[k] * z[l->a.col[k]]);
    }
    multiply(l, z, l->r);
    vector_subtract(n, b, l->r);
    left = vector_norm(n, l->r);
    *backward = left / (vector_norm(n, size) + vector_norm(n, b));
    if (!isfinite(left) || isnan(*backward))
        *backward = INFINITY;
    return 0;
}

/* Fresh factors left a residual: says whether the matrix or the solver is to blame. */
static int blame(linear *l, const double *b, double *x, double reached, error *err)
{
    double backward;

    l->factored = l->fresh = 0;
    TRY(backward_error(l, b, x, &backward, err));
    if (backward > BACKWARD_ERROR)
        return error_set(
            err, ERR_PLUGIN,
            "linear solver %s left a residual of %.2g after its own factorisation, and its solution %s: "
            "the solver or its plugin is at fault, not the equations; take another solver",
            l->solver->name, reached, isinf(backward) ? "is not finite" : "solves no system near this one");
    error_set(err, ERR_CONVERGE, "the linear system is nearly singular: residual %.2g after factoring it", reached);
    err->retry = 1;
    return ERR_CONVERGE;
}

/* By the factors of before bodies have moved, if that pays: it does until a solve takes more than all of them took
 * in the mean since the factorisation, with that. */
static int solve_moved(linear *l, const double *b, double *x, double tol, int *done, error *err)
{
    double t = clock_seconds(), reached = 0;
    int before = l->stats.gmres_iterations, pays;

    *done = 0;
    if (!l->has_factors || tol <= 0 || l->last_flops * l->moved_solves > l->moved_flops)
        return 0;
    TRY(band_setup(&l->band, &l->a, l->stats.cost.flops, &pays, err));
    l->stats.factor_seconds += clock_seconds() - t;
    l->stats.band_factorisations += pays;
    l->factored = pays;
    if (!pays)
        return 0;
    t = clock_seconds();
    TRY(gmres(l, b, x, tol, l->max_iterations, &reached, err));
    l->stats.solve_seconds += clock_seconds() - t;
    l->last_flops = l->band.flops + (l->stats.gmres_iterations - before) * solve_flops(l);
    l->moved_flops += l->last_flops;
    l->moved_solves++;
    *done = reached <= 1.01 * tol;
    return 0;
}

int linear_solve(linear *l, const double *b, double *x, double tol, error *err)
{
    double t, reached, size;
    int done = 0;

    l->stats.solves++;
    l->fresh = l->fresh && l->kept;
    l->kept = 0;
    if (l->band.placed) {
        TRY(solve_moved(l, b, x, tol, &done, err));
        if (done)
            return 0;
    } else if (l->factored && !l->fresh && tol > 0 && l->spent * solve_flops(l) < l->stats.cost.flops) {
        int spent = l->spent;

        t = clock_seconds();
        TRY(gmres(l, b, x, tol, l->max_iterations, &reached, err));
        l->stats.solve_seconds += clock_seconds() - t;
        if (l->spent == spent + 1 && reached <= LINEAR_ACCEPT)
            l->spent = spent; /* as good as fresh ones: new factors would have taken this iteration, too */
        if (reached <= 1.01 * tol)
            return 0;
    }
    if (!l->fresh)
        TRY(factor(l, err));
    t = clock_seconds();
    TRY(gmres(l, b, x, LINEAR_ACCEPT, 1, &reached, err));
    if (!(reached <= LINEAR_ACCEPT))
        TRY(gmres(l, b, x, 0.1 * LINEAR_ACCEPT, l->max_iterations, &reached, err));
    size = vector_norm(l->a.n, b);
    l->stats.largest_b = fmax(l->stats.largest_b, size);
    if (isfinite(reached)) /* of a right-hand side near round-off only a part */
        l->stats.worst_residual =
            fmax(l->stats.worst_residual, reached * fmin(1, size / (ROUND_OFF * l->stats.largest_b + DBL_MIN)));
    l->stats.solve_seconds += clock_seconds() - t;
    return reached <= USELESS ? 0 : blame(l, b, x, reached, err);
}
