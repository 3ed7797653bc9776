/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * facet.h -- a boundary facet as a surface in space, straight or curved: places, normals, nearest points. */
#ifndef MESH_FACET_H
#define MESH_FACET_H

#include "mesh/mesh.h"

enum { FACET_MAX_VERTICES = 4 };

/* Coordinates (s, t): -1 <= s <= 1 on a line (2D); -1 <= s, t <= 1 on a quadrilateral; s, t >= 0, s + t <= 1 on a
 * triangle. */
enum facet_kind { FACET_LINE, FACET_QUAD, FACET_TRIANGLE };

/* x_k(s, t) = sum_ij c[k][i][j] s^i t^j. */
typedef struct facet {
    enum facet_kind kind;
    int dim;
    double c[3][3][3];
    double inward; /* 1 or -1: inward * (x_s cross x_t), in 2D inward * (dy/ds, -dx/ds), points into the cell */
    double size;   /* largest extent of its box                                                         */
} facet;

/* The boundary facet f of the mesh, and a box that holds all of it. */
int facet_create(facet *f, const mesh *m, int64_t number, double box[2][3], error *err);

/* A point of a facet. */
typedef struct facet_point {
    double s[2], x[3];
    double distance; /* from the place that it is nearest to */
    int n_vertex;    /* 0: inside the facet; 1: at a vertex; 2: on the edge between two        */
    int vertex[2];   /* their numbers                                                          */
} facet_point;

/* The point nearest to x[dim]. */
void facet_nearest(const facet *f, const double *x, facet_point *p);
/* Unit normal into the domain at (s, t); 0 where the facet is degenerate. */
void facet_normal(const facet *f, const double *s, double *n);
int facet_n_vertex(const facet *f);
void facet_vertex(const facet *f, int i, double *x);
/* Axis along which the normal of a facet of the mesh lies, or -1. */
int facet_axis(const mesh *m, int64_t facet);

#endif
