/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Which body holds a place, and what the fields are there: the velocity is the body's motion; a field with
 * equations in the fluid only has no value, and neither has one that enforces what a rigid motion fulfils by
 * itself, as the pressure does.  A field of the bodies' own has none outside.  By the poses of the state, as
 * everything that is written. */
#include "run/run.h"

#include <math.h>
#include <string.h>

/* Depth in radii up to which a place counts as on the surface. */
#define SURFACE 1e-9

/* Places of bodies: each as it stands, and its images by the periods of the mesh that may reach into the domain. */
int inside_open(run *r, error *err)
{
    const bodies *b = &r->p->bodies;

    if (b->n == 0)
        return 0;
    ARENA_NEW(&r->memory, r->body_of_node, r->p->mesh.n_node, err);
    ARENA_NEW(&r->memory, r->in_file, r->p->space.n_dof, err);
    ARENA_NEW(&r->memory, r->place, (int64_t)b->n * b->n_image, err);
    for (int f = 0; f < r->p->space.n_field; f++)
        if (f != bodies_rigid_field(b) && r->p->space.field[f].support == PF_ON_MESH &&
            (b->fluid_only[f] || !describe_field_is_balanced(&r->p->description, f)))
            r->empty |= 1u << f;
    for (int f = 0; f < r->p->space.n_field; f++)
        if (r->p->space.field[f].support == PF_IN_PARTICLES && !r->p->space.field[f].constrains)
            r->empty_outside |= 1u << f;
    return 0;
}

/* The places now; a body that meets no cell there is left out. */
static void find_places(run *r)
{
    const bodies *b = &r->p->bodies;

    r->n_place = 0;
    for (int k = 0; k < b->n; k++)
        for (int j = 0; j < b->n_image; j++) {
            body_place *at = &r->place[r->n_place];

            *at = (body_place){.body = k, .solid = solid_at(&b->spec[k].shape, &r->p->state.pose[k])};
            for (int i = 0; i < 3; i++)
                at->solid.at.x[i] += b->image[j][i];
            r->n_place +=
                j == 0 || cell_grid_ball(b->grid, at->solid.at.x, at->solid.shape->radius, b->near_cell) > 0;
        }
}

/* Whether a place lies below the surface; a probe on the surface itself is in the fluid. */
static int holds(const body_place *p, const double *x)
{
    double level = solid_level(&p->solid, x), g[3] = {0}, depth = SURFACE * p->solid.shape->radius;

    if (level >= 0)
        return 0;
    solid_slope(&p->solid, x, g);
    return level * level > depth * depth * (g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
}

const body_place *inside_place(const run *r, const double *x)
{
    for (const body_place *p = r->place; p < r->place + r->n_place; p++) {
        double d = 0;

        for (int i = 0; i < r->p->mesh.dim; i++)
            d += (x[i] - p->solid.at.x[i]) * (x[i] - p->solid.at.x[i]);
        if (d < p->solid.shape->radius * p->solid.shape->radius && holds(p, x))
            return p;
    }
    return NULL;
}

void inside_value(const run *r, const body_place *p, int field, const double *x, double *v)
{
    if ((p ? r->empty : r->empty_outside) >> field & 1)
        for (int k = 0; k < r->p->space.field[field].n_comp; k++)
            v[k] = NAN;
    else if (p && field == bodies_rigid_field(&r->p->bodies))
        bodies_velocity(&r->p->bodies, &p->solid.at, r->x, p->body, x, v);
}

/* Nodes that the place holds. */
static void enter(run *r, const body_place *p, double *shown)
{
    const mesh *m = &r->p->mesh;
    const bodies *b = &r->p->bodies;
    int rigid = bodies_rigid_field(b);
    int64_t n = cell_grid_ball(b->grid, p->solid.at.x, p->solid.shape->radius, b->near_cell);

    for (int64_t c = 0; c < n; c++)
        for (int i = 0; i < m->type->n_node; i++) {
            int32_t node = m->cell[(int64_t)b->near_cell[c] * m->type->n_node + i];
            double x[3] = {0};

            memcpy(x, m->x + (int64_t)node * m->dim, (size_t)m->dim * sizeof *x);
            if (r->body_of_node[node] >= 0 || !holds(p, x))
                continue;
            r->body_of_node[node] = p->body;
            if (rigid >= 0 && r->p->space.first[rigid][node] >= 0)
                bodies_velocity(b, &p->solid.at, r->x, p->body, x, shown + r->p->space.first[rigid][node]);
        }
}

void inside_update(run *r)
{
    if (r->p->bodies.n)
        find_places(r);
}

void inside_nodes(run *r, double *shown)
{
    if (r->p->bodies.n == 0)
        return;
    for (int64_t i = 0; i < r->p->mesh.n_node; i++)
        r->body_of_node[i] = -1;
    for (const body_place *p = r->place; p < r->place + r->n_place; p++)
        enter(r, p, shown);
}
