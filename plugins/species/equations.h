/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A dissolved species: what happens at one point.  c is the amount per volume, s tests its balance. */

/* dc/dt s */
static int F(storage)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    PF_LANES_OF (b, i)
        out[0][i] = in[0][i];
    return PF_OK;
}

/* (u . grad c) s */
static int F(advection)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const NUM *restrict u = in[0], *restrict grad_c = in[1];
    NUM *restrict s = out[0];

    PF_LANES_OF (b, i)
        s[i] = 0;
    for (uint32_t k = 0; k < b->dim; k++)
        PF_LANES_OF (b, i)
            s[i] += u[k * LD + i] * grad_c[k * LD + i];
    return PF_OK;
}

/* D grad c . grad s */
static int F(diffusion)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const struct species *p = b->params;

    for (uint32_t k = 0; k < b->dim; k++)
        PF_LANES_OF (b, i)
            out[0][k * LD + i] = p->diffusivity * in[0][k * LD + i];
    return PF_OK;
}

/* r(c) = k_1 c + k_2 c^2 + V c/(K_m + c); where an iteration makes c negative the last goes on with its slope at 0
 */
static inline NUM F(consumed)(const struct reaction *p, NUM c)
{
    const NUM positive = creal(c) > 0 ? c : 0;

    return p->first_order * c + p->second_order * c * c + p->max_rate * c / (p->half_saturation + positive);
}

/* (r(c) - f) s */
static int F(reaction)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const struct reaction *p = b->params;

    PF_LANES_OF (b, i)
        out[0][i] = F(consumed)(p, in[0][i]) - in[1][i];
    return PF_OK;
}

/* tau (dc/dt + u . grad c - D lap c + r(c) - f) w . grad s,  1/tau^2 = 4 s^2 + w . G w + C D^2 G : G, with the
 * metric G and the factor s of the time scheme.  w is the velocity; in unsteady flow that of a step ago. */
static int F(streamline)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const struct reaction *p = b->params;
    const NUM *restrict u = in[U], *restrict w = b->shift > 0 ? in[OLD_U] : in[U];
    const double *restrict g = b->metric;
    const uint32_t d = b->dim;

    PF_LANES_OF (b, i) {
        NUM r = in[C_T][i] - p->diffusivity * in[LAP_C][i] + F(consumed)(p, in[C][i]) - in[SOURCE][i];
        NUM m = 4 * b->shift * b->shift + NO_ZERO;

        for (uint32_t j = 0; j < d; j++) {
            r += u[j * LD + i] * in[GRAD_C][j * LD + i];
            for (uint32_t k = 0; k < d; k++)
                m += g[(j * d + k) * LD + i] *
                     (w[j * LD + i] * w[k * LD + i] +
                      INVERSE_ESTIMATE * p->diffusivity * p->diffusivity * g[(j * d + k) * LD + i]);
        }
        for (uint32_t k = 0; k < d; k++)
            out[0][k * LD + i] = r / sqrt(m) * w[k * LD + i];
    }
    return PF_OK;
}

/* -q s on a boundary, q > 0 into the fluid */
static int F(flux)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    PF_LANES_OF (b, i)
        out[0][i] = -in[0][i];
    return PF_OK;
}

/* k c s on a boundary that consumes the species */
static int F(uptake)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    PF_LANES_OF (b, i)
        out[0][i] = in[1][i] * in[0][i];
    return PF_OK;
}

/* (k c - q) s on the surface of a body, which releases q and consumes k c */
static int F(body)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const struct surface *p = b->params;

    PF_LANES_OF (b, i)
        out[0][i] = p->uptake * in[0][i] - p->release;
    return PF_OK;
}

/* (g D/h^2 + g c_0) dc ds, d: what differs from the polynomial of the root */
static int F(extension)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const struct tie *p = b->params;

    PF_LANES_OF (b, i)
        out[0][i] = p->g_c * (p->diffusivity / (b->h[i] * b->h[i]) + b->shift) * in[0][i];
    return PF_OK;
}
