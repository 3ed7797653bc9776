/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What terms may read of bodies at their points (pf_batch of interface 1.4): centre, axes, volume, mass, inertia,
 * what the fluid did; of pairs also of the other body.  All of it is constant on a body, so it is written lane by
 * lane, and only where some term may read it. */
#include "assemble/batch.h"

#include <string.h>

static int on_bodies(const assembly_class *c)
{
    return c->where == PF_SOLID || c->where == PF_SURFACE || c->where == PF_PARTICLE || c->where == PF_PAIR;
}

int body_data_room(size_t n_q, size_t dim, workspace *w, error *err)
{
    const size_t spin = dim == 2 ? 1 : 3;
    const struct {
        v8 **to;
        size_t n;
    } list[] = {{&w->body.centre, dim},
                {&w->body.axes, dim * dim},
                {&w->body.volume, 1},
                {&w->body.mass, 1},
                {&w->body.inertia, spin * spin},
                {&w->body.fluid_force, dim},
                {&w->body.fluid_torque, spin},
                {&w->body.other_centre, dim},
                {&w->body.other_axes, dim * dim},
                {&w->body.other_arm, dim},
                {&w->body.curvature, 1}};

    for (size_t i = 0; i < sizeof list / sizeof *list; i++)
        ARENA_NEW(&w->memory, *list[i].to, list[i].n * n_q, err);
    ARENA_NEW(&w->memory, w->body.other_id, n_q * PF_LANES, err);
    return 0;
}

void points_of_bodies(const assembly *a, const assembly_class *c, int64_t batch, workspace *w)
{
    const body_points *b = a->bodies;

    w->w[0] = (v8){0} + 1;
    for (int k = 0; k <= ASSEMBLE_PAD; k++)
        w->basis[0][0][k] = (v8){0} + (k == 0);
    for (int l = 0; l < 8; l++) {
        int64_t item = assemble_item(c, batch, l);
        int32_t id = c->source[item];

        w->h[0][l] = a->space->mesh->h[c->cell[item]];
        w->density[0][l] = b->density[id];
        w->id[l] = id;
        for (int k = 0; k < a->space->mesh->dim; k++) {
            w->x[k][l] = b->body[id].at.x[k];
            w->arm[k][l] = 0;
        }
    }
}

/* n numbers of a body into lane l, the same at all points. */
static void put(v8 *to, const double *from, int n, int n_q, int l)
{
    for (int i = 0; i < n; i++)
        for (int q = 0; q < n_q; q++)
            to[i * n_q + q][l] = from[i];
}

static void put_axes(v8 *to, const solid *q, int dim, int n_q, int l)
{
    for (int i = 0; i < dim; i++)
        put(to + i * dim * n_q, q->axes[i], dim, n_q, l);
}

/* I = rho (trace(M) 1 - M), M the second moments, turned into the axes of space; in 2D about the third axis. */
static int inertia_of(const solid *q, double density, double *inertia)
{
    const double(*m)[3] = q->shape->moment;
    double trace = m[0][0] + m[1][1] + m[2][2];

    if (q->shape->dim == 2) {
        inertia[0] = density * (m[0][0] + m[1][1]);
        return 1;
    }
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            double sum = i == j ? trace : 0;

            for (int k = 0; k < 3; k++)
                for (int l = 0; l < 3; l++)
                    sum -= q->axes[i][k] * m[k][l] * q->axes[j][l];
            inertia[3 * i + j] = density * sum;
        }
    return 9;
}

/* The centre of the body's image at the points of an item. */
static void centre_of(const assembly *a, const assembly_class *c, int64_t item, int32_t id, double *centre)
{
    memcpy(centre, a->bodies->body[id].at.x, 3 * sizeof *centre);
    if (c->where == PF_SOLID || c->where == PF_SURFACE)
        for (int k = 0; k < a->space->mesh->dim; k++)
            centre[k] += a->bodies->shift[c->group[item] - space_attached_group(a->space, 0)][k];
}

/* Whether the data of this body stand in the lane from an earlier batch; if not they will. */
static int is_there(const assembly *a, const assembly_class *c, int32_t id, const double *centre, int l,
                    workspace *w)
{
    int same = w->body.last[l].class_ == c && w->body.last[l].stamp == a->bodies->stamp &&
               w->body.last[l].id == id && !memcmp(w->body.last[l].centre, centre, 3 * sizeof *centre);

    w->body.last[l].class_ = c;
    w->body.last[l].stamp = a->bodies->stamp;
    w->body.last[l].id = id;
    memcpy(w->body.last[l].centre, centre, 3 * sizeof *centre);
    return same;
}

static void take_pair(const assembly *a, const near_pair *p, int l, workspace *w)
{
    const int dim = a->space->mesh->dim;
    const double rest[9] = {0};

    w->body.other_id[l] = p->other;
    put(w->body.other_centre, p->other_centre, dim, 1, l);
    if (p->other < 0) {
        put(w->body.other_axes, rest, dim * dim, 1, l);
        put(w->body.other_arm, rest, dim, 1, l);
    } else {
        put_axes(w->body.other_axes, &a->bodies->body[p->other], dim, 1, l);
    }
    for (int k = 0; k < dim; k++) {
        w->arm[k][l] = p->at[k] - a->bodies->body[p->particle].at.x[k];
        if (p->other >= 0)
            w->body.other_arm[k][l] = p->at[k] - p->other_centre[k];
    }
}

void body_data_take(const assembly *a, const assembly_class *c, const assembly_state *s, int64_t batch,
                    workspace *w)
{
    const int dim = a->space->mesh->dim, nq = c->n_q, spin = dim == 2 ? 1 : 3;
    const double still[6] = {0};

    if (!c->any_body_data || !on_bodies(c))
        return;
    for (int l = 0; l < 8; l++) {
        const int64_t item = assemble_item(c, batch, l);
        const int32_t id = w->id[l];
        const solid *q = &a->bodies->body[id];
        const double density = a->bodies->density[id], mass = density * q->shape->volume;
        double centre[3], inertia[9];
        int n;

        centre_of(a, c, item, id, centre);
        if (!is_there(a, c, id, centre, l, w)) {
            n = inertia_of(q, density, inertia);
            put(w->body.centre, centre, dim, nq, l);
            put_axes(w->body.axes, q, dim, nq, l);
            put(w->body.volume, &q->shape->volume, 1, nq, l);
            put(w->body.mass, &mass, 1, nq, l);
            put(w->body.inertia, inertia, n, nq, l);
        }
        if (c->where == PF_PARTICLE) {
            put(w->body.fluid_force, s->fluid ? s->fluid[id] : still, dim, nq, l);
            put(w->body.fluid_torque, s->fluid ? s->fluid[id] + 3 : still, spin, nq, l);
        }
        if (c->where == PF_PAIR)
            take_pair(a, &c->pair[c->source[item]], l, w);
        for (int p = 0; c->where == PF_SURFACE && a->bodies->curvature && p < nq; p++)
            w->body.curvature[p][l] = a->bodies->curvature[(int64_t)c->source[item] * nq + p];
    }
}

void body_data_show(const assembly_class *c, const workspace *w, pf_batch *b)
{
    if (!c->any_body_data || !on_bodies(c))
        return;
    b->centre = (double *)w->body.centre;
    b->axes = (double *)w->body.axes;
    b->volume = (double *)w->body.volume;
    b->mass = (double *)w->body.mass;
    b->inertia = (double *)w->body.inertia;
    if (c->where == PF_PARTICLE) {
        b->fluid_force = (double *)w->body.fluid_force;
        b->fluid_torque = (double *)w->body.fluid_torque;
    }
    if (c->where == PF_SURFACE)
        b->curvature = (double *)w->body.curvature;
    if (c->where == PF_PAIR) {
        b->other_id = w->body.other_id;
        b->other_centre = (double *)w->body.other_centre;
        b->other_axes = (double *)w->body.other_axes;
        b->other_arm = (double *)w->body.other_arm;
    }
}
