/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Values of nodes that lie in bodies, where the fluid's unknowns have no equations: the motion of the body.
 * They are what history finds where its path (paths.c) leads below the surface. */
#include "body/body.h"

#include <stdlib.h>

/* Idle nodes of a covered cell; those that an earlier cell filled stay. */
static void fill_cell(const bodies *b, const placement *p, int f, int64_t a, uint8_t *filled, double *x)
{
    const space *s = b->space;
    const mesh *m = s->mesh;
    int body = s->attached_particle[a];

    for (int i = 0; i < m->type->n_node; i++) {
        int32_t node = m->cell[(int64_t)s->attached_cell[a] * m->type->n_node + i];
        int64_t d = s->first[f][node];
        double at[3] = {0}, v[3];

        if (d < 0 || !p->idle[d] || filled[s->dof_node[d]])
            continue;
        filled[s->dof_node[d]] = 1;
        for (int k = 0; k < m->dim; k++) /* in the frame of the body itself, not of its image */
            at[k] = m->x[(int64_t)node * m->dim + k] - b->envelope.shift[a][k];
        bodies_velocity(b, &p->body[body].at, x, body, at, v);
        for (int k = 0; k < m->dim; k++)
            if (!s->fixed[d + k])
                x[d + k] = v[k];
    }
}

int bodies_fill(const bodies *b, const placement *p, double *x, error *err)
{
    int f = bodies_moved_field(b);
    uint8_t *filled;

    if (f < 0)
        return 0;
    filled = calloc((size_t)b->space->n_carrier, 1);
    if (!filled)
        return error_memory(err, "nodes inside bodies", (double)b->space->n_carrier);
    for (int64_t k = 0; k < p->n_covered; k++)
        fill_cell(b, p, f, p->covered[k], filled, x);
    free(filled);
    return 0;
}
