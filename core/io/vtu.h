/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * vtu.h -- fields for ParaView: quadratic cells, appended raw, one file a time. */
#ifndef IO_VTU_H
#define IO_VTU_H

#include "space/space.h"

/* Which nodes lie in rigid bodies, where there is no fluid. */
typedef struct vtu_bodies {
    const int32_t *body;    /* [n_node] number of the body that holds the node, -1: fluid          */
    uint32_t empty;         /* bit f: field f of the space has no value in bodies, NaN in the file */
    uint32_t empty_outside; /* ... has none outside of them */
} vtu_bodies;

/* Fields with one value a cell. */
typedef struct vtu_cells {
    int n;
    const field_spec *field[2 * SPACE_MAX_FIELDS];
    const double *value[2 * SPACE_MAX_FIELDS]; /* [n_cell][n_comp] */
} vtu_cells;

/* What else stands in the same file: fields of another space, fields of cells. */
typedef struct vtu_more {
    const space *space; /* on the same mesh */
    const int *field;   /* [n_field] of it  */
    int n_field;
    const double *x;
    uint32_t empty, empty_outside; /* bit f: field f has no value in bodies, outside of them */
    const vtu_cells *cells;        /* NULL: there are none */
} vtu_more;

/* Writes fields[n_field] of the space (order 1 ones are interpolated to all nodes, exactly) with the unknowns
 * x[n_dof] at time t; NAN: a steady state.  bodies: the point array "body" is written, too, and fields that are
 * empty in bodies have no value there; of all others x must hold what is to stand there.  NULL: no bodies.
 * ERR_IO, ERR_MEMORY; the file is then as it was. */
int vtu_write(const char *path, const space *s, const int *fields, int n_field, const double *x, double t,
              const vtu_bodies *bodies, error *err);
/* The same with some more. */
int vtu_write_more(const char *path, const space *s, const int *fields, int n_field, const double *x, double t,
                   const vtu_bodies *bodies, const vtu_more *more, error *err);
/* The list of files with their times. */
int vtu_write_pvd(const char *path, const char *const *file, const double *t, int n, error *err);

#endif
