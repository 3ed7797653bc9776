/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * made.h -- results that are made: fields known at every point, and bodies, without a run. */
#ifndef SUPPORT_MADE_H
#define SUPPORT_MADE_H

#include "io/vtp.h"
#include "io/vtu.h"

/* A box of the unit size with u (order 2) and p (order 1), and bodies in it. */
typedef struct made {
    mesh m;
    space s;
    int32_t *body; /* [n_node] */
    double *x;     /* [n_dof]  */
    field_list fields;
    shape shapes[4];
    vtp_body bodies[4];
    int n;
    arena memory;
} made;

/* The linear field that fluid has everywhere. */
double made_field(const double *x);

/* n cells in each direction. */
void made_create(made *k, int dim, int simplex, int n);
void made_destroy(made *k);
/* A body of the kind of shape with half widths a, b, c. */
void made_add(made *k, int kind, double a, double b, double c, const double *at, int moves);
/* Level of the body: negative inside. */
double made_level(const vtp_body *b, const double *x);
/* u = (field, 0, 0), in bodies (inside, 0, 0); p = field, which reaches into bodies.  Nodes count as in a body
 * where its level is less than -depth. */
void made_fill(made *k, double inside, double depth);
/* Writes fields_00000.vtu, whose path it returns, and particles_00000.vtp; told: the file of fields tells which
 * nodes lie in bodies, and has no p there. */
const char *made_write(made *k, const char *folder, int told);

#endif
