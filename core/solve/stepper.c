/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Time steps.  A step is tried on a copy of the state:
 *
 *     unknowns extrapolated and prescribed -> bodies placed where they will be -> Newton -> bodies moved by the
 * mean of old and new velocity.
 *
 * BDF2 needs two values to start from.  Its first step is Richardson's extrapolation of backward Euler,
 * 2 (two half steps) - (one step): of second order in velocity, pressure and reactions. */
#include "solve/stepper.h"

#include <stdio.h>
#include <string.h>

enum { HALVINGS = 6 };

int stepper_create(stepper *p, newton_system *s, bodies *b, const conditions *c, state *now, error *err)
{
    int64_t n = s->space->n_dof;
    int kinds = b->n ? REACTIONS : 1;

    memset(p, 0, sizeof *p);
    p->system = s;
    p->bodies = b;
    p->conditions = c;
    p->now = now;
    for (int i = 0; i < 3; i++)
        TRY(state_create(&p->trial[i], now->n_dof, now->n_body, err));
    ARENA_NEW(&p->memory, p->history, n, err);
    ARENA_NEW(&p->memory, p->level, n, err);
    ARENA_NEW(&p->memory, p->idle, n, err);
    for (int i = 0; i < kinds; i++) {
        ARENA_NEW(&p->memory, p->reaction[i], n, err);
        ARENA_NEW(&p->memory, p->saved[i], n, err);
    }
    return 0;
}

void stepper_destroy(stepper *p)
{
    for (int i = 0; i < 3; i++)
        state_destroy(&p->trial[i]);
    arena_free(&p->memory);
    memset(p, 0, sizeof *p);
}

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
        linear_forget(&p->system->linear); /* the old factors know the old cells */
    bodies_clear(p->bodies, p->bodies->now, x);
    return 0;
}

/* All reactions at x, with free fields of zero mean. */
static int react(stepper *p, newton_time time, const double *x, error *err)
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

int stepper_steady(stepper *p, error *err)
{
    return react(p, (newton_time){.bodies = points(p->bodies)}, p->now->x, err);
}

/* Whether a step that carries bodies so far must be a shorter one; says so, of each kind once. */
static int goes_too_far(stepper *p, const state *from, const state *to, double dt)
{
    char why[300];
    enum too_far far = p->bodies->n ? bodies_too_far(p->bodies, from->pose, to->pose, why, sizeof why) : FAR_NOT;

    if (!far)
        return 0;
    if (!p->said[far])
        warning_add(p->bodies->warnings,
                    "t = %.6g: a step of %.3g is too long and is shortened, as others may be: %s", from->t, dt,
                    why);
    p->said[far] = 1;
    p->too_far = far;
    snprintf(p->report.why, sizeof p->report.why, "%s", why);
    return 1;
}

/* One BDF step of order 1 or 2 from a state to another. */
static int step(stepper *p, const state *from, state *to, int order, double dt, int *converged, error *err)
{
    bdf b = bdf_of(order, dt, from->dt_previous);
    newton_time time = {.t = from->t + dt, .dt = dt, .shift = b.shift, .history = p->history, .old = from->x};

    *converged = 0;
    p->too_far = FAR_NOT;
    state_copy(to, from);
    for (int64_t i = 0; i < from->n_dof; i++) {
        p->history[i] = b.c[0] * from->x[i] + b.c[1] * from->before[i];
        if (order == 2)
            to->x[i] += b.ratio * (from->x[i] - from->before[i]);
    }
    TRY(stepper_prescribe(p->conditions, p->bodies, time.t, to->x, err));
    for (int k = 0; k <= p->geometry_iterations; k++) { /* from the second on with the motion just found */
        bodies_move(p->bodies, from->pose, dt, from->x, to->x, to->pose);
        if (goes_too_far(p, from, to, dt))
            return 0;
        if (place(p, to->pose, to->x, err))
            return error_prefix(err, "t = %.6g: ", time.t);
        time.bodies = points(p->bodies);
        if (p->bodies->n)
            time.frame =
                bodies_paths(p->bodies, p->bodies->now, order, b.c, (const double *[]){from->x, from->before},
                             (const pose *[]){from->pose, from->pose_before}, p->history);
        TRY(newton_solve(p->system, &time, &p->options, to->x, &p->report, err));
        TRY(bodies_check(p->bodies, err)); /* paths asked for their levels */
        p->now->newton_iterations += p->report.iterations;
        if (!p->report.converged)
            return 0;
    }
    bodies_move(p->bodies, from->pose, dt, from->x, to->x, to->pose);
    if (goes_too_far(p, from, to, dt))
        return 0;
    *converged = 1;
    if (p->bodies->n)
        TRY(bodies_fill(p->bodies, p->bodies->now, to->x, err));
    TRY(react(p, time, to->x, err));
    memcpy(to->before, from->x, (size_t)from->n_dof * sizeof *to->before);
    memcpy(to->pose_before, from->pose, (size_t)from->n_body * sizeof *to->pose);
    to->t = time.t;
    to->dt_previous = dt;
    to->n_history = from->n_history + 1;
    return 0;
}

/* 2 (two half steps) - (one step), into the first trial state. */
static int start(stepper *p, double dt, int *converged, error *err)
{
    const state *from = p->now;
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
    for (int i = 0; i < REACTIONS && p->reaction[i]; i++)
        for (int64_t k = 0; k < n; k++)
            p->reaction[i][k] = 2 * p->reaction[i][k] - p->saved[i][k];
    bodies_move(p->bodies, from->pose, dt, from->x, whole->x, whole->pose);
    if (goes_too_far(p, from, whole, dt))
        *converged = 0;
    return p->bodies->n ? bodies_fill(p->bodies, p->bodies->now, whole->x, err) : 0;
}

/* The state reached becomes that of now; counts go on. */
static void accept(stepper *p)
{
    int64_t iterations = p->now->newton_iterations, halved = p->now->halved, shortened = p->now->shortened;

    state_swap(p->now, &p->trial[0]);
    p->now->newton_iterations = iterations;
    p->now->halved = halved;
    p->now->shortened = shortened;
    p->now->steps++;
}

static int advance(stepper *p, double dt, int halvings, error *err)
{
    const state *now = p->now;
    int converged;

    /* BDF2 is stable for steps that grow by less than 1 + sqrt(2) */
    if (p->order == 2 && now->n_history > 0 && dt > 2.1 * now->dt_previous) {
        TRY(advance(p, dt / 2, halvings, err));
        return advance(p, dt / 2, halvings, err);
    }
    if (p->order == 2 && now->n_history == 0)
        TRY(start(p, dt, &converged, err));
    else
        TRY(step(p, now, &p->trial[0], p->order, dt, &converged, err));
    if (converged) {
        power_meter_accept(p->meter, p->order, p->trial[0].dt_previous);
        accept(p);
        return 0;
    }
    power_meter_drop(p->meter);
    linear_forget(&p->system->linear);
    if (halvings == HALVINGS)
        return error_set(err, ERR_CONVERGE, "no convergence at t = %.6g with a step of %.3g, %d times halved: %s",
                         now->t, dt, HALVINGS, p->report.why);
    p->now->halved += !p->too_far;
    p->now->shortened += p->too_far != FAR_NOT;
    TRY(advance(p, dt / 2, halvings + 1, err));
    return advance(p, dt / 2, halvings + 1, err);
}

int stepper_advance(stepper *p, double dt, error *err)
{
    return advance(p, dt, 0, err);
}
