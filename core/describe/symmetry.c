/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The planes of boundary "..." { symmetry = true }. */
#include "describe/describe.h"

#include "mesh/facet.h"

#include <math.h>

static void add_plane(const mesh *m, int64_t f, const char *name, symmetry_plane *plane, int *n)
{
    const int32_t *cell = m->cell + (int64_t)m->facet[f].cell * m->type->n_node;
    int axis = facet_axis(m, f);
    double at;

    if (axis < 0)
        return;
    at = m->x[(int64_t)cell[m->type->facet[m->facet[f].local][0]] * m->dim + axis];
    for (int i = 0; i < *n; i++)
        if (plane[i].axis == axis && fabs(plane[i].at - at) < 1e-7 * m->h[m->facet[f].cell])
            return;
    if (*n < DESCRIBE_MAX_PLANES)
        plane[(*n)++] = (symmetry_plane){axis, at, name};
}

int describe_planes(const description *d, const mesh *m, symmetry_plane *plane, int *n, error *err)
{
    arena scratch = {0};
    uint8_t *on;

    *n = 0;
    ARENA_NEW(&scratch, on, m->n_facet + 1, err);
    for (int i = 0; i < d->n_line; i++) {
        if (!d->line[i].symmetry)
            continue;
        describe_facets(d, m, i, on);
        for (int64_t f = 0; f < m->n_facet; f++)
            if (on[f])
                add_plane(m, f, d->line[i].name, plane, n);
    }
    arena_free(&scratch);
    return 0;
}
