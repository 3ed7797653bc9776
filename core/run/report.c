/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What a run says after a solution: a line of the log, and warnings. */
#include "run/run.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

int run_log_solve(run *r, double t, double dt, const newton_report *report, error *err)
{
    text s = {0};
    int status;

    text_add(&s, "\"step\": %ld, \"t\": ", r->result->steps);
    text_number(&s, t);
    text_add(&s, ", \"dt\": ");
    text_number(&s, dt);
    text_add(&s, ", \"newton\": %d, \"residual\": ", report->iterations);
    text_number(&s, report->history[report->iterations]);
    text_add(&s, ", \"ratio\": ");
    text_number(&s, report->ratio);
    text_add(&s, ", \"history\": [");
    for (int i = 0; i <= report->iterations; i++) {
        text_add(&s, "%s", i ? ", " : "");
        text_number(&s, report->history[i]);
    }
    text_add(&s, "]");
    energy_log(r, &s);
    if (r->p->bodies.n) {
        text_add(&s, ", \"particles\": %d, \"kinetic_energy\": ", r->p->bodies.n);
        text_number(&s, particles_energy(r));
        text_add(&s, ", \"momentum_defect\": ");
        text_number(&s, particles_balance(r));
    }
    status = s.failed ? error_memory(err, "log", 0) : output_event(r, "solve", s.s, err);
    text_free(&s);
    return status;
}

int run_log_failures(run *r, error *err)
{
    const stepper *p = r->stepper;

    for (int i = 0; i < p->n_failed && i < STEPPER_FAILURES; i++) {
        const failed_try *f = &p->failed[i];
        text s = {0};
        int status;

        text_add(&s, "\"t\": ");
        text_number(&s, f->t);
        text_add(&s, ", \"dt\": ");
        text_number(&s, f->dt);
        text_add(&s, ", \"why\": ");
        text_json(&s, f->why);
        status = s.failed ? error_memory(err, "log", 0) : output_event(r, "repeated", s.s, err);
        text_free(&s);
        TRY(status);
    }
    return 0;
}

/* A warning, once, if it cannot be told whether a field is free. */
static void warn_doubt(run *r)
{
    for (int f = 0; f < r->p->space.n_field && !r->warned_doubt; f++)
        if (r->p->system.gauge.doubt[f] > 0) {
            r->warned_doubt = 1;
            warning_add(
                &r->p->warnings,
                "away from bodies nothing fixes the level of %s, and near them the equations do so weakly, by "
                "%.1g of their terms: if it is their quadrature, %s and forces are off by a constant part; take "
                "more cells across a body",
                r->p->space.field[f].name, r->p->system.gauge.doubt[f], r->p->space.field[f].name);
        }
}

/* A warning if what flows in does not flow out. */
void run_warn_defect(run *r)
{
    problem *p = r->p;
    const gauge *g = &p->system.gauge;
    double speed = 0;

    warn_doubt(r);
    for (int64_t d = 0; d < p->space.n_dof; d++)
        if (p->space.field[p->space.dof_field[d]].shape == PF_VECTOR)
            speed = fmax(speed, fabs(r->x[d]));
    for (int f = 0; f < p->space.n_field; f++)
        if (g->free[f] && !r->warned &&
            fabs(g->defect[f]) > 1e-3 * speed * pow(g->volume, 1 - 1.0 / p->description.dim)) {
            r->warned = 1;
            warning_add(
                &p->warnings,
                "%s is free up to a constant and its equations do not add up: by %.3g (the net flow through "
                "the boundary, if %s is a pressure); the excess is spread over the domain. Is an outflow "
                "(natural = true) missing?",
                p->space.field[f].name, -g->defect[f], p->space.field[f].name);
        }
}

/* A warning, once, if the equations leave unknowns open. */
void run_warn_singular(run *r, const newton_report *report)
{
    if (report->singular && !r->warned_singular)
        warning_add(&r->p->warnings,
                    "the equations do not determine all unknowns (%s); the residual has converged, some unknowns "
                    "(pressure inside bodies?) are arbitrary",
                    report->why);
    r->warned_singular |= report->singular;
}

/* A warning, once, if Newton's method converges as it does with a wrong matrix. */
void run_warn_order(run *r, const newton_report *report)
{
    if (report->linear_only && !r->warned_order)
        warning_add(
            &r->p->warnings,
            "Newton converges with order %.1f only: some Jacobian block is wrong or missing; plugflow jacobian "
            "%s compares them one by one",
            report->order, r->p->description.c->path);
    r->warned_order |= report->linear_only;
}

void run_say(const run *r, const char *fmt, ...)
{
    char line[1000];
    va_list ap;

    if (!r->talk || !r->talk->say)
        return;
    va_start(ap, fmt);
    vsnprintf(line, sizeof line, fmt, ap);
    va_end(ap);
    r->talk->say(r->talk->ctx, line);
}

/* Says and logs the warnings that have come since the last call. */
int run_tell_warnings(run *r, error *err)
{
    const warning_list *w = &r->p->warnings;

    for (; r->told < w->n; r->told++) {
        text s = {0};
        int status;

        text_add(&s, "  warning: ");
        text_add(&s, "%s", w->text[r->told]);
        if (r->talk && r->talk->warn && !s.failed)
            r->talk->warn(r->talk->ctx, s.s);
        text_free(&s);
        text_add(&s, "\"text\": ");
        text_json(&s, w->text[r->told]);
        status = s.failed ? error_memory(err, "log", 0) : output_event(r, "warning", s.s, err);
        text_free(&s);
        TRY(status);
    }
    return 0;
}

/* r->x: the solution as it is shown. */
void run_take_solution(run *r)
{
    memcpy(r->x, r->p->state.x, (size_t)r->p->space.n_dof * sizeof *r->x);
    gauge_zero_mean(&r->p->system, problem_points(r->p), r->x);
}
