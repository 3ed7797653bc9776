/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The loop over batches, and adding element vectors and matrices to the global ones.  Slabs of
 * cells go to threads; cells that touch two slabs come last, on one thread.  No atomics: the
 * order of additions depends on nothing but the number of threads. */
#include "assemble/assemble.h"

#include <string.h>

static void scatter_vector(const assembly *a, const assembly_class *c, int64_t batch, int field, const workspace *w,
                           double *residual)
{
    const space *s = a->space;
    int n = c->n_basis[s->field[field].order];

    for (int64_t item = c->batch[batch]; item < c->batch[batch + 1]; item++)
        for (int i = 0, l = (int)(item - c->batch[batch]); i < n; i++) {
            int32_t carrier = space_carrier(s, c->group[item], assemble_item_local(c, s, field, i));

            for (int k = 0; carrier >= 0 && k < s->field[field].n_comp; k++)
                residual[s->first[field][carrier] + k] += w->vec[k * n + i][l];
        }
}

/* Free columns of a field on a group: position within the columns of their carrier, or -1. */
static void columns(const assembly_class *c, const space *s, const uint8_t *idle, int64_t group, int field, int n,
                    int *local, int (*relative)[3])
{
    for (int j = 0; j < n; j++) {
        int32_t carrier;

        local[j] = assemble_item_local(c, s, field, j);
        carrier = space_carrier(s, group, local[j]);
        for (int b = 0; b < s->field[field].n_comp; b++) {
            int32_t f = carrier < 0 ? -1 : s->free_of[s->first[field][carrier] + b];

            relative[j][b] = f < 0 || idle[s->first[field][carrier] + b] ? -1 : (int)(f - s->node_free[carrier]);
        }
    }
}

static void scatter_matrix(const assembly *a, const assembly_class *c, int64_t batch, int row_field, int col_field,
                           const workspace *w, double *value)
{
    const space *s = a->space;
    int n_row = c->n_basis[s->field[row_field].order];
    int n_col = c->n_basis[s->field[col_field].order], row_comp = s->field[row_field].n_comp;
    int col_comp = s->field[col_field].n_comp, pr = assemble_padded(n_row), pc = assemble_padded(n_col);

    for (int64_t item = c->batch[batch]; item < c->batch[batch + 1]; item++) {
        int l = (int)(item - c->batch[batch]), local[2 * FE_MAX_NODES], relative[2 * FE_MAX_NODES][3];
        int64_t group = c->group[item];
        int size = space_group_size(s, group);

        columns(c, s, a->idle, group, col_field, n_col, local, relative);
        for (int i = 0; i < n_row; i++) {
            int li = assemble_item_local(c, s, row_field, i);
            int32_t carrier = space_carrier(s, group, li), dof = carrier < 0 ? 0 : s->first[row_field][carrier];
            const int32_t *pair = space_pair(s, group) + li * size;

            for (int ra = 0; carrier >= 0 && ra < row_comp; ra++) {
                int32_t row = s->free_of[dof + ra];
                double *to;

                if (row < 0 || a->idle[dof + ra])
                    continue;
                to = value + s->row[row];
                for (int b = 0; b < col_comp; b++) {
                    const v8 *k = w->mat + (ra * col_comp + b) * pr * pc + i * pc;

                    for (int j = 0; j < n_col; j++)
                        if (relative[j][b] >= 0)
                            to[pair[local[j]] + relative[j][b]] += k[j][l];
                }
            }
        }
    }
}

/* Fields whose test functions the class uses. */
static int row_fields(const assembly_class *c, int *list)
{
    int n = 0;

    for (int t = 0; t < c->n_test; t++) {
        int seen = 0;

        for (int i = 0; i < n; i++)
            seen |= list[i] == c->test[t].field;
        if (!seen)
            list[n++] = c->test[t].field;
    }
    return n;
}

static int run_batch(const assembly *a, const assembly_class *c, const assembly_state *s, int64_t batch,
                     int diagnose, workspace *w, double *residual, double *value)
{
    int field[ASSEMBLE_MAX_TESTS], n = row_fields(c, field), on = !c->off;

    for (int64_t i = c->batch[batch]; i < c->batch[batch + 1]; i++)
        on |= c->off && !c->off[c->cell[i]];
    if (!on)
        return 0;

    geometry_points(a, c, batch, w);
    inputs_values(a, c, s, batch, w);
    if (evaluate_terms(a, c, s, batch, value != NULL, diagnose, w)) {
        w->failed_batch = batch;
        return 1;
    }
    for (int i = 0; i < n; i++) {
        element_vector(a, c, field[i], w);
        scatter_vector(a, c, batch, field[i], w, residual);
        for (int j = 0; value && j < a->space->n_field; j++)
            if (element_matrix(a, c, field[i], j, w))
                scatter_matrix(a, c, batch, field[i], j, w, value);
    }
    return 0;
}

static int report(const workspace *w, const assembly_class *c, error *err)
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
            if (s->col[k] == r)
                value[k] = 1;
    }
}

int assembly_run(assembly *a, const assembly_state *s, double *residual, double *value, int diagnose, error *err)
{
    TRY(items_take(a, s->bodies, err));
    memset(residual, 0, (size_t)a->space->n_dof * sizeof *residual);
    if (value)
        memset(value, 0, (size_t)a->space->row[a->space->n_free] * sizeof *value);
    if (s->power)
        power_clear(a);
    for (int k = 0; k < a->n_class; k++) {
        assembly_class *c = &a->class_[k];

        if (!evaluate_any(a, c, s))
            continue;
        TRY(inputs_functions(a, c, &a->work[0], s->t, err));
        TRY(history_update(a, c, &a->work[0], s->frame, err));
        for (int i = 0; i < a->n_thread; i++)
            a->work[i].failed_batch = -1;
#pragma omp parallel for num_threads(c->n_slab) schedule(static, 1)
        for (int slab = 0; slab < c->n_slab; slab++)
            for (int64_t b = c->slab[slab]; b < c->slab[slab + 1]; b++)
                if (run_batch(a, c, s, b, diagnose, &a->work[slab], residual, value))
                    break;
        for (int slab = 0; slab < c->n_slab; slab++)
            if (a->work[slab].failed_batch >= 0)
                return report(&a->work[slab], c, err);
        for (int64_t b = c->slab[c->n_slab]; b < c->n_batch; b++)
            if (run_batch(a, c, s, b, diagnose, &a->work[0], residual, value))
                return report(&a->work[0], c, err);
    }
    close_idle(a->space, a->idle, residual, value);
    if (s->power)
        power_sum(a, s->power);
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
    ARENA_NEW(&a->memory, a->use, (int64_t)n_spec * ASSEMBLE_MAX_USES + 1, err);
    a->idle = a->none_idle;
    for (a->n_class = 0; a->n_class < n_spec; a->n_class++)
        TRY(plan_create(a, &a->class_[a->n_class], &spec[a->n_class], err));
    for (int i = 0; i < a->n_thread; i++)
        TRY(plan_workspace(a, &a->work[i], err));
    return 0;
}

void assembly_destroy(assembly *a)
{
    for (int i = 0; a->work && i < a->n_thread; i++)
        arena_free(&a->work[i].memory);
    for (int i = 0; i < a->n_class; i++) {
        arena_free(&a->class_[i].item_memory);
        arena_free(&a->class_[i].frame_memory);
    }
    arena_free(&a->memory);
    memset(a, 0, sizeof *a);
}
