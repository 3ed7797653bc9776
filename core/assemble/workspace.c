/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Room of a thread: for the largest batch of any class. */
#include "assemble/batch.h"

/* Numbers of v8, of bytes in `scratch`, of unknowns and columns in `entries` and `width`. */
typedef struct sizes {
    size_t q, node, basis[3], in, test, block, out, jac, room, scratch, filled, entries, width, stages, chain,
        product;
    size_t body_q; /* points of the classes that are on bodies */
    int laplace[3], own[3], metric;
} sizes;

static void raise(size_t *most, size_t n)
{
    *most = n > *most ? n : *most;
}

static sizes find_sizes(const assembly *a)
{
    const fe_cell *type = a->space->mesh->type;
    sizes s = {.q = 1, .node = (size_t)assemble_padded(type->n_node)};

    for (int i = 0; i < a->n_class; i++) {
        const assembly_class *c = &a->class_[i];
        size_t nq = (size_t)c->n_q;

        raise(&s.q, nq);
        raise(&s.in, c->in_size * nq);
        raise(&s.test, c->test_size * nq);
        raise(&s.block, c->block_size * nq);
        raise(&s.filled, c->block_size);
        raise(&s.out, c->out_size * nq);
        raise(&s.jac, c->jac_size * nq);
        raise(&s.room, c->room_size * nq);
        raise(&s.scratch, c->scratch_size);
        raise(&s.chain, c->chain_size * nq);
        raise(&s.product, c->product_size * nq);
        raise(&s.entries, (size_t)c->layout.n);
        raise(&s.width, (size_t)c->layout.width);
        raise(&s.stages, c->tensor ? tensor_room(type->dim, c->tensor->n) : 0);
        s.metric |= c->any_metric;
        if (c->any_body_data && c->where != PF_CELL && c->where != PF_FLUID && c->where != PF_FACET)
            raise(&s.body_q, nq);
        for (int order = 0; order < 3; order++) {
            raise(&s.basis[order], (size_t)assemble_padded(c->n_basis[order]));
            raise(&s.node, s.basis[order]);
            s.laplace[order] |= c->laplace_used[order];
            s.own[order] |= c->own_used[order];
        }
    }
    return s;
}

/* Points and bases. */
static int room_for_geometry(const sizes *s, size_t dim, workspace *w, error *err)
{
    arena *memory = &w->memory;
    size_t q = s->q;

    ARENA_NEW(memory, w->x_node, s->node * dim, err);
    ARENA_NEW(memory, w->w, q, err);
    ARENA_NEW(memory, w->x, q * dim, err);
    ARENA_NEW(memory, w->normal, q * dim, err);
    ARENA_NEW(memory, w->h, q, err);
    ARENA_NEW(memory, w->arm, q * dim, err);
    ARENA_NEW(memory, w->density, q, err);
    ARENA_NEW(memory, w->gap, q, err);
    for (int i = 0; i < 2; i++)
        ARENA_NEW(memory, w->size[i], q, err);
    ARENA_NEW(memory, w->other_density, q, err);
    ARENA_NEW(memory, w->id, q * PF_LANES, err);
    for (int order = 0; order < 3; order++)
        for (size_t k = 0; k < BASIS_ROWS; k++)
            if (k <= dim || (k == LAPLACE_ROW && s->laplace[order]) || (k == OWN_ROW && s->own[order]))
                ARENA_NEW(memory, w->basis[order][k], (s->basis[order] + 1) * q, err);
    if (s->metric)
        ARENA_NEW(memory, w->metric, q * dim * dim, err);
    if (s->stages) {
        ARENA_NEW(memory, w->inverse, q * dim * dim, err);
        ARENA_NEW(memory, w->reference, q * (2 * TENSOR_KINDS * TENSOR_KINDS + 1), err);
        ARENA_NEW(memory, w->stages, s->stages, err);
    }
    return 0;
}

/* Of any field, and not less than a spin in space has. */
static size_t most_components(const space *s)
{
    size_t most = 3;

    for (int f = 0; f < s->n_field; f++)
        raise(&most, (size_t)s->field[f].n_comp);
    return most;
}

int workspace_create(const assembly *a, workspace *w, error *err)
{
    size_t dim = (size_t)a->space->mesh->dim, n_comp = most_components(a->space);
    sizes s = find_sizes(a);
    arena *memory = &w->memory;

    TRY(room_for_geometry(&s, dim, w, err));
    if (s.body_q)
        TRY(body_data_room(s.body_q, dim, w, err));
    ARENA_NEW(memory, w->rate, s.q * n_comp * (dim + 1), err);
    ARENA_NEW(memory, w->dof, s.node * n_comp, err);
    ARENA_NEW(memory, w->in, s.in + 1, err);
    ARENA_NEW(memory, w->test, s.test + 1, err);
    ARENA_NEW(memory, w->unknown, s.test + 1, err);
    ARENA_NEW(memory, w->still, s.q * n_comp, err);
    ARENA_NEW(memory, w->power, a->n_use + 1, err);
    ARENA_NEW(memory, w->block, s.block + 1, err);
    ARENA_NEW(memory, w->filled, s.filled + 1, err);
    ARENA_NEW(memory, w->out, s.out + 1, err);
    ARENA_NEW(memory, w->jac, s.jac + 1, err);
    ARENA_NEW(memory, w->room, s.room + 1, err);
    ARENA_NEW(memory, w->chain, s.chain + 1, err);
    ARENA_NEW(memory, w->product, s.product + 1, err);
    ARENA_NEW(memory, w->g, TEST_ROWS * ASSEMBLE_PAD * s.q, err);
    ARENA_NEW(memory, w->vec, s.entries + 1, err);
    if (a->space->kept.n)
        ARENA_NEW(memory, w->kept, (int64_t)s.q * VALUE_MAX, err);
    ARENA_NEW(memory, w->mat, s.entries * s.width + 1, err);
    ARENA_NEW(memory, w->mask, s.q * PF_LANES, err);
    w->scratch = arena_alloc(memory, s.scratch + 1, 1);
    return w->scratch ? 0 : error_memory(err, "scratch", (double)s.scratch);
}
