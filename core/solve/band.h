/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * band.h -- factors F of an earlier matrix, made good where bodies have moved since.
 *
 * There the matrix A is another one in the rows of cells that bodies were near to then or are near to now, and
 * elsewhere nearly the same.  The band are the unknowns of these cells and of one layer of cells round them, and
 * those of the bodies; with R the restriction to it,
 *
 *     z = B r,      z += F^-1 (r - A z),      z += B (r - A z),      B = R^T (R A R^T)^-1 R,
 *
 * nearly solves A z = r: what is near, the far field, and what is near again.  The band's matrix is small, and
 * factored for every A by the same kind of solver.  What one matrix has as an unknown and the other has not (fields
 * inside of bodies) lies in the band. */
#ifndef SOLVE_BAND_H
#define SOLVE_BAND_H

#include "assemble/assemble.h"

#include <plugflow/solver.h>

typedef struct band {
    const space *space;
    const pf_solver *solver;
    const void *params; /* of the solver, see linear_choice */
    int n_thread;
    uint8_t *then, *now; /* [n_cell] 1: a body was near when the factors were made; is near now */
    uint8_t *cell;       /* [n_cell] of the band */
    uint8_t *node;       /* [n_carrier] of the band */
    int64_t n_then;      /* unknowns of the factors, by their number among all: */
    int32_t *dof_then;   /* [n_dof] */
    int factors;         /* there are some */
    int same;            /* their unknowns are those of now */
    int placed;          /* bodies have moved since */
    int ready;           /* structure and solver are those of this placement */
    void *self;          /* of the band's matrix */
    pf_csr a;            /* of the band */
    int64_t *row, *node_row;
    int64_t *col, col_room;
    double *value;
    int64_t value_room;
    int32_t *unknown;                     /* [a.n] of the band among those of the matrix, ascending */
    int32_t *number;                      /* [n_dof] of the matrix among those of the band, or -1 */
    int64_t n_rim;                        /* rows beside the band that have columns in it: */
    int32_t *rim;                         /* [n_dof] */
    double *r, *z, *left, *far_r, *far_z; /* [n_dof] room */
    pf_solver_cost cost, far;             /* of the factors of the band, and of those of the earlier matrix */
    double flops;                         /* of the last solution, ...                                      */
    double total;                         /* ... and of all since the factorisation, with that              */
    int solves;                           /* how many these were */
    arena memory;
} band;

int band_create(band *b, const pf_solver *solver, const void *params, const space *s, int n_thread, error *err);
void band_destroy(band *b);
/* Bodies are elsewhere, and the space may have other unknowns. */
void band_place(band *b, const body_points *now);
/* A matrix with the bodies and unknowns of now has been factored, or (factors = 0) that has failed. */
void band_remember(band *b, int factors, const pf_solver_cost *cost, const pf_csr *a);
/* Whether a band is worth a try: it is until a solution takes more operations than all since the factorisation took
 * in the mean, with that. */
int band_pays(const band *b);
/* Factors of the band of this matrix.  *done = 0: it is so large, or so singular, that there are none. */
int band_setup(band *b, const pf_csr *a, int *done, error *err);
/* A solution with the last set-up has taken so many applications. */
void band_count(band *b, int applications);
/* z = nearly the solution for r; `far` holds the factors of the earlier matrix. */
int band_apply(band *b, const pf_csr *a, void *far, const double *r, double *z, error *err);

#endif
