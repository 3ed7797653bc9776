/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Bodies in the results: particles.csv (a row a body and step) and, with every file of fields, their
 * outlines as particles_NNNNN.vtp. */
#include "run/run.h"
#include "run/showing.h"

#include "io/vtp.h"
#include "io/vtu.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const columns_2d[] = {"t",     "id", "x",  "y",      "angle",     "u",         "v",
                                         "omega", "fx", "fy", "torque", "contact_x", "contact_y", "active_nodes"};
static const char *const columns_3d[] = {
    "t",  "id", "x",  "y",         "z",         "q0",        "q1",          "q2", "q3",
    "u",  "v",  "w",  "omega_x",   "omega_y",   "omega_z",   "fx",          "fy", "fz",
    "tx", "ty", "tz", "contact_x", "contact_y", "contact_z", "active_nodes"};
static const char *const coefficients[] = {"cx", "cy", "cz"};
enum { COLUMNS_2D = 14, COLUMNS_3D = 25 };

int particles_plan(run *r, error *err)
{
    char path[4600], name[2 * OFF_MESH_MOST][OFF_MESH_NAME], own[SHOWING_MOST_COLUMNS][96];
    const char *column[COLUMNS_3D + 2 * OFF_MESH_MOST + SHOWING_MOST_COLUMNS + 3], *unit[SHOWING_MOST_COLUMNS];
    const int dim = r->p->description.dim, n = dim == 2 ? COLUMNS_2D : COLUMNS_3D;
    int more, n_shown;

    if (r->p->bodies.n == 0)
        return 0;
    ARENA_NEW(&r->memory, r->body_row, r->p->bodies.n + COLUMNS_3D + 2 * OFF_MESH_MOST + SHOWING_MOST_COLUMNS + 3,
              err);
    memcpy(column, dim == 2 ? columns_2d : columns_3d, (size_t)n * sizeof *column);
    more = off_mesh_columns(r, PF_ON_PARTICLE, name);
    more += kept_columns(r, name + more);
    for (int i = 0; i < more; i++)
        column[n + i] = name[i];
    n_shown = showing_body_columns(r, SHOWING_MOST_COLUMNS, own, unit);
    for (int i = 0; i < n_shown; i++)
        column[n + more + i] = own[i];
    for (int i = 0; r->p->description.output.coefficient > 0 && i < dim; i++)
        column[n + more + n_shown++] = coefficients[i];
    snprintf(path, sizeof path, "%s/particles.csv", r->dir);
    return table_create(&r->particles, path, column, n + more + n_shown, err);
}

/* How many covered cells of all bodies share each node. */
static int share_nodes(run *r, error *err)
{
    const space *s = &r->p->space;
    const placement *now = r->p->bodies.now;

    if (!r->node_share)
        ARENA_NEW(&r->memory, r->node_share, s->mesh->n_node, err);
    for (int pass = 0; pass < 2; pass++)
        for (int64_t a = 0; a < now->n_covered; a++)
            for (int i = 0; i < s->mesh->type->n_node; i++) {
                float *n = &r->node_share[space_carrier(s, space_attached_group(s, now->covered[a]), i)];

                *n = pass ? *n + 1 : 0;
            }
    return 0;
}

/* Nodes of the active set near each body. */
static void count_active(const run *r, double *n)
{
    const space *s = &r->p->space;
    const placement *now = r->p->bodies.now;
    int f = 0;

    while (f < s->n_field && s->field[f].support != PF_IN_PARTICLES)
        f++;
    for (int64_t a = 0; f < s->n_field && a < now->n_covered; a++) {
        int64_t group = space_attached_group(s, now->covered[a]);

        for (int i = 0; i < s->mesh->type->n_node; i++) { /* a node counts in equal parts in its cells */
            int64_t d = s->first[f][space_carrier(s, group, i)];

            if (d >= 0 && !now->idle[d])
                n[s->attached_particle[now->covered[a]]] += 1.0 / r->node_share[space_carrier(s, group, i)];
        }
    }
}

int particles_write(run *r, double t, error *err)
{
    problem *p = r->p;
    int dim = p->description.dim, n_spin = dim == 2 ? 1 : 3, n = p->bodies.n;
    const double *force = r->stepper->reaction[REACTION_FLUID], *contact = r->stepper->reaction[REACTION_CONTACT];
    double *active = r->body_row, *row = r->body_row + n;

    if (n == 0)
        return 0;
    memset(active, 0, (size_t)n * sizeof *active);
    TRY(share_nodes(r, err));
    count_active(r, active);
    for (int k = 0; k < n; k++) {
        const pose *q = &p->state.pose[k];
        int64_t u = bodies_dof(&p->bodies, k, 0), w = bodies_dof(&p->bodies, k, 1);
        double *at = row;

        *at++ = t;
        *at++ = k;
        for (int i = 0; i < dim; i++)
            *at++ = q->x[i];
        if (dim == 2)
            *at++ = q->angle;
        for (int i = 0; dim == 3 && i < 4; i++)
            *at++ = q->q[i];
        for (int i = 0; i < dim; i++)
            *at++ = u >= 0 ? r->x[u + i] : 0;
        for (int i = 0; i < n_spin; i++)
            *at++ = w >= 0 ? r->x[w + i] : 0;
        for (int i = 0; i < dim; i++)
            *at++ = r->before_steps ? NAN : u >= 0 ? -force[u + i] : 0;
        for (int i = 0; i < n_spin; i++)
            *at++ = r->before_steps ? NAN : w >= 0 ? -force[w + i] : 0;
        for (int i = 0; i < dim; i++)
            *at++ = r->before_steps ? NAN : u >= 0 ? -contact[u + i] : 0;
        *at++ = round(active[k]);
        at = off_mesh_values(r, PF_ON_PARTICLE, space_body_carrier(&p->space, k), at);
        at = kept_of_body(r, k, at);
        at = showing_body_row(r, k, at, err);
        if (!at)
            return err->code;
        for (int i = 0; p->description.output.coefficient > 0 && i < dim; i++)
            *at++ = r->before_steps ? NAN : u >= 0 ? -p->description.output.coefficient * force[u + i] : 0;
        TRY(table_add(&r->particles, row, err));
    }
    return 0;
}

double particles_energy(const run *r)
{
    const problem *p = r->p;
    int dim = p->description.dim;
    double sum = 0;

    for (int k = 0; k < p->bodies.n; k++) {
        const body_spec *q = &p->bodies.spec[k];
        int64_t u = bodies_dof(&p->bodies, k, 0), w = bodies_dof(&p->bodies, k, 1);
        solid here = solid_at(&q->shape, &p->state.pose[k]);
        double trace = q->shape.moment[0][0] + q->shape.moment[1][1] + q->shape.moment[2][2];

        for (int i = 0; u >= 0 && i < dim; i++)
            sum += 0.5 * q->density * q->shape.volume * r->x[u + i] * r->x[u + i];
        if (w >= 0 && dim == 2)
            sum += 0.5 * q->density * (q->shape.moment[0][0] + q->shape.moment[1][1]) * r->x[w] * r->x[w];
        if (w < 0 || dim == 2)
            continue;
        for (int i = 0; i < 3; i++) /* spin in the body's frame; I = trace(M) 1 - M */
            for (int j = 0; j < 3; j++) {
                double wi = 0, wj = 0;

                for (int c = 0; c < 3; c++) {
                    wi += here.axes[c][i] * r->x[w + c];
                    wj += here.axes[c][j] * r->x[w + c];
                }
                sum += 0.5 * q->density * wi * wj * ((i == j ? trace : 0) - q->shape.moment[i][j]);
            }
    }
    return sum;
}

double particles_balance(const run *r)
{
    const space *s = &r->p->space;
    const double *coupling = r->stepper->reaction[REACTION_COUPLING];
    double sum[3] = {0}, size = 0;

    for (int64_t d = 0; d < s->n_dof; d++) {
        const field_spec *f = &s->field[s->dof_field[d]];

        if (f->shape != PF_VECTOR || f->support == PF_IN_PARTICLES)
            continue;
        sum[s->dof_comp[d]] += coupling[d];
        size += f->support == PF_ON_PARTICLE ? fabs(coupling[d]) : 0;
    }
    return size > 0 ? sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]) / size : 0;
}

/* The .vtp of all places. */
static int write_outline(run *r, const char *path, arena *scratch, error *err)
{
    const problem *p = r->p;
    int list[SPACE_MAX_FIELDS], n_field = off_mesh_fields(r, PF_ON_PARTICLE, list), width = 0;
    vtp_field field[SPACE_MAX_FIELDS];
    vtp_body *body;
    double *more;

    for (int f = 0; f < n_field; f++) {
        field[f] = (vtp_field){p->space.field[list[f]].name, p->space.field[list[f]].n_comp};
        width += field[f].width;
    }
    ARENA_NEW(scratch, more, (int64_t)p->bodies.n * width + 1, err);
    ARENA_NEW(scratch, body, r->n_place + 1, err);
    for (int k = 0; k < p->bodies.n; k++)
        off_mesh_values(r, PF_ON_PARTICLE, space_body_carrier(&p->space, k), more + k * width);
    for (int i = 0; i < r->n_place; i++) {
        int k = r->place[i].body;
        int64_t u = bodies_dof(&p->bodies, k, 0);

        body[i] = (vtp_body){.id = k,
                             .moves = p->bodies.spec[k].motion != BODY_FIXED,
                             .at = r->place[i].solid,
                             .more = more + k * width};
        for (int a = 0; u >= 0 && a < p->mesh.dim; a++)
            body[i].velocity[a] = r->x[u + a];
    }
    return vtp_write(path, p->mesh.dim, body, r->n_place, field, n_field, err);
}

/* A .vtp with all places of bodies; of those by images the ones that meet the domain. */
int particles_outline(run *r, error *err)
{
    const problem *p = r->p;
    char path[4600], name[40], **more;
    arena scratch = {0};
    int status;

    if (p->bodies.n == 0)
        return 0;
    snprintf(name, sizeof name, "particles_%05d.vtp", r->n_file - 1);
    snprintf(path, sizeof path, "%s/%s", r->dir, name);
    status = write_outline(r, path, &scratch, err);
    arena_free(&scratch);
    TRY(status);
    TRY(bodies_check(&p->bodies, err)); /* the outline met the levels */
    more = realloc(r->body_file, (size_t)(r->n_body_file + 1) * sizeof *more);
    if (!more)
        return error_memory(err, path, 0);
    r->body_file = more;
    if (!(more[r->n_body_file] = strdup(name)))
        return error_memory(err, path, 0);
    r->n_body_file++;
    snprintf(path, sizeof path, "%s/particles.pvd", r->dir);
    return vtu_write_pvd(path, (const char *const *)r->body_file, r->file_time, r->n_body_file, err);
}
