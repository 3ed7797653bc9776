/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Memory of terms (space/kept.h) at the points of a batch: at the end of the last step, near moving bodies along
 * the paths that follow them (see moving_frame). */
#include "assemble/batch.h"

#include <omp.h>
#include <string.h>

int kept_place(assembly *a, assembly_class *c, error *err)
{
    const kept_fields *k = &a->space->kept;
    const int part = c->follows && (c->where == PF_FLUID || c->where == PF_SOLID);

    if (!part) /* the points of whole cells are those of the memory; others are found one by one */
        return 0;
    ARENA_NEW(&a->memory, c->kept_weight, c->n_q * k->rule.n, err);
    for (int q = 0; q < c->n_q; q++)
        kept_weights(k, c->rule[0].x[q], c->kept_weight + q * k->rule.n);
    return 0;
}

/* Whether the points of a class are those that memory has values at. */
static int at_own_points(const assembly_class *c)
{
    return c->where == PF_CELL || (c->where == PF_FLUID && !c->follows);
}

/* Point q of an item, in its cell. */
static const double *place(const assembly_class *c, int64_t item, int q)
{
    if (c->where == PF_SURFACE)
        return c->ref[(int64_t)c->source[item] * c->n_q + q];
    return c->rule[c->where == PF_FACET ? c->facet[item] : 0].x[q];
}

/* The body that an item is a part of, or -1: it is fluid. */
static int body_of(const assembly *a, const assembly_class *c, int64_t item)
{
    return c->where == PF_SOLID ? a->space->attached_particle[a->bodies->solid[c->source[item]]] : -1;
}

/* At point x of an item's cell, along the path through it; 0: beside it, as x is no part of the item. */
static int along(const assembly *a, const assembly_class *c, const assembly_state *s, int f, int64_t item,
                 const double *xi, const double *x, double *v)
{
    const int32_t cell = c->cell[item];
    located then;
    int how = s->frame ? s->frame->before(s->frame->ctx, cell, x, body_of(a, c, item), &then) : 0;

    if (how)
        kept_value(&a->space->kept, f, s->kept, then.cell, then.xi, v);
    else
        kept_value(&a->space->kept, f, s->kept, cell, xi, v);
    return how != BEFORE_BESIDE;
}

void kept_along_cell(const assembly *a, const assembly_class *c, const assembly_state *s, int f, int64_t item,
                     double *at)
{
    const kept_fields *k = &a->space->kept;
    const int32_t cell = c->cell[item];

    if (!s->frame) {
        memcpy(at, s->kept + kept_at(k, f, cell), (size_t)(k->field[f].n_comp * k->rule.n) * sizeof *at);
        return;
    }
    for (int p = 0; p < k->rule.n; p++) {
        double x[3] = {0}, j[3][3], v[VALUE_MAX];

        mesh_place(k->mesh, cell, k->rule.x[p], x, j);
        along(a, c, s, f, item, k->rule.x[p], x, v);
        for (int i = 0; i < k->field[f].n_comp; i++)
            at[i * k->rule.n + p] = v[i];
    }
}

void kept_nearest(const assembly *a, const assembly_class *c, int64_t item, const uint8_t *counts, int n_comp,
                  const double *v, double *at)
{
    const int nq = c->n_q;
    const double *weight = c->weight + (int64_t)c->source[item] * nq;
    double w[FE_MAX_POINTS], most = 0;

    for (int q = 0; q < nq; q++)
        most = weight[q] > most ? weight[q] : most;
    for (int q = 0; q < nq;
         q++) /* squares: points outside of the part that counts have small weights of either sign */
        w[q] = weight[q] > 0 && (!counts || counts[q]) ? weight[q] * weight[q] / most : 0;
    kept_fit(&a->space->kept, nq, c->kept_weight, w, n_comp, v, at);
}

/* One input at the points of an item, v[n_comp][n_q], along the paths.  Of a part of a cell: the polynomial nearest
 * to the values there, so that it is smooth in all of the cell. */
static void take_item(const assembly *a, const assembly_class *c, const assembly_state *s, const plan_input *in,
                      int64_t item, int lane, const workspace *w, double *v)
{
    const kept_fields *k = &a->space->kept;
    const int nq = c->n_q, dim = a->space->mesh->dim, np = k->rule.n;
    double at[VALUE_MAX * KEPT_MAX_POINTS], one[VALUE_MAX];
    uint8_t counts[FE_MAX_POINTS];

    for (int q = 0; q < nq; q++) {
        double x[3] = {0};

        for (int d = 0; d < dim; d++)
            x[d] = w->x[d * nq + q][lane];
        counts[q] = (uint8_t)along(a, c, s, in->kept, item, place(c, item, q), x, one);
        for (int i = 0; i < in->n_comp; i++)
            v[i * nq + q] = one[i];
    }
    if (!c->kept_weight)
        return;
    kept_along_cell(a, c, s, in->kept, item, at);
    kept_nearest(a, c, item, counts, in->n_comp, v, at);
    for (int q = 0; q < nq; q++)
        for (int i = 0; i < in->n_comp; i++) {
            v[i * nq + q] = 0;
            for (int p = 0; p < np; p++)
                v[i * nq + q] += c->kept_weight[q * np + p] * at[i * np + p];
        }
}

static void take_batch(const assembly *a, const assembly_class *c, const assembly_state *s, int64_t b, workspace *w)
{
    v8 *to = c->kept + c->kept_at[b];
    const int nq = c->n_q;

    geometry_points(a, c, b, w);
    for (int i = 0; i < c->n_input; i++) {
        const plan_input *in = &c->input[i];

        if (in->kept < 0)
            continue;
        for (int64_t item = c->batch[b]; item < c->batch[b + 1]; item++) {
            take_item(a, c, s, in, item, (int)(item - c->batch[b]), w, w->kept);
            for (int k = 0; k < in->n_comp * nq; k++)
                to[k][item - c->batch[b]] = w->kept[k];
        }
        to += in->n_comp * nq;
    }
}

int kept_update(const assembly *a, assembly_class *c, const assembly_state *s, error *err)
{
    const moving_frame *f = s->frame;
    int64_t n = 0, n_comp = 0;

    if (!f || !f->before || !s->kept || !c->any_kept || c->where == PF_CELL || c->where == PF_FACET ||
        c->where == PF_PARTICLE || c->where == PF_PAIR || c->kept_stamp == f->stamp)
        return 0;
    for (int i = 0; i < c->n_input; i++)
        n_comp += c->input[i].kept >= 0 ? c->input[i].n_comp : 0;
    arena_free(&c->kept_memory);
    c->kept_stamp = 0;
    ARENA_NEW(&c->kept_memory, c->kept_at, c->n_batch + 1, err);
    for (int64_t b = 0; b < c->n_batch; b++) {
        int near = 0;

        for (int64_t i = c->batch[b]; i < c->batch[b + 1]; i++)
            near |= f->cell[c->cell[i]] && !(c->off && c->off[c->cell[i]]);
        c->kept_at[b] = near ? n * n_comp * c->n_q : -1;
        n += near;
    }
    ARENA_NEW(&c->kept_memory, c->kept, n * n_comp * c->n_q + 1, err);
#pragma omp parallel for num_threads(f->one_thread ? 1 : a->n_thread) schedule(dynamic, 4)
    for (int64_t b = 0; b < c->n_batch; b++)
        if (c->kept_at[b] >= 0)
            take_batch(a, c, s, b, &a->work[omp_get_thread_num()]);
    c->kept_stamp = f->stamp;
    return 0;
}

/* Where the values of a batch along the paths are, of this input; NULL: all rest. */
static const v8 *along_paths(const assembly_class *c, const assembly_state *s, int64_t batch, const plan_input *in)
{
    const v8 *at;

    if (!s->frame || !s->frame->before || c->kept_stamp != s->frame->stamp || c->kept_at[batch] < 0)
        return NULL;
    at = c->kept + c->kept_at[batch];
    for (int i = 0; &c->input[i] != in; i++)
        at += c->input[i].kept >= 0 ? c->input[i].n_comp * c->n_q : 0;
    return at;
}

void kept_values(const assembly *a, const assembly_class *c, const assembly_state *s, int64_t batch,
                 const plan_input *in, const workspace *w, v8 *out)
{
    const kept_fields *k = &a->space->kept;
    const int nq = c->n_q, np = k->rule.n, of_body = k->field[in->kept].support == PF_KEPT_BY_PARTICLE;
    const v8 *table = along_paths(c, s, batch, in);

    if (table || !s->kept) {
        if (table)
            memcpy(out, table, (size_t)(in->n_comp * nq) * sizeof *out);
        else
            memset(out, 0, (size_t)(in->n_comp * nq) * sizeof *out);
        return;
    }
    for (int l = 0; l < 8; l++)
        for (int q = 0; q < nq; q++) {
            const int64_t item = assemble_item(c, batch, l);
            const double *v = s->kept + kept_at(k, in->kept, of_body ? w->id[q * 8 + l] : c->cell[item]);
            double one[VALUE_MAX];

            if (!of_body && !at_own_points(c) && !c->kept_weight)
                kept_value(k, in->kept, s->kept, c->cell[item], place(c, item, q), one);
            for (int i = 0; i < in->n_comp; i++) {
                double sum = of_body ? v[i] : at_own_points(c) ? v[i * np + q] : c->kept_weight ? 0 : one[i];

                for (int p = 0; !of_body && c->kept_weight && p < np; p++)
                    sum += c->kept_weight[q * np + p] * v[i * np + p];
                out[i * nq + q][l] = sum;
            }
        }
}
