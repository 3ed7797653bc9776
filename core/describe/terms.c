/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * term "..." {} and fluid {} of a case: which terms are on, with which parameters; and the
 * fields that they need. */
#include "describe/describe.h"

#include <lauxlib.h>

#include <stdio.h>
#include <string.h>

static const char *const derivative_name[] = {"auto", "analytic", "complex", "fd", NULL};

/* One parameter from a reader into the term's struct; as the readers return. */
static int read_param(reader *r, const pf_param *q, int dim, void *params)
{
    char *at = (char *)params + q->offset,
         *doc = arena_alloc(&r->c->memory, strlen(q->doc) + strlen(q->unit) + 4, 1);
    double v[3] = {0};
    int n = 0, status;

    if (!doc)
        return -1;
    sprintf(doc, "%s%s%s", q->doc, strcmp(q->unit, "1") ? ", " : "", strcmp(q->unit, "1") ? q->unit : "");
    switch (q->type) {
    case PF_T_REAL:
        status = reader_number(r, q->name, doc, q->min, q->max, v);
        if (status > 0)
            memcpy(at, v, sizeof *v);
        return status;
    case PF_T_VECTOR:
        status = reader_vector(r, q->name, doc, dim, v);
        if (status > 0)
            memcpy(at, v, sizeof v);
        return status;
    case PF_T_INT:
        status = reader_integer(r, q->name, doc, q->min < q->max ? (int)q->min : -1000000000,
                                q->min < q->max ? (int)q->max : 1000000000, &n);
        break;
    case PF_T_BOOL:
        status = reader_bool(r, q->name, doc, &n);
        break;
    default:
        status = reader_choice(r, q->name, doc, q->choice, &n);
    }
    if (status > 0)
        memcpy(at, &n, sizeof n);
    return status;
}

static void read_params(description *d, reader *own, reader *fluid, term_use *u)
{
    for (uint32_t i = 0; i < u->term->n_param; i++) {
        const pf_param *q = &u->term->param[i];
        int status = 0;

        if (q->flags & PF_SHARED)
            status = read_param(fluid, q, d->dim, u->params);
        if (reader_has(own, q->name) || !status) /* the term's own line has the last word */
            status = read_param(own, q, d->dim, u->params);
        if (status == 0 && (q->flags & PF_REQUIRED)) {
            if ((q->flags & PF_SHARED) && (reader_misspelt(fluid, q->name) || reader_misspelt(own, q->name)))
                continue;
            if (q->flags & PF_SHARED)
                case_wrong(d->c, fluid->b ? fluid->b : own->b, NULL,
                           "%s needs \"%s\" (%s, %s): give it in fluid { %s = ... }", own->what, q->name, q->doc,
                           q->unit, q->name);
            else
                reader_required(own, q->name, status);
        }
    }
}

/* PF_DATA slots of terms on cells: keys of the term's line. */
static void read_data(description *d, reader *own, term_use *u)
{
    for (uint32_t k = 0; k < u->term->n_in; k++) {
        const pf_slot *s = &u->term->in[k];
        value *v;

        if (s->eval != PF_DATA || (u->term->flags & PF_BY_BOUNDARY))
            continue;
        v = arena_alloc(&d->memory, 1, sizeof *v);
        if (!v)
            return;
        v->n = term_components(s->shape, d->dim);
        reader_value(own, s->name, "a value or a function of position and time", v->n, d->dim, v);
        u->data[k] = v;
    }
}

static int is_listed(const char *name, const char *const *list, int n)
{
    for (int i = 0; i < n; i++)
        if (strcmp(list[i], name) == 0)
            return 1;
    return 0;
}

static int add_use(description *d, const term_plugin *plugin, const pf_term *t, error *err)
{
    term_use *u = &d->use[d->n_use];

    if (d->n_use == DESCRIBE_MAX_TERMS)
        return error_set(err, ERR_CASE, "%s: more than %d terms", d->c->path, DESCRIBE_MAX_TERMS);
    *u = (term_use){.plugin = plugin, .term = t, .where = (int)t->where};
    u->params = arena_alloc(&d->memory, t->params_bytes ? t->params_bytes : 1, 1);
    if (!u->params)
        return error_memory(err, "parameters", t->params_bytes);
    term_defaults(t, u->params);
    d->n_use++;
    return 0;
}

/* Checks the names in without = {...} or only = {...}. */
static void check_names(description *d, reader *r, const char *key, const term_plugin *plugin,
                        const char *const *list, int n)
{
    const char *name[64];
    uint32_t m = 0;

    for (; m < plugin->d.n_term && m < 64; m++)
        name[m] = plugin->term[m].name;
    for (int i = 0; i < n; i++)
        if (!is_listed(list[i], name, (int)m)) {
            const char *near = text_nearest(list[i], name, m);

            case_wrong(d->c, r->b, key, "%s: %s: there is no integrator \"%s\"%s%s%s", r->what, key, list[i],
                       near ? "; did you mean \"" : "", near ? near : "", near ? "\"?" : "");
        }
}

/* The plugin of a term line.  A name that no plugin has is a mistake of the case like any other: it is reported,
 * and reading goes on as if the name that comes nearest stood there; without one *plugin is NULL. */
static int find_plugin(description *d, registry *r, const case_block *b, char *name, size_t size,
                       const term_plugin **plugin, error *err)
{
    const char *near = NULL;

    *plugin = NULL;
    if (registry_knows(r, name, &near)) {
        if (registry_equation(r, name, plugin, err))
            return error_prefix(err, "%s:%d: term \"%s\": ", b->file, b->line, b->name);
        return 0;
    }
    registry_equation(r, name, plugin, err); /* for its message */
    case_wrong(d->c, b, NULL, "term \"%s\": %s", b->name, err->text);
    *plugin = NULL;
    d->incomplete = 1;
    if (near) {
        snprintf(name, size, "%s", near);
        if (registry_equation(r, name, plugin, err))
            *plugin = NULL;
        d->incomplete = *plugin == NULL;
    }
    return 0;
}

/* Terms from number `first` on that an earlier line has switched on. */
static void check_twice(const description *d, const case_block *b, const char *what, const char *plugin, int first)
{
    for (int i = 0; i < first; i++)
        for (int k = first; k < d->n_use; k++)
            if (d->use[i].term == d->use[k].term) {
                case_wrong(d->c, b, NULL, "%s: %s.%s is on already, by an earlier line", what, plugin,
                           d->use[k].term->name);
                return;
            }
}

static int read_term(description *d, registry *r, const case_block *b, reader *fluid, int outside, error *err)
{
    static const char *const over_name[] = {"all", "fluid", NULL};
    const term_plugin *plugin;
    const char *dot = strchr(b->name, '.'), *single = dot ? dot + 1 : NULL, *without[32];
    char name[128], *what = arena_alloc(&d->memory, strlen(b->name) + 10, 1);
    int n_without, how = 0, over = outside, found = 0, first = d->n_use;
    reader own;

    snprintf(name, sizeof name, "%.*s", dot ? (int)(dot - b->name) : (int)strlen(b->name), b->name);
    TRY(find_plugin(d, r, b, name, sizeof name, &plugin, err));
    if (!plugin)
        return 0;
    if (!what)
        return error_memory(err, "case", 0);
    sprintf(what, "term \"%s\"", b->name);
    reader_open(&own, d->c, b, what);
    if (!single && reader_strings(&own, "without", "integrators to leave out", 32, without, &n_without) > 0)
        check_names(d, &own, "without", plugin, without, n_without);
    reader_choice(&own, "jacobian", "how the derivatives are computed", derivative_name, &how);
    reader_choice(&own, "over", "part of the domain: all of it, or outside of the bodies (fluid)", over_name,
                  &over);
    for (uint32_t i = 0; i < plugin->d.n_term; i++) {
        const pf_term *t = &plugin->term[i];

        if (single ? strcmp(t->name, single) != 0
                   : (t->flags & PF_OPTIONAL) || is_listed(t->name, without, n_without))
            continue;
        found = 1;
        TRY(add_use(d, plugin, t, err));
        if (!term_has_derivative(t, (enum term_derivative)how))
            case_wrong(
                d->c, b, "jacobian",
                "%s: jacobian = \"%s\", but %s.%s has no such derivative; leave the key out (\"auto\" takes the "
                "best there is)",
                what, derivative_name[how], name, t->name);
        d->use[d->n_use - 1].how = (enum term_derivative)how;
        if (over && t->where == PF_CELL)
            d->use[d->n_use - 1].where = PF_FLUID;
    }
    if (single && !found)
        case_wrong(d->c, b, NULL, "%s: plugin \"%s\" has no term \"%s\"; plugflow describe %s lists its terms",
                   what, name, single, name);
    for (int i = first; i < d->n_use; i++) {
        read_params(d, &own, fluid, &d->use[i]);
        read_data(d, &own, &d->use[i]);
    }
    reader_close(&own);
    for (int i = first; i < d->n_use; i++) {
        const term_use *u = &d->use[i];
        char why[400] = "";

        if (u->term->check && u->term->check(u->params, why, sizeof why))
            case_wrong(d->c, b, NULL, "%s: %s", what, why);
    }
    check_twice(d, b, what, name, first);
    return 0;
}

/* Fields of the slots in use; every one needs an equation. */
static int collect_fields(description *d, error *err)
{
    int has_rows[TERM_MAX_FIELDS] = {0};

    for (int i = 0; i < d->n_use; i++) {
        const pf_term *t = d->use[i].term;

        for (uint32_t k = 0; k < t->n_in + t->n_out; k++) {
            const pf_slot *s = k < t->n_in ? &t->in[k] : &t->out[k - t->n_in];
            int f;

            if (s->eval == PF_DATA)
                continue;
            TRY(fields_add(&d->fields, d->dim, term_field(d->use[i].plugin, s->field), d->use[i].plugin->d.name,
                           err));
            f = fields_find(&d->fields, s->field);
            has_rows[f] |= k >= t->n_in && t->where != PF_FACET;
        }
    }
    for (int f = 0; f < d->fields.n && !d->incomplete; f++)
        if (!has_rows[f])
            case_wrong(
                d->c, NULL, NULL,
                "field \"%s\" (%s) is used by plugin \"%s\", but no term gives an equation for it; switch one on",
                d->fields.f[f].name, d->fields.f[f].doc, d->fields.f[f].declared_by);
    return 0;
}

int describe_terms(description *d, registry *r, error *err)
{
    static const char *const regions[] = {"everywhere", "outside", NULL};
    const case_block *b;
    int outside = 0;
    reader fluid;

    reader_open(&fluid, d->c, case_find(d->c, "fluid", 0), "fluid");
    reader_choice(&fluid, "region", "where the terms on cells act: everywhere, or outside of the bodies", regions,
                  &outside);
    if (!case_find(d->c, "term", 0)) {
        d->incomplete = 1; /* what the other blocks say has no one to understand it */
        case_wrong(d->c, NULL, NULL,
                   "the case has no term; add lines like term \"continuity\" {} and term \"momentum\" {}");
    }
    for (int k = 0; (b = case_find(d->c, "term", k)); k++) {
        if (!b->name) {
            case_wrong(d->c, b, NULL, "term: expected a name in quotes, as in term \"momentum\" {}");
            continue;
        }
        TRY(read_term(d, r, b, &fluid, outside, err));
    }
    if (!d->incomplete)
        reader_close(&fluid);
    return collect_fields(d, err);
}
