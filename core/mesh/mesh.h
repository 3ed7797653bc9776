/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * mesh.h -- cells of one type with nodes of second order, and named boundary facets. */
#ifndef MESH_MESH_H
#define MESH_MESH_H

#include "base/arena.h"
#include "base/error.h"
#include "fe/fe.h"

#include <stdint.h>

enum { MESH_MAX_NAMES = 64, MESH_MAX_IMAGES = 27 };

typedef struct mesh_facet {
    int32_t cell;   /* the cell behind it                              */
    int32_t local;  /* which of its facets                             */
    uint64_t names; /* bit i: the facet belongs to boundary name[i]   */
} mesh_facet;

typedef struct mesh {
    int dim;
    const fe_cell *type;
    int64_t n_node, n_cell, n_facet;
    double *x;       /* coordinates, [n_node][dim]                       */
    int32_t *cell;   /* nodes of cells, [n_cell][type->n_node]           */
    double *h;       /* size of cells, volume^(1/dim), [n_cell]          */
    uint8_t *is_box; /* [n_cell] 1: a quad or hex with straight sides along the axes and evenly spaced nodes; NULL:
                        not measured yet */
    mesh_facet *facet; /* boundary facets, sorted by local number          */
    int n_name;
    char *name[MESH_MAX_NAMES];
    int n_period; /* periodic pairs of boundary names          */
    int period[MESH_MAX_NAMES][2];
    double period_at[MESH_MAX_NAMES][3];     /* centre of the first of them                */
    double period_vector[MESH_MAX_NAMES][3]; /* from there to the second                   */
    int32_t *master;                         /* [n_node] node that carries the unknowns (itself, unless periodic) */
    arena memory;
} mesh;

/* What a box is made of. */
typedef struct mesh_box {
    int dim, simplex;
    double low[3], high[3];
    int n[3];
    /* Optional, per direction: n[k] + 1 ascending positions; NULL = equal cells. */
    const double *ticks[3];
} mesh_box;

/* Name of side 0..2 dim - 1: left, right (x), bottom, top (y), back, front (z). */
const char *mesh_box_side(int side);
int mesh_create_box(const mesh_box *box, mesh *m, error *err);

struct pf_mesh_data;
/* Takes over (copies) what a mesh reader returned. */
int mesh_create_from_data(const struct pf_mesh_data *data, const char *source, mesh *m, error *err);

/* Sizes, boxes, inverted cells (an error that names the cell and where it is). */
int mesh_measure(mesh *m, error *err);

/* Identifies the nodes of boundaries a and b, which must match under a translation. */
int mesh_make_periodic(mesh *m, int a, int b, error *err);
/* Brings a point, by whole periods, to between the two boundaries of each; a difference of points, to the shortest.
 */
void mesh_wrap(const mesh *m, double *x);
void mesh_nearest(const mesh *m, double *d);
/* Shifts of the images of a point: by -1, 0 or 1 of each of at most 3 periods, zero first.  Returns how many. */
int mesh_images(const mesh *m, double shift[MESH_MAX_IMAGES][3]);

/* Isoparametric mapping of a cell at a point with second-order basis n, dn: place x, Jacobian matrix
 * j[a][b] = dx_a / dxi_b (identity in unused directions); returns its determinant. */
double mesh_map(const mesh *m, int64_t cell, const double *n, const double (*dn)[3], double x[3], double j[3][3]);

/* The same at reference coordinates xi of the cell. */
double mesh_place(const mesh *m, int64_t cell, const double *xi, double x[3], double j[3][3]);

int mesh_find_name(const mesh *m, const char *name); /* index or -1 */
void mesh_destroy(mesh *m);

#endif
