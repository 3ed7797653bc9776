/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * linear.h -- linear systems: which solver, and the reuse of what it has set up. */
#ifndef SOLVE_LINEAR_H
#define SOLVE_LINEAR_H

#include "base/warning.h"
#include "solve/band.h"
#include "solve/gmres.h"
#include "solve/packed.h"
#include "solve/unknowns.h"

#define LINEAR_ACCEPT 1e-10
enum { LINEAR_MAX_ITERATIONS = 30 }; /* of GMRES with the factors of an earlier matrix */

/* Solvers to take: one, or a factorisation and one that iterates, of which the prediction chooses. */
typedef struct linear_choice {
    const pf_solver *direct, *iterative; /* NULL: not that one */
    const void *params;                  /* of the one that the case names; NULL: it has none */
    int each_step;                       /* bodies move: every step has a matrix that old factors are far from */
} linear_choice;

typedef struct linear_stats {
    int factorisations, gmres_iterations, solves;
    int band_factorisations; /* of the band alone, see band.h                             */
    double largest_b;        /* norm of the largest right-hand side                       */
    double worst_residual;   /* largest |b - A x| / |b| by fresh factors; of last corrections, small as b is,
                              * relative to 1e-8 of the largest |b| */
    double factor_seconds, solve_seconds, analyze_seconds;
    pf_solver_cost cost; /* of the solver in use                */
    double direct_flops; /* of a factorisation, as it was guessed where it was not analysed; 0: it was */
    char why[200];       /* the iterative solver is not in use; empty: nobody asked */
} linear_stats;

enum { METHOD_DIRECT, METHOD_ITERATIVE, N_METHOD };

typedef struct linear {
    linear_choice choice;
    void *instance[N_METHOD]; /* of the solvers, made when they are needed */
    int at;                   /* the method in use, once analysed          */
    const space *space;
    pf_csr a;
    double *value;
    int n_thread;
    int analyzed, factored; /* factored: something was set up, perhaps of an older matrix */
    int fresh;              /* it is of the matrix of the last solve ...      */
    int kept;               /* ... and the next one has the same              */
    int gave_up;            /* the iterative solver failed once               */
    int max_iterations;     /* of GMRES with old factors; 0: factor every matrix        */
    int spent;              /* GMRES iterations since the last factorisation, beyond what fresh ones take */
    double rate;            /* iterations that the iterative solver, freshly set up, takes for a digit */
    double memory_limit;    /* bytes                                                    */
    double *row_scale;      /* [n] by which residuals count in an iterative solver, see measure.c */
    unknowns rows;
    const int64_t *pin; /* [n_field] row of the value that is held of a free field, or -1 */
    band band;          /* where bodies have moved since the last factorisation */
    packed packed;      /* the matrix as it is factored */
    gmres krylov;
    double *b, *dx; /* [n] room of the refinement */
    double *r;      /* [n] b - A x of the last solve */
    linear_stats stats;
    char said[400];         /* by the solver in use of the last matrix that was singular */
    warning_list *warnings; /* NULL: nobody listens */
    arena memory;           /* of this pattern */
} linear;

int linear_create(linear *l, const linear_choice *choice, const space *s, int n_thread, error *err);
/* The pattern of the space is another one. */
int linear_renew(linear *l, error *err);
/* Before a solution: unknowns that are off [n_dof]; fields with a free constant [n_field], their integrals [n_dof]
 * each, and the row of each that a factorisation holds. */
int linear_tell(linear *l, const uint8_t *idle, const int *free_fields, const double *const *integral,
                const int64_t *pin, error *err);
/* Solves A x = b to |b - A x| <= tol |b|: with what is set up, as preconditioner of GMRES, if that pays, else with
 * a fresh set-up.  A fresh factorisation passes whatever tol is, unless it is useless.  An iterative solver that
 * does not reach tol is replaced by the factorisation, with a warning.  Of free fields one value is held, in the
 * matrix and in b, if a factorisation solves.
 * Errors: ERR_CONVERGE with err->retry if the matrix is singular or nearly so; ERR_PLUGIN if the solver does not
 * solve. */
int linear_solve(linear *l, double *b, double *x, double tol, error *err);
/* The next linear_solve has the matrix of the last one: it is not set up a second time. */
void linear_keep(linear *l);
/* Chooses a solver and analyses the pattern: fills stats.cost; ERR_MEMORY if it will not fit. */
int linear_predict(linear *l, error *err);
/* x = what is set up makes of b, right or not; an iterative solver reduces the residual to about a tenth. */
int linear_apply(linear *l, double *b, double *x, error *err);
void linear_forget(linear *l); /* the next solve sets up afresh */
/* Bodies are elsewhere: factors of before are of use as band.h says, if at all. */
int linear_move(linear *l, const body_points *now, error *err);
const pf_solver *linear_solver(const linear *l); /* the one in use; NULL before it is chosen */
void linear_destroy(linear *l);
int linear_approximates(const pf_solver *s); /* PF_SOLVER_APPROXIMATE */
/* The solvers there are: the one named, without "solver_"; NULL: a factorisation and one that iterates. */
int linear_find(linear_choice *c, registry *r, const char *named, error *err);

/* --- between the files of this folder --- */

/* The solver knows of this member, which early ones do not, and has it. */
#define LINEAR_HAS(solver, member)                                                                                 \
    ((solver)->size >= offsetof(pf_solver, member) + sizeof(solver)->member && (solver)->member)

/* factors.c.  The set-up of this matrix; GMRES with it, at most `limit` iterations; before either: what a solver of
 * the kind needs, held values or projections. */
int linear_set_up(linear *l, error *err);
int linear_iterate(linear *l, const double *b, double *x, double tol, int limit, double *reached, error *err);
void linear_prepare(linear *l, double *b, int approximate);
int linear_precondition(void *linear_, const double *b, double *x, error *err);
int linear_by_factors(linear *l, double *b, double *x, double tol, error *err);
/* iterative.c */
int linear_by_iteration(linear *l, double *b, double *x, double tol, error *err);
/* A solution by the factors of before bodies have moved; *done = 0: it was none. */
int moved_solve(linear *l, const double *b, double *x, double tol, int *done, error *err);
/* row_scale, from the matrix. */
int linear_measure(linear *l, error *err);
const pf_solver *linear_method(const linear *l, int method);
/* Whether the analysis is of the structure that there is; else it must be made again. */
int linear_holds(const linear *l);
/* The matrix as the solver in use reads it. */
const pf_csr *linear_matrix(linear *l);
/* Analysis by one method: the error says what went wrong, *unfit: only that this solver is not for such systems. */
int linear_analyze(linear *l, int method, int *unfit, error *err);

#endif
