/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Linear systems with the factors of before bodies have moved (band.h), or without. */
#include "base/clock.h"
#include "solve/linear.h"

void linear_forget(linear *l)
{
    l->factored = l->fresh = l->band.factors = 0;
}

int linear_move(linear *l, const body_points *now, error *err)
{
    l->factored = l->fresh = 0;
    if (!l->choice.direct)
        return 0;
    if (!l->band.space)
        TRY(band_create(&l->band, l->choice.direct, l->choice.params, l->space, l->n_thread, err));
    band_place(&l->band, now);
    return 0;
}

/* What the band cannot do fresh factors can: only where memory runs out an error is one. */
static int give_up(linear *l, const error *err)
{
    l->factored = l->band.factors = 0;
    return err->code == ERR_MEMORY ? ERR_MEMORY : 0;
}

int moved_solve(linear *l, const double *b, double *x, double tol, int *done, error *err)
{
    double start = clock_seconds(), reached = 0;
    int n;

    if (band_setup(&l->band, &l->a, &l->factored, err))
        return give_up(l, err);
    l->stats.factor_seconds += clock_seconds() - start;
    l->stats.band_factorisations += l->factored;
    if (!l->factored)
        return 0;
    start = clock_seconds();
    if (gmres_solve(&l->krylov, b, x, tol, l->max_iterations, &reached, &n, err))
        return give_up(l, err);
    l->stats.gmres_iterations += n;
    l->stats.solve_seconds += clock_seconds() - start;
    band_count(&l->band, n);
    *done = reached <= 1.01 * tol;
    return 0;
}
