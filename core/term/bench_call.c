/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Calls of a term's functions: announced, so that a call that does not come back is told by name; afterwards all
 * that it must not touch is looked at. */
#include "term/bench.h"

#include "base/process.h"

#include <stdio.h>

void bench_enter(bench *k, const char *what)
{
    k->report.status = 0;
    guard_keep(&k->guard);
    if (k->s->enter)
        k->s->enter(k->s->ctx, k->p->d.name, k->t->name, what);
    process_enter(k->p->d.name, k->t->name, what, -1);
}

int bench_left(bench *k, const char *what)
{
    char why[500];
    int sound = 1;

    process_leave();
    if (k->s->enter)
        k->s->enter(k->s->ctx, k->p->d.name, k->t->name, NULL);
    if (surroundings_changed(&k->surroundings, why, sizeof why)) {
        bench_line(k, 0, "%s  %s in %dD %s", k->t->name, what, k->dim, why);
        sound = 0;
    }
    if (guard_broken(&k->guard, why, sizeof why)) {
        bench_line(k, 0, "%s  %s in %dD %s", k->t->name, what, k->dim, why);
        sound = 0;
    }
    return sound;
}

int bench_status(bench *k, double *const *out, const char *what, int *sound)
{
    int status;

    bench_enter(k, what);
    status = k->t->residual(&k->b, (const double *const *)k->in, out);
    *sound = bench_left(k, what);
    return status;
}

int bench_call(bench *k, double *const *out, const char *what)
{
    int sound, status = bench_status(k, out, what, &sound);

    if (sound && status)
        bench_line(k, 0, "%s  %s returned %d: %s%s", k->t->name, what, status,
                   k->report.status ? k->report.text : "without saying why (host->fail gives the reason)",
                   status != PF_RETRY ? ""
                   : bench_has_range(k)
                       ? " (on values in the ranges of its slots)"
                       : "; if it makes sense for some values only, say which: min and max of a slot");
    return sound && status == 0;
}

int bench_init(bench *k)
{
    const pf_setup setup = {
        .size = sizeof setup, .dim = (uint32_t)k->dim, .n_body = 2, .unsteady = 1, .host = &term_host};
    char why[400] = "", *text = why;
    int status;

    if (!k->t->init)
        return 1;
    bench_enter(k, "init");
    status = k->t->init(k->params, &setup, why, sizeof why);
    guard_keep(&k->guard); /* the parameters are init's to write */
    if (!bench_left(k, "init"))
        return 0;
    if (status)
        bench_line(k, 0, "%s  init returned %d: %s", k->t->name, status, *text ? text : "without saying why");
    k->initialised = status == 0;
    return k->initialised;
}

void bench_done(bench *k)
{
    if (!k->initialised || !k->t->done)
        return;
    k->initialised = 0;
    bench_enter(k, "done");
    k->t->done(k->params);
    guard_keep(&k->guard);
    bench_left(k, "done");
}
