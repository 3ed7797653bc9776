/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * trial_call.h -- an instance of a solver under test, and calls of its functions. */
#ifndef SOLVE_TRIAL_CALL_H
#define SOLVE_TRIAL_CALL_H

#include "solve/trial.h"

/* A test as it goes on. */
typedef struct trials {
    selftest *s;
    const pf_solver *solver;
    const void *params; /* its defaults, or another choice */
    int approximate;
    char why[400]; /* of the last call */
} trials;

/* Functions of the solver; an enum pf_solver_status, reasons in c->why.  One without a reason where there must be
 * one gets "it does not say why". */
int trial_make(trials *c, void **self);
int trial_analyze(trials *c, void *self, trial *t);
int trial_setup(trials *c, void *self, trial *t);
int trial_update(trials *c, void *self, trial *t);
int trial_apply(trials *c, void *self, const double *b, double *x, int64_t n);
void trial_product(trials *c, void *self, const double *x, double *y);
void trial_drop(trials *c, void *self);
/* Has the optional function `update`, and `multiply`. */
int trial_updates(const trials *c);
int trial_multiplies(const trials *c);

/* Makes an instance, analyses and sets up; on failure *self = NULL. */
int trial_begin(trials *c, void **self, trial *t);

/* A line of the report. */
void trial_line(trials *c, int ok, const char *format, ...) __attribute__((format(printf, 3, 4)));
/* A call failed where it should not. */
void trial_failed(trials *c, const char *subject, int status);
/* What is set up solves t, and says how well: one line.  before, beside: as in trial_guess. */
int trial_check(trials *c, void *self, const trial *t, const char *subject, const trial *before,
                const trial *beside, error *err);

/* trial_life.c: what happens in the life of an instance, on systems of one kind. */
int trial_life(trials *c, enum trial_kind kind, int side, error *err);

#endif
