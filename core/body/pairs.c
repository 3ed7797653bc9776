/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Bodies near each other and near the walls of a box.  The gap along the line of centres is the distance less both
 * bodies' extents in that direction: exact for disks and spheres, and for any body against a wall. */
#include "body/body.h"

#include <math.h>

/* Which sides of a box mesh are walls: some vector field is prescribed there. */
static unsigned walls_of(const bodies *b)
{
    const description *d = b->description;
    const mesh *m = b->space->mesh;
    unsigned walls = 0;

    for (int64_t f = 0; !d->mesh.path && !d->mesh.has_map && f < m->n_facet; f++)
        for (int i = 0; i < d->n_line; i++)
            for (int k = 0; b->conditions->facet[i][f] && k < b->space->n_field; k++)
                if (d->line[i].has_value[k] && b->space->field[k].shape == PF_VECTOR)
                    walls |= (unsigned)m->facet[f].names;
    return walls;
}

/* Distance from y to the nearest image of x, and the unit vector along it. */
static double separation(const bodies *b, const double *x, const double *y, double *n)
{
    double least = INFINITY;
    int dim = b->space->mesh->dim;

    for (int i = 0; i < b->n_image; i++) {
        double r[3], d = 0;

        for (int k = 0; k < dim; k++) {
            r[k] = x[k] + b->image[i][k] - y[k];
            d += r[k] * r[k];
        }
        d = sqrt(d);
        for (int k = 0; d < least && k < dim; k++)
            n[k] = d > 0 ? r[k] / d : k == 0;
        least = fmin(d, least);
    }
    return least;
}

int pairs_link(bodies *b, const pose *at, double drift, error *err)
{
    for (int k = 0; k < b->n && b->pair_range == 0; k++)
        b->pair_range = fmax(b->pair_range, 2 * b->spec[k].shape.radius);
    b->walls = walls_of(b);
    for (int i = 0; b->has_pairs && i < b->n; i++)
        TRY(space_add_link(b->space, i, -1, err));
    for (int i = 0; b->has_pairs && i < b->n; i++)
        for (int j = 0; j < i; j++) {
            double ignored[3];

            if (separation(b, at[i].x, at[j].x, ignored) - b->spec[i].shape.radius - b->spec[j].shape.radius <=
                b->pair_range + drift)
                TRY(space_add_link(b->space, i, j, err));
        }
    return 0;
}

/* The pair of bodies i and j (-1: a wall) of a link, at this gap and normal. */
static void add_pair(const bodies *b, placement *p, int64_t link, int i, int j, double gap, const double *normal)
{
    near_pair *n = &p->pair[p->n_pair++];
    const solid *q = &p->body[i];
    double back[3], reach;

    *n = (near_pair){.group = space_link_group(b->space, link), .particle = i, .gap = gap, .h = b->h_mean};
    n->size[0] = 2 * q->shape->radius;
    n->density[0] = b->spec[i].density;
    n->size[1] = j >= 0 ? 2 * b->spec[j].shape.radius : INFINITY;
    n->density[1] = j >= 0 ? b->spec[j].density : 0;
    for (int k = 0; k < 3; k++)
        back[k] = -normal[k];
    reach = solid_support(q, back) + 0.5 * gap;
    for (int k = 0; k < b->space->mesh->dim; k++) {
        n->normal[k] = normal[k];
        n->at[k] = q->at.x[k] - reach * normal[k];
    }
}

static void near_walls(const bodies *b, placement *p, int k)
{
    const mesh_box *box = &b->description->mesh.box;
    const solid *q = &p->body[k];

    for (int side = 0; side < 2 * b->space->mesh->dim; side++) {
        int axis = side / 2;
        double n[3] = {0}, gap;

        if (!(b->walls >> side & 1))
            continue;
        n[axis] = side % 2 ? -1 : 1;
        gap = (side % 2 ? box->high[axis] - q->at.x[axis] : q->at.x[axis] - box->low[axis]) - solid_support(q, n);
        if (gap < b->pair_range)
            add_pair(b, p, k, k, -1, gap, n);
    }
}

int pairs_find(const bodies *b, placement *p, error *err)
{
    const space *s = b->space;

    ARENA_NEW(&p->memory, p->pair, s->n_link + 2 * s->mesh->dim * b->n, err);
    for (int k = 0; s->n_link && k < b->n; k++)
        near_walls(b, p, k);
    for (int64_t l = b->n; l < s->n_link; l++) {
        int i = s->link[l][0], j = s->link[l][1];
        double n[3] = {0}, back[3], gap = separation(b, p->body[i].at.x, p->body[j].at.x, n);

        for (int k = 0; k < 3; k++)
            back[k] = -n[k];
        gap -= solid_support(&p->body[i], back) + solid_support(&p->body[j], n);
        if (gap < b->pair_range)
            add_pair(b, p, l, i, j, gap, n);
    }
    return 0;
}
