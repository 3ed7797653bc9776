/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Bodies in the results: particles.csv (a row a body and step) and, with every file of fields, their
 * surfaces as particles_NNNNN.vtp. */
#include "run/run.h"

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
enum { COLUMNS_2D = 14, COLUMNS_3D = 25 };

int particles_open(run *r, error *err)
{
    char path[4600];

    if (r->p->n_particle == 0)
        return 0;
    ARENA_NEW(&r->p->memory, r->body_row, r->p->n_particle + COLUMNS_3D, err);
    ARENA_NEW(&r->p->memory, r->contact, r->p->space.n_dof, err);
    snprintf(path, sizeof path, "%s/particles.csv", r->dir);
    return r->p->dim == 2 ? table_create(&r->particles, path, columns_2d, COLUMNS_2D, err)
                          : table_create(&r->particles, path, columns_3d, COLUMNS_3D, err);
}

/* Nodes of the active set near each body. */
static void count_active(const problem *p, double *n)
{
    const space *s = &p->space;
    int f = 0;

    while (f < s->n_field && s->field[f].support != PF_IN_PARTICLES)
        f++;
    for (int64_t a = 0; f < s->n_field && a < p->n_covered; a++) {
        int k = s->attached_particle[p->covered[a]];
        int64_t group = p->mesh.n_cell + p->covered[a];

        for (int i = 0; i < p->mesh.type->n_node; i++) /* a node counts in the first cell that lists it */
            if (!s->idle[s->first[f][space_carrier(s, group, i)]])
                n[k] += 1.0 / p->node_share[space_carrier(s, group, i)];
    }
}

/* How many covered cells of all bodies share each node. */
static int share_nodes(problem *p, error *err)
{
    if (!p->node_share)
        ARENA_NEW(&p->memory, p->node_share, p->mesh.n_node, err);
    for (int pass = 0; pass < 2; pass++)
        for (int64_t a = 0; a < p->n_covered; a++)
            for (int i = 0; i < p->mesh.type->n_node; i++) {
                float *n = &p->node_share[space_carrier(&p->space, p->mesh.n_cell + p->covered[a], i)];

                *n = pass ? *n + 1 : 0;
            }
    return 0;
}

int particles_write(run *r, double t, error *err)
{
    problem *p = r->p;
    int n_spin = p->dim == 2 ? 1 : 3;
    newton_time fluid = r->last;
    double *force, *active = r->body_row, *row = r->body_row + p->n_particle;

    if (p->n_particle == 0)
        return 0;
    fluid.only = PF_FLUID_FORCE;
    memset(active, 0, (size_t)p->n_particle * sizeof *active);
    TRY(share_nodes(p, err));
    count_active(p, active);
    TRY(newton_residual(&p->system, &fluid, p->x, p->system.trial, err));
    force = p->system.trial;
    fluid.only = ASSEMBLE_CONTACT;
    TRY(newton_residual(&p->system, &fluid, p->x, r->contact, err));
    for (int k = 0; k < p->n_particle; k++) {
        const particle *q = &p->particle[k];
        int64_t u = problem_particle_dof(p, k, PF_VECTOR), w = problem_particle_dof(p, k, PF_SPIN);
        double *at = row;

        *at++ = t;
        *at++ = k;
        for (int i = 0; i < p->dim; i++)
            *at++ = q->x[i];
        if (p->dim == 2)
            *at++ = q->angle;
        for (int i = 0; p->dim == 3 && i < 4; i++)
            *at++ = q->q[i];
        for (int i = 0; i < p->dim; i++)
            *at++ = u >= 0 ? p->x[u + i] : 0;
        for (int i = 0; i < n_spin; i++)
            *at++ = w >= 0 ? p->x[w + i] : 0;
        for (int i = 0; i < p->dim; i++)
            *at++ = u >= 0 ? -force[u + i] : 0;
        for (int i = 0; i < n_spin; i++)
            *at++ = w >= 0 ? -force[w + i] : 0;
        for (int i = 0; i < p->dim; i++)
            *at++ = u >= 0 ? -r->contact[u + i] : 0;
        *at = round(active[k]);
        TRY(table_add(&r->particles, row, err));
    }
    return 0;
}

double particles_energy(const run *r)
{
    const problem *p = r->p;
    double sum = 0;

    for (int k = 0; k < p->n_particle; k++) {
        const particle *q = &p->particle[k];
        int64_t u = problem_particle_dof(p, k, PF_VECTOR), w = problem_particle_dof(p, k, PF_SPIN);
        double axes[3][3], trace = q->shape.moment[0][0] + q->shape.moment[1][1] + q->shape.moment[2][2];

        for (int i = 0; u >= 0 && i < p->dim; i++)
            sum += 0.5 * q->density * q->shape.volume * p->x[u + i] * p->x[u + i];
        if (w >= 0 && p->dim == 2)
            sum += 0.5 * q->density * (q->shape.moment[0][0] + q->shape.moment[1][1]) * p->x[w] * p->x[w];
        if (w < 0 || p->dim == 2)
            continue;
        particle_rotation(q, axes);
        for (int i = 0; i < 3; i++) /* spin in the body's frame; I = trace(M) 1 - M */
            for (int j = 0; j < 3; j++) {
                double wi = 0, wj = 0;

                for (int c = 0; c < 3; c++) {
                    wi += axes[c][i] * p->x[w + c];
                    wj += axes[c][j] * p->x[w + c];
                }
                sum += 0.5 * q->density * wi * wj * ((i == j ? trace : 0) - q->shape.moment[i][j]);
            }
    }
    return sum;
}

int particles_balance(run *r, double *balance, error *err)
{
    problem *p = r->p;
    const space *s = &p->space;
    newton_time coupling = r->last;
    double sum[3] = {0}, size = 0;

    coupling.only = ASSEMBLE_COUPLING;
    TRY(newton_residual(&p->system, &coupling, p->x, r->contact, err));
    for (int64_t d = 0; d < s->n_dof; d++) {
        const space_field *f = &s->field[s->dof_field[d]];

        if (f->shape != PF_VECTOR || f->support == PF_IN_PARTICLES)
            continue;
        sum[s->dof_comp[d]] += r->contact[d];
        size += f->support == PF_ON_PARTICLE ? fabs(r->contact[d]) : 0;
    }
    *balance = size > 0 ? sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]) / size : 0;
    return 0;
}

/* Body k at the place of its image that covers attached pair a. */
static vtp_body body_at(const problem *p, int64_t a)
{
    int k = p->space.attached_particle[a];
    int64_t u = problem_particle_dof(p, k, PF_VECTOR);
    vtp_body b = {.id = k, .at = problem_image(p, a)};

    for (int i = 0; u >= 0 && i < p->dim; i++)
        b.velocity[i] = p->x[u + i];
    return b;
}

/* Bodies in order, each at all places where it meets the domain; pairs of a body and an image lie together. */
static int find_places(const problem *p, vtp_body *body)
{
    int n = 0;

    for (int64_t i = 0; i < p->n_covered; i++) {
        vtp_body b = body_at(p, p->covered[i]);
        int known = 0;

        for (int j = n - 1; j >= 0 && body[j].id == b.id; j--)
            known |= memcmp(body[j].at.x, b.at.x, sizeof b.at.x) == 0;
        if (!known)
            body[n++] = b;
    }
    return n;
}

int particles_outline(run *r, error *err)
{
    const problem *p = r->p;
    char path[4600], name[40], **more;
    vtp_body *body;
    int status;

    if (p->n_particle == 0)
        return 0;
    body = malloc((size_t)p->n_particle * (size_t)p->n_image * sizeof *body);
    if (!body)
        return error_memory(err, "places of bodies", (double)p->n_particle * p->n_image * (double)sizeof *body);
    snprintf(name, sizeof name, "particles_%05d.vtp", r->n_file - 1);
    snprintf(path, sizeof path, "%s/%s", r->dir, name);
    status = vtp_write(path, p->dim, body, find_places(p, body), err);
    free(body);
    TRY(status);
    more = realloc(r->body_file, (size_t)(r->n_body_file + 1) * sizeof *more);
    if (!more || !(more[r->n_body_file] = strdup(name)))
        return error_memory(err, path, 0);
    r->body_file = more;
    r->n_body_file++;
    snprintf(path, sizeof path, "%s/particles.pvd", r->dir);
    return vtu_write_pvd(path, (const char *const *)r->body_file, r->file_time, r->n_body_file, err);
}
