/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Drag of a porous medium: what happens at one point. */

/* (mu k + rho c_F sqrt(k) |u|) u . v, k = 1/K; none where k is 0, which is free fluid */
static int F(drag)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const struct medium *m = b->params;
    const NUM *restrict u = in[0], *restrict k = in[1];
    NUM *restrict v = out[0];

    PF_LANES_OF (b, i) {
        NUM square = 0, rate;

        if (!(creal(k[i]) >= 0))
            return b->host->fail(
                b, i, PF_FAIL, "inverse_permeability is %g; it must not be negative (0: free fluid)", creal(k[i]));
        for (uint32_t a = 0; a < b->dim; a++)
            square += u[a * LD + i] * u[a * LD + i];
        rate = m->viscosity * k[i] + m->density * m->forchheimer * sqrt(creal(k[i])) * sqrt(square + NO_ZERO);
        for (uint32_t a = 0; a < b->dim; a++)
            v[a * LD + i] = rate * u[a * LD + i];
    }
    return PF_OK;
}
