/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Fields that files have one value a cell of: memory of terms, by its mean over the cell. */
#include "run/run.h"

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
    return 0;
}
