/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * On which points of a batch a term acts: where `inside` of its line is above 0; of pairs, on those with a gap
 * below its own reach (they are looked for as far as any term asks).  Elsewhere what it gives is zero, whatever it
 * computed there. */
#include "assemble/batch.h"

#include <math.h>

/* Gap from which on the term does nothing; infinite where points are no pairs. */
static double reach_of(const assembly *a, const assembly_class *c, const term_use *u)
{
    if (c->where != PF_PAIR)
        return INFINITY;
    return u->term->reach ? u->term->reach(u->params, a->bodies->pair_size, a->bodies->pair_h)
                          : a->bodies->pair_size;
}

int mask_take(const assembly *a, const assembly_class *c, const plan_use *p, workspace *w)
{
    const size_t ld = (size_t)c->n_q * PF_LANES;
    const double *in = p->inside < 0 ? NULL : (const double *)(w->in + c->input[p->inside].at * (size_t)c->n_q);
    const double *gap = c->where == PF_PAIR ? (const double *)w->gap : NULL, reach = reach_of(a, c, p->use);
    size_t n = 0;

    w->masked = 0;
    if (!in && !gap)
        return 1;
    for (size_t i = 0; i < ld; i++) {
        w->mask[i] = (!in || in[i] > 0) && (!gap || gap[i] < reach);
        n += w->mask[i];
    }
    w->masked = n < ld;
    return n > 0;
}

void mask_rows(const workspace *w, double *rows, size_t n, size_t ld)
{
    for (size_t k = 0; w->masked && k < n; k++)
        for (size_t i = 0; i < ld; i++)
            rows[k * ld + i] = w->mask[i] ? rows[k * ld + i] : 0;
}

int mask_residual(const pf_term *t, const pf_batch *b, const double *const *in, double *const *out,
                  const workspace *w)
{
    TRY(t->residual(b, in, out));
    for (uint32_t o = 0; o < t->n_out; o++)
        mask_rows(w, out[o], (size_t)term_components(t->out[o].shape, (int)b->dim), b->ld);
    return 0;
}
