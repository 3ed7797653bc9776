/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * conditions.h -- the boundary conditions of a case on a mesh: which facets each line has, and values prescribed at
 * nodes. */
#ifndef SPACE_CONDITIONS_H
#define SPACE_CONDITIONS_H

#include "describe/describe.h"
#include "space/space.h"

/* Unknowns of a field at nodes, held at values of a case. */
typedef struct dirichlet_set {
    const value *value; /* NULL: zero */
    int comp;           /* -1: all components that are not free; else this one */
    int field;
    int64_t n;
    int32_t *node;
} dirichlet_set;

typedef struct conditions {
    int n_line;
    uint8_t **facet; /* [n_line][n_facet] 1: the facet belongs to the line of the description */
    int n_set;
    dirichlet_set *set;
    arena memory;
} conditions;

/* Finds facets and nodes, and marks the unknowns in space.fixed.  ERR_CASE. */
int conditions_create(conditions *c, const description *d, space *s, error *err);
/* Prescribed values at time t into x [n_dof]. */
int conditions_apply(const conditions *c, const space *s, double t, double *x, error *err);
void conditions_destroy(conditions *c);

#endif
