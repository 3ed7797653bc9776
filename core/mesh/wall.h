/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * wall.h -- distances from walls: any set of boundary facets, straight or curved. */
#ifndef MESH_WALL_H
#define MESH_WALL_H

#include "mesh/box_grid.h"
#include "mesh/facet.h"

typedef struct wall {
    const mesh *mesh;
    int64_t n;
    int32_t *number; /* [n] of the facets in mesh->facet */
    facet *facet;    /* [n] */
    box_grid grid;
    int n_image; /* of a place by the periods of the mesh */
    double image[MESH_MAX_IMAGES][3];
    arena memory;
} wall;

/* Of the boundary facets with on[i] != 0, i < m->n_facet; the mesh must stay. */
int wall_create(wall *w, const mesh *m, const uint8_t *on, error *err);
void wall_destroy(wall *w);

/* Where the distance of a place from the walls has a local minimum. */
typedef struct wall_point {
    double distance;  /* negative: the place lies outside of the domain */
    double x[3];      /* the point of the wall */
    double normal[3]; /* unit vector into the domain; the place is x + distance * normal */
    int32_t facet;    /* of the mesh */
    int boundary;     /* the first of the facet's names, -1 without one */
} wall_point;

/* Up to `most` of the local minima within range of the place x[dim], the nearest first: one in front of a plane or
 * round wall, two or three in a corner.  Minima whose normals differ by less than 15 degrees count as one (the
 * nearer), so that a polygon or a joint of curved facets is one wall.  Walls are continued through periodic
 * boundaries.  A wall that the place is behind counts if it is the nearest.  *n: how many.  ERR_MEMORY. */
int wall_near(const wall *w, const double *x, double range, int most, wall_point *list, int *n, error *err);

#endif
