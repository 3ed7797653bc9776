/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Time steps by BDF1 and BDF2 with steps of any length,
 *
 *     du/dt = (c0 u^{n+1} + c1 u^n + c2 u^{n-1}),   w = dt / dt_previous
 *     c0 = (1 + 2w) / (1 + w) / dt,  c1 = -(1 + w) / dt,  c2 = w^2 / (1 + w) / dt.
 *
 * BDF2 needs two values to start from.  Its first step is Richardson's extrapolation of backward
 * Euler, 2 (two half steps) - (one step): of second order in velocity and in pressure. */
#include "solve/solve.h"

#include <math.h>
#include <string.h>

enum { HALVINGS = 6 };

int stepper_create(stepper *p, newton_system *s, int order, dirichlet_fn *f, void *ctx, error *err)
{
    int64_t n = s->space->n_dof;

    memset(p, 0, sizeof *p);
    p->system = s;
    p->order = order;
    p->dirichlet = f;
    p->dirichlet_ctx = ctx;
    ARENA_NEW(&p->memory, p->x, n, err);
    ARENA_NEW(&p->memory, p->before, n, err);
    ARENA_NEW(&p->memory, p->history, n, err);
    ARENA_NEW(&p->memory, p->residual, n, err);
    for (int i = 0; i < 4; i++)
        ARENA_NEW(&p->memory, p->save[i], n, err);
    return 0;
}

void stepper_destroy(stepper *p)
{
    arena_free(&p->memory);
    memset(p, 0, sizeof *p);
}

static int move(stepper *p, enum move what, int slot, double dt, const double *u0, double *u1, error *err)
{
    return p->move ? p->move(p->dirichlet_ctx, what, slot, dt, u0, u1, err) : 0;
}

/* One BDF step from (x, before) to t + dt; on failure x and before are as they were. */
static int step(stepper *p, int order, double dt, int *converged, error *err)
{
    newton_system *s = p->system;
    size_t n = (size_t)s->space->n_dof;
    double w = order == 2 ? dt / p->dt_previous : 0; /* at most 2, see advance */
    newton_time time = {.t = p->t + dt, .dt = dt, .history = p->history, .old = p->save[2]};
    double c[2] = {order == 2 ? -(1 + w) / dt : -1 / dt, order == 2 ? w * w / (1 + w) / dt : 0};

    time.shift = order == 2 ? (1 + 2 * w) / (1 + w) / dt : 1 / dt;
    memcpy(p->save[2], p->x, n * sizeof *p->x);
    for (size_t i = 0; i < n; i++) {
        p->history[i] = c[0] * p->x[i] + c[1] * p->before[i];
        if (order == 2) /* start from the extrapolation */
            p->x[i] += w * (p->x[i] - p->before[i]);
    }
    TRY(p->dirichlet(p->dirichlet_ctx, time.t, p->x, err));
    TRY(move(p, MOVE_REMEMBER, 0, 0, NULL, NULL, err));
    for (int k = 0; k <= p->geometry_iterations; k++) { /* from the second on with the motion just found */
        if (move(p, MOVE_PREDICT, 0, dt, p->save[2], p->x, err))
            return error_prefix(err, "t = %.6g: ", time.t);
        if (p->frame)
            time.frame =
                p->frame(p->dirichlet_ctx, order, c, (const double *[]){p->save[2], p->before}, p->history);
        TRY(newton_solve(s, &time, &p->options, p->x, &p->report, err));
        p->newton_iterations += p->report.iterations;
        if (!p->report.converged)
            break;
    }
    *converged = p->report.converged;
    if (!*converged) {
        memcpy(p->x, p->save[2], n * sizeof *p->x);
        return move(p, MOVE_RESTORE, 0, 0, NULL, NULL, err);
    }
    TRY(move(p, MOVE_PLACE, 0, dt, p->save[2], p->x, err));
    memcpy(p->before, p->save[2], n * sizeof *p->x);
    TRY(move(p, MOVE_KEEP, 0, 0, NULL, NULL, err));
    memcpy(p->save[2], p->x, n * sizeof *p->x);
    gauge_zero_mean(s, p->save[2]);
    time.old = p->before;
    TRY(newton_residual(s, &time, p->save[2], p->residual, err));
    p->last = time;
    p->dt_previous = dt;
    p->t += dt;
    p->n_history++;
    return 0;
}

/* First step of BDF2. */
static int start(stepper *p, double dt, int *converged, error *err)
{
    size_t n = (size_t)p->system->space->n_dof;
    double t = p->t;

    memcpy(p->save[0], p->x, n * sizeof *p->x);
    TRY(move(p, MOVE_REMEMBER, 1, 0, NULL, NULL, err));
    TRY(step(p, 1, dt, converged, err));
    if (!*converged)
        return 0;
    TRY(move(p, MOVE_RESTORE, 1, 0, NULL, NULL, err));
    memcpy(p->save[1], p->x, n * sizeof *p->x);
    memcpy(p->save[3], p->residual, n * sizeof *p->x);
    memcpy(p->x, p->save[0], n * sizeof *p->x);
    p->t = t;
    for (int half = 0; half < 2 && *converged; half++)
        TRY(step(p, 1, dt / 2, converged, err));
    for (size_t i = 0; i < n; i++) {
        p->x[i] = *converged ? 2 * p->x[i] - p->save[1][i] : p->save[0][i];
        p->before[i] = p->save[0][i];
        p->residual[i] = 2 * p->residual[i] - p->save[3][i];
    }
    p->t = *converged ? t + dt : t;
    TRY(move(p, MOVE_KEEP, 1, 0, NULL, NULL, err));
    TRY(move(p, *converged ? MOVE_PLACE : MOVE_RESTORE, 1, dt, p->save[0], p->x, err));
    p->dt_previous = dt;
    p->n_history = *converged ? 1 : 0;
    return 0;
}

static int advance(stepper *p, double dt, int halvings, error *err)
{
    int converged;

    /* BDF2 is stable for steps that grow by less than 1 + sqrt(2) */
    if (p->order == 2 && p->n_history > 0 && dt > 2.1 * p->dt_previous && halvings < HALVINGS) {
        TRY(advance(p, dt / 2, halvings + 1, err));
        return advance(p, dt / 2, halvings + 1, err);
    }
    if (p->order == 2 && p->n_history == 0)
        TRY(start(p, dt, &converged, err));
    else
        TRY(step(p, p->order, dt, &converged, err));
    if (converged) {
        p->n_steps++;
        return 0;
    }
    linear_forget(&p->system->linear);
    if (halvings == HALVINGS)
        return error_set(err, ERR_CONVERGE, "no convergence at t = %.6g with a step of %.3g, %d times halved: %s",
                         p->t, dt, HALVINGS, p->report.why);
    p->n_halved++;
    TRY(advance(p, dt / 2, halvings + 1, err));
    return advance(p, dt / 2, halvings + 1, err);
}

int stepper_advance(stepper *p, double dt, error *err)
{
    return advance(p, dt, 0, err);
}
