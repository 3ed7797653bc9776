/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * particle {} and particles {} of a case. */
#include "problem/problem.h"

#include <lauxlib.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MOST_TRIES = 200000 };

static const char *const shape_kinds[] = {"ellipsoid", "box", "cylinder", "superellipsoid", "distance", NULL};
static const char *const motions[] = {"free", "fixed", "prescribed", NULL};

static int measure(problem *p, const case_block *b, shape *s, error *err)
{
    int status = shape_measure(s, &p->memory, err);

    if (status && !shape_check(s, NULL)) /* an error of the function names its line itself */
        error_prefix(err, "%s:%d: shape: ", b->file, b->line);
    if (!status && s->accuracy > 1e-4)
        text_add(
            &p->c->printed,
            "warning: %s:%d: shape: volume and moments of inertia of the body are known to %.1g only, its surface "
            "has edges or is thin against half; a smaller box round it (half = ...) helps\n",
            b->file, b->line, s->accuracy);
    return status;
}

/* The table that disk{}, sphere{}, box{} ... return (see the prelude), on top of the stack; pops it. */
static int read_shape(problem *p, const case_block *b, shape *s, error *err)
{
    lua_State *l = p->c->lua;
    case_block inner = {.kind = "shape", .ref = LUA_NOREF, .file = b->file, .line = b->line};
    double half[3] = {0};
    reader r;

    memset(s, 0, sizeof *s);
    s->dim = p->dim;
    inner.ref = luaL_ref(l, LUA_REGISTRYINDEX);
    reader_open(&r, p->c, arena_alloc(&p->memory, 1, sizeof inner), "shape");
    memcpy((void *)r.b, &inner, sizeof inner);
    reader_required(
        &r, "kind",
        reader_choice(&r, "kind", "shape; use disk{}, sphere{}, ellipse{}, box{} ...", shape_kinds, &s->kind));
    if (!reader_required(&r, "half", reader_vector(&r, "half", "half widths, m", p->dim, half)))
        return 0;
    reader_vector(&r, "exponent", "of a superellipsoid", 2, s->exponent);
    for (int k = 0; k < p->dim; k++) {
        s->half[k] = half[k];
        if (!(half[k] > 0))
            case_wrong(p->c, b, "shape", "shape: widths must be positive, %g is not", half[k]);
    }
    if (s->kind == SHAPE_DISTANCE)
        reader_required(
            &r, "distance",
            reader_value(&r, "distance", "signed distance, function of x, y[, z]", 1, p->dim, &s->distance));
    if (s->kind == SHAPE_CYLINDER && p->dim == 2)
        case_wrong(p->c, b, "shape", "shape: a cylinder needs three dimensions; in 2D use disk{} or rectangle{}");
    if (s->kind == SHAPE_SUPERELLIPSOID && !(s->exponent[0] >= 1 && (p->dim == 2 || s->exponent[1] >= 1)))
        case_wrong(p->c, b, "shape", "shape: exponents of a superellipsoid must be at least 1");
    reader_close(&r);
    return p->c->n_error ? 0 : measure(p, b, s, err);
}

static void read_hold(problem *p, reader *r, particle *q)
{
    static const char *const name[] = {"x", "y", "z", "spin_x", "spin_y", "spin_z", "spin"};
    const char *list[8];
    int n;

    if (reader_strings(r, "hold", "motions that are held: x, y, z, spin (2D), spin_x, spin_y, spin_z", 8, list,
                       &n) <= 0)
        return;
    for (int i = 0; i < n; i++) {
        int found = 0;

        for (int k = 0; k < 7; k++)
            if (strcmp(list[i], name[k]) == 0) {
                q->held[k == 6 ? 5 : k] = found = 1;
                if (k == 6 && p->dim == 3)
                    q->held[3] = q->held[4] = 1;
            }
        if (!found)
            case_wrong(p->c, r->b, "hold",
                       "particle: hold: \"%s\" is none of x, y, z, spin, spin_x, spin_y, spin_z", list[i]);
    }
}

/* Everything of a body but its shape and place. */
static void read_body(problem *p, reader *r, particle *q)
{
    double orientation[4] = {1, 0, 0, 0}, norm = 0;

    reader_required(r, "density",
                    reader_number(r, "density", "mass per volume, kg/m^3", 1e-300, 1e30, &q->density));
    if (p->dim == 2)
        reader_number(r, "angle", "of the body's x axis, rad", -1e9, 1e9, &q->at.angle);
    else
        reader_vector(r, "orientation", "quaternion {w, x, y, z}", 4, orientation);
    for (int k = 0; k < 4; k++)
        norm += orientation[k] * orientation[k];
    for (int k = 0; k < 4; k++)
        q->at.q[k] = orientation[k] / (norm > 0 ? sqrt(norm) : 1);
    q->velocity.n = p->dim;
    q->spin.n = p->dim == 2 ? 1 : 3;
    reader_value(r, "velocity", "m/s; a function of t if the motion is prescribed", p->dim, 0, &q->velocity);
    reader_value(r, "spin", "rad/s; a function of t if the motion is prescribed", q->spin.n, 0, &q->spin);
    reader_choice(r, "motion",
                  "free, fixed (place and orientation stay), or prescribed (velocity and spin as given)", motions,
                  &q->motion);
    read_hold(p, r, q);
}

static int add_particle(problem *p, const particle *q, error *err)
{
    if ((p->n_particle & (p->n_particle - 1)) == 0) {
        particle *more;

        ARENA_NEW(&p->memory, more, 2 * p->n_particle + 1, err);
        memcpy(more, p->particle ? p->particle : more, (size_t)p->n_particle * sizeof *more);
        p->particle = more;
    }
    p->particle[p->n_particle++] = *q;
    return 0;
}

static int read_one(problem *p, const case_block *b, error *err)
{
    particle q = {0};
    reader r;

    reader_open(&r, p->c, b, "particle");
    read_body(p, &r, &q);
    reader_required(&r, "at", reader_vector(&r, "at", "place of the centroid, m", p->dim, q.at.x));
    if (reader_required(&r, "shape",
                        reader_table(&r, "shape", "disk{radius = ...}, sphere{}, ellipse{}, rectangle{} ...")))
        TRY(read_shape(p, b, &q.shape, err));
    reader_close(&r);
    return p->c->n_error ? 0 : add_particle(p, &q, err);
}

/* Numbers in [0, 1), the same in every run. */
static double uniform(unsigned long long *s)
{
    *s ^= *s >> 12;
    *s ^= *s << 25;
    *s ^= *s >> 27;
    return (double)((*s * 2685821657736338717ULL) >> 11) * 0x1p-53;
}

/* particles { n, shape, density, inside = {{...}, {...}}, gap, seed }: places at random, without overlap. */
static int read_many(problem *p, const case_block *b, error *err)
{
    particle q = {0};
    double corner[2][3] = {{0}}, gap = 0;
    int n = 0, seed = 1, first = p->n_particle, tries = 0;
    unsigned long long state;
    lua_State *l = p->c->lua;
    reader r;

    reader_open(&r, p->c, b, "particles");
    read_body(p, &r, &q);
    reader_required(&r, "n", reader_integer(&r, "n", "how many", 1, 100000, &n));
    reader_integer(&r, "seed", "of the random places", 0, 1000000000, &seed);
    reader_number(&r, "gap", "smallest distance between two bodies, m", 0, 1e30, &gap);
    if (reader_required(&r, "inside", reader_table(&r, "inside", "box to fill: {{x, y[, z]}, {x, y[, z]}}"))) {
        for (int c = 0; c < 2; c++) {
            lua_rawgeti(l, -1, c + 1);
            for (int k = 0; lua_istable(l, -1) && k < p->dim; k++) {
                lua_rawgeti(l, -1, k + 1);
                corner[c][k] = lua_tonumber(l, -1);
                lua_pop(l, 1);
            }
            lua_pop(l, 1);
        }
        lua_pop(l, 1);
    }
    if (reader_required(&r, "shape",
                        reader_table(&r, "shape", "disk{radius = ...}, sphere{}, ellipse{}, rectangle{} ...")))
        TRY(read_shape(p, b, &q.shape, err));
    reader_close(&r);
    state = 88172645463325252ULL + 2 * (unsigned long long)seed;
    while (!p->c->n_error && p->n_particle < first + n) {
        int ok = 1;

        if (++tries > MOST_TRIES) {
            case_wrong(p->c, b, NULL,
                       "particles: only %d of %d bodies find a place; take fewer, smaller ones, or a larger box",
                       p->n_particle - first, n);
            break;
        }
        for (int k = 0; k < p->dim; k++)
            q.at.x[k] = corner[0][k] + q.shape.radius +
                     (corner[1][k] - corner[0][k] - 2 * q.shape.radius) * uniform(&state);
        for (int i = 0; i < p->n_particle && ok; i++) {
            double d = 0, reach = p->particle[i].shape.radius + q.shape.radius + gap;

            for (int k = 0; k < p->dim; k++)
                d += (p->particle[i].at.x[k] - q.at.x[k]) * (p->particle[i].at.x[k] - q.at.x[k]);
            ok = d >= reach * reach;
        }
        if (ok)
            TRY(add_particle(p, &q, err));
    }
    return 0;
}

int problem_read_particles(problem *p, error *err)
{
    const case_block *b;

    for (int k = 0; (b = case_find(p->c, "particle", k)); k++)
        TRY(read_one(p, b, err));
    for (int k = 0; (b = case_find(p->c, "particles", k)); k++)
        TRY(read_many(p, b, err));
    return 0;
}
