/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Rows of bodies that several slabs add to.  The first slab of a round at a body adds to the residual and the
 * matrix themselves, each later one to a copy of its own, zero at first; the copies are added in the order of the
 * slabs.
 */
#include "assemble/batch.h"

#include <stdlib.h>
#include <string.h>

int shares_find(assembly *a, assembly_class *c, arena *memory, error *err)
{
    const space *s = a->space;
    int on_bodies = c->where == PF_SOLID || c->where == PF_SURFACE;
    int32_t *first;

    c->n_share = 0;
    c->share_of = NULL;
    if (!on_bodies || c->n_slab == 1)
        return 0;
    ARENA_NEW(memory, first, s->n_particle + 1, err);
    ARENA_NEW(memory, c->share_of, (int64_t)SLAB_ROUNDS * c->n_slab * s->n_particle + 1, err);
    ARENA_NEW(memory, c->share, (int64_t)SLAB_ROUNDS * c->n_slab * s->n_particle + 1, err);
    for (int slab = 0; slab < SLAB_ROUNDS * c->n_slab; slab++) {
        if (slab % c->n_slab == 0) /* another round */
            memset(first, 0, (size_t)s->n_particle * sizeof *first);
        for (int64_t i = c->batch[c->slab[slab]]; i < c->batch[c->slab[slab + 1]]; i++) {
            int32_t body = s->attached_particle[c->group[i] - space_attached_group(s, 0)];
            int32_t *share = &c->share_of[(int64_t)slab * s->n_particle + body];

            if (!first[body])
                first[body] = slab + 1;
            if (first[body] == slab + 1 || *share)
                continue;
            c->share[c->n_share++] = (body_share){.carrier = space_body_carrier(s, body)};
            *share = c->n_share;
        }
    }
    return 0;
}

int shares_clear(assembly *a, assembly_class *c, int with_matrix, error *err)
{
    const space *s = a->space;
    int64_t n = 0;

    for (int k = 0; k < c->n_share; k++) {
        body_share *b = &c->share[k];

        b->first_value = s->row[s->node_free[b->carrier]];
        b->n_value = with_matrix ? s->row[s->node_free[b->carrier + 1]] - b->first_value : 0;
        b->at = n;
        n += c->layout.n + b->n_value;
    }
    if (n > a->share_room) {
        arena_free(&a->share_memory);
        a->share_room = 0;
        ARENA_NEW(&a->share_memory, a->share_sum, n, err);
        a->share_room = n;
    }
    if (n)
        memset(a->share_sum, 0, (size_t)n * sizeof *a->share_sum);
    return 0;
}

const body_share *shares_at(const assembly *a, const assembly_class *c, int slab, int64_t item)
{
    const space *s = a->space;
    int64_t body;
    int32_t k;

    if (!c->n_share || slab == SLAB_ROUNDS * c->n_slab)
        return NULL;
    body = s->attached_particle[c->group[item] - space_attached_group(s, 0)];
    k = c->share_of[(int64_t)slab * s->n_particle + body];
    return k ? &c->share[k - 1] : NULL;
}

void shares_add(const assembly *a, const assembly_class *c, double *residual, double *value)
{
    const space *s = a->space;
    const element_layout *p = &c->layout;

    for (int k = 0; k < c->n_share; k++) {
        const body_share *b = &c->share[k];
        const double *sum = a->share_sum + b->at;

        for (int e = 0; e < p->n; e++) /* entries of a body: one field after the other, component by component */
            if (s->field[p->field[e]].support == PF_ON_PARTICLE)
                residual[s->first[p->field[e]][b->carrier] + e - p->at[p->field[e]][0]] += sum[e];
        for (int64_t i = 0; i < b->n_value; i++)
            value[b->first_value + i] += sum[p->n + i];
    }
}
