/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What the terms of laplacians.c have in common, for real and for complex numbers. */

/* (lap T - f) s + weight sum_kl (G_kl - delta_kl metric_k) (1 + l) ds/dx_k */
static int F(difference)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const struct expected *e = b->params;
    const uint32_t d = b->dim;

    PF_LANES_OF (b, i)
        out[0][i] = in[0][i] - in[1][i];
    for (uint32_t k = 0; k < d; k++)
        PF_LANES_OF (b, i) {
            out[1][k * LD + i] = 0;
            for (uint32_t l = 0; l < d; l++)
                out[1][k * LD + i] +=
                    e->weight * (b->metric[(k * d + l) * LD + i] - (k == l ? e->metric[k] : 0)) * (1 + l);
        }
    return PF_OK;
}
