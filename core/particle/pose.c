/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Where bodies are and how they are turned, and a shape at such a pose. */
#include "particle/particle.h"

#include <math.h>
#include <string.h>

/* Columns: the body's axes. */
static void axes_of(const pose *at, int dim, double r[3][3])
{
    double w = at->q[0], x = at->q[1], y = at->q[2], z = at->q[3];

    if (dim == 2) {
        double c = cos(at->angle), s = sin(at->angle);
        const double m[3][3] = {{c, -s, 0}, {s, c, 0}, {0, 0, 1}};

        memcpy(r, m, sizeof m);
        return;
    }
    r[0][0] = 1 - 2 * (y * y + z * z), r[0][1] = 2 * (x * y - w * z), r[0][2] = 2 * (x * z + w * y);
    r[1][0] = 2 * (x * y + w * z), r[1][1] = 1 - 2 * (x * x + z * z), r[1][2] = 2 * (y * z - w * x);
    r[2][0] = 2 * (x * z - w * y), r[2][1] = 2 * (y * z + w * x), r[2][2] = 1 - 2 * (x * x + y * y);
}

solid solid_at(const shape *s, const pose *at)
{
    solid b = {.shape = s, .at = *at};

    axes_of(at, s->dim, b.axes);
    return b;
}

void solid_own(const solid *b, const double *x, double *own)
{
    for (int i = 0; i < 3; i++)
        own[i] = 0;
    for (int i = 0; i < b->shape->dim; i++)
        for (int j = 0; j < b->shape->dim; j++)
            own[i] += b->axes[j][i] * (x[j] - b->at.x[j]);
}

double solid_level(const solid *b, const double *x)
{
    double own[3];

    solid_own(b, x, own);
    return shape_level(b->shape, own);
}

void solid_slope(const solid *b, const double *x, double *g)
{
    int dim = b->shape->dim;
    double at[3], own[3] = {0};

    solid_own(b, x, at);
    shape_slope(b->shape, at, own);
    for (int j = 0; j < dim; j++) {
        g[j] = 0;
        for (int i = 0; i < dim; i++)
            g[j] += b->axes[j][i] * own[i];
    }
}

double solid_support(const solid *b, const double *n)
{
    const shape *s = b->shape;
    double own[3] = {0};

    for (int i = 0; i < s->dim; i++)
        for (int j = 0; j < s->dim; j++)
            own[i] += b->axes[j][i] * n[j];
    return shape_support(s, own);
}

/* q <- exp(rotation / 2) q, normalised. */
void pose_turn(pose *at, int dim, const double *rotation)
{
    double angle, s, a[4], *q = at->q, b[4], norm = 0;

    if (dim == 2) {
        at->angle += rotation[2];
        return;
    }
    angle = sqrt(rotation[0] * rotation[0] + rotation[1] * rotation[1] + rotation[2] * rotation[2]);
    s = angle > 1e-12 ? sin(angle / 2) / angle : 0.5;
    a[0] = cos(angle / 2), a[1] = s * rotation[0], a[2] = s * rotation[1], a[3] = s * rotation[2];
    b[0] = a[0] * q[0] - a[1] * q[1] - a[2] * q[2] - a[3] * q[3];
    b[1] = a[0] * q[1] + a[1] * q[0] + a[2] * q[3] - a[3] * q[2];
    b[2] = a[0] * q[2] - a[1] * q[3] + a[2] * q[0] + a[3] * q[1];
    b[3] = a[0] * q[3] + a[1] * q[2] - a[2] * q[1] + a[3] * q[0];
    for (int k = 0; k < 4; k++)
        norm += b[k] * b[k];
    for (int k = 0; k < 4; k++)
        q[k] = b[k] / sqrt(norm);
}
