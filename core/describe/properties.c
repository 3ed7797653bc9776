/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Properties: which term publishes what another one takes.  Where none does, it is a number that the case gives.
 * What would have no effect is refused: a property that no term takes, a number beside a term that publishes it. */
#include "describe/describe.h"

#include <stdio.h>
#include <string.h>

/* "momentum.viscous" */
typedef struct full_name {
    char s[128];
} full_name;

static full_name name_of(const term_plugin *p, const pf_term *t)
{
    full_name n;

    snprintf(n.s, sizeof n.s, "%s.%s", p->d.name, t->name);
    return n;
}

static full_name name_of_use(const term_use *u)
{
    return name_of(u->plugin, u->term);
}

/* Terms that are on: equations, publishers, what is shown. */
static int count(const description *d)
{
    return d->n_use + d->law.n + d->shown.n;
}

/* Inside of bodies a publisher there comes before one in the fluid, and serves no other points. */
static const term_use *publisher(const description *d, const char *property, int where)
{
    const term_use *found = NULL;

    for (int i = 0; i < d->law.n; i++) {
        const term_use *law = &d->law.use[i];

        if (term_publishes(law->term, property) < 0 || (law->where == PF_SOLID && where != PF_SOLID))
            continue;
        if (!found || law->where == PF_SOLID)
            found = law;
    }
    return found;
}

/* Two that publish one property at the same points. */
static void check_rivals(description *d)
{
    for (int i = 0; i < d->law.n; i++)
        for (int k = 0; k < i; k++)
            for (uint32_t o = 0; o < d->law.use[i].term->n_out; o++) {
                const term_use *a = &d->law.use[k], *b = &d->law.use[i];

                if ((a->where == PF_SOLID) != (b->where == PF_SOLID) ||
                    term_publishes(a->term, b->term->out[o].field) < 0)
                    continue;
                case_wrong(d->c, d->law.block[i], NULL,
                           "\"%s\" is published by %s (line %d) and by %s (line %d); one of them must go",
                           b->term->out[o].field, name_of_use(a).s, d->law.block[k]->line, name_of_use(b).s,
                           d->law.block[i]->line);
            }
}

/* A term of some plugin that takes the property, "" if there is none. */
static full_name taker(registry *r, const char *property)
{
    full_name none = {""};
    error ignored;

    if (registry_scan(r, &ignored))
        return none;
    for (int i = 0; i < r->n_file; i++) {
        const term_plugin *p = &r->file[i].plugin;

        for (uint32_t k = 0; p->term && k < p->d.n_term; k++)
            if (term_kind(&p->term[k]) == TERM_EQUATION && p->term[k].where <= PF_FLUID &&
                !(p->term[k].flags & PF_OPTIONAL) && term_takes(&p->term[k], property))
                return name_of(p, &p->term[k]);
    }
    return none;
}

/* A property that no term takes. */
static void check_taken(description *d, registry *r)
{
    for (int i = 0; i < d->law.n; i++)
        for (uint32_t o = 0; o < d->law.use[i].term->n_out; o++) {
            const char *property = d->law.use[i].term->out[o].field;
            const case_block *line;
            full_name other;
            int taken = 0;

            for (int k = 0; k < count(d); k++) {
                const term_use *u = describe_use(d, k, &line);

                taken |= term_takes(u->term, property) && publisher(d, property, u->where) == &d->law.use[i];
            }
            if (taken)
                continue;
            other = taker(r, property);
            case_wrong(d->c, d->law.block[i], NULL,
                       "\"%s\" is published by %s (line %d), but no term of the case takes it%s%s%s", property,
                       name_of_use(&d->law.use[i]).s, d->law.block[i]->line, *other.s ? "; " : "", other.s,
                       *other.s ? " would" : "");
        }
}

/* Whether some term takes fluid{}'s key as a number that is no property. */
static int is_number(description *d, const char *key)
{
    const case_block *line;
    int found = 0;

    for (int i = 0; i < count(d); i++) {
        const term_use *u = describe_use(d, i, &line);
        const pf_param *q = describe_param(u, key);

        found |= q && (q->flags & PF_SHARED) && !term_takes(u->term, key);
    }
    return found;
}

/* The numbers of a term: one that has to be there and is not published; one that nobody would use. */
static void check_number(description *d, const term_use *u, const case_block *line, uint32_t i)
{
    const pf_param *q = &u->term->param[i];
    const term_use *law = publisher(d, q->name, u->where);

    if (!term_takes(u->term, q->name)) {
        if (law && u->given >> i & 1)
            describe_warn(d, line, q->name, "%s takes \"%s\" as a number, %s publishes it: the same fluid has two",
                          name_of_use(u).s, q->name, name_of_use(law).s);
        return;
    }
    if (!law && (u->missing >> i & 1))
        describe_missing(d, line, q);
    if (law && (u->given >> i & 1)) {
        reader own;

        reader_open(&own, d->c, line, "");
        if (reader_has(&own, q->name) || !is_number(d, q->name))
            case_wrong(d->c, reader_has(&own, q->name) ? line : case_find(d->c, "fluid", 0), q->name,
                       "\"%s\" is given here, but %s publishes it: this number would not be used; take it out",
                       q->name, name_of_use(law).s);
    }
}

/* What a term takes against what is published. */
static void bind(description *d, term_use *u, const case_block *line, uint32_t k)
{
    const pf_slot *slot = &u->term->in[k], *out;
    const term_use *law = publisher(d, slot->field, u->where);

    if (!law) {
        if (!term_number(u, slot))
            case_wrong(d->c, line, NULL, "%s takes \"%s\"%s%s, which no term of the case publishes",
                       name_of_use(u).s, slot->field, slot->doc ? ", " : "", slot->doc ? slot->doc : "");
        return;
    }
    out = &law->term->out[term_publishes(law->term, slot->field)];
    if (out->shape != slot->shape || (slot->unit && strcmp(out->unit, slot->unit) != 0))
        case_wrong(d->c, line, NULL,
                   "%s takes \"%s\" as another quantity (%d components, %s) than %s publishes "
                   "(%d components, %s)",
                   name_of_use(u).s, slot->field, term_components(slot->shape, d->dim),
                   slot->unit ? slot->unit : "no unit", name_of_use(law).s, term_components(out->shape, d->dim),
                   out->unit);
    else if (u->where == PF_PARTICLE)
        case_wrong(d->c, line, NULL, "%s takes \"%s\", which %s publishes in the fluid, at the centre of a body",
                   name_of_use(u).s, slot->field, name_of_use(law).s);
    u->law[k] = law;
}

/* A law that needs itself: from `law`, through laws in `path`. */
static int find_circle(const term_use *law, const term_use **path, int n)
{
    for (int i = 0; i < n; i++)
        if (path[i] == law)
            return 1;
    if (n == DESCRIBE_MAX_TERMS)
        return 0;
    path[n] = law;
    for (uint32_t k = 0; k < law->term->n_in; k++)
        if (law->law[k] && find_circle(law->law[k], path, n + 1))
            return 1;
    return 0;
}

static void check_circles(description *d)
{
    for (int i = 0; i < d->law.n; i++) {
        const term_use *path[DESCRIBE_MAX_TERMS] = {NULL};
        text names = {0};

        if (!find_circle(&d->law.use[i], path, 0))
            continue;
        for (int k = 0; k < DESCRIBE_MAX_TERMS && path[k]; k++)
            text_add(&names, "%s%s", k ? " takes what is published by " : "", name_of_use(path[k]).s);
        case_wrong(d->c, d->law.block[i], NULL, "properties go round in a circle: %s, and so on",
                   names.s ? names.s : "");
        text_free(&names);
        d->incomplete = 1;
        return;
    }
}

/* A density that differs from place to place has no hydrostatic pressure that could be left out. */
static void check_reduced(description *d)
{
    for (int i = 0; i < d->n_use; i++) {
        const term_use *u = &d->use[i], *law = publisher(d, "density", u->where);
        const pf_param *q = describe_param(u, "reduced_pressure");
        int on = 0;

        if (!law || !q || q->type != PF_T_BOOL || !term_takes(u->term, "density"))
            continue;
        memcpy(&on, (const char *)u->params + q->offset, sizeof on);
        if (on) {
            case_wrong(d->c, case_find(d->c, "fluid", 0), "reduced_pressure",
                       "reduced_pressure leaves the weight of a fluid of one density to the pressure, but %s "
                       "publishes \"density\": the weight would be lost; take reduced_pressure out",
                       name_of_use(law).s);
            return;
        }
    }
}

void describe_properties(description *d, registry *r)
{
    const case_block *line;

    if (!d->incomplete)
        check_rivals(d);
    for (int i = 0; i < count(d); i++) {
        term_use *u = describe_use(d, i, &line);

        if (u->inside && term_kind(u->term) == TERM_PUBLISHES)
            case_wrong(d->c, line, "inside", "%s publishes a property, which is everywhere: take inside out",
                       name_of_use(u).s);
        for (uint32_t k = 0; k < u->term->n_param; k++)
            check_number(d, u, line, k);
        for (uint32_t k = 0; k < u->term->n_in; k++)
            if (u->term->in[k].eval == PF_PROPERTY)
                bind(d, u, line, k);
    }
    if (d->incomplete)
        return;
    check_circles(d);
    check_taken(d, r);
    check_reduced(d);
}
