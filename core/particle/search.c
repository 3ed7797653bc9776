/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Buckets of cells, so that what is near a body is found at a cost of its size, not the mesh's. */
#include "particle/particle.h"

#include "base/order.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static int bucket(const cell_grid *g, int k, double x)
{
    int i = (int)floor((x - g->low[k]) / g->width[k]);

    return i < 0 ? 0 : i >= g->n[k] ? g->n[k] - 1 : i;
}

/* Calls for every bucket that a box meets: counts (fill = 0) or enters the cell. */
static void visit(cell_grid *g, const double *box, int32_t cell, int64_t *at, int fill)
{
    int a[3] = {0}, b[3] = {0};

    for (int k = 0; k < g->dim; k++) {
        a[k] = bucket(g, k, box[k]);
        b[k] = bucket(g, k, box[3 + k]);
    }
    for (int z = a[2]; z <= b[2]; z++)
        for (int y = a[1]; y <= b[1]; y++)
            for (int x = a[0]; x <= b[0]; x++) {
                int64_t i = ((int64_t)z * g->n[1] + y) * g->n[0] + x;

                if (fill)
                    g->cell[at[i]++] = cell;
                else
                    at[i + 1]++;
            }
}

int cell_grid_create(cell_grid *g, const mesh *m, error *err)
{
    double high[3] = {0}, size = 0;
    int64_t buckets = 1, *at;

    memset(g, 0, sizeof *g);
    g->dim = m->dim;
    ARENA_NEW(&g->memory, g->box, 6 * m->n_cell, err);
    ARENA_NEW(&g->memory, g->seen, m->n_cell, err);
    for (int k = 0; k < 3; k++)
        g->low[k] = INFINITY, high[k] = -INFINITY, g->n[k] = 1;
    for (int64_t e = 0; e < m->n_cell; e++) {
        double *box = g->box + 6 * e;

        for (int k = 0; k < m->dim; k++) {
            box[k] = INFINITY, box[3 + k] = -INFINITY;
            for (int i = 0; i < m->type->n_node; i++) {
                double x = m->x[(int64_t)m->cell[e * m->type->n_node + i] * m->dim + k];

                box[k] = fmin(box[k], x);
                box[3 + k] = fmax(box[3 + k], x);
            }
            g->low[k] = fmin(g->low[k], box[k]);
            high[k] = fmax(high[k], box[3 + k]);
        }
        size += m->h[e];
    }
    size = 2 * size / (double)m->n_cell;
    for (int k = 0; k < m->dim; k++) {
        g->n[k] = (int)fmax(1, fmin(1000, floor((high[k] - g->low[k]) / size)));
        g->width[k] = (high[k] - g->low[k]) / g->n[k];
        buckets *= g->n[k];
    }
    ARENA_NEW(&g->memory, g->start, buckets + 1, err);
    for (int64_t e = 0; e < m->n_cell; e++)
        visit(g, g->box + 6 * e, (int32_t)e, g->start, 0);
    for (int64_t i = 0; i < buckets; i++)
        g->start[i + 1] += g->start[i];
    ARENA_NEW(&g->memory, g->cell, g->start[buckets], err);
    ARENA_NEW(&g->memory, at, buckets + 1, err);
    memcpy(at, g->start, (size_t)buckets * sizeof *at);
    for (int64_t e = 0; e < m->n_cell; e++)
        visit(g, g->box + 6 * e, (int32_t)e, at, 1);
    return 0;
}

int64_t cell_grid_ball(cell_grid *g, const double *x, double radius, int32_t *list)
{
    int a[3] = {0}, b[3] = {0};
    int64_t n = 0;

    g->query++;
    for (int k = 0; k < g->dim; k++) {
        a[k] = bucket(g, k, x[k] - radius);
        b[k] = bucket(g, k, x[k] + radius);
    }
    for (int z = a[2]; z <= b[2]; z++)
        for (int y = a[1]; y <= b[1]; y++)
            for (int c = a[0]; c <= b[0]; c++) {
                int64_t i = ((int64_t)z * g->n[1] + y) * g->n[0] + c;

                for (int64_t k = g->start[i]; k < g->start[i + 1]; k++) {
                    const double *box = g->box + 6 * (int64_t)g->cell[k];
                    double d2 = 0;

                    if (g->seen[g->cell[k]] == g->query)
                        continue;
                    g->seen[g->cell[k]] = g->query;
                    for (int q = 0; q < g->dim; q++) {
                        double d = fmax(0, fmax(box[q] - x[q], x[q] - box[3 + q]));

                        d2 += d * d;
                    }
                    if (d2 <= radius * radius)
                        list[n++] = g->cell[k];
                }
            }
    qsort(list, (size_t)n, sizeof *list, order_int32);
    return n;
}

void cell_grid_destroy(cell_grid *g)
{
    arena_free(&g->memory);
    memset(g, 0, sizeof *g);
}
