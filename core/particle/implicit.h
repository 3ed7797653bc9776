/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * implicit.h -- between the files of the implicit quadrature: implicit.c divides boxes and calls
 * implicit_lines.c, which calls implicit_level.c.
 *
 * c[dim]: coordinates of the unit box that the reference cell is the image of. */
#ifndef PARTICLE_IMPLICIT_H
#define PARTICLE_IMPLICIT_H

#include "particle/particle.h"

/* A cell that is being integrated. */
typedef struct implicit_work {
    const implicit_rule *rule;
    const mesh *m;
    const solid *b;
    const implicit_sink *sink;
    int32_t cell;
    int dim, affine;
    int partly;            /* something of the cell is outside of the body */
    int most_depth;        /* of the division into boxes                   */
    double x0[3], j[3][3]; /* of the cell, if it is affine                 */
    double size;           /* of the cell                                  */
} implicit_work;

/* A part of the unit box. */
typedef struct implicit_box {
    double low[3], high[3];
} implicit_box;

/* --- implicit_level.c --- */

/* Reference coordinates of c, and their derivatives d[i][k] = d xi_i / d c_k; returns the determinant. */
double implicit_reference(const implicit_work *w, const double *c, double *xi, double d[3][3]);
/* Place of reference coordinates; j[a][b] = d x_a / d xi_b (2D: j[2][2] = 1, the rest of what is unused as it was).
 */
void implicit_place(const implicit_work *w, const double *xi, double *x, double j[3][3]);
double implicit_level(const implicit_work *w, const double *c);
/* Gradient with respect to c, also to x; part[k]: along the line of c_k in space, per length (NAN where the line is
 * a point, in the corner of a collapsed box). */
void implicit_slope(const implicit_work *w, const double *c, double *by_c, double *by_x, double *part);

/* --- implicit_lines.c --- */

/* Passes a point inside on. */
void implicit_emit(const implicit_work *w, const double *c, double weight);
/* Lines along k on Gauss points of direction j, split where the surface meets the sides low and high of k. */
void implicit_sweep(implicit_work *w, const implicit_box *b, double *c, int k, int j, double weight);
/* In 3D: sweeps on Gauss points of direction i, split where the surface meets the four edges of k and j. */
void implicit_sweep_planes(implicit_work *w, const implicit_box *b, int k, int j, int i);

#endif
