/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What bodies near a point do to the path through it (paths.c).  A grid has the bodies that may be near, and of
 * these each one's distance is found once. */
#include "body/body.h"

#include <math.h>
#include <string.h>

enum { MOST_KEPT = 256 }; /* distances at a point; those of further bodies are found again where they are needed */

static double away(const moving_body *b, const double *x)
{
    double d = 0;

    for (int k = 0; k < b->here.shape->dim; k++)
        d += (x[k] - b->here.at.x[k]) * (x[k] - b->here.at.x[k]);
    return sqrt(d) - b->here.shape->radius;
}

/* Distance from a body: the larger of two lower bounds, to first order (level over its slope) and from its ball; 0
 * inside.  Of a disk or sphere the second is exact. */
static double distance(const moving_body *b, const double *x)
{
    double g[3] = {0}, size = 0, level;

    if (b->round)
        return fmax(away(b, x), 0);
    level = solid_level(&b->here, x);
    if (level <= 0)
        return 0;
    solid_slope(&b->here, x, g);
    for (int k = 0; k < b->here.shape->dim; k++)
        size += g[k] * g[k];
    return fmax(level / sqrt(size), away(b, x));
}

/* Bodies that may be near a point, and how far they are: at least `far` where they do not matter. */
typedef struct near_bodies {
    const body_paths *paths;
    const double *x;
    double far, distance[MOST_KEPT];
    int64_t n;
    const int32_t *body;
} near_bodies;

static double find_distance(const near_bodies *p, int64_t i)
{
    const moving_body *b = &p->paths->body[p->body[i]];

    return away(b, p->x) < p->far ? distance(b, p->x) : p->far;
}

static double distance_of(const near_bodies *p, int64_t i)
{
    return i < MOST_KEPT ? p->distance[i] : find_distance(p, i);
}

static near_bodies find_near(const body_paths *t, const double *x, double far)
{
    near_bodies p = {.paths = t, .x = x, .far = far, .n = t->n, .body = t->all};

    if (t->near.n_box)
        p.body = box_grid_at(&t->near, x, &p.n);
    for (int64_t i = 0; i < p.n && i < MOST_KEPT; i++)
        p.distance[i] = find_distance(&p, i);
    return p;
}

static double smooth(double s)
{
    return s >= 1 ? 1 : s * s * (3 - 2 * s);
}

/* Share of body i in the path through x: 1 at its surface, 0 from `reach` on; less where another body is less than
 * twice as far, and none at that one. */
static double share(const near_bodies *p, int64_t i, double reach)
{
    double d = distance_of(p, i), s = 1 - smooth(d / reach);

    for (int64_t k = 0; s > 0 && d > 0 && k < p->n; k++) {
        double e = distance_of(p, k);

        s *= k != i && e < 2 * d ? smooth(e / (2 * d)) : 1;
    }
    return s;
}

/* How far the point of a body that is at x now has come since level l. */
void paths_travelled(const moving_body *b, int l, const double *x, double *d)
{
    int dim = b->here.shape->dim;
    double own[3] = {0};

    for (int i = 0; i < dim; i++)
        for (int k = 0; k < dim; k++)
            own[i] += b->here.axes[k][i] * (x[k] - b->here.at.x[k]);
    for (int k = 0; k < dim; k++) {
        d[k] = b->way[l][k] + x[k] - b->here.at.x[k];
        for (int i = 0; i < dim; i++)
            d[k] -= b->then[l][k][i] * own[i];
    }
}

/* Where the path through x was at each level: x - way; 0: it rests. */
int paths_find(const body_paths *t, const double *x, double reach, double way[PATHS_MAX_LEVELS][3])
{
    near_bodies near;
    int any = 0;

    memset(way, 0, PATHS_MAX_LEVELS * sizeof *way);
    near = find_near(t, x, 2 * reach);
    for (int64_t i = 0; i < near.n; i++) {
        const moving_body *b = &t->body[near.body[i]];
        double s = b->moves ? share(&near, i, reach) : 0, d[3];

        for (int l = 0; s > 0 && l < t->levels; l++) {
            paths_travelled(b, l, x, d);
            for (int k = 0; k < b->here.shape->dim; k++)
                way[l][k] += s * d[k];
        }
        any |= s > 0;
    }
    return any;
}

const moving_body *paths_below(const body_paths *t, const double *x)
{
    int64_t n = t->n;
    const int32_t *body = t->near.n_box ? box_grid_at(&t->near, x, &n) : t->all;

    for (int64_t i = 0; i < n; i++) {
        const moving_body *b = &t->body[body[i]];

        if (b->moves && away(b, x) < 0 && distance(b, x) == 0)
            return b;
    }
    return NULL;
}

void paths_list(body_paths *t, int dim, double reach)
{
    error ignored; /* without memory for the grid all bodies may be near everywhere */
    double width = 0;

    box_grid_destroy(&t->near);
    if (box_grid_create(&t->near, dim, t->n, &ignored)) {
        t->near.n_box = 0;
        return;
    }
    for (int i = 0; i < t->n; i++) {
        const solid *q = &t->body[i].here;

        for (int k = 0; k < dim; k++) {
            t->near.box[i][0][k] = q->at.x[k] - q->shape->radius - 2 * reach;
            t->near.box[i][1][k] = q->at.x[k] + q->shape->radius + 2 * reach;
        }
        width = fmax(width, q->shape->radius + 0.5 * reach);
    }
    if (box_grid_build(&t->near, width, &ignored))
        t->near.n_box = 0;
}
