/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Points to cells: candidates by their boxes, then Newton on the mapping. */
#include "space/locate.h"

#include "base/dense.h"
#include "space/evaluate.h"

#include <math.h>

#define OUTSIDE 1e-8 /* in reference coordinates: on a facet is inside */

static int is_inside(const fe_cell *c, const double *xi)
{
    double sum = 0;

    for (int k = 0; k < c->dim; k++) {
        if (!(c->simplex ? xi[k] >= -OUTSIDE : fabs(xi[k]) <= 1 + OUTSIDE)) /* nor where x is no number */
            return 0;
        sum += xi[k];
    }
    return !c->simplex || sum <= 1 + OUTSIDE;
}

/* In a box the mapping is linear, direction by direction. */
static void locate_in_box(const mesh *m, int64_t cell, const double *x, double *xi)
{
    double at[3], j[3][3];

    mesh_place(m, cell, (const double[3]){0}, at, j);
    for (int k = 0; k < 3; k++)
        xi[k] = k < m->dim ? (x[k] - at[k]) / j[k][k] : 0;
}

int locate_in_cell(const mesh *m, int64_t cell, const double *x, double *xi)
{
    if (m->is_box && m->is_box[cell]) {
        locate_in_box(m, cell, x, xi);
        return is_inside(m->type, xi);
    }
    for (int k = 0; k < 3; k++)
        xi[k] = m->type->simplex ? 0.25 : 0;
    for (int it = 0; it < 30; it++) {
        double at[3], j[3][3], d[3] = {0}, size = 0;

        mesh_place(m, cell, xi, at, j);
        for (int k = 0; k < m->dim; k++)
            d[k] = x[k] - at[k];
        if (dense_solve(3, &j[0][0], d))
            return -1;
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

/* Whether x is in the box of the cell, or only by round-off outside. */
static int is_near(const cell_grid *g, int32_t cell, const double *x)
{
    for (int k = 0; k < g->dim; k++) {
        double low = g->box[cell][0][k], high = g->box[cell][1][k], margin = BOX_GRID_MARGIN * (high - low);

        if (!(x[k] >= low - margin && x[k] <= high + margin))
            return 0;
    }
    return 1;
}

located locate_point(const mesh *m, const cell_grid *grid, const double *x)
{
    located at = {.cell = -1};
    int64_t n;
    const int32_t *cell = box_grid_at(grid, x, &n);

    for (int64_t i = 0; i < n && at.cell < 0; i++)
        if (is_near(grid, cell[i], x) && locate_in_cell(m, cell[i], x, at.xi) > 0)
            at.cell = cell[i];
    return at;
}

void locate_value(const space *s, const located *at, int field, const double *x, double *value, double *gradient)
{
    space_evaluate(s, field, x, at->cell, at->xi, &(point_values){.value = value, .gradient = gradient});
}
