/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * particle {} and particles {} of a case. */
#include "base/random.h"
#include "describe/describe.h"

#include <lauxlib.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MOST_TRIES = 200000 };

static const char *const shape_kinds[] = {"ellipsoid", "box", "cylinder", "superellipsoid", "distance", NULL};
static const char *const motions[] = {"free", "fixed", "prescribed", NULL};

/* Volume, moments and reach of a shape; a warning if they are not exact. */
static int measure(description *d, const case_block *b, shape *s, error *err)
{
    int status = shape_measure(s, &d->memory, err);

    if (status && !shape_check(s, NULL)) /* an error of the function names its line itself */
        error_prefix(err, "%s:%d: shape: ", b->file, b->line);
    if (!status && s->accuracy > 1e-4)
        warning_add(
            &d->warnings,
            "%s:%d: shape: volume and moments of inertia of the body are known to %.1g only, its surface has "
            "edges or is thin against half; a smaller box round it (half = ...) helps",
            b->file, b->line, s->accuracy);
    return status;
}

/* The table that disk{}, sphere{}, box{} ... return (see the prelude), on top of the stack; pops it. */
static int read_shape(description *d, const case_block *b, shape *s, error *err)
{
    lua_State *l = d->c->lua;
    case_block inner = {.kind = "shape", .ref = LUA_NOREF, .file = b->file, .line = b->line};
    const char *name = "", *other = "";
    double half[3] = {0};
    int dim = d->dim;
    reader r;

    memset(s, 0, sizeof *s);
    s->dim = d->dim;
    inner.ref = luaL_ref(l, LUA_REGISTRYINDEX);
    reader_open(&r, d->c, arena_alloc(&d->memory, 1, sizeof inner), "shape");
    memcpy((void *)r.b, &inner, sizeof inner);
    reader_string(&r, "name", "of the function that made the shape", &name);
    reader_string(&r, "other", "what takes its place in the other dimension", &other);
    reader_integer(&r, "dim", "dimension that the shape is for", 2, 3, &dim);
    if (dim != d->dim) {
        case_wrong(d->c, b, "shape", "shape: %s{} is a shape in %dD, the mesh is %dD; use %s", name, dim, d->dim,
                   other);
        return 0;
    }
    reader_required(
        &r, "kind",
        reader_choice(&r, "kind", "shape; use disk{}, sphere{}, ellipse{}, box{} ...", shape_kinds, &s->kind));
    if (!reader_required(&r, "half", reader_vector(&r, "half", "half widths, m", d->dim, half)))
        return 0;
    reader_vector(&r, "exponent", "of a superellipsoid", 2, s->exponent);
    for (int k = 0; k < d->dim; k++) {
        s->half[k] = half[k];
        if (!(half[k] > 0))
            case_wrong(d->c, b, "shape", "shape: widths must be positive, %g is not", half[k]);
    }
    if (s->kind == SHAPE_DISTANCE)
        reader_required(
            &r, "distance",
            reader_value(&r, "distance", "signed distance, function of x, y[, z]", 1, d->dim, &s->distance));
    if (s->kind == SHAPE_CYLINDER && d->dim == 2)
        case_wrong(d->c, b, "shape", "shape: a cylinder needs three dimensions; in 2D use disk{} or rectangle{}");
    if (s->kind == SHAPE_SUPERELLIPSOID && !(s->exponent[0] >= 1 && (d->dim == 2 || s->exponent[1] >= 1)))
        case_wrong(d->c, b, "shape", "shape: exponents of a superellipsoid must be at least 1");
    reader_close(&r);
    return d->c->n_error ? 0 : measure(d, b, s, err);
}

static void read_hold(description *d, reader *r, body_spec *q)
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
                if (k == 6 && d->dim == 3)
                    q->held[3] = q->held[4] = 1;
            }
        if (!found)
            case_wrong(d->c, r->b, "hold",
                       "particle: hold: \"%s\" is none of x, y, z, spin, spin_x, spin_y, spin_z", list[i]);
    }
}

/* Everything of a body but its shape and place. */
static void read_body(description *d, reader *r, body_spec *q)
{
    double orientation[4] = {1, 0, 0, 0}, norm = 0;

    reader_required(r, "density",
                    reader_number(r, "density", "mass per volume, kg/m^3", 1e-300, 1e30, &q->density));
    if (d->dim == 2)
        reader_number(r, "angle", "of the body's x axis, rad", -1e9, 1e9, &q->start.angle);
    else
        reader_vector(r, "orientation", "quaternion {w, x, y, z}", 4, orientation);
    for (int k = 0; k < 4; k++)
        norm += orientation[k] * orientation[k];
    for (int k = 0; k < 4; k++)
        q->start.q[k] = orientation[k] / (norm > 0 ? sqrt(norm) : 1);
    q->velocity.n = d->dim;
    q->spin.n = d->dim == 2 ? 1 : 3;
    reader_value(r, "velocity", "m/s; a function of t if the motion is prescribed", d->dim, 0, &q->velocity);
    reader_value(r, "spin", "rad/s; a function of t if the motion is prescribed", q->spin.n, 0, &q->spin);
    reader_choice(r, "motion",
                  "free, fixed (place and orientation stay), or prescribed (velocity and spin as given)", motions,
                  &q->motion);
    read_hold(d, r, q);
}

static int add_body(description *d, const body_spec *q, error *err)
{
    if ((d->n_body & (d->n_body - 1)) == 0) {
        body_spec *more;

        ARENA_NEW(&d->memory, more, 2 * d->n_body + 1, err);
        memcpy(more, d->body ? d->body : more, (size_t)d->n_body * sizeof *more);
        d->body = more;
    }
    d->body[d->n_body++] = *q;
    return 0;
}

static int read_one(description *d, const case_block *b, error *err)
{
    body_spec q = {.block = b};
    reader r;

    reader_open(&r, d->c, b, "particle");
    read_body(d, &r, &q);
    reader_required(&r, "at", reader_vector(&r, "at", "place of the centroid, m", d->dim, q.start.x));
    if (reader_required(&r, "shape",
                        reader_table(&r, "shape", "disk{radius = ...}, sphere{}, ellipse{}, rectangle{} ...")))
        TRY(read_shape(d, b, &q.shape, err));
    reader_close(&r);
    return d->c->n_error ? 0 : add_body(d, &q, err);
}

/* particles { n, shape, density, inside = {{...}, {...}}, gap, seed }: places at random, without overlap. */
static int read_many(description *d, const case_block *b, error *err)
{
    body_spec q = {.block = b};
    double corner[2][3] = {{0}}, gap = 0;
    int n = 0, seed = 1, first = d->n_body, tries = 0;
    unsigned long long state;
    lua_State *l = d->c->lua;
    reader r;

    reader_open(&r, d->c, b, "particles");
    read_body(d, &r, &q);
    reader_required(&r, "n", reader_integer(&r, "n", "how many", 1, 100000, &n));
    reader_integer(&r, "seed", "of the random places", 0, 1000000000, &seed);
    reader_number(&r, "gap", "smallest distance between two bodies, m", 0, 1e30, &gap);
    if (reader_required(&r, "inside", reader_table(&r, "inside", "box to fill: {{x, y[, z]}, {x, y[, z]}}"))) {
        for (int c = 0; c < 2; c++) {
            lua_rawgeti(l, -1, c + 1);
            for (int k = 0; lua_istable(l, -1) && k < d->dim; k++) {
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
        TRY(read_shape(d, b, &q.shape, err));
    reader_close(&r);
    state = random_start((unsigned long long)seed);
    while (!d->c->n_error && d->n_body < first + n) {
        int ok = 1;

        if (++tries > MOST_TRIES) {
            case_wrong(d->c, b, NULL,
                       "particles: only %d of %d bodies find a place; take fewer, smaller ones, or a larger box",
                       d->n_body - first, n);
            break;
        }
        for (int k = 0; k < d->dim; k++)
            q.start.x[k] = corner[0][k] + q.shape.radius +
                           (corner[1][k] - corner[0][k] - 2 * q.shape.radius) * random_next(&state);
        for (int i = 0; i < d->n_body && ok; i++) {
            double d2 = 0, reach = d->body[i].shape.radius + q.shape.radius + gap;

            for (int k = 0; k < d->dim; k++)
                d2 += (d->body[i].start.x[k] - q.start.x[k]) * (d->body[i].start.x[k] - q.start.x[k]);
            ok = d2 >= reach * reach;
        }
        if (ok)
            TRY(add_body(d, &q, err));
    }
    return 0;
}

int describe_bodies(description *d, error *err)
{
    const case_block *b;

    for (int k = 0; (b = case_find(d->c, "particle", k)); k++)
        TRY(read_one(d, b, err));
    for (int k = 0; (b = case_find(d->c, "particles", k)); k++)
        TRY(read_many(d, b, err));
    return 0;
}
