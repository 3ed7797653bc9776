/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A term in the place of another that brings its own viscosity: other terms, which take that property, would go on
 * with the number of the case. */
#include "describe/describe.h"

#include <string.h>

/* Whether the term goes by the number of the case. */
static int takes_number(const term_use *u, const char *property)
{
    const pf_param *q = describe_param(u, property);

    for (uint32_t k = 0; k < u->term->n_in; k++)
        if (u->term->in[k].eval == PF_PROPERTY && strcmp(u->term->in[k].field, property) == 0)
            return !u->law[k];
    return q && (q->flags & PF_SHARED);
}

/* Adds "plugin.term (line 7)" of those in the list that go by the number; *held: one of them holds bodies. */
static void list_takers(const term_use *use, const case_block *const *block, int n, const char *property,
                        text *names, int *held)
{
    for (int i = 0; i < n; i++)
        if (takes_number(&use[i], property)) {
            text_add(names, "%s%s.%s (line %d)", names->n ? ", " : "", use[i].plugin->d.name, use[i].term->name,
                     block[i]->line);
            *held |= use[i].where == PF_SURFACE || use[i].where == PF_CUT;
        }
}

/* At the surfaces of bodies the number gives them a wrong force: that is an error; elsewhere it may be meant. */
static void check_property(description *d, const replacement *p, const term_use *by, const case_block *line,
                           const char *property)
{
    text names = {0}, why = {0};
    int held = 0;

    list_takers(d->use, d->use_block, d->n_use, property, &names, &held);
    list_takers(d->shown.use, d->shown.block, d->shown.n, property, &names, &held);
    text_add(
        &why,
        "%s.%s takes the place of %s.%s, which takes \"%s\", and does not take it itself; %s would go on with the "
        "number of the case: publish \"%s\" instead (docs/plugins.md, Properties)",
        by->plugin->d.name, by->term->name, p->plugin->d.name, p->term->name, property, names.s ? names.s : "",
        property);
    if (held)
        case_wrong(d->c, line, NULL, "%s", why.s ? why.s : "");
    else if (names.n)
        describe_warn(d, line, NULL, "%s", why.s ? why.s : "");
    text_free(&why);
    text_free(&names);
}

void describe_check_replaced(description *d)
{
    for (int i = 0; i < d->n_replaced && !d->incomplete; i++) {
        const replacement *p = &d->replaced[i];
        int k = 0;

        while (k < d->n_use && d->use[k].term != p->by)
            k++;
        for (uint32_t s = 0; k < d->n_use && s < p->term->n_in; s++) {
            const pf_slot *slot = &p->term->in[s];

            if (slot->eval == PF_PROPERTY && !term_takes(p->by, slot->field) &&
                !describe_param(&d->use[k], slot->field))
                check_property(d, p, &d->use[k], d->use_block[k], slot->field);
        }
    }
}
