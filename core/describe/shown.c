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

/* The output before this one that has the same name, in files of fields or in the same table; its term, or NULL. */
static const term_use *namesake(const description *d, int use, const pf_slot *slot)
{
    for (int i = 0; i <= use; i++)
        for (uint32_t o = 0; o < d->shown.use[i].term->n_out; o++) {
            const pf_slot *other = &d->shown.use[i].term->out[o];

            if (other == slot)
                return NULL;
            if (other->eval == slot->eval && strcmp(other->name, slot->name) == 0 &&
                (slot->eval == PF_SHOW || d->shown.use[i].term->where == d->shown.use[use].term->where))
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

static int add_use(description *d, int k, error *err)
{
    const term_use *u = &d->shown.use[k];
    const case_block *b = d->shown.block[k];
    const pf_term *t = u->term;

    if (t->where >= PF_SOLID && t->where != PF_FACET && d->n_body == 0)
        case_wrong(d->c, b, NULL, "term \"%s\": %s.%s is about bodies, and the case has none", b->name,
                   u->plugin->d.name, t->name);
    for (uint32_t o = 0; o < t->n_out; o++) {
        const pf_slot *slot = &t->out[o];
        const term_use *other = namesake(d, k, slot);
        const int field = slot->eval == PF_SHOW ? fields_find(&d->fields, slot->name) : -1;

        if (other || field >= 0)
            case_wrong(d->c, b, NULL, "term \"%s\": %s.%s shows \"%s\", and so does %s%s%s", b->name,
                       u->plugin->d.name, t->name, slot->name,
                       other ? other->plugin->d.name : "a field of the case", other ? "." : "",
                       other ? other->term->name : "");
        else if (slot->eval == PF_SHOW)
            TRY(add_field(d, u, slot, err));
    }
    return 0;
}

int describe_shown(description *d, error *err)
{
    for (int k = 0; k < d->shown.n; k++)
        TRY(add_use(d, k, err));
    return 0;
}
