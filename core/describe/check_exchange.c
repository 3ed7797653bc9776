/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What equations of the fluid want where bodies are, beyond the formulations that particulate writes: a force that
 * is counted, and a field that is tied where a body leaves too little of a cell. */
#include "describe/describe.h"

#include <string.h>

/* Whether the term has an equation of a field of this support. */
static int writes_support(const description *d, const pf_term *t, int support)
{
    for (uint32_t o = 0; o < t->n_out; o++) {
        const int f = term_slot_field(&t->out[o]) ? fields_find(&d->fields, t->out[o].field) : -1;

        if (f >= 0 && d->fields.f[f].support == support)
            return 1;
    }
    return 0;
}

/* A term that gives a body what it takes from the fluid, and does not say so. */
static void check_forces(description *d)
{
    for (int i = 0; i < d->n_use; i++) {
        const term_use *u = &d->use[i];

        if ((u->where != PF_SURFACE && u->where != PF_SOLID) || (u->term->flags & PF_FLUID_FORCE) ||
            !writes_support(d, u->term, PF_ON_MESH) || !writes_support(d, u->term, PF_ON_PARTICLE))
            continue;
        describe_warn(
            d, d->use_block[i], NULL,
            "%s.%s gives bodies what it takes from the fluid, but that force is missing in particles.csv: "
            "give the term .flags = PF_FLUID_FORCE (docs/plugins.md, Points of bodies)",
            u->plugin->d.name, u->term->name);
    }
}

/* Whether a term on such points has an equation of the field; *line: where it is switched on. */
static int has_equation(const description *d, const char *field, int where, const case_block **line)
{
    for (int i = 0; i < d->n_use; i++)
        for (uint32_t o = 0; d->use[i].where == where && o < d->use[i].term->n_out; o++)
            if (term_slot_field(&d->use[i].term->out[o]) && strcmp(d->use[i].term->out[o].field, field) == 0) {
                *line = d->use_block[i];
                return 1;
            }
    return 0;
}

/* A field that ends at bodies, and that no term ties where they leave too little of a cell. */
static void check_ties(description *d)
{
    const case_block *line, *other;

    for (int f = 0; f < d->fields.n; f++) {
        const field_spec *g = &d->fields.f[f];

        if (g->support == PF_ON_MESH && has_equation(d, g->name, PF_FLUID, &line) &&
            !has_equation(d, g->name, PF_CELL, &other) && !has_equation(d, g->name, PF_CUT, &other))
            describe_warn(
                d, line, NULL,
                "%s (%s) has no tie in cells with too little fluid: where a body leaves a sliver of a cell "
                "hardly anything determines it; add a PF_CUT term (docs/plugins.md, Points of bodies)",
                g->name, g->doc);
    }
}

void describe_check_exchange(description *d)
{
    if (d->incomplete || !d->n_body)
        return;
    check_forces(d);
    check_ties(d);
}
