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

static int start(bench *k, int n_body, int unsteady, char *why, size_t n, int *sound)
{
    const pf_setup setup = {.size = sizeof setup,
                            .dim = (uint32_t)k->dim,
                            .n_body = (uint32_t)n_body,
                            .unsteady = (uint32_t)unsteady,
                            .host = &term_host};
    int status;

    *why = 0;
    bench_enter(k, "init");
    status = k->t->init(k->params, &setup, why, n);
    guard_keep(&k->guard); /* the parameters are init's to write */
    *sound = bench_left(k, "init");
    k->initialised = *sound && status == 0;
    return status;
}

int bench_init(bench *k)
{
    static const int bodies[] = {2, 1, 0, 3, 4, 5, 6, 7, 8};
    enum { N = sizeof bodies / sizeof *bodies };
    char first[400], why[400];
    int sound, status;

    if (!k->t->init)
        return 1;
    status = start(k, 2, 1, first, sizeof first, &sound);
    if (!status || !sound || k->draw) /* drawn parameters may be refused, as by its check */
        return k->initialised;
    for (int i = 1; i < 2 * N; i++) {
        const int n = bodies[i % N], unsteady = i < N;

        if (start(k, n, unsteady, why, sizeof why, &sound) == 0 && sound)
            bench_line(k, 1, "%s  init refuses 2 bodies, unsteady (%s); tested with %d, %s", k->t->name,
                       *first ? first : "without saying why", n, unsteady ? "unsteady" : "steady");
        if (k->initialised || !sound)
            return k->initialised;
    }
    bench_line(k, 0,
               "%s  init returned %d: %s -- to each of 0 to 8 bodies, unsteady and steady, in %dD with parameters "
               "at their defaults; in the conditions of a case: plugflow test --case CASE",
               k->t->name, status, *first ? first : "without saying why", k->dim);
    return 0;
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
