/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What keeps flow stable where the mesh does not resolve it: what happens at one point.  All terms vanish with
 * div u, so that the exact solution satisfies the equations with them, too. */

/* 1/2 rho (div u) u . v: with it convection has no power of its own where div u_h is not zero */
static int F(skew)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const struct stabilise *s = b->params;
    const NUM *restrict u = in[0], *restrict div_u = in[1];
    NUM *restrict v = out[0];

    for (uint32_t a = 0; a < b->dim; a++)
        PF_LANES_OF (b, i)
            v[a * LD + i] = 0.5 * s->density * div_u[i] * u[a * LD + i];
    return PF_OK;
}

/* c r^2/sqrt(r^2 + mu^2) (div u) (div v), r = rho |w| h: c rho |w| h where convection prevails in a cell, of
 * second order in h where viscosity does.  w is the velocity; in unsteady flow that of a step ago, so that the term
 * is linear. */
static int F(grad_div)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const struct stabilise *s = b->params;
    const NUM *restrict w = is_steady(b) ? in[0] : in[1], *restrict div_u = in[2];
    NUM *restrict div_v = out[0];

    PF_LANES_OF (b, i) {
        const double rho_h = s->density * b->h[i];
        NUM r2 = 0;

        for (uint32_t k = 0; k < b->dim; k++)
            r2 += w[k * LD + i] * w[k * LD + i];
        r2 *= rho_h * rho_h;
        div_v[i] = s->grad_div * r2 / sqrt(r2 + s->viscosity * s->viscosity + NO_ZERO) * div_u[i];
    }
    return PF_OK;
}
