/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The order of the items of a class: slabs for the threads, and what two slabs share.
 *
 * A node belongs to the first slab that has an item at it; items of later slabs at such a node make up the
 * interface, which one thread does when the slabs are done.  Rows of a body, which may reach through several slabs,
 * are summed by each slab on its own, and added in the order of the slabs (shares.c). */
#include "assemble/batch.h"

#include <stdlib.h>
#include <string.h>

enum { LEAST_BATCHES = 8 }; /* a slab: fewer are not worth waiting for a thread */

/* An item and its place in the order of the class. */
typedef struct place {
    int64_t key, item;
    int slab;
} place;

static int by_key(const void *a, const void *b)
{
    const place *p = a, *q = b;

    return p->key != q->key ? (p->key > q->key) - (p->key < q->key) : (p->item > q->item) - (p->item < q->item);
}

static int by_slab(const void *a, const void *b)
{
    const place *p = a, *q = b;

    return p->slab != q->slab ? p->slab - q->slab : by_key(a, b);
}

/* Splits the items of the list that have no slab yet (-1) into n equal ones along the order, numbered from `first`
 * on. Items at nodes of an earlier one of these stay without.  owner: [n_node] room. */
static void assign(const assembly *a, const assembly_class *c, place *list, int first, int n, uint16_t *owner)
{
    const space *s = a->space;
    int64_t left = 0, at = 0, per;

    for (int64_t i = 0; i < c->n_item; i++)
        left += list[i].slab < 0;
    per = (left + n - 1) / n;
    memset(owner, 0, (size_t)s->mesh->n_node * sizeof *owner);
    for (int64_t i = 0; i < c->n_item; i++) {
        int64_t group = c->group[list[i].item];
        int slab, size = space_group_size(s, group);

        if (list[i].slab >= 0)
            continue;
        slab = list[i].slab = first + (int)(at++ / per);
        for (int k = 0; k < size; k++) {
            int32_t node = space_carrier(s, group, k);

            if (node < 0 || node >= s->mesh->n_node)
                continue;
            if (owner[node] == 0)
                owner[node] = (uint16_t)(slab + 1);
            if (owner[node] != slab + 1)
                list[i].slab = -1;
        }
    }
}

/* Slabs of all rounds; what is left after the last one is for one thread. */
static int assign_rounds(const assembly *a, const assembly_class *c, place *list, error *err)
{
    arena scratch = {0};
    uint16_t *owner;

    ARENA_NEW(&scratch, owner, a->space->mesh->n_node + 1, err);
    for (int64_t i = 0; i < c->n_item; i++)
        list[i].slab = -1;
    for (int round = 0; round < SLAB_ROUNDS; round++) {
        int64_t left = 0, n;

        for (int64_t i = 0; i < c->n_item; i++)
            left += list[i].slab < 0;
        n = left / (LEAST_BATCHES * PF_LANES);
        if (n > 1)
            assign(a, c, list, round * c->n_slab, n < c->n_slab ? (int)n : c->n_slab, owner);
    }
    for (int64_t i = 0; i < c->n_item; i++)
        if (list[i].slab < 0)
            list[i].slab = SLAB_ROUNDS * c->n_slab;
    arena_free(&scratch);
    return 0;
}

/* Items in the order of the list, and batches of them: of one slab and, of facets, with the same local number. */
static int arrange(assembly_class *c, const place *list, arena *memory, error *err)
{
    int32_t *cell = c->cell, *facet = c->facet, *source = c->source;
    int64_t *group = c->group;
    int slab = 0;

    ARENA_NEW(memory, c->cell, c->n_item + 1, err);
    ARENA_NEW(memory, c->facet, c->n_item + 1, err);
    ARENA_NEW(memory, c->source, c->n_item + 1, err);
    ARENA_NEW(memory, c->group, c->n_item + 1, err);
    ARENA_NEW(memory, c->batch, c->n_item + 1, err);
    ARENA_NEW(memory, c->slab, SLAB_ROUNDS * c->n_slab + 2, err);
    c->n_batch = 0;
    for (int64_t at = 0; at < c->n_item; at++) {
        int64_t from = list[at].item;
        int fresh = at == 0 || list[at].slab != list[at - 1].slab;

        c->cell[at] = cell[from];
        c->facet[at] = facet[from];
        c->source[at] = source[from];
        c->group[at] = group[from];
        for (; slab < list[at].slab; slab++)
            c->slab[slab + 1] = c->n_batch;
        if (fresh || at - c->batch[c->n_batch - 1] == PF_LANES || c->facet[at] != c->facet[at - 1])
            c->batch[c->n_batch++] = at;
    }
    for (; slab <= SLAB_ROUNDS * c->n_slab; slab++)
        c->slab[slab + 1] = c->n_batch;
    c->batch[c->n_batch] = c->n_item;
    return 0;
}

int slabs_make(assembly *a, assembly_class *c, arena *memory, error *err)
{
    int64_t most = c->n_item / (LEAST_BATCHES * PF_LANES);
    arena scratch = {0};
    place *list;
    int status = 0;

    c->n_slab = c->serial || most < 1 ? 1 : most < a->n_thread ? (int)most : a->n_thread;
    ARENA_NEW(&scratch, list, c->n_item + 1, err);
    for (int64_t i = 0; i < c->n_item; i++)
        list[i] = (place){c->facet[i] * a->space->mesh->n_cell + c->cell[i], i, 0};
    qsort(list, (size_t)c->n_item, sizeof *list, by_key);
    if (c->n_slab > 1) {
        status = assign_rounds(a, c, list, err);
        qsort(list, (size_t)c->n_item, sizeof *list, by_slab);
    }
    if (!status)
        status = arrange(c, list, memory, err);
    arena_free(&scratch);
    return status ? status : shares_find(a, c, memory, err);
}
