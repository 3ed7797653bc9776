/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Which pairs a term acts on: those with a gap below its own reach.  Pairs are looked for as far as any term asks.
 */
#include "assemble/batch.h"

int reach_of(const assembly *a, const assembly_class *c, const term_use *use, const workspace *w, int *in)
{
    int n = 0;
    double reach;

    if (c->where != PF_PAIR)
        return PF_LANES;
    reach = use->term->reach ? use->term->reach(use->params, a->bodies->pair_size, a->bodies->pair_h)
                             : a->bodies->pair_size;
    for (int l = 0; l < (int)PF_LANES; l++) {
        in[l] = w->gap[0][l] < reach;
        n += in[l];
    }
    return n;
}

void reach_mask(const int *in, double *v, size_t n)
{
    for (size_t i = 0; i < n; i++)
        v[i] = in[i % PF_LANES] ? v[i] : 0;
}
