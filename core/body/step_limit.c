/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * How far a step may carry bodies: no further than the paths of history allow, and no further than the gap to what
 * they meet, or they would pass through it without any numerical sign. */
#include "body/body.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* Displacement of body k, by the shortest way. */
static double way_of(const bodies *b, const pose *from, const pose *to, int k, double *way)
{
    const mesh *m = b->space->mesh;
    double d = 0;

    for (int i = 0; i < 3; i++)
        way[i] = i < m->dim ? to[k].x[i] - from[k].x[i] : 0;
    mesh_nearest(m, way);
    for (int i = 0; i < m->dim; i++)
        d += way[i] * way[i];
    return sqrt(d);
}

static double along(const double *a, const double *n)
{
    return a[0] * n[0] + a[1] * n[1] + a[2] * n[2];
}

/* Size of the cells where the body is. */
static double cell_size(const bodies *b, const pose *at)
{
    double x[3] = {at->x[0], at->x[1], at->x[2]};
    located l;

    mesh_wrap(b->space->mesh, x);
    l = locate_point(b->space->mesh, b->grid, x);
    return l.cell >= 0 ? b->space->mesh->h[l.cell] : b->h_mean;
}

static enum too_far meets_wall(const bodies *b, int k, const pose *from, const double *way, double size, char *why,
                               size_t n)
{
    solid here = solid_at(&b->spec[k].shape, &from[k]);
    wall_gap wall[PAIRS_MOST_WALLS];
    int n_wall = 0;
    error ignored; /* without memory the walls are not looked for; the next allocation says so */

    if (pairs_walls(b, &here, size, wall, &n_wall, &ignored))
        return FAR_NOT;
    for (int i = 0; i < n_wall; i++) {
        double closing = -along(way, wall[i].normal);

        if (wall[i].gap > 0 && closing > wall[i].gap) {
            snprintf(why, n, "particle %d would move by %.3g towards boundary \"%s\", to which its gap is %.3g", k,
                     closing, wall[i].boundary >= 0 ? b->space->mesh->name[wall[i].boundary] : "without a name",
                     wall[i].gap);
            return FAR_WALL;
        }
    }
    return FAR_NOT;
}

static enum too_far meets_body(const bodies *b, int k, const pose *from, const double (*way)[3], const double *size,
                               char *why, size_t n)
{
    for (int j = 0; j < k; j++) {
        double normal[3] = {0}, back[3], closing, gap = pairs_separation(b, from[k].x, from[j].x, normal);
        solid first, second;

        if (gap - b->spec[k].shape.radius - b->spec[j].shape.radius > size[k] + size[j])
            continue;
        first = solid_at(&b->spec[k].shape, &from[k]);
        second = solid_at(&b->spec[j].shape, &from[j]);
        for (int i = 0; i < 3; i++)
            back[i] = -normal[i];
        gap -= solid_support(&first, back) + solid_support(&second, normal);
        closing = along(way[j], normal) - along(way[k], normal);
        if (gap > 0 && closing > gap) {
            snprintf(why, n, "particles %d and %d would come nearer by %.3g than their gap of %.3g", j, k, closing,
                     gap);
            return FAR_BODY;
        }
    }
    return FAR_NOT;
}

enum too_far bodies_too_far(const bodies *b, const pose *from, const pose *to, char *why, size_t n)
{
    double(*way)[3] = calloc((size_t)b->n, sizeof *way), *size = calloc((size_t)b->n, sizeof *size);
    enum too_far far = FAR_NOT;

    for (int k = 0; way && size && k < b->n && !far; k++) {
        double h;

        size[k] = way_of(b, from, to, k, way[k]);
        h = size[k] > 0 ? cell_size(b, &from[k]) : 1;
        if (size[k] > BODIES_MOST_CELLS * h) {
            snprintf(why, n, "particle %d would move by %.3g cells, at most %d are possible", k, size[k] / h,
                     BODIES_MOST_CELLS);
            far = FAR_CELLS;
        }
        if (!far && size[k] > 0)
            far = meets_wall(b, k, from, way[k], size[k], why, n);
        if (!far)
            far = meets_body(b, k, from, (const double(*)[3])way, size, why, n);
    }
    free(way);
    free(size);
    return far;
}
