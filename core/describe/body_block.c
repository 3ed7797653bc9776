/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What particle {} and particles {} have in common: everything of a body but its place. */
#include "describe/describe.h"

#include <math.h>
#include <string.h>

static const char *const motions[] = {"free", "fixed", "prescribed", NULL};

/* hold = {...}: component of velocity (0..2) and spin (3..5) of each name; in 2D there is one spin. */
static const struct {
    const char *name;
    int first, last, in_2d;
} holds[] = {{"x", 0, 0, 1},      {"y", 1, 1, 1},      {"z", 2, 2, 0},     {"spin", 3, 5, 1},
             {"spin_x", 3, 3, 0}, {"spin_y", 4, 4, 0}, {"spin_z", 5, 5, 1}};

static void read_hold(description *d, reader *r, body_spec *q)
{
    const char *list[8];
    int n, status = reader_strings(r, "hold", "motions that are held, as in {\"x\", \"spin\"}", 8, list, &n);

    if (status > 0 && q->motion != BODY_FREE)
        case_wrong(
            d->c, r->b, "hold",
            "%s: hold = {...} says which motions of a free body are held; with motion = \"%s\" all of them are, "
            "leave it out",
            r->what, motions[q->motion]);
    for (int i = 0; status > 0 && i < n; i++) {
        int found = 0;

        for (size_t k = 0; k < sizeof holds / sizeof *holds; k++)
            if (strcmp(list[i], holds[k].name) == 0 && (d->dim == 3 || holds[k].in_2d)) {
                for (int c = holds[k].first; c <= holds[k].last; c++)
                    q->held[c] = 1;
                found = 1;
            }
        if (!found)
            case_wrong(d->c, r->b, "hold", "%s: hold: \"%s\" is none of %s", r->what, list[i],
                       d->dim == 2 ? "x, y, spin" : "x, y, z, spin, spin_x, spin_y, spin_z");
    }
}

/* angle or orientation. */
static void read_turn(description *d, reader *r, body_spec *q)
{
    const double full = 2 * M_PI;
    double orientation[4] = {1, 0, 0, 0}, norm = 0;

    if (d->dim == 2) {
        if (reader_number(r, "angle", "of the body's x axis, rad", -1e9, 1e9, &q->start.angle) > 0 &&
            fabs(q->start.angle) > full * (1 + 1e-9))
            describe_warn(d, r->b, "angle", "%s: angle = %g is in radians (%.4g degrees); math.rad(%g) converts",
                          r->what, q->start.angle, q->start.angle * 360 / full, q->start.angle);
    } else {
        reader_vector(r, "orientation", "quaternion {w, x, y, z}", 4, orientation);
    }
    for (int k = 0; k < 4; k++)
        norm += orientation[k] * orientation[k];
    if (!(norm > 0))
        case_wrong(
            d->c, r->b, "orientation",
            "%s: \"orientation\" is zero; a quaternion {w, x, y, z} = {cos(a/2), sin(a/2) n} turns by a about "
            "the unit vector n, {1, 0, 0, 0} turns nothing",
            r->what);
    for (int k = 0; k < 4; k++)
        q->start.q[k] = orientation[k] / (norm > 0 ? sqrt(norm) : 1);
}

/* A function of t is for motions that follow one. */
static void check_given(description *d, reader *r, const body_spec *q, const char *key, const value *v, int held)
{
    if (q->motion == BODY_FREE && v->f && !held)
        case_wrong(d->c, r->b, key,
                   "%s: \"%s\" is a function, but a free body follows the flow from its start on, which needs a "
                   "number%s; motion = \"prescribed\" follows the function",
                   r->what, key, v->n > 1 ? " for each component" : "");
}

static void read_motion(description *d, reader *r, body_spec *q)
{
    int any = 0;

    q->velocity.n = d->dim;
    q->spin.n = d->dim == 2 ? 1 : 3;
    any |= describe_value(r, "velocity", "m/s; a function of t if the motion is prescribed", d->dim, 0,
                          &q->velocity) != 0;
    any |= describe_value(r, "spin", "rad/s; a function of t if the motion is prescribed", q->spin.n, 0,
                          &q->spin) != 0;
    any |= reader_choice(r, "motion",
                         "free, fixed (place and orientation stay), or prescribed (velocity and spin as given)",
                         motions, &q->motion) < 0;
    read_hold(d, r, q);
    check_given(d, r, q, "velocity", &q->velocity, q->held[0] || q->held[1] || q->held[2]);
    check_given(d, r, q, "spin", &q->spin, q->held[3] || q->held[4] || q->held[5]);
    if (q->motion == BODY_PRESCRIBED && !any)
        case_wrong(
            d->c, r->b, "motion",
            "%s: motion = \"prescribed\" moves with \"velocity\" and \"spin\", but neither is given; a body that "
            "stays is motion = \"fixed\"",
            r->what);
}

/* The shape, whose functions are often mistaken for names. */
static int read_shape(description *d, reader *r, body_spec *q, error *err)
{
    static const char doc[] = "made by disk{}, sphere{}, ellipse{}, rectangle{} ...";
    lua_State *l = d->c->lua;
    int status;

    reader_note(r, "shape", doc);
    if (reader_type(r, "shape") == LUA_TSTRING || reader_type(r, "shape") == LUA_TFUNCTION) {
        case_wrong(
            d->c, r->b, "shape",
            "%s: \"shape\" (%s) is a %s; write the function with its measures, as in shape = disk { radius = 0.1 "
            "}",
            r->what, doc, lua_typename(l, reader_type(r, "shape")));
        return 0;
    }
    status = reader_table(r, "shape", doc);
    return reader_required(r, "shape", status) ? describe_shape(d, r->b, &q->shape, err) : 0;
}

int describe_body(description *d, reader *r, body_spec *q, error *err)
{
    int status = reader_number(r, "density", "mass per volume, kg/m^3", 1e-300, 1e30, &q->density);

    read_turn(d, r, q);
    read_motion(d, r, q);
    reader_required(r, "density", status);
    TRY(describe_body_extras(d, r, q, err));
    return read_shape(d, r, q, err);
}
