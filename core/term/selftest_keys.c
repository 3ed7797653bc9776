/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What a term's line in a case may say: every key must change something, and every property that the term takes
 * must come from somewhere. */
#include "term/selftest_parts.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TRIES = 6 };

static int outputs(bench *k, double *const *to)
{
    int sound;

    for (uint32_t o = 0; o < k->t->n_out; o++)
        memset(to[o], 0, (size_t)bench_components(k, &k->t->out[o]) * BENCH_LD * sizeof(double));
    return bench_status(k, to, "residual with other parameters", &sound);
}

/* 1 if the outputs are not the same, or one of the two has none. */
static int differs(bench *k, int status)
{
    if (outputs(k, k->again) != status)
        return 1;
    for (uint32_t o = 0; o < k->t->n_out; o++)
        if (memcmp(k->out[o], k->again[o],
                   (size_t)bench_components(k, &k->t->out[o]) * BENCH_LD * sizeof(double)) != 0)
            return 1;
    return 0;
}

/* The value of a property that nobody publishes: the slot shows it. */
static int is_number_of_property(const pf_term *t, const pf_param *p)
{
    return term_takes(t, p->name);
}

static int changes_something(bench *k, const pf_param *p)
{
    int status = outputs(k, k->out), live = 0;
    char why[200];

    for (int n = 0; n < TRIES && !live; n++) {
        bench_put_other(k, p, n);
        live = (!k->t->check || k->t->check(k->params, why, sizeof why) == 0) && differs(k, status);
        memcpy(k->params, k->other_params, k->t->params_bytes);
    }
    return live;
}

/* Beside the parameters of the bench. */
static void look(bench *k)
{
    memcpy(k->other_params, k->params, k->t->params_bytes);
    for (uint32_t i = 0; i < k->t->n_param && i < 32; i++)
        if (!(k->live >> i & 1) &&
            (is_number_of_property(k->t, &k->t->param[i]) || changes_something(k, &k->t->param[i])))
            k->live |= 1u << i;
}

/* A zero may switch on what other keys are for: of those that are zero unless the case says otherwise. */
static void look_beside_zeros(bench *k)
{
    const pf_term *t = k->t;
    const double zero[3] = {0};
    char *drawn = malloc(t->params_bytes + 1), why[200];

    if (!drawn)
        return;
    memcpy(drawn, k->params, t->params_bytes);
    for (uint32_t i = 0; i < t->n_param; i++)
        if (t->param[i].type == PF_T_REAL && t->param[i].dflt == 0 && !(t->param[i].flags & PF_REQUIRED))
            bench_put_param(k, &t->param[i], zero);
    if (!t->check || t->check(k->params, why, sizeof why) == 0)
        look(k);
    memcpy(k->params, drawn, t->params_bytes);
    free(drawn);
}

void selftest_keys(bench *k)
{
    for (int state = 0; state < 3; state++) {
        bench_random_inputs(k);
        if (state)
            bench_put_state(k, state - 1);
        look(k);
    }
    bench_random_inputs(k);
    look_beside_zeros(k);
}

/* The last term of the plugin that has the key, if it changes nothing in any of them: the line of a plugin gives
 * its keys to all its terms.  One that init, check or reach may use: *elsewhere. */
static int is_dead(const term_plugin *p, const uint32_t *live, uint32_t of, const pf_param *key, int *elsewhere)
{
    *elsewhere = 0;
    for (uint32_t k = 0; k < p->d.n_term; k++)
        for (uint32_t i = 0; i < p->term[k].n_param; i++) {
            const pf_term *t = &p->term[k];

            if (strcmp(t->param[i].name, key->name) != 0)
                continue;
            if (k > of || i >= 32 || live[k] >> i & 1)
                return 0;
            *elsewhere |= t->init || t->check || t->reach;
        }
    return 1;
}

void selftest_dead_keys(selftest *s, const term_plugin *p, const uint32_t *live)
{
    for (uint32_t k = 0; k < p->d.n_term; k++)
        for (uint32_t i = 0; i < p->term[k].n_param; i++) {
            const pf_param *key = &p->term[k].param[i];
            char text[600];
            int elsewhere;

            if (!is_dead(p, live, k, key, &elsewhere))
                continue;
            snprintf(text, sizeof text, "%.100s  no output and no derivative depends on key %.100s%s",
                     p->term[k].name, key->name,
                     elsewhere
                         ? ": it is for init, check or reach alone"
                         : "; is its name hidden by another, as by EACH (a) a key a? Use it, or leave it out");
            *(elsewhere ? &s->passed : &s->failed) += 1;
            s->line(s->ctx, elsewhere, text);
        }
}

static int has_value(const bench *k, const pf_slot *s)
{
    const term_use use = {.plugin = k->p, .term = k->t, .params = k->params};

    if (term_number(&use, s))
        return 1;
    for (uint32_t i = 0; i < k->p->d.n_term; i++)
        if (term_publishes(&k->p->term[i], s->field) >= 0)
            return 1;
    return 0;
}

void selftest_takes(bench *k)
{
    for (uint32_t i = 0; i < k->t->n_in; i++)
        if (k->t->in[i].eval == PF_PROPERTY && !has_value(k, &k->t->in[i]))
            bench_line(k, 0,
                       "%s  takes %s, which no term publishes and its PARAMS have no key for (of that name, in "
                       "term.h DENSITY, VISCOSITY, REAL(%s, ...))",
                       k->t->name, k->t->in[i].field, k->t->in[i].field);
}
