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
    switch (slot->eval) {
    case PF_GRAD:
    case PF_DIV:
        return BASIS_GRAD;
    case PF_LAPLACE:
        return BASIS_LAPLACE;
    default:
        return c->where == PF_CUT && slot->eval != PF_DEFECT ? BASIS_OWN : BASIS_VALUE;
    }
}

static void mark_used(assembly_class *c, int order, enum basis_kind kind)
{
    c->order_used[order] = 1;
    c->grad_used[order] |= kind == BASIS_GRAD;
    c->laplace_used[order] |= kind == BASIS_LAPLACE;
    c->own_used[order] |= kind == BASIS_OWN;
    c->any_laplace |= kind == BASIS_LAPLACE;
}

static plan_input *new_input(assembly_class *c, uint32_t eval, int n_comp, error *err)
{
    plan_input *in = &c->input[c->n_input];

    if (c->n_input == ASSEMBLE_MAX_INPUTS) {
        error_set(err, ERR_PLUGIN, "the terms need more than %d different inputs", ASSEMBLE_MAX_INPUTS);
        return NULL;
    }
    *in = (plan_input){.field = -1, .eval = eval, .n_comp = n_comp, .at = c->in_size};
    c->in_size += (size_t)n_comp;
    c->n_input++;
    return in;
}

/* Slot k of a term, as input[]; but for properties. */
static int find_input(assembly_class *c, const space *s, const pf_slot *slot, const value *data, error *err)
{
    int f = slot->eval == PF_DATA ? -1 : space_find_field(s, slot->field);
    plan_input *in;

    for (int i = 0; i < c->n_input; i++)
        if (c->input[i].field == f && c->input[i].eval == slot->eval && c->input[i].data == data)
            return i;
    in = new_input(c, slot->eval, term_components(slot->shape, s->mesh->dim), err);
    if (!in)
        return -1;
    in->field = f;
    in->data = data;
    in->frozen = f >= 0 && c->where == PF_PAIR && s->field[f].support != PF_ON_PARTICLE;
    if (f >= 0 && !in->frozen) {
        mark_used(c, s->field[f].order, kind_of(c, slot));
        if (slot->eval == PF_DOT && c->where == PF_FLUID) /* see moving_frame */
            c->grad_used[s->field[f].order] = 1;
    }
    return (int)(in - c->input);
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

/* Test functions of an unknown, and of its slopes where it is a rate in the fluid. */
static int find_trial(assembly_class *c, const space *s, const pf_slot *slot, int *trial, int *slope, error *err)
{
    const pf_slot gradient = {.field = slot->field, .shape = slot->shape, .eval = PF_GRAD};

    *trial = *slope = -1;
    if (!term_is_unknown(slot))
        return 0;
    *trial = find_basis(c, s, c->trial, &c->n_trial, slot, err);
    if (*trial >= 0 && slot->eval == PF_DOT && c->where == PF_FLUID)
        *slope = find_basis(c, s, c->trial, &c->n_trial, &gradient, err);
    return *trial < 0 || (slot->eval == PF_DOT && c->where == PF_FLUID && *slope < 0) ? err->code : 0;
}

/* Room for the outputs of a term and their derivatives. */
static void raise_sizes(assembly_class *c, const pf_term *t, int dim)
{
    size_t out = 0, jac = 0;

    for (uint32_t o = 0; o < t->n_out; o++) {
        out += (size_t)term_components(t->out[o].shape, dim);
        for (uint32_t k = 0; k < t->n_in; k++)
            jac += (size_t)(term_components(t->out[o].shape, dim) * term_components(t->in[k].shape, dim));
    }
    c->any_metric |= (t->flags & PF_METRIC) != 0;
    c->out_size = max_size(c->out_size, out);
    c->jac_size = max_size(c->jac_size, jac);
    c->scratch_size = max_size(c->scratch_size, t->scratch_bytes);
    c->room_size = max_size(c->room_size, term_jacobian_room(t, dim, PF_LANES) / sizeof(v8));
}

/* Notes that a property depends on an unknown, once. */
static int add_chain(assembly_class *c, int dim, plan_chain chain, error *err)
{
    for (int i = 0; i < c->n_chain; i++)
        if (c->chain[i].property == chain.property && c->chain[i].unknown == chain.unknown)
            return 0;
    if (c->n_chain == ASSEMBLE_MAX_CHAINS)
        return error_set(err, ERR_PLUGIN, "the properties depend on more than %d unknowns", ASSEMBLE_MAX_CHAINS);
    chain.at = c->chain_size;
    c->chain_size += (size_t)(c->input[chain.property].n_comp * term_components(chain.slot->shape, dim));
    c->chain[c->n_chain++] = chain;
    return 0;
}

/* What the outputs of a law depend on by way of its slot k: an unknown, or those of another property. */
static int add_chains(assembly_class *c, const space *s, const plan_law *l, uint32_t k, error *err)
{
    const pf_term *t = l->use->term;
    const pf_slot *slot = &t->in[k];
    const int before = c->n_chain, dim = s->mesh->dim;
    plan_chain own = {.unknown = l->in[k], .slot = slot};

    if (c->where == PF_PAIR || !term_is_derived(slot))
        return 0;
    TRY(find_trial(c, s, slot, &own.trial, &own.slope, err));
    for (uint32_t o = 0; o < t->n_out; o++) {
        if (t->depends && !t->depends[o * t->n_in + k])
            continue;
        own.property = l->out[o];
        if (slot->eval != PF_PROPERTY)
            TRY(add_chain(c, dim, own, err));
        for (int i = 0; i < before; i++)
            if (slot->eval == PF_PROPERTY && c->chain[i].property == l->in[k]) {
                plan_chain far = c->chain[i];

                far.property = l->out[o];
                TRY(add_chain(c, dim, far, err));
            }
    }
    return 0;
}

/* What a law takes has to be there, at points that are none of its own kind. */
static int check_law(const assembly_class *c, const space *s, const term_use *law, error *err)
{
    const pf_term *t = law->term;

    for (uint32_t k = 0; k < t->n_in; k++) {
        const int f = term_slot_field(&t->in[k]) ? space_find_field(s, t->in[k].field) : -1;
        const int pair = c->where == PF_PAIR, cut = c->where == PF_CUT;

        if ((pair && (t->in[k].eval == PF_LAPLACE || t->flags & PF_METRIC)) ||
            (cut && f >= 0 && s->field[f].support != PF_ON_MESH))
            return error_set(err, ERR_PLUGIN,
                             "%s.%s publishes what a term on %s points takes, where \"%s\" (%s) is not there",
                             law->plugin->d.name, t->name, term_where_name((uint32_t)c->where), t->in[k].name,
                             t->flags & PF_METRIC ? "or the metric" : term_eval_name(t->in[k].eval));
    }
    return 0;
}

static int find_slot(assembly_class *c, const space *s, const term_use *use, uint32_t k, error *err);

/* Adds a publisher, after those that it takes properties of. */
static int add_law(assembly_class *c, const space *s, const term_use *law, error *err)
{
    const pf_term *t = law->term;
    plan_law l = {.use = law};

    TRY(check_law(c, s, law, err));
    for (uint32_t k = 0; k < t->n_in; k++) {
        l.in[k] = find_slot(c, s, law, k, err);
        if (l.in[k] < 0)
            return err->code;
    }
    if (c->n_law == ASSEMBLE_MAX_LAWS)
        return error_set(err, ERR_PLUGIN, "more than %d terms publish properties", ASSEMBLE_MAX_LAWS);
    for (uint32_t o = 0; o < t->n_out; o++) {
        plan_input *in = new_input(c, PF_PROPERTY, term_components(t->out[o].shape, s->mesh->dim), err);

        if (!in)
            return err->code;
        in->law = law;
        l.out[o] = (int)(in - c->input);
    }
    c->law[c->n_law++] = l;
    raise_sizes(c, t, s->mesh->dim);
    for (uint32_t k = 0; k < t->n_in; k++)
        TRY(add_chains(c, s, &l, k, err));
    return 0;
}

/* A property: what its publisher gives, else the term's own number. */
static int find_property(assembly_class *c, const space *s, const term_use *use, uint32_t k, error *err)
{
    const pf_slot *slot = &use->term->in[k];
    const term_use *law = use->law[k];
    const double *number = law ? NULL : term_number(use, slot);
    plan_input *in;

    if (!law && !number)
        return -error_set(err, ERR_PLUGIN, "%s.%s takes \"%s\", which no term publishes", use->plugin->d.name,
                          use->term->name, slot->field);
    for (int i = 0; number && i < c->n_input; i++)
        if (c->input[i].number == number)
            return i;
    for (int i = 0; law && i < c->n_law; i++)
        if (c->law[i].use == law)
            return c->law[i].out[term_publishes(law->term, slot->field)];
    if (law)
        return add_law(c, s, law, err) ? -1 : c->law[c->n_law - 1].out[term_publishes(law->term, slot->field)];
    in = new_input(c, PF_PROPERTY, term_components(slot->shape, s->mesh->dim), err);
    if (!in)
        return -1;
    in->number = number;
    return (int)(in - c->input);
}

static int find_slot(assembly_class *c, const space *s, const term_use *use, uint32_t k, error *err)
{
    return use->term->in[k].eval == PF_PROPERTY ? find_property(c, s, use, k, err)
                                                : find_input(c, s, &use->term->in[k], use->data[k], err);
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
        c->product_size = max_size(c->product_size, rows * (size_t)term_components(chain->slot->shape, dim));
    }
}

/* Adds one term; marks the blocks of D that it can fill. */
static int add_use(assembly_class *c, const space *s, term_use *use, error *err)
{
    const pf_term *t = use->term;
    plan_use *p = &c->use[c->n_use++];

    p->use = use;
    for (uint32_t k = 0; k < t->n_in; k++) {
        p->in[k] = find_slot(c, s, use, k, err);
        if (p->in[k] < 0)
            return err->code;
        TRY(find_trial(c, s, &t->in[k], &p->trial[k], &p->slope[k], err));
    }
    for (uint32_t o = 0; o < t->n_out; o++) {
        p->out[o] = find_basis(c, s, c->test, &c->n_test, &t->out[o], err);
        if (p->out[o] < 0)
            return err->code;
        for (uint32_t k = 0; k < t->n_in; k++)
            if (!t->depends || t->depends[o * t->n_in + k])
                couple(c, p, o, k, s->mesh->dim);
    }
    raise_sizes(c, t, s->mesh->dim);
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
        } else if (c->where == PF_PAIR) {
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
    c->follows = spec->rule != NULL || spec->where == PF_PAIR || spec->where == PF_SURFACE || spec->where == PF_CUT;
    c->serial = c->where == PF_FACET || c->where == PF_PAIR;
    for (int order = 0; order < 3; order++)
        c->n_basis[order] =
            fe_n_basis(s->mesh->type, order) * (c->where == PF_CUT || (c->where == PF_PAIR && order == 0) ? 2 : 1);
    memset(c->block, 0xff, sizeof c->block);
    for (int i = 0; i < spec->n_use; i++) {
        if (i == ASSEMBLE_MAX_USES)
            return error_set(err, ERR_PLUGIN, "more than %d terms act on the same points", ASSEMBLE_MAX_USES);
        TRY(add_use(c, s, spec->use[i], err));
        c->use[i].number = number_use(a, spec->use[i]);
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
    TRY(layout_create(a, c, err));
    TRY(layout_tensor(a, c, err));
    if (c->follows)
        return 0; /* its items come with the bodies */
    return place_items(a, c, spec, err);
}
