/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The course of a run: start, steps (or one steady solution), files, summary. */
#include "run/run.h"

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
    if (r->p->n_particle) {
        double balance;

        if (particles_balance(r, &balance, err)) {
            text_free(&s);
            return err->code;
        }
        text_add(&s, ", \"particles\": %d, \"kinetic_energy\": ", r->p->n_particle);
        text_number(&s, particles_energy(r));
        text_add(&s, ", \"momentum_defect\": ");
        text_number(&s, balance);
    }
    status = s.failed ? error_memory(err, "log", 0) : output_event(r, "solve", s.s, err);
    text_free(&s);
    return status;
}

/* Says so if what flows in does not flow out. */
static void warn_defect(run *r)
{
    const problem *p = r->p;
    const gauge *g = &p->system.gauge;
    double speed = 0;

    for (int64_t d = 0; d < p->space.n_dof; d++)
        if (p->space.field[p->space.dof_field[d]].shape == PF_VECTOR)
            speed = fmax(speed, fabs(p->x[d]));
    for (int f = 0; f < p->space.n_field; f++)
        if (g->free[f] && !r->warned && fabs(g->defect[f]) > 1e-3 * speed * pow(g->volume, 1 - 1.0 / p->dim)) {
            r->warned = 1;
            say(r,
                "  warning: %s is free up to a constant and its equations do not add up: by %.3g (the net flow "
                "through the "
                "boundary, if %s is a pressure); the excess is spread over the domain. Is an outflow (natural = "
                "true) missing?",
                p->space.field[f].name, -g->defect[f], p->space.field[f].name);
        }
}

/* Says so, once, if the equations leave unknowns open. */
static void warn_singular(run *r, const newton_report *report)
{
    if (report->singular && !r->warned_singular)
        say(r,
            "  warning: the equations do not determine all unknowns (%s); the residual has converged, some "
            "unknowns (pressure inside bodies?) are arbitrary",
            report->why);
    r->warned_singular |= report->singular;
}

/* Says so, once, if Newton's method converges as it does with a wrong matrix. */
static void warn_order(run *r, const newton_report *report)
{
    if (report->linear_only && !r->warned_order)
        say(r,
            "  warning: Newton converges with order %.1f only: some Jacobian block is wrong or missing; plugflow "
            "jacobian %s compares them one by one",
            report->order, r->p->c->path);
    r->warned_order |= report->linear_only;
}

static int steady(run *r, error *err)
{
    problem *p = r->p;
    newton_report report;
    int steps;

    p->system.talk = tell_newton;
    p->system.talk_ctx = r;
    TRY(continuation_solve(&p->system, &p->continuation, &p->newton, p->x, &report, &steps, tell_continuation, r,
                           err));
    r->result->newton_iterations = report.total;
    r->result->last_newton = report.iterations;
    r->result->newton_order = report.order;
    r->result->newton_ratio = report.ratio;
    r->result->steps = 1;
    TRY(log_solve(r, 0, 0, &report, err));
    warn_order(r, &report);
    if (!report.converged && p->system.stop && *p->system.stop) {
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
    problem_fill(p, p->x);
    gauge_zero_mean(&p->system, p->x);
    warn_defect(r);
    TRY(newton_residual(&p->system, &(newton_time){0}, p->x, r->residual, err));
    r->last = (newton_time){0};
    TRY(output_series(r, 0, err));
    TRY(particles_write(r, 0, err));
    TRY(output_fields(r, 0, err));
    return output_lines(r, 0, err);
}

static int one_step(run *r, stepper *s, double next, error *err)
{
    problem *p = r->p;
    run_progress progress;
    int before = s->newton_iterations, status;

    status = stepper_advance(s, next - s->t, err);
    warn_order(r, &s->report);
    TRY(status);
    r->result->steps++;
    r->result->newton_iterations = s->newton_iterations;
    r->result->halved = s->n_halved;
    warn_singular(r, &s->report);
    memcpy(p->x, s->x, (size_t)p->space.n_dof * sizeof *p->x);
    gauge_zero_mean(&p->system, p->x);
    memcpy(r->residual, s->residual, (size_t)p->space.n_dof * sizeof *r->residual);
    r->last = s->last;
    TRY(log_solve(r, s->t, s->dt_previous, &s->report, err));
    TRY(output_series(r, s->t, err));
    TRY(particles_write(r, s->t, err));
    progress = (run_progress){.step = r->result->steps,
                              .steps = lround(ceil((p->time.stop - p->time.start) / p->time.step * (1 - 1e-12))),
                              .t = s->t,
                              .dt = s->dt_previous,
                              .newton = s->newton_iterations - before,
                              .residual = s->report.history[s->report.iterations]};
    if (r->talk && r->talk->progress)
        r->talk->progress(r->talk->ctx, &progress);
    return 0;
}

static int march(run *r, stepper *s, const volatile sig_atomic_t *stop, error *err)
{
    problem *p = r->p;
    const problem_time *time = &p->time;
    long n = lround(ceil((time->stop - time->start) / time->step * (1 - 1e-12)));
    double written = time->start, shown = 1e-9 * time->step;

    TRY(output_fields(r, time->start, err));
    for (long k = 1; k <= n; k++) {
        double next = k == n ? time->stop : time->start + (double)k * time->step;

        {
            int status = one_step(r, s, next, err);
            error ignored;

            if (status && stop && *stop) { /* the signal came within the step */
                r->result->status = "interrupted";
                return output_fields(r, s->t, err);
            }
            if (status && s->t > written) /* the last good state goes to disk */
                output_fields(r, s->t, &ignored);
            TRY(status);
        }
        warn_defect(r);
        if (s->t >= written + p->output.every - shown || k == n) {
            written = p->output.every * floor((s->t - time->start + shown) / p->output.every) + time->start;
            TRY(output_fields(r, s->t, err));
        }
        if (stop && *stop) {
            r->result->status = "interrupted";
            break;
        }
    }
    return output_lines(r, s->t, err);
}

static int unsteady(run *r, const volatile sig_atomic_t *stop, error *err)
{
    problem *p = r->p;
    stepper s;
    int status = stepper_create(&s, &p->system, p->time.order, problem_dirichlet, p, err);

    if (!status) {
        s.options = p->newton;
        s.t = p->time.start;
        s.geometry_iterations = p->time.geometry_iterations;
        s.move = p->n_particle ? problem_move : NULL;
        s.frame = p->any_fluid_only ? problem_frame : NULL;
        memcpy(s.x, p->x, (size_t)p->space.n_dof * sizeof *s.x);
        status = march(r, &s, stop, err);
        r->result->last_newton = s.report.iterations;
        r->result->newton_order = s.report.order;
    }
    stepper_destroy(&s);
    return status;
}

static int finish(run *r, error *err)
{
    problem *p = r->p;
    double t = p->time.unsteady ? p->time.stop : 0;

    for (int f = 0; f < p->space.n_field; f++) {
        int i = r->result->n_error;

        if (!p->has_exact[f] || strcmp(r->result->status, "ok"))
            continue;
        snprintf(r->result->error_norm[i].name, sizeof r->result->error_norm[i].name, "%s", p->space.field[f].name);
        TRY(norms_of_error(p, f, t, &r->result->error_norm[i].l2, &r->result->error_norm[i].h1,
                           &r->result->error_norm[i].l2_exact, err));
        r->result->n_error++;
    }
    return strcmp(r->result->status, "ok") == 0 ? results_evaluate(r, err) : 0;
}

static int log_start(run *r, error *err)
{
    char line[300];

    snprintf(line, sizeof line, "\"cells\": %lld, \"unknowns\": %lld, \"particles\": %d, \"threads\": %d",
             (long long)r->p->mesh.n_cell, (long long)r->p->space.n_dof, r->p->n_particle, r->p->n_thread);
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
                                  : "failed";
}

int run_problem(problem *p, const char *dir, const run_talk *talk, const volatile sig_atomic_t *stop,
                run_result *result, error *err)
{
    run r = {.p = p, .dir = dir, .talk = talk, .result = result, .start = solve_seconds(), .log_fd = -1};
    error later;
    int status;

    memset(result, 0, sizeof *result);
    result->status = "ok";
    r.forces.fd = r.probes.fd = r.particles.fd = -1;
    p->system.stop = stop;
    ARENA_NEW(&p->memory, r.residual, p->space.n_dof, err);
    status = problem_initial(p, err);
    if (!status)
        status = problem_cut(p, p->x, err);
    if (!status)
        status = output_open(&r, err);
    if (!status)
        status = log_start(&r, err);
    if (!status) {
        status = p->time.unsteady ? unsteady(&r, stop, err) : steady(&r, err);
        if (!status)
            status = finish(&r, err);
        if (status)
            result->status = status_of(status);
        if (output_summary(&r, status ? &later : err) && !status)
            status = err->code;
        if (log_end(&r, status ? &later : err) && !status)
            status = err->code;
        if (!status)
            say(&r, "  %s", r.results.s ? r.results.s : "");
    }
    output_close(&r);
    return status;
}
