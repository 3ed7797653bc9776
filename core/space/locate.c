/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Points to cells: candidates by the box around the cell's nodes, then Newton on the mapping. */
#include "space/locate.h"

#include <math.h>
#include <string.h>

#define OUTSIDE 1e-8 /* in reference coordinates: on a facet is inside */

static void solve3(int dim, double a[3][3], double *b)
{
    for (int i = 0; i < dim; i++) {
        int best = i;

        for (int r = i + 1; r < dim; r++)
            best = fabs(a[r][i]) > fabs(a[best][i]) ? r : best;
        for (int c = 0; c < dim; c++) {
            double swap = a[i][c];

            a[i][c] = a[best][c], a[best][c] = swap;
        }
        double swap = b[i];

        b[i] = b[best], b[best] = swap;
        for (int r = i + 1; r < dim; r++) {
            double f = a[r][i] / a[i][i];

            for (int c = i; c < dim; c++)
                a[r][c] -= f * a[i][c];
            b[r] -= f * b[i];
        }
    }
    for (int i = dim - 1; i >= 0; i--) {
        for (int c = i + 1; c < dim; c++)
            b[i] -= a[i][c] * b[c];
        b[i] /= a[i][i];
    }
}

static void jacobian(const mesh *m, int64_t cell, const double *xi, double *x, double j[3][3])
{
    double n[FE_MAX_NODES], dn[FE_MAX_NODES][3];

    fe_basis(m->type, 2, xi, n, dn);
    mesh_map(m, cell, n, (const double(*)[3])dn, x, j);
}

static int is_inside(const fe_cell *c, const double *xi)
{
    double sum = 0;

    for (int k = 0; k < c->dim; k++) {
        if (c->simplex ? xi[k] < -OUTSIDE : fabs(xi[k]) > 1 + OUTSIDE)
            return 0;
        sum += xi[k];
    }
    return !c->simplex || sum <= 1 + OUTSIDE;
}

int locate_in_cell(const mesh *m, int64_t e, const double *x, double *xi)
{
    for (int k = 0; k < 3; k++)
        xi[k] = m->type->simplex ? 0.25 : 0;
    for (int it = 0; it < 30; it++) {
        double at[3], j[3][3], d[3], size = 0;

        jacobian(m, e, xi, at, j);
        for (int k = 0; k < m->dim; k++)
            d[k] = x[k] - at[k];
        solve3(m->dim, j, d);
        for (int k = 0; k < m->dim; k++) {
            xi[k] += d[k];
            size = fmax(size, fabs(d[k]));
        }
        if (!(size < 1e3))
            return -1;
        if (size < 1e-13)
            break;
    }
    return is_inside(m->type, xi);
}

located locate_point(const mesh *m, const double *x)
{
    located at = {.cell = -1};

    for (int64_t e = 0; e < m->n_cell; e++) {
        const int32_t *node = m->cell + e * m->type->n_node;
        int near = 1;

        for (int k = 0; k < m->dim && near; k++) {
            double low = INFINITY, high = -INFINITY, margin;

            for (int i = 0; i < m->type->n_node; i++) {
                low = fmin(low, m->x[(int64_t)node[i] * m->dim + k]);
                high = fmax(high, m->x[(int64_t)node[i] * m->dim + k]);
            }
            margin = 0.2 * (high - low) + 1e-12 * m->h[e];
            near = x[k] >= low - margin && x[k] <= high + margin;
        }
        if (near && locate_in_cell(m, e, x, at.xi) > 0) {
            at.cell = (int32_t)e;
            break;
        }
    }
    return at;
}

void locate_value(const space *s, const located *at, int field, const double *x, double *value, double *gradient)
{
    const mesh *m = s->mesh;
    const field_spec *f = &s->field[field];
    const int32_t *node = m->cell + (int64_t)at->cell * m->type->n_node;
    int n = fe_n_basis(m->type, f->order), dim = m->dim;
    double b[FE_MAX_NODES], db[FE_MAX_NODES][3];

    fe_basis(m->type, f->order, at->xi, b, db);
    memset(value, 0, (size_t)f->n_comp * sizeof *value);
    if (gradient)
        memset(gradient, 0, (size_t)(f->n_comp * dim) * sizeof *gradient);
    for (int i = 0; i < n; i++) {
        int64_t carrier = f->order == 0 ? m->n_node : node[f->order == 2 ? i : m->type->vertex[i]];
        const double *u = x + s->first[field][carrier];
        double g[3], j[3][3], jt[3][3], ignored[3];

        for (int k = 0; k < f->n_comp; k++)
            value[k] += b[i] * u[k];
        if (!gradient)
            continue;
        jacobian(m, at->cell, at->xi, ignored, j);
        for (int p = 0; p < dim; p++)
            for (int q = 0; q < dim; q++)
                jt[p][q] = j[q][p];
        memcpy(g, db[i], sizeof g);
        solve3(dim, jt, g); /* J^T grad = reference gradient */
        for (int k = 0; k < f->n_comp; k++)
            for (int d = 0; d < dim; d++)
                gradient[k * dim + d] += u[k] * g[d];
    }
}
