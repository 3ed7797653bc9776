/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Linear systems: a fresh factorisation, or GMRES (right preconditioned, no restart) with the
 * factors of an earlier matrix.  Old factors are kept while the iterations spent on them cost
 * less than new ones, by predicted operations, so that the choice is the same in every run. */
#include "solve/solve.h"

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

static double dot(int64_t n, const double *a, const double *b)
{
    double s = 0;

    for (int64_t i = 0; i < n; i++)
        s += a[i] * b[i];
    return s;
}

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
    l->a = (pf_csr){.n = s->n_free, .row = s->row, .col = s->col, .n_node = s->n_row_node, .node = s->row_node};
    l->max_iterations = s->mesh->dim == 2 ? 12 : 30;
    ARENA_NEW(&l->memory, l->value, s->row[s->n_free], err);
    l->a.value = l->value;
    ARENA_NEW(&l->memory, l->r, 2 * s->n_free, err);
    ARENA_NEW(&l->memory, l->v, (l->max_iterations + 1) * s->n_free, err);
    ARENA_NEW(&l->memory, l->z, l->max_iterations * s->n_free, err);
    if (solver->create(&l->self, n_thread, why, sizeof why))
        return error_set(err, ERR_MEMORY, "linear solver %s: %s", solver->name, why);
    return 0;
}

void linear_destroy(linear *l)
{
    if (l->self)
        l->solver->destroy(l->self);
    arena_free(&l->memory);
    memset(l, 0, sizeof *l);
}

void linear_forget(linear *l)
{
    l->factored = 0;
}

int linear_predict(linear *l, error *err)
{
    char why[400] = "";
    double t = solve_seconds(), memory;
    int status = l->solver->analyze(l->self, &l->a, &l->stats.cost, why, sizeof why);

    l->stats.analyze_seconds += solve_seconds() - t;
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

/* GMRES from x = 0; *reached = relative residual. */
static int gmres(linear *l, const double *b, double *x, double tol, int limit, double *reached, error *err)
{
    enum { MOST = 64 };
    int64_t n = l->a.n;
    double h[MOST][MOST + 1], c[MOST], s[MOST], g[MOST + 1] = {0}, y[MOST], size = sqrt(dot(n, b, b));
    int k = 0;

    memset(x, 0, (size_t)n * sizeof *x);
    *reached = 0;
    if (size == 0)
        return 0;
    g[0] = size;
    for (int64_t i = 0; i < n; i++)
        l->v[i] = b[i] / size;
    while (k < limit && fabs(g[k]) > tol * size) {
        double *w = l->v + (k + 1) * n, *z = l->z + k * n, next;

        TRY(linear_apply(l, l->v + k * n, z, err));
        multiply(l, z, w);
        for (int i = 0; i <= k; i++) {
            h[k][i] = dot(n, w, l->v + i * n);
            for (int64_t j = 0; j < n; j++)
                w[j] -= h[k][i] * l->v[i * n + j];
        }
        next = h[k][k + 1] = sqrt(dot(n, w, w));
        for (int64_t j = 0; j < n && next > 0; j++)
            w[j] /= next;
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
        for (int64_t j = 0; j < n; j++)
            x[j] += y[i] * l->z[i * n + j];
    }
    multiply(l, x, l->r);
    for (int64_t i = 0; i < n; i++)
        l->r[i] = b[i] - l->r[i];
    *reached = sqrt(dot(n, l->r, l->r)) / size;
    return 0;
}

static int factor(linear *l, error *err)
{
    char why[400] = "";
    double t;
    int status;

    if (!l->analyzed)
        TRY(linear_predict(l, err));
    t = solve_seconds();
    status = l->solver->setup(l->self, &l->a, why, sizeof why);
    l->stats.factor_seconds += solve_seconds() - t;
    l->stats.factorisations++;
    l->spent = 0;
    l->factored = status == PF_SOLVER_OK;
    if (status == PF_SOLVER_SINGULAR) {
        error_set(err, ERR_CONVERGE,
                  "the linear system is singular: an equation or a boundary condition is missing for some unknown");
        err->retry = 1;
        return ERR_CONVERGE;
    }
    if (status)
        return error_set(err, status == PF_SOLVER_MEMORY ? ERR_MEMORY : ERR_CONVERGE, "linear solver %s: %s",
                         l->solver->name, why);
    return 0;
}

int linear_solve(linear *l, const double *b, double *x, double tol, error *err)
{
    double t, reached, size, solve_flops = 4 * l->stats.cost.fill;

    l->stats.solves++;
    if (l->factored && tol > 0 && l->spent * solve_flops < l->stats.cost.flops) {
        t = solve_seconds();
        TRY(gmres(l, b, x, tol, l->max_iterations, &reached, err));
        l->stats.solve_seconds += solve_seconds() - t;
        if (reached <= 1.01 * tol)
            return 0;
    }
    TRY(factor(l, err));
    t = solve_seconds();
    TRY(gmres(l, b, x, LINEAR_ACCEPT, 1, &reached, err));
    if (!(reached <= LINEAR_ACCEPT))
        TRY(gmres(l, b, x, 0.1 * LINEAR_ACCEPT, l->max_iterations, &reached, err));
    size = sqrt(dot(l->a.n, b, b));
    l->stats.largest_b = fmax(l->stats.largest_b, size);
    if (isfinite(reached)) /* of a right-hand side near round-off only a part */
        l->stats.worst_residual =
            fmax(l->stats.worst_residual, reached * fmin(1, size / (ROUND_OFF * l->stats.largest_b + DBL_MIN)));
    l->stats.solve_seconds += solve_seconds() - t;
    if (!(reached <= 1e-6)) {
        error_set(err, ERR_CONVERGE, "the linear system is nearly singular: residual %.2g after factoring it",
                  reached);
        err->retry = 1;
        l->factored = 0;
        return ERR_CONVERGE;
    }
    return 0;
}
