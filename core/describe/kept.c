/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Memory of the terms that are on: its fields, who keeps them, what they start from. */
#include "describe/describe.h"

#include <string.h>

/* A term, or one that publishes or shows, by number; NULL after the last. */
static const term_use *use_at(const description *d, int i)
{
    if (i < d->n_use)
        return &d->use[i];
    i -= d->n_use;
    if (i < d->law.n)
        return &d->law.use[i];
    i -= d->law.n;
    return i < d->shown.n ? &d->shown.use[i] : NULL;
}

static const case_block *line_at(const description *d, int i)
{
    if (i < d->n_use)
        return d->use_block[i];
    i -= d->n_use;
    return i < d->law.n ? d->law.block[i] : d->shown.block[i - d->law.n];
}

int describe_kept(description *d, error *err)
{
    const term_use *u;

    for (int i = 0; (u = use_at(d, i)); i++)
        for (uint32_t k = 0; k < u->term->n_in + u->term->n_out; k++) {
            const pf_slot *s = k < u->term->n_in ? &u->term->in[k] : &u->term->out[k - u->term->n_in];

            if (s->eval == PF_STATE)
                TRY(fields_add(&d->kept, d->dim, term_field(u->plugin, s->field), u->plugin->d.name, err));
        }
    return 0;
}

void describe_initial_kept(description *d, reader *r)
{
    for (int f = 0; f < d->kept.n; f++)
        d->has_kept[f] = describe_value(r, d->kept.f[f].name, d->kept.f[f].doc, d->kept.f[f].n_comp, d->dim,
                                        &d->kept_initial[f]) > 0;
}

static int has_slot(const pf_slot *slot, uint32_t n, const char *field)
{
    for (uint32_t k = 0; k < n; k++)
        if (slot[k].eval == PF_STATE && strcmp(slot[k].field, field) == 0)
            return 1;
    return 0;
}

/* One term keeps a field, all who use it do so on one side of the surfaces of bodies. */
static void check_field(const description *d, const field_spec *f)
{
    const term_use *u, *keeper = NULL, *fluid = NULL, *solid = NULL;
    const case_block *b = NULL;

    for (int i = 0; (u = use_at(d, i)); i++) {
        const int keeps = has_slot(u->term->out, u->term->n_out, f->name);

        if (!keeps && !has_slot(u->term->in, u->term->n_in, f->name))
            continue;
        b = line_at(d, i);
        if (keeps && keeper && keeper->term != u->term)
            case_wrong(
                d->c, b, NULL, "%s.%s and %s.%s both keep \"%s\" (%s): one of them needs a memory of its own",
                keeper->plugin->d.name, keeper->term->name, u->plugin->d.name, u->term->name, f->name, f->doc);
        keeper = keeps ? u : keeper;
        fluid = u->where == PF_FLUID && d->n_body ? u : fluid;
        solid = u->where == PF_SOLID ? u : solid;
    }
    if (!keeper)
        case_wrong(
            d->c, b, NULL,
            "\"%s\" (%s) is memory that a term reads, but none that is on keeps it: switch on the one of plugin "
            "\"%s\" that does",
            f->name, f->doc, f->declared_by);
    if (fluid && solid)
        case_wrong(d->c, b, NULL,
                   "%s.%s uses \"%s\" in the fluid and %s.%s inside of bodies: memory is of one of them",
                   fluid->plugin->d.name, fluid->term->name, f->name, solid->plugin->d.name, solid->term->name);
    if (!d->time.unsteady)
        case_wrong(
            d->c, b, NULL,
            "%s keeps \"%s\" (%s) from step to step, and a steady case has no steps: add time { step = ..., stop "
            "= ... }",
            keeper ? keeper->plugin->d.name : f->declared_by, f->name, f->doc);
}

void describe_check_kept(const description *d)
{
    for (int f = 0; !d->incomplete && f < d->kept.n; f++) {
        if (fields_find(&d->fields, d->kept.f[f].name) >= 0)
            case_wrong(d->c, NULL, NULL, "\"%s\" is an unknown of plugin \"%s\" and memory of plugin \"%s\"",
                       d->kept.f[f].name, d->fields.f[fields_find(&d->fields, d->kept.f[f].name)].declared_by,
                       d->kept.f[f].declared_by);
        check_field(d, &d->kept.f[f]);
    }
}
