/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Instances of terms (interface 1.4): conduction that stands on several lines, each with a part of the domain and
 * a table of its own; terms that take its place; and what goes wrong at the start of a run. */
#include <plugflow/plugin.h>

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>

struct conduct {
    double conductivity;
    double *table; /* made by init: the conductivity */
};

static int begin(void *params, const pf_setup *s, char *err, size_t nerr)
{
    struct conduct *c = params;

    if (s->size < sizeof *s || (s->dim != 2 && s->dim != 3) || s->n_body < 0 || !s->host) {
        snprintf(err, nerr, "what a run is was not said");
        return 1;
    }
    if (c->conductivity == 13) {
        snprintf(err, nerr, "no table for a conductivity of 13 (%s)", s->unsteady ? "unsteady" : "steady");
        return 1;
    }
    if (c->conductivity == 14)
        raise(SIGSEGV);
    c->table = malloc(sizeof *c->table);
    if (c->table)
        *c->table = c->conductivity;
    return c->table == NULL;
}

static void end(void *params)
{
    struct conduct *c = params;

    free(c->table);
    c->table = NULL;
    if (getenv("PARTS_END"))
        printf("end of %g\n", c->conductivity);
}

static int conduct(const pf_batch *b, const double *const *in, double *const *out)
{
    const struct conduct *c = b->params;

    for (uint32_t i = 0; i < b->dim * b->ld; i++)
        out[0][i] = *c->table * in[0][i];
    return PF_OK;
}

static int twice(const pf_batch *b, const double *const *in, double *const *out)
{
    for (uint32_t i = 0; i < b->dim * b->ld; i++)
        out[0][i] = 2 * in[0][i];
    return PF_OK;
}

#define SLOTS                                                                                                      \
    .where = PF_CELL, .doc = "k\\nabla T\\cdot\\nabla s", .cite = "Fourier",                                       \
    PF_IN({"grad_T", "T", PF_GRAD, PF_VECTOR}), PF_OUT({"grad_s", "T", PF_GRAD, PF_VECTOR})

static const pf_term plain = {
    PF_TERM_SIZES,
    .name = "conduct",
    .residual = conduct,
    SLOTS,
    PF_PARAMS(struct conduct,
              PF_NUMBER(struct conduct, conductivity, "W/(m K)", "conductivity", .dflt = 1, PF_NOT_NEGATIVE)),
    .init = begin,
    .done = end,
};
static const pf_term other = {
    PF_TERM_SIZES,     .name = "twice", .flags = PF_OPTIONAL,
    .residual = twice, SLOTS,           .replaces = "parts.conduct no.such",
};
static const pf_term another = {
    PF_TERM_SIZES, .name = "too", .flags = PF_OPTIONAL, .residual = twice, SLOTS, .replaces = "parts.conduct",
};
static const pf_term missing = {
    PF_TERM_SIZES, .name = "lost", .flags = PF_OPTIONAL, .residual = twice, SLOTS, .replaces = "parts.conductor",
};

static const pf_plugin plugin = {
    PF_PLUGIN,
    .min_minor = 4,
    .name = "parts",
    .version = "1.0",
    .author = "plugflow",
    .license = "GPL-3.0-or-later",
    .doc = "conduction in parts",
    PF_FIELDS({.name = "T", .unit = "K", .doc = "temperature", .shape = PF_SCALAR, .order = 2}),
    PF_TERMS(&plain, &other, &another, &missing),
};
PF_ENTRY(plugin)
