/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Bodies in the results: particles.csv (a row a body and step) and, with every file of fields, their
 * outlines as particles_NNNNN.vtp. */
#include "run/run.h"

#include "io/vtu.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { OUTLINE = 96 };

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
            *at++ = q->at.x[i];
        if (p->dim == 2)
            *at++ = q->at.angle;
        for (int i = 0; p->dim == 3 && i < 4; i++)
            *at++ = q->at.q[i];
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
        solid here = solid_at(&q->shape, &q->at);
        double trace = q->shape.moment[0][0] + q->shape.moment[1][1] + q->shape.moment[2][2];

        for (int i = 0; u >= 0 && i < p->dim; i++)
            sum += 0.5 * q->density * q->shape.volume * p->x[u + i] * p->x[u + i];
        if (w >= 0 && p->dim == 2)
            sum += 0.5 * q->density * (q->shape.moment[0][0] + q->shape.moment[1][1]) * p->x[w] * p->x[w];
        if (w < 0 || p->dim == 2)
            continue;
        for (int i = 0; i < 3; i++) /* spin in the body's frame; I = trace(M) 1 - M */
            for (int j = 0; j < 3; j++) {
                double wi = 0, wj = 0;

                for (int c = 0; c < 3; c++) {
                    wi += here.axes[c][i] * p->x[w + c];
                    wj += here.axes[c][j] * p->x[w + c];
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

/* Point of the outline in direction angle, in the plane of the body's x and y axes. */
static void outline_point(const particle *q, double angle, double *x)
{
    solid here = solid_at(&q->shape, &q->at);
    double low = 0, high = 1.5 * q->shape.radius;

    for (int i = 0; i < 50; i++) {
        double mid = 0.5 * (low + high), body[3] = {mid * cos(angle), mid * sin(angle), 0};

        if (shape_level(&q->shape, body) < 0)
            low = mid;
        else
            high = mid;
    }
    for (int k = 0; k < 3; k++)
        x[k] = q->at.x[k] + low * (here.axes[k][0] * cos(angle) + here.axes[k][1] * sin(angle));
}

static void add_array(text *t, const char *name, const char *type, int width)
{
    text_add(t, "<DataArray type=\"%s\" Name=\"%s\" NumberOfComponents=\"%d\" format=\"ascii\">\n", type, name,
             width);
}

/* A closed line a body, with a spoke from the centre along its x axis that shows how it is turned. */
int particles_outline(run *r, error *err)
{
    const problem *p = r->p;
    char path[4600], name[40], **more;
    text s = {0};
    int status, n = p->n_particle;

    if (n == 0)
        return 0;
    text_add(&s,
             "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" "
             "byte_order=\"LittleEndian\">\n<PolyData>\n"
             "<Piece NumberOfPoints=\"%d\" NumberOfLines=\"%d\">\n<Points>\n",
             n * (OUTLINE + 1), n);
    add_array(&s, "Points", "Float64", 3);
    for (int k = 0; k < n; k++) {
        text_add(&s, "%.9g %.9g %.9g\n", p->particle[k].at.x[0], p->particle[k].at.x[1], p->particle[k].at.x[2]);
        for (int i = 0; i < OUTLINE; i++) {
            double x[3];

            outline_point(&p->particle[k], 2 * M_PI * i / OUTLINE, x);
            text_add(&s, "%.9g %.9g %.9g\n", x[0], x[1], p->dim == 3 ? x[2] : 0.0);
        }
    }
    text_add(&s, "</DataArray>\n</Points>\n<Lines>\n");
    add_array(&s, "connectivity", "Int32", 1);
    for (int k = 0; k < n; k++) {
        for (int i = 0; i <= OUTLINE; i++)
            text_add(&s, "%d ", k * (OUTLINE + 1) + i);
        text_add(&s, "%d\n", k * (OUTLINE + 1) + 1);
    }
    text_add(&s, "</DataArray>\n");
    add_array(&s, "offsets", "Int32", 1);
    for (int k = 0; k < n; k++)
        text_add(&s, "%d\n", (k + 1) * (OUTLINE + 2));
    text_add(&s, "</DataArray>\n</Lines>\n<CellData>\n");
    add_array(&s, "id", "Int32", 1);
    for (int k = 0; k < n; k++)
        text_add(&s, "%d\n", k);
    text_add(&s, "</DataArray>\n");
    add_array(&s, "velocity", "Float64", 3);
    for (int k = 0; k < n; k++) {
        int64_t u = problem_particle_dof(p, k, PF_VECTOR);

        text_add(&s, "%.9g %.9g %.9g\n", u >= 0 ? p->x[u] : 0, u >= 0 ? p->x[u + 1] : 0,
                 u >= 0 && p->dim == 3 ? p->x[u + 2] : 0);
    }
    text_add(&s, "</DataArray>\n</CellData>\n</Piece>\n</PolyData>\n</VTKFile>\n");
    snprintf(name, sizeof name, "particles_%05d.vtp", r->n_file - 1);
    snprintf(path, sizeof path, "%s/%s", r->dir, name);
    status = s.failed ? error_memory(err, path, 0) : file_write(path, s.s, s.n, err);
    text_free(&s);
    TRY(status);
    for (int k = 0; k < n; k++)
        TRY(shape_check(&p->particle[k].shape, err)); /* the outline met its level */
    more = realloc(r->body_file, (size_t)(r->n_body_file + 1) * sizeof *more);
    if (!more || !(more[r->n_body_file] = strdup(name)))
        return error_memory(err, path, 0);
    r->body_file = more;
    r->n_body_file++;
    snprintf(path, sizeof path, "%s/particles.pvd", r->dir);
    return vtu_write_pvd(path, (const char *const *)r->body_file, r->file_time, r->n_body_file, err);
}
