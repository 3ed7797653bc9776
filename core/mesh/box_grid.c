/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A box that reaches into several of the buckets that a search looks through is found in the first of them: the one
 * with the lowest number in each direction.  So nothing has to be marked. */
#include "mesh/box_grid.h"

#include <math.h>
#include <string.h>

enum { MOST_BUCKETS = 1000 }; /* in each direction */

/* Number of the bucket of coordinate x; beyond the ends, the last one there. */
static int bucket(const box_grid *g, int k, double x)
{
    double i = floor((x - g->low[k]) / g->width[k]);

    return i >= g->n[k] ? g->n[k] - 1 : i > 0 ? (int)i : 0;
}

/* Range of the buckets that a box reaches into. */
static void range_of(const box_grid *g, int64_t i, int from[3], int to[3])
{
    for (int k = 0; k < 3; k++) {
        const double *low = g->box[i][0], *high = g->box[i][1];
        double margin = k < g->dim ? BOX_GRID_MARGIN * (high[k] - low[k]) : 0;

        from[k] = k < g->dim ? bucket(g, k, low[k] - margin) : 0;
        to[k] = k < g->dim ? bucket(g, k, high[k] + margin) : 0;
    }
}

static int64_t number(const box_grid *g, int x, int y, int z)
{
    return ((int64_t)z * g->n[1] + y) * g->n[0] + x;
}

/* Counts the boxes of each bucket in at[bucket + 1] (list = NULL), or enters them from at[bucket] on. */
static void enter(const box_grid *g, int64_t *at, int32_t *list)
{
    for (int64_t i = 0; i < g->n_box; i++) {
        int from[3], to[3];

        range_of(g, i, from, to);
        for (int z = from[2]; z <= to[2]; z++)
            for (int y = from[1]; y <= to[1]; y++)
                for (int x = from[0]; x <= to[0]; x++)
                    if (list)
                        list[at[number(g, x, y, z)]++] = (int32_t)i;
                    else
                        at[number(g, x, y, z) + 1]++;
    }
}

/* Number of buckets of this width over boxes of this extent, n[k] in each direction. */
static double count(const box_grid *g, const double *extent, double width, int *n)
{
    double all = 1;

    for (int k = 0; k < g->dim; k++) {
        n[k] = (int)fmax(1, fmin(MOST_BUCKETS, floor(extent[k] / width)));
        all *= n[k];
    }
    return all;
}

/* Bounds of all boxes, and how many buckets: of this width, but not many more than there are boxes. */
static int64_t choose(box_grid *g, double width)
{
    double extent[3] = {0};

    for (int k = 0; k < g->dim; k++) {
        double low = INFINITY, high = -INFINITY;

        for (int64_t i = 0; i < g->n_box; i++) {
            low = fmin(low, g->box[i][0][k]);
            high = fmax(high, g->box[i][1][k]);
        }
        g->low[k] = low;
        extent[k] = g->n_box ? high - low : 0;
    }
    width = width > 0 ? width : INFINITY;
    while (count(g, extent, width, g->n) > 4.0 * (double)g->n_box + 64)
        width *= 1.25;
    for (int k = 0; k < g->dim; k++)
        g->width[k] = extent[k] > 0 ? extent[k] / g->n[k] : 1;
    return (int64_t)g->n[0] * g->n[1] * g->n[2];
}

int box_grid_create(box_grid *g, int dim, int64_t n, error *err)
{
    memset(g, 0, sizeof *g);
    g->dim = dim;
    g->n_box = n;
    if (n > INT32_MAX)
        return error_set(err, ERR_MEMORY, "search: %lld boxes are more than this build can number (%d)",
                         (long long)n, INT32_MAX);
    for (int k = 0; k < 3; k++)
        g->n[k] = 1, g->width[k] = 1;
    ARENA_NEW(&g->memory, g->box, n, err);
    return 0;
}

int box_grid_build(box_grid *g, double width, error *err)
{
    int64_t buckets = choose(g, width), *at;

    ARENA_NEW(&g->memory, g->start, buckets + 1, err);
    enter(g, g->start, NULL);
    for (int64_t i = 0; i < buckets; i++)
        g->start[i + 1] += g->start[i];
    ARENA_NEW(&g->memory, g->list, g->start[buckets], err);
    ARENA_NEW(&g->memory, at, buckets, err);
    memcpy(at, g->start, (size_t)buckets * sizeof *at);
    enter(g, at, g->list);
    return 0;
}

void box_grid_destroy(box_grid *g)
{
    arena_free(&g->memory);
    memset(g, 0, sizeof *g);
}

const int32_t *box_grid_at(const box_grid *g, const double *x, int64_t *n)
{
    int at[3] = {0};
    int64_t i;

    for (int k = 0; k < g->dim; k++)
        at[k] = bucket(g, k, x[k]);
    i = number(g, at[0], at[1], at[2]);
    *n = g->start[i + 1] - g->start[i];
    return g->list + g->start[i];
}

static int meets_ball(const box_grid *g, int32_t i, const double *x, double radius)
{
    double d2 = 0;

    for (int k = 0; k < g->dim; k++) {
        double d = fmax(0, fmax(g->box[i][0][k] - x[k], x[k] - g->box[i][1][k]));

        d2 += isnan(x[k]) ? NAN : d * d;
    }
    return d2 <= radius * radius;
}

/* Whether bucket `at` is the first that box i reaches into of those from `from` on. */
static int is_first(const box_grid *g, int32_t i, const int at[3], const int from[3])
{
    int low[3], high[3];

    range_of(g, i, low, high);
    for (int k = 0; k < 3; k++)
        if (at[k] != (low[k] > from[k] ? low[k] : from[k]))
            return 0;
    return 1;
}

void box_grid_ball(const box_grid *g, const double *x, double radius, void (*found)(void *ctx, int32_t i),
                   void *ctx)
{
    int from[3] = {0}, to[3] = {0}, at[3];

    for (int k = 0; k < g->dim; k++) {
        from[k] = bucket(g, k, x[k] - radius);
        to[k] = bucket(g, k, x[k] + radius);
    }
    for (at[2] = from[2]; at[2] <= to[2]; at[2]++)
        for (at[1] = from[1]; at[1] <= to[1]; at[1]++)
            for (at[0] = from[0]; at[0] <= to[0]; at[0]++) {
                int64_t b = number(g, at[0], at[1], at[2]);

                for (int64_t k = g->start[b]; k < g->start[b + 1]; k++)
                    if (meets_ball(g, g->list[k], x, radius) && is_first(g, g->list[k], at, from))
                        found(ctx, g->list[k]);
            }
}
