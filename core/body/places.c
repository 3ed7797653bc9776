/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Placements that cannot be are mistakes of the case: bodies within each other, outside of the mesh, through its
 * boundaries, or cut by a symmetry plane that they are not symmetric about. */
#include "body/places.h"

int bodies_check_places(const description *d, const mesh *m, const cell_grid *grid, error *err)
{
    if (d->n_body == 0)
        return 0;
    TRY(overlap_check(d, m, err));
    TRY(within_check(d, m, grid, err));
    return symmetry_check(d, m, err);
}
