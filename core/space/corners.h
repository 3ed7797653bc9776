/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * corners.h -- nodes that boundaries with different conditions share, and what flows through each boundary. */
#ifndef SPACE_CORNERS_H
#define SPACE_CORNERS_H

#include "base/warning.h"
#include "describe/describe.h"
#include "space/space.h"

enum { CORNER_MOST = 8 };

/* One boundary at a shared node: its normal component is kept. */
typedef struct corner_side {
    int line;           /* of the description */
    const value *value; /* NULL: zero (symmetry) */
    double normal[3];   /* unit vector, out of the domain */
} corner_side;

/* A node where several lines prescribe a vector field; sides by rank of their lines, the one that holds last. */
typedef struct corner {
    int32_t node;
    int field, n;
    const value *last; /* what the tangential rest is */
    corner_side side[CORNER_MOST];
} corner;

typedef struct corner_list {
    int64_t n, room;
    corner *corner;
} corner_list;

/* Finds the corners of a field.  facet: [n_line][n_facet], see conditions.h; rank [n_line]: a line holds over those
 * of lower rank. */
int corners_find(corner_list *l, const description *d, const space *s, uint8_t *const *facet, const int *rank,
                 int field, error *err);
/* Values at time t into x [n_dof].  w, unless NULL: gets a warning where normal components contradict each other.
 */
int corners_apply(const corner_list *l, const description *d, const space *s, double t, double *x, warning_list *w,
                  error *err);
void corners_destroy(corner_list *l);

/* Place and area element n ds (of the facet's own coordinates, fe_rule_facet) of a point of a facet. */
void facet_element(const mesh *m, int64_t facet, const double *xi, const double (*tangent)[3], int orient,
                   double *x, double *ds);
/* Integral of phi_i n over a facet for each of its nodes, and their sum n_all: the area vector.  Facet rules of
 * degree 5. */
int facet_weights(const mesh *m, int64_t facet, double (*weight)[3], double *all, error *err);

#endif
