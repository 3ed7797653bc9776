/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Linear systems.  A solver plugin sets something up, factors or a preconditioner, and flexible GMRES goes round
 * it.  What was set up for an earlier matrix is kept while the iterations that this takes more cost less than a new
 * one, by predicted operations, so that the choice is the same in every run. */
#include "solve/linear.h"
#include "base/clock.h"
#include "solve/vector.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* Part of the largest right-hand side of a run below which a solution is a correction in the last digits. */
#define ROUND_OFF 1e-8

/* Backward error above which a solution is none: that of a stable factorisation is round-off and growth of pivots.
 */
#define BACKWARD_ERROR 1e-8

/* Relative residual of fresh factors above which a solution is useless. */
#define USELESS 1e-6

/* Iterations that a freshly set up iterative solver may take. */
enum { ITERATIVE_MOST = 150 };

/* Part of the residual at which an iteration begins anew: far above round-off in single precision. */
#define ROUND 1e-5

/* Iterations of a rough answer. */
enum { ROUGH = 6 };

static int precondition(void *linear_, const double *b, double *x, error *err)
{
    linear *l = linear_;
    char why[400] = "";

    if (l->band.placed)
        return band_apply(&l->band, &l->a, l->instance[METHOD_DIRECT], b, x, err);
    if (linear_method(l, l->at)->solve(l->instance[l->at], b, x, why, sizeof why))
        return error_set(err, ERR_CONVERGE, "linear solver %s: %s", linear_method(l, l->at)->name, why);
    return 0;
}

static void project(void *linear_, double *rows)
{
    const linear *l = linear_;

    unknowns_project(&l->rows, l->space, rows);
}

static void level(void *linear_, double *x)
{
    const linear *l = linear_;

    unknowns_level(&l->rows, l->space, x);
}

static void multiply(void *linear_, const double *x, double *y)
{
    linear *l = linear_;

    linear_method(l, l->at)->multiply(l->instance[l->at], x, y);
}

static int approximates(const linear *l)
{
    return linear_approximates(linear_method(l, l->at));
}

int linear_renew(linear *l, error *err)
{
    const space *s = l->space;

    arena_free(&l->memory);
    gmres_destroy(&l->krylov);
    l->analyzed = l->factored = l->fresh = l->kept = 0;
    l->row_scale = NULL;
    l->a = (pf_csr){.n = s->n_free,
                    .row = s->row,
                    .shared_col = s->col,
                    .shared_shift = s->col_shift,
                    .n_node = s->n_row_node,
                    .node = s->row_node};
    l->max_iterations = s->mesh->dim == 2 ? 12 : LINEAR_MAX_ITERATIONS;
    ARENA_NEW(&l->memory, l->value, s->row[s->n_free], err);
    l->a.value = l->value;
    ARENA_NEW(&l->memory, l->r, s->n_free, err);
    ARENA_NEW(&l->memory, l->b, s->n_free, err);
    ARENA_NEW(&l->memory, l->dx, s->n_free, err);
    TRY(unknowns_create(&l->rows, &l->memory, s, err));
    l->a.unknowns = &l->rows.view;
    l->krylov = (gmres){.a = &l->a, .n_thread = l->n_thread, .apply = precondition, .ctx = l, .r = l->r};
    return 0;
}

int linear_create(linear *l, const linear_choice *choice, const space *s, int n_thread, error *err)
{
    memset(l, 0, sizeof *l);
    l->choice = *choice;
    l->space = s;
    l->n_thread = n_thread;
    return linear_renew(l, err);
}

void linear_destroy(linear *l)
{
    for (int m = 0; m < N_METHOD; m++)
        if (l->instance[m])
            linear_method(l, m)->destroy(l->instance[m]);
    gmres_destroy(&l->krylov);
    band_destroy(&l->band);
    packed_destroy(&l->packed);
    arena_free(&l->memory);
    memset(l, 0, sizeof *l);
}

void linear_keep(linear *l)
{
    l->kept = 1;
}

int linear_tell(linear *l, const uint8_t *idle, const int *free_fields, const double *const *integral,
                const int64_t *pin, error *err)
{
    l->pin = pin;
    return unknowns_update(&l->rows, &l->memory, l->space, idle, free_fields, integral, err);
}

static int set_up(linear *l, error *err)
{
    const pf_solver *solver;
    char why[400] = "";
    double t;
    int status;

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
        err->retry = 1;
        return ERR_CONVERGE;
    }
    if (status)
        return error_set(err, status == PF_SOLVER_MEMORY ? ERR_MEMORY : ERR_CONVERGE, "linear solver %s: %s",
                         solver->name, why);
    return 0;
}

static int iterate(linear *l, const double *b, double *x, double tol, int limit, double *reached, error *err)
{
    double t = clock_seconds();
    int n, status = gmres_solve(&l->krylov, b, x, tol, limit, reached, &n, err);

    l->stats.gmres_iterations += n;
    l->spent += n;
    l->stats.solve_seconds += clock_seconds() - t;
    return status;
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
static void prepare(linear *l, double *b, int approximate)
{
    l->krylov.project = approximate ? project : NULL;
    l->krylov.level = approximate ? level : NULL;
    l->krylov.multiply = approximate && LINEAR_HAS(linear_method(l, l->at), multiply) ? multiply : NULL;
    l->krylov.scale = approximate ? l->row_scale : NULL;
    if (!approximate)
        hold(l, b);
}

int linear_apply(linear *l, double *b, double *x, error *err)
{
    double reached;

    prepare(l, b, approximates(l));
    return approximates(l) ? iterate(l, b, x, 0.1, ROUGH, &reached, err) : precondition(l, b, x, err);
}

/* Backward error |b - A z| / (| |A||z| | + |b|) of what the solver returns (Oettli and Prager 1964); infinite if
 * it is not a number.  A sound solver keeps it at round-off, however nearly singular A is. */
static int backward_error(linear *l, const double *b, double *z, double *backward, error *err)
{
    int64_t n = l->a.n;
    double *size = l->krylov.v[0], left;

    TRY(precondition(l, b, z, err));
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

static int solve_by_factors(linear *l, double *b, double *x, double tol, error *err)
{
    double reached, size, solve_flops = 4 * l->stats.cost.fill;
    int unfit;

    prepare(l, b, 0);
    if (l->factored && !l->fresh && tol > 0 && l->spent * solve_flops < l->stats.cost.flops) {
        int spent = l->spent;

        TRY(iterate(l, b, x, tol, l->max_iterations, &reached, err));
        if (l->spent == spent + 1 && reached <= LINEAR_ACCEPT)
            l->spent = spent; /* as good as fresh ones: new factors would have taken this iteration, too */
        if (reached <= 1.01 * tol)
            return 0;
    }
    if (!l->fresh && !packed_holds(&l->packed, l->space))
        TRY(linear_analyze(l, METHOD_DIRECT, &unfit, err));
    if (!l->fresh)
        TRY(set_up(l, err));
    TRY(iterate(l, b, x, LINEAR_ACCEPT, 1, &reached, err));
    if (!(reached <= LINEAR_ACCEPT))
        TRY(iterate(l, b, x, 0.1 * LINEAR_ACCEPT, l->max_iterations, &reached, err));
    size = vector_norm(l->a.n, b);
    l->stats.largest_b = fmax(l->stats.largest_b, size);
    if (isfinite(reached)) /* of a right-hand side near round-off only a part */
        l->stats.worst_residual =
            fmax(l->stats.worst_residual, reached * fmin(1, size / (ROUND_OFF * l->stats.largest_b + DBL_MIN)));
    return reached <= USELESS ? 0 : blame(l, b, x, reached, err);
}

/* The iterative solver did not reach tol: the factorisation takes over, for good. */
static int replace(linear *l, double *b, double *x, double tol, double reached, error *err)
{
    int unfit, status;

    linear_forget(l);
    if (!l->choice.direct) {
        error_set(err, ERR_CONVERGE, "linear solver %s: residual %.2g after %d iterations, expected %.2g",
                  l->choice.iterative->name, reached, ITERATIVE_MOST, tol);
        err->retry = 1;
        return ERR_CONVERGE;
    }
    l->gave_up = 1;
    l->analyzed = 0;
    snprintf(l->stats.why, sizeof l->stats.why, "residual %.2g after %d iterations", reached, ITERATIVE_MOST);
    status = linear_analyze(l, METHOD_DIRECT, &unfit, err);
    if (status) {
        err->retry = status == ERR_MEMORY; /* a shorter step may be easier */
        l->gave_up = status != ERR_MEMORY;
        return status;
    }
    if (l->warnings)
        warning_add(l->warnings,
                    "the iterative linear solver reached a residual of %.2g after %d iterations, expected %.2g: %s "
                    "solves from here on",
                    reached, ITERATIVE_MOST, tol, l->choice.direct->name);
    return solve_by_factors(l, b, x, tol, err);
}

/* Goes on from x, which has left l->b = b - A x, *reached of |b|, with what is set up.  The iteration is stopped
 * every now and then and goes on from the residual as it really is: its own product may be one in single precision,
 * and what is begun anew there costs hardly an iteration more. */
static int refine(linear *l, double *x, double tol, int limit, double *reached, int *n_iteration, error *err)
{
    int64_t n = l->a.n;
    int had = l->stats.gmres_iterations;
    double last;

    do {
        double part;

        last = *reached;
        TRY(iterate(l, l->b, l->dx, fmax(tol / last, ROUND), limit - (l->stats.gmres_iterations - had), &part,
                    err));
        *reached *= part;
        vector_add(n, 1, l->dx, x);
        memcpy(l->b, l->r, (size_t)n * sizeof *l->b);
        *n_iteration = l->stats.gmres_iterations - had;
    } while (*reached > tol && *reached < 0.5 * last && *n_iteration < limit);
    return 0;
}

/* The matrix is another one than that of the last set-up. */
static int update(linear *l, error *err)
{
    const pf_solver *solver = linear_method(l, l->at);
    char why[400] = "";
    double t = clock_seconds();
    int status =
        LINEAR_HAS(solver, update) ? solver->update(l->instance[l->at], linear_matrix(l), why, sizeof why) : 0;

    l->stats.factor_seconds += clock_seconds() - t;
    return status ? error_set(err, ERR_MEMORY, "linear solver %s: %s", solver->name, why) : 0;
}

static int solve_by_iteration(linear *l, double *b, double *x, double tol, error *err)
{
    const double price = l->stats.cost.flops / (4 * l->stats.cost.fill), expected = -l->rate * log10(tol);
    double reached = 1, before;
    int n;

    if (!l->row_scale || !l->factored)
        TRY(linear_measure(l, err));
    prepare(l, b, 1);
    memset(x, 0, (size_t)l->a.n * sizeof *x);
    memcpy(l->b, b, (size_t)l->a.n * sizeof *b);
    if (l->factored && !l->fresh && l->spent < price) {
        int spent = l->spent;

        TRY(update(l, err));
        TRY(refine(l, x, tol, (int)(expected + price) + 1, &reached, &n, err));
        l->spent = spent + (int)fmax(0, n - expected);
        if (reached <= 1.01 * tol)
            return 0;
        l->spent += (int)price + 1;
    }
    if (!l->fresh)
        TRY(set_up(l, err));
    before = reached;
    TRY(refine(l, x, tol, ITERATIVE_MOST, &reached, &n, err));
    if (reached < 0.1 * before)
        l->rate = n / log10(before / reached);
    l->spent = 0;
    l->stats.worst_residual = fmax(l->stats.worst_residual, reached);
    return reached <= 1.01 * tol ? 0 : replace(l, b, x, tol, reached, err);
}

int linear_solve(linear *l, double *b, double *x, double tol, error *err)
{
    int moved = l->band.placed && tol > 0 && band_pays(&l->band), done = 0, unfit;

    l->stats.solves++;
    l->fresh = l->fresh && l->kept;
    l->kept = 0;
    if (moved)
        prepare(l, b, 0);
    if (moved)
        TRY(moved_solve(l, b, x, tol, &done, err));
    if (done)
        return 0;
    l->factored = l->factored && !l->band.placed;
    if (!l->analyzed) /* in a matrix for factors a value is held already */
        TRY(moved ? linear_analyze(l, METHOD_DIRECT, &unfit, err) : linear_predict(l, err));
    if (approximates(l))
        return solve_by_iteration(l, b, x, tol > 0 ? tol : 0.1 * USELESS, err);
    return solve_by_factors(l, b, x, tol, err);
}
