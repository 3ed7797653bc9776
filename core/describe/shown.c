/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What the terms of a case show: names of fields and columns, each once, and points that there are. */
#include "describe/describe.h"

#include <stdio.h>
#include <string.h>

int describe_shows(const description *d, int where)
{
    for (int i = 0; i < d->shown.n; i++)
        if (d->shown.use[i].where == where)
            return 1;
    return 0;
}

const char *describe_who_shows(registry *r, const char *name)
{
    error ignored;

    if (registry_scan(r, &ignored))
        return NULL;
    for (int i = 0; i < r->n_file; i++) {
        const term_plugin *p = r->file[i].refused ? NULL : &r->file[i].plugin;

        for (uint32_t k = 0; p && p->term && k < p->d.n_term; k++)
            for (uint32_t o = 0; o < p->term[k].n_out; o++)
                if (p->term[k].out[o].eval == PF_SHOW && strcmp(p->term[k].out[o].name, name) == 0) {
                    char *full = arena_alloc(&r->memory, strlen(p->d.name) + strlen(p->term[k].name) + 2, 1);

                    if (full)
                        sprintf(full, "%s.%s", p->d.name, p->term[k].name);
                    return full;
                }
    }
    return NULL;
}

/* Whether two lines that give integrals of the same name give the same column. */
static int same_column(const term_use *a, const term_use *b)
{
    const char *x = a->label ? a->label : "", *y = b->label ? b->label : "";

    return a->term->where == b->term->where && strcmp(x, y) == 0;
}

/* The term with an output before this one that has the same name, in files of fields or in the same table, or NULL.
 * Lines of one term, each with its part of the domain, give one field together. */
static const term_use *namesake(const description *d, int use, const pf_slot *slot)
{
    for (int i = 0; i < use; i++)
        for (uint32_t o = 0; o < d->shown.use[i].term->n_out; o++) {
            const pf_slot *other = &d->shown.use[i].term->out[o];

            if (other->eval == slot->eval && strcmp(other->name, slot->name) == 0 &&
                (slot->eval == PF_SHOW ? other != slot : same_column(&d->shown.use[i], &d->shown.use[use])))
                return &d->shown.use[i];
        }
    return NULL;
}

static int add_field(description *d, const term_use *u, const pf_slot *slot, error *err)
{
    const pf_field f = {.name = slot->name,
                        .unit = slot->unit,
                        .doc = slot->doc,
                        .shape = slot->shape,
                        .order = 1,
                        .support = PF_ON_MESH};

    return fields_add(&d->shown_fields, d->dim, &f, u->plugin->d.name, err);
}

static int any_pairs(const description *d)
{
    for (int i = 0; i < d->n_use; i++)
        if (d->use[i].where == PF_PAIR)
            return 1;
    return 0;
}

static void check_points(const description *d, const term_use *u, const case_block *b)
{
    const uint32_t where = u->term->where;

    if (where >= PF_SOLID && where != PF_FACET && d->n_body == 0)
        case_wrong(d->c, b, NULL, "term \"%s\": %s.%s is about bodies, and the case has none", b->name,
                   u->plugin->d.name, u->term->name);
    else if (where == PF_PAIR && !any_pairs(d))
        case_wrong(d->c, b, NULL,
                   "term \"%s\": %s.%s is about near pairs, which are looked for where a term acts on them; switch "
                   "one on, as term \"contact.lubrication\" {}",
                   b->name, u->plugin->d.name, u->term->name);
}

static int add_slot(description *d, int k, const pf_slot *slot, error *err)
{
    const term_use *u = &d->shown.use[k], *other = namesake(d, k, slot);
    const case_block *b = d->shown.block[k];

    if (slot->eval == PF_SHOW &&
        (fields_find(&d->fields, slot->name) >= 0 || fields_find(&d->kept, slot->name) >= 0))
        case_wrong(d->c, b, NULL, "term \"%s\": %s.%s shows \"%s\", and the case has a field of that name", b->name,
                   u->plugin->d.name, u->term->name, slot->name);
    else if (other)
        case_wrong(d->c, b, NULL, "term \"%s\": %s.%s shows \"%s\", and so does %s.%s%s", b->name,
                   u->plugin->d.name, u->term->name, slot->name, other->plugin->d.name, other->term->name,
                   other->term == u->term ? "; give each line a name = \"...\" for its columns" : "");
    else if (slot->eval == PF_SHOW)
        return add_field(d, u, slot, err);
    return 0;
}

int describe_shown(description *d, error *err)
{
    for (int k = 0; k < d->shown.n; k++) {
        const term_use *u = &d->shown.use[k];

        check_points(d, u, d->shown.block[k]);
        for (uint32_t o = 0; o < u->term->n_out; o++)
            TRY(add_slot(d, k, &u->term->out[o], err));
    }
    return 0;
}
