/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * How far a step may carry bodies: no further than the paths of history allow, and no further than the gap to what
 * they meet, or they would pass through it without any numerical sign. */
#include "body/body.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* By how much a gap with a force in it may close in one step, in radii. */
#define CLOSES 0.01

#define HINT "; term \"contact.repulsion\" {} would keep them apart"

/* A body before and after a step. */
typedef struct move {
    solid before, after;
    double way[3]; /* of its centre */
    double size;   /* of the longest way of a point of it, or more: by turning, too */
    double h;      /* of the cells where it is */
} move;

static double along(const double *a, const double *n)
{
    return a[0] * n[0] + a[1] * n[1] + a[2] * n[2];
}

/* Angle between two orientations. */
static double turn_of(const pose *a, const pose *b, int dim)
{
    double c = 0;

    for (int i = 0; i < 4; i++)
        c += a->q[i] * b->q[i];
    return dim == 2 ? fabs(b->angle - a->angle) : 2 * acos(fmin(fabs(c), 1));
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

static move move_of(const bodies *b, const pose *from, const pose *to, int k)
{
    const shape *s = &b->spec[k].shape;
    move m = {.before = solid_at(s, &from[k]), .after = solid_at(s, &to[k])};

    for (int i = 0; i < 3; i++)
        m.way[i] = to[k].way[i] - from[k].way[i];
    m.size = sqrt(along(m.way, m.way)) + (shape_is_round(s) ? 0 : s->radius * turn_of(&from[k], &to[k], s->dim));
    m.h = m.size > 0 ? cell_size(b, &from[k]) : b->h_mean;
    return m;
}

/* By how much the body's extent comes further in the direction of -n. */
static double closing(const move *m, const double *n)
{
    const double back[3] = {-n[0], -n[1], -n[2]};

    return -along(m->way, n) + solid_support(&m->after, back) - solid_support(&m->before, back);
}

/* Whether the gap is too narrow for what comes nearer: one that is closed already is a matter of the force that
 * acts in it, if there is one.  So is one that closes by little: what falls on a floor would else come nearer in
 * ever shorter steps. */
static int is_through(const bodies *b, double gap, double nearer, double radius)
{
    return (gap > 0 || !b->has_pairs) && nearer > fmax(gap, 0) + (b->has_pairs ? CLOSES : 1e-9) * radius;
}

static enum too_far through_wall(const bodies *b, int k, double gap, double nearer, const char *name, char *why,
                                 size_t n)
{
    if (!is_through(b, gap, nearer, b->spec[k].shape.radius))
        return FAR_NOT;
    snprintf(why, n, "particle %d would move by %.3g towards boundary \"%s\", to which its gap is %.3g%s", k,
             nearer, name, gap, b->spec[k].motion == BODY_FREE && !b->has_pairs ? HINT : "");
    return FAR_WALL;
}

static enum too_far meets_wall(const bodies *b, int k, const move *m, char *why, size_t n)
{
    wall_gap wall[PAIRS_MOST_WALLS];
    int n_wall = 0;
    error ignored; /* without memory the walls are not looked for; the next allocation says so */
    enum too_far far = FAR_NOT;

    if (pairs_walls(b, &m->before, m->size, wall, &n_wall, &ignored))
        return FAR_NOT;
    for (int i = 0; i < n_wall && !far; i++)
        far =
            through_wall(b, k, wall[i].gap, closing(m, wall[i].normal),
                         wall[i].boundary >= 0 ? b->space->mesh->name[wall[i].boundary] : "without a name", why, n);
    for (int i = 0; i < b->n_plane && !far; i++) { /* a body that a symmetry plane cuts is held on it */
        double normal[3] = {0}, from = m->before.at.x[b->plane[i].axis] - b->plane[i].at, back[3] = {0};

        if (fabs(from) <= 1e-9 * m->before.shape->radius)
            continue;
        normal[b->plane[i].axis] = from > 0 ? 1 : -1;
        back[b->plane[i].axis] = -normal[b->plane[i].axis];
        far = through_wall(b, k, fabs(from) - solid_support(&m->before, back), closing(m, normal),
                           b->plane[i].boundary, why, n);
    }
    return far;
}

static enum too_far meets_body(const bodies *b, int k, const move *m, char *why, size_t n)
{
    for (int j = 0; j < k; j++) {
        const pose *at[2] = {&m[k].before.at, &m[j].before.at};
        double normal[3] = {0}, back[3], nearer, gap = pairs_separation(b, at[0]->x, at[1]->x, normal);

        if (gap - b->spec[k].shape.radius - b->spec[j].shape.radius > m[k].size + m[j].size)
            continue;
        for (int i = 0; i < 3; i++)
            back[i] = -normal[i];
        gap -= solid_support(&m[k].before, back) + solid_support(&m[j].before, normal);
        nearer = closing(&m[k], normal) + closing(&m[j], back);
        if (is_through(b, gap, nearer, fmin(b->spec[k].shape.radius, b->spec[j].shape.radius))) {
            int free = b->spec[k].motion == BODY_FREE || b->spec[j].motion == BODY_FREE;

            snprintf(why, n, "particles %d and %d would come nearer by %.3g than their gap of %.3g%s", j, k, nearer,
                     gap, free && !b->has_pairs ? HINT : "");
            return FAR_BODY;
        }
    }
    return FAR_NOT;
}

enum too_far bodies_too_far(const bodies *b, const pose *from, const pose *to, char *why, size_t n)
{
    move *m = calloc((size_t)b->n, sizeof *m);
    enum too_far far = FAR_NOT;

    for (int k = 0; m && k < b->n && !far; k++) {
        m[k] = move_of(b, from, to, k);
        if (m[k].size > BODIES_MOST_CELLS * m[k].h) {
            snprintf(why, n, "particle %d would move by %.3g cells, at most %d are possible", k, m[k].size / m[k].h,
                     BODIES_MOST_CELLS);
            far = FAR_CELLS;
        }
        if (!far && m[k].size > 0)
            far = meets_wall(b, k, &m[k], why, n);
        if (!far)
            far = meets_body(b, k, m, why, n);
    }
    free(m);
    return far;
}
