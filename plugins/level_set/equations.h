/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Two fluids that do not mix: what happens at one point.  phi goes from 0 in the first to 1 in the second,
 * n = grad phi / |grad phi|. */

/* |grad phi| at lane i; where the fluids are all but unmixed it levels off, so that n dies out there */
static inline NUM F(steepness)(const pf_batch *b, const NUM *g, uint32_t i)
{
    const struct level_set *l = b->params;
    NUM s = FLAT * FLAT / (l->thickness * l->thickness);

    for (uint32_t k = 0; k < b->dim; k++)
        s += g[k * LD + i] * g[k * LD + i];
    return sqrt(s);
}

/* a where phi = 0, b where phi = 1, no more and no less elsewhere */
static inline NUM F(mix)(NUM phi, double a, double b)
{
    return creal(phi) < 0 ? a : creal(phi) > 1 ? b : a + (b - a) * phi;
}

/* (d phi/dt + u . grad phi) s */
static int F(transport)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const NUM *restrict phi_t = in[0], *restrict u = in[1], *restrict g = in[2];
    NUM *restrict s = out[0];

    PF_LANES_OF (b, i)
        s[i] = phi_t[i];
    for (uint32_t k = 0; k < b->dim; k++)
        PF_LANES_OF (b, i)
            s[i] += u[k * LD + i] * g[k * LD + i];
    return PF_OK;
}

/* c (e grad phi - phi (1 - phi) n) . grad s, which is at rest for phi = 1/(1 + exp(d/e)), d the distance from the
 * interface */
static int F(compression)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const struct level_set *l = b->params;
    const NUM *restrict phi = in[0], *restrict g = in[1];
    NUM *restrict grad_s = out[0];

    PF_LANES_OF (b, i) {
        const NUM c = l->speed * (l->thickness - phi[i] * (1 - phi[i]) / F(steepness)(b, g, i));

        for (uint32_t k = 0; k < b->dim; k++)
            grad_s[k * LD + i] = c * g[k * LD + i];
    }
    return PF_OK;
}

/* sigma |grad phi| (I - n n) : grad v, the tension of the interface, drawn out over its thickness */
static int F(tension)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const struct level_set *l = b->params;
    const NUM *restrict g = in[0];
    NUM *restrict grad_v = out[0];
    const uint32_t d = b->dim;

    PF_LANES_OF (b, i) {
        const NUM s = F(steepness)(b, g, i);

        for (uint32_t a = 0; a < d; a++)
            for (uint32_t k = 0; k < d; k++)
                grad_v[(a * d + k) * LD + i] = l->tension * ((a == k ? s : 0) - g[a * LD + i] * g[k * LD + i] / s);
    }
    return PF_OK;
}

/* rho (du/dt + (u . grad) u - g) . v + 2 mu D(u) : grad v - p div v, without the weight of the first fluid if p is
 * the reduced pressure */
static int F(momentum)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const struct level_set *l = b->params;
    const NUM *restrict phi = in[0], *restrict u_t = in[1], *restrict u = in[2], *restrict grad_u = in[3],
                        *restrict p = in[4];
    NUM *restrict v = out[0], *restrict grad_v = out[1];
    const uint32_t d = b->dim;

    for (uint32_t a = 0; a < d; a++)
        PF_LANES_OF (b, i) {
            const NUM rho = F(mix)(phi[i], l->density, l->density_2);
            const NUM mu = F(mix)(phi[i], l->viscosity, l->viscosity_2);
            NUM rate = u_t[a * LD + i];

            for (uint32_t k = 0; k < d; k++) {
                rate += u[k * LD + i] * grad_u[(a * d + k) * LD + i];
                grad_v[(a * d + k) * LD + i] =
                    mu * (grad_u[(a * d + k) * LD + i] + grad_u[(k * d + a) * LD + i]) - (a == k ? p[i] : 0);
            }
            v[a * LD + i] = rho * rate - (rho - (l->reduced_pressure ? l->density : 0)) * l->gravity[a];
        }
    return PF_OK;
}
