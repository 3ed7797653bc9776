/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What a run has for the function in results(...) of its case: columns of tables, means, norms of errors. */
#include "run/results.h"
#include "run/run.h"
#include "run/showing.h"

#include <stdio.h>
#include <string.h>

/* Every so many rows from the first: of n_time rows, those at the start before them are left out. */
static results_column column_of(const run *r, const table *t, int c, const char *name, long first_row, long every)
{
    long skip = t->n_row - every * (long)r->n_time;

    return (results_column){.name = name,
                            .first = t->row ? t->row + (skip + first_row) * t->n_column + c : NULL,
                            .stride = every * t->n_column,
                            .n = (long)r->n_time};
}

static int gather_columns(const run *r, arena *memory, results_input *in, error *err)
{
    const table *plain[] = {&r->forces, &r->probes, &r->values, &r->integrals}, *bodies = &r->particles;
    int n_body = r->p->bodies.n;

    in->t = (results_column){.first = r->time, .stride = 1, .n = (long)r->n_time};
    ARENA_NEW(memory, in->column,
              r->forces.n_column + r->probes.n_column + r->values.n_column + r->integrals.n_column +
                  n_body * bodies->n_column + 1,
              err);
    for (int k = 0; k < 4; k++)
        for (int c = 1; c < plain[k]->n_column; c++)
            in->column[in->n_column++] = column_of(r, plain[k], c, plain[k]->column[c], 0, 1);
    for (int id = 0; id < n_body; id++) /* p<id>.<name>, from the third column on: t, id, ... */
        for (int c = 2; c < bodies->n_column; c++) {
            size_t n = strlen(bodies->column[c]) + 16;
            char *name;

            ARENA_NEW(memory, name, n, err);
            snprintf(name, n, "p%d.%s", id, bodies->column[c]);
            in->column[in->n_column++] = column_of(r, bodies, c, name, id, n_body);
        }
    return 0;
}

/* over: the run is over, and means and norms can be had; before, only their names. */
static int gather(run *r, int over, arena *memory, results_input *in, error *err)
{
    const problem *p = r->p;
    const field_spec *shown;
    const int n_shown = showing_fields(r, &shown);

    *in = (results_input){.dt = p->description.time.step};
    TRY(gather_columns(r, memory, in, err));
    ARENA_NEW(memory, in->mean, p->space.n_field + n_shown + 1, err);
    ARENA_NEW(memory, in->norm, p->space.n_field + 1, err);
    for (int f = 0; f < p->space.n_field; f++) {
        results_mean *mean = &in->mean[in->n_mean];

        if (p->space.field[f].support == PF_ON_MESH) {
            *mean = (results_mean){.name = p->space.field[f].name, .n_comp = p->space.field[f].n_comp};
            if (over)
                TRY(norms_mean(r, f, mean->mean, err));
            in->n_mean++;
        }
        if (!over && p->description.has_exact[f])
            in->norm[in->n_norm++].name = p->space.field[f].name;
    }
    if (over && n_shown)
        TRY(showing_take(r, err));
    for (int f = 0; f < n_shown; f++) {
        results_mean *mean = &in->mean[in->n_mean++];

        *mean = (results_mean){.name = shown[f].name, .n_comp = shown[f].n_comp};
        memcpy(mean->mean, showing_mean(r, f), (size_t)shown[f].n_comp * sizeof *mean->mean);
    }
    for (int i = 0; over && i < r->result->n_error; i++)
        in->norm[in->n_norm++] = (results_norm){r->result->error_norm[i].name, r->result->error_norm[i].l2,
                                                r->result->error_norm[i].h1, r->result->error_norm[i].l2_exact};
    return 0;
}

static int with_results(run *r, int over, error *err)
{
    arena memory = {0};
    results_input in;
    int status;

    if (!case_find(r->p->description.c, "results", 0))
        return 0;
    status = gather(r, over, &memory, &in, err);
    if (!status)
        status = over ? results_call(r->p->description.c, &in, &r->results, err)
                      : results_check(r->p->description.c, &in, err);
    arena_free(&memory);
    return status;
}

int results_expect(run *r, error *err)
{
    return with_results(r, 0, err);
}

int results_evaluate(run *r, error *err)
{
    return with_results(r, 1, err);
}
