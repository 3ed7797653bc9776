/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What terms read at the points of a batch: fields, interpolated from nodal values, and the case's own functions.
 */
#include "assemble/batch.h"

/* Nodal values of a field on the items of a batch, dof[comp][i]; zero where there is no carrier (a wall). */
static void gather(const assembly *a, const assembly_class *c, int64_t batch, int field, const double *x, v8 *dof)
{
    const field_spec *f = &a->space->field[field];
    const int *at = c->layout.at[field];
    int n = c->n_basis[f->order];

    for (int l = 0; l < 8; l++) {
        const int32_t *restrict of = c->dof + assemble_item(c, batch, l) * c->layout.n;

        for (int k = 0; k < f->n_comp; k++)
            for (int i = 0; i < n; i++) {
                int32_t d = of[at[i] + k];

                dof[k * n + i][l] = d < 0 ? 0 : x[d];
            }
    }
}

/* A key of the bodies at the points: of the body there, or of the other one of a pair. */
static void take_key(const assembly_class *c, const plan_input *in, const workspace *w, v8 *out)
{
    const int32_t *id = in->eval == PF_OTHER_KEY ? w->body.other_id : w->id;

    for (int q = 0; q < c->n_q; q++)
        for (int l = 0; l < 8; l++)
            for (int i = 0; i < in->n_comp; i++) {
                int32_t k = id[q * 8 + l];

                out[i * c->n_q + q][l] = k < 0 ? 0 : in->key[k * in->n_comp + i];
            }
}

void inputs_values(const assembly *a, const assembly_class *c, const assembly_state *s, int64_t batch, workspace *w)
{
    const space *sp = a->space;
    int nq = c->n_q, dim = sp->mesh->dim;
    const double *gathered = NULL;
    int gathered_field = -1;

    w->frame = s->frame && c->frame_at && c->frame_at[batch] >= 0 ? c->frame + c->frame_at[batch] : NULL;
    for (int k = 0; k < c->n_input; k++) {
        const plan_input *in = &c->input[k];
        const double *from = in->eval == PF_DOT ? s->dot : in->eval == PF_OLD ? s->old : s->x;
        v8 *out = w->in + in->at * (size_t)nq;

        if (in->law) /* by properties_evaluate */
            continue;
        if (in->frozen) {
            properties_frozen(a, c, s, batch, in, out);
            continue;
        }
        if (in->key) {
            take_key(c, in, w, out);
            continue;
        }
        if (in->kept >= 0) {
            kept_values(a, c, s, batch, in, w, out);
            continue;
        }
        if (in->field < 0) {
            const double *constant = in->number ? in->number : in->data->constant;

            for (int i = 0; i < in->n_comp; i++)
                for (int q = 0; q < nq; q++)
                    out[i * nq + q] =
                        in->table ? in->table[(batch * in->n_comp + i) * nq + q] : (v8){0} + constant[i];
            continue;
        }
        if (from != gathered || in->field != gathered_field) {
            gather(a, c, batch, in->field, from, w->dof);
            gathered = from;
            gathered_field = in->field;
        }
        interpolate(c, &sp->field[in->field], dim, in->eval, w, out);
        if (in->eval == PF_DOT && w->frame && (s->frame->fields >> in->field & 1)) {
            gather(a, c, batch, in->field, s->x, w->dof);
            gathered = s->x;
            history_take(a, c, s, in, w);
        }
    }
}

void inputs_unknowns(const assembly *a, const assembly_class *c, const assembly_state *s, int64_t batch,
                     workspace *w)
{
    const space *sp = a->space;

    for (int t = 0; t < c->n_test; t++) {
        const plan_basis *test = &c->test[t];
        const field_spec *f = &sp->field[test->field];
        uint32_t eval = assemble_eval(c, test->kind);
        v8 *to = w->unknown + test->at * (size_t)c->n_q;

        w->unknown_of[t] = NULL;
        if (!(s->power->fields >> test->field & 1))
            continue;
        for (int k = 0; k < c->n_input; k++)
            if (c->input[k].field == test->field && c->input[k].eval == eval)
                w->unknown_of[t] = w->in + c->input[k].at * (size_t)c->n_q;
        if (w->unknown_of[t])
            continue;
        gather(a, c, batch, test->field, s->x, w->dof);
        interpolate(c, f, sp->mesh->dim, eval, w, to);
        w->unknown_of[t] = to;
    }
}

/* Values of the case's functions at all points; once per time, on one thread (Lua has one). */
int inputs_functions(assembly *a, assembly_class *c, workspace *w, double t, error *err)
{
    int any = 0, nq = c->n_q, dim = a->space->mesh->dim;

    for (int k = 0; k < c->n_input; k++)
        any |= c->input[k].table != NULL;
    if (!any || (c->data_ready && c->data_time == t))
        return 0;
    for (int64_t b = 0; b < c->n_batch; b++) {
        geometry_points(a, c, b, w);
        for (int k = 0; k < c->n_input; k++) {
            plan_input *in = &c->input[k];

            for (int q = 0; in->table && q < nq; q++)
                for (int l = 0; l < 8; l++) {
                    double x[3] = {0}, v[VALUE_MAX];

                    for (int d = 0; d < dim; d++)
                        x[d] = w->x[d * nq + q][l];
                    TRY(value_at(in->data, x, t, v, err));
                    for (int i = 0; i < in->n_comp; i++)
                        in->table[(b * in->n_comp + i) * nq + q][l] = v[i];
                }
        }
    }
    c->data_time = t;
    c->data_ready = 1;
    return 0;
}

int inputs_room(arena *memory, assembly_class *c, error *err)
{
    for (int i = 0; i < c->n_input; i++)
        if (c->input[i].data && c->input[i].data->f)
            ARENA_NEW(memory, c->input[i].table, c->n_batch * c->input[i].n_comp * c->n_q + 1, err);
    c->data_ready = 0;
    return 0;
}
