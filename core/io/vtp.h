/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * vtp.h -- rigid bodies as geometry for ParaView and for pictures: outlines in 2D, closed surfaces in 3D. */
#ifndef IO_VTP_H
#define IO_VTP_H

#include "base/arena.h"
#include "base/error.h"
#include "particle/particle.h"

#include <stddef.h>
#include <stdint.h>

/* A body at one place; one that reaches through a periodic boundary is listed once for every place. */
typedef struct vtp_body {
    int id;
    int moves; /* 0: it is fixed */
    solid at;
    double velocity[3]; /* of the centre, m/s              */
    const double *more; /* [sum of the widths of vtp_field] */
} vtp_body;

/* Another quantity of bodies, with 1 or more components. */
typedef struct vtp_field {
    const char *name;
    int width;
} vtp_field;

/* Writes the n bodies, whose surface must be met once by each ray from the centre, with the cell data id,
 * velocity and moves (0: the body is fixed).  2D: a line per body, closed, 96 points counter-clockwise from the
 * body's x axis, and of bodies that move a spoke there from the centre that shows how they are turned; the points
 * are each body's centre, then its outline.  3D: triangles, their normals out of the body, between 96 meridians
 * and 47 circles of latitude round the body's z axis; fewer if there are many bodies (72, 35; 48, 23).
 * field: n_field more cell data.  ERR_IO, ERR_MEMORY. */
int vtp_write(const char *path, int dim, const vtp_body *body, int n, const vtp_field *field, int n_field,
              error *err);

/* The same read back, all in one arena. */
typedef struct vtp_file {
    size_t n_point, n_cell;
    double (*point)[3]; /* [n_point]                                                   */
    size_t *first;      /* [n_cell + 1] where the points of each line or polygon start */
    size_t *corner;     /* [first[n_cell]] their points, each less than n_point        */
    int32_t *id;        /* [n_cell]                                                    */
    int polygons;       /* 1: the cells are polygons, 0: lines                         */
} vtp_file;

/* ERR_IO if the file cannot be read, is cut short or is none of these. */
int vtp_read(const char *path, vtp_file *v, arena *a, error *err);

#endif
