/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The domain ends at the facets that only one cell has.  In 2D they are the lines themselves;
 * in 3D they are cut into triangles, and the lines are the sections of these with the plane. */
#include "io/picture_parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct facet {
    size_t key[3]; /* the smallest vertices in order: no two facets share three (2D: two) */
    size_t cell;
    int number;
} facet;

static int by_key(const void *a, const void *b)
{
    const facet *p = a, *q = b;

    for (int k = 0; k < 3; k++)
        if (p->key[k] != q->key[k])
            return p->key[k] < q->key[k] ? -1 : 1;
    return 0;
}

static void facet_of(const fe_cell *cell, const size_t *point, size_t c, int number, facet *f)
{
    size_t key[4] = {0};

    for (int i = 0; i < cell->facet_vertices; i++) {
        size_t p = point[cell->facet[number][i]];
        int j = i;

        for (; j > 0 && key[j - 1] > p; j--)
            key[j] = key[j - 1];
        key[j] = p;
    }
    memcpy(f->key, key, sizeof f->key);
    f->cell = c;
    f->number = number;
}

/* In 3D only cells near the plane count. */
static int near_plane(const vtu_file *v, const picture_view *view, size_t c)
{
    double low[3], high[3], bulge;

    if (view->dim == 2)
        return 1;
    patch_box(v, c, low, high);
    bulge = 0.1 * fmax(high[0] - low[0], fmax(high[1] - low[1], high[2] - low[2]));
    return low[view->normal] - bulge <= view->at && high[view->normal] + bulge >= view->at;
}

/* Facets of one cell, first in the list. */
static int facets_find(const vtu_file *v, const picture_view *view, arena *a, facet **list, size_t *n, error *err)
{
    size_t point[FE_MAX_NODES], room = 0, m = 0, single = 0;
    facet *f;

    for (size_t c = 0; c < v->n_cell; c++)
        if (near_plane(v, view, c))
            room += (size_t)vtu_cell(v, c, point)->n_facet;
    ARENA_NEW(a, f, room, err);
    for (size_t c = 0; c < v->n_cell; c++) {
        const fe_cell *cell = vtu_cell(v, c, point);

        for (int i = 0; near_plane(v, view, c) && i < cell->n_facet; i++)
            facet_of(cell, point, c, i, f + m++);
    }
    if (m)
        qsort(f, m, sizeof *f, by_key);
    for (size_t i = 0, j; i < m; i = j) {
        for (j = i + 1; j < m && !by_key(f + i, f + j);)
            j++;
        if (j == i + 1)
            f[single++] = f[i];
    }
    *list = f;
    *n = single;
    return 0;
}

static int segment_add(picture_outline *o, const picture_view *view, const double *from, const double *to,
                       error *err)
{
    const double *end[2] = {from, to};

    if (o->n == o->room) {
        size_t room = o->room ? 2 * o->room : 1024;
        double(*more)[4] = realloc(o->segment, room * sizeof *more);

        if (!more)
            return error_memory(err, "outline", (double)room * (double)sizeof *more);
        o->segment = more;
        o->room = room;
    }
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 2; k++) {
            double x = end[i][view->across[k]];

            o->segment[o->n][2 * i + k] = x;
            o->low[k] = fmin(o->low[k], x);
            o->high[k] = fmax(o->high[k], x);
        }
    o->n++;
    return 0;
}

/* The point of the facet between its vertices: (s, t) from the first to the second and third. */
static void facet_point(const vtu_file *v, const facet *f, double s, double t, double x[3])
{
    size_t point[FE_MAX_NODES];
    const fe_cell *cell = vtu_cell(v, f->cell, point);
    const int *q = cell->facet[f->number];
    double xi[3], n[FE_MAX_NODES], dn[FE_MAX_NODES][3];

    for (int k = 0; k < 3; k++)
        xi[k] = cell->x[q[0]][k] + s * (cell->x[q[1]][k] - cell->x[q[0]][k]) +
                (cell->dim == 3 ? t * (cell->x[q[2]][k] - cell->x[q[0]][k]) : 0);
    fe_basis(cell, 2, xi, n, dn);
    for (int k = 0; k < 3; k++) {
        x[k] = 0;
        for (int i = 0; i < cell->n_node; i++)
            x[k] += n[i] * vtu_number(&v->point, 3 * point[i] + (size_t)k);
    }
}

/* A straight edge is one segment. */
static int edge_add(const vtu_file *v, const picture_view *view, const facet *f, int n, picture_outline *o,
                    error *err)
{
    double from[3], to[3], a[3], b[3], m[3], bend = 0, length = 0;

    facet_point(v, f, 0, 0, a);
    facet_point(v, f, 0.5, 0, m);
    facet_point(v, f, 1, 0, b);
    for (int k = 0; k < 3; k++) {
        bend += fabs(0.5 * (a[k] + b[k]) - m[k]);
        length += fabs(b[k] - a[k]);
    }
    n = bend < 1e-6 * length ? 1 : n;
    for (int i = 0; i < n; i++) {
        facet_point(v, f, (double)i / n, 0, from);
        facet_point(v, f, (double)(i + 1) / n, 0, to);
        TRY(segment_add(o, view, from, to, err));
    }
    return 0;
}

/* Triangles (i, j), (i+1, j), (i, j+1) and the other halves of the squares, of which a
 * triangular facet has those below its long side. */
static int face_add(const vtu_file *v, const picture_view *view, const facet *f, int n, picture_outline *o,
                    error *err)
{
    size_t point[FE_MAX_NODES];
    int simplex = vtu_cell(v, f->cell, point)->simplex;

    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++)
            for (int half = 0; half < 2; half++) {
                picture_point p[3] = {0}, s[4];
                const picture_point *const corner[3] = {p, p + 1, p + 2};

                if (simplex && i + j + half >= n)
                    continue;
                facet_point(v, f, (double)(i + half) / n, (double)(j + half) / n, p[0].x);
                facet_point(v, f, (double)(i + 1) / n, (double)j / n, p[1].x);
                facet_point(v, f, (double)i / n, (double)(j + 1) / n, p[2].x);
                if (patch_section(view, corner, 3, s) == 2)
                    TRY(segment_add(o, view, s[0].x, s[1].x, err));
            }
    return 0;
}

static int lines_make(const vtu_file *v, const picture_view *view, picture_outline *o, arena *a, error *err)
{
    facet *f;
    size_t n;
    int parts;

    TRY(facets_find(v, view, a, &f, &n, err));
    parts = n > 5000 ? 2 : n > 1000 ? 4 : n > 200 ? 8 : 16;
    for (size_t i = 0; i < n; i++)
        TRY(view->dim == 2 ? edge_add(v, view, f + i, parts, o, err) : face_add(v, view, f + i, parts, o, err));
    if (!o->n && view->dim == 3)
        return error_set(err, ERR_USAGE, "the plane %c = %g does not meet the domain", 'x' + view->normal,
                         view->at);
    if (!o->n)
        return error_set(err, ERR_IO, "the cells have no boundary");
    for (int k = 0; k < 2; k++)
        if (!(o->high[k] > o->low[k]))
            return error_set(err, ERR_IO, "the domain has no extent along %c: it lies at %g", 'x' + view->across[k],
                             o->low[k]);
    return 0;
}

int outline_make(const vtu_file *v, const picture_view *view, picture_outline *o, error *err)
{
    arena a = {0};
    int status;

    memset(o, 0, sizeof *o);
    for (int k = 0; k < 2; k++) {
        o->low[k] = INFINITY;
        o->high[k] = -INFINITY;
    }
    status = lines_make(v, view, o, &a, err);
    arena_free(&a);
    if (status)
        outline_free(o);
    return status;
}

void outline_free(picture_outline *o)
{
    free(o->segment);
    memset(o, 0, sizeof *o);
}
