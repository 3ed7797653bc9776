/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The fluid near bodies that move, extrapolated in time along the paths of its history (paths.c). */
#include "body/body.h"

#include <string.h>

/* Of one node. */
static void extrapolate_node(bodies *b, int64_t cell, int32_t node, int32_t carrier, double *x)
{
    const space *s = b->space;
    double at[3] = {0}, w[3], value[SPACE_MAX_FIELDS * VALUE_MAX], *v = value;

    memcpy(at, s->mesh->x + (int64_t)node * s->mesh->dim, (size_t)s->mesh->dim * sizeof *at);
    if (!paths_at(b, cell, at, w, value))
        return;
    for (int f = 0; f < s->n_field; f++) {
        int64_t d = s->first[f][carrier];

        if (!(b->paths.frame.fields >> f & 1))
            continue;
        for (int a = 0; d >= 0 && a < s->field[f].n_comp; a++)
            x[d + a] = v[a];
        v += s->field[f].n_comp;
    }
}

void bodies_extrapolate(bodies *b, const placement *now, int levels, const double *c, const double *const *u,
                        const pose *const *then, double *x)
{
    const mesh *m = b->space->mesh;
    body_paths *t = &b->paths;

    if (!t->frame.fields || !paths_take(b, now, levels, c, u, then))
        return;
    memset(t->seen, 0, (size_t)b->space->n_carrier);
    for (int64_t k = 0; k < m->n_cell; k++)
        for (int i = 0; t->cell[k] && i < m->type->n_node; i++) {
            int32_t node = m->cell[k * m->type->n_node + i], carrier = space_master(b->space, node);

            if (!t->seen[carrier])
                extrapolate_node(b, k, node, carrier, x);
            t->seen[carrier] = 1;
        }
}
