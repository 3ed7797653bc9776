/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * solve.h -- linear solution with reused factors, Newton's method, continuation. */
#ifndef SOLVE_SOLVE_H
#define SOLVE_SOLVE_H

#include "assemble/assemble.h"
#include "solve/linear.h"

#include <signal.h>

/* --- fields that are fixed up to a constant (gauge.c) --- */

typedef struct gauge {
    int sharp;                      /* cells are cut: their quadrature is not exact     */
    int free[SPACE_MAX_FIELDS];     /* the field has a free constant                    */
    int approximate;                /* one that is so to the quadrature of cut cells    */
    double doubt[SPACE_MAX_FIELDS]; /* not 0: taken for none, with this defect, near bodies only */
    uint8_t *near;                  /* [n_carrier] of cells near bodies                          */
    /* [n_dof] Integral of each basis function over the fluid, of the placement of the last evaluation; NULL:
     * `whole`, over whole cells. */
    const double *weight[SPACE_MAX_FIELDS];
    double *whole[SPACE_MAX_FIELDS];
    int64_t pin[SPACE_MAX_FIELDS];   /* row of the value that is held                    */
    double volume;                   /* sum of the weights                               */
    double defect[SPACE_MAX_FIELDS]; /* what was taken out of the residual               */
} gauge;

/* --- Newton (newton.c) --- */

enum { NEWTON_MAX_ITERATIONS = 50 };

typedef struct newton_options {
    double tolerance; /* per field, relative to |J| |x|          */
    double fall; /* of a step in time: residual, relative to that of the prediction, that is small enough, too; 0:
                  * none is */
    int max_iterations;
    int hurry;               /* a step in time, which may be shorter: gives up where the residual hardly falls */
    double linear_tolerance; /* what GMRES may leave at most; 0: factor every matrix */
} newton_options;

typedef struct newton_report {
    int iterations, converged;
    int singular;    /* the equations leave some unknowns open; with `converged`: the others have converged */
    int linear_only; /* it converges with order one, as with a wrong matrix */
    int total;       /* iterations of all solves of a continuation */
    int64_t evaluations, matrices;             /* of the residual; those of them with the matrix */
    double norm[SPACE_MAX_FIELDS];             /* scaled residual of each field, last  */
    double history[NEWTON_MAX_ITERATIONS + 1]; /* largest of them, per iteration        */
    double order;                              /* of convergence, by the last residuals that show it; 0: none do */
    double ratio;                              /* r_{k+1} / r_k^2 of the same           */
    char why[600];                             /* if it did not converge                */
} newton_report;

typedef void newton_talk(void *ctx, int iteration, double norm, const double *field_norm, double step);

/* Everything that a nonlinear solve needs. */
typedef struct newton_system {
    space *space;
    assembly assembly;
    linear linear;
    gauge gauge;
    double *residual;                   /* [n_dof] of the last evaluation */
    double *step;                       /* [n_free] of the last iteration */
    double *trial, *rhs, *scale, *work; /* [n_dof] room */
    double assemble_seconds;
    int64_t evaluations, matrices;      /* since it was created, see newton_report */
    int last_iterations;                /* of the last solve ... */
    double last_fall;                   /* ... and the fall of the residual in its first; 1 before any */
    int vanishes[SPACE_MAX_FIELDS];     /* the field is zero but for round-off */
    uint32_t coupled[SPACE_MAX_FIELDS]; /* bit g: equations of the field contain field g */
    const volatile sig_atomic_t *stop;  /* not NULL and not 0: end soon */
    newton_talk *talk;
    void *talk_ctx;
    arena memory;
} newton_system;

/* Finds anew, on the matrix just formed, which fields are free; *changed: others than before. */
int gauge_detect(newton_system *s, int *changed, error *err);
void gauge_project(newton_system *s, double *residual); /* takes the inconsistent part out */
/* Scaled norm of what that was, largest of all fields. */
double gauge_excess(const newton_system *s, const double *scale);
/* Tells the linear solver, before each solution, what is idle and free. */
int gauge_tell(newton_system *s, error *err);
void gauge_use(newton_system *s, const body_points *bodies); /* what follows is with these bodies (or NULL) */
/* Takes from free fields their mean over the fluid. */
void gauge_zero_mean(newton_system *s, const body_points *bodies, double *x);

int system_create(newton_system *s, space *sp, const assembly_spec *spec, int n_spec, const linear_choice *solvers,
                  int n_thread, error *err);
/* The pattern of the matrix is another one (space.h): numbers the free unknowns anew, with a linear solver for
 * them. */
int system_renew(newton_system *s, error *err);
void system_destroy(newton_system *s);

/* dot = shift x + history.  x must satisfy the Dirichlet conditions at t. */
typedef struct newton_time {
    double t, dt, shift;
    const double *history, *old; /* NULL: steady */
    const double *kept;          /* see assembly_state */
    const body_points *bodies;   /* NULL: none   */
    const moving_frame *frame;   /* NULL: none   */
    double faded;                /* see assembly_state */
    uint32_t only;               /* not 0: terms with one of these flags only */
    assembly_power *power;       /* NULL: nobody asks */
    const double (*fluid)[6];    /* see assembly_state */
} newton_time;

/* The residual of all rows at x, as it is (reactions at prescribed unknowns). */
int newton_residual(newton_system *s, const newton_time *time, const double *x, double *residual, error *err);

/* 0 also when it does not converge (see report); an error only if going on makes no sense. */
int newton_solve(newton_system *s, const newton_time *time, const newton_options *o, double *x,
                 newton_report *report, error *err);

/* --- between the files of this folder --- */

/* s->residual, and the matrix in s->linear.value, at x; errors and `diagnose` as assembly_run (system.c). */
int system_evaluate(newton_system *s, const newton_time *time, const double *x, int with_matrix, int diagnose,
                    error *err);
/* Memory at x, see assembly_keep. */
int system_keep(newton_system *s, const newton_time *time, const double *x, double *kept, error *err);
/* Whether all terms that take part are linear: the matrix is the same for every x. */
int system_is_linear(const newton_system *s, const newton_time *time);

/* scale.c.  scale[f], norm[f] are per field; x and s->residual belong together.
 * Scales from the last matrix; with a step [n_free] the unknowns count with what they are about to become. */
void scale_fields(newton_system *s, const double *x, const double *step, double *scale);
/* Scaled s->residual, NaN where it is not finite; returns the largest, NaN if any is.  The same of a free vector.
 */
double scale_norms(const newton_system *s, const double *scale, double *norm);
void scale_norms_free(const newton_system *s, const double *free_, const double *scale, double *norm);
/* Largest relative change of a field by length s->step; fields that vanish or are free do not count. */
double scale_change(const newton_system *s, const double *x, double length);
/* Bit f: the equations of field f depend on a field that has not converged and that does not depend on f. */
uint32_t scale_waiting(const newton_system *s, const double *norm, double tolerance);

/* forcing.c.  Relative residual that the linear solution at iterate k may leave, of a history up to there, the
 * lengths of the steps and the residual that is small enough; not less than FORCING_LEAST, as one more iteration
 * costs less than that, but for a smaller linear_tolerance. */
double forcing(const newton_system *s, const newton_options *o, const newton_report *r, const double *length,
               double enough, int k);
#define FORCING_LEAST 1e-6

/* observe.c.  Order and ratio at the last iteration that is above round-off, and above what linear solutions
 * left. */
void observe_order(newton_report *r, const double *inexact);
/* Whether it was one, as with a wrong matrix; not where a constant is free only nearly.  Of each step its length,
 * and the part of the residual that its linear solution left. */
void observe_linear(newton_report *r, const double *length, const double *inexact);

/* explain.c.  Something is not finite at x: the error names who put it there (term and place, or the unknown). */
int explain_nan(newton_system *s, const newton_time *time, const double *x, error *err);
/* Whether the linear system that was handed over, matrix and s->rhs, is. */
int explain_is_finite(const newton_system *s);
/* Adds to the error which unknowns the matrix leaves open. */
void explain_singular(newton_system *s, error *err);

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
