/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Solutions by a solver that only approximates: flexible GMRES with what it has set up, begun anew now and then. */
#include "solve/linear.h"
#include "base/clock.h"
#include "solve/vector.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Iterations that a freshly set up iterative solver may take. */
enum { ITERATIVE_MOST = 150 };

/* Part of the residual at which an iteration begins anew: far above round-off in single precision. */
#define ROUND 1e-5

/* The iterative solver did not do: the factorisation takes over, for good. */
static int replace(linear *l, double *b, double *x, double tol, const char *why, error *err)
{
    int unfit, status;

    linear_forget(l);
    if (!l->choice.direct) {
        error_set(err, ERR_CONVERGE, "linear solver %s: %s", l->choice.iterative->name, why);
        err->retry = 1;
        return ERR_CONVERGE;
    }
    l->gave_up = 1;
    l->analyzed = 0;
    snprintf(l->stats.why, sizeof l->stats.why, "%s", why);
    status = linear_analyze(l, METHOD_DIRECT, &unfit, err);
    if (status) {
        err->retry = status == ERR_MEMORY; /* a shorter step may be easier */
        l->gave_up = status != ERR_MEMORY;
        return status;
    }
    if (l->warnings)
        warning_add(l->warnings, "the iterative linear solver gave up (%s): %s solves from here on", why,
                    l->choice.direct->name);
    return linear_by_factors(l, b, x, tol, err);
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
        TRY(linear_iterate(l, l->b, l->dx, fmax(tol / last, ROUND), limit - (l->stats.gmres_iterations - had),
                           &part, err));
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
    return status ? error_set(err, status == PF_SOLVER_MEMORY ? ERR_MEMORY : ERR_CONVERGE, "linear solver %s: %s",
                              solver->name, why)
                  : 0;
}

/* Nothing has been solved yet. */
static void begin(linear *l, const double *b, double *x, double *reached)
{
    memset(x, 0, (size_t)l->a.n * sizeof *x);
    memcpy(l->b, b, (size_t)l->a.n * sizeof *b);
    *reached = 1;
}

/* Iterations that a set-up costs. */
static double price(const linear *l)
{
    double one = 4 * l->stats.cost.fill;

    return one > 0 ? fmin(l->stats.cost.flops / one, GMRES_MOST) : 0;
}

int linear_by_iteration(linear *l, double *b, double *x, double tol, error *err)
{
    const double expected = -l->rate * log10(tol);
    double reached, before;
    char why[200];
    int n;

    if (!l->row_scale || !l->factored)
        TRY(linear_measure(l, err));
    linear_prepare(l, b, 1);
    begin(l, b, x, &reached);
    if (l->factored && !l->fresh && linear_holds(l) && l->spent < price(l)) {
        int spent = l->spent;

        TRY(update(l, err));
        TRY(refine(l, x, tol, (int)(expected + price(l)) + 1, &reached, &n, err));
        l->spent = spent + (int)fmax(0, n - expected);
        if (reached <= 1.01 * tol)
            return 0;
        if (!isfinite(reached))
            begin(l, b, x, &reached);
    }
    if (!l->fresh && linear_set_up(l, err)) {
        snprintf(why, sizeof why, "%.*s", (int)sizeof why - 1, err->text);
        return replace(l, b, x, tol, why, err);
    }
    before = reached;
    TRY(refine(l, x, tol, ITERATIVE_MOST, &reached, &n, err));
    if (reached < 0.1 * before)
        l->rate = n / log10(before / reached);
    l->spent = 0;
    l->stats.worst_residual = fmax(l->stats.worst_residual, reached);
    if (reached <= 1.01 * tol)
        return 0;
    snprintf(why, sizeof why, "residual %.2g after %d iterations, expected %.2g", reached, n, tol);
    return replace(l, b, x, tol, why, err);
}
