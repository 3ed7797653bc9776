/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Triangles to pixels.  A pixel takes the value that is linear on the triangle over its
 * centre.  Neighbours that are cut differently fit together only nearly: a triangle also takes
 * the free pixels that lie beside it by a fraction of a pixel, so that no seam can show. */
#include "io/picture_parts.h"

#include <math.h>

/* Longest side of a piece of a cell, pixels. */
static const double piece_2d = 8, piece_3d = 12;

/* Pixels first..end of 0..n whose centres lie in low..high. */
static void centres(double low, double high, int n, int *first, int *end)
{
    *first = (int)fmax(0, fmin(n, ceil(low - 0.5)));
    *end = (int)fmin(n, fmax(0, floor(high - 0.5) + 1));
}

/* Width of the seams that are closed, pixels. */
static const double seam = 0.35;

typedef struct painter {
    picture_raster *r;
    const picture_view *view;
} painter;

static void count_value(picture_raster *r, double v)
{
    if (isfinite(v)) {
        r->low = fmin(r->low, v);
        r->high = fmax(r->high, v);
    }
}

/* Whether a place, in pixels, lies in a body. */
static int is_solid(const picture_raster *r, double x, double y)
{
    size_t i = (size_t)fmax(0, fmin(r->w - 1, floor(x))), j = (size_t)fmax(0, fmin(r->h - 1, floor(y)));

    return r->solid && r->solid[j * (size_t)r->w + i];
}

/* The triangle in pixels. */
typedef struct corners {
    double x[3], y[3], area; /* area: twice that, with its sign                        */
    double slack[3];         /* the barycentric coordinates at seam pixels outside     */
} corners;

static void corners_of(const painter *t, const picture_point *const *p, corners *q)
{
    const picture_raster *r = t->r;

    for (int k = 0; k < 3; k++) {
        q->x[k] = (p[k]->x[t->view->across[0]] - r->left) * r->scale[0];
        q->y[k] = (r->top - p[k]->x[t->view->across[1]]) * r->scale[1];
    }
    q->area = (q->x[1] - q->x[0]) * (q->y[2] - q->y[0]) - (q->x[2] - q->x[0]) * (q->y[1] - q->y[0]);
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;

        q->slack[k] = seam * hypot(q->x[j] - q->x[i], q->y[j] - q->y[i]) / fabs(q->area);
    }
}

/* Barycentric coordinates of the pixel's centre.  2: it lies in the triangle, 1: beside it by
 * less than a seam, and w is moved onto the edge; 0: outside. */
static int locate(const corners *q, int i, int j, double w[3])
{
    double s = i + 0.5 - q->x[0], u = j + 0.5 - q->y[0], sum = 0;
    int inside = 2;

    w[1] = (s * (q->y[2] - q->y[0]) - (q->x[2] - q->x[0]) * u) / q->area;
    w[2] = ((q->x[1] - q->x[0]) * u - s * (q->y[1] - q->y[0])) / q->area;
    w[0] = 1 - w[1] - w[2];
    for (int k = 0; k < 3; k++) {
        if (!(w[k] >= -q->slack[k]))
            return 0;
        if (w[k] < -1e-6)
            inside = 1;
        w[k] = fmax(w[k], 0);
        sum += w[k];
    }
    for (int k = 0; k < 3; k++)
        w[k] /= sum;
    return inside;
}

static void paint(void *to, const picture_point *a, const picture_point *b, const picture_point *c)
{
    const painter *t = to;
    picture_raster *r = t->r;
    const picture_point *p[3] = {a, b, c};
    corners q;
    int i0, i1, j0, j1;

    corners_of(t, p, &q);
    for (int k = 0; k < 3; k++)
        if (!is_solid(r, q.x[k], q.y[k]))
            count_value(r, p[k]->value[0]);
    if (!(fabs(q.area) > 1e-100))
        return;
    centres(fmin(q.x[0], fmin(q.x[1], q.x[2])) - seam, fmax(q.x[0], fmax(q.x[1], q.x[2])) + seam, r->w, &i0, &i1);
    centres(fmin(q.y[0], fmin(q.y[1], q.y[2])) - seam, fmax(q.y[0], fmax(q.y[1], q.y[2])) + seam, r->h, &j0, &j1);
    for (int j = j0; j < j1; j++)
        for (int i = i0; i < i1; i++) {
            size_t at = (size_t)j * (size_t)r->w + (size_t)i;
            double w[3];
            int inside = locate(&q, i, j, w);

            if (inside == 2 && r->solid && !r->solid[at]) /* up to a surface between the corners */
                count_value(r, w[0] * a->value[0] + w[1] * b->value[0] + w[2] * c->value[0]);
            for (int k = 0; k < r->n_value; k++)
                if (inside == 2 || (inside == 1 && isnan(r->value[k][at])))
                    r->value[k][at] = (float)(w[0] * a->value[k] + w[1] * b->value[k] + w[2] * c->value[k]);
        }
}

/* An even number of pieces, so that the nodes are among the points. */
static int pieces(double pixels, double piece, int most)
{
    int n = 2 * (int)fmin(ceil(pixels / (2 * piece)), most / 2);

    return n < 2 ? 2 : n;
}

int raster_make(const vtu_file *v, const picture_view *view, const picture_field *f, picture_raster *r, arena *a,
                error *err)
{
    painter t = {r, view};
    picture_patch *patch;
    size_t n = (size_t)r->w * (size_t)r->h;
    double scale = fmin(r->scale[0], r->scale[1]);

    ARENA_NEW(a, patch, 1, err);
    for (int k = 0; k < r->n_value; k++) {
        ARENA_NEW(a, r->value[k], n, err);
        for (size_t i = 0; i < n; i++)
            r->value[k][i] = NAN;
    }
    r->low = INFINITY;
    r->high = -INFINITY;
    for (size_t c = 0; c < v->n_cell; c++) {
        double low[3], high[3], size = 0, bulge;

        if (patch_body(v, c) >= 0)
            continue;
        patch_box(v, c, low, high);
        for (int k = 0; k < 3; k++)
            size = fmax(size, high[k] - low[k]);
        bulge = 0.1 * size; /* curved faces may reach beyond the nodes */
        if (view->dim == 3 && (low[view->normal] - bulge > view->at || high[view->normal] + bulge < view->at))
            continue;
        patch_triangles(v, view, f, c,
                        view->dim == 2 ? pieces(size * scale, piece_2d, PATCH_MAX_2D)
                                       : pieces(size * scale, piece_3d, PATCH_MAX_3D),
                        patch, paint, &t);
    }
    return 0;
}
