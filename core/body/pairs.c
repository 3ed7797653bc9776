/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Bodies near each other and near walls.  The gap along the line of centres, or from the centre to the nearest
 * place of a wall, is the distance less the bodies' extents in that direction: exact for disks and spheres, and for
 * any body against a plane wall. */
#include "body/body.h"

#include "base/list.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Boundaries where a vector field is prescribed are walls. */
int pairs_find_walls(bodies *b, error *err)
{
    const description *d = b->description;
    const mesh *m = b->space->mesh;
    uint8_t *on = calloc((size_t)m->n_facet + 1, 1);
    int status;

    if (!on)
        return error_memory(err, "walls", (double)m->n_facet);
    for (int64_t f = 0; f < m->n_facet; f++) {
        for (int i = 0; i < d->n_line; i++)
            for (int k = 0; b->conditions->facet[i][f] && k < b->space->n_field; k++)
                on[f] |= d->line[i].has_value[k] && b->space->field[k].shape == PF_VECTOR;
        b->has_walls |= on[f];
    }
    status = b->has_walls ? wall_create(&b->walls, m, on, err) : 0;
    free(on);
    return status;
}

int pairs_create(bodies *b, error *err)
{
    const description *d = b->description;
    const int dim = b->space->mesh->dim;
    double low[3], high[3], across = 0;

    for (int k = 0; k < b->n; k++)
        b->pair_size = fmax(b->pair_size, 2 * b->spec[k].shape.radius);
    for (int64_t e = 0; e < b->space->mesh->n_cell; e++)
        b->h_most = fmax(b->h_most, b->space->mesh->h[e]);
    for (int i = 0; i < d->n_use; i++) {
        const pf_term *t = d->use[i].term;

        if (d->use[i].where == PF_PAIR)
            b->pair_range =
                fmax(b->pair_range, t->reach ? t->reach(d->use[i].params, b->pair_size, b->h_most) : b->pair_size);
    }
    describe_bounds(b->space->mesh, low, high); /* nothing is further apart than its diagonal */
    for (int k = 0; k < dim; k++)
        across += (high[k] - low[k]) * (high[k] - low[k]);
    b->pair_range = fmin(b->pair_range, 2 * sqrt(across));
    return pairs_find_walls(b, err);
}

/* The cell at the middle of a gap, or the fallback where there is none, and its size. */
static void find_cell(const bodies *b, near_pair *n, int64_t fallback)
{
    const mesh *m = b->space->mesh;
    double at[3] = {n->at[0], n->at[1], n->at[2]};
    located l;

    mesh_wrap(m, at);
    l = locate_point(m, b->grid, at);
    if (l.cell < 0 && fallback >= 0 && locate_in_cell(m, fallback, at, l.xi) >= 0)
        l.cell = (int32_t)fallback;
    n->cell = l.cell;
    memcpy(n->ref, l.xi, sizeof n->ref);
    n->h = l.cell >= 0 ? m->h[l.cell] : fallback >= 0 ? m->h[fallback] : b->h_mean;
}

/* Distance from y to the nearest image of x, and the unit vector along it. */
double pairs_separation(const bodies *b, const double *x, const double *y, double *n)
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
    for (int i = 0; b->has_pairs && i < b->n; i++)
        TRY(space_add_link(b->space, i, -1, err));
    for (int i = 0; b->has_pairs && i < b->n; i++)
        for (int j = 0; j < i; j++) {
            double ignored[3];

            if (pairs_separation(b, at[i].x, at[j].x, ignored) - b->spec[i].shape.radius -
                    b->spec[j].shape.radius <=
                b->pair_range + drift)
                TRY(space_add_link(b->space, i, j, err));
        }
    return 0;
}

/* The pair of bodies i and j (-1: a wall, before this cell) of a link, at this gap and normal. */
static int add_pair(const bodies *b, placement *p, int64_t link, int i, int j, int64_t cell, double gap,
                    double distance, const double *normal, int64_t *room, error *err)
{
    const solid *q = &p->body[i];
    near_pair *n;
    double back[3], reach;

    LIST_ROOM(p->pair, p->n_pair, room, err);
    n = &p->pair[p->n_pair++];
    *n = (near_pair){.group = space_link_group(b->space, link), .particle = i, .other = j, .gap = gap};
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
        n->other_centre[k] = j >= 0 ? q->at.x[k] - distance * normal[k] : 0;
    }
    find_cell(b, n, cell);
    return 0;
}

int pairs_walls(const bodies *b, const solid *q, double range, wall_gap *list, int *n, error *err)
{
    wall_point near[PAIRS_MOST_WALLS];
    int found = 0;

    *n = 0;
    if (!b->has_walls)
        return 0;
    TRY(wall_near(&b->walls, q->at.x, q->shape->radius + range, PAIRS_MOST_WALLS, near, &found, err));
    for (int i = 0; i < found; i++) {
        wall_gap *w = &list[*n];
        double back[3] = {-near[i].normal[0], -near[i].normal[1], -near[i].normal[2]};

        w->gap = near[i].distance - solid_support(q, back);
        memcpy(w->normal, near[i].normal, sizeof w->normal);
        w->cell = b->space->mesh->facet[near[i].facet].cell;
        w->boundary = near[i].boundary;
        *n += w->gap < range;
    }
    return 0;
}

int pairs_find(const bodies *b, placement *p, error *err)
{
    const space *s = b->space;
    int64_t room = 0;

    for (int k = 0; s->n_link && k < b->n; k++) {
        wall_gap wall[PAIRS_MOST_WALLS];
        int n;

        TRY(pairs_walls(b, &p->body[k], b->pair_range, wall, &n, err));
        for (int i = 0; i < n; i++)
            TRY(add_pair(b, p, k, k, -1, wall[i].cell, wall[i].gap, 0, wall[i].normal, &room, err));
    }
    for (int64_t l = b->n; l < s->n_link; l++) {
        int i = s->link[l][0], j = s->link[l][1];
        double n[3] = {0}, back[3], apart = pairs_separation(b, p->body[i].at.x, p->body[j].at.x, n), gap = apart;

        for (int k = 0; k < 3; k++)
            back[k] = -n[k];
        gap -= solid_support(&p->body[i], back) + solid_support(&p->body[j], n);
        if (gap < b->pair_range)
            TRY(add_pair(b, p, l, i, j, -1, gap, apart, n, &room, err));
    }
    return 0;
}
