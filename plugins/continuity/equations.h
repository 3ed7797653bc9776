/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Continuity (appendix A.1-A.6): what happens at one point. */

/* q div u */
static int F(divergence)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const NUM *restrict div_u = in[0];
    NUM *restrict q = out[0];

    PF_LANES_OF (b, i)
        q[i] = div_u[i];
    return PF_OK;
}

/* eps h^2 / (mu + rho c0 h^2 / dt) grad p . grad q inside bodies (numerics 4): there div u = 0 follows from the
 * rigid motion and leaves p undetermined */
static int F(pressure_smoothing)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const struct smoothing *s = b->params;
    const NUM *restrict grad_p = in[0];
    NUM *restrict grad_q = out[0];

    for (uint32_t a = 0; a < b->dim; a++)
        PF_LANES_OF (b, i) {
            const double h2 = b->h[i] * b->h[i];

            grad_q[a * LD + i] = s->epsilon * h2 / (s->viscosity + s->density * h2 * b->shift) * grad_p[a * LD + i];
        }
    return PF_OK;
}
