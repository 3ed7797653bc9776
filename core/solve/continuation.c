/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Steady states.  Newton from the given start; if that fails, the same problem with its
 * nonlinear terms faded in (s from 0 to 1), or with a parameter moved to its value: each
 * solution, extrapolated along s, starts the next; a failed solve halves the increment. */
#include "solve/solve.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* The problem at s: moved parameters, or what is left out of the terms that fade in. */
static void set(continuation *c, double s, newton_time *steady)
{
    for (int i = 0; i < c->n_parameter; i++)
        *c->parameter[i] = s >= 1 ? c->to[i] : c->from[i] * pow(c->to[i] / c->from[i], s);
    steady->faded = c->n_parameter == 0 ? 1 - s : 0;
}

int continuation_solve(newton_system *s, continuation *c, const newton_options *o, double *x, newton_report *report,
                       int *n_steps, continuation_talk *talk, void *ctx, error *err)
{
    size_t n = (size_t)s->space->n_dof;
    newton_time steady = {.bodies = c->bodies};
    newton_options loose = *o;
    double *start, *last, *before, at = 0, previous = -1, ds = 0.25;
    int total = 0, go_on;

    *n_steps = 0;
    ARENA_NEW(&s->memory, start, n, err);
    memcpy(start, x, n * sizeof *x);
    if (c->n_parameter == 0) {
        TRY(newton_solve(s, &steady, o, x, report, err));
        report->total = total = report->iterations;
        if (report->converged || !c->fades || (s->stop && *s->stop))
            return 0;
        if (talk)
            talk(ctx, 1, report->iterations, 0);
    }
    ARENA_NEW(&s->memory, last, n, err);
    ARENA_NEW(&s->memory, before, n, err);
    memcpy(x, start, n * sizeof *x);
    loose.tolerance = fmax(o->tolerance, 1e-6);
    set(c, 0, &steady);
    TRY(newton_solve(s, &steady, &loose, x, report, err));
    total += report->iterations;
    if (talk)
        talk(ctx, 0, report->iterations, report->converged);
    go_on = report->converged;
    while (go_on && at < 1 && !(s->stop && *s->stop)) {
        double next = fmin(1, at + ds);

        memcpy(last, x, n * sizeof *x);
        for (size_t i = 0; previous >= 0 && i < n; i++)
            x[i] += (next - at) / (at - previous) * (last[i] - before[i]);
        set(c, next, &steady);
        TRY(newton_solve(s, &steady, next >= 1 ? o : &loose, x, report, err));
        total += report->iterations;
        ++*n_steps;
        if (talk)
            talk(ctx, next, report->iterations, report->converged);
        if (report->converged) {
            memcpy(before, last, n * sizeof *x);
            previous = at;
            at = next;
            ds *= report->iterations <= 6 ? 2 : 1;
        } else {
            memcpy(x, last, n * sizeof *x);
            ds *= 0.5;
            go_on = ds > 1.0 / 256;
        }
    }
    set(c, 1, &steady);
    if (at < 1)
        report->converged = 0;
    if (at < 1 && s->stop && *s->stop)
        snprintf(report->why, sizeof report->why, "stopped by a signal");
    report->total = total;
    return 0;
}
