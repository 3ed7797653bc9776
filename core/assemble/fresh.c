/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Zeroing the matrix: rows of a node right before the first batch that adds to them, so that they go through the
 * memory once; all others beforehand.  A node that two slabs share belongs to one of them, and batches of the
 * interface come last: no other thread is there before the first batch is done. */
#include "assemble/batch.h"

#include <string.h>

/* A class that has every node of the mesh in some batch, whatever the bodies do. */
static int has_all_nodes(const assembly_class *c)
{
    return !c->follows && (c->where == PF_CELL || c->where == PF_FLUID);
}

int fresh_find(const assembly *a, assembly_class *c, arena *memory, error *err)
{
    const space *s = a->space;
    uint8_t *seen;
    arena scratch = {0};
    int64_t n = 0;

    if (!has_all_nodes(c))
        return 0;
    ARENA_NEW(memory, c->first_fresh, c->n_batch + 1, err);
    ARENA_NEW(memory, c->fresh, s->mesh->n_node + 1, err);
    ARENA_NEW(&scratch, seen, s->mesh->n_node + 1, err);
    for (int64_t b = 0; b < c->n_batch; b++) {
        c->first_fresh[b] = n;
        for (int64_t i = c->batch[b]; i < c->batch[b + 1]; i++)
            for (int k = 0; k < s->mesh->type->n_node; k++) {
                int32_t node = space_carrier(s, c->group[i], k);

                if (!seen[node])
                    c->fresh[n++] = node;
                seen[node] = 1;
            }
    }
    c->first_fresh[c->n_batch] = n;
    arena_free(&scratch);
    return 0;
}

/* Rows of carriers from `first` up to `end`, which lie in one piece. */
static void clear_rows(const space *s, int64_t first, int64_t end, double *value)
{
    int64_t from = s->row[s->node_free[first]], to = s->row[s->node_free[end]];

    memset(value + from, 0, (size_t)(to - from) * sizeof *value);
}

void fresh_clear(const assembly *a, const assembly_class *c, int64_t batch, double *value)
{
    for (int64_t i = c->first_fresh[batch]; i < c->first_fresh[batch + 1]; i++)
        clear_rows(a->space, c->fresh[i], c->fresh[i] + 1, value);
}

int fresh_begin(const assembly *a, const assembly_state *s, double *value)
{
    int by_batches = a->n_class > 0 && has_all_nodes(&a->class_[0]) && evaluate_any(a, &a->class_[0], s);

    clear_rows(a->space, by_batches ? a->space->mesh->n_node : 0, a->space->n_carrier, value);
    return by_batches;
}
