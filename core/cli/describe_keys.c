/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The keys of a plugin, each once, and what the parts of a description are called. */
#include "cli/describe.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

static const char *or_empty(const char *s)
{
    return s ? s : "";
}

static int same(const described_key *a, const described_key *b)
{
    return a->place == b->place && strcmp(a->name, b->name) == 0 && strcmp(a->unit, b->unit) == 0 &&
           strcmp(a->doc, b->doc) == 0 && strcmp(or_empty(a->standard.s), or_empty(b->standard.s)) == 0 &&
           strcmp(or_empty(a->range.s), or_empty(b->range.s)) == 0;
}

static void drop(described_key *k)
{
    text_free(&k->standard);
    text_free(&k->range);
    text_free(&k->terms);
}

/* Adds k, or the term to the one that is the same; takes over what k holds. */
static void add(described_keys *l, described_key *k, const char *term)
{
    int i = 0;

    while (i < l->n && !same(&l->key[i], k))
        i++;
    if (i == l->n)
        l->key[l->n++] = *k;
    else
        drop(k);
    text_add(&l->key[i].terms, "%s%s", l->key[i].terms.n ? ", " : "", term);
}

/* 1e30 and beyond stands for no bound, and less than 1e-20 for more than 0. */
static void put_range(text *t, double low, double high)
{
    if (low >= high)
        return;
    if (high < 1e30)
        text_add(t, "%g to %g", low, high);
    else if (low > 0 && low < 1e-20)
        text_add(t, "above 0");
    else if (low > -1e30)
        text_add(t, "at least %g", low);
}

static void add_param(described_keys *l, const pf_param *p, const char *term)
{
    described_key k = {.place = p->flags & PF_SHARED ? KEY_OF_FLUID : KEY_OF_TERM,
                       .name = p->name,
                       .unit = or_empty(p->unit),
                       .doc = or_empty(p->doc)};

    if (p->flags & PF_REQUIRED)
        text_add(&k.standard, "required");
    else if (p->type == PF_T_CHOICE)
        text_add(&k.standard, "\"%s\"", p->choice[(int)p->dflt]);
    else if (p->type == PF_T_BOOL)
        text_add(&k.standard, "%s", p->dflt != 0 ? "true" : "false");
    else
        text_add(&k.standard, "%g", p->dflt);
    if (p->type == PF_T_CHOICE)
        for (const char *const *c = p->choice; *c; c++)
            text_add(&k.range, "%s\"%s\"", c == p->choice ? "" : ", ", *c);
    else if (p->type == PF_T_BOOL)
        text_add(&k.range, "true or false");
    else
        put_range(&k.range, p->min, p->max);
    if (p->type == PF_T_VECTOR)
        text_add(&k.range, "%svector", k.range.n ? ", " : "");
    if (p->type == PF_T_INT)
        text_add(&k.range, "%swhole", k.range.n ? ", " : "");
    add(l, &k, term);
}

/* Values of the case, and keys of bodies, are slots. */
static void add_slot(described_keys *l, const pf_term *t, const pf_slot *s)
{
    described_key k = {.unit = or_empty(s->unit), .doc = or_empty(s->doc)};

    if (s->eval == PF_BODY_KEY) {
        k.place = KEY_OF_BODY;
        k.name = s->field;
        text_add(&k.standard, "%g", s->dflt);
        put_range(&k.range, s->min, s->max);
        if (s->shape != PF_SCALAR)
            text_add(&k.range, "%s%s", k.range.n ? ", " : "", term_shape_name(s->shape));
    } else {
        k.place = t->flags & PF_BY_BOUNDARY ? KEY_OF_BOUNDARY : KEY_OF_TERM;
        k.name = s->name;
        k.doc = s->doc                      ? s->doc
                : t->flags & PF_BY_BOUNDARY ? "acts where a boundary gives it"
                                            : "given by the case";
        text_add(&k.standard, t->flags & PF_BY_BOUNDARY ? "off" : s->flags & PF_REQUIRED ? "required" : "0");
        text_add(&k.range, "%s, or a function of it", term_shape_name(s->shape));
    }
    add(l, &k, t->name);
}

static int room(described_keys *l, size_t n, error *err)
{
    *l = (described_keys){.key = calloc(n + 1, sizeof *l->key)};
    return l->key ? 0 : error_memory(err, "keys", (double)(n * sizeof *l->key));
}

int describe_keys(described_keys *l, const term_plugin *p, const char *only, error *err)
{
    size_t n = 0;

    for (uint32_t i = 0; i < p->d.n_term; i++)
        n += p->term[i].n_param + p->term[i].n_in;
    TRY(room(l, n, err));
    for (uint32_t i = 0; i < p->d.n_term; i++) {
        const pf_term *t = &p->term[i];

        if (only && strcmp(only, t->name) != 0)
            continue;
        for (uint32_t k = 0; k < t->n_param; k++)
            add_param(l, &t->param[k], t->name);
        for (uint32_t k = 0; k < t->n_in; k++)
            if (t->in[k].eval == PF_DATA || t->in[k].eval == PF_BODY_KEY)
                add_slot(l, t, &t->in[k]);
    }
    return 0;
}

int describe_solver_keys(described_keys *l, const pf_solver *s, error *err)
{
    /* early solvers know of none */
    const int has = s->size >= offsetof(pf_solver, configure) + sizeof s->configure && s->param;

    TRY(room(l, has ? s->n_param : 0, err));
    for (uint32_t i = 0; has && i < s->n_param; i++) {
        pf_param p = {0};

        memcpy(&p, (const char *)s->param + (size_t)i * s->param_size,
               s->param_size < sizeof p ? s->param_size : sizeof p);
        if (p.name)
            add_param(l, &p, s->name);
    }
    return 0;
}

void describe_keys_free(described_keys *l)
{
    for (int i = 0; i < l->n; i++)
        drop(&l->key[i]);
    free(l->key);
    *l = (described_keys){0};
}

const char *describe_derivative(const pf_term *t)
{
    return t->jacobian ? "by hand" : t->residual_c ? "by complex step" : "by differences";
}

const char *describe_points(const pf_term *t)
{
    static const char *const name[] = {"",
                                       "all cells",
                                       "outside of bodies",
                                       "inside of bodies",
                                       "boundary facets",
                                       "surfaces of bodies",
                                       "cells with too little fluid (differences from their roots)",
                                       "bodies, once each",
                                       "near pairs of bodies or body and wall"};

    return name[t->where];
}

const char *describe_support(const pf_field *f)
{
    static const char *const order[] = {"one value a cell", "of order 1", "of order 2"};
    static const char *const name[] = {"",
                                       "one for the whole problem",
                                       "of each body",
                                       "inside of bodies",
                                       "memory of points in cells",
                                       "memory of each body"};

    return f->support == PF_ON_MESH ? order[f->order] : name[f->support];
}

void describe_slot(text *t, const pf_slot *s)
{
    text_add(t, "%s%s%s", term_eval_name(s->eval),
             !s->field                 ? ""
             : s->eval == PF_PROPERTY  ? " "
             : s->eval == PF_BODY_KEY  ? ": "
             : s->eval == PF_OTHER_KEY ? ": "
                                       : " of ",
             or_empty(s->field));
}

void describe_flags(text *t, const pf_term *term, const char *before)
{
    static const struct {
        uint32_t flag;
        const char *text;
    } flags[] = {{PF_LINEAR, "linear"},
                 {PF_CONTINUATION, "faded in by continuation"},
                 {PF_FLUID_FORCE, "what the fluid does to the body"},
                 {PF_METRIC, "reads the metric of the element"},
                 {PF_WALL_DISTANCE, "reads the distance to the nearest wall"},
                 {PF_ONLY_2D, "2D only"},
                 {PF_ONLY_3D, "3D only"},
                 {PF_LAST, "after all others"}};

    for (size_t i = 0; i < sizeof flags / sizeof *flags; i++)
        if (term->flags & flags[i].flag)
            text_add(t, "%s%s", before, flags[i].text);
    if (term->replaces && *term->replaces)
        text_add(t, "%stakes the place of %s", before, term->replaces);
}
