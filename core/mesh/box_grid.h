/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * box_grid.h -- which of many boxes are near a point: a grid of buckets, each with the boxes that reach into it, so
 * that a search costs as much as it finds.  Built once, then only read. */
#ifndef MESH_BOX_GRID_H
#define MESH_BOX_GRID_H

#include "base/arena.h"
#include "base/error.h"

#include <stdint.h>

/* How far outside of a box, in sizes of it, a point may lie and still find it in its bucket. */
#define BOX_GRID_MARGIN 1e-6

typedef struct box_grid {
    int dim;
    int64_t n_box;
    double (*box)[2][3];     /* [n_box] lower and upper corner                            */
    int n[3];                /* buckets in each direction, 1 in unused ones               */
    double low[3], width[3]; /* corner of the first bucket; size of each                  */
    int64_t *start;          /* [n buckets + 1] where the list of each bucket starts      */
    int32_t *list;           /* numbers of the boxes in each bucket, ascending            */
    arena memory;
} box_grid;

/* Room for n boxes (n <= 2^31 - 1): g->box is to be filled, then box_grid_build. */
int box_grid_create(box_grid *g, int dim, int64_t n, error *err);
/* Buckets of about this width. */
int box_grid_build(box_grid *g, double width, error *err);
void box_grid_destroy(box_grid *g);

/* Boxes in the bucket of x, *n of them, ascending: among them all that hold x, or all but (BOX_GRID_MARGIN). */
const int32_t *box_grid_at(const box_grid *g, const double *x, int64_t *n);

/* Calls found(ctx, i) for every box that meets the ball round x, each once, in no order. */
void box_grid_ball(const box_grid *g, const double *x, double radius, void (*found)(void *ctx, int32_t i),
                   void *ctx);

#endif
