/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Lagrange bases: products of 1D polynomials on quads and hexes, barycentric on simplices. */
#include "fe/fe.h"

#include <plugflow/mesh.h>

#include <string.h>

static const fe_cell triangle = {
    .type = PF_TRI6,
    .name = "triangle",
    .dim = 2,
    .simplex = 1,
    .n_vertex = 3,
    .n_node = 6,
    .n_facet = 3,
    .facet_vertices = 2,
    .facet_nodes = 3,
    .vertex = {0, 1, 2},
    .facet = {{0, 1, 3}, {1, 2, 4}, {2, 0, 5}},
    .x = {{0, 0}, {1, 0}, {0, 1}, {.5, 0}, {.5, .5}, {0, .5}},
    .measure = 0.5,
    .vtk_type = 22,
    .vtk = {0, 1, 2, 3, 4, 5},
};

static const fe_cell quad = {
    .type = PF_QUAD9,
    .name = "quadrilateral",
    .dim = 2,
    .n_vertex = 4,
    .n_node = 9,
    .n_facet = 4,
    .facet_vertices = 2,
    .facet_nodes = 3,
    .vertex = {0, 2, 6, 8},
    .facet = {{0, 2, 1}, {2, 8, 5}, {8, 6, 7}, {6, 0, 3}},
    .x = {{-1, -1}, {0, -1}, {1, -1}, {-1, 0}, {0, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}},
    .measure = 4,
    .vtk_type = 28,
    .vtk = {0, 2, 8, 6, 1, 5, 7, 3, 4},
};

static const fe_cell tet = {
    .type = PF_TET10,
    .name = "tetrahedron",
    .dim = 3,
    .simplex = 1,
    .n_vertex = 4,
    .n_node = 10,
    .n_facet = 4,
    .facet_vertices = 3,
    .facet_nodes = 6,
    .vertex = {0, 1, 2, 3},
    .facet = {{0, 2, 1, 6, 5, 4}, {0, 1, 3, 4, 8, 7}, {1, 2, 3, 5, 9, 8}, {2, 0, 3, 6, 7, 9}},
    .x = {{0, 0, 0},
          {1, 0, 0},
          {0, 1, 0},
          {0, 0, 1},
          {.5, 0, 0},
          {.5, .5, 0},
          {0, .5, 0},
          {0, 0, .5},
          {.5, 0, .5},
          {0, .5, .5}},
    .measure = 1.0 / 6,
    .vtk_type = 24,
    .vtk = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9},
};

/* Facets x-, x+, y-, y+, z-, z+. */
static const fe_cell hex = {
    .type = PF_HEX27,
    .name = "hexahedron",
    .dim = 3,
    .n_vertex = 8,
    .n_node = 27,
    .n_facet = 6,
    .facet_vertices = 4,
    .facet_nodes = 9,
    .vertex = {0, 2, 6, 8, 18, 20, 24, 26},
    .facet = {{0, 6, 18, 24, 3, 9, 12, 15, 21},
              {2, 8, 20, 26, 5, 11, 14, 17, 23},
              {0, 2, 18, 20, 1, 9, 10, 11, 19},
              {6, 8, 24, 26, 7, 15, 16, 17, 25},
              {0, 2, 6, 8, 1, 3, 4, 5, 7},
              {18, 20, 24, 26, 19, 21, 22, 23, 25}},
    .x = {{-1, -1, -1}, {0, -1, -1}, {1, -1, -1}, {-1, 0, -1}, {0, 0, -1},  {1, 0, -1}, {-1, 1, -1},
          {0, 1, -1},   {1, 1, -1},  {-1, -1, 0}, {0, -1, 0},  {1, -1, 0},  {-1, 0, 0}, {0, 0, 0},
          {1, 0, 0},    {-1, 1, 0},  {0, 1, 0},   {1, 1, 0},   {-1, -1, 1}, {0, -1, 1}, {1, -1, 1},
          {-1, 0, 1},   {0, 0, 1},   {1, 0, 1},   {-1, 1, 1},  {0, 1, 1},   {1, 1, 1}},
    .measure = 8,
    .vtk_type = 29,
    .vtk = {0, 2, 8, 6, 18, 20, 26, 24, 1, 5, 7, 3, 19, 23, 25, 21, 9, 11, 17, 15, 12, 14, 10, 16, 4, 22, 13},
};

const fe_cell *fe_cell_of(int type)
{
    switch (type) {
    case PF_TRI6:
        return &triangle;
    case PF_QUAD9:
        return &quad;
    case PF_TET10:
        return &tet;
    case PF_HEX27:
        return &hex;
    default:
        return NULL;
    }
}

int fe_n_basis(const fe_cell *c, int order)
{
    return order == 2 ? c->n_node : order == 1 ? c->n_vertex : 1;
}

void fe_line_basis(int order, double s, double *l, double *dl)
{
    if (order == 0) {
        l[0] = 1, dl[0] = 0;
    } else if (order == 2) {
        l[0] = 0.5 * s * (s - 1), dl[0] = s - 0.5;
        l[1] = 1 - s * s, dl[1] = -2 * s;
        l[2] = 0.5 * s * (s + 1), dl[2] = s + 0.5;
    } else {
        l[0] = 0.5 * (1 - s), dl[0] = -0.5;
        l[1] = 0.5 * (1 + s), dl[1] = 0.5;
    }
}

/* Those of all directions; of the third in 2D there is a constant. */
static void line_bases(int dim, int order, const double *xi, double (*l)[3], double (*dl)[3])
{
    for (int k = 0; k < dim; k++)
        fe_line_basis(order, xi[k], l[k], dl[k]);
    if (dim == 2)
        l[2][0] = 1;
}

static void tensor_basis(int dim, int order, const double *xi, double *n, double (*dn)[3])
{
    double l[3][3] = {{0}}, dl[3][3] = {{0}};
    int m = order + 1, mz = dim == 3 ? m : 1;

    line_bases(dim, order, xi, l, dl);
    for (int c = 0, i = 0; c < mz; c++)
        for (int b = 0; b < m; b++)
            for (int a = 0; a < m; a++, i++) {
                n[i] = l[0][a] * l[1][b] * l[2][c];
                dn[i][0] = dl[0][a] * l[1][b] * l[2][c];
                dn[i][1] = l[0][a] * dl[1][b] * l[2][c];
                dn[i][2] = l[0][a] * l[1][b] * dl[2][c];
            }
}

/* Middles of edges of a simplex, after its vertices: the vertices they lie between. */
static const int simplex_edge[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};

/* Gradients of the barycentric coordinates. */
static const double barycentric_slope[4][3] = {{-1, -1, -1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

static void simplex_basis(int dim, int order, const double *xi, double *n, double (*dn)[3])
{
    const double(*db)[3] = barycentric_slope;
    double b[4] = {1, 0, 0, 0};
    int nv = dim + 1, ne = dim == 2 ? 3 : 6;

    for (int k = 0; k < dim; k++) {
        b[k + 1] = xi[k];
        b[0] -= xi[k];
    }
    for (int i = 0; i < nv; i++) {
        n[i] = order == 2 ? b[i] * (2 * b[i] - 1) : b[i];
        for (int k = 0; k < 3; k++)
            dn[i][k] = order == 2 ? (4 * b[i] - 1) * db[i][k] : db[i][k];
    }
    for (int e = 0; order == 2 && e < ne; e++) {
        int p = simplex_edge[e][0], q = simplex_edge[e][1];

        n[nv + e] = 4 * b[p] * b[q];
        for (int k = 0; k < 3; k++)
            dn[nv + e][k] = 4 * (b[p] * db[q][k] + b[q] * db[p][k]);
    }
}

void fe_basis(const fe_cell *c, int order, const double *xi, double *n, double (*dn)[3])
{
    if (order == 0) {
        n[0] = 1;
        memset(dn[0], 0, sizeof dn[0]);
    } else if (c->simplex) {
        simplex_basis(c->dim, order, xi, n, dn);
    } else {
        tensor_basis(c->dim, order, xi, n, dn);
    }
}

static void tensor_second(int dim, int order, const double *xi, double (*d2n)[FE_SECOND])
{
    double l[3][3] = {{0}}, dl[3][3] = {{0}};
    const double d2l[3] = {order == 2 ? 1 : 0, order == 2 ? -2 : 0, order == 2 ? 1 : 0};
    int m = order + 1, mz = dim == 3 ? m : 1;

    line_bases(dim, order, xi, l, dl);
    for (int c = 0, i = 0; c < mz; c++)
        for (int b = 0; b < m; b++)
            for (int a = 0; a < m; a++, i++) {
                d2n[i][0] = d2l[a] * l[1][b] * l[2][c];
                d2n[i][1] = l[0][a] * d2l[b] * l[2][c];
                d2n[i][2] = dim == 3 ? l[0][a] * l[1][b] * d2l[c] : 0;
                d2n[i][3] = dl[0][a] * dl[1][b] * l[2][c];
                d2n[i][4] = l[0][a] * dl[1][b] * dl[2][c];
                d2n[i][5] = dl[0][a] * l[1][b] * dl[2][c];
            }
}

static void simplex_second(int dim, int order, double (*d2n)[FE_SECOND])
{
    static const int of[FE_SECOND][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};
    int nv = dim + 1, ne = dim == 2 ? 3 : 6;

    for (int s = 0; s < FE_SECOND; s++) {
        int k = of[s][0], l = of[s][1], on = order == 2 && k < dim && l < dim;

        for (int i = 0; i < nv; i++)
            d2n[i][s] = on ? 4 * barycentric_slope[i][k] * barycentric_slope[i][l] : 0;
        for (int e = 0; order == 2 && e < ne; e++) {
            const double *p = barycentric_slope[simplex_edge[e][0]], *q = barycentric_slope[simplex_edge[e][1]];

            d2n[nv + e][s] = on ? 4 * (p[k] * q[l] + q[k] * p[l]) : 0;
        }
    }
}

void fe_basis_second(const fe_cell *c, int order, const double *xi, double (*d2n)[FE_SECOND])
{
    if (order == 0)
        memset(d2n[0], 0, sizeof d2n[0]);
    else if (c->simplex)
        simplex_second(c->dim, order, d2n);
    else
        tensor_second(c->dim, order, xi, d2n);
}

void fe_bernstein(const fe_cell *c, double *v)
{
    int nv = c->n_vertex;

    if (c->simplex) {
        for (int e = 0; nv + e < c->n_node; e++)
            v[nv + e] = 2 * v[nv + e] - 0.5 * (v[simplex_edge[e][0]] + v[simplex_edge[e][1]]);
        return;
    }
    for (int k = 0, step = 1; k < c->dim; k++, step *= 3) /* line by line, one direction after the other */
        for (int i = 0; i < c->n_node; i++)
            if (i / step % 3 == 1)
                v[i] = 2 * v[i] - 0.5 * (v[i - step] + v[i + step]);
}
