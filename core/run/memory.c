/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Memory of terms in the results: in files of fields its mean over each cell, of bodies a column of particles.csv.
 */
#include "run/run.h"

#include <stdio.h>
#include <string.h>

static int order_zero(const run *r, int f, vtu_cells *to, arena *memory, error *err)
{
    const space *s = &r->p->space;
    const int n_comp = s->field[f].n_comp;
    double *v;

    if (!space_of_cells(&s->field[f]))
        return 0;
    ARENA_NEW(memory, v, s->mesh->n_cell * n_comp + 1, err);
    for (int64_t e = 0; e < s->mesh->n_cell; e++)
        memcpy(v + e * n_comp, r->shown + s->first[f][space_cell_carrier(s, e)], (size_t)n_comp * sizeof *v);
    to->field[to->n] = &s->field[f];
    to->value[to->n++] = v;
    return 0;
}

int cell_fields(const run *r, vtu_cells *to, arena *memory, error *err)
{
    const kept_fields *k = &r->p->space.kept;

    to->n = 0;
    for (int f = 0; f < k->n; f++) {
        double *mean;

        if (k->field[f].support != PF_AT_POINTS || !(r->p->description.output.kept >> f & 1))
            continue;
        ARENA_NEW(memory, mean, k->mesh->n_cell * k->field[f].n_comp + 1, err);
        kept_means(k, f, r->p->state.kept, mean);
        to->field[to->n] = &k->field[f];
        to->value[to->n++] = mean;
    }
    for (int i = 0; i < r->p->description.output.n_field; i++)
        TRY(order_zero(r, r->p->description.output.field[i], to, memory, err));
    return 0;
}

int kept_columns(const run *r, char (*name)[OFF_MESH_NAME])
{
    const kept_fields *k = &r->p->space.kept;
    int n = 0;

    for (int f = 0; f < k->n; f++)
        for (int i = 0; k->field[f].support == PF_KEPT_BY_PARTICLE && i < k->field[f].n_comp; i++, n++)
            if (k->field[f].n_comp == 1)
                snprintf(name[n], sizeof *name, "%s", k->field[f].name);
            else
                snprintf(name[n], sizeof *name, "%s_%s", k->field[f].name,
                         term_component((uint32_t)k->field[f].shape, k->field[f].n_comp, i));
    return n;
}

double *kept_of_body(const run *r, int body, double *to)
{
    const kept_fields *k = &r->p->space.kept;

    for (int f = 0; f < k->n; f++)
        if (k->field[f].support == PF_KEPT_BY_PARTICLE) {
            memcpy(to, r->p->state.kept + kept_at(k, f, body), (size_t)k->field[f].n_comp * sizeof *to);
            to += k->field[f].n_comp;
        }
    return to;
}
