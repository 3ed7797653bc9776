/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Shape functions and Gauss points of the printed formulas.
 *
 *     quads, hexes    l_a(s) = prod_{b != a} (s - s_b) / (s_a - s_b),  phi = l_a l_b l_c
 *     simplices       phi = L_i (2 L_i - 1) at vertices, 4 L_i L_j on edges,  psi = L_i
 *
 * Points: 3 of Gauss a direction; 7 of Radon (1948) on triangles; 14 of Walkington (2000) on tets. */
#include "printed_shapes.h"

#include <math.h>
#include <string.h>

/* Value and slope of the polynomial that is 1 at node[a] and 0 at the other nodes. */
static double lagrange(const double *node, int n, int a, double s, double *slope)
{
    double value = 1;

    *slope = 0;
    for (int b = 0; b < n; b++) {
        double others = 1;

        if (b == a)
            continue;
        value *= (s - node[b]) / (node[a] - node[b]);
        for (int c = 0; c < n; c++)
            if (c != a && c != b)
                others *= (s - node[c]) / (node[a] - node[c]);
        *slope += others / (node[a] - node[b]);
    }
    return value;
}

/* L_0 = 1 - s_0 - s_1 (- s_2), L_1 = s_0, ... */
static void barycentric(const printed_cell *c, const double *s, double *l)
{
    l[0] = 1;
    for (int k = 0; k < c->dim; k++) {
        l[k + 1] = s[k];
        l[0] -= s[k];
    }
}

/* dL_i / ds_k */
static double barycentric_slope(int i, int k)
{
    return i == 0 ? -1 : i == k + 1 ? 1 : 0;
}

static void phi_simplex(const printed_cell *c, const double *s, double *phi, double (*dphi)[3])
{
    static const int end[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
    double l[4];

    barycentric(c, s, l);
    for (int a = 0; a < c->n_phi; a++) {
        int vertex = a <= c->dim, i = vertex ? a : end[a - c->dim - 1][0], j = vertex ? a : end[a - c->dim - 1][1];

        phi[a] = vertex ? l[i] * (2 * l[i] - 1) : 4 * l[i] * l[j];
        for (int k = 0; k < c->dim; k++)
            dphi[a][k] = vertex ? (4 * l[i] - 1) * barycentric_slope(i, k)
                                : 4 * l[i] * barycentric_slope(j, k) + 4 * l[j] * barycentric_slope(i, k);
    }
}

static void phi_box(const printed_cell *c, const double *s, double *phi, double (*dphi)[3])
{
    static const double node[3] = {-1, 0, 1};

    for (int i = 0; i < c->n_phi; i++) {
        int at[3] = {i % 3, i / 3 % 3, i / 9};
        double l[3] = {1, 1, 1}, dl[3] = {0, 0, 0};

        for (int k = 0; k < c->dim; k++)
            l[k] = lagrange(node, 3, at[k], s[k], &dl[k]);
        phi[i] = l[0] * l[1] * l[2];
        dphi[i][0] = dl[0] * l[1] * l[2];
        dphi[i][1] = l[0] * dl[1] * l[2];
        dphi[i][2] = l[0] * l[1] * dl[2];
    }
}

void printed_phi(const printed_cell *c, const double *s, double *phi, double (*dphi)[3])
{
    memset(dphi, 0, (size_t)c->n_phi * sizeof *dphi);
    if (c->simplex)
        phi_simplex(c, s, phi, dphi);
    else
        phi_box(c, s, phi, dphi);
}

void printed_psi(const printed_cell *c, const double *s, double *psi)
{
    static const double node[2] = {-1, 1};
    double unused;

    if (c->simplex) {
        barycentric(c, s, psi);
        return;
    }
    for (int i = 0; i < c->n_psi; i++) {
        psi[i] = 1;
        for (int k = 0; k < c->dim; k++)
            psi[i] *= lagrange(node, 2, i >> k & 1, s[k], &unused);
    }
}

static void point(printed_cell *c, double weight, double s0, double s1, double s2)
{
    c->s[c->n_point][0] = s0;
    c->s[c->n_point][1] = s1;
    c->s[c->n_point][2] = s2;
    c->weight[c->n_point++] = weight;
}

static void points_box(printed_cell *c)
{
    const double x[3] = {-sqrt(3.0 / 5), 0, sqrt(3.0 / 5)}, w[3] = {5.0 / 9, 8.0 / 9, 5.0 / 9};

    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            for (int k = 0; k < (c->dim == 3 ? 3 : 1); k++)
                point(c, w[i] * w[j] * (c->dim == 3 ? w[k] : 1), x[i], x[j], c->dim == 3 ? x[k] : 0);
}

/* Weights of the literature are of the area; the triangle has the area 1/2. */
static void points_triangle(printed_cell *c)
{
    const double root = sqrt(15.0), near = (6 - root) / 21, far = (6 + root) / 21;
    const double w_near = (155 - root) / 1200 / 2, w_far = (155 + root) / 1200 / 2;

    point(c, 9.0 / 40 / 2, 1.0 / 3, 1.0 / 3, 0);
    point(c, w_near, near, near, 0);
    point(c, w_near, near, 1 - 2 * near, 0);
    point(c, w_near, 1 - 2 * near, near, 0);
    point(c, w_far, far, far, 0);
    point(c, w_far, far, 1 - 2 * far, 0);
    point(c, w_far, 1 - 2 * far, far, 0);
}

/* Two orbits of 4 points, L = (1 - 3a, a, a, a), and one of 6, L = (b, b, 1/2 - b, 1/2 - b). */
static void points_tet(printed_cell *c)
{
    const double a[2] = {0.3108859192633006, 0.09273525031089123};
    const double w[2] = {0.01878132095300264, 0.01224884051939366};
    const double b = 0.04550370412564965, w_b = 0.007091003462846911;

    for (int orbit = 0; orbit < 2; orbit++)
        for (int i = 0; i < 4; i++) {
            double l[4] = {a[orbit], a[orbit], a[orbit], a[orbit]};

            l[i] = 1 - 3 * a[orbit];
            point(c, w[orbit], l[1], l[2], l[3]);
        }
    for (int i = 0; i < 4; i++)
        for (int j = i + 1; j < 4; j++) {
            double l[4] = {0.5 - b, 0.5 - b, 0.5 - b, 0.5 - b};

            l[i] = l[j] = b;
            point(c, w_b, l[1], l[2], l[3]);
        }
}

void printed_cell_make(int dim, int simplex, printed_cell *c)
{
    memset(c, 0, sizeof *c);
    c->dim = dim;
    c->simplex = simplex;
    c->n_phi = simplex ? (dim + 1) * (dim + 2) / 2 : dim == 2 ? 9 : 27;
    c->n_psi = simplex ? dim + 1 : 1 << dim;
    for (int i = 0; i < c->n_psi; i++)
        c->psi_node[i] = simplex ? i : 2 * (i & 1) + 6 * (i >> 1 & 1) + 18 * (i >> 2);
    if (!simplex)
        points_box(c);
    else if (dim == 2)
        points_triangle(c);
    else
        points_tet(c);
}
