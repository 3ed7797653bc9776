/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Solutions by factors, fresh ones or those of an earlier matrix as preconditioner, and what both ways to solve
 * share: set-up, iteration, values that are held. */
#include "solve/linear.h"
#include "base/clock.h"
#include "solve/vector.h"

#include <float.h>
#include <math.h>
#include <stdio.h>

/* Part of the largest right-hand side of a run below which a solution is a correction in the last digits. */
#define ROUND_OFF 1e-8

/* Backward error above which a solution is none: that of a stable factorisation is round-off and growth of pivots.
 */
#define BACKWARD_ERROR 1e-8

/* Relative residual of fresh factors above which a solution is useless. */
#define USELESS 1e-6

int linear_precondition(void *linear_, const double *b, double *x, error *err)
{
    linear *l = linear_;
    char why[400] = "";

    if (l->band.placed)
        return band_apply(&l->band, &l->a, l->instance[METHOD_DIRECT], b, x, err);
    if (linear_method(l, l->at)->solve(l->instance[l->at], b, x, why, sizeof why))
        return error_set(err, ERR_CONVERGE, "linear solver %s: %s", linear_method(l, l->at)->name, why);
    return 0;
}

static void multiply(void *linear_, const double *x, double *y)
{
    linear *l = linear_;

    linear_method(l, l->at)->multiply(l->instance[l->at], x, y);
}

static void project(void *linear_, double *rows)
{
    const linear *l = linear_;

    unknowns_project(&l->rows, l->space, rows);
}

static void level(void *linear_, double *x)
{
    const linear *l = linear_;

    unknowns_level(&l->rows, l->space, l->pin, x);
}

int linear_set_up(linear *l, error *err)
{
    const pf_solver *solver;
    char why[400] = "";
    double t;
    int status, unfit;

    if (!linear_holds(l))
        TRY(linear_analyze(l, l->at, &unfit, err));
    solver = linear_method(l, l->at);
    t = clock_seconds();
    status = solver->setup(l->instance[l->at], linear_matrix(l), why, sizeof why);
    l->stats.factor_seconds += clock_seconds() - t;
    l->stats.factorisations++;
    l->spent = 0;
    l->factored = l->fresh = status == PF_SOLVER_OK;
    if (l->band.space)
        band_remember(&l->band, status == PF_SOLVER_OK && l->at == METHOD_DIRECT, &l->stats.cost, &l->a);
    if (status == PF_SOLVER_SINGULAR) {
        error_set(err, ERR_CONVERGE, "the linear system is singular");
        snprintf(l->said, sizeof l->said, "%s", why);
        err->retry = 1;
        return ERR_CONVERGE;
    }
    if (status)
        return error_set(err, status == PF_SOLVER_MEMORY ? ERR_MEMORY : ERR_CONVERGE, "linear solver %s: %s",
                         solver->name, why);
    return 0;
}

int linear_iterate(linear *l, const double *b, double *x, double tol, int limit, double *reached, error *err)
{
    double t = clock_seconds();
    int n, status = gmres_solve(&l->krylov, b, x, tol, limit, reached, &n, err);

    l->stats.gmres_iterations += n;
    l->spent += n;
    l->stats.solve_seconds += clock_seconds() - t;
    return status;
}

/* The solver has a product of its own, and keeps it up to date. */
static int multiplies(const pf_solver *s)
{
    return LINEAR_HAS(s, multiply) && LINEAR_HAS(s, update);
}

/* Of each free field one value is held: its equation is x = 0. */
static void hold(linear *l, double *b)
{
    for (int f = 0; l->pin && f < l->space->n_field; f++) {
        int64_t pin = l->pin[f];

        if (!(l->rows.view.free_fields >> f & 1))
            continue;
        for (int64_t k = l->a.row[pin]; k < l->a.row[pin + 1]; k++) {
            int64_t j = pf_column(&l->a, pin, k);

            l->value[k] = j == pin;
            for (int64_t m = l->a.row[j]; j != pin && m < l->a.row[j + 1]; m++)
                if (pf_column(&l->a, j, m) == pin)
                    l->value[m] = 0;
        }
        b[pin] = 0;
    }
}

/* In an iteration residuals of different fields compare, and free constants are left alone. */
void linear_prepare(linear *l, double *b, int approximate)
{
    l->krylov.project = approximate ? project : NULL;
    l->krylov.level = approximate ? level : NULL;
    l->krylov.multiply = approximate && multiplies(linear_method(l, l->at)) ? multiply : NULL;
    l->krylov.scale = approximate ? l->row_scale : NULL;
    if (!approximate)
        hold(l, b);
}

/* Backward error |b - A z| / (| |A||z| | + |b|) of what the solver returns (Oettli and Prager 1964); infinite if
 * it is not a number.  A sound solver keeps it at round-off, however nearly singular A is. */
static int backward_error(linear *l, const double *b, double *z, double *backward, error *err)
{
    int64_t n = l->a.n;
    double *size = l->krylov.v[0], left;

    TRY(linear_precondition(l, b, z, err));
    for (int64_t i = 0; i < n; i++) {
        size[i] = 0;
        for (int64_t k = l->a.row[i]; k < l->a.row[i + 1]; k++)
            size[i] += fabs(l->value[k] * z[pf_column(&l->a, i, k)]);
    }
    gmres_multiply(&l->krylov, z, l->r);
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
            linear_method(l, l->at)->name, reached,
            isinf(backward) ? "is not finite" : "solves no system near this one");
    error_set(err, ERR_CONVERGE, "the linear system is nearly singular: residual %.2g after factoring it", reached);
    err->retry = 1;
    return ERR_CONVERGE;
}

int linear_by_factors(linear *l, double *b, double *x, double tol, error *err)
{
    double reached, size, solve_flops = 4 * l->stats.cost.fill;

    linear_prepare(l, b, 0);
    if (l->factored && !l->fresh && tol > 0 && l->spent * solve_flops < l->stats.cost.flops) {
        int spent = l->spent;

        TRY(linear_iterate(l, b, x, tol, l->max_iterations, &reached, err));
        if (l->spent == spent + 1 && reached <= LINEAR_ACCEPT)
            l->spent = spent; /* as good as fresh ones: new factors would have taken this iteration, too */
        if (reached <= 1.01 * tol)
            return 0;
    }
    if (!l->fresh)
        TRY(linear_set_up(l, err));
    TRY(linear_iterate(l, b, x, LINEAR_ACCEPT, 1, &reached, err));
    if (!(reached <= LINEAR_ACCEPT))
        TRY(linear_iterate(l, b, x, 0.1 * LINEAR_ACCEPT, l->max_iterations, &reached, err));
    size = vector_norm(l->a.n, b);
    l->stats.largest_b = fmax(l->stats.largest_b, size);
    if (isfinite(reached)) /* of a right-hand side near round-off only a part */
        l->stats.worst_residual =
            fmax(l->stats.worst_residual, reached * fmin(1, size / (ROUND_OFF * l->stats.largest_b + DBL_MIN)));
    return reached <= USELESS ? 0 : blame(l, b, x, reached, err);
}
