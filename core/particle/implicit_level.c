/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The level of a body in coordinates of the unit box that a cell is the image of; simplices are boxes collapsed
 * (Duffy). */
#include "particle/implicit.h"

#include <math.h>
#include <string.h>

double implicit_reference(const implicit_work *w, const double *c, double *xi, double d[3][3])
{
    memset(d, 0, 9 * sizeof(double));
    if (!w->m->type->simplex) {
        for (int k = 0; k < w->dim; k++) {
            xi[k] = 2 * c[k] - 1;
            d[k][k] = 2;
        }
        return w->dim == 2 ? 4 : 8;
    }
    if (w->dim == 2) {
        xi[0] = c[0] * (1 - c[1]);
        xi[1] = c[1];
        d[0][0] = 1 - c[1], d[0][1] = -c[0], d[1][1] = 1;
        return 1 - c[1];
    }
    xi[0] = c[0] * (1 - c[1]) * (1 - c[2]);
    xi[1] = c[1] * (1 - c[2]);
    xi[2] = c[2];
    d[0][0] = (1 - c[1]) * (1 - c[2]), d[0][1] = -c[0] * (1 - c[2]), d[0][2] = -c[0] * (1 - c[1]);
    d[1][1] = 1 - c[2], d[1][2] = -c[1], d[2][2] = 1;
    return (1 - c[1]) * (1 - c[2]) * (1 - c[2]);
}

void implicit_place(const implicit_work *w, const double *xi, double *x, double j[3][3])
{
    if (w->affine) {
        for (int a = 0; a < w->dim; a++) {
            x[a] = w->x0[a];
            for (int b = 0; b < w->dim; b++) {
                x[a] += w->j[a][b] * xi[b];
                j[a][b] = w->j[a][b];
            }
        }
        if (w->dim == 2)
            j[2][2] = 1;
        return;
    }
    mesh_place(w->m, w->cell, xi, x, j);
}

double implicit_level(const implicit_work *w, const double *c)
{
    double xi[3] = {0}, d[3][3], x[3] = {0}, j[3][3];

    implicit_reference(w, c, xi, d);
    implicit_place(w, xi, x, j);
    return solid_level(w->b, x);
}

void implicit_slope(const implicit_work *w, const double *c, double *by_c, double *by_x, double *part)
{
    double xi[3] = {0}, d[3][3], x[3] = {0}, j[3][3] = {{0}};

    implicit_reference(w, c, xi, d);
    implicit_place(w, xi, x, j);
    solid_slope(w->b, x, by_x);
    for (int k = 0; k < w->dim; k++) {
        double speed = 0;

        by_c[k] = 0;
        for (int a = 0; a < w->dim; a++) {
            double along = 0; /* d x_a / d c_k */

            for (int i = 0; i < w->dim; i++)
                along += j[a][i] * d[i][k];
            by_c[k] += by_x[a] * along;
            speed += along * along;
        }
        part[k] = speed > 1e-24 * w->size * w->size ? by_c[k] / sqrt(speed) : NAN;
    }
}
