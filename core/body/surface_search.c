/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The point of a body's surface where a function is least.  The surface is seen from the centre: directions
 *
 *     (a cos s, b sin s)   or   (a cos t cos s, b cos t sin s, c sin t),   a, b, c half widths,
 *
 * each with the outermost point of the body that lies there.  The best of a grid of directions is the start of a
 * search with ever smaller steps.  Such a search stops short on an edge that it runs into, so edges of blocks and
 * rims of cylinders are searched by themselves. */
#include "body/places.h"

#include <math.h>
#include <string.h>

enum { AROUND_2D = 96, AROUND_3D = 32, UP_3D = 15, ALONG = 16, OUTWARD = 48, BISECTIONS = 52, MOST_TRIES = 300 };

#define SMALLEST 1e-9 /* step of the search */

typedef struct search {
    const solid *b;
    double (*f)(const void *ctx, const double *x);
    const void *ctx;
    double part;
    double best, at[3];
} search;

/* Whether the part r of the way from the centre along own coordinates d[3] ends inside. */
static int is_inside(const shape *s, const double *d, double r)
{
    double x[3] = {0};

    for (int k = 0; k < s->dim; k++)
        x[k] = r * d[k];
    return shape_level(s, x) < 0;
}

/* Part of that way at which the body ends. */
static double reach(const shape *s, const double *d)
{
    const double size = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    double in = 0, out = 1.001 * s->radius / size;

    if (s->kind == SHAPE_DISTANCE) /* it may have bays: from outside to the first point inside */
        for (int i = OUTWARD - 1; i > 0 && in == 0; i--) {
            double r = 1.001 * s->radius / size * i / OUTWARD;

            if (is_inside(s, d, r))
                in = r;
            else
                out = r;
        }
    for (int i = 0; i < BISECTIONS; i++) {
        double r = 0.5 * (in + out);

        if (is_inside(s, d, r))
            in = r;
        else
            out = r;
    }
    return 0.5 * (in + out);
}

/* Looks at a point in own coordinates, drawn towards the centre; 1: it is better. */
static int look(search *s, const double *own)
{
    const int dim = s->b->shape->dim;
    double x[3] = {0}, v;

    for (int i = 0; i < dim; i++) {
        x[i] = s->b->at.x[i];
        for (int j = 0; j < dim; j++)
            x[i] += s->b->axes[i][j] * s->part * own[j];
    }
    v = s->f(s->ctx, x);
    if (!(v < s->best))
        return 0;
    s->best = v;
    memcpy(s->at, x, sizeof x);
    return 1;
}

/* The point of the surface in the direction of two angles. */
static int look_along(search *s, const double *angle)
{
    const shape *q = s->b->shape;
    const double flat = q->dim == 2 ? 1 : cos(angle[1]);
    double d[3] = {q->half[0] * cos(angle[0]) * flat, q->half[1] * sin(angle[0]) * flat, 0}, r;

    d[2] = q->dim == 2 ? 0 : q->half[2] * sin(angle[1]);
    r = reach(q, d);
    for (int k = 0; k < 3; k++)
        d[k] *= r;
    return look(s, d);
}

/* From the best of a grid of directions on. */
static void search_directions(search *s)
{
    const int flat = s->b->shape->dim == 2, around = flat ? AROUND_2D : AROUND_3D, up = flat ? 1 : UP_3D;
    double angle[2] = {0}, step = 2 * M_PI / around;

    for (int i = 0; i < around; i++)
        for (int j = 0; j < up; j++) {
            const double to[2] = {2 * M_PI * i / around, flat ? 0 : M_PI * (j - up / 2) / (up - 1)};

            if (look_along(s, to))
                memcpy(angle, to, sizeof angle);
        }
    for (int i = 0; i < MOST_TRIES && step > SMALLEST; i++) {
        const double from[2] = {angle[0], angle[1]};
        int better = 0;

        for (int p = -1; p <= 1; p++)
            for (int q = flat ? 0 : -1; q <= (flat ? 0 : 1); q++) {
                const double to[2] = {from[0] + p * step, from[1] + q * step};

                if ((p || q) && look_along(s, to)) {
                    memcpy(angle, to, sizeof angle);
                    better = 1;
                }
            }
        step *= better ? 1 : 0.5;
    }
}

/* Point t, -1..1, of an edge of a block (12 of them), or of a rim of a cylinder (2), in own coordinates. */
static void edge_point(const shape *s, int edge, double t, double *x)
{
    const int axis = edge / 4;

    if (s->kind == SHAPE_CYLINDER) {
        x[0] = s->half[0] * cos(M_PI * t);
        x[1] = s->half[0] * sin(M_PI * t);
        x[2] = edge ? s->half[2] : -s->half[2];
        return;
    }
    x[axis] = t * s->half[axis];
    x[(axis + 1) % 3] = edge & 1 ? s->half[(axis + 1) % 3] : -s->half[(axis + 1) % 3];
    x[(axis + 2) % 3] = edge & 2 ? s->half[(axis + 2) % 3] : -s->half[(axis + 2) % 3];
}

static void search_edge(search *s, int edge)
{
    double best = 0, step = 2.0 / ALONG, x[3];
    int any = 0;

    for (int i = 0; i <= ALONG; i++) {
        edge_point(s->b->shape, edge, -1 + i * step, x);
        if (look(s, x)) {
            best = -1 + i * step;
            any = 1;
        }
    }
    for (int i = 0; any && i < MOST_TRIES && step > SMALLEST; i++) {
        const double from = best;
        int better = 0;

        for (int p = -1; p <= 1; p += 2) {
            const double to = fmin(1, fmax(-1, from + p * step));

            edge_point(s->b->shape, edge, to, x);
            if (look(s, x)) {
                best = to;
                better = 1;
            }
        }
        step *= better ? 1 : 0.5;
    }
}

double surface_least(const solid *b, double (*f)(const void *ctx, const double *x), const void *ctx, double part,
                     double *at)
{
    search s = {.b = b, .f = f, .ctx = ctx, .part = part, .best = INFINITY};
    int edges = b->shape->kind == SHAPE_CYLINDER ? 2 : b->shape->kind == SHAPE_BOX && b->shape->dim == 3 ? 12 : 0;

    search_directions(&s);
    for (int i = 0; i < edges; i++)
        search_edge(&s, i);
    memcpy(at, s.at, sizeof s.at);
    return s.best;
}

double surface_slack(const shape *s)
{
    return 1e-9 * (s->kind == SHAPE_DISTANCE ? s->thickness : 1);
}
