/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Terms that act in a part of the domain only (`inside` of their line): at points outside of it what they give is
 * zero, whatever they computed there. */
#include "assemble/batch.h"

int inside_any(const assembly_class *c, const plan_use *p, const workspace *w)
{
    const v8 *in = w->in + c->input[p->inside < 0 ? 0 : p->inside].at * (size_t)c->n_q;

    for (int q = 0; p->inside >= 0 && q < c->n_q; q++)
        for (int l = 0; l < (int)PF_LANES; l++)
            if (in[q][l] > 0)
                return 1;
    return p->inside < 0;
}

void inside_mask(const assembly_class *c, const plan_use *p, const workspace *w, double *rows, int n)
{
    const size_t ld = (size_t)c->n_q * PF_LANES;
    const double *restrict in = (const double *)(w->in + c->input[p->inside].at * (size_t)c->n_q);

    for (int k = 0; k < n; k++) {
        double *restrict row = rows + (size_t)k * ld;

        for (size_t i = 0; i < ld; i++)
            row[i] = in[i] > 0 ? row[i] : 0;
    }
}

int inside_residual(const assembly_class *c, const plan_use *p, const pf_batch *b, const double *const *in,
                    double *const *out, const workspace *w)
{
    const pf_term *t = p->use->term;

    TRY(t->residual(b, in, out));
    for (uint32_t o = 0; p->inside >= 0 && o < t->n_out; o++)
        inside_mask(c, p, w, out[o], term_components(t->out[o].shape, (int)b->dim));
    return 0;
}
