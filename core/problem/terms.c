/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * term "..." {} and fluid {} of a case: which terms are on, with which parameters; and the
 * fields that they need. */
#include "problem/problem.h"

#include <lauxlib.h>

#include <stdio.h>
#include <string.h>

static const char *const derivative_name[] = {"auto", "analytic", "complex", "fd", NULL};

/* One parameter from a reader into the term's struct; as the readers return. */
static int read_param(reader *r, const pf_param *p, int dim, void *params)
{
    char *at = (char *)params + p->offset,
         *doc = arena_alloc(&r->c->memory, strlen(p->doc) + strlen(p->unit) + 4, 1);
    double v[3] = {0};
    int n = 0, status;

    if (!doc)
        return -1;
    sprintf(doc, "%s%s%s", p->doc, strcmp(p->unit, "1") ? ", " : "", strcmp(p->unit, "1") ? p->unit : "");
    switch (p->type) {
    case PF_T_REAL:
        status = reader_number(r, p->name, doc, p->min, p->max, v);
        if (status > 0)
            memcpy(at, v, sizeof *v);
        return status;
    case PF_T_VECTOR:
        status = reader_vector(r, p->name, doc, dim, v);
        if (status > 0)
            memcpy(at, v, sizeof v);
        return status;
    case PF_T_INT:
        status = reader_integer(r, p->name, doc, p->min < p->max ? (int)p->min : -1000000000,
                                p->min < p->max ? (int)p->max : 1000000000, &n);
        break;
    case PF_T_BOOL:
        status = reader_bool(r, p->name, doc, &n);
        break;
    default:
        status = reader_choice(r, p->name, doc, p->choice, &n);
    }
    if (status > 0)
        memcpy(at, &n, sizeof n);
    return status;
}

static void read_params(problem *p, reader *own, reader *fluid, term_use *u)
{
    for (uint32_t i = 0; i < u->term->n_param; i++) {
        const pf_param *q = &u->term->param[i];
        int status = 0;

        if (q->flags & PF_SHARED)
            status = read_param(fluid, q, p->dim, u->params);
        if (reader_has(own, q->name) || !status) /* the term's own line has the last word */
            status = read_param(own, q, p->dim, u->params);
        if (status == 0 && (q->flags & PF_REQUIRED)) {
            if ((q->flags & PF_SHARED) && (reader_misspelt(fluid, q->name) || reader_misspelt(own, q->name)))
                continue;
            if (q->flags & PF_SHARED)
                case_wrong(p->c, fluid->b ? fluid->b : own->b, NULL,
                           "%s needs \"%s\" (%s, %s): give it in fluid { %s = ... }", own->what, q->name, q->doc,
                           q->unit, q->name);
            else
                reader_required(own, q->name, status);
        }
    }
}

/* PF_DATA slots of terms on cells: keys of the term's line. */
static void read_data(problem *p, reader *own, term_use *u)
{
    for (uint32_t k = 0; k < u->term->n_in; k++) {
        const pf_slot *s = &u->term->in[k];
        value *v;

        if (s->eval != PF_DATA || (u->term->flags & PF_BY_BOUNDARY))
            continue;
        v = arena_alloc(&p->memory, 1, sizeof *v);
        if (!v)
            return;
        v->n = term_components(s->shape, p->dim);
        reader_value(own, s->name, "a value or a function of position and time", v->n, p->dim, v);
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

static int add_use(problem *p, const term_plugin *plugin, const pf_term *t, error *err)
{
    term_use *u = &p->use[p->n_use];

    if (p->n_use == ASSEMBLE_MAX_USES)
        return error_set(err, ERR_CASE, "%s: more than %d terms", p->c->path, ASSEMBLE_MAX_USES);
    *u = (term_use){.plugin = plugin, .term = t, .where = (int)t->where, .factor = 1};
    u->params = arena_alloc(&p->memory, t->params_bytes ? t->params_bytes : 1, 1);
    if (!u->params)
        return error_memory(err, "parameters", t->params_bytes);
    term_defaults(t, u->params);
    p->n_use++;
    return 0;
}

/* Checks the names in without = {...} or only = {...}. */
static void check_names(problem *p, reader *r, const char *key, const term_plugin *plugin, const char *const *list,
                        int n)
{
    const char *name[64];
    uint32_t m = 0;

    for (; m < plugin->d.n_term && m < 64; m++)
        name[m] = plugin->term[m].name;
    for (int i = 0; i < n; i++)
        if (!is_listed(list[i], name, (int)m)) {
            const char *near = text_nearest(list[i], name, m);

            case_wrong(p->c, r->b, key, "%s: %s: there is no integrator \"%s\"%s%s%s", r->what, key, list[i],
                       near ? "; did you mean \"" : "", near ? near : "", near ? "\"?" : "");
        }
}

static int read_term(problem *p, const case_block *b, reader *fluid, int outside, error *err)
{
    static const char *const over_name[] = {"all", "fluid", NULL};
    const term_plugin *plugin;
    const char *dot = strchr(b->name, '.'), *single = dot ? dot + 1 : NULL, *without[32];
    char name[128], *what = arena_alloc(&p->memory, strlen(b->name) + 10, 1);
    int n_without, how = 0, over = outside, found = 0, first = p->n_use;
    reader own;

    snprintf(name, sizeof name, "%.*s", dot ? (int)(dot - b->name) : (int)strlen(b->name), b->name);
    if (registry_equation(p->r, name, &plugin, err))
        return error_prefix(err, "%s:%d: term \"%s\": ", b->file, b->line, b->name);
    if (!what)
        return error_memory(err, "case", 0);
    sprintf(what, "term \"%s\"", b->name);
    reader_open(&own, p->c, b, what);
    if (!single && reader_strings(&own, "without", "integrators to leave out", 32, without, &n_without) > 0)
        check_names(p, &own, "without", plugin, without, n_without);
    reader_choice(&own, "jacobian", "how the derivatives are computed", derivative_name, &how);
    reader_choice(&own, "over", "part of the domain: all of it, or outside of the bodies (fluid)", over_name,
                  &over);
    for (uint32_t i = 0; i < plugin->d.n_term; i++) {
        const pf_term *t = &plugin->term[i];

        if (single ? strcmp(t->name, single) != 0
                   : (t->flags & PF_OPTIONAL) || is_listed(t->name, without, n_without))
            continue;
        found = 1;
        TRY(add_use(p, plugin, t, err));
        p->use[p->n_use - 1].how = (enum term_derivative)how;
        if (over && t->where == PF_CELL)
            p->use[p->n_use - 1].where = PF_FLUID;
    }
    if (single && !found)
        case_wrong(p->c, b, NULL, "%s: plugin \"%s\" has no term \"%s\"; plugflow describe %s lists its terms",
                   what, name, single, name);
    for (int i = first; i < p->n_use; i++) {
        read_params(p, &own, fluid, &p->use[i]);
        read_data(p, &own, &p->use[i]);
    }
    reader_close(&own);
    for (int i = first; i < p->n_use; i++) {
        const term_use *u = &p->use[i];
        char why[400] = "";

        if (u->term->check && u->term->check(u->params, why, sizeof why))
            case_wrong(p->c, b, NULL, "%s: %s", what, why);
    }
    for (int i = 0; i < first; i++)
        for (int k = first; k < p->n_use; k++)
            if (p->use[i].term == p->use[k].term) {
                case_wrong(p->c, b, NULL, "%s: %s.%s is on already, by an earlier line", what, name,
                           p->use[k].term->name);
                return 0;
            }
    return 0;
}

/* Fields of the slots in use; every one needs an equation. */
static int collect_fields(problem *p, error *err)
{
    int has_rows[SPACE_MAX_FIELDS] = {0};

    for (int i = 0; i < p->n_use; i++) {
        const pf_term *t = p->use[i].term;

        for (uint32_t k = 0; k < t->n_in + t->n_out; k++) {
            const pf_slot *s = k < t->n_in ? &t->in[k] : &t->out[k - t->n_in];
            int f;

            if (s->eval == PF_DATA)
                continue;
            TRY(space_add_field(&p->space, p->dim, term_field(p->use[i].plugin, s->field), p->use[i].plugin->d.name,
                                err));
            f = space_find_field(&p->space, s->field);
            has_rows[f] |= k >= t->n_in && t->where != PF_FACET;
        }
    }
    for (int f = 0; f < p->space.n_field; f++)
        if (!has_rows[f])
            case_wrong(
                p->c, NULL, NULL,
                "field \"%s\" (%s) is used by plugin \"%s\", but no term gives an equation for it; switch one on",
                p->space.field[f].name, p->space.field[f].doc, p->space.field[f].declared_by);
    return 0;
}

int problem_read_terms(problem *p, error *err)
{
    static const char *const regions[] = {"everywhere", "outside", NULL};
    const case_block *b;
    int outside = 0;
    reader fluid;

    reader_open(&fluid, p->c, case_find(p->c, "fluid", 0), "fluid");
    reader_choice(&fluid, "region", "where the terms on cells act: everywhere, or outside of the bodies", regions,
                  &outside);
    if (!case_find(p->c, "term", 0))
        case_wrong(p->c, NULL, NULL,
                   "the case has no term; add lines like term \"continuity\" {} and term \"momentum\" {}");
    for (int k = 0; (b = case_find(p->c, "term", k)); k++) {
        if (!b->name) {
            case_wrong(p->c, b, NULL, "term: expected a name in quotes, as in term \"momentum\" {}");
            continue;
        }
        TRY(read_term(p, b, &fluid, outside, err));
    }
    reader_close(&fluid);
    return collect_fields(p, err);
}
