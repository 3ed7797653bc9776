/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * stepper.h -- time steps of the coupled system, with bodies that move. */
#ifndef SOLVE_STEPPER_H
#define SOLVE_STEPPER_H

#include "body/body.h"
#include "solve/power_meter.h"
#include "solve/solve.h"
#include "solve/step_control.h"
#include "solve/step_measure.h"
#include "state/state.h"

/* Residuals of the step's own equations at its solution, of all rows [n_dof]: minus what holds the unknowns. */
enum reaction {
    REACTION_ALL,      /* of all terms: at prescribed unknowns minus the force on the boundary           */
    REACTION_FLUID,    /* of PF_FLUID_FORCE: at the bodies' unknowns minus what the fluid does to them   */
    REACTION_CONTACT,  /* of the terms on pairs                                                          */
    REACTION_COUPLING, /* of the terms by which bodies and fluid act on each other                      */
    REACTIONS
};

/* A try at a step that came to nothing, and why. */
typedef struct failed_try {
    double t, dt;
    char why[600];
} failed_try;

enum { STEPPER_FAILURES = 8 };

typedef struct stepper {
    newton_system *system;
    bodies *bodies;
    const conditions *conditions;
    int order;               /* 1: BDF1, 2: BDF2 */
    int geometry_iterations; /* how often bodies are placed anew within a step */
    newton_options options;
    state *now;                                     /* of whom it is */
    state trial[3];                                 /* attempts */
    double *history, *level, *predicted;            /* [n_dof] */
    uint8_t *idle;                                  /* [n_dof] of the first of the steps that are extrapolated */
    double *reaction[REACTIONS], *saved[REACTIONS]; /* [n_dof]; without bodies only that of all terms */
    power_meter *meter;                             /* reads at the end of every step; NULL: none */
    newton_report report;
    int failures;     /* of Newton's method in a row: it then gets simpler predictions, and more time */
    double tolerance; /* of steps that choose their length; 0: they do not */
    double least;     /* no step is shorter than this, s */
    step_measure measure;
    int n_failed; /* tries of the last step that failed; of so many the reasons are kept: */
    failed_try failed[STEPPER_FAILURES];
    enum too_far too_far;   /* why the last step was refused before or after it was solved */
    int said[FAR_BODY + 1]; /* warnings given */
    arena memory;
} stepper;

int stepper_create(stepper *p, newton_system *s, bodies *b, const conditions *c, state *now, error *err);
/* Steps choose their length from here on: the first is of length `first`, none is shorter than `least`. */
void stepper_adapt(stepper *p, double tolerance, double first, double least);
/* now goes from t to t + dt; a step that fails is halved, at most 6 times. */
int stepper_advance(stepper *p, double dt, error *err);
/* now goes on by one step of its own length, not beyond `until`. */
int stepper_advance_freely(stepper *p, double until, error *err);
/* Reactions of the steady solution now. */
int stepper_steady(stepper *p, error *err);
void stepper_destroy(stepper *p);

/* Prescribed values at time t into x: boundaries and bodies. */
int stepper_prescribe(const conditions *c, const bodies *b, double t, double *x, error *err);

/* --- one step (step.c) --- */

/* What became of the attempt at a step. */
enum step_outcome { STEP_DONE, STEP_TOO_FAR, STEP_NEWTON };

/* Tries a step of this length from `now` into the first trial state.  Unless size is NULL: error of a step that was
 * done, and sizes of fields (measure_relative). */
int step_try(stepper *p, double dt, enum step_outcome *outcome, step_error *e, double *size, error *err);
/* All reactions at x, with free fields of zero mean. */
int step_react(stepper *p, newton_time time, const double *x, error *err);

/* --- coefficients (bdf.c) --- */

/* du/dt = shift u^{n+1} + c[0] u^n + c[1] u^{n-1} for a step of length dt after one of dt_previous. */
typedef struct bdf {
    int order;
    double shift, c[2];
} bdf;

bdf bdf_of(int order, double dt, double dt_previous);

#endif
