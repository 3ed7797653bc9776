/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What the terms of a class take: the distinct inputs, test and trial functions; properties, with the terms that
 * publish them and what they depend on. */
#include "assemble/batch.h"

#include <stdint.h>
#include <string.h>

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
    *in = (plan_input){.field = -1, .kept = -1, .eval = eval, .n_comp = n_comp, .at = c->in_size};
    c->in_size += (size_t)n_comp;
    c->n_input++;
    return in;
}

int slots_input(assembly_class *c, const space *s, const pf_slot *slot, const value *data, const double *key,
                error *err)
{
    int f = term_slot_field(slot) ? space_find_field(s, slot->field) : -1;
    int kept = slot->eval == PF_STATE ? kept_find(&s->kept, slot->field) : -1;
    plan_input *in;

    for (int i = 0; i < c->n_input; i++)
        if (c->input[i].field == f && c->input[i].eval == slot->eval && c->input[i].data == data &&
            c->input[i].key == key && c->input[i].kept == kept)
            return i;
    in = new_input(c, slot->eval, term_components(slot->shape, s->mesh->dim), err);
    if (!in)
        return -1;
    in->field = f;
    in->data = data;
    in->key = key;
    in->kept = kept;
    in->frozen = f >= 0 && c->where == PF_PAIR && s->field[f].support != PF_ON_PARTICLE;
    c->any_kept |= kept >= 0;
    if (f >= 0 && !in->frozen) {
        mark_used(c, s->field[f].order, kind_of(c, slot));
        if (slot->eval == PF_DOT && c->where == PF_FLUID) /* see moving_frame */
            c->grad_used[s->field[f].order] = 1;
    }
    return (int)(in - c->input);
}

int slots_basis(assembly_class *c, const space *s, plan_basis *list, int *n, const pf_slot *slot, error *err)
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

int slots_shown(assembly_class *c, const space *s, const pf_slot *slot, error *err)
{
    if (c->n_test == ASSEMBLE_MAX_TESTS)
        return -error_set(err, ERR_PLUGIN, "more than %d quantities are shown of the same points",
                          ASSEMBLE_MAX_TESTS);
    c->test[c->n_test] = (plan_basis){.field = -1, .n_comp = term_components(slot->shape, s->mesh->dim)};
    return c->n_test++;
}

static size_t max_size(size_t a, size_t b)
{
    return a > b ? a : b;
}

/* Test functions of an unknown, and of its slopes where it is a rate in the fluid. */
int slots_trial(assembly_class *c, const space *s, const pf_slot *slot, int *trial, int *slope, error *err)
{
    const pf_slot gradient = {.field = slot->field, .shape = slot->shape, .eval = PF_GRAD};

    *trial = *slope = -1;
    if (!term_is_unknown(slot))
        return 0;
    *trial = slots_basis(c, s, c->trial, &c->n_trial, slot, err);
    if (*trial >= 0 && slot->eval == PF_DOT && c->where == PF_FLUID)
        *slope = slots_basis(c, s, c->trial, &c->n_trial, &gradient, err);
    return *trial < 0 || (slot->eval == PF_DOT && c->where == PF_FLUID && *slope < 0) ? err->code : 0;
}

/* Room for the outputs of a term and their derivatives. */
void slots_sizes(assembly_class *c, const pf_term *t, int dim)
{
    size_t out = 0, jac = 0;

    for (uint32_t o = 0; o < t->n_out; o++) {
        out += (size_t)term_components(t->out[o].shape, dim);
        for (uint32_t k = 0; k < t->n_in; k++)
            jac += (size_t)(term_components(t->out[o].shape, dim) * term_components(t->in[k].shape, dim));
    }
    c->any_metric |= (t->flags & PF_METRIC) != 0;
    c->any_wall |= (t->flags & PF_WALL_DISTANCE) != 0;
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
    TRY(slots_trial(c, s, slot, &own.trial, &own.slope, err));
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

        if ((pair && (t->in[k].eval == PF_LAPLACE || t->in[k].eval == PF_STATE || t->flags & PF_METRIC)) ||
            (cut && f >= 0 && s->field[f].support != PF_ON_MESH))
            return error_set(err, ERR_PLUGIN,
                             "%s.%s publishes what a term on %s points takes, where \"%s\" (%s) is not there",
                             law->plugin->d.name, t->name, term_where_name((uint32_t)c->where), t->in[k].name,
                             t->flags & PF_METRIC ? "or the metric" : term_eval_name(t->in[k].eval));
    }
    return 0;
}

/* Adds a publisher, after those that it takes properties of. */
static int add_law(assembly_class *c, const space *s, const term_use *law, error *err)
{
    const pf_term *t = law->term;
    plan_law l = {.use = law};

    TRY(check_law(c, s, law, err));
    for (uint32_t k = 0; k < t->n_in; k++) {
        l.in[k] = slots_find(c, s, law, k, err);
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
    slots_sizes(c, t, s->mesh->dim);
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

int slots_find(assembly_class *c, const space *s, const term_use *use, uint32_t k, error *err)
{
    return use->term->in[k].eval == PF_PROPERTY
               ? find_property(c, s, use, k, err)
               : slots_input(c, s, &use->term->in[k], use->data[k], use->key[k], err);
}
