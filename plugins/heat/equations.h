/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Heat in a fluid: what happens at one point.  temperature is T of the formulas, C = rho c the heat capacity per
 * volume, s tests the balance of heat. */

/* C dT/dt s */
static int F(storage)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const struct heat *h = b->params;
    const NUM *restrict T_t = in[0];
    NUM *restrict s = out[0];

    PF_LANES_OF (b, i)
        s[i] = h->density * h->heat_capacity * T_t[i];
    return PF_OK;
}

/* C (u . grad T) s */
static int F(advection)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const struct heat *h = b->params;
    const NUM *restrict u = in[0], *restrict grad_T = in[1];
    NUM *restrict s = out[0];

    PF_LANES_OF (b, i)
        s[i] = 0;
    for (uint32_t k = 0; k < b->dim; k++)
        PF_LANES_OF (b, i)
            s[i] += h->density * h->heat_capacity * u[k * LD + i] * grad_T[k * LD + i];
    return PF_OK;
}

/* k grad T . grad s */
static int F(diffusion)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const struct heat *h = b->params;
    const NUM *restrict grad_T = in[0];
    NUM *restrict grad_s = out[0];

    for (uint32_t k = 0; k < b->dim; k++)
        PF_LANES_OF (b, i)
            grad_s[k * LD + i] = h->conductivity * grad_T[k * LD + i];
    return PF_OK;
}

/* -q s, heat made in the fluid, per volume */
static int F(source)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const NUM *restrict q = in[0];
    NUM *restrict s = out[0];

    PF_LANES_OF (b, i)
        s[i] = -q[i];
    return PF_OK;
}

/* rho beta (T - T_ref) g . v, what remains of -rho(T) g . v beside the -rho g . v of momentum */
static int F(buoyancy)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const struct heat *h = b->params;
    const NUM *restrict temperature = in[0];
    NUM *restrict v = out[0];

    for (uint32_t a = 0; a < b->dim; a++)
        PF_LANES_OF (b, i)
            v[a * LD + i] = h->density * h->expansion * (temperature[i] - h->reference_temperature) * h->gravity[a];
    return PF_OK;
}

/* -q s on a boundary, q > 0 into the fluid */
static int F(heat_flux)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    return F(source)(b, in, out);
}

/* tau (C (dT/dt + u . grad T) - k lap T - q) C (w . grad s),  C tau = C / sqrt(m),
 * m = C^2 (4 s^2 + w . G w) + K k^2 G : G, with the metric G and the factor s of the time scheme.  w is the
 * velocity; in unsteady flow that of a step ago, so that only the residual moves in Newton's method. */
static int F(streamline)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const struct heat *h = b->params;
    const NUM *restrict u = in[0], *restrict w = b->shift > 0 ? in[1] : u, *restrict grad_T = in[2],
                        *restrict lap_T = in[3], *restrict T_t = in[4], *restrict q = in[5];
    const double *restrict g = b->metric, c = h->density * h->heat_capacity;
    NUM *restrict grad_s = out[0];

    PF_LANES_OF (b, i) {
        NUM r = c * T_t[i] - h->conductivity * lap_T[i] - q[i], m = 4 * c * c * b->shift * b->shift + NO_ZERO;

        for (uint32_t j = 0; j < b->dim; j++) {
            r += c * u[j * LD + i] * grad_T[j * LD + i];
            for (uint32_t k = 0; k < b->dim; k++) {
                const double g_jk = g[(j * b->dim + k) * LD + i];

                m += c * c * w[j * LD + i] * g_jk * w[k * LD + i] +
                     INVERSE_ESTIMATE * h->conductivity * h->conductivity * g_jk * g_jk;
            }
        }
        for (uint32_t k = 0; k < b->dim; k++)
            grad_s[k * LD + i] = c / sqrt(m) * r * w[k * LD + i];
    }
    return PF_OK;
}
