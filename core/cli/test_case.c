/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * plugflow test --case CASE: the terms of a case with its parameters, at points of the real problem: batches are
 * taken as the assembly is about to compute them, at the initial state and at a random one near it. */
#include "base/random.h"
#include "cli/test.h"
#include "run/showing.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_BATCHES = 24 };

/* What has been tested of each term that is on. */
typedef struct seen_term {
    const term_use *use;
    int64_t seen;
    int tested, wrong;
} seen_term;

typedef struct case_test {
    selftest *s;
    const char *only_plugin, *only_term;
    int n;
    seen_term term[256];
    error *err;
    int status;
} case_test;

static seen_term *find(case_test *c, const term_use *use)
{
    for (int i = 0; i < c->n; i++)
        if (c->term[i].use == use)
            return &c->term[i];
    if (c->n == (int)(sizeof c->term / sizeof *c->term))
        return NULL;
    c->term[c->n] = (seen_term){.use = use};
    return &c->term[c->n++];
}

/* The first batches, and some of the later ones. */
static int is_wanted(const seen_term *t)
{
    return t->tested < MOST_BATCHES && !t->wrong && (t->seen < 4 || (t->seen & (t->seen - 1)) == 0);
}

static void look(void *ctx, const term_use *use, const pf_batch *b, const double *const *in)
{
    case_test *c = ctx;
    seen_term *t = find(c, use);
    const int before = c->s->failed;
    int some = 0;

    if (!t || c->status || (c->only_plugin && strcmp(c->only_plugin, use->plugin->d.name) != 0) ||
        (c->only_term && strcmp(c->only_term, use->term->name) != 0))
        return;
    if (is_wanted(t)) {
        c->status = selftest_batch(c->s, use, b, in, &some, c->err);
        t->tested += some;
        t->wrong = c->s->failed > before;
    }
    t->seen++;
}

static void report(case_test *c)
{
    for (int i = 0; i < c->n; i++) {
        const seen_term *t = &c->term[i];
        char line[300];

        if (t->wrong || !t->seen)
            continue;
        snprintf(line, sizeof line, "%s.%s  %d of %lld batches of the case%s", t->use->plugin->d.name,
                 t->use->term->name, t->tested, (long long)t->seen,
                 t->tested ? "" : ": it could be computed on none of those tried (PF_RETRY)");
        *(t->tested ? &c->s->passed : &c->s->failed) += 1;
        c->s->line(c->s->ctx, t->tested > 0, line);
    }
}

/* All terms at a state: equations with the properties that they take, what is kept, what is shown.  A term may
 * refuse the state; what came before it has been seen. */
static int evaluate_at(run *r, assembly_state *st, double *kept, error *err)
{
    newton_system *sys = &r->p->system;

    TRY(assembly_run(&sys->assembly, st, sys->residual, NULL, 0, err));
    if (r->p->space.kept.n)
        TRY(assembly_keep(&sys->assembly, st, kept, err));
    return showing_look(r, st, err);
}

/* At the initial state, and at a random one. */
static int evaluate(run *r, case_test *c, error *err)
{
    problem *p = r->p;
    const space *s = &p->space;
    newton_system *sys = &p->system;
    const uint8_t *idle = p->bodies.now ? p->bodies.now->idle : sys->assembly.none_idle;
    const assembly_watch watch = {look, c};
    const double shift = p->description.time.unsteady ? 1.5 / p->description.time.step : 0;
    unsigned long long random = RANDOM_SEED;
    double *x, *kept;

    ARENA_NEW(&p->memory, x, s->n_dof, err);
    ARENA_NEW(&p->memory, kept, s->kept.n_value + 1, err);
    memcpy(x, p->state.x, (size_t)s->n_dof * sizeof *x);
    for (int round = 0; round < 2; round++) {
        assembly_state st = {.t = p->description.time.start,
                             .dt = p->description.time.step,
                             .shift = shift,
                             .x = x,
                             .dot = sys->step,
                             .old = x,
                             .kept = p->state.kept,
                             .fluid = (const double(*)[6])p->state.fluid,
                             .bodies = problem_points(p),
                             .watch = &watch};
        error ignored = {0};

        for (int64_t i = 0; i < s->n_dof; i++) {
            x[i] += round == 0 || idle[i] || s->fixed[i] & SPACE_AWAY ? 0 : 2 * random_next(&random) - 1;
            sys->step[i] = shift * x[i];
        }
        if (evaluate_at(r, &st, kept, &ignored) && !ignored.retry && round == 0) {
            *err = ignored;
            return err->code;
        }
        TRY(c->status);
    }
    return 0;
}

int cli_test_case(const cli *o, selftest *s, error *err)
{
    cli of_case = *o;
    cli_case *k = malloc(sizeof *k);
    run *r = calloc(1, sizeof *r);
    case_test *c = calloc(1, sizeof *c);
    char plugin[128] = "", *dot;
    int status;

    if (!k || !r || !c) {
        free(k);
        free(r);
        free(c);
        return error_memory(err, "case", sizeof *k);
    }
    of_case.operand[0] = o->case_path;
    of_case.n_thread = 1;
    *c = (case_test){.s = s, .err = err};
    if (o->n_operand > 0) {
        snprintf(plugin, sizeof plugin, "%s", o->operand[0]);
        c->only_plugin = plugin;
        if ((dot = strchr(plugin, '.')))
            *dot = 0, c->only_term = dot + 1;
    }
    status = cli_open(&of_case, k, err);
    if (!status)
        status = problem_initial(&k->p, err);
    r->p = &k->p;
    if (!status)
        status = showing_open(r, err);
    if (!status)
        status = evaluate(r, c, err);
    if (!status)
        report(c);
    if (!status && s->passed + s->failed == 0)
        status = error_set(err, ERR_USAGE, "no term of %s is on in %s", o->n_operand ? o->operand[0] : "any plugin",
                           o->case_path);
    showing_close(r);
    arena_free(&r->memory);
    cli_close(k);
    free(k);
    free(r);
    free(c);
    return status;
}
