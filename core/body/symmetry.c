/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Bodies that symmetry planes cut through the centre: what is computed is a half, a quarter or an eighth of them.
 * That has a meaning if the body is its own mirror image, and stays it: nothing may move it off the plane or turn
 * it out of it. */
#include "body/places.h"

#include "base/text.h"

#include <math.h>
#include <string.h>

int symmetry_planes_at(const symmetry_plane *plane, int n, const solid *b, int *which)
{
    int cut = 0;

    for (int i = 0; i < n; i++)
        if (fabs(b->at.x[plane[i].axis] - plane[i].at) <= 1e-9 * b->shape->radius)
            which[cut++] = i;
    return cut;
}

typedef struct mirror {
    const solid *b;
    const symmetry_plane *plane;
} mirror;

static double mirrored_level(const void *ctx, const double *x)
{
    const mirror *m = ctx;
    double y[3] = {x[0], x[1], x[2]};

    y[m->plane->axis] = 2 * m->plane->at - y[m->plane->axis];
    return -fabs(solid_level(m->b, y));
}

static void check_shape(const description *d, const body_spec *q, const solid *b, const symmetry_plane *plane)
{
    const mirror m = {b, plane};
    double at[3] = {0}, least = surface_least(b, mirrored_level, &m, 1, at);

    if (-least > 1e3 * surface_slack(b->shape))
        case_wrong(d->c, q->block, "at",
                   "particle %d at %s is cut by the symmetry plane \"%s\", about which it is not symmetric; turn "
                   "it, or take the "
                   "whole domain",
                   (int)(q - d->body), text_point(b->at.x, d->dim).s, plane->boundary);
}

/* Components (0..2: velocity, 3..5: spin) that a plane rules out. */
static void ruled_out(int dim, const symmetry_plane *plane, int *out)
{
    out[plane->axis] = 1;
    for (int k = 0; k < 3; k++)
        out[3 + k] |= dim == 2 ? k == 2 : k != plane->axis;
}

/* The largest of a component of a given motion: a number, or a function at a few times of the run. */
static int is_given(const description *d, const value *v, int comp, double *largest, error *err)
{
    double t0 = d->time.start, t1 = d->time.unsteady ? d->time.stop : t0;

    *largest = 0;
    for (int k = 0; v->f ? k < 5 : k < 1; k++) {
        double out[VALUE_MAX] = {0};

        TRY(value_at(v, (double[3]){0}, t0 + k * (t1 - t0) / 4, out, err));
        *largest = fmax(*largest, fabs(out[comp]));
    }
    return 0;
}

/* Motions that a plane rules out must be held, and none of them be given. */
static int check_motion(const description *d, const body_spec *q, const symmetry_plane *plane, const int *which,
                        int n, error *err)
{
    static const char *const name[] = {"x", "y", "z", "spin_x", "spin_y", "spin_z"};
    int out[6] = {0}, missing = 0;
    text list = {0};

    for (int i = 0; i < n; i++)
        ruled_out(d->dim, &plane[which[i]], out);
    for (int k = 0; k < 6; k++)
        missing |= q->motion == BODY_FREE && out[k] && !q->held[k];
    for (int k = 0; k < 6; k++)
        if (out[k])
            text_add(&list, "%s\"%s\"", list.n ? ", " : "", d->dim == 2 && k == 5 ? "spin" : name[k]);
    if (missing)
        case_wrong(d->c, q->block, "at",
                   "particle %d at %s is cut by the symmetry plane \"%s\", so its other half moves as a mirror "
                   "image: hold what is not symmetric, hold = {%s}",
                   (int)(q - d->body), text_point(q->start.x, d->dim).s, plane[which[0]].boundary,
                   list.s ? list.s : "");
    text_free(&list);
    for (int k = 0; k < 6; k++) {
        const value *v = k < 3 ? &q->velocity : &q->spin;
        int comp = k < 3 ? k : d->dim == 2 ? 0 : k - 3;
        double largest;

        if (!out[k] || comp >= v->n)
            continue;
        TRY(is_given(d, v, comp, &largest, err));
        if (largest > 0)
            case_wrong(
                d->c, q->block, k < 3 ? "velocity" : "spin",
                "particle %d at %s is cut by the symmetry plane \"%s\", so its %s along %s must be zero, not "
                "%g",
                (int)(q - d->body), text_point(q->start.x, d->dim).s, plane[which[0]].boundary,
                k < 3 ? "velocity" : "spin",
                k % 3 == 0   ? "x"
                : k % 3 == 1 ? "y"
                             : "z",
                largest);
    }
    return 0;
}

int symmetry_check(const description *d, const mesh *m, error *err)
{
    symmetry_plane plane[DESCRIBE_MAX_PLANES];
    int n, which[DESCRIBE_MAX_PLANES];

    TRY(describe_planes(d, m, plane, &n, err));
    for (int k = 0; n > 0 && k < d->n_body; k++) {
        const body_spec *q = &d->body[k];
        const solid b = solid_at(&q->shape, &q->start);
        int cut = symmetry_planes_at(plane, n, &b, which);

        for (int i = 0; i < cut; i++)
            check_shape(d, q, &b, &plane[which[i]]);
        if (cut)
            TRY(check_motion(d, q, plane, which, cut, err));
    }
    return 0;
}
