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

/* Distance from the centre of b to that of the nearest image of a, and the unit vector along it. */
static double separation(const problem *p, const particle *a, const particle *b, double *n)
{
    double least = INFINITY;

    for (int i = 0; i < p->n_image; i++) {
        double r[3], d = 0;

        for (int k = 0; k < p->dim; k++) {
            r[k] = a->at.x[k] + p->image[i][k] - b->at.x[k];
            d += r[k] * r[k];
        }
        d = sqrt(d);
        for (int k = 0; d < least && k < p->dim; k++)
            n[k] = d > 0 ? r[k] / d : k == 0;
        least = fmin(d, least);
    }
    return least;
}

int problem_link(problem *p, double drift, error *err)
{
    const int32_t first = (int32_t)p->mesh.n_node + 1;
    int has_pairs = 0;

    for (int i = 0; i < p->n_use; i++)
        has_pairs |= p->use[i].where == PF_PAIR;
    for (int k = 0; k < p->n_particle && p->pair_range == 0; k++)
        p->pair_range = fmax(p->pair_range, 2 * p->particle[k].shape.radius);
    p->walls = walls_of(p);
    p->space.n_extra = p->n_link = 0;
    for (int i = 0; has_pairs && i < p->n_particle; i++)
        TRY(fluid_add_group(p, (int32_t[2]){first + i, -1}, 2, err));
    for (int i = 0; has_pairs && i < p->n_particle; i++)
        for (int j = 0; j < i; j++) {
            const particle *a = &p->particle[i], *b = &p->particle[j];
            double ignored[3];

            if (separation(p, a, b, ignored) - a->shape.radius - b->shape.radius <= p->pair_range + drift)
                TRY(fluid_add_group(p, (int32_t[2]){first + i, first + j}, 2, err));
        }
    p->n_link = p->space.n_extra;
    ARENA_NEW(&p->envelope_memory, p->pair, p->n_link + 2 * p->dim * p->n_particle, err);
    return 0;
}

/* The pair of body a, b (NULL: a wall) of link k, at this gap and normal. */
static void add_pair(problem *p, int64_t link, int a, const particle *b, double gap, const double *normal)
{
    near_pair *n = &p->pair[p->n_pair++];
    const particle *q = &p->particle[a];
    solid here = solid_at(&q->shape, &q->at);
    double back[3], reach;

    *n = (near_pair){
        .group = p->mesh.n_cell + p->space.n_attached + link, .particle = a, .gap = gap, .h = p->h_mean};
    n->size[0] = 2 * q->shape.radius;
    n->density[0] = q->density;
    n->size[1] = b ? 2 * b->shape.radius : INFINITY;
    n->density[1] = b ? b->density : 0;
    for (int k = 0; k < 3; k++)
        back[k] = -normal[k];
    reach = solid_support(&here, back) + 0.5 * gap;
    for (int k = 0; k < p->dim; k++) {
        n->normal[k] = normal[k];
        n->at[k] = q->at.x[k] - reach * normal[k];
    }
}

static void near_walls(problem *p, int k)
{
    const particle *q = &p->particle[k];
    solid here = solid_at(&q->shape, &q->at);

    for (int side = 0; side < 2 * p->dim; side++) {
        int axis = side / 2;
        double n[3] = {0}, gap;

        if (!(p->walls >> side & 1))
            continue;
        n[axis] = side % 2 ? -1 : 1;
        gap = (side % 2 ? p->box.high[axis] - q->at.x[axis] : q->at.x[axis] - p->box.low[axis]) -
              solid_support(&here, n);
        if (gap < p->pair_range)
            add_pair(p, k, k, NULL, gap, n);
    }
}

void problem_find_pairs(problem *p)
{
    const space *s = &p->space;

    p->n_pair = 0;
    for (int k = 0; p->n_link && k < p->n_particle; k++)
        near_walls(p, k);
    for (int64_t l = p->n_particle; l < p->n_link; l++) {
        int i = (int)(s->extra_carrier[2 * l] - p->mesh.n_node - 1);
        const particle *a = &p->particle[i], *b = &p->particle[s->extra_carrier[2 * l + 1] - p->mesh.n_node - 1];
        solid first = solid_at(&a->shape, &a->at), second = solid_at(&b->shape, &b->at);
        double n[3] = {0}, back[3], gap = separation(p, a, b, n);

        for (int k = 0; k < 3; k++)
            back[k] = -n[k];
        gap -=
            solid_support(&first, back) + solid_support(&second, n);
        if (gap < p->pair_range)
            add_pair(p, l, i, b, gap, n);
    }
}
