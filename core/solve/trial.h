/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * trial.h -- a linear solver on its own: no mesh, no case, small systems of known solution. */
#ifndef SOLVE_TRIAL_H
#define SOLVE_TRIAL_H

#include "base/arena.h"
#include "term/selftest.h"

#include <plugflow/solver.h>

/* In the order in which they are tried. */
enum trial_kind {
    TRIAL_DIFFUSION,  /* symmetric, positive definite: five points on a square              */
    TRIAL_CONVECTION, /* the same with convection by upwind differences: unsymmetric         */
    TRIAL_STOKES,     /* a saddle point: elements of second and first order, p-p block zero  */
    TRIAL_OSEEN,      /* the same with convection                                            */
    TRIAL_ENCLOSED,   /* a saddle point without outflow: a constant pressure is free ...     */
    TRIAL_HELD,       /* ... or one value of it is held, as for solvers that are exact       */
    N_TRIAL
};

/* Values on one pattern: those, others that are far from them, others that are near. */
enum trial_values { TRIAL_FIRST, TRIAL_FAR, TRIAL_NEAR };

/* A system A x = b, as the kernel would hand it over. */
typedef struct trial {
    enum trial_kind kind;
    pf_csr a; /* with columns of its own */
    pf_csr shared;
    pf_unknowns unknowns;
    double *value; /* [row[n]] of both matrices, spoilt once they have been handed over */
    double *kept;  /* [row[n]] */
    double *full;  /* [n][n] A, by rows */
    double *x, *b; /* [n] */
    double *weight;
    const double *weights[2];
    int32_t (*place)[2]; /* [n_node] in the grid */
    uint8_t *field_of, *comp_of;
    arena memory;
} trial;

const char *trial_name(enum trial_kind kind);
/* With about `side` elements in each direction. */
int trial_create(trial *t, enum trial_kind kind, int side, enum trial_values values, error *err);
/* The values from the full matrix; makes them what is no number. */
void trial_fill(trial *t);
void trial_spoil(trial *t);
/* y = A x, or with the transpose. */
void trial_multiply(const trial *t, int transposed, const double *x, double *y);
/* |b - A x| / |b| for the right-hand side of t and the matrix of `with`, which has as many rows. */
double trial_residual(const trial *t, const trial *with, int transposed, const double *x);
void trial_destroy(trial *t);

/* What the wrong answer x to t looks like, "it returns zeros"; "" if like nothing that is known.  before: values
 * that were set up earlier, beside: of another instance; NULL: there are none. */
const char *trial_guess(const trial *t, const trial *before, const trial *beside, const double *x, char *text,
                        size_t size);

/* Tests the solver; ends early where there is no memory for the test. */
int trial_run(selftest *s, const pf_solver *solver, error *err);

#endif
