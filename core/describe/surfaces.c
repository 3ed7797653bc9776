/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A plugin of equations in cells may have terms at the surfaces of bodies as well (PF_SURFACE, PF_CUT): what its
 * equations need where a field ends there.  A line for the whole plugin switches them on only then: if there are
 * bodies, and no term has an equation inside of them for a field that these write. */
#include "describe/describe.h"

#include <string.h>

static int is_in_cells(int where)
{
    return where == PF_CELL || where == PF_FLUID;
}

static int has_cells(const term_plugin *p)
{
    for (uint32_t i = 0; i < p->d.n_term; i++)
        if (is_in_cells((int)p->term[i].where))
            return 1;
    return 0;
}

/* Whether a term has an equation for the field in all cells. */
static int goes_on(const description *d, const char *field)
{
    for (int i = 0; i < d->n_use; i++)
        for (uint32_t o = 0; d->use[i].where == PF_CELL && o < d->use[i].term->n_out; o++)
            if (term_slot_field(&d->use[i].term->out[o]) && strcmp(d->use[i].term->out[o].field, field) == 0)
                return 1;
    return 0;
}

static int is_needed(const description *d, const term_use *u)
{
    for (uint32_t o = 0; o < u->term->n_out; o++)
        if (term_slot_field(&u->term->out[o]) && goes_on(d, u->term->out[o].field))
            return 0;
    return case_find(d->c, "particle", 0) || case_find(d->c, "particles", 0);
}

void describe_surfaces(description *d)
{
    for (int i = 0; i < d->n_use; i++) {
        term_use *u = &d->use[i];
        int at_surface = u->where == PF_SURFACE || u->where == PF_CUT, whole = !strchr(d->use_block[i]->name, '.');

        if (at_surface && whole && has_cells(u->plugin) && !is_needed(d, u))
            u->replaced = 1;
    }
}
