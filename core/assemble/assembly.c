/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The loop over batches.  Slabs of cells go to threads; what is between slabs comes later (slabs.c).  No atomics:
 * the order of additions depends on nothing but the number of threads. */
#include "assemble/batch.h"

#include <string.h>

static int run_batch(const assembly *a, const assembly_class *c, const assembly_state *s, int64_t batch, int slab,
                     int diagnose, workspace *w, double *residual, double *value)
{
    int on = !c->off;

    if (value && a->clears && c == &a->class_[0])
        fresh_clear(a, c, batch, value);
    for (int64_t i = c->batch[batch]; i < c->batch[batch + 1]; i++)
        on |= c->off && !c->off[c->cell[i]];
    if (!on)
        return 0;

    geometry_points(a, c, batch, w);
    body_data_take(a, c, s, batch, w);
    inputs_values(a, c, s, batch, w);
    if (evaluate_terms(a, c, s, batch, value != NULL, diagnose, w)) {
        w->failed_batch = batch;
        return 1;
    }
    if (s->shown) {
        w->failed_batch = show_batch(a, c, s, batch, w) ? batch : -1;
        return w->failed_batch >= 0;
    }
    memset(w->vec, 0, (size_t)c->layout.n * sizeof *w->vec);
    for (int f = 0; f < a->space->n_field; f++) {
        element_vector(a, c, f, w);
        if (value && c->layout.coupled[f])
            element_matrix(a, c, f, w);
    }
    scatter_vector(a, c, batch, slab, w, residual);
    if (value)
        scatter_matrix(a, c, batch, slab, w, value);
    return 0;
}

int report_failure(const workspace *w, const assembly_class *c, error *err)
{
    int code = error_set(err, w->report.status > 0 ? ERR_CONVERGE : ERR_PLUGIN, "%s (cells from %d)",
                         w->report.text, c->cell[c->batch[w->failed_batch]]);

    err->retry = w->report.status > 0;
    return code;
}

/* Unknowns that are off now: their equation is x = 0. */
static void close_idle(const space *s, const uint8_t *idle, double *residual, double *value)
{
    for (int64_t d = 0; d < s->n_dof; d++) {
        int32_t r = s->free_of[d];

        if (!idle[d])
            continue;
        residual[d] = 0;
        for (int64_t k = r >= 0 && value ? s->row[r] : 0; k < (r >= 0 && value ? s->row[r + 1] : 0); k++)
            if (space_column(s, r, k) == r)
                value[k] = 1;
    }
}

/* Rows and columns of the matrix of this state. */
static void number_columns(assembly *a)
{
    const space *s = a->space;

    for (int64_t d = 0; d < s->n_dof; d++) {
        int32_t r = a->idle[d] ? -1 : s->free_of[d];

        a->row_of[d] = r;
        a->column_of[d] = r < 0 ? -1 : (int32_t)(r - s->node_free[s->dof_node[d]]);
    }
}

/* Slabs from `first` on, n of them at once. */
static int run_slabs(assembly *a, const assembly_class *c, const assembly_state *s, int first, int n,
                     double *residual, double *value, int diagnose, error *err)
{
    if (c->slab[first] == c->slab[first + n])
        return 0;
    for (int k = 0; k < n; k++)
        a->work[k].failed_batch = -1;
#pragma omp parallel for num_threads(n) schedule(static, 1)
    for (int k = 0; k < n; k++)
        for (int64_t b = c->slab[first + k]; b < c->slab[first + k + 1]; b++)
            if (run_batch(a, c, s, b, first + k, diagnose, &a->work[k], residual, value))
                break;
    for (int k = 0; k < n; k++)
        if (a->work[k].failed_batch >= 0)
            return report_failure(&a->work[k], c, err);
    return 0;
}

static int run_class(assembly *a, assembly_class *c, const assembly_state *s, double *residual, double *value,
                     int diagnose, error *err)
{
    TRY(inputs_functions(a, c, &a->work[0], s->t, err));
    TRY(walls_update(a, c, err));
    TRY(history_update(a, c, s->frame, err));
    TRY(kept_update(a, c, s, err));
    TRY(shares_clear(a, c, value != NULL, err));
    for (int round = 0; round < SLAB_ROUNDS; round++)
        TRY(run_slabs(a, c, s, round * c->n_slab, c->n_slab, residual, value, diagnose, err));
    if (residual)
        shares_add(a, c, residual, value);
    return run_slabs(a, c, s, SLAB_ROUNDS * c->n_slab, 1, residual, value, diagnose, err);
}

int assembly_run(assembly *a, const assembly_state *s, double *residual, double *value, int diagnose, error *err)
{
    TRY(items_take(a, s->bodies, err));
    memset(residual, 0, (size_t)a->space->n_dof * sizeof *residual);
    if (value) {
        a->clears = fresh_begin(a, s, value);
        number_columns(a);
    }
    if (s->power)
        power_clear(a);
    for (int k = 0; k < a->n_class; k++)
        if (evaluate_any(a, &a->class_[k], s))
            TRY(run_class(a, &a->class_[k], s, residual, value, diagnose, err));
    close_idle(a->space, a->idle, residual, value);
    if (s->power)
        power_sum(a, s->power);
    return 0;
}

int assembly_show(assembly *a, const assembly_state *s, error *err)
{
    TRY(items_take(a, s->bodies, err));
    TRY(show_begin(a, s->shown, err));
    for (int k = 0; k < a->n_class; k++)
        if (run_class(a, &a->class_[k], s, NULL, NULL, 0, err)) {
            err->retry = 0; /* the step is over */
            return err->code;
        }
    return 0;
}

int assembly_create(assembly *a, const space *s, const assembly_spec *spec, int n_spec, int n_thread, error *err)
{
    memset(a, 0, sizeof *a);
    a->space = s;
    a->n_thread = n_thread < 1 ? 1 : n_thread;
    ARENA_NEW(&a->memory, a->class_, n_spec > 0 ? n_spec : 1, err);
    ARENA_NEW(&a->memory, a->work, a->n_thread, err);
    ARENA_NEW(&a->memory, a->none_idle, s->n_dof + 1, err);
    ARENA_NEW(&a->memory, a->row_of, s->n_dof + 1, err);
    ARENA_NEW(&a->memory, a->column_of, s->n_dof + 1, err);
    ARENA_NEW(&a->memory, a->use, (int64_t)n_spec * ASSEMBLE_MAX_USES + 1, err);
    a->idle = a->none_idle;
    for (a->n_class = 0; a->n_class < n_spec; a->n_class++)
        TRY(plan_create(a, &a->class_[a->n_class], &spec[a->n_class], err));
    for (int i = 0; i < a->n_thread; i++)
        TRY(workspace_create(a, &a->work[i], err));
    return 0;
}

void assembly_destroy(assembly *a)
{
    for (int i = 0; a->work && i < a->n_thread; i++)
        arena_free(&a->work[i].memory);
    for (int i = 0; i < a->n_class; i++) {
        arena_free(&a->class_[i].item_memory);
        arena_free(&a->class_[i].frame_memory);
        arena_free(&a->class_[i].kept_memory);
        arena_free(&a->class_[i].wall_memory);
    }
    arena_free(&a->share_memory);
    arena_free(&a->memory);
    memset(a, 0, sizeof *a);
}
