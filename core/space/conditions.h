/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * conditions.h -- the boundary conditions of a case on a mesh: which facets each line has, and values prescribed at
 * nodes. */
#ifndef SPACE_CONDITIONS_H
#define SPACE_CONDITIONS_H

#include "describe/describe.h"
#include "space/corners.h"
#include "space/space.h"

/* Unknowns of a field at nodes, held at values of a case. */
typedef struct dirichlet_set {
    const value *value; /* NULL: zero */
    int comp;           /* -1: all components that are not free; else this one */
    int field;
    int64_t n;
    int32_t *node;
} dirichlet_set;

/* What flows out through the lines of a case: flux = sum of weight * x[dof], of a vector field whose divergence
 * some equation holds, if its normal component is prescribed on all of the boundary. */
typedef struct net_flow {
    int closed;  /* it is */
    int of_time; /* what is prescribed may change */
    int field;
    int64_t *first; /* [n_line + 1] where the terms of a line start */
    int64_t *dof;
    double *weight;
} net_flow;

typedef struct conditions {
    int n_line;
    uint8_t **facet; /* [n_line][n_facet] 1: the facet belongs to the line of the description */
    int n_set;
    dirichlet_set *set;
    corner_list corners;
    net_flow flow;
    const description *description;
    arena memory;
} conditions;

/* Finds facets and nodes, and marks the unknowns in space.fixed; conditions that contradict each other at a node
 * are warnings.  ERR_CASE, also if more flows in than out at the start (see below). */
int conditions_create(conditions *c, const description *d, space *s, warning_list *w, error *err);
/* Prescribed values at time t into x [n_dof]. */
int conditions_values(const conditions *c, const space *s, double t, double *x, error *err);
/* The same.  ERR_CASE if the field of an incompressible fluid is prescribed on
 * all of the boundary and what flows in does not flow out, by more than 1e-6 of it. */
int conditions_apply(const conditions *c, const space *s, double t, double *x, error *err);
void conditions_destroy(conditions *c);

/* --- net_flow.c --- */
int net_flow_create(conditions *c, const description *d, const space *s, error *err);
/* ERR_CASE as above; *excess: net flow of the finite-element function, as part of what goes in and out. */
int net_flow_check(const conditions *c, const space *s, const double *x, double t, double *excess, error *err);

#endif
