/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What the sound description in broken.c computes, for real and for complex numbers. */

/* (rho (u . grad) u - f) . v */
static int F(convection)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const struct fluid *fluid = b->params;
    const NUM *restrict u = in[0], *restrict grad_u = in[1], *restrict f = in[2];
    NUM *restrict v = out[0];
    const uint32_t d = b->dim;

    for (uint32_t a = 0; a < d; a++) {
        PF_LANES_OF (b, i)
            v[a * LD + i] = -f[a * LD + i];
        for (uint32_t k = 0; k < d; k++)
            PF_LANES_OF (b, i)
                v[a * LD + i] += fluid->density * u[k * LD + i] * grad_u[(a * d + k) * LD + i];
    }
    return PF_OK;
}
