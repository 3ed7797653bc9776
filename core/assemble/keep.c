/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What terms keep at the end of a step (space/kept.h): their PF_STATE outputs, evaluated once, with its solution.
 * At the points of whole cells these are the memory itself; of a part of a cell, the polynomial nearest to them is.
 */
#include "assemble/batch.h"

#include <omp.h>
#include <string.h>

/* Outside of where a term acts memory stays what it was. */
static void leave_outside(const assembly_class *c, const plan_use *p, const workspace *w, uint32_t o, size_t n_comp,
                          double *out)
{
    const size_t ld = (size_t)c->n_q * PF_LANES;
    const double *before = (const double *)(w->in + c->input[p->kept[o]].at * (size_t)c->n_q);

    for (size_t i = 0; w->masked && i < n_comp * ld; i++)
        out[i] = w->mask[i % ld] ? out[i] : before[i];
}

/* One output at the points of a batch into the memory. */
static void store(const assembly *a, const assembly_class *c, const assembly_state *s, int64_t batch, int f,
                  const v8 *out, const workspace *w, double *kept)
{
    const kept_fields *k = &a->space->kept;
    const int nq = c->n_q, n_comp = k->field[f].n_comp, of_body = k->field[f].support == PF_KEPT_BY_PARTICLE;

    for (int64_t item = c->batch[batch]; item < c->batch[batch + 1]; item++) {
        const int l = (int)(item - c->batch[batch]);
        double *v = c->kept_weight ? w->kept : kept + kept_at(k, f, of_body ? w->id[l] : c->cell[item]);
        double at[VALUE_MAX * KEPT_MAX_POINTS];

        if (c->off && c->off[c->cell[item]])
            continue;
        for (int i = 0; i < n_comp * nq; i++)
            v[i] = out[i][l];
        if (!c->kept_weight)
            continue;
        kept_along_cell(a, c, s, f, item, at);
        kept_nearest(a, c, item, NULL, n_comp, v, at);
        memcpy(kept + kept_at(k, f, c->cell[item]), at, (size_t)(n_comp * k->rule.n) * sizeof *at);
    }
}

static int keep_term(const assembly *a, const assembly_class *c, const assembly_state *s, int64_t batch,
                     const plan_use *p, pf_batch *b, workspace *w, double *kept)
{
    const pf_term *t = p->use->term;
    const double *in[TERM_MAX_SLOTS];
    double *out[TERM_MAX_SLOTS];
    int status = evaluate_term(c, p, batch, b, in, out, w);

    if (!status && s->watch)
        s->watch->look(s->watch->ctx, p->use, b, in);
    if (!status && evaluate_find_nan(t, b, out, &w->report))
        status = PF_FAIL;
    for (uint32_t o = 0; o < t->n_out && !status; o++)
        if (p->kept[o] >= 0) {
            int f = c->input[p->kept[o]].kept;

            leave_outside(c, p, w, o, (size_t)a->space->kept.field[f].n_comp, out[o]);
            store(a, c, s, batch, f, (const v8 *)out[o], w, kept);
        }
    return evaluate_end(status, w);
}

static int keeps(const plan_use *p)
{
    int any = 0;

    for (uint32_t o = 0; o < p->use->term->n_out; o++)
        any |= p->kept[o] >= 0;
    return any;
}

static int keep_batch(const assembly *a, const assembly_class *c, const assembly_state *s, int64_t batch,
                      workspace *w, double *kept)
{
    pf_batch b = evaluate_batch(c, s, a->space->mesh->dim, w);
    int on = !c->off;

    for (int64_t i = c->batch[batch]; i < c->batch[batch + 1]; i++)
        on |= c->off && !c->off[c->cell[i]];
    if (!on)
        return 0;
    geometry_points(a, c, batch, w);
    body_data_take(a, c, s, batch, w);
    inputs_values(a, c, s, batch, w);
    TRY(properties_evaluate(c, s, batch, 0, 1, &b, w));
    for (int u = 0; u < c->n_use; u++)
        if (keeps(&c->use[u]) && mask_take(a, c, &c->use[u], w))
            TRY(keep_term(a, c, s, batch, &c->use[u], &b, w, kept));
    return 0;
}

static int keep_class(assembly *a, assembly_class *c, const assembly_state *s, double *kept, error *err)
{
    const int lua = c->follows && s->frame && s->frame->one_thread;
    const int n = lua || c->where == PF_SOLID ? 1 : a->n_thread; /* two bodies may have one cell */

    TRY(inputs_functions(a, c, &a->work[0], s->t, err));
    TRY(walls_update(a, c, err));
    TRY(history_update(a, c, s->frame, err));
    TRY(kept_update(a, c, s, err));
    for (int k = 0; k < a->n_thread; k++)
        a->work[k].failed_batch = -1;
#pragma omp parallel for num_threads(n) schedule(static)
    for (int64_t b = 0; b < c->n_batch; b++) {
        workspace *w = &a->work[omp_get_thread_num()];

        if (w->failed_batch < 0 && keep_batch(a, c, s, b, w, kept))
            w->failed_batch = b;
    }
    for (int k = 0; k < a->n_thread; k++)
        if (a->work[k].failed_batch >= 0)
            return report_failure(&a->work[k], c, err);
    return 0;
}

int assembly_keep(assembly *a, const assembly_state *s, double *kept, error *err)
{
    TRY(items_take(a, s->bodies, err));
    for (int k = 0; k < a->n_class; k++) {
        int any = 0;

        for (int u = 0; u < a->class_[k].n_use; u++)
            any |= keeps(&a->class_[k].use[u]);
        if (any)
            TRY(keep_class(a, &a->class_[k], s, kept, err));
    }
    return 0;
}
