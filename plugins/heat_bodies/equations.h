/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Heat of bodies that cut through cells: what happens at one point.  temperature is that of the fluid, s its test
 * function; temperature_b and s_b are those of the bodies; n points out of the fluid. */

/* (g k/h^2 + g_t rho c c0/dt) dT ds;  d: what differs from the polynomial of the root */
static int F(tie)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const struct heat *h = b->params;
    const NUM *restrict dT = in[0];
    NUM *restrict ds = out[0];

    PF_LANES_OF (b, i)
        ds[i] =
            (h->g_k * h->conductivity / (b->h[i] * b->h[i]) + h->g_t * h->density * h->heat_capacity * b->shift) *
            dT[i];
    return PF_OK;
}

/* -k (dT/dn) s + k (ds/dn) w + gamma k/h w s,  w = T - T_b: Nitsche's method with the skew sign; flux: what the
 * fluid loses */
static inline void F(nitsche)(const pf_batch *b, const NUM *grad_T, NUM w, uint32_t i, NUM *flux, NUM *grad_s)
{
    const struct heat *h = b->params;
    const double *restrict n = b->normal, k = h->conductivity;
    NUM q = h->gamma * k / b->h[i] * w;

    for (uint32_t a = 0; a < b->dim; a++) {
        q -= k * grad_T[a * LD + i] * n[a * LD + i];
        grad_s[a * LD + i] = k * w * n[a * LD + i];
    }
    flux[i] = q;
}

/* The surface holds the temperature T_b. */
static int F(surface_temperature)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const NUM *restrict temperature = in[0], *restrict held = in[2];

    PF_LANES_OF (b, i)
        F(nitsche)(b, in[1], temperature[i] - held[i], i, out[0], out[1]);
    return PF_OK;
}

/* What the fluid loses the body gets: q s - q s_b + k (ds/dn) (T - T_b),  q = -k dT/dn + gamma k/h (T - T_b) */
static int F(interface)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const NUM *restrict temperature = in[0], *restrict temperature_b = in[2];
    NUM *restrict s = out[0], *restrict s_b = out[2];

    PF_LANES_OF (b, i) {
        F(nitsche)(b, in[1], temperature[i] - temperature_b[i], i, s, out[1]);
        s_b[i] = -s[i];
    }
    return PF_OK;
}

/* -q s, heat that a surface gives the fluid, or that is made in a body */
static int F(surface_flux)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const NUM *restrict q = in[0];
    NUM *restrict s = out[0];

    PF_LANES_OF (b, i)
        s[i] = -q[i];
    return PF_OK;
}

static int F(source)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    return F(surface_flux)(b, in, out);
}

/* k_b grad T_b . grad s_b */
static int F(conduction)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const struct heat *h = b->params;
    const NUM *restrict grad_T = in[0];
    NUM *restrict grad_s = out[0];

    for (uint32_t k = 0; k < b->dim; k++)
        PF_LANES_OF (b, i)
            grad_s[k * LD + i] = h->body_conductivity * grad_T[k * LD + i];
    return PF_OK;
}

/* rho_P c_b dT_b/dt s_b */
static int F(storage)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const struct heat *h = b->params;
    const NUM *restrict T_t = in[0];
    NUM *restrict s = out[0];

    PF_LANES_OF (b, i)
        s[i] = b->density[i] * h->body_heat_capacity * T_t[i];
    return PF_OK;
}

/* HARDLY k_b grad T_b . grad s_b outside, where cut cells have unknowns of bodies with next to no body */
static int F(continuation)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    F(conduction)(b, in, out);
    for (uint32_t k = 0; k < b->dim; k++)
        PF_LANES_OF (b, i)
            out[0][k * LD + i] *= HARDLY;
    return PF_OK;
}
