/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * summary.json: what a run came to. */
#include "base/clock.h"
#include "run/run.h"

#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>

static void number(text *t, const char *name, double v)
{
    text_add(t, ",\n  \"%s\": ", name);
    text_number(t, v);
}

static void take_figures(const run *r, run_result *q)
{
    const linear_stats *l = &r->p->system.linear.stats;
    struct rusage usage;

    getrusage(RUSAGE_SELF, &usage);
    q->factorisations = l->factorisations;
    q->gmres_iterations = l->gmres_iterations;
    q->seconds_assemble = r->p->system.assemble_seconds;
    q->seconds_factor = l->factor_seconds + l->analyze_seconds;
    q->seconds_solve = l->solve_seconds;
    q->seconds_total = clock_seconds() - r->start + r->p->setup_seconds;
    q->peak_bytes = 1024.0 * (double)usage.ru_maxrss;
}

/* How often steps were repeated, and why. */
static void add_steps(const problem *p, const run_result *q, text *t)
{
    const step_counts *n = &p->state.count;
    const time_spec *time = &p->description.time;

    number(t, "steps_halved", (double)n->halved);
    if (p->bodies.n)
        number(t, "steps_shortened", (double)n->shortened);
    if (time->tolerance > 0)
        text_add(t,
                 ",\n  \"adaptive\": {\"accepted\": %lld, \"repeated\": {\"error\": %lld, \"newton\": %lld, "
                 "\"geometry\": %lld}, \"rough\": %lld, \"jumps\": %lld}",
                 (long long)n->steps, (long long)n->repeated, (long long)n->halved, (long long)n->shortened,
                 (long long)n->rough, (long long)n->restarted);
    if (time->steady > 0) {
        text_add(t, ",\n  \"steady\": %s", q->steady ? "true" : "false");
        number(t, "steady_change", q->change);
        number(t, "stopped_at", p->state.t);
    }
}

static void add_counts(const problem *p, const run_result *q, text *t)
{
    const linear_stats *l = &p->system.linear.stats;

    number(t, "cells", (double)p->mesh.n_cell);
    number(t, "unknowns", (double)p->space.n_dof);
    number(t, "free_unknowns", (double)p->space.n_free);
    number(t, "threads", p->n_thread);
    if (p->bodies.n)
        number(t, "particles", p->bodies.n);
    number(t, "steps", (double)q->steps);
    add_steps(p, q, t);
    if (p->bodies.has_ties)
        number(t, "cuts_with_rootless_cells", (double)p->bodies.rootless);
    number(t, "newton_iterations", q->newton_iterations);
    number(t, "newton_order", q->newton_order);
    number(t, "evaluations", (double)p->system.evaluations);
    number(t, "matrices", (double)p->system.matrices);
    number(t, "gmres_iterations", q->gmres_iterations);
    number(t, "factorisations", q->factorisations);
    number(t, "band_factorisations", l->band_factorisations);
    if (p->bodies.n)
        number(t, "patterns", (double)p->bodies.patterns);
    number(t, "worst_linear_residual", l->worst_residual);
    if (linear_solver(&p->system.linear)) {
        text_add(t, ",\n  \"linear_solver\": ");
        text_json(t, linear_solver(&p->system.linear)->name);
    }
    text_add(t, ",\n  \"predicted\": {\"factor_bytes\": ");
    text_number(t, l->cost.bytes);
    text_add(t, ", \"factor_flops\": ");
    text_number(t, l->cost.flops);
    text_add(t, "}");
}

static void add_seconds(const problem *p, const run_result *q, text *t)
{
    struct {
        const char *name;
        double seconds;
    } part[] = {{"setup", p->setup_seconds},
                {"geometry", p->bodies.seconds},
                {"assemble", q->seconds_assemble},
                {"factor", q->seconds_factor},
                {"solve", q->seconds_solve},
                {"output", q->seconds_output},
                {"other", 0},
                {"total", q->seconds_total}};
    enum { OTHER = sizeof part / sizeof *part - 2 };

    part[OTHER].seconds = q->seconds_total;
    for (int i = 0; i < OTHER; i++)
        part[OTHER].seconds -= part[i].seconds;
    text_add(t, ",\n  \"seconds\": {");
    for (size_t i = 0; i < sizeof part / sizeof *part; i++) {
        text_add(t, "%s\"%s\": ", i ? ", " : "", part[i].name);
        text_number(t, part[i].seconds);
    }
    text_add(t, "}");
    number(t, "peak_memory_bytes", q->peak_bytes);
}

static void add_warnings(const warning_list *w, text *t)
{
    text_add(t, ",\n  \"warnings\": [");
    for (int i = 0; i < w->n; i++) {
        text_add(t, "%s", i ? ", " : "");
        text_json(t, w->text[i]);
    }
    text_add(t, "]");
}

static void add_errors(const run_result *q, text *t)
{
    text_add(t, ",\n  \"errors\": {");
    for (int i = 0; i < q->n_error; i++) {
        text_add(t, "%s\"%s\": {\"l2\": ", i ? ", " : "", q->error_norm[i].name);
        text_number(t, q->error_norm[i].l2);
        text_add(t, ", \"h1\": ");
        text_number(t, q->error_norm[i].h1);
        text_add(t, ", \"l2_exact\": ");
        text_number(t, q->error_norm[i].l2_exact);
        text_add(t, "}");
    }
    text_add(t, "}");
}

int output_summary(run *r, error *err)
{
    const case_file *c = r->p->description.c;
    char path[4600], stamp[40];
    time_t now = time(NULL);
    struct tm tm;
    text t = {0};
    int status;

    take_figures(r, r->result);
    gmtime_r(&now, &tm);
    strftime(stamp, sizeof stamp, "%Y-%m-%dT%H:%M:%SZ", &tm);
    text_add(&t, "{\n  \"status\": \"%s\",\n  \"finished\": \"%s\",\n  \"case\": ", r->result->status, stamp);
    text_json(&t, c->title ? c->title : c->path);
    add_counts(r->p, r->result, &t);
    add_seconds(r->p, r->result, &t);
    add_warnings(&r->p->warnings, &t);
    add_errors(r->result, &t);
    energy_summary(r, &t);
    text_add(&t, ",\n  \"results\": {%s}\n}\n", r->results.s ? r->results.s : "");
    snprintf(path, sizeof path, "%s/summary.json", r->dir);
    status = t.failed ? error_memory(err, path, 0) : file_write(path, t.s, t.n, err);
    text_free(&t);
    return status;
}
