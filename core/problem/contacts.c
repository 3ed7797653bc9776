/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Bodies near each other and near the walls of a box.  The gap along the line of centres is the
 * distance less both bodies' extents in that direction: exact for disks and spheres, and for any
 * body against a wall. */
#include "problem/problem.h"

#include <math.h>
#include <string.h>

/* Which sides of a box mesh are walls: some vector field is prescribed there. */
static unsigned walls_of(const problem *p)
{
    unsigned walls = 0;

    for (int64_t f = 0; !p->mesh_path && !p->has_map && f < p->mesh.n_facet; f++)
        for (int i = 0; i < p->n_line; i++)
            for (int k = 0; p->line[i].facet && p->line[i].facet[f] && k < p->space.n_field; k++)
                if (p->line[i].has_value[k] && p->space.field[k].shape == PF_VECTOR)
                    walls |= (unsigned)p->mesh.facet[f].names;
    return walls;
}

/* The first attached pair of a body: any does, its only use is to name the body. */
static int32_t attached_of(const problem *p, int k)
{
    int64_t a = 0;

    while (p->space.attached_particle[a] != k)
        a++;
    return (int32_t)a;
}

static void add_pair(problem *p, int k, double gap, const double *normal)
{
    near_pair *n = &p->pair[p->n_pair++];

    n->attached = attached_of(p, k);
    n->gap = gap;
    n->size = 2 * p->particle[k].shape.radius;
    memcpy(n->normal, normal, sizeof n->normal);
}

static void near_walls(problem *p, int k, const double r[3][3])
{
    const particle *q = &p->particle[k];

    for (int side = 0; side < 2 * p->dim; side++) {
        int axis = side / 2;
        double n[3] = {0}, gap;

        if (!(p->walls >> side & 1))
            continue;
        n[axis] = side % 2 ? -1 : 1;
        gap =
            (side % 2 ? p->box.high[axis] - q->x[axis] : q->x[axis] - p->box.low[axis]) - particle_support(q, r, n);
        if (gap < p->pair_range)
            add_pair(p, k, gap, n);
    }
}

int problem_find_pairs(problem *p, error *err)
{
    double r[2][3][3];

    p->n_pair = 0;
    if (!p->pair) {
        p->walls = walls_of(p);
        p->pair_room = (int64_t)p->n_particle * (2 * p->dim + 24);
        ARENA_NEW(&p->memory, p->pair, p->pair_room, err);
        for (int k = 0; k < p->n_particle; k++)
            p->pair_range = fmax(p->pair_range, 2 * p->particle[k].shape.radius);
    }
    for (int i = 0; i < p->n_particle; i++) {
        const particle *a = &p->particle[i];

        particle_rotation(a, r[0]);
        near_walls(p, i, (const double(*)[3])r[0]);
        for (int j = 0; j < i; j++) {
            const particle *b = &p->particle[j];
            double n[3] = {0}, back[3] = {0}, d = 0, gap, reach = a->shape.radius + b->shape.radius + p->pair_range;

            for (int k = 0; k < p->dim; k++)
                d += (a->x[k] - b->x[k]) * (a->x[k] - b->x[k]);
            if (d >= reach * reach || d == 0)
                continue;
            d = sqrt(d);
            for (int k = 0; k < p->dim; k++) {
                n[k] = (a->x[k] - b->x[k]) / d;
                back[k] = -n[k];
            }
            particle_rotation(b, r[1]);
            gap = d - particle_support(a, (const double(*)[3])r[0], back) -
                  particle_support(b, (const double(*)[3])r[1], n);
            if (p->n_pair + 2 > p->pair_room)
                return error_set(err, ERR_CONVERGE, "more than %lld near pairs: do bodies overlap?",
                                 (long long)p->pair_room);
            if (gap < p->pair_range) {
                add_pair(p, i, gap, n);
                add_pair(p, j, gap, back);
            }
        }
    }
    return 0;
}
