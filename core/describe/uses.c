/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * All terms that are on, whatever they give: one walk over equations, laws and what is shown. */
#include "describe/describe.h"

term_use *describe_use(description *d, int i, const case_block **line)
{
    term_list *list[] = {&d->law, &d->shown};

    if (i < d->n_use) {
        *line = d->use_block[i];
        return &d->use[i];
    }
    i -= d->n_use;
    for (int k = 0; k < 2; i -= list[k++]->n)
        if (i < list[k]->n) {
            *line = list[k]->block[i];
            return &list[k]->use[i];
        }
    return NULL;
}
