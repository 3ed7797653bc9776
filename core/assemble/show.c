/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What shown terms give at the points of a batch, integrated: over each item, and against the functions of the
 * vertices for a projection,
 *
 *     sum = int q,     load_i = int q phi_i,     mass_ij = int phi_i phi_j. */
#include "assemble/batch.h"

#include "base/text.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static int pairs_of(const assembly *a)
{
    const int n = a->space->mesh->type->n_vertex;

    return n * (n + 1) / 2;
}

int show_begin(const assembly *a, assembly_shown *to, error *err)
{
    arena_free(&to->memory);
    memset(to->load, 0, (size_t)to->to->n_dof * sizeof *to->load);
    for (int k = 0; k < a->n_class; k++) {
        const assembly_class *c = &a->class_[k];
        shown_class *s = &to->class_[k];

        ARENA_NEW(&to->memory, s->item, c->n_item + 1, err);
        ARENA_NEW(&to->memory, s->sum, c->n_item * s->width + 1, err);
        ARENA_NEW(&to->memory, s->measure, c->n_item + 1, err);
        if (s->projects)
            ARENA_NEW(&to->memory, s->mass, c->n_item * pairs_of(a) + 1, err);
        for (int64_t i = 0; i < c->n_item; i++)
            s->item[c->source[i]] = i;
    }
    return 0;
}

/* A point without weight is none: fluid outside of a cut cell, what fills up a piece of surface. */
static v8 integrate(const workspace *w, int nq, const v8 *restrict q, const double *restrict phi, int stride)
{
    v8 sum = {0};

    for (int p = 0; p < nq; p++) {
        v8 add = w->w[p] * q[p] * (phi ? phi[p * stride] : 1);

        for (int l = 0; l < 8; l++)
            sum[l] += w->w[p][l] == 0 ? 0 : add[l];
    }
    return sum;
}

static int is_finite(v8 v)
{
    int finite = 1;

    for (int l = 0; l < 8; l++)
        finite &= isfinite(v[l]) != 0;
    return finite;
}

/* Says which term gave what is not finite, and where. */
static int tell(const assembly *a, const assembly_class *c, const assembly_state *s, int test, workspace *w)
{
    const v8 *value = w->test + c->test[test].at * (size_t)c->n_q;
    const int dim = a->space->mesh->dim, nq = c->n_q;

    for (int u = 0; u < c->n_use; u++)
        for (uint32_t o = 0; o < c->use[u].use->term->n_out; o++)
            for (int i = 0; c->use[u].out[o] == test && i < c->test[test].n_comp * nq * 8; i++) {
                const int q = i / 8 % nq, l = i % 8;
                double x[3] = {0};

                if (w->w[q][l] == 0 || isfinite(value[i / 8][l]))
                    continue;
                for (int k = 0; k < dim; k++)
                    x[k] = w->x[k * nq + q][l];
                w->report = (term_report){
                    .plugin = c->use[u].use->plugin->d.name, .term = c->use[u].use->term->name, .status = PF_FAIL};
                snprintf(w->report.text, sizeof w->report.text,
                         "term %s.%s: output \"%s\" is %g at x = %s, t = %.6g", w->report.plugin, w->report.term,
                         c->use[u].use->term->out[o].name, value[i / 8][l], text_point(x, dim).s, s->t);
                return 1;
            }
    w->report.status = PF_FAIL;
    snprintf(w->report.text, sizeof w->report.text, "an integral of what is shown overflows at t = %.6g", s->t);
    return 1;
}

/* Adds the part of the vertex functions that the items of the batch have to load. */
static int add_load(const assembly *a, const assembly_class *c, int64_t batch, int test, const shown_class *to,
                    const assembly_shown *shown, const workspace *w)
{
    const fe_cell *type = a->space->mesh->type;
    const int32_t *first = shown->to->first[to->field[test]];
    const int nv = type->n_vertex;
    int finite = 1;

    for (int k = 0; k < c->test[test].n_comp; k++)
        for (int i = 0; i < nv; i++) {
            v8 part = integrate(w, c->n_q, w->test + (c->test[test].at + (size_t)k) * (size_t)c->n_q,
                                c->n_ref[0][1] + i, nv);

            finite &= is_finite(part);
            for (int64_t item = c->batch[batch]; item < c->batch[batch + 1]; item++) {
                const int32_t *cell = a->space->mesh->cell + (int64_t)c->cell[item] * type->n_node;

                shown->load[first[cell[type->vertex[i]]] + k] += part[item - c->batch[batch]];
            }
        }
    return finite;
}

static void take_mass(const assembly *a, const assembly_class *c, int64_t batch, const shown_class *to,
                      const workspace *w)
{
    const int nv = a->space->mesh->type->n_vertex, n = pairs_of(a);
    const double *phi = c->n_ref[0][1];

    for (int i = 0, at = 0; i < nv; i++)
        for (int j = i; j < nv; j++, at++) {
            v8 sum = {0};

            for (int q = 0; q < c->n_q; q++)
                sum += w->w[q] * phi[q * nv + i] * phi[q * nv + j];
            for (int64_t item = c->batch[batch]; item < c->batch[batch + 1]; item++)
                to->mass[c->source[item] * n + at] = sum[item - c->batch[batch]];
        }
}

int show_batch(const assembly *a, const assembly_class *c, const assembly_state *s, int64_t batch, workspace *w)
{
    const shown_class *to = &s->shown->class_[c - a->class_];
    v8 measure = {0};

    for (int q = 0; q < c->n_q; q++)
        measure += w->w[q];
    for (int64_t item = c->batch[batch]; item < c->batch[batch + 1]; item++)
        to->measure[c->source[item]] = measure[item - c->batch[batch]];
    for (int t = 0; t < c->n_test; t++) {
        if (to->field[t] >= 0 && !add_load(a, c, batch, t, to, s->shown, w))
            return tell(a, c, s, t, w);
        for (int k = 0; to->field[t] < 0 && k < c->test[t].n_comp; k++) {
            v8 sum = integrate(w, c->n_q, w->test + (c->test[t].at + (size_t)k) * (size_t)c->n_q, NULL, 0);

            if (!is_finite(sum))
                return tell(a, c, s, t, w);
            for (int64_t item = c->batch[batch]; item < c->batch[batch + 1]; item++)
                to->sum[c->source[item] * to->width + to->at[t] + k] = sum[item - c->batch[batch]];
        }
    }
    if (to->projects)
        take_mass(a, c, batch, to, w);
    return 0;
}
