/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * How bodies move: prescribed and held velocities, poses from velocities, the velocity at a place in a body. */
#include "body/body.h"

#include <string.h>

int64_t bodies_dof(const bodies *b, int k, int spin)
{
    int f = spin ? b->field_spin : b->field_velocity;

    return f < 0 ? -1 : b->space->first[f][space_body_carrier(b->space, k)];
}

static int n_spin(const bodies *b)
{
    return b->space->mesh->dim == 2 ? 1 : 3;
}

void bodies_hold(const bodies *b)
{
    int dim = b->space->mesh->dim;

    for (int k = 0; k < b->n; k++) {
        const body_spec *q = &b->spec[k];
        int64_t u = bodies_dof(b, k, 0), w = bodies_dof(b, k, 1);

        for (int i = 0; u >= 0 && i < dim; i++)
            b->space->fixed[u + i] = q->motion != BODY_FREE || q->held[i];
        for (int i = 0; w >= 0 && i < n_spin(b); i++)
            b->space->fixed[w + i] = q->motion != BODY_FREE || q->held[dim == 2 ? 5 : 3 + i];
    }
}

int bodies_prescribe(const bodies *b, double t, double *x, error *err)
{
    for (int k = 0; k < b->n; k++)
        for (int spin = 0; spin < 2; spin++) {
            const value *given = spin ? &b->spec[k].spin : &b->spec[k].velocity;
            int64_t first = bodies_dof(b, k, spin);
            double v[VALUE_MAX];

            TRY(value_at(given, (double[3]){0}, t, v, err));
            for (int i = 0; first >= 0 && i < given->n; i++)
                if (b->space->fixed[first + i])
                    x[first + i] = v[i];
        }
    return 0;
}

/* Another field of body k at the start: what the body says, or initial{} at its centre; else 0. */
static int start_field(const bodies *b, int f, int k, double t, double *to, error *err)
{
    const description *d = b->description;
    double v[VALUE_MAX] = {0};

    if (d->has_initial[f])
        TRY(value_at(&d->initial[f], b->spec[k].start.x, t, v, err));
    memcpy(to, b->spec[k].has_field >> f & 1 ? b->spec[k].field + 3 * f : v,
           (size_t)b->space->field[f].n_comp * sizeof *to);
    return 0;
}

int bodies_start(const bodies *b, double t, double *x, error *err)
{
    for (int k = 0; k < b->n; k++)
        for (int spin = 0; spin < 2; spin++) {
            int64_t first = bodies_dof(b, k, spin);

            if (first >= 0)
                TRY(value_at(spin ? &b->spec[k].spin : &b->spec[k].velocity, (double[3]){0}, t, x + first, err));
        }
    for (int f = 0; f < b->space->n_field; f++)
        for (int k = 0; b->space->field[f].support == PF_ON_PARTICLE && k < b->n; k++)
            if (f != b->field_velocity && f != b->field_spin)
                TRY(start_field(b, f, k, t, x + b->space->first[f][space_body_carrier(b->space, k)], err));
    return 0;
}

void bodies_move(const bodies *b, const pose *from, double dt, const double *u0, const double *u1, pose *to)
{
    int dim = b->space->mesh->dim;

    for (int k = 0; k < b->n; k++) {
        int64_t u = bodies_dof(b, k, 0), w = bodies_dof(b, k, 1);
        double turn[3] = {0};

        to[k] = from[k];
        if (b->spec[k].motion == BODY_FIXED)
            continue;
        for (int i = 0; u >= 0 && i < dim; i++) {
            to[k].x[i] += 0.5 * dt * (u0[u + i] + u1[u + i]);
            to[k].way[i] += 0.5 * dt * (u0[u + i] + u1[u + i]);
        }
        for (int i = 0; w >= 0 && i < n_spin(b); i++)
            turn[dim == 2 ? 2 : i] = 0.5 * dt * (u0[w + i] + u1[w + i]);
        pose_turn(&to[k], dim, turn);
        mesh_wrap(b->space->mesh,
                  to[k].x); /* one that left through a periodic boundary comes in on the other side */
    }
}

void bodies_velocity(const bodies *b, const pose *at, const double *x, int k, const double *place, double *v)
{
    int dim = b->space->mesh->dim;
    int64_t u = bodies_dof(b, k, 0), w = bodies_dof(b, k, 1);
    double r[3] = {0}, spin[3] = {0};

    for (int i = 0; i < dim; i++)
        r[i] = place[i] - at->x[i];
    for (int i = 0; w >= 0 && i < n_spin(b); i++)
        spin[dim == 2 ? 2 : i] = x[w + i];
    for (int i = 0; i < dim; i++) {
        const int p = (i + 1) % 3, q = (i + 2) % 3;

        v[i] = (u >= 0 ? x[u + i] : 0) + spin[p] * r[q] - spin[q] * r[p];
    }
}

int bodies_rigid_field(const bodies *b)
{
    const char *name = b->field_velocity >= 0 ? b->space->field[b->field_velocity].constrains : NULL;

    for (int f = 0; !name && f < b->space->n_field; f++)
        if (b->space->field[f].support == PF_IN_PARTICLES)
            name = b->space->field[f].constrains;
    return name ? space_find_field(b->space, name) : -1;
}

int bodies_moved_field(const bodies *b)
{
    int f = bodies_rigid_field(b);

    return f >= 0 && b->fluid_only[f] ? f : -1;
}
