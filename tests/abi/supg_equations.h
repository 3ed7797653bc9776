/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Equations of supg.c, for real and for complex numbers. */

/* (dT/dt + u . grad T - f) s + k grad T . grad s */
static int F(galerkin)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const struct transport *t = b->params;
    const NUM *restrict u = in[0], *restrict grad_T = in[1], *restrict f = in[2], *restrict T_t = in[3];
    NUM *restrict s = out[0], *restrict grad_s = out[1];

    PF_LANES_OF (b, i)
        s[i] = T_t[i] - f[i];
    for (uint32_t k = 0; k < b->dim; k++)
        PF_LANES_OF (b, i) {
            s[i] += u[k * LD + i] * grad_T[k * LD + i];
            grad_s[k * LD + i] = t->diffusivity * grad_T[k * LD + i];
        }
    return PF_OK;
}

/* tau (dT/dt + u . grad T - k lap T - f) u . grad s,   tau = (u . G u + C k^2 G : G)^(-1/2) with the metric G */
static int F(supg)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const struct transport *t = b->params;
    const NUM *restrict u = in[0], *restrict grad_T = in[1], *restrict lap_T = in[2], *restrict f = in[3],
                        *restrict T_t = in[4];
    const double *restrict g = b->metric;
    NUM *restrict grad_s = out[0];
    const uint32_t d = b->dim;

    PF_LANES_OF (b, i) {
        NUM r = T_t[i] - t->diffusivity * lap_T[i] - f[i], rate = 0;

        for (uint32_t j = 0; j < d; j++) {
            r += u[j * LD + i] * grad_T[j * LD + i];
            for (uint32_t k = 0; k < d; k++) {
                double g_jk = g[(j * d + k) * LD + i];

                rate += u[j * LD + i] * g_jk * u[k * LD + i] +
                        t->constant * t->diffusivity * t->diffusivity * g_jk * g_jk;
            }
        }
        for (uint32_t k = 0; k < d; k++)
            grad_s[k * LD + i] = r / sqrt(rate) * u[k * LD + i];
    }
    return PF_OK;
}
