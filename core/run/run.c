/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The course of a run: start, steps (or one steady solution), files, summary. */
#include "run/run.h"
#include "run/showing.h"

#include "base/clock.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Part of the time itself below which a step is too short to be told from none. */
#define LEAST 1e-14

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
    if (p->description.time.tolerance > 0)
        stepper_adapt(r->stepper, p->description.time.tolerance, p->description.time.step,
                      LEAST * (fabs(p->description.time.stop) + fabs(p->description.time.start)));
    memcpy(r->x, p->state.x, (size_t)p->space.n_dof * sizeof *r->x);
    TRY(energy_open(r, err));
    TRY(norms_check(p, err));
    TRY(showing_open(r, err));
    TRY(output_open(r, err));
    TRY(log_start(r, err));
    return run_tell_warnings(r, err);
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
    r.forces.fd = r.probes.fd = r.particles.fd = r.values.fd = r.integrals.fd = -1;
    status = prepare(&r, err);
    if (!status) {
        status = p->description.time.unsteady ? unsteady(&r, stop, err) : run_steady(&r, stop, err);
        if (!status)
            status = finish(&r, err);
        if (status)
            result->status = status_of(status);
        if (run_tell_warnings(&r, status ? &later : err) && !status)
            status = err->code;
        if (output_summary(&r, status ? &later : err) && !status)
            status = err->code;
        if (log_end(&r, status ? &later : err) && !status)
            status = err->code;
        energy_say(&r);
        if (!status)
            run_say(&r, "  %s", r.results.s ? r.results.s : "");
    }
    energy_close(&r);
    showing_close(&r);
    output_close(&r);
    stepper_destroy(&stepper);
    return status;
}
