/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What points of bodies have, for the tests of a term: values that fit together, different at all points. */
#include "term/bench.h"

#include "base/random.h"

#include <math.h>

static double number(bench *k)
{
    return 2 * random_next(&k->random) - 1;
}

/* The next n components of the room, with numbers in [low, high]. */
static const double *fill(bench *k, double **room, int n, double low, double high)
{
    double *to = *room;

    for (int i = 0; i < n * BENCH_LD; i++)
        to[i] = low + (high - low) * 0.5 * (1 + number(k));
    *room += n * BENCH_LD;
    return to;
}

/* A rotation by quaternions, at each point. */
static void turn(const bench *k, const double *q, double *axes, int l)
{
    double w = q[l], x = q[BENCH_LD + l], y = q[2 * BENCH_LD + l], z = q[3 * BENCH_LD + l];
    double size = sqrt(w * w + x * x + y * y + z * z), angle = 3 * w;
    const double in_2d[4] = {cos(angle), -sin(angle), sin(angle), cos(angle)};

    w /= size, x /= size, y /= size, z /= size;
    const double in_3d[9] = {1 - 2 * (y * y + z * z), 2 * (x * y - w * z),     2 * (x * z + w * y),
                             2 * (x * y + w * z),     1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
                             2 * (x * z - w * y),     2 * (y * z + w * x),     1 - 2 * (x * x + y * y)};

    for (int i = 0; i < k->dim * k->dim; i++)
        axes[i * BENCH_LD + l] = k->dim == 2 ? in_2d[i] : in_3d[i];
}

static const double *axes_of(bench *k, double **room)
{
    double *axes = *room;
    const double *q;

    *room += 9 * BENCH_LD;
    q = fill(k, room, 4, 0.1, 1);
    for (int l = 0; l < BENCH_LD; l++)
        turn(k, q, axes, l);
    return axes;
}

/* A diagonal of one to two, and little beside it. */
static const double *inertia_of(bench *k, double **room)
{
    const int n = k->dim == 2 ? 1 : 3;
    double *m = *room;

    fill(k, room, n * n, 1, 2);
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            for (int l = 0; i != j && l < BENCH_LD; l++)
                m[(i * n + j) * BENCH_LD + l] = 0.2 * (m[((i < j ? i * n + j : j * n + i)) * BENCH_LD + l] - 1.5);
    return m;
}

static const double *centre_of(const bench *k, double **room, const double *arm)
{
    double *to = *room;

    for (int i = 0; i < k->dim * BENCH_LD; i++)
        to[i] = k->x[i] - arm[i];
    *room += 3 * BENCH_LD;
    return to;
}

int bench_bodies(bench *k, error *err)
{
    const uint32_t where = k->t->where;
    const int spin = k->dim == 2 ? 1 : 3;
    pf_batch *b = &k->b;
    double *room;

    if (k->t->flags & PF_WALL_DISTANCE) {
        ARENA_NEW(&k->memory, room, BENCH_LD, err);
        b->wall_distance = fill(k, &room, 1, 0.1, 1);
    }
    if (where != PF_SOLID && where != PF_SURFACE && where != PF_PARTICLE && where != PF_PAIR)
        return 0;
    ARENA_NEW(&k->memory, k->body, 80 * BENCH_LD, err);
    ARENA_NEW(&k->memory, k->other_id, BENCH_LD, err);
    room = k->body;
    b->density = k->density;
    b->id = k->id;
    b->arm = where == PF_PARTICLE ? room : k->arm;
    room += where == PF_PARTICLE ? 3 * BENCH_LD : 0; /* zero */
    b->centre = centre_of(k, &room, b->arm);
    b->axes = axes_of(k, &room);
    b->volume = fill(k, &room, 1, 0.5, 1);
    b->mass = fill(k, &room, 1, 1, 2);
    b->inertia = inertia_of(k, &room);
    if (where == PF_SURFACE)
        b->curvature = fill(k, &room, 1, 0.5, 2);
    if (where == PF_PARTICLE) {
        b->fluid_force = fill(k, &room, k->dim, -1, 1);
        b->fluid_torque = fill(k, &room, spin, -1, 1);
    }
    if (where == PF_PAIR) {
        for (int l = 0; l < BENCH_LD; l++)
            k->other_id[l] = l % 5 ? l + 1 : -1; /* some of them walls */
        b->other_id = k->other_id;
        b->other_arm = fill(k, &room, 3, -1, 1);
        b->other_centre = centre_of(k, &room, b->other_arm);
        b->other_axes = axes_of(k, &room);
    }
    return 0;
}
