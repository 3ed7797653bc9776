/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * From step to step: which are accepted, and what becomes of one that is not.
 *
 * Steps of a given length: one that fails is done in two halves, at most six times.  Steps that choose their length
 * (step_control.h): one that fails, or whose error is too large, is tried again, shorter, and the next ones grow
 * again. */
#include "solve/stepper.h"

#include <math.h>
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
        TRY(state_create(&p->trial[i], now->n_dof, now->n_body, now->n_kept, err));
    ARENA_NEW(&p->memory, p->history, n, err);
    ARENA_NEW(&p->memory, p->level, n, err);
    ARENA_NEW(&p->memory, p->predicted, n, err);
    ARENA_NEW(&p->memory, p->idle, n, err);
    for (int i = 0; i < kinds; i++) {
        ARENA_NEW(&p->memory, p->reaction[i], n, err);
        ARENA_NEW(&p->memory, p->saved[i], n, err);
    }
    return measure_create(&p->measure, b, s->vanishes, &p->memory, err);
}

void stepper_destroy(stepper *p)
{
    for (int i = 0; i < 3; i++)
        state_destroy(&p->trial[i]);
    arena_free(&p->memory);
    memset(p, 0, sizeof *p);
}

void stepper_adapt(stepper *p, double tolerance, double first, double least)
{
    p->tolerance = tolerance;
    p->least = least;
    p->now->control.next = first;
}

int stepper_steady(stepper *p, error *err)
{
    const body_points *at = p->bodies->now ? &p->bodies->now->points : NULL;

    return step_react(p, (newton_time){.bodies = at}, p->now->x, err);
}

/* The state reached becomes that of now; counts go on. */
static void accept(stepper *p)
{
    power_meter_accept(p->meter, p->order, p->trial[0].dt_previous);
    p->trial[0].count = p->now->count;
    p->trial[0].control = p->now->control;
    state_swap(p->now, &p->trial[0]);
    p->now->count.steps++;
}

/* p->report.why: of the try that failed. */
static void keep_reason(stepper *p, double dt)
{
    if (p->n_failed < STEPPER_FAILURES) {
        failed_try *f = &p->failed[p->n_failed];

        f->t = p->now->t;
        f->dt = dt;
        snprintf(f->why, sizeof f->why, "%s", p->report.why);
    }
    p->n_failed++;
}

static void count_failure(stepper *p, enum step_outcome outcome, double dt)
{
    keep_reason(p, dt);
    p->now->count.halved += outcome == STEP_NEWTON;
    p->now->count.shortened += outcome == STEP_TOO_FAR;
}

static int advance(stepper *p, double dt, int halvings, error *err)
{
    const state *now = p->now;
    enum step_outcome outcome;
    step_error e;

    /* BDF2 is stable for steps that grow by less than 1 + sqrt(2) */
    if (p->order == 2 && now->n_history > 0 && dt > 2.1 * now->dt_previous) {
        TRY(advance(p, dt / 2, halvings, err));
        return advance(p, dt / 2, halvings, err);
    }
    TRY(step_try(p, dt, &outcome, &e, NULL, err));
    if (outcome == STEP_DONE) {
        accept(p);
        return 0;
    }
    if (halvings == HALVINGS)
        return error_set(err, ERR_CONVERGE, "no convergence at t = %.6g with a step of %.3g, %d times halved: %s",
                         now->t, dt, HALVINGS, p->report.why);
    count_failure(p, outcome, dt);
    TRY(advance(p, dt / 2, halvings + 1, err));
    return advance(p, dt / 2, halvings + 1, err);
}

int stepper_advance(stepper *p, double dt, error *err)
{
    p->n_failed = 0;
    return advance(p, dt, 0, err);
}

/* --- steps that choose their length --- */

/* Tries from one state, until one is accepted. */
typedef struct tries {
    int n;            /* failed so far                                       */
    int flat;         /* of them in a row whose error did not fall with dt   */
    int jumped;       /* the scheme starts anew                              */
    int rough;        /* accepted with an error that shorter steps have, too */
    double dt, error; /* of the last with an error                           */
} tries;

/* An error that falls with less than this power of dt is none of time: that falls with the third. */
#define FLAT 1
/* One that does not fall is a jump if it is this many times the tolerance; below that it is roughness. */
#define JUMP 10
enum { FLAT_JUMP = 5 };

/* A body that moves by less than this, in cells, moves by little even for its mesh: what changes then is roughness.
 */
#define CREEPS 0.02

static int creeps(const stepper *p, double dt)
{
    double most = 0;

    for (int k = 0; k < p->bodies->n; k++) {
        double v[6];

        measure_motion(&p->measure, k, p->trial[0].x, v);
        most = fmax(most, sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]));
    }
    return p->measure.free && most > 0 && most * dt < CREEPS * p->bodies->h_mean;
}

/* Whether the try with this error is accepted; else *dt is another length. */
static int judge(stepper *p, tries *t, const step_error *e, double *dt)
{
    step_control *c = &p->now->control;

    if (e->error <= fmax(1, c->floor) || t->jumped || c->jumped)
        return 1;
    t->flat = t->error > 0 && e->error > t->error * pow(*dt / t->dt, FLAT) ? t->flat + 1 : 0;
    if ((t->flat || creeps(p, *dt)) && e->whole < JUMP * p->tolerance) {
        if (p->measure.moves)
            c->floor = 1.5 * e->error;
        t->rough = 1;
        p->now->count.rough++;
        return 1;
    }
    if (t->flat >= FLAT_JUMP ||
        (t->flat && *dt < p->tolerance * c->usual)) { /* what was before it says nothing about what comes */
        t->jumped = 1;
        p->now->count.restarted++;
        if (p->now->n_history == 0)
            return 1;
        p->now->n_history = 0;
        return 0;
    }
    snprintf(p->report.why, sizeof p->report.why, "its error is %.3g of what is allowed", e->error);
    keep_reason(p, *dt);
    t->error = e->error;
    t->dt = *dt;
    *dt = t->flat ? *dt / 2 : control_shorten(e->error, *dt);
    p->now->count.repeated++;
    return 0;
}

/* A step of this length, or shorter, into the first trial state. */
static int try_until_done(stepper *p, double *dt, tries *t, step_error *e, double *size, error *err)
{
    const step_control *c = &p->now->control;
    enum step_outcome outcome;

    for (;; t->n++) {
        if (t->n && *dt < p->least)
            return error_set(err, ERR_CONVERGE,
                             "at t = %.6g no step is short enough: the last try, of %.3g, failed: %s", p->now->t,
                             *dt, p->report.why);
        memcpy(size, c->scale, sizeof c->scale);
        TRY(step_try(p, *dt, &outcome, e, size, err));
        if (outcome == STEP_DONE && judge(p, t, e, dt))
            return 0;
        if (outcome != STEP_DONE) {
            count_failure(p, outcome, *dt);
            *dt *= outcome == STEP_NEWTON ? 0.5 : 0.7;
        }
    }
}

int stepper_advance_freely(stepper *p, double until, error *err)
{
    state *now = p->now;
    step_control *c = &now->control;
    double size[SPACE_MAX_FIELDS], wish = now->n_history > 0 ? fmin(c->next, 2 * now->dt_previous) : c->next;
    double dt = control_land(now->t, wish, until);
    step_error e;
    tries t = {0};

    p->n_failed = 0;
    TRY(try_until_done(p, &dt, &t, &e, size, err));
    memcpy(c->scale, size, sizeof size);
    if (t.jumped)
        c->n_past = 0;
    if (t.jumped || c->jumped) { /* nothing is known yet: another one of the same length */
        c->next = dt;
        c->before = 0;
    } else if (t.rough)
        c->next = wish; /* as if it had not been tried shorter */
    else
        control_accept(c, e.error / fmax(1, c->floor), dt,
                       t.error > 0 ? REPEATED_ERROR
                       : t.n       ? REPEATED
                                   : NOT_REPEATED);
    c->jumped = t.jumped;
    c->floor *= 0.9;
    c->usual = fmax(dt, 0.9 * c->usual);
    accept(p);
    measure_remember(&p->measure, p->now);
    return 0;
}
