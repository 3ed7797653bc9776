/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What has to be computed at the points of a class of cells or facets: the distinct inputs of
 * its terms, the distinct test and trial functions, and which of them couple; its points and cells. */
#include "assemble/batch.h"

#include <stdint.h>
#include <string.h>

enum { FACET_DEGREE = 5 };

static enum basis_kind kind_of(const assembly_class *c, const pf_slot *slot)
{
    if (c->where == PF_PAIR && slot->eval != PF_DEFECT)
        return slot->eval == PF_OTHER ? BASIS_OTHER : BASIS_FIRST;
    switch (slot->eval) {
    case PF_GRAD:
    case PF_DIV:
        return BASIS_GRAD;
    case PF_LAPLACE:
        return BASIS_LAPLACE;
    default:
        return BASIS_VALUE;
    }
}

static void mark_used(assembly_class *c, int order, enum basis_kind kind)
{
    c->order_used[order] = 1;
    c->grad_used[order] |= kind == BASIS_GRAD;
    c->laplace_used[order] |= kind == BASIS_LAPLACE;
    c->any_laplace |= kind == BASIS_LAPLACE;
}

/* data, key: where what is no field comes from, or NULL. */
static int find_input(assembly_class *c, const space *s, const pf_slot *slot, const value *data, const double *key,
                      error *err)
{
    int f = term_slot_field(slot) ? space_find_field(s, slot->field) : -1;
    int kept = slot->eval == PF_STATE ? kept_find(&s->kept, slot->field) : -1;
    plan_input *in;

    for (int i = 0; i < c->n_input; i++)
        if (c->input[i].field == f && c->input[i].eval == slot->eval && c->input[i].data == data &&
            c->input[i].key == key && c->input[i].kept == kept)
            return i;
    if (c->n_input == ASSEMBLE_MAX_INPUTS)
        return -error_set(err, ERR_PLUGIN, "the terms need more than %d different inputs", ASSEMBLE_MAX_INPUTS);
    in = &c->input[c->n_input];
    *in = (plan_input){.field = f, .eval = slot->eval, .data = data, .key = key, .kept = kept, .at = c->in_size};
    in->n_comp = term_components(slot->shape, s->mesh->dim);
    c->any_kept |= kept >= 0;
    c->in_size += (size_t)in->n_comp;
    if (f >= 0) {
        mark_used(c, s->field[f].order, kind_of(c, slot));
        if (slot->eval == PF_DOT && c->where == PF_FLUID) /* see moving_frame */
            c->grad_used[s->field[f].order] = 1;
    }
    return c->n_input++;
}

static int find_basis(assembly_class *c, const space *s, plan_basis *list, int *n, const pf_slot *slot, error *err)
{
    int f = space_find_field(s, slot->field);
    enum basis_kind kind = kind_of(c, slot);
    plan_basis *b = &list[*n];

    for (int i = 0; i < *n; i++)
        if (list[i].field == f && list[i].kind == kind)
            return i;
    if (*n == ASSEMBLE_MAX_TESTS)
        return -error_set(err, ERR_PLUGIN, "the terms need more than %d different test functions",
                          ASSEMBLE_MAX_TESTS);
    *b = (plan_basis){
        .field = f, .kind = kind, .n_comp = s->field[f].n_comp * (kind == BASIS_GRAD ? s->mesh->dim : 1)};
    mark_used(c, s->field[f].order, kind);
    return (*n)++;
}

static size_t max_size(size_t a, size_t b)
{
    return a > b ? a : b;
}

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

/* Adds one term; marks the blocks of D that it can fill. */
static int add_use(assembly_class *c, const space *s, term_use *use, error *err)
{
    const pf_term *t = use->term;
    plan_use *p = &c->use[c->n_use++];
    size_t out = 0, jac = 0;
    int dim = s->mesh->dim;

    p->use = use;
    p->inside = -1;
    if (use->inside) {
        p->inside = find_input(c, s, &(pf_slot){.eval = PF_DATA, .shape = PF_SCALAR}, use->inside, NULL, err);
        if (p->inside < 0)
            return err->code;
    }
    c->any_metric |= (t->flags & PF_METRIC) != 0;
    c->any_wall |= (t->flags & PF_WALL_DISTANCE) != 0;
    c->any_body_data |= use->plugin->d.min_minor >= 4;
    for (uint32_t k = 0; k < t->n_in; k++) {
        const pf_slot *slot = &t->in[k];

        p->in[k] = find_input(c, s, slot, use->data[k], use->key[k], err);
        p->trial[k] = term_is_unknown(slot) ? find_basis(c, s, c->trial, &c->n_trial, slot, err) : -1;
        p->slope[k] = slot->eval == PF_DOT && c->where == PF_FLUID
                          ? find_basis(c, s, c->trial, &c->n_trial,
                                       &(pf_slot){.field = slot->field, .shape = slot->shape, .eval = PF_GRAD}, err)
                          : -1;
        if (p->in[k] < 0 || (term_is_unknown(slot) && p->trial[k] < 0) ||
            (slot->eval == PF_DOT && c->where == PF_FLUID && p->slope[k] < 0))
            return err->code;
    }
    for (uint32_t o = 0; o < t->n_out; o++) {
        const int keeps = t->out[o].eval == PF_STATE;

        p->out[o] = keeps ? -1 : find_basis(c, s, c->test, &c->n_test, &t->out[o], err);
        p->kept[o] = keeps ? find_input(c, s, &t->out[o], NULL, NULL, err) : -1;
        if (p->out[o] < 0 && p->kept[o] < 0)
            return err->code;
        p->equations |= !keeps;
        out += (size_t)term_components(t->out[o].shape, dim);
        for (uint32_t k = 0; k < t->n_in; k++) {
            jac += (size_t)(term_components(t->out[o].shape, dim) * term_components(t->in[k].shape, dim));
            if (keeps)
                continue;
            if (p->trial[k] >= 0 && (!t->depends || t->depends[o * t->n_in + k]))
                c->block[p->out[o]][p->trial[k]] = 0;
            if (p->slope[k] >= 0 && (!t->depends || t->depends[o * t->n_in + k]))
                c->block[p->out[o]][p->slope[k]] = 0;
        }
    }
    c->out_size = max_size(c->out_size, out);
    c->jac_size = max_size(c->jac_size, jac);
    c->scratch_size = max_size(c->scratch_size, t->scratch_bytes);
    c->room_size = max_size(c->room_size, term_jacobian_room(t, dim, PF_LANES) / sizeof(v8));
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
        c->serial |= s->field[c->test[t].field].support == PF_ON_PROBLEM; /* one row for all cells */
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
