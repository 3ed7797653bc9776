/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * fe.h -- reference elements and quadrature.
 *
 * Cells: triangle, quadrilateral, tetrahedron, hexahedron.  A cell carries its nodes of second
 * order (6, 9, 10, 27); nodes of order 1 are its vertices.  Quads and hexes live on [-1,1]^dim
 * with nodes in lexicographic order (x fastest); triangles and tets on the unit simplex,
 * vertices first, then the middles of edges 01 12 20 (03 13 23). */
#ifndef FE_FE_H
#define FE_FE_H

#include "base/error.h"

enum { FE_MAX_NODES = 27, FE_MAX_POINTS = 125, FE_MAX_FACET_NODES = 9 };

typedef struct fe_cell {
    int type; /* enum pf_cell_type */
    const char *name;
    int dim, simplex;
    int n_vertex, n_node; /* nodes of order 2                                   */
    int n_facet, facet_vertices, facet_nodes;
    int vertex[8];                    /* node that is vertex i                              */
    int facet[6][FE_MAX_FACET_NODES]; /* nodes of facet f: vertices first               */
    double x[FE_MAX_NODES][3];        /* reference coordinates of the nodes                 */
    double measure;                   /* of the reference cell                              */
    int vtk_type;
    int vtk[FE_MAX_NODES]; /* node that VTK calls i                              */
} fe_cell;

/* The cell of enum pf_cell_type, or NULL. */
const fe_cell *fe_cell_of(int type);

/* Number of basis functions of order 0 (one constant), 1 or 2 on the cell. */
int fe_n_basis(const fe_cell *c, int order);

/* Values n[i] and reference gradients dn[i][dim] of the basis of the order at xi. */
void fe_basis(const fe_cell *c, int order, const double *xi, double *n, double (*dn)[3]);

/* On quads and hexes this is a product of those on the line [-1, 1]: a constant, or Lagrange polynomials on {-1, 1}
 * or
 * {-1, 0, 1}; and their derivatives. */
void fe_line_basis(int order, double s, double *l, double *dl);

/* Second reference derivatives d2n[i] of the same basis: xx, yy, zz, xy, yz, zx; zero where there is no z. */
enum { FE_SECOND = 6 };
void fe_basis_second(const fe_cell *c, int order, const double *xi, double (*d2n)[FE_SECOND]);

/* Nodal values of a function of second order, [n_node], to its Bernstein coefficients in place.  The function's
 * values on the cell lie between the smallest and the largest of them. */
void fe_bernstein(const fe_cell *c, double *v);

enum { FE_MAX_GAUSS = 8 };

/* The n Gauss-Legendre points on [-1, 1], ascending, and their weights; 1 <= n <= FE_MAX_GAUSS. */
int fe_gauss(int n, double *x, double *w, error *err);

/* Quadrature on the reference cell. */
typedef struct fe_rule {
    int n;
    double x[FE_MAX_POINTS][3], w[FE_MAX_POINTS];
} fe_rule;

/* Rule exact for polynomials of the degree (per direction on quads and hexes); degree <= 7 on
 * quads and hexes, <= 5 on triangles and tets. */
int fe_rule_cell(const fe_cell *c, int degree, fe_rule *rule, error *err);

/* Rule on facet f of the cell, points in the cell's reference coordinates.  tangent[i] =
 * d xi / d s_i of the facet's own coordinates; orient is +1 or -1 such that orient * (t1 x t2),
 * in 2D orient * (t_y, -t_x), points out of the cell. */
int fe_rule_facet(const fe_cell *c, int f, int degree, fe_rule *rule, double tangent[2][3], int *orient,
                  error *err);

#endif
