/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Shapes: which points are inside, volume and second moments. */
#include "particle/particle.h"

#include <math.h>
#include <string.h>

/* Cells of the grid over the bounding box, a direction, for moments by quadrature. */
enum { MOMENT_CELLS_2D = 1200, MOMENT_CELLS_3D = 160 };

static double general_level(const shape *s, const double *x)
{
    double at[3] = {0}, d[VALUE_MAX] = {1};
    error ignored;

    for (int k = 0; k < s->dim; k++)
        at[k] = x[k] + s->centre[k];
    return value_at(&s->distance, at, 0, d, &ignored) ? 1 : d[0];
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

static int measure_formula(shape *s)
{
    const double *h = s->half;
    double n = s->dim == 2 ? 4 : 5;

    memset(s->moment, 0, sizeof s->moment);
    switch (s->kind) {
    case SHAPE_ELLIPSOID:
        s->volume = s->dim == 2 ? M_PI * h[0] * h[1] : 4 * M_PI / 3 * h[0] * h[1] * h[2];
        for (int k = 0; k < s->dim; k++)
            s->moment[k][k] = s->volume * h[k] * h[k] / n;
        return 1;
    case SHAPE_BOX:
        s->volume = s->dim == 2 ? 4 * h[0] * h[1] : 8 * h[0] * h[1] * h[2];
        for (int k = 0; k < s->dim; k++)
            s->moment[k][k] = s->volume * h[k] * h[k] / 3;
        return 1;
    case SHAPE_CYLINDER:
        s->volume = 2 * M_PI * h[0] * h[0] * h[2];
        s->moment[0][0] = s->moment[1][1] = s->volume * h[0] * h[0] / 4;
        s->moment[2][2] = s->volume * h[2] * h[2] / 3;
        return 1;
    default:
        return 0;
    }
}

/* Moments of order 0, 1, 2 about the origin by midpoints of a fine grid over +-half. */
static void measure_grid(const shape *s, double *volume, double *first, double second[3][3])
{
    int n = s->dim == 2 ? MOMENT_CELLS_2D : MOMENT_CELLS_3D, nz = s->dim == 2 ? 1 : n;
    double d[3];

    *volume = 0;
    memset(first, 0, 3 * sizeof *first);
    memset(second, 0, 9 * sizeof(double));
    for (int k = 0; k < 3; k++)
        d[k] = 2 * s->half[k] / n;
    for (int c = 0; c < nz; c++)
        for (int b = 0; b < n; b++)
            for (int a = 0; a < n; a++) {
                double x[3] = {-s->half[0] + (a + 0.5) * d[0], -s->half[1] + (b + 0.5) * d[1],
                               s->dim == 3 ? -s->half[2] + (c + 0.5) * d[2] : 0};
                double w = d[0] * d[1] * (s->dim == 3 ? d[2] : 1);

                if (shape_level(s, x) >= 0)
                    continue;
                *volume += w;
                for (int i = 0; i < s->dim; i++) {
                    first[i] += w * x[i];
                    for (int j = 0; j < s->dim; j++)
                        second[i][j] += w * x[i] * x[j];
                }
            }
}

int shape_measure(shape *s, error *err)
{
    double first[3];

    s->radius = 0;
    for (int k = 0; k < s->dim; k++)
        s->radius += s->half[k] * s->half[k];
    s->radius = s->kind == SHAPE_ELLIPSOID ? fmax(s->half[0], fmax(s->half[1], s->dim == 3 ? s->half[2] : 0))
                                           : sqrt(s->radius);
    if (s->kind == SHAPE_CYLINDER)
        s->radius = hypot(s->half[0], s->half[2]);
    s->thickness = 2 * fmin(s->half[0], s->dim == 3 ? fmin(s->half[1], s->half[2]) : s->half[1]);
    if (measure_formula(s))
        return 0;
    memset(s->centre, 0, sizeof s->centre);
    measure_grid(s, &s->volume, first, s->moment);
    if (!(s->volume > 0))
        return error_set(err, ERR_CASE, "the distance function is nowhere negative inside the box of its shape");
    for (int k = 0; k < s->dim; k++)
        s->centre[k] = s->kind == SHAPE_DISTANCE ? first[k] / s->volume : 0;
    for (int i = 0; i < s->dim; i++) {
        s->radius += fabs(s->centre[i]);
        for (int j = 0; j < s->dim; j++)
            s->moment[i][j] -= s->volume * s->centre[i] * s->centre[j];
    }
    return 0;
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
    default:
        return s->radius;
    }
}
