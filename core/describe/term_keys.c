/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Keys of term "..." {} and fluid {}: parameters and data of the terms that are on. */
#include "describe/describe.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { MOST_INT = 1000000000 };

/* One parameter from a reader into the struct of its term or solver.  *status: as the readers return. */
int describe_read_param(reader *r, const pf_param *q, int dim, void *params, int *status, error *err)
{
    const int bounded = q->min < q->max, unit = strcmp(q->unit, "1") != 0;
    char *at = (char *)params + q->offset, *doc;
    double v[3] = {0};
    size_t size = sizeof *v;
    int n = 0;

    ARENA_NEW(&r->c->memory, doc, strlen(q->doc) + strlen(q->unit) + 4, err);
    sprintf(doc, "%s%s%s", q->doc, unit ? ", " : "", unit ? q->unit : "");
    switch (q->type) {
    case PF_T_REAL:
        *status = reader_number(r, q->name, doc, q->min, q->max, v);
        break;
    case PF_T_VECTOR:
        *status = reader_vector(r, q->name, doc, dim, v);
        size = sizeof v;
        break;
    case PF_T_INT:
        *status = reader_integer(r, q->name, doc, bounded ? (int)fmax(q->min, -MOST_INT) : -MOST_INT,
                                 bounded ? (int)fmin(q->max, MOST_INT) : MOST_INT, &n);
        break;
    case PF_T_BOOL:
        *status = reader_bool(r, q->name, doc, &n);
        break;
    default:
        *status = reader_choice(r, q->name, doc, q->choice, &n);
    }
    if (*status <= 0)
        return 0;
    if (q->type == PF_T_REAL || q->type == PF_T_VECTOR)
        memcpy(at, v, size);
    else
        memcpy(at, &n, sizeof n);
    return 0;
}

void describe_missing(description *d, const case_block *own, const pf_param *q)
{
    const case_block *fluid = case_find(d->c, "fluid", 0);

    if (q->flags & PF_SHARED)
        case_wrong(d->c, fluid ? fluid : own, NULL,
                   "term \"%s\" needs \"%s\" (%s, %s): give it in fluid { %s = ... }", own->name, q->name, q->doc,
                   q->unit, q->name);
    else
        case_wrong(d->c, own, NULL, "term \"%s\": \"%s\" is missing (%s%s%s)", own->name, q->name, q->doc,
                   strcmp(q->unit, "1") ? ", " : "", strcmp(q->unit, "1") ? q->unit : "");
}

static int read_params(description *d, reader *own, reader *fluid, term_use *u, error *err)
{
    for (uint32_t i = 0; i < u->term->n_param; i++) {
        const pf_param *q = &u->term->param[i];
        int status = 0;

        if (q->flags & PF_SHARED)
            TRY(describe_read_param(fluid, q, d->dim, u->params, &status, err));
        if (reader_has(own, q->name) || !status) /* the term's own line has the last word */
            TRY(describe_read_param(own, q, d->dim, u->params, &status, err));
        u->given |= status ? 1u << i : 0;
        if (status || !(q->flags & PF_REQUIRED))
            continue;
        if (reader_misspelt(fluid, q->name) || reader_misspelt(own, q->name))
            continue;
        if (!term_takes(u->term, q->name))
            describe_missing(d, own->b, q);
        u->missing |= 1u << i; /* unless it is published: describe_properties */
    }
    return 0;
}

static void missing_data(description *d, const case_block *own, const pf_slot *s)
{
    const char *doc = s->doc ? s->doc : "a value or a function of position and time";
    const int unit = s->unit && strcmp(s->unit, "1") != 0;

    case_wrong(d->c, own, NULL, "term \"%s\": \"%s\" is missing (%s%s%s)", own->name, s->name, doc,
               unit ? ", " : "", unit ? s->unit : "");
}

/* PF_DATA slots of terms on cells: keys of the term's line. */
static int read_data(description *d, reader *own, term_use *u, error *err)
{
    for (uint32_t k = 0; k < u->term->n_in; k++) {
        const pf_slot *s = &u->term->in[k];
        int status;
        value *v;

        if (s->eval != PF_DATA || (u->term->flags & PF_BY_BOUNDARY))
            continue;
        ARENA_NEW(&d->memory, v, 1, err);
        v->n = term_components(s->shape, d->dim);
        status = describe_value(own, s->name, "a value or a function of position and time", v->n, d->dim, v);
        u->data[k] = v;
        u->no_data |= status == 0 ? 1u << k : 0;
        if (status == 0 && (s->flags & PF_REQUIRED) && !reader_misspelt(own, s->name))
            missing_data(d, own->b, s);
    }
    return 0;
}

int describe_term_keys(description *d, reader *own, reader *fluid, term_use *u, error *err)
{
    TRY(read_params(d, own, fluid, u, err));
    return read_data(d, own, u, err);
}

void describe_misplaced(description *d, reader *r, const char *key, const char *fmt, ...)
{
    char why[400];
    va_list ap;

    if (!reader_has(r, key) || reader_asked(r, key))
        return;
    va_start(ap, fmt);
    vsnprintf(why, sizeof why, fmt, ap);
    va_end(ap);
    case_wrong(d->c, r->b, key, "%s: \"%s\" %s", r->what, key, why);
    reader_note(r, key, "");
}

void describe_off_keys(description *d, reader *own, const term_plugin *plugin)
{
    const char *name = plugin->d.name;

    for (uint32_t i = 0; i < plugin->d.n_term; i++) {
        const pf_term *t = &plugin->term[i];

        for (uint32_t k = 0; k < t->n_in; k++)
            if (t->in[k].eval == PF_DATA && (t->flags & PF_BY_BOUNDARY))
                describe_misplaced(d, own, t->in[k].name, "(%s.%s) is a key of boundary \"...\" {}", name, t->name);
            else if (t->in[k].eval == PF_DATA)
                describe_misplaced(d, own, t->in[k].name,
                                   "belongs to %s.%s, which is off here; term \"%s.%s\" {} switches it on", name,
                                   t->name, name, t->name);
        for (uint32_t k = 0; k < t->n_param; k++)
            describe_misplaced(d, own, t->param[k].name,
                               "belongs to %s.%s, which is off here; term \"%s.%s\" {} switches it on", name,
                               t->name, name, t->name);
    }
}

/* What a fluid has is no mistake in fluid{} where the one term of a plugin that takes it is left out. */
static void note_off_keys(reader *fluid, const term_plugin *plugin)
{
    for (uint32_t i = 0; i < plugin->d.n_term; i++)
        for (uint32_t k = 0; k < plugin->term[i].n_param; k++)
            if (plugin->term[i].param[k].flags & PF_SHARED && !(plugin->term[i].flags & PF_OPTIONAL))
                reader_note(fluid, plugin->term[i].param[k].name, plugin->term[i].param[k].doc);
}

void describe_unshared_keys(description *d, reader *fluid)
{
    for (int i = 0; i < d->n_use; i++) {
        const pf_term *t = d->use[i].term;
        const char *line = d->use_block[i]->name;

        for (uint32_t k = 0; k < t->n_in; k++)
            if (t->in[k].eval == PF_DATA && (t->flags & PF_BY_BOUNDARY))
                describe_misplaced(d, fluid, t->in[k].name, "is a key of boundary \"...\" {}");
            else if (t->in[k].eval == PF_DATA)
                describe_misplaced(d, fluid, t->in[k].name, "is a key of the line term \"%s\" {}", line);
        for (uint32_t k = 0; k < t->n_param; k++)
            describe_misplaced(d, fluid, t->param[k].name, "is a key of the line term \"%s\" {}", line);
        note_off_keys(fluid, d->use[i].plugin);
    }
}

const pf_param *describe_param(const term_use *u, const char *name)
{
    for (uint32_t i = 0; i < u->term->n_param; i++)
        if (strcmp(u->term->param[i].name, name) == 0)
            return &u->term->param[i];
    return NULL;
}
