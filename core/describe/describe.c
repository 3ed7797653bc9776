/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * From the blocks of a case to its description: every block is read, whatever is wrong with another. */
#include "describe/describe.h"

#include <string.h>

int describe(description *d, case_file *c, registry *r, warning_list *w, error *err)
{
    memset(d, 0, sizeof *d);
    d->c = c;
    d->warnings = w;
    TRY(describe_mesh(d, err));
    if (d->dim == 0)
        d->dim = 2; /* the mesh block is wrong and said so; go on to find what else is */
    TRY(describe_terms(d, r, err));
    describe_properties(d, r);
    TRY(describe_boundaries(d, err));
    TRY(describe_bodies(d, err));
    TRY(describe_settings(d, r, err));
    TRY(describe_shown(d, err));
    TRY(describe_output(d, r, err));
    describe_check_replaced(d);
    describe_check_formulation(d);
    describe_check_exchange(d);
    describe_check_box(d);
    describe_check_terms(d);
    describe_check_kept(d);
    return 0;
}

int describe_has(const description *d, int where)
{
    for (int i = 0; i < d->n_use; i++)
        if (d->use[i].where == where)
            return 1;
    return 0;
}

void describe_destroy(description *d)
{
    describe_end(d);
    arena_free(&d->memory);
    memset(d, 0, sizeof *d);
}
