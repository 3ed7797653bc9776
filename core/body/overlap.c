/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Bodies that start within each other, also through periodic boundaries.  Two round bodies overlap where their
 * centres are nearer than the sum of their radii; of others the points of each surface, and points half way to the
 * centre, must not lie inside the other.  Pairs come from a sweep along the direction in which the bodies spread
 * most. */
#include "body/places.h"

#include "base/text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A ball round an image of a body. */
typedef struct ball {
    int body, image; /* image 0: the body itself */
    double x[3], radius, low;
} ball;

typedef struct sweep {
    const description *d;
    int n_image;
    double shift[27][3];
    int64_t n;
    ball *ball;
    int found;
    arena memory;
} sweep;

static int by_low(const void *a, const void *b)
{
    const ball *p = a, *q = b;

    return p->low != q->low     ? (p->low > q->low) - (p->low < q->low)
           : p->body != q->body ? p->body - q->body
                                : p->image - q->image;
}

/* Balls of all bodies and of their images that come near some body. */
static int list_balls(sweep *s, error *err)
{
    const description *d = s->d;
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    int axis = 0;

    for (int i = 0; i < d->n_body; i++)
        for (int k = 0; k < d->dim; k++) {
            low[k] = fmin(low[k], d->body[i].start.x[k] - d->body[i].shape.radius);
            high[k] = fmax(high[k], d->body[i].start.x[k] + d->body[i].shape.radius);
            axis = high[k] - low[k] > high[axis] - low[axis] ? k : axis;
        }
    ARENA_NEW(&s->memory, s->ball, (int64_t)d->n_body * s->n_image, err);
    for (int i = 0; i < d->n_body; i++)
        for (int j = 0; j < s->n_image; j++) {
            ball *b = &s->ball[s->n];
            int near = 1;

            *b = (ball){.body = i, .image = j, .radius = d->body[i].shape.radius};
            for (int k = 0; k < d->dim; k++) {
                b->x[k] = d->body[i].start.x[k] + s->shift[j][k];
                near = near && b->x[k] + b->radius >= low[k] && b->x[k] - b->radius <= high[k];
            }
            b->low = b->x[axis] - b->radius;
            s->n += near;
        }
    qsort(s->ball, (size_t)s->n, sizeof *s->ball, by_low);
    return 0;
}

/* Whether an image lies back along the first period that moves it. */
static int is_back(const sweep *s, int image)
{
    for (int k = 0; k < 3; k++)
        if (s->shift[image][k] != 0)
            return s->shift[image][k] < 0;
    return 0;
}

static int is_round(const shape *s)
{
    return s->kind == SHAPE_ELLIPSOID && s->half[0] == s->half[1] && (s->dim == 2 || s->half[0] == s->half[2]);
}

static double level_of(const void *ctx, const double *x)
{
    return solid_level(ctx, x);
}

typedef struct both {
    const solid *a, *b;
} both;

static double level_of_both(const void *ctx, const double *x)
{
    const both *t = ctx;

    return fmax(solid_level(t->a, x), solid_level(t->b, x));
}

/* How deep the surface of a, or a point half way to it, lies in b; 0: nowhere. */
static double depth_in(const solid *a, const solid *b)
{
    double x[3] = {0}, g[3] = {0}, level = surface_least(a, level_of, b, 1, x), slope = 0, inner[3];
    double small = surface_slack(b->shape);

    if (level > -small) {
        const both t = {a, b}; /* the point may lie in a bay of a */

        level = surface_least(a, level_of_both, &t, 0.5, inner);
        return level < -fmax(small, surface_slack(a->shape)) ? a->shape->thickness : 0;
    }
    solid_slope(b, x, g);
    for (int k = 0; k < b->shape->dim; k++)
        slope += g[k] * g[k];
    return slope > 0 ? fmin(-level / sqrt(slope), b->shape->thickness) : b->shape->thickness;
}

/* By how much two bodies overlap, approximately unless both are round; 0: not at all. */
static double overlap(const sweep *s, const ball *p, const ball *q)
{
    const body_spec *a = &s->d->body[p->body], *b = &s->d->body[q->body];
    double r2 = 0, size = 0, reach = p->radius + q->radius, gap, slack;
    solid one, other;

    for (int k = 0; k < s->d->dim; k++) {
        r2 += (p->x[k] - q->x[k]) * (p->x[k] - q->x[k]);
        size = fmax(size, fmax(fabs(p->x[k]), fabs(q->x[k])));
    }
    gap = sqrt(r2) - reach;
    slack = 1e-12 * reach + 8 * 2.2e-16 * size;
    if (gap >= -slack)
        return 0;
    if (is_round(&a->shape) && is_round(&b->shape))
        return -gap;
    one = solid_at(&a->shape, &a->start);
    other = solid_at(&b->shape, &b->start);
    memcpy(one.at.x, p->x, sizeof one.at.x);
    memcpy(other.at.x, q->x, sizeof other.at.x);
    return fmin(fmax(depth_in(&one, &other), depth_in(&other, &one)), fmin(a->shape.thickness, b->shape.thickness));
}

static void tell(sweep *s, const ball *p, const ball *q, double by)
{
    const int swap = p->body > q->body || (p->body == q->body && p->image > q->image);
    const ball *first = swap ? q : p, *second = swap ? p : q;
    const case_block *a = s->d->body[first->body].block, *b = s->d->body[second->body].block;
    const double *x = s->d->body[first->body].start.x, *y = s->d->body[second->body].start.x;
    const int dim = s->d->dim;

    if (s->found++ >= PLACES_MOST_TOLD)
        return;
    if (first->body == second->body)
        case_wrong(
            s->d->c, a, "at",
            "particle %d at %s overlaps its own image through a periodic boundary by %.3g: it is larger than "
            "the period",
            first->body, text_point(x, dim).s, by);
    else
        case_wrong(s->d->c, b, "at",
                   "particle %d at %s overlaps particle %d at %s (line %d)%s by %.3g; move them apart",
                   second->body, text_point(y, dim).s, first->body, text_point(x, dim).s, a->line,
                   first->image || second->image ? " through a periodic boundary" : "", by);
}

int overlap_check(const description *d, const mesh *m, error *err)
{
    sweep s = {.d = d};
    int status;

    s.n_image = mesh_images(m, s.shift);
    status = list_balls(&s, err);
    for (int64_t i = 0; !status && i < s.n; i++)
        for (int64_t k = i + 1; k < s.n && s.ball[k].low < s.ball[i].low + 2 * s.ball[i].radius; k++) {
            const ball *p = &s.ball[i], *q = &s.ball[k];
            double by;

            if (p->image && q->image) /* this pair is met again, one of the two at its own place */
                continue;
            if (p->body != q->body && (p->body < q->body ? p->image : q->image))
                continue; /* the image is that of the later body */
            if (p->body == q->body && !is_back(&s, p->image ? p->image : q->image))
                continue; /* its images come in pairs */
            by = overlap(&s, p, q);
            if (by > 0)
                tell(&s, p, q, by);
        }
    if (s.found > PLACES_MOST_TOLD)
        case_wrong(d->c, NULL, NULL, "%d more pairs of bodies overlap", s.found - PLACES_MOST_TOLD);
    arena_free(&s.memory);
    return status;
}
