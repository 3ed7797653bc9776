/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * step_control.h -- how long a time step is, by the error of the one before. */
#ifndef SOLVE_STEP_CONTROL_H
#define SOLVE_STEP_CONTROL_H

#include "state/state.h"

/* Part of x - x_predicted, extrapolated through three levels, that is the error of a step of BDF2 of length dt
 * after one of dt_previous after one of dt_before. */
double control_milne(double dt, double dt_previous, double dt_before);
/* Error of a step of BDF2 over the third derivative. */
double control_defect(double dt, double dt_previous);
/* Coefficients of that extrapolation. */
void control_extrapolate(double dt, double dt_previous, double dt_before, double *c);

enum repeated { NOT_REPEATED, REPEATED, REPEATED_ERROR };

/* A step was made with this error (over what is allowed), after tries that failed, or failed by their error: sets
 * the next one's length. */
void control_accept(step_control *c, double error, double dt, enum repeated repeated);
/* Length for another try after one of dt with too large an error. */
double control_shorten(double error, double dt);
/* Length of a step from t, so that one ends at `until` without a last small one. */
double control_land(double t, double dt, double until);

#endif
