/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * solve.h -- linear solution with reused factors, Newton's method, continuation, time steps. */
#ifndef SOLVE_SOLVE_H
#define SOLVE_SOLVE_H

#include "assemble/assemble.h"

#include <plugflow/solver.h>

#include <signal.h>

/* --- linear (linear.c) --- */

typedef struct linear_stats {
    int factorisations, gmres_iterations, solves;
    double largest_b;      /* norm of the largest right-hand side                       */
    double worst_residual; /* largest |b - A x| / |b| by fresh factors; of last corrections, small as b is,
                            * relative to 1e-8 of the largest |b| */
    double factor_seconds, solve_seconds, analyze_seconds;
    pf_solver_cost cost;
} linear_stats;

typedef struct linear {
    const pf_solver *solver;
    void *self;
    pf_csr a;
    double *value;
    int analyzed, factored; /* factored: there are factors, perhaps of an older matrix */
    int max_iterations;     /* of GMRES with old factors; 0: factor every matrix        */
    int spent;              /* GMRES iterations since the last factorisation            */
    double memory_limit;    /* bytes                                                    */
    double *v, *z, *r;      /* Krylov vectors                                           */
    linear_stats stats;
    arena memory;
} linear;

int linear_create(linear *l, const pf_solver *solver, const space *s, int n_thread, error *err);
/* Solves A x = b to |b - A x| <= tol |b|: with the factors there are, as preconditioner of GMRES,
 * if that pays, else with fresh ones.  A fresh solve below LINEAR_ACCEPT passes whatever tol is. */
int linear_solve(linear *l, const double *b, double *x, double tol, error *err);
/* Analyses the pattern: fills stats.cost; ERR_MEMORY if the factors will not fit. */
int linear_predict(linear *l, error *err);
/* x = the last factors' answer for b, right or not. */
int linear_apply(linear *l, const double *b, double *x, error *err);
void linear_forget(linear *l); /* the next solve factors afresh */
void linear_destroy(linear *l);
#define LINEAR_ACCEPT 1e-10

/* --- fields that are fixed up to a constant (gauge.c) --- */

typedef struct gauge {
    int known;
    double tolerance;                 /* of the null vector, relative; 0: round-off       */
    int free[SPACE_MAX_FIELDS];       /* the field has a free constant                    */
    double *weight[SPACE_MAX_FIELDS]; /* [n_dof] integral of each basis function         */
    double volume;
    double defect[SPACE_MAX_FIELDS]; /* what was taken out of the residual               */
} gauge;

/* --- Newton (newton.c) --- */

enum { NEWTON_MAX_ITERATIONS = 50 };

typedef struct newton_options {
    double tolerance; /* per field, relative to |J| |x|          */
    int max_iterations;
    double linear_tolerance; /* of GMRES; 0: factor every matrix  */
} newton_options;

typedef struct newton_report {
    int iterations, converged;
    int singular;                              /* converged, but the equations leave some unknowns open */
    int total;                                 /* iterations of all solves of a continuation */
    double norm[SPACE_MAX_FIELDS];             /* scaled residual of each field, last  */
    double history[NEWTON_MAX_ITERATIONS + 1]; /* largest of them, per iteration        */
    double ratio;                              /* r_{k+1} / r_k^2 of the last iterations */
    double order;                              /* observed order of convergence         */
    char why[300];                             /* if it did not converge                */
} newton_report;

typedef struct solution {
    double t, dt;
    double *x, *dot, *old; /* [n_dof] */
} solution;

typedef void newton_talk(void *ctx, int iteration, double norm, const double *field_norm, double step);

/* Everything that a nonlinear solve needs. */
typedef struct newton_system {
    space *space;
    assembly assembly;
    linear linear;
    gauge gauge;
    double *residual, *trial, *step, *rhs, *scale, *work; /* [n_dof] */
    double assemble_seconds;
    int vanishes[SPACE_MAX_FIELDS];    /* the field is zero but for round-off */
    const volatile sig_atomic_t *stop; /* not NULL and not 0: end soon        */
    newton_talk *talk;
    void *talk_ctx;
    arena memory;
} newton_system;

int gauge_detect(newton_system *s, error *err);
/* Whether the constants found are still free with the matrix of now; forgets those that are not. */
int gauge_holds(newton_system *s);
void gauge_project(newton_system *s, double *residual); /* takes the inconsistent part out */
void gauge_pin(newton_system *s);                       /* changes the matrix              */
void gauge_zero_mean(const newton_system *s, double *x);
/* Integral of each basis function of a field; returns the volume. */
double gauge_weights(const space *s, int field, double *weight);

int system_create(newton_system *s, space *sp, const assembly_spec *spec, int n_spec, const pf_solver *solver,
                  int n_thread, error *err);
/* The pattern of the matrix is another one (space.h): numbers the free unknowns anew, with a linear solver for
 * them. */
int system_renew(newton_system *s, error *err);
void system_destroy(newton_system *s);

/* dot = shift x + history.  x must satisfy the Dirichlet conditions at t. */
typedef struct newton_time {
    double t, dt, shift;
    const double *history, *old; /* NULL: steady */
    const body_points *bodies;   /* NULL: none   */
    const moving_frame *frame;   /* NULL: none   */
    double faded;                /* see assembly_state */
    uint32_t only;               /* not 0: terms with one of these flags only */
} newton_time;

/* The residual of all rows at x, as it is (reactions at prescribed unknowns). */
int newton_residual(newton_system *s, const newton_time *time, const double *x, double *residual, error *err);

/* 0 also when it does not converge (see report); an error only if going on makes no sense. */
int newton_solve(newton_system *s, const newton_time *time, const newton_options *o, double *x,
                 newton_report *report, error *err);

/* --- steady states (continuation.c) --- */

typedef struct continuation {
    const body_points *bodies;
    int fades;             /* some terms can be faded in (PF_CONTINUATION) */
    double *parameter[16]; /* or: parameters moved from `from` to their value, geometrically */
    double from[16], to[16];
    int n_parameter;
} continuation;

typedef void continuation_talk(void *ctx, double s, int iterations, int converged);

int continuation_solve(newton_system *s, continuation *c, const newton_options *o, double *x, newton_report *report,
                       int *n_steps, continuation_talk *talk, void *ctx, error *err);

double solve_seconds(void);

#endif
