/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * du/dt along paths that follow moving bodies (see moving_frame). */
#include "assemble/batch.h"

#include <omp.h>
#include <string.h>

static int frame_components(const space *s, const moving_frame *f)
{
    int n = s->mesh->dim;

    for (int k = 0; k < s->n_field; k++)
        n += f->fields >> k & 1 ? s->field[k].n_comp : 0;
    return n;
}

/* w = 0 and the usual history at a point. */
static void stay(const assembly *a, const assembly_class *c, const moving_frame *f, int64_t item, int q, double *v)
{
    const space *s = a->space;
    const int32_t *node = s->mesh->cell + (int64_t)c->cell[item] * s->mesh->type->n_node;
    int at = s->mesh->dim;

    memset(v, 0, (size_t)frame_components(s, f) * sizeof *v);
    for (int k = 0; k < s->n_field; k++) {
        int order = s->field[k].order, n_comp = f->fields >> k & 1 ? s->field[k].n_comp : 0;

        for (int i = 0; n_comp && i < c->n_basis[order]; i++) {
            const double *u = f->u + s->first[k][node[assemble_local(s, k, i)]];

            for (int j = 0; j < n_comp; j++)
                v[at + j] += u[j] * c->n_ref[0][order][q * c->n_basis[order] + i];
        }
        at += n_comp;
    }
}

/* Velocity of the path and history at the points of a batch. */
static void take_batch(const assembly *a, const assembly_class *c, workspace *w, const moving_frame *f, int64_t b,
                       int n_comp)
{
    int dim = a->space->mesh->dim, nq = c->n_q;
    v8 *to = c->frame + c->frame_at[b];

    geometry_points(a, c, b, w);
    for (int64_t item = c->batch[b]; item < c->batch[b + 1]; item++)
        for (int q = 0, l = (int)(item - c->batch[b]); q < nq; q++) {
            double x[3] = {0}, v[3 + VALUE_MAX * SPACE_MAX_FIELDS];

            for (int k = 0; k < dim; k++)
                x[k] = w->x[k * nq + q][l];
            if (!f->at(f->ctx, c->cell[item], x, v, v + dim))
                stay(a, c, f, item, q, v);
            for (int k = 0; k < n_comp; k++)
                to[k * nq + q][l] = v[k];
        }
}

int history_update(const assembly *a, assembly_class *c, const moving_frame *f, error *err)
{
    const space *s = a->space;
    int nq = c->n_q, n_comp;
    int64_t n = 0;

    if (!f || !f->fields || c->where != PF_FLUID || c->frame_stamp == f->stamp)
        return 0;
    n_comp = frame_components(s, f);
    arena_free(&c->frame_memory);
    c->frame_stamp = 0;
    ARENA_NEW(&c->frame_memory, c->frame_at, c->n_batch + 1, err);
    for (int64_t b = 0; b < c->n_batch; b++) {
        int near = 0;

        for (int64_t i = c->batch[b]; i < c->batch[b + 1]; i++)
            near |= f->cell[c->cell[i]] && !(c->off && c->off[c->cell[i]]);
        c->frame_at[b] = near ? n * n_comp * nq : -1;
        n += near;
    }
    ARENA_NEW(&c->frame_memory, c->frame, n * n_comp * nq + 1, err);
#pragma omp parallel for num_threads(f->one_thread ? 1 : a->n_thread) schedule(dynamic, 4)
    for (int64_t b = 0; b < c->n_batch; b++)
        if (c->frame_at[b] >= 0)
            take_batch(a, c, &a->work[omp_get_thread_num()], f, b, n_comp);
    c->frame_stamp = f->stamp;
    return 0;
}

void history_take(const assembly *a, const assembly_class *c, const assembly_state *s, const plan_input *in,
                  workspace *w)
{
    const field_spec *field = &a->space->field[in->field];
    int dim = a->space->mesh->dim, nq = c->n_q, at = dim;
    v8 *dot = w->in + in->at * (size_t)nq, *value = w->rate, *grad = w->rate + in->n_comp * nq;

    for (int k = 0; k < in->field; k++)
        at += s->frame->fields >> k & 1 ? a->space->field[k].n_comp : 0;
    interpolate(c, field, dim, PF_VALUE, w, value);
    interpolate(c, field, dim, PF_GRAD, w, grad);
    for (int k = 0; k < in->n_comp; k++)
        for (int q = 0; q < nq; q++) {
            v8 rate = w->frame[(at + k) * nq + q] + s->shift * value[k * nq + q];

            for (int d = 0; d < dim; d++)
                rate -= w->frame[d * nq + q] * grad[(k * dim + d) * nq + q];
            dot[k * nq + q] = rate;
        }
}

void history_jacobian(const pf_slot *out, const pf_slot *in, int n_trial, double factor, const double *jac, int dim,
                      size_t ld, const double *velocity, double *block, uint8_t *filled)
{
    int oc = out->eval == PF_DIV ? dim : term_components(out->shape, dim), ic = term_components(in->shape, dim);

    for (int a = 0; a < oc; a++)
        for (int b = 0; b < ic; b++)
            for (int k = 0; k < dim; k++) {
                int row = out->eval == PF_DIV ? a * dim + a : a;
                const double *restrict from = jac + (size_t)((out->eval == PF_DIV ? 0 : a) * ic + b) * ld;
                const double *restrict w = velocity + (size_t)k * ld;
                double *restrict to = block + (size_t)(row * n_trial + b * dim + k) * ld;
                uint8_t *seen = &filled[row * n_trial + b * dim + k];

                for (size_t i = 0; i < ld; i++)
                    to[i] = (*seen ? to[i] : 0) - factor * w[i] * from[i];
                *seen = 1;
            }
}
