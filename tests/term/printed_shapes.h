/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * printed_shapes.h -- shape functions and Gauss points of the printed formulas.
 *
 * phi (second order) and psi (first order) on the cells that core/fe/fe.h describes, written a
 * second time: from Lagrange's formula on quads and hexes, in barycentric coordinates on
 * triangles and tets.  Nothing of core/fe is called. */
#ifndef PRINTED_SHAPES_H
#define PRINTED_SHAPES_H

enum { PRINTED_NODES = 27, PRINTED_POINTS = 27 };

typedef struct printed_cell {
    int dim, simplex;
    int n_phi, n_psi;
    int psi_node[8]; /* node of the cell at which psi_i is 1                  */
    int n_point;
    double s[PRINTED_POINTS][3]; /* points in the reference cell, unused coordinates 0  */
    double weight[PRINTED_POINTS];
} printed_cell;

/* Quad (dim 2), hex (dim 3), or triangle and tet (simplex). */
void printed_cell_make(int dim, int simplex, printed_cell *c);

/* phi[n_phi] and its gradients in reference coordinates, dphi[n_phi][3], at s. */
void printed_phi(const printed_cell *c, const double *s, double *phi, double (*dphi)[3]);
/* psi[n_psi] at s. */
void printed_psi(const printed_cell *c, const double *s, double *psi);

#endif
