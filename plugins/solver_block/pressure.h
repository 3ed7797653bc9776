/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * pressure.h -- the Schur complement S = C - D F^-1 G of the pressure by least squares, scaled by the diagonal of F
 * (Elman, Howle, Shadid, Shuttleworth and Tuminaro 2006), with C for the ties:
 *
 *     S^-1 = about T^-1 (C - D dF^-1 F dF^-1 G) T^-1,       T = C - D dF^-1 G */
#ifndef SOLVER_BLOCK_PRESSURE_H
#define SOLVER_BLOCK_PRESSURE_H

#include "aggregate.h"
#include "coarse.h"
#include "options.h"
#include "split.h"

enum { PRESSURE_LEVELS = 12 };

typedef struct pressure_level {
    sparse a, prolong, restrict_;
    double *diagonal, *x, *b, *r;
} pressure_level;

typedef struct pressure {
    const split *s;
    const options *o;
    double sign; /* T is positive with this sign */
    sparse t;    /* of the fluid alone; the bodies' part is of low rank and applied as it stands */
    int n_level;
    pressure_level level[PRESSURE_LEVELS];
    coarse coarse;  /* the last level */
    int32_t n_body; /* blocks of bodies */
    int32_t *body;
    double *r, *z, *d, *w, *y; /* [n_p] of the iteration */
    float *f, *g;              /* [n blocks][b] */
    pool memory;
} pressure;

/* From the values of the split matrix; 0 or an enum pf_solver_status. */
int pressure_create(pressure *q, const split *s, const options *o);
/* p = about S^-1 r [n_p]. */
void pressure_solve(pressure *q, const double *r, double *p);
void pressure_destroy(pressure *q);

#endif
