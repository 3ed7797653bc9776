/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Shapes: which points are inside, and how far a body reaches. */
#include "particle/particle.h"

#include "base/text.h"

#include <math.h>

static double general_level(const shape *s, const double *x)
{
    double at[3] = {0}, d[VALUE_MAX] = {1};

    if (s->fault->code)
        return 1;
    for (int k = 0; k < s->dim; k++)
        at[k] = x[k] + s->centre[k];
    if (value_at(&s->distance, at, 0, d, s->fault))
        return 1;
    if (!isfinite(d[0])) {
        error_set(s->fault, ERR_CASE, "the distance function of a shape is not finite at %s of its own frame",
                  text_point(at, s->dim).s);
        return 1;
    }
    return d[0];
}

int shape_check(const shape *s, error *err)
{
    if (!s->fault || !s->fault->code)
        return 0;
    if (err)
        *err = *s->fault;
    return s->fault->code;
}

double shape_level(const shape *s, const double *x)
{
    double v = 0;

    switch (s->kind) {
    case SHAPE_ELLIPSOID:
        for (int k = 0; k < s->dim; k++)
            v += x[k] * x[k] / (s->half[k] * s->half[k]);
        return v - 1;
    case SHAPE_BOX:
        for (int k = 0; k < s->dim; k++)
            v = fmax(v, fabs(x[k]) / s->half[k]);
        return v - 1;
    case SHAPE_CYLINDER:
        return fmax((x[0] * x[0] + x[1] * x[1]) / (s->half[0] * s->half[0]), fabs(x[2]) / s->half[2]) - 1;
    case SHAPE_SUPERELLIPSOID:
        v = pow(fabs(x[0] / s->half[0]), s->exponent[0]) + pow(fabs(x[1] / s->half[1]), s->exponent[0]);
        if (s->dim == 3)
            v = pow(v, s->exponent[1] / s->exponent[0]) + pow(fabs(x[2] / s->half[2]), s->exponent[1]);
        return v - 1;
    default:
        return general_level(s, x);
    }
}

void shape_slope(const shape *s, const double *x, double *g)
{
    if (s->kind == SHAPE_ELLIPSOID) {
        for (int k = 0; k < s->dim; k++)
            g[k] = 2 * x[k] / (s->half[k] * s->half[k]);
        return;
    }
    for (int k = 0; k < s->dim; k++) {
        double to[3] = {x[0], x[1], s->dim == 3 ? x[2] : 0}, step = 1e-5 * s->thickness, high;

        to[k] = x[k] + step;
        high = shape_level(s, to);
        to[k] = x[k] - step;
        g[k] = (high - shape_level(s, to)) / (2 * step);
    }
}

int shape_is_smooth(const shape *s)
{
    return s->kind == SHAPE_ELLIPSOID || s->kind == SHAPE_DISTANCE;
}

/* Norm |(a, b)|_q; q = INFINITY: the larger. */
static double norm(double a, double b, double q)
{
    double most = fmax(fabs(a), fabs(b));

    return isinf(q) || most == 0 ? most : most * pow(pow(fabs(a) / most, q) + pow(fabs(b) / most, q), 1 / q);
}

/* A superellipsoid is the unit ball of |(|(x/a, y/b)|_e0, z/c)|_e1: its support is the dual norm, 1/q = 1 - 1/e. */
static double superellipsoid_support(const shape *s, const double *n)
{
    double q[2], v;

    for (int i = 0; i < 2; i++)
        q[i] = s->exponent[i] > 1 ? s->exponent[i] / (s->exponent[i] - 1) : INFINITY;
    v = norm(s->half[0] * n[0], s->half[1] * n[1], q[0]);
    return s->dim == 2 ? v : norm(v, s->half[2] * n[2], q[1]);
}

/* Of points of the surface. */
static double sampled_support(const shape *s, const double *n)
{
    double most = -INFINITY;

    for (int64_t i = 0; i < s->n_support; i++) {
        double v = 0;

        for (int k = 0; k < s->dim; k++)
            v += s->support[i][k] * n[k];
        most = fmax(most, v);
    }
    return most;
}

double shape_support(const shape *s, const double *n)
{
    double v = 0;

    switch (s->kind) {
    case SHAPE_ELLIPSOID:
        for (int i = 0; i < s->dim; i++)
            v += s->half[i] * s->half[i] * n[i] * n[i];
        return sqrt(v);
    case SHAPE_BOX:
        for (int i = 0; i < s->dim; i++)
            v += s->half[i] * fabs(n[i]);
        return v;
    case SHAPE_CYLINDER:
        return s->half[0] * hypot(n[0], n[1]) + s->half[2] * fabs(n[2]);
    case SHAPE_SUPERELLIPSOID:
        return superellipsoid_support(s, n);
    default:
        return sampled_support(s, n);
    }
}

int shape_is_round(const shape *s)
{
    return s->kind == SHAPE_ELLIPSOID && s->half[0] == s->half[1] && (s->dim == 2 || s->half[1] == s->half[2]);
}
