/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The nearest point of each facet within range is a local minimum of the distance from all walls if it lies inside
 * the facet, or on an edge or vertex while no facet that joins there is nearer. */
#include "mesh/wall.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define ONE_WALL 0.9659258262890683 /* cos(15 degrees): normals of one wall */
#define JOINED   1e-7               /* vertices are one, in sizes of a facet */
#define EQUAL    1e-9               /* distances are equal, in sizes of a facet */

int wall_create(wall *w, const mesh *m, const uint8_t *on, error *err)
{
    double size = 0;
    int64_t n = 0;

    memset(w, 0, sizeof *w);
    w->mesh = m;
    w->n_image = mesh_images(m, w->image);
    for (int64_t i = 0; i < m->n_facet; i++)
        w->n += on[i] != 0;
    ARENA_NEW(&w->memory, w->number, w->n, err);
    ARENA_NEW(&w->memory, w->facet, w->n, err);
    TRY(box_grid_create(&w->grid, m->dim, w->n, err));
    for (int64_t i = 0; i < m->n_facet; i++)
        if (on[i]) {
            TRY(facet_create(&w->facet[n], m, i, w->grid.box[n], err));
            size += w->facet[n].size;
            w->number[n++] = (int32_t)i;
        }
    return box_grid_build(&w->grid, n ? 2 * size / (double)n : 1, err);
}

void wall_destroy(wall *w)
{
    box_grid_destroy(&w->grid);
    arena_free(&w->memory);
    memset(w, 0, sizeof *w);
}

/* A facet, or an image of it, and its point nearest to the place. */
typedef struct candidate {
    int32_t facet, image;
    facet_point at;
} candidate;

typedef struct search {
    const wall *w;
    const double *x;
    double range, seen_from[3]; /* the place as the image has it */
    int32_t image;
    candidate *list;
    int64_t n, room;
    int failed;
} search;

static void look_at(void *ctx, int32_t i)
{
    search *s = ctx;
    candidate c = {.facet = i, .image = s->image};

    facet_nearest(&s->w->facet[i], s->seen_from, &c.at);
    if (c.at.distance > s->range)
        return;
    if (s->n == s->room) {
        int64_t room = 2 * s->room + 64;
        candidate *more = realloc(s->list, (size_t)room * sizeof *more);

        if (!more) {
            s->failed = 1;
            return;
        }
        s->list = more;
        s->room = room;
    }
    for (int k = 0; k < s->w->mesh->dim; k++)
        c.at.x[k] += s->w->image[s->image][k];
    s->list[s->n++] = c;
}

static int by_distance(const void *a, const void *b)
{
    const candidate *p = a, *q = b;

    if (p->at.distance != q->at.distance)
        return p->at.distance < q->at.distance ? -1 : 1;
    return p->facet != q->facet ? (p->facet > q->facet) - (p->facet < q->facet) : p->image - q->image;
}

/* Place of a vertex of the facet of c. */
static void vertex_of(const search *s, const candidate *c, int vertex, double *x)
{
    facet_vertex(&s->w->facet[c->facet], vertex, x);
    for (int k = 0; k < 3; k++)
        x[k] += s->w->image[c->image][k];
}

static int has_vertex(const search *s, const candidate *c, const double *x, double margin)
{
    const double(*box)[3] = (const double(*)[3])s->w->grid.box[c->facet], *shift = s->w->image[c->image];

    for (int k = 0; k < s->w->mesh->dim; k++)
        if (x[k] < box[0][k] + shift[k] - margin || x[k] > box[1][k] + shift[k] + margin)
            return 0;
    for (int i = 0; i < facet_n_vertex(&s->w->facet[c->facet]); i++) {
        double v[3], d = 0;

        vertex_of(s, c, i, v);
        for (int k = 0; k < 3; k++)
            d = fmax(d, fabs(v[k] - x[k]));
        if (d <= margin)
            return 1;
    }
    return 0;
}

/* Whether the facet of `other` joins that of c where the nearest point of c is. */
static int joins(const search *s, const candidate *c, const candidate *other)
{
    for (int i = 0; i < c->at.n_vertex; i++) {
        double x[3];

        vertex_of(s, c, c->at.vertex[i], x);
        if (!has_vertex(s, other, x, JOINED * s->w->facet[c->facet].size))
            return 0;
    }
    return c->at.n_vertex > 0;
}

/* Whether candidate i, of a list in ascending order, is a local minimum. */
static int is_minimum(const search *s, int64_t i)
{
    const candidate *c = &s->list[i];
    double least = c->at.distance - EQUAL * s->w->facet[c->facet].size;

    for (int64_t k = 0; c->at.n_vertex && k < i && s->list[k].at.distance < least; k++)
        if (joins(s, c, &s->list[k]))
            return 0;
    return 1;
}

/* Normal and signed distance at a minimum.  On an edge or vertex the side is that of the sum of the normals of all
 * facets that join there, and the normal the direction to the place. */
static wall_point point_of(const search *s, int64_t at)
{
    const candidate *c = &s->list[at];
    const mesh_facet *b = &s->w->mesh->facet[s->w->number[c->facet]];
    double equal = EQUAL * s->w->facet[c->facet].size, size = 0, way[3] = {0}, side = 0;
    wall_point p = {.distance = c->at.distance, .facet = s->w->number[c->facet], .boundary = -1};

    for (int i = 0; i < MESH_MAX_NAMES && p.boundary < 0; i++)
        p.boundary = b->names >> i & 1 ? i : -1;
    memcpy(p.x, c->at.x, sizeof p.x);
    facet_normal(&s->w->facet[c->facet], c->at.s, p.normal);
    for (int64_t k = 0; c->at.n_vertex && k < s->n && s->list[k].at.distance <= c->at.distance + equal; k++)
        if (k != at && joins(s, c, &s->list[k])) {
            double n[3];

            facet_normal(&s->w->facet[s->list[k].facet], s->list[k].at.s, n);
            for (int i = 0; i < 3; i++)
                p.normal[i] += n[i];
        }
    for (int k = 0; k < s->w->mesh->dim; k++) {
        way[k] = s->x[k] - p.x[k];
        side += way[k] * p.normal[k];
        size += p.normal[k] * p.normal[k];
    }
    p.distance = side < 0 ? -p.distance : p.distance;
    for (int k = 0; k < 3; k++)
        p.normal[k] = c->at.n_vertex && c->at.distance > equal ? way[k] / p.distance
                      : size > 0                               ? p.normal[k] / sqrt(size)
                                                               : 0;
    return p;
}

static int is_new(const wall_point *list, int n, const wall_point *p)
{
    if (n > 0 && p->distance < 0)
        return 0;
    for (int i = 0; i < n; i++)
        if (p->normal[0] * list[i].normal[0] + p->normal[1] * list[i].normal[1] + p->normal[2] * list[i].normal[2] >
            ONE_WALL)
            return 0;
    return 1;
}

int wall_near(const wall *w, const double *x, double range, int most, wall_point *list, int *n, error *err)
{
    search s = {.w = w, .x = x, .range = range};

    *n = 0;
    for (s.image = 0; s.image < w->n_image; s.image++) {
        for (int k = 0; k < w->mesh->dim; k++)
            s.seen_from[k] = x[k] - w->image[s.image][k];
        box_grid_ball(&w->grid, s.seen_from, range, look_at, &s);
    }
    if (!s.failed && s.n > 0)
        qsort(s.list, (size_t)s.n, sizeof *s.list, by_distance);
    for (int64_t i = 0; !s.failed && i < s.n && *n < most; i++)
        if (is_minimum(&s, i)) {
            wall_point p = point_of(&s, i);

            if (is_new(list, *n, &p))
                list[(*n)++] = p;
        }
    free(s.list);
    return s.failed ? error_memory(err, "walls near a body", (double)s.room * (double)sizeof *s.list) : 0;
}
