/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * One time step, tried on a copy of the state:
 *
 *     unknowns extrapolated and prescribed -> bodies placed where they will be -> Newton -> bodies moved by the
 * mean of old and new velocity.
 *
 * BDF2 needs two values to start from.  Its first step is Richardson's extrapolation of backward Euler,
 * 2 (two half steps) - (one step): of second order in velocity, pressure and reactions. */
#include "solve/stepper.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

int stepper_prescribe(const conditions *c, const bodies *b, double t, double *x, error *err)
{
    TRY(conditions_apply(c, b->space, t, x, err));
    return bodies_prescribe(b, t, x, err);
}

static const body_points *points(const bodies *b)
{
    return b->now ? &b->now->points : NULL;
}

/* Places the bodies; matrix, factors and unknowns follow. */
static int place(stepper *p, const pose *at, double *x, error *err)
{
    enum placement_change change;

    if (p->bodies->n == 0)
        return 0;
    TRY(bodies_place(p->bodies, at, &change, err));
    if (change == PLACEMENT_PATTERN)
        TRY(system_renew(p->system, err));
    if (change != PLACEMENT_SAME)
        TRY(linear_move(&p->system->linear, points(p->bodies), err));
    bodies_clear(p->bodies, p->bodies->now, x);
    return 0;
}

/* All reactions at x, with free fields of zero mean. */
int step_react(stepper *p, newton_time time, const double *x, error *err)
{
    static const uint32_t only[REACTIONS] = {0, PF_FLUID_FORCE, ASSEMBLE_CONTACT, ASSEMBLE_COUPLING};

    memcpy(p->level, x, (size_t)p->now->n_dof * sizeof *x);
    gauge_zero_mean(p->system, time.bodies, p->level);
    for (int i = 0; i < REACTIONS && p->reaction[i]; i++) {
        time.only = only[i];
        time.power = i == REACTION_ALL ? power_meter_ask(p->meter) : NULL;
        TRY(newton_residual(p->system, &time, p->level, p->reaction[i], err));
    }
    return power_meter_read(p->meter, p->level, p->reaction[REACTION_ALL], time.bodies, err);
}

/* What the fluid does to the bodies, by the reactions of the step. */
static void remember_fluid(const stepper *p, state *to)
{
    const int n[2] = {p->bodies->space->mesh->dim, p->bodies->space->mesh->dim == 2 ? 1 : 3};

    for (int k = 0; k < (int)to->n_body; k++)
        for (int spin = 0; spin < 2; spin++) {
            int64_t d = bodies_dof(p->bodies, k, spin);

            for (int i = 0; i < n[spin]; i++)
                to->fluid[k].force[3 * spin + i] = d >= 0 ? -p->reaction[REACTION_FLUID][d + i] : 0;
        }
}

/* Whether a step that carries bodies so far must be a shorter one; says so, of each kind once. */
static int goes_too_far(stepper *p, const state *from, const state *to, double dt)
{
    char why[300];
    enum too_far far = p->bodies->n ? bodies_too_far(p->bodies, from->pose, to->pose, why, sizeof why) : FAR_NOT;

    if (!far)
        return 0;
    if (!p->said[far] && p->tolerance == 0)
        warning_add(p->bodies->warnings,
                    "t = %.6g: a step of %.3g is too long and is shortened, as others may be: %s", from->t, dt,
                    why);
    p->said[far] = 1;
    p->too_far = far;
    snprintf(p->report.why, sizeof p->report.why, "%s", why);
    return 1;
}

/* Coefficients with which the levels extrapolate to the end of a step, through at most `most` of them; how many. */
static int levels_of(const state *from, double dt, int most, double *c)
{
    int n = from->n_history + 1 < most ? (int)from->n_history + 1 : most;

    c[0] = 1;
    if (n == 2) {
        c[0] = 1 + dt / from->dt_previous;
        c[1] = -dt / from->dt_previous;
    }
    if (n == 3)
        control_extrapolate(dt, from->dt_previous, from->dt_before, c);
    return n;
}

/* to->x: the unknowns extrapolated to the end of the step, at their places. */
static void extrapolate(const state *from, state *to, double dt, int most)
{
    const double *u[] = {from->x, from->before, from->before2};
    double c[3];
    int n = levels_of(from, dt, most, c);

    for (int64_t i = 0; i < from->n_dof; i++) {
        double sum = c[0] * u[0][i];

        for (int l = 1; l < n; l++)
            sum += c[l] * u[l][i];
        to->x[i] = sum;
    }
}

/* The same along the paths of bodies that have been placed, near those that move; what is prescribed stays. */
static int follow(stepper *p, const state *from, state *to, double dt, int most, error *err)
{
    double c[3];
    int n = levels_of(from, dt, most, c);

    if (p->bodies->n && n > 1) {
        bodies_extrapolate(p->bodies, p->bodies->now, n, c,
                           (const double *[]){from->x, from->before, from->before2},
                           (const pose *[]){from->pose, from->pose_before, from->pose_before2}, to->x);
        TRY(stepper_prescribe(p->conditions, p->bodies, from->t + dt, to->x, err));
        bodies_clear(p->bodies, p->bodies->now, to->x);
    }
    return 0;
}

/* p->predicted, and from where Newton's method starts: there, or, where it has failed, at an extrapolation of less
 * order, which does not overshoot. */
static int predict(stepper *p, const state *from, state *to, double dt, int most, error *err)
{
    int simpler = most > p->failures ? most - p->failures : 1;

    TRY(follow(p, from, to, dt, most, err));
    memcpy(p->predicted, to->x, (size_t)from->n_dof * sizeof *to->x);
    if (simpler == most)
        return 0;
    extrapolate(from, to, dt, simpler);
    TRY(stepper_prescribe(p->conditions, p->bodies, from->t + dt, to->x, err));
    if (p->bodies->n)
        bodies_clear(p->bodies, p->bodies->now, to->x);
    return follow(p, from, to, dt, simpler, err);
}

/* What was now is a level of history. */
static void advance_levels(const state *from, state *to, double dt)
{
    const size_t unknowns = (size_t)from->n_dof * sizeof *to->x, poses = (size_t)from->n_body * sizeof *to->pose;

    memcpy(to->before2, from->before, unknowns);
    memcpy(to->before, from->x, unknowns);
    memcpy(to->pose_before2, from->pose_before, poses);
    memcpy(to->pose_before, from->pose, poses);
    to->t = from->t + dt;
    to->dt_before = from->dt_previous;
    to->dt_previous = dt;
    to->n_history = from->n_history + 1;
}

/* Bodies are placed where they will be, with the motion in to->x; *too_far: that would be too far. */
static int place_ahead(stepper *p, const state *from, state *to, double dt, int *too_far, error *err)
{
    bodies_move(p->bodies, from->pose, dt, from->x, to->x, to->pose);
    *too_far = goes_too_far(p, from, to, dt);
    if (!*too_far && place(p, to->pose, to->x, err))
        return error_prefix(err, "t = %.6g: ", from->t + dt);
    return 0;
}

/* Memory at the end of the step.  A term that asks for a shorter one gets it. */
static int keep(stepper *p, const newton_time *time, state *to, int *converged, error *err)
{
    int status = system_keep(p->system, time, to->x, to->kept, err);

    if (!status || !err->retry)
        return status;
    snprintf(p->report.why, sizeof p->report.why, "%.500s", err->text);
    *converged = 0;
    return 0;
}

/* One BDF step of order 1 or 2 from a state to another. */
static int step(stepper *p, const state *from, state *to, int order, double dt, int *converged, error *err)
{
    bdf b = bdf_of(order, dt, from->dt_previous);
    newton_time time = {
        .t = from->t + dt, .dt = dt, .shift = b.shift, .history = p->history, .old = from->x, .kept = from->kept};
    time.fluid = (const double(*)[6])from->fluid;
    int too_far = 0;

    *converged = 0;
    p->too_far = FAR_NOT;
    state_copy(to, from);
    for (int64_t i = 0; i < from->n_dof; i++)
        p->history[i] = b.c[0] * from->x[i] + b.c[1] * from->before[i];
    extrapolate(from, to, dt, order == 2 ? 3 : 1);
    TRY(stepper_prescribe(p->conditions, p->bodies, time.t, to->x, err));
    for (int k = 0; k <= p->geometry_iterations; k++) { /* from the second on with the motion just found */
        TRY(place_ahead(p, from, to, dt, &too_far, err));
        if (too_far)
            return 0;
        if (k == 0)
            TRY(predict(p, from, to, dt, order == 2 ? 3 : 1, err));
        time.bodies = points(p->bodies);
        if (p->bodies->n)
            time.frame =
                bodies_paths(p->bodies, p->bodies->now, order, b.c, (const double *[]){from->x, from->before},
                             (const pose *[]){from->pose, from->pose_before}, p->history);
        TRY(newton_solve(p->system, &time, &p->options, to->x, &p->report, err));
        TRY(bodies_check(p->bodies, err)); /* paths asked for their levels */
        p->now->count.newton_iterations += p->report.iterations;
        if (!p->report.converged)
            return 0;
    }
    bodies_move(p->bodies, from->pose, dt, from->x, to->x, to->pose);
    if (goes_too_far(p, from, to, dt))
        return 0;
    *converged = 1;
    if (p->bodies->n)
        TRY(bodies_fill(p->bodies, p->bodies->now, to->x, err));
    TRY(step_react(p, time, to->x, err));
    TRY(keep(p, &time, to, converged, err));
    remember_fluid(p, to);
    advance_levels(from, to, dt);
    return 0;
}

/* 2 (two half steps) - (one step), into the first trial state. */
static int start(stepper *p, const state *from, double dt, int *converged, error *err)
{
    state *whole = &p->trial[0], *half = &p->trial[1], *full = &p->trial[2];
    int64_t n = from->n_dof;

    TRY(step(p, from, whole, 1, dt, converged, err));
    if (!*converged)
        return 0;
    for (int i = 0; i < REACTIONS && p->reaction[i]; i++)
        memcpy(p->saved[i], p->reaction[i], (size_t)n * sizeof **p->saved);
    if (p->bodies->n)
        memcpy(p->idle, p->bodies->now->idle, (size_t)n * sizeof *p->idle);
    TRY(step(p, from, half, 1, dt / 2, converged, err));
    power_meter_hold(p->meter, dt / 2);
    if (*converged)
        TRY(step(p, half, full, 1, dt / 2, converged, err));
    if (!*converged)
        return 0;
    for (int64_t k = 0; k < n; k++) /* what was off in one of the two has no value there to extrapolate from */
        whole->x[k] =
            p->idle[k] || (p->bodies->n && p->bodies->now->idle[k]) ? full->x[k] : 2 * full->x[k] - whole->x[k];
    memcpy(whole->kept, full->kept, (size_t)from->n_kept * sizeof *full->kept); /* bounds of memory hold */
    for (int i = 0; i < REACTIONS && p->reaction[i]; i++)
        for (int64_t k = 0; k < n; k++)
            p->reaction[i][k] = 2 * p->reaction[i][k] - p->saved[i][k];
    remember_fluid(p, whole);
    bodies_move(p->bodies, from->pose, dt, from->x, whole->x, whole->pose);
    if (goes_too_far(p, from, whole, dt))
        *converged = 0;
    return p->bodies->n ? bodies_fill(p->bodies, p->bodies->now, whole->x, err) : 0;
}

/* Error of the step in the first trial state.  That of the first step is guessed from what Richardson's
 * extrapolation took out, that of the second from what a straight line misses. */
static step_error error_of(stepper *p, const state *from, int started, double dt, double *size)
{
    const uint8_t *idle = p->bodies->n ? p->bodies->now->idle : NULL;
    const double *x = p->trial[0].x;

    measure_place(&p->measure);
    if (started)
        return measure_first(&p->measure, from, p->tolerance, dt, x, p->trial[2].x, idle, size);
    if (from->n_history == 1)
        return measure_first(&p->measure, from, p->tolerance, dt, x, p->predicted, idle, size);
    return measure_step(&p->measure, from, p->tolerance, dt, x, p->predicted, idle, size);
}

int step_try(stepper *p, double dt, enum step_outcome *outcome, step_error *e, double *size, error *err)
{
    const state *from = p->now;
    int started = p->order == 2 && from->n_history == 0, converged;

    power_meter_drop(p->meter);
    p->options.hurry = p->failures < 2;
    if (started)
        TRY(start(p, from, dt, &converged, err));
    else
        TRY(step(p, from, &p->trial[0], p->order, dt, &converged, err));
    p->failures = converged || p->too_far ? 0 : p->failures + 1;
    *outcome = converged ? STEP_DONE : p->too_far ? STEP_TOO_FAR : STEP_NEWTON;
    if (!converged)
        linear_forget(&p->system->linear);
    else if (size)
        *e = error_of(p, from, started, dt, size);
    return 0;
}
