/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Where the plane of a slice cuts the bodies' surfaces.  Each triangle with corners on both sides of the plane is
 * cut along two edges.  A closed surface has every edge twice, so the cuts chain up to closed loops: over the
 * triangle from one of its cuts to the other, over the edge to the next triangle.  Corners in the plane count as
 * above it, which keeps the chains whole. */
#include "io/picture_parts.h"

#include <stdlib.h>

/* A triangle's cut along the edge between two points. */
typedef struct edge_cut {
    size_t low, high; /* the edge's points     */
    size_t triangle;
    int second; /* of the triangle's two */
} edge_cut;

typedef struct section {
    const vtp_file *v;
    const picture_view *view;
    size_t n;      /* cut triangles                                   */
    edge_cut *cut; /* [2 n], by edge                                   */
    size_t *place; /* [2 n] of cut `second` of each triangle in there  */
    char *seen;    /* [n]                                             */
} section;

static int by_edge(const void *a, const void *b)
{
    const edge_cut *p = a, *q = b;

    if (p->low != q->low)
        return p->low < q->low ? -1 : 1;
    if (p->high != q->high)
        return p->high < q->high ? -1 : 1;
    return p->triangle != q->triangle ? (p->triangle < q->triangle ? -1 : 1) : p->second - q->second;
}

static int is_below(const section *s, size_t point)
{
    return s->v->point[point][s->view->normal] < s->view->at;
}

/* Cuts of the triangle, numbered n; 1: the plane cuts it.  cut: NULL to ask only. */
static int cut_triangle(const section *s, size_t c, size_t n, edge_cut *cut)
{
    const size_t *p = s->v->corner + s->v->first[c];
    int m = 0;

    if (s->v->first[c + 1] - s->v->first[c] != 3)
        return 0;
    for (int i = 0; i < 3; i++) {
        size_t a = p[i], b = p[(i + 1) % 3];

        if (is_below(s, a) == is_below(s, b))
            continue;
        if (cut)
            cut[m] = (edge_cut){a < b ? a : b, a < b ? b : a, n, m};
        m++;
    }
    return m == 2;
}

static int find_cuts(section *s, size_t **cell, arena *a, error *err)
{
    size_t n = 0;

    for (size_t c = 0; c < s->v->n_cell; c++)
        s->n += (size_t)cut_triangle(s, c, 0, NULL);
    ARENA_NEW(a, s->cut, 2 * s->n + 1, err);
    ARENA_NEW(a, s->place, 2 * s->n + 1, err);
    ARENA_NEW(a, s->seen, s->n + 1, err);
    ARENA_NEW(a, *cell, s->n + 1, err);
    for (size_t c = 0; c < s->v->n_cell; c++)
        if (cut_triangle(s, c, n, NULL)) {
            cut_triangle(s, c, n, s->cut + 2 * n);
            (*cell)[n++] = c;
        }
    qsort(s->cut, 2 * s->n, sizeof *s->cut, by_edge);
    for (size_t i = 0; i < 2 * s->n; i++)
        s->place[2 * s->cut[i].triangle + (size_t)s->cut[i].second] = i;
    return 0;
}

/* The same edge's cut in the triangle on its other side; SIZE_MAX: there is none. */
static size_t other_side(const section *s, size_t i)
{
    for (size_t j = i ? i - 1 : 0; j <= i + 1 && j < 2 * s->n; j++)
        if (j != i && s->cut[j].low == s->cut[i].low && s->cut[j].high == s->cut[i].high)
            return j;
    return SIZE_MAX;
}

static void cut_point(const section *s, size_t i, double x[2])
{
    const double *a = s->v->point[s->cut[i].low], *b = s->v->point[s->cut[i].high];
    double t = (s->view->at - a[s->view->normal]) / (b[s->view->normal] - a[s->view->normal]);

    for (int k = 0; k < 2; k++)
        x[k] = a[s->view->across[k]] + t * (b[s->view->across[k]] - a[s->view->across[k]]);
}

int section_make(const vtp_file *v, const picture_view *view, picture_bodies *b, arena *a, error *err)
{
    section s = {.v = v, .view = view};
    size_t *cell, n = 0;

    TRY(find_cuts(&s, &cell, a, err));
    ARENA_NEW(a, b->point, s.n + 1, err);
    ARENA_NEW(a, b->loop, s.n + 1, err);
    for (size_t start = 0; start < s.n; start++) {
        picture_loop *l = &b->loop[b->n];
        size_t t = start;
        int leave = 1; /* the cut by which the triangle is left */

        if (s.seen[start])
            continue;
        *l = (picture_loop){.first = n, .id = v->id[cell[start]]};
        while (!s.seen[t]) {
            size_t i = s.place[2 * t + (size_t)leave], next = other_side(&s, i);

            s.seen[t] = 1;
            cut_point(&s, i, b->point[n++]);
            if (next == SIZE_MAX)
                break;
            t = s.cut[next].triangle;
            leave = !s.cut[next].second;
        }
        l->n = n - l->first;
        b->n++;
    }
    return 0;
}
