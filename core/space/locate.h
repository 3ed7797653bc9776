/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * locate.h -- the cell that a point lies in, and fields at that point. */
#ifndef SPACE_LOCATE_H
#define SPACE_LOCATE_H

#include "mesh/cell_grid.h"
#include "space/space.h"

typedef struct located {
    int32_t cell; /* -1: outside the mesh */
    double xi[3]; /* reference coordinates */
} located;

/* Reference coordinates of x[dim] in a cell: 1 inside, 0 outside (the mapping continued), -1 not found. */
int locate_in_cell(const mesh *m, int64_t cell, const double *x, double *xi);
/* The cell of x[dim], of several the one with the lowest number; grid: of the same mesh.  A point that left through
 * a periodic boundary is outside; mesh_wrap brings it back. */
located locate_point(const mesh *m, const cell_grid *grid, const double *x);
/* Value[n_comp] and, unless NULL, gradient[n_comp][dim] of a field there (see space_evaluate). */
void locate_value(const space *s, const located *at, int field, const double *x, double *value, double *gradient);

#endif
