/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Curvature of surfaces: the divergence of the normal n = g/|g|, g the gradient and H the second derivatives of the
 * level,
 *
 *     div n = (tr H |g|^2 - g.H g) / |g|^3 . */
#include "particle/particle.h"

#include <math.h>

/* Slope and second derivatives of the level by central differences. */
static void differences(const shape *s, const double *x, double *g, double h[3][3])
{
    const double step = 1e-3 * s->thickness, here = shape_level(s, x);

    for (int i = 0; i < s->dim; i++)
        for (int j = 0; j <= i; j++) {
            double v[2][2] = {{0}};

            for (int a = 0; a < 2; a++)
                for (int b = 0; b < 2; b++) {
                    double to[3] = {x[0], x[1], s->dim == 3 ? x[2] : 0};

                    to[i] += a ? step : -step;
                    to[j] += i == j ? 0 : b ? step : -step;
                    v[a][b] = i == j && b ? v[a][0] : shape_level(s, to);
                }
            if (i == j) {
                g[i] = (v[1][0] - v[0][0]) / (2 * step);
                h[i][i] = (v[1][0] - 2 * here + v[0][0]) / (step * step);
            } else {
                h[i][j] = h[j][i] = (v[1][1] - v[1][0] - v[0][1] + v[0][0]) / (4 * step * step);
            }
        }
}

static double divergence(int dim, const double *g, double h[3][3])
{
    double size = 0, trace = 0, along = 0;

    for (int i = 0; i < dim; i++) {
        size += g[i] * g[i];
        trace += h[i][i];
        for (int j = 0; j < dim; j++)
            along += g[i] * h[i][j] * g[j];
    }
    return size > 0 ? (trace * size - along) / (size * sqrt(size)) : 0;
}

double shape_curvature(const shape *s, const double *x)
{
    double g[3] = {0}, h[3][3] = {{0}};

    switch (s->kind) {
    case SHAPE_BOX:
        return 0;
    case SHAPE_CYLINDER:
        return hypot(x[0], x[1]) / s->half[0] > fabs(x[2]) / s->half[2] ? 1 / s->half[0] : 0;
    case SHAPE_ELLIPSOID:
        for (int k = 0; k < s->dim; k++) {
            g[k] = x[k] / (s->half[k] * s->half[k]);
            h[k][k] = 1 / (s->half[k] * s->half[k]);
        }
        break;
    default:
        differences(s, x, g, h);
    }
    return divergence(s->dim, g, h);
}

double solid_curvature(const solid *b, const double *x)
{
    double own[3];

    solid_own(b, x, own);
    return shape_curvature(b->shape, own);
}
