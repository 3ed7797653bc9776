/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The course of a run: start, steps (or one steady solution), files, summary. */
#include "run/run.h"

#include "base/clock.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static void say(const run *r, const char *fmt, ...) __attribute__((format(printf, 2, 3)));
static void say(const run *r, const char *fmt, ...)
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

/* Newton's iterations of a steady case, one line each. */
static void tell_newton(void *ctx, int iteration, double norm, const double *field_norm, double length)
{
    const run *r = ctx;
    const space *s = &r->p->space;
    char line[400];
    int n = snprintf(line, sizeof line, "  newton %2d  residual %.2e ", iteration, norm);

    for (int f = 0; f < s->n_field && n < 300; f++)
        n += snprintf(line + n, sizeof line - (size_t)n, "  %s %.1e", s->field[f].name, field_norm[f]);
    if (iteration > 0 && length < 1)
        snprintf(line + n, sizeof line - (size_t)n, "  step %.3g", length);
    say(r, "%s", line);
}

static void tell_continuation(void *ctx, double s, int iterations, int converged)
{
    const run *r = ctx;

    if (s >= 1 && !converged)
        say(r, "  no convergence from here in %d iterations; going on by continuation", iterations);
    else
        say(r, "  continuation at %.3g: %s in %d iterations", s, converged ? "converged" : "no convergence",
            iterations);
}

static int log_solve(run *r, double t, double dt, const newton_report *report, error *err)
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

/* A warning if what flows in does not flow out. */
static void warn_defect(run *r)
{
    problem *p = r->p;
    const gauge *g = &p->system.gauge;
    double speed = 0;

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
static void warn_singular(run *r, const newton_report *report)
{
    if (report->singular && !r->warned_singular)
        warning_add(&r->p->warnings,
                    "the equations do not determine all unknowns (%s); the residual has converged, some unknowns "
                    "(pressure inside bodies?) are arbitrary",
                    report->why);
    r->warned_singular |= report->singular;
}

/* A warning, once, if Newton's method converges as it does with a wrong matrix. */
static void warn_order(run *r, const newton_report *report)
{
    if (report->linear_only && !r->warned_order)
        warning_add(
            &r->p->warnings,
            "Newton converges with order %.1f only: some Jacobian block is wrong or missing; plugflow jacobian "
            "%s compares them one by one",
            report->order, r->p->description.c->path);
    r->warned_order |= report->linear_only;
}

/* Says and logs the warnings that have come since the last call. */
static int tell_warnings(run *r, error *err)
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
static void take_solution(run *r)
{
    memcpy(r->x, r->p->state.x, (size_t)r->p->space.n_dof * sizeof *r->x);
    gauge_zero_mean(&r->p->system, problem_points(r->p), r->x);
}

static int steady(run *r, const volatile sig_atomic_t *stop, error *err)
{
    problem *p = r->p;
    newton_report report;
    int steps;

    p->system.talk = tell_newton;
    p->system.talk_ctx = r;
    p->system.stop = stop;
    p->continuation.bodies = problem_points(p);
    TRY(continuation_solve(&p->system, &p->continuation, &p->newton, p->state.x, &report, &steps, tell_continuation,
                           r, err));
    r->result->newton_iterations = report.total;
    r->result->last_newton = report.iterations;
    r->result->newton_order = report.order;
    r->result->newton_ratio = report.ratio;
    r->result->steps = 1;
    warn_order(r, &report);
    if (!report.converged && stop && *stop) {
        r->result->status = "interrupted";
        return 0;
    }
    if (!report.converged && report.singular)
        return error_set(err, ERR_CONVERGE, "no steady state found: %s", report.why);
    if (!report.converged)
        return error_set(err, ERR_CONVERGE,
                         "no steady state found: %s; refine the mesh, start from an easier problem (solve { "
                         "continuation = { viscosity = "
                         "... } }), or make the case unsteady with time {}",
                         report.why);
    warn_singular(r, &report);
    say(r, "  converged in %d iterations, observed order %.1f, |r| / |r_before|^2 = %.2g", report.iterations,
        report.order, report.ratio);
    if (p->bodies.n)
        TRY(bodies_fill(&p->bodies, p->bodies.now, p->state.x, err));
    take_solution(r);
    TRY(stepper_steady(r->stepper, err));
    TRY(energy_step(r, err));
    TRY(log_solve(r, 0, 0, &report, err));
    warn_defect(r);
    TRY(output_take(r, 0, err));
    TRY(tables_add(r, 0, err));
    TRY(particles_write(r, 0, err));
    TRY(output_fields(r, 0, err));
    return lines_write(r, 0, err);
}

static int one_step(run *r, double next, error *err)
{
    problem *p = r->p;
    stepper *s = r->stepper;
    const time_spec *time = &p->description.time;
    run_progress progress;
    int64_t before = p->state.newton_iterations;
    int status = stepper_advance(s, next - p->state.t, err);

    warn_order(r, &s->report);
    TRY(status);
    p->state.t = next; /* steps that were halved add up to it but for round-off */
    r->result->steps++;
    r->result->newton_iterations = (int)p->state.newton_iterations;
    r->result->halved = (int)p->state.halved;
    warn_singular(r, &s->report);
    take_solution(r);
    warn_defect(r);
    TRY(energy_step(r, err));
    TRY(tell_warnings(r, err));
    TRY(log_solve(r, p->state.t, p->state.dt_previous, &s->report, err));
    TRY(output_take(r, p->state.t, err));
    TRY(tables_add(r, p->state.t, err));
    TRY(particles_write(r, p->state.t, err));
    progress = (run_progress){.step = r->result->steps,
                              .steps = r->result->steps +
                                       lround(ceil((time->stop - p->state.t) / time->step * (1 - 1e-12))),
                              .t = p->state.t,
                              .dt = p->state.dt_previous,
                              .newton = (int)(p->state.newton_iterations - before),
                              .residual = s->report.history[s->report.iterations]};
    if (r->talk && r->talk->progress)
        r->talk->progress(r->talk->ctx, &progress);
    return 0;
}

/* Part of a step below which none is made: the one before or after is longer or shorter by it. */
#define NEAR 0.01

/* Steps of the given length, with one more wherever fields are due within a step. */
static int march(run *r, const volatile sig_atomic_t *stop, error *err)
{
    problem *p = r->p;
    const time_spec *time = &p->description.time;
    const double every = p->description.output.every, slack = 1e-9 * time->step;
    const long n = lround(ceil((time->stop - time->start) / time->step * (1 - 1e-12)));
    long k = 1, files = 1;

    TRY(output_take(r, time->start, err));
    TRY(output_fields(r, time->start, err));
    while (k <= n) {
        double grid = k == n ? time->stop : time->start + (double)k * time->step;
        double due = time->start + (double)files * every, near = k < n ? NEAR * time->step : 0;
        double next = due < grid + near && fabs(due - grid) > slack ? due : grid;
        int status = one_step(r, next, err);
        error ignored;

        if (status && r->taken > p->state.written) /* the last good state goes to disk */
            output_fields(r, r->taken, &ignored);
        TRY(status);
        k += next >= grid - near;
        if (p->state.t >= due - slack || k > n) {
            while (time->start + (double)files * every <= p->state.t + slack)
                files++;
            TRY(output_fields(r, p->state.t, err));
        }
        if (stop && *stop) {
            r->result->status = "interrupted";
            if (p->state.t > p->state.written)
                TRY(output_fields(r, p->state.t, err));
            break;
        }
    }
    return lines_write(r, p->state.t, err);
}

static int unsteady(run *r, const volatile sig_atomic_t *stop, error *err)
{
    int status = march(r, stop, err);

    r->result->last_newton = r->stepper->report.iterations;
    r->result->newton_order = r->stepper->report.order;
    return status;
}

static int finish(run *r, error *err)
{
    const description *d = &r->p->description;

    if (strcmp(r->result->status, "ok"))
        return 0;
    for (int f = 0; f < d->fields.n; f++) {
        int i = r->result->n_error;

        if (!d->has_exact[f])
            continue;
        snprintf(r->result->error_norm[i].name, sizeof r->result->error_norm[i].name, "%s", d->fields.f[f].name);
        TRY(norms_of_error(r, f, r->p->state.t, &r->result->error_norm[i].l2, &r->result->error_norm[i].h1,
                           &r->result->error_norm[i].l2_exact, err));
        r->result->n_error++;
    }
    return results_evaluate(r, err);
}

static int log_start(run *r, error *err)
{
    char line[300];

    snprintf(line, sizeof line, "\"cells\": %lld, \"unknowns\": %lld, \"particles\": %d, \"threads\": %d",
             (long long)r->p->mesh.n_cell, (long long)r->p->space.n_dof, r->p->bodies.n, r->p->n_thread);
    return output_event(r, "start", line, err);
}

static int log_end(run *r, error *err)
{
    char line[300];

    snprintf(line, sizeof line, "\"status\": \"%s\", \"steps\": %ld, \"seconds\": %.6g", r->result->status,
             r->result->steps, r->result->seconds_total);
    return output_event(r, "end", line, err);
}

static const char *status_of(int code)
{
    return code == 0              ? "ok"
           : code == ERR_CONVERGE ? "not converged"
           : code == ERR_MEMORY   ? "out of memory"
           : code == ERR_IO       ? "input/output error"
           : code > ERR_SIGNAL    ? "interrupted"
                                  : "failed";
}

static int prepare(run *r, error *err)
{
    problem *p = r->p;

    ARENA_NEW(&r->memory, r->x, p->space.n_dof, err);
    TRY(problem_initial(p, err));
    TRY(stepper_create(r->stepper, &p->system, &p->bodies, &p->conditions, &p->state, err));
    r->stepper->options = p->newton;
    r->stepper->order = p->description.time.order;
    r->stepper->geometry_iterations = p->description.time.geometry_iterations;
    memcpy(r->x, p->state.x, (size_t)p->space.n_dof * sizeof *r->x);
    TRY(energy_open(r, err));
    TRY(norms_check(p, err));
    TRY(output_open(r, err));
    TRY(log_start(r, err));
    return tell_warnings(r, err);
}

int run_problem(problem *p, const char *dir, const run_talk *talk, const volatile sig_atomic_t *stop,
                run_result *result, error *err)
{
    stepper stepper = {0};
    run r = {.p = p,
             .stepper = &stepper,
             .dir = dir,
             .talk = talk,
             .result = result,
             .start = clock_seconds(),
             .log_fd = -1};
    error later;
    int status;

    memset(result, 0, sizeof *result);
    result->status = "ok";
    r.forces.fd = r.probes.fd = r.particles.fd = -1;
    status = prepare(&r, err);
    if (!status) {
        status = p->description.time.unsteady ? unsteady(&r, stop, err) : steady(&r, stop, err);
        if (!status)
            status = finish(&r, err);
        if (status)
            result->status = status_of(status);
        if (tell_warnings(&r, status ? &later : err) && !status)
            status = err->code;
        if (output_summary(&r, status ? &later : err) && !status)
            status = err->code;
        if (log_end(&r, status ? &later : err) && !status)
            status = err->code;
        energy_say(&r);
        if (!status)
            say(&r, "  %s", r.results.s ? r.results.s : "");
    }
    energy_close(&r);
    output_close(&r);
    stepper_destroy(&stepper);
    return status;
}
