/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * From the start of an unsteady run to its end: steps, all of one length or each of its own, that end wherever
 * files of fields or rows of tables are due. */
#include "run/run.h"

#include <math.h>
#include <stdio.h>

/* Part of a step of given length below which none is made: the one before or after is longer or shorter by it. */
#define NEAR 0.01

/* Part of the shortest of what is due below which two dates are the same. */
#define SAME 1e-3

/* What is written at multiples of a time. */
typedef struct due {
    double start, every, slack; /* every = 0: after each step */
    long n;                     /* the next one               */
} due;

static double due_at(const due *d)
{
    return d->every > 0 ? d->start + (double)d->n * d->every : INFINITY;
}

/* Whether it is due at t; then the next one is later. */
static int due_now(due *d, double t)
{
    int now = d->every == 0 || t >= due_at(d) - d->slack;

    while (d->every > 0 && due_at(d) <= t + d->slack)
        d->n++;
    return now;
}

/* What a step came to: warnings, log, what the files show. */
static int take_step(run *r, int64_t iterations, error *err)
{
    problem *p = r->p;
    stepper *s = r->stepper;
    const time_spec *time = &p->description.time;
    run_progress progress;
    double left;

    r->result->steps++;
    r->result->newton_iterations = (int)p->state.count.newton_iterations;
    run_warn_singular(r, &s->report);
    run_take_solution(r);
    run_warn_defect(r);
    TRY(energy_step(r, err));
    TRY(run_tell_warnings(r, err));
    TRY(run_log_solve(r, p->state.t, p->state.dt_previous, &s->report, err));
    TRY(output_take(r, p->state.t, err));
    left = (time->stop - p->state.t) / (time->tolerance > 0 ? p->state.control.next : time->step);
    progress = (run_progress){.step = r->result->steps,
                              .steps = r->result->steps + lround(ceil(left * (1 - 1e-12))),
                              .t = p->state.t,
                              .dt = p->state.dt_previous,
                              .newton = (int)(p->state.count.newton_iterations - iterations),
                              .residual = s->report.history[s->report.iterations]};
    if (r->talk && r->talk->progress)
        r->talk->progress(r->talk->ctx, &progress);
    return 0;
}

/* One step towards `next`: there, or if steps choose their length perhaps less far. */
static int one_step(run *r, double next, error *err)
{
    problem *p = r->p;
    int64_t iterations = p->state.count.newton_iterations;
    int free = p->description.time.tolerance > 0;
    error later;
    int status =
        free ? stepper_advance_freely(r->stepper, next, err) : stepper_advance(r->stepper, next - p->state.t, err);

    run_warn_order(r, &r->stepper->report);
    if (run_log_failures(r, status ? &later : err) && !status)
        status = err->code;
    TRY(status);
    if (!free || fabs(p->state.t - next) <= 1e-6 * p->state.dt_previous)
        p->state.t = next; /* steps add up to it but for round-off */
    return take_step(r, iterations, err);
}

/* Whether the flow has become steady: within the whole time that the run may take it would change, at the rate of
 * the last step, by less than a small part of its largest size.  A flow that has been at rest so far is not:
 * something may start it. */
static int is_steady(run *r)
{
    problem *p = r->p;
    const state *s = &p->state;
    const time_spec *time = &p->description.time;
    step_measure m = r->stepper->measure;
    double motion = 0;

    if (time->steady == 0 || s->n_history < 3)
        return 0;
    measure_place(&r->stepper->measure);
    if (m.rated == 0) /* no equation has a rate: all fields are looked at */
        m.rated = ~0u;
    r->result->change = (time->stop - time->start) / s->dt_previous *
                        measure_relative(&m, s->x, s->before, NULL, p->bodies.n ? p->bodies.now->idle : NULL, 1,
                                         r->largest, &motion);
    for (int f = 0; f < p->space.n_field; f++)
        motion = fmax(motion, r->largest[f]);
    r->result->steady = motion > 1e-300 && r->result->change <= time->steady;
    return r->result->steady;
}

static void warn_unsteady(run *r)
{
    const time_spec *t = &r->p->description.time;

    if (t->steady > 0 && !r->result->steady)
        warning_add(
            &r->p->warnings,
            "the flow is not steady at t = %g (at_most): at the rate of the last step it would change by %.2g of "
            "itself within the time gone by, and %g is asked for",
            t->stop, r->result->change, t->steady);
}

static int write_rows(run *r, error *err)
{
    TRY(tables_add(r, r->p->state.t, err));
    return particles_write(r, r->p->state.t, err);
}

/* End of the next step: of the grid of steps of given length, or what is due before; of steps that choose their
 * length what is due next. *k: number of the next step of the grid. */
static double next_stop(const time_spec *t, double files, double tables, double slack, long n, long *k)
{
    const double first = fmin(files, tables);
    double grid, near;

    if (t->tolerance > 0)
        return first < t->stop - slack ? first : t->stop;
    grid = *k >= n ? t->stop : t->start + (double)*k * t->step;
    near = *k < n ? NEAR * t->step : 0;
    if (first < grid + near && fabs(first - grid) > slack) {
        *k += first >= grid - near;
        return first;
    }
    ++*k;
    return grid;
}

/* After a step: rows and files that are due. */
static int write_due(run *r, due *files, due *tables, int last, error *err)
{
    double t = r->p->state.t;

    if (due_now(tables, t) || last)
        TRY(write_rows(r, err));
    if (due_now(files, t) || last)
        TRY(output_fields(r, t, err));
    return 0;
}

static int begin(run *r, error *err)
{
    TRY(output_take(r, r->p->description.time.start, err));
    TRY(tables_start(r, err));
    return output_fields(r, r->p->description.time.start, err);
}

/* Dates that are nearer to each other are one: no step is made from the one to the other. */
static double same_time(const time_spec *t, const output_spec *o)
{
    double shortest = fmin(o->every, t->stop - t->start);

    if (o->tables_every > 0)
        shortest = fmin(shortest, o->tables_every);
    if (t->tolerance == 0)
        shortest = fmin(shortest, t->step);
    return SAME * shortest;
}

int march(run *r, const volatile sig_atomic_t *stop, error *err)
{
    problem *p = r->p;
    const time_spec *time = &p->description.time;
    const output_spec *o = &p->description.output;
    const double slack = same_time(time, o);
    const long n = time->tolerance > 0 ? 0 : lround(ceil((time->stop - time->start) / time->step * (1 - 1e-12)));
    due files = {time->start, o->every, slack, 1}, tables = {time->start, o->tables_every, slack, 1};
    long k = 1;
    int last = 0;

    TRY(begin(r, err));
    while (!last) {
        double next = next_stop(time, due_at(&files), due_at(&tables), slack, n, &k);
        int status = one_step(r, next, err);
        error ignored;

        if (status && r->taken > p->state.written) /* the last good state goes to disk */
            output_fields(r, r->taken, &ignored);
        TRY(status);
        last = is_steady(r) || p->state.t >= time->stop;
        if (stop && *stop) {
            r->result->status = "interrupted";
            last = 1;
        }
        TRY(write_due(r, &files, &tables, last, err));
    }
    if (!stop || !*stop)
        warn_unsteady(r);
    return lines_write(r, p->state.t, err);
}
