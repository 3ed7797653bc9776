/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * summary.json: what a run came to. */
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

int output_summary(run *r, error *err)
{
    const problem *p = r->p;
    run_result *q = r->result;
    const linear_stats *l = &p->system.linear.stats;
    struct rusage usage;
    char path[4600], stamp[40];
    time_t now = time(NULL);
    struct tm tm;
    text t = {0};
    int status;

    getrusage(RUSAGE_SELF, &usage);
    gmtime_r(&now, &tm);
    strftime(stamp, sizeof stamp, "%Y-%m-%dT%H:%M:%SZ", &tm);
    q->factorisations = l->factorisations;
    q->gmres_iterations = l->gmres_iterations;
    q->seconds_assemble = p->system.assemble_seconds;
    q->seconds_factor = l->factor_seconds + l->analyze_seconds;
    q->seconds_solve = l->solve_seconds;
    q->seconds_total = solve_seconds() - r->start + p->setup_seconds;
    q->peak_bytes = 1024.0 * (double)usage.ru_maxrss;
    text_add(&t, "{\n  \"status\": \"%s\",\n  \"finished\": \"%s\",\n  \"case\": ", q->status, stamp);
    text_json(&t, p->c->title ? p->c->title : p->c->path);
    number(&t, "cells", (double)p->mesh.n_cell);
    number(&t, "unknowns", (double)p->space.n_dof);
    number(&t, "free_unknowns", (double)p->space.n_free);
    number(&t, "threads", p->n_thread);
    if (p->n_particle)
        number(&t, "particles", p->n_particle);
    number(&t, "steps", (double)q->steps);
    number(&t, "steps_halved", q->halved);
    if (r->p->has_ties)
        number(&t, "cuts_with_rootless_cells", (double)r->p->rootless);
    number(&t, "newton_iterations", q->newton_iterations);
    number(&t, "newton_order", q->newton_order);
    number(&t, "evaluations", (double)p->system.evaluations);
    number(&t, "matrices", (double)p->system.matrices);
    number(&t, "gmres_iterations", q->gmres_iterations);
    number(&t, "factorisations", q->factorisations);
    number(&t, "worst_linear_residual", l->worst_residual);
    text_add(&t, ",\n  \"predicted\": {\"factor_bytes\": ");
    text_number(&t, l->cost.bytes);
    text_add(&t, ", \"factor_flops\": ");
    text_number(&t, l->cost.flops);
    text_add(&t, "},\n  \"seconds\": {\"setup\": ");
    text_number(&t, p->setup_seconds);
    text_add(&t, ", \"geometry\": ");
    text_number(&t, p->geometry_seconds);
    text_add(&t, ", \"assemble\": ");
    text_number(&t, q->seconds_assemble);
    text_add(&t, ", \"factor\": ");
    text_number(&t, q->seconds_factor);
    text_add(&t, ", \"solve\": ");
    text_number(&t, q->seconds_solve);
    text_add(&t, ", \"output\": ");
    text_number(&t, q->seconds_output);
    text_add(&t, ", \"total\": ");
    text_number(&t, q->seconds_total);
    text_add(&t, "}");
    number(&t, "peak_memory_bytes", q->peak_bytes);
    text_add(&t, ",\n  \"errors\": {");
    for (int i = 0; i < q->n_error; i++) {
        text_add(&t, "%s\"%s\": {\"l2\": ", i ? ", " : "", q->error_norm[i].name);
        text_number(&t, q->error_norm[i].l2);
        text_add(&t, ", \"h1\": ");
        text_number(&t, q->error_norm[i].h1);
        text_add(&t, ", \"l2_exact\": ");
        text_number(&t, q->error_norm[i].l2_exact);
        text_add(&t, "}");
    }
    text_add(&t, "},\n  \"results\": {%s}\n}\n", r->results.s ? r->results.s : "");
    snprintf(path, sizeof path, "%s/summary.json", r->dir);
    status = t.failed ? error_memory(err, path, 0) : file_write(path, t.s, t.n, err);
    text_free(&t);
    return status;
}
