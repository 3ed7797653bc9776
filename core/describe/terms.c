/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * term "..." {} and fluid {} of a case: which terms are on, with which parameters; and the
 * fields that they need. */
#include "describe/describe.h"

#include <stdio.h>
#include <string.h>

static const char *const derivative_name[] = {"auto", "analytic", "complex", "fd", NULL};

static int is_listed(const char *name, const char *const *list, int n)
{
    for (int i = 0; i < n; i++)
        if (strcmp(list[i], name) == 0)
            return 1;
    return 0;
}

/* The terms that a line switches on. */
typedef struct line_terms {
    int n;
    term_use *use[DESCRIBE_MAX_TERMS];
} line_terms;

static int add_use(description *d, const case_block *b, const term_plugin *plugin, const pf_term *t,
                   line_terms *mine, error *err)
{
    term_list *list = term_kind(t) == TERM_PUBLISHES ? &d->law : term_kind(t) == TERM_SHOWS ? &d->shown : NULL;
    int *n = list ? &list->n : &d->n_use;
    term_use *u = list ? &list->use[*n] : &d->use[*n];

    if (*n == DESCRIBE_MAX_TERMS)
        return error_set(err, ERR_CASE, "%s:%d: more than %d terms", b->file, b->line, DESCRIBE_MAX_TERMS);
    *u = (term_use){.plugin = plugin, .term = t, .where = (int)t->where};
    u->params = arena_alloc(&d->memory, t->params_bytes ? t->params_bytes : 1, 1);
    if (!u->params)
        return error_memory(err, "parameters", t->params_bytes);
    term_defaults(t, u->params);
    *(list ? &list->block[*n] : &d->use_block[*n]) = b;
    ++*n;
    mine->use[mine->n++] = u;
    return 0;
}

/* A name that is none of the plugin's terms. */
static void no_such_term(description *d, const case_block *b, const char *key, const char *what,
                         const term_plugin *plugin, const char *wrong)
{
    const char *name[64];
    text list = {0};
    uint32_t n = 0;

    for (; n < plugin->d.n_term && n < 64; n++) {
        name[n] = plugin->term[n].name;
        text_add(&list, "%s%s", n ? ", " : "", name[n]);
    }
    case_wrong(d->c, b, key, "%s: plugin \"%s\" has no term \"%s\"%s\n    its terms: %s", what, plugin->d.name,
               wrong, text_hint(text_nearest(wrong, name, n)).s, list.s ? list.s : "");
    text_free(&list);
}

/* Names in without = {...}, only = {...}. */
static void check_names(description *d, reader *r, const char *key, const term_plugin *plugin,
                        const char *const *list, int n)
{
    for (int i = 0; i < n; i++) {
        int found = 0;

        for (uint32_t k = 0; k < plugin->d.n_term; k++)
            found |= strcmp(plugin->term[k].name, list[i]) == 0;
        if (!found)
            no_such_term(d, r->b, key, r->what, plugin, list[i]);
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

/* How a line uses the terms that it switches on. */
typedef struct line_options {
    const char *without[32], *only[32];
    int n_without, n_only;
    int how, over; /* enum term_derivative; 1: in the fluid only */
    const value *inside;
    const char *label;
} line_options;

static void read_options(description *d, reader *own, const term_plugin *plugin, int single, line_options *o)
{
    static const char *const over_name[] = {"all", "fluid", NULL};

    if (!single && reader_strings(own, "without", "terms to leave out", 32, o->without, &o->n_without) > 0)
        check_names(d, own, "without", plugin, o->without, o->n_without);
    if (!single &&
        reader_strings(own, "only", "the terms to switch on, optional ones too", 32, o->only, &o->n_only) > 0)
        check_names(d, own, "only", plugin, o->only, o->n_only);
    reader_choice(own, "jacobian", "how the derivatives are computed", derivative_name, &o->how);
    reader_choice(own, "over", "part of the domain: all of it, or outside of the bodies (fluid)", over_name,
                  &o->over);
}

/* Terms that make sense in 2D, or in 3D, alone. */
static void check_dimension(description *d, const reader *own, const term_plugin *plugin, const pf_term *t)
{
    const int only = t->flags & PF_ONLY_2D ? 2 : t->flags & PF_ONLY_3D ? 3 : d->dim;

    if (only != d->dim)
        case_wrong(d->c, own->b, NULL,
                   "%s: %s.%s is for cases in %dD, and this one is in %dD; leave it out, or take a mesh in %dD",
                   own->what, plugin->d.name, t->name, only, d->dim, only);
}

/* Whether a line switches a term on: it names it, or does not and the term is none of the optional ones. */
static int is_on(const pf_term *t, const char *single, const line_options *o)
{
    if (single)
        return strcmp(t->name, single) == 0;
    return (o->n_only ? is_listed(t->name, o->only, o->n_only) : !(t->flags & PF_OPTIONAL)) &&
           !is_listed(t->name, o->without, o->n_without);
}

/* Switches on the terms of a line: the one that it names, or all but optional ones and those left out. */
static int switch_on(description *d, reader *own, const term_plugin *plugin, const char *single,
                     const line_options *o, line_terms *mine, error *err)
{
    int found = 0;

    for (uint32_t i = 0; i < plugin->d.n_term; i++) {
        const pf_term *t = &plugin->term[i];

        if (!is_on(t, single, o))
            continue;
        found = 1;
        check_dimension(d, own, plugin, t);
        TRY(add_use(d, own->b, plugin, t, mine, err));
        if (!term_has_derivative(t, (enum term_derivative)o->how))
            case_wrong(
                d->c, own->b, "jacobian",
                "%s: jacobian = \"%s\", but %s.%s has no such derivative; leave the key out (\"auto\" takes the "
                "best there is)",
                own->what, derivative_name[o->how], plugin->d.name, t->name);
        mine->use[mine->n - 1]->how = (enum term_derivative)o->how;
        mine->use[mine->n - 1]->inside = o->inside;
        mine->use[mine->n - 1]->label = o->label;
        if (o->inside && term_kind(t) == TERM_PUBLISHES)
            case_wrong(d->c, own->b, "inside",
                       "%s: %s.%s publishes a property, which is needed everywhere: leave \"inside\" out",
                       own->what, plugin->d.name, t->name);
        if (o->over && t->where == PF_CELL)
            mine->use[mine->n - 1]->where = PF_FLUID;
    }
    d->incomplete |= !found;
    if (single && !found)
        no_such_term(d, own->b, NULL, own->what, plugin, single);
    else if (!found)
        case_wrong(d->c, own->b, "without",
                   o->n_without ? "%s: no term is left; leave the line out instead"
                                : "%s: all its terms are off unless they are named, as in only = {\"%s\"}",
                   own->what, plugin->term[0].name);
    return 0;
}

/* A key of the line that two of its terms take as different things. */
static void check_meaning(description *d, const reader *own, const term_use *a, const term_use *b)
{
    for (uint32_t i = 0; i < a->term->n_param; i++) {
        const pf_param *p = &a->term->param[i], *q = describe_param(b, p->name);
        const char *what = q ? term_key_differs(p, q) : NULL;

        if (what && reader_has(own, p->name))
            case_wrong(
                d->c, own->b, p->name,
                "%s: \"%s\" means two things here, of another %s in %s (%s) than in %s (%s): switch each on by a "
                "line of its own, as in term \"%s.%s\" {}",
                own->what, p->name, what, a->term->name, p->doc, b->term->name, q->doc, b->plugin->d.name,
                b->term->name);
    }
}

/* What the terms of a line say about their parameters, and whether one is on already. */
static void check_line(description *d, const reader *own, const line_terms *mine)
{
    for (int i = 0; i < mine->n; i++) {
        const term_use *u = mine->use[i];
        char why[400] = "";

        if (u->term->check && u->term->check(u->params, why, sizeof why))
            case_wrong(d->c, own->b, NULL, "%s: %s", own->what, why);
    }
    for (int i = 0; i < mine->n; i++)
        for (int k = 0; k < i; k++)
            check_meaning(d, own, mine->use[k], mine->use[i]);
    for (int i = 0; i < mine->n; i++)
        if (!describe_check_twice(d, own, mine->use[i]))
            return;
}

/* A line whose terms are known, and whose keys are to be read. */
typedef struct term_line {
    const term_plugin *plugin; /* NULL: there is none */
    reader own;
    line_terms mine;
} term_line;

static int read_term(description *d, registry *r, const case_block *b, int outside, term_line *line, error *err)
{
    const term_plugin *plugin;
    const char *dot = strchr(b->name, '.'), *single = dot ? dot + 1 : NULL;
    char name[128], *what;
    line_options o = {.over = outside};

    snprintf(name, sizeof name, "%.*s", dot ? (int)(dot - b->name) : (int)strlen(b->name), b->name);
    TRY(find_plugin(d, r, b, name, sizeof name, &plugin, err));
    if (!plugin)
        return 0;
    ARENA_NEW(&d->memory, what, strlen(b->name) + 10, err);
    sprintf(what, "term \"%s\"", b->name);
    reader_open(&line->own, d->c, b, what);
    read_options(d, &line->own, plugin, single != NULL, &o);
    TRY(describe_instance(d, &line->own, &o.inside, &o.label, err));
    TRY(switch_on(d, &line->own, plugin, single, &o, &line->mine, err));
    line->plugin = plugin;
    return 0;
}

/* The keys of a line, but for terms that others replace. */
static int read_keys(description *d, reader *fluid, term_line *line, error *err)
{
    line_terms on = {0};

    for (int i = 0; i < line->mine.n; i++)
        if (!line->mine.use[i]->replaced)
            on.use[on.n++] = line->mine.use[i];
    for (int i = 0; i < on.n; i++)
        TRY(describe_term_keys(d, &line->own, fluid, on.use[i], err));
    describe_off_keys(d, &line->own, line->plugin);
    reader_close(&line->own);
    check_line(d, &line->own, &on);
    return 0;
}

/* Whether a term gives an equation for a field on its usual points, and needs no field that the case lacks. */
static int gives_equation(const description *d, const pf_term *t, const field_spec *f)
{
    int rows = 0;

    for (uint32_t o = 0; o < t->n_out; o++)
        rows |= term_slot_field(&t->out[o]) && strcmp(t->out[o].field, f->name) == 0;
    for (uint32_t k = 0; k < t->n_in; k++)
        rows &= !term_slot_field(&t->in[k]) || fields_find(&d->fields, t->in[k].field) >= 0;
    return rows && !(t->flags & PF_OPTIONAL) &&
           (f->support == PF_ON_MESH ? t->where <= PF_FLUID : t->where != PF_FACET);
}

/* A plugin of those that can be found which gives an equation for the field, or NULL. */
static const char *plugin_for(const description *d, registry *r, const field_spec *f)
{
    error ignored;

    if (registry_scan(r, &ignored))
        return NULL;
    for (int i = 0; i < r->n_file; i++) {
        const term_plugin *p = &r->file[i].plugin;

        for (uint32_t k = 0; p->term && k < p->d.n_term; k++)
            if (gives_equation(d, &p->term[k], f))
                return p->d.name;
    }
    return NULL;
}

static void no_equation(description *d, registry *r, const field_spec *f)
{
    const char *plugin = plugin_for(d, r, f);
    const case_block *b = NULL;

    for (int i = d->n_use - 1; i >= 0; i--)
        if (strcmp(d->use[i].plugin->d.name, f->declared_by) == 0)
            b = d->use_block[i];
    case_wrong(d->c, b, NULL,
               "field \"%s\" (%s) is used by plugin \"%s\", but no term gives an equation for it; %s%s%s", f->name,
               f->doc, f->declared_by, plugin ? "term \"" : "switch one on", plugin ? plugin : "",
               plugin ? "\" {} does" : "");
}

/* Adds the fields of a term's slots to those of the case; has_rows: for which there is an equation. */
static int add_fields(description *d, const term_use *u, int *has_rows, error *err)
{
    const pf_term *t = u->term;

    for (uint32_t k = 0; k < t->n_in + t->n_out; k++) {
        const pf_slot *s = k < t->n_in ? &t->in[k] : &t->out[k - t->n_in];

        if (!term_slot_field(s))
            continue;
        TRY(fields_add(&d->fields, d->dim, term_field(u->plugin, s->field), u->plugin->d.name, err));
        has_rows[fields_find(&d->fields, s->field)] |= k >= t->n_in && t->where != PF_FACET;
    }
    return 0;
}

/* Fields of the slots in use; every one needs an equation. */
static int collect_fields(description *d, registry *r, error *err)
{
    int has_rows[TERM_MAX_FIELDS] = {0};

    for (int i = 0; i < d->n_use; i++)
        TRY(add_fields(d, &d->use[i], has_rows, err));
    for (int i = 0; i < d->law.n; i++)
        TRY(add_fields(d, &d->law.use[i], has_rows, err));
    for (int i = 0; i < d->shown.n; i++)
        TRY(add_fields(d, &d->shown.use[i], has_rows, err));
    if (d->incomplete)
        return 0;
    for (int f = 0; f < d->fields.n; f++)
        if (!has_rows[f]) {
            no_equation(d, r, &d->fields.f[f]);
            d->incomplete = 1;
        }
    return 0;
}

int describe_terms(description *d, registry *r, error *err)
{
    static const char *const regions[] = {"everywhere", "outside", NULL};
    const case_block *b;
    term_line *line;
    int outside = 0, n = 0;
    reader fluid;

    while (case_find(d->c, "term", n))
        n++;
    ARENA_NEW(&d->memory, line, n + 1, err);
    n = 0;
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
            d->incomplete = 1;
            continue;
        }
        TRY(read_term(d, r, b, outside, &line[n], err));
        n += line[n].plugin != NULL;
    }
    describe_replace(d, r);
    describe_surfaces(d);
    for (int k = 0; k < n; k++)
        TRY(read_keys(d, &fluid, &line[k], err));
    describe_leave_out(d);
    describe_unshared_keys(d, &fluid);
    TRY(describe_kept(d, err));
    TRY(collect_fields(d, r, err));
    if (!d->incomplete)
        reader_close(&fluid);
    return 0;
}
