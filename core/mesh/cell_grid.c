/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Boxes of cells.  A curved cell reaches beyond the box of its nodes, but not beyond that of its Bernstein
 * coefficients. */
#include "mesh/cell_grid.h"

#include "base/order.h"

#include <math.h>
#include <stdlib.h>

int cell_grid_create(cell_grid *g, const mesh *m, error *err)
{
    double size = 0;

    TRY(box_grid_create(g, m->dim, m->n_cell, err));
    for (int64_t e = 0; e < m->n_cell; e++) {
        const int32_t *node = m->cell + e * m->type->n_node;

        for (int k = 0; k < m->dim; k++) {
            double x[FE_MAX_NODES], low = INFINITY, high = -INFINITY;

            for (int i = 0; i < m->type->n_node; i++)
                x[i] = m->x[(int64_t)node[i] * m->dim + k];
            fe_bernstein(m->type, x);
            for (int i = 0; i < m->type->n_node; i++) {
                low = fmin(low, x[i]);
                high = fmax(high, x[i]);
            }
            g->box[e][0][k] = low;
            g->box[e][1][k] = high;
        }
        size += m->h[e];
    }
    return box_grid_build(g, 2 * size / (double)m->n_cell, err);
}

typedef struct cell_list {
    int32_t *cell;
    int64_t n;
} cell_list;

static void add(void *ctx, int32_t cell)
{
    cell_list *l = ctx;

    l->cell[l->n++] = cell;
}

int64_t cell_grid_ball(const cell_grid *g, const double *x, double radius, int32_t *list)
{
    cell_list l = {list, 0};

    box_grid_ball(g, x, radius, add, &l);
    qsort(list, (size_t)l.n, sizeof *list, order_int32);
    return l.n;
}

void cell_grid_destroy(cell_grid *g)
{
    box_grid_destroy(g);
}
