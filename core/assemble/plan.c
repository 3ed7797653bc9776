/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What has to be computed at the points of a class of cells or facets: the distinct inputs of
 * its terms, the distinct test and trial functions, and which of them couple; its points and cells. */
#include "assemble/batch.h"

#include <stdint.h>
#include <string.h>

enum { FACET_DEGREE = 5 };

/* The number of a term, the same on the points of all classes. */
static int number_use(assembly *a, term_use *use)
{
    int i = 0;

    while (i < a->n_use && a->use[i] != use)
        i++;
    if (i == a->n_use)
        a->use[a->n_use++] = use;
    return i;
}

/* Marks the blocks of D that output o of a term can fill by its slot k. */
static void couple(assembly_class *c, plan_use *p, uint32_t o, uint32_t k, int dim)
{
    const size_t rows = (size_t)term_components(p->use->term->out[o].shape, dim);

    if (p->trial[k] >= 0)
        c->block[p->out[o]][p->trial[k]] = 0;
    if (p->slope[k] >= 0)
        c->block[p->out[o]][p->slope[k]] = 0;
    for (int i = 0; i < c->n_chain; i++) {
        const plan_chain *chain = &c->chain[i];

        if (chain->property != p->in[k])
            continue;
        p->varies = 1;
        c->block[p->out[o]][chain->trial] = 0;
        if (chain->slope >= 0)
            c->block[p->out[o]][chain->slope] = 0;
        if (c->product_size < rows * (size_t)term_components(chain->slot->shape, dim))
            c->product_size = rows * (size_t)term_components(chain->slot->shape, dim);
    }
}

/* Adds one term; marks the blocks of D that it can fill. */
static int add_use(assembly_class *c, const space *s, term_use *use, error *err)
{
    const pf_term *t = use->term;
    plan_use *p = &c->use[c->n_use++];
    const int shows = term_kind(t) == TERM_SHOWS; /* nothing is solved for: no derivatives */

    p->use = use;
    p->inside = -1;
    if (use->inside) {
        p->inside = slots_input(c, s, &(pf_slot){.eval = PF_DATA, .shape = PF_SCALAR}, use->inside, NULL, err);
        if (p->inside < 0)
            return err->code;
    }
    c->any_body_data |= use->plugin->d.min_minor >= 4;
    for (uint32_t k = 0; k < t->n_in; k++) {
        p->in[k] = slots_find(c, s, use, k, err);
        if (p->in[k] < 0)
            return err->code;
        p->trial[k] = p->slope[k] = -1;
        if (!shows)
            TRY(slots_trial(c, s, &t->in[k], &p->trial[k], &p->slope[k], err));
    }
    for (uint32_t o = 0; o < t->n_out; o++) {
        const int keeps = t->out[o].eval == PF_STATE;

        p->out[o] = keeps   ? -1
                    : shows ? slots_shown(c, s, &t->out[o], err)
                            : slots_basis(c, s, c->test, &c->n_test, &t->out[o], err);
        p->kept[o] = keeps ? slots_input(c, s, &t->out[o], NULL, NULL, err) : -1;
        if (p->out[o] < 0 && p->kept[o] < 0)
            return err->code;
        p->equations |= !keeps;
        for (uint32_t k = 0; k < t->n_in && !keeps && !shows; k++)
            if (!t->depends || t->depends[o * t->n_in + k])
                couple(c, p, o, k, s->mesh->dim);
    }
    slots_sizes(c, t, s->mesh->dim);
    return 0;
}

/* Second derivatives of the basis at the points of rule f, of the mapping and of the orders that are asked for. */
static int place_second(assembly *a, assembly_class *c, int f, error *err)
{
    const fe_cell *type = a->space->mesh->type;
    const fe_rule *r = &c->rule[f];

    for (int order = 0; order < 3; order++) {
        int n = fe_n_basis(type, order);

        if (order < 2 && !c->laplace_used[order])
            continue;
        ARENA_NEW(&a->memory, c->d2n_ref[f][order], r->n * n, err);
        for (int q = 0; q < r->n; q++)
            fe_basis_second(type, order, r->x[q], c->d2n_ref[f][order] + q * n);
    }
    return 0;
}

static int place_rules(assembly *a, assembly_class *c, const cut_rule *cut, error *err)
{
    const fe_cell *type = a->space->mesh->type;
    int n_rule = c->where == PF_FACET ? type->n_facet : 1;

    for (int f = 0; f < n_rule; f++) {
        fe_rule *r = &c->rule[f];

        if (c->where == PF_FACET) {
            TRY(fe_rule_facet(type, f, FACET_DEGREE, r, c->tangent[f], &c->orient[f], err));
        } else if (c->where == PF_PAIR || c->where == PF_PARTICLE) {
            r->n = 1; /* any point of the cell: weight 1, and no field of the mesh */
        } else if (c->where == PF_SURFACE) {
            r->n = SURFACE_POINTS; /* where they are comes with the bodies */
        } else if (cut) {
            r->n = cut->n;
            memcpy(r->x, cut->x, (size_t)cut->n * sizeof *r->x);
        } else {
            TRY(fe_rule_cell(type, ASSEMBLE_CELL_DEGREE, r, err));
        }
        c->n_q = r->n;
        for (int order = 0; order < 3; order++) {
            int n = fe_n_basis(type, order);

            ARENA_NEW(&a->memory, c->n_ref[f][order], r->n * n, err);
            ARENA_NEW(&a->memory, c->dn_ref[f][order], r->n * n, err);
            for (int q = 0; q < r->n; q++)
                fe_basis(type, order, r->x[q], c->n_ref[f][order] + q * n, c->dn_ref[f][order] + q * n);
        }
        if (c->any_laplace)
            TRY(place_second(a, c, f, err));
    }
    return 0;
}

static int place_items(assembly *a, assembly_class *c, const assembly_spec *spec, error *err)
{
    const mesh *m = a->space->mesh;
    int64_t n = 0;

    for (int64_t f = 0; spec->where == PF_FACET && f < m->n_facet; f++)
        n += spec->facet_on[f];
    TRY(items_room(c, spec->where == PF_FACET ? n : m->n_cell, &a->memory, err));
    n = 0;
    for (int64_t f = 0; spec->where == PF_FACET && f < m->n_facet; f++)
        if (spec->facet_on[f]) {
            c->cell[n] = m->facet[f].cell;
            c->facet[n++] = m->facet[f].local;
        }
    for (int64_t i = 0; i < c->n_item; i++) {
        if (spec->where != PF_FACET)
            c->cell[i] = (int32_t)i;
        c->group[i] = c->cell[i];
    }
    return items_order(a, c, &a->memory, err);
}

int plan_create(assembly *a, assembly_class *c, const assembly_spec *spec, error *err)
{
    const space *s = a->space;

    c->where = spec->where;
    c->follows = spec->rule != NULL || spec->where == PF_PAIR || spec->where == PF_PARTICLE ||
                 spec->where == PF_SURFACE || spec->where == PF_CUT;
    c->serial = c->where == PF_FACET || c->where == PF_PAIR || c->where == PF_PARTICLE;
    for (int order = 0; order < 3; order++)
        c->n_basis[order] =
            fe_n_basis(s->mesh->type, order) * (c->where == PF_CUT || (c->where == PF_PAIR && order == 0) ? 2 : 1);
    memset(c->block, 0xff, sizeof c->block);
    for (int i = 0; i < 2 * spec->n_use; i++) { /* those with PF_LAST after all others */
        term_use *use = spec->use[i % spec->n_use];

        if (((use->term->flags & PF_LAST) != 0) != (i >= spec->n_use))
            continue;
        if (c->n_use == ASSEMBLE_MAX_USES)
            return error_set(err, ERR_PLUGIN, "more than %d terms act on the same points", ASSEMBLE_MAX_USES);
        TRY(add_use(c, s, use, err));
        c->use[c->n_use - 1].number = number_use(a, use);
    }
    for (int t = 0; t < c->n_test; t++) {
        c->test[t].at = c->test_size;
        c->test_size += (size_t)c->test[t].n_comp;
        c->serial |= c->test[t].field >= 0 &&
                     s->field[c->test[t].field].support == PF_ON_PROBLEM; /* one row for all cells */
        for (int r = 0; r < c->n_trial; r++)
            if (c->block[t][r] == 0) {
                c->block[t][r] = c->block_size;
                c->block_size += (size_t)(c->test[t].n_comp * c->trial[r].n_comp);
            }
    }
    TRY(place_rules(a, c, spec->rule, err));
    if (c->any_kept)
        TRY(kept_place(a, c, err));
    TRY(layout_create(a, c, err));
    TRY(layout_tensor(a, c, err));
    if (c->follows)
        return 0; /* its items come with the bodies */
    return place_items(a, c, spec, err);
}
