/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Box meshes.  The grid of second-order nodes has 2n+1 points a direction.  A quad is split
 * into two triangles, a hex into six tets around its main diagonal (Kuhn), so that facets
 * of neighbours match. */
#include "mesh/mesh.h"

#include <plugflow/mesh.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *mesh_box_side(int side)
{
    static const char *const name[6] = {"left", "right", "bottom", "top", "back", "front"};

    return name[side];
}

/* Position of grid point i (of 2n+1) along direction k. */
static double grid_position(const mesh_box *box, int k, int i)
{
    const double *tick = box->ticks[k];
    int c = i / 2;

    if (!tick)
        return i == 2 * box->n[k] ? box->high[k]
                                  : box->low[k] + (box->high[k] - box->low[k]) * i / (2.0 * box->n[k]);
    return i % 2 == 0 ? tick[c] : 0.5 * (tick[c] + tick[c + 1]);
}

/* Grid offsets (0..2 a direction) of the nodes of the simplices that a box cell is split into. */
static int simplex_nodes(int dim, int s, int node[10][3])
{
    static const int order[6][3] = {{0, 1, 2}, {1, 0, 2}, {1, 2, 0}, {2, 1, 0}, {2, 0, 1}, {0, 2, 1}};
    static const int edge[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
    int odd = s % 2, nv = dim + 1;

    memset(node, 0, 10 * sizeof node[0]);
    for (int i = 1; i < nv; i++) {
        memcpy(node[i], node[i - 1], sizeof node[0]);
        node[i][order[s][i - 1]] += 2;
    }
    if (odd) /* keep the volume positive */
        for (int k = 0; k < 3; k++) {
            int swap = node[nv - 2][k];

            node[nv - 2][k] = node[nv - 1][k];
            node[nv - 1][k] = swap;
        }
    for (int e = 0; e < (dim == 2 ? 3 : 6); e++)
        for (int k = 0; k < 3; k++)
            node[nv + e][k] = (node[edge[e][0]][k] + node[edge[e][1]][k]) / 2;
    return dim == 2 ? 2 : 6;
}

static int32_t grid_node(const mesh_box *box, int i, int j, int k)
{
    int64_t nx = 2 * box->n[0] + 1, ny = 2 * box->n[1] + 1;

    return (int32_t)(((int64_t)k * ny + j) * nx + i);
}

static void fill_cells(const mesh_box *box, mesh *m)
{
    int split = box->simplex ? (box->dim == 2 ? 2 : 6) : 1;
    int32_t *cell = m->cell;

    for (int k = 0; k < (box->dim == 3 ? box->n[2] : 1); k++)
        for (int j = 0; j < box->n[1]; j++)
            for (int i = 0; i < box->n[0]; i++)
                for (int s = 0; s < split; s++, cell += m->type->n_node) {
                    int node[10][3];

                    if (box->simplex)
                        simplex_nodes(box->dim, s, node);
                    for (int a = 0; a < m->type->n_node; a++) {
                        int o[3] = {a % 3, a / 3 % 3, a / 9};

                        if (box->simplex)
                            memcpy(o, node[a], sizeof o);
                        cell[a] = grid_node(box, 2 * i + o[0], 2 * j + o[1], 2 * k + o[2]);
                    }
                }
}

/* Bit of each side of the box that all vertices of the facet are on. */
static uint64_t facet_sides(const mesh_box *box, const mesh *m, const int32_t *cell, int f)
{
    int64_t nx = 2 * box->n[0] + 1, ny = 2 * box->n[1] + 1;
    uint64_t sides = 0x3f;

    for (int v = 0; v < m->type->facet_vertices; v++) {
        int64_t node = cell[m->type->facet[f][v]];
        int64_t at[3] = {node % nx, node / nx % ny, node / (nx * ny)};
        uint64_t on = 0;

        for (int k = 0; k < box->dim; k++) {
            on |= at[k] == 0 ? 1u << (2 * k) : 0;
            on |= at[k] == 2 * box->n[k] ? 2u << (2 * k) : 0;
        }
        sides &= on;
    }
    return sides;
}

static int fill_facets(const mesh_box *box, mesh *m, error *err)
{
    for (int pass = 0; pass < 2; pass++) {
        int64_t n = 0;

        for (int f = 0; f < m->type->n_facet; f++)
            for (int64_t c = 0; c < m->n_cell; c++) {
                uint64_t sides = facet_sides(box, m, m->cell + c * m->type->n_node, f);

                if (!sides)
                    continue;
                if (pass)
                    m->facet[n] = (mesh_facet){(int32_t)c, f, sides};
                n++;
            }
        m->n_facet = n;
        if (!pass)
            ARENA_NEW(&m->memory, m->facet, n, err);
    }
    return 0;
}

int mesh_create_box(const mesh_box *box, mesh *m, error *err)
{
    int type = box->dim == 2 ? (box->simplex ? PF_TRI6 : PF_QUAD9) : (box->simplex ? PF_TET10 : PF_HEX27);
    double cells = box->simplex ? (box->dim == 2 ? 2 : 6) : 1, nodes = 1;

    memset(m, 0, sizeof *m);
    m->dim = box->dim;
    m->type = fe_cell_of(type);
    for (int k = 0; k < box->dim; k++) {
        cells *= box->n[k];
        nodes *= 2.0 * box->n[k] + 1;
    }
    if (nodes > 2147483647.0 / 4)
        return error_set(err, ERR_MEMORY, "mesh: %.3g nodes are more than this build can number (%.3g)", nodes,
                         2147483647.0 / 4);
    m->n_cell = (int64_t)cells;
    m->n_node = (int64_t)nodes;
    ARENA_NEW(&m->memory, m->x, m->n_node * m->dim, err);
    ARENA_NEW(&m->memory, m->cell, m->n_cell * m->type->n_node, err);
    for (int64_t i = 0; i < m->n_node; i++) {
        int64_t nx = 2 * box->n[0] + 1, ny = 2 * box->n[1] + 1, at[3] = {i % nx, i / nx % ny, i / (nx * ny)};

        for (int k = 0; k < m->dim; k++)
            m->x[i * m->dim + k] = grid_position(box, k, (int)at[k]);
    }
    fill_cells(box, m);
    TRY(fill_facets(box, m, err));
    m->n_name = 2 * m->dim;
    for (int i = 0; i < m->n_name; i++)
        if (!(m->name[i] = arena_strdup(&m->memory, mesh_box_side(i))))
            return error_memory(err, "mesh names", 0);
    return 0;
}
