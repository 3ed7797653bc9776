/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * cell_grid.h -- which cells of a mesh are near a point.  The box of a cell holds all of it, curved as it may be;
 * that of a straight cell is the box of its vertices. */
#ifndef MESH_CELL_GRID_H
#define MESH_CELL_GRID_H

#include "mesh/box_grid.h"
#include "mesh/mesh.h"

typedef box_grid cell_grid;

/* Of a mesh that has been measured; it is not needed any more afterwards. */
int cell_grid_create(cell_grid *g, const mesh *m, error *err);
/* Cells whose box meets the ball, ascending; list has room for all cells.  Returns their number. */
int64_t cell_grid_ball(const cell_grid *g, const double *x, double radius, int32_t *list);
void cell_grid_destroy(cell_grid *g);

#endif
