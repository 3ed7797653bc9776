/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The power of terms.  The rows of a term, each times its own unknown, add up to what it does per time to the
 * energy of the fields: its outputs at the points times the unknowns as the test functions enter,
 *
 *     sum_i r_i x_i = sum_q w s . B x,       the counterpart of r_i = sum_q w B_i^T s.
 *
 * Of a term with rates d/dt the part without them is told apart, and the energy that the other part is the rate of.
 */
#include "assemble/batch.h"

#include <math.h>
#include <string.h>

/* sum_q w s . B x of the real items of the batch: lanes past the end repeat the last one. */
static double output_power(const assembly_class *c, int64_t batch, const plan_use *p, int dim,
                           const double *const *out, const workspace *w)
{
    const pf_term *t = p->use->term;
    int nq = c->n_q, n_item = (int)(c->batch[batch + 1] - c->batch[batch]);
    v8 sum = {0};
    double total = 0;

    for (uint32_t o = 0; o < t->n_out; o++) {
        const v8 *restrict x = p->out[o] < 0 ? NULL : w->unknown_of[p->out[o]], *restrict s = (const v8 *)out[o];
        int div = t->out[o].eval == PF_DIV, n = div ? dim : term_components(t->out[o].shape, dim);

        for (int k = 0; x && k < n; k++) /* q div v is q I : grad v */
            for (int q = 0; q < nq; q++)
                sum += w->w[q] * s[(div ? 0 : k) * nq + q] * x[(div ? k * dim + k : k) * nq + q];
    }
    for (int l = 0; l < n_item; l++)
        total += sum[l];
    return total;
}

/* The values of a field among the unknowns of the tests; NULL: none of its rows has them. */
static const double *values_of(const assembly_class *c, int field, const workspace *w)
{
    for (int t = 0; t < c->n_test; t++)
        if (c->test[t].field == field && c->test[t].kind == BASIS_VALUE)
            return (const double *)w->unknown_of[t];
    return NULL;
}

int power_add(const assembly_class *c, const assembly_state *s, int64_t batch, const plan_use *p, double factor,
              const pf_batch *b, const double *const *in, double *const *out, workspace *w)
{
    const pf_term *t = p->use->term;
    const double *still[TERM_MAX_SLOTS], *moved[TERM_MAX_SLOTS];
    double all = output_power(c, batch, p, (int)b->dim, (const double *const *)out, w), rest = all, kinetic = 0;
    int rates = 0, known = 1;

    for (uint32_t k = 0; k < t->n_in; k++) {
        int field = c->input[p->in[k]].field,
            counts = t->in[k].eval == PF_DOT && s->power->fields >> field & 1 && term_stores(t, t->in[k].field);

        still[k] = counts ? (const double *)w->still : in[k];
        moved[k] = counts ? values_of(c, field, w) : in[k];
        rates |= counts;
        known &= moved[k] != NULL;
    }
    if (rates) {
        TRY(mask_residual(t, b, still, out, w));
        rest = output_power(c, batch, p, (int)b->dim, (const double *const *)out, w);
        kinetic = NAN;
    }
    if (rates && known) {
        TRY(mask_residual(t, b, moved, out, w));
        kinetic = 0.5 * (output_power(c, batch, p, (int)b->dim, (const double *const *)out, w) - rest);
    }
    w->power[p->number][POWER_ALL] += factor * all;
    w->power[p->number][POWER_REST] += factor * rest;
    w->power[p->number][POWER_KINETIC] += factor * kinetic;
    return 0;
}

void power_clear(assembly *a)
{
    for (int i = 0; i < a->n_thread; i++)
        memset(a->work[i].power, 0, (size_t)a->n_use * sizeof *a->work[i].power);
}

void power_sum(const assembly *a, assembly_power *power)
{
    memset(power->use, 0, (size_t)a->n_use * sizeof *power->use);
    for (int i = 0; i < a->n_thread; i++)
        for (int u = 0; u < a->n_use; u++)
            for (int k = 0; k < POWERS; k++)
                power->use[u][k] += a->work[i].power[u][k];
}
