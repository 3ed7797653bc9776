/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Linear systems.  A solver plugin sets something up, factors or a preconditioner, and flexible GMRES goes round
 * it.  What was set up for an earlier matrix is kept while the iterations that this takes more cost less than a new
 * one, by predicted operations, so that the choice is the same in every run. */
#include "solve/linear.h"
#include "solve/vector.h"

#include <string.h>

/* Iterations of a rough answer. */
enum { ROUGH = 6 };

/* What is left of a residual where any is small enough. */
#define SMALL 1e-7

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
    l->krylov = (gmres){.a = &l->a, .n_thread = l->n_thread, .apply = linear_precondition, .ctx = l, .r = l->r};
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

int linear_apply(linear *l, double *b, double *x, error *err)
{
    const int spent = l->spent;
    double reached;

    linear_prepare(l, b, approximates(l));
    if (!approximates(l))
        return linear_precondition(l, b, x, err);
    TRY(linear_iterate(l, b, x, 0.1, ROUGH, &reached, err));
    l->spent = spent;
    return 0;
}

int linear_solve(linear *l, double *b, double *x, double tol, error *err)
{
    int moved = l->band.placed && tol > 0 && band_pays(&l->band), done = 0, unfit;

    l->stats.solves++;
    l->fresh = l->fresh && l->kept;
    l->kept = 0;
    if (moved)
        linear_prepare(l, b, 0);
    if (moved)
        TRY(moved_solve(l, b, x, tol, &done, err));
    if (done)
        return 0;
    l->factored = l->factored && !l->band.placed;
    if (!l->analyzed) /* in a matrix for factors a value is held already */
        TRY(moved ? linear_analyze(l, METHOD_DIRECT, &unfit, err) : linear_predict(l, err));
    if (approximates(l))
        return linear_by_iteration(l, b, x, tol > 0 ? tol : SMALL, err);
    return linear_by_factors(l, b, x, tol, err);
}
