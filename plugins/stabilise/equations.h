/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What keeps flow stable where the mesh does not resolve it: what happens at one point.  The terms vanish with div
 * u or with the residual of momentum, so that the exact solution satisfies the equations with them, too. */

/* 1/2 rho (div u) u . v: with it convection has no power of its own where div u_h is not zero */
static int F(skew)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const NUM *restrict u = in[0], *restrict div_u = in[1], *restrict rho = in[2];
    NUM *restrict v = out[0];

    for (uint32_t a = 0; a < b->dim; a++)
        PF_LANES_OF (b, i)
            v[a * LD + i] = 0.5 * rho[i] * div_u[i] * u[a * LD + i];
    return PF_OK;
}

/* c r^2/sqrt(r^2 + mu^2) (div u) (div v), r = rho |w| h: c rho |w| h where convection prevails in a cell, of
 * second order in h where viscosity does.  w is the velocity; in unsteady flow that of a step ago, so that the term
 * is linear. */
static int F(grad_div)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const struct stabilise *s = b->params;
    const NUM *restrict w = is_steady(b) ? in[0] : in[1], *restrict div_u = in[2], *restrict rho = in[3],
                        *restrict mu = in[4];
    NUM *restrict div_v = out[0];

    PF_LANES_OF (b, i) {
        const NUM rho_h = rho[i] * b->h[i];
        NUM r2 = 0;

        for (uint32_t k = 0; k < b->dim; k++)
            r2 += w[k * LD + i] * w[k * LD + i];
        r2 *= rho_h * rho_h;
        div_v[i] = s->grad_div * r2 / sqrt(r2 + mu[i] * mu[i] + NO_ZERO) * div_u[i];
    }
    return PF_OK;
}

/* m, which is (c / tau)^2: rho^2 (2 c s)^2 + rho^2 w.G w + C mu^2 G:G, with the metric G and the factor s of the
 * time scheme, so that the strength c weakens tau where convection or viscosity make it, and the step bounds it. No
 * viscosity and no flow: not quite zero. */
static inline NUM F(rate)(const pf_batch *b, const NUM *const *in, const NUM *w, uint32_t i)
{
    const struct streamline *s = b->params;
    const double *restrict g = b->metric;
    const NUM rho2 = in[RHO][i] * in[RHO][i], mu2 = in[MU][i] * in[MU][i];
    const double by_time = BY_TIME * s->streamline * b->shift;
    NUM m = rho2 * by_time * by_time + NO_ZERO;

    for (uint32_t j = 0; j < b->dim; j++)
        for (uint32_t k = 0; k < b->dim; k++) {
            const double g_jk = g[(j * b->dim + k) * LD + i];

            m += rho2 * w[j * LD + i] * g_jk * w[k * LD + i] + INVERSE_ESTIMATE * mu2 * g_jk * g_jk;
        }
    return m;
}

/* Component a of du/dt + (u . grad) u - g; without g if p is the reduced pressure */
static inline NUM F(acceleration)(const pf_batch *b, const NUM *const *in, uint32_t a, uint32_t i)
{
    const struct streamline *s = b->params;
    const NUM *restrict u = in[U], *restrict grad_u = in[GRAD_U];
    NUM rate = in[U_T][a * LD + i] - (s->reduced_pressure ? 0 : s->gravity[a]);

    for (uint32_t k = 0; k < b->dim; k++)
        rate += u[k * LD + i] * grad_u[(a * b->dim + k) * LD + i];
    return rate;
}

/* Component a of the residual of momentum: rho times that + grad p - mu lap u - f.  Where mu differs from place to
 * place -2 D(u) grad mu is left out. */
static inline NUM F(residual_of)(const pf_batch *b, const NUM *const *in, uint32_t a, uint32_t i)
{
    return in[RHO][i] * F(acceleration)(b, in, a, i) + in[GRAD_P][a * LD + i] - in[MU][i] * in[LAP_U][a * LD + i] -
           in[FORCE][a * LD + i];
}

/* tau r . rho (w . grad) v with the residual r of momentum and tau = c m^(-1/2).  w is the velocity; in unsteady
 * flow that of a step ago, so that test function and time scale stand still in Newton's method. */
static int F(streamline)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const struct streamline *s = b->params;
    const NUM *restrict w = is_steady(b) ? in[U] : in[OLD_U];
    NUM *restrict grad_v = out[0];

    PF_LANES_OF (b, i) {
        const NUM rho_tau = s->streamline * in[RHO][i] / sqrt(F(rate)(b, in, w, i));

        for (uint32_t a = 0; a < b->dim; a++) {
            const NUM r = rho_tau * F(residual_of)(b, in, a, i);

            for (uint32_t k = 0; k < b->dim; k++)
                grad_v[(a * b->dim + k) * LD + i] = r * w[k * LD + i];
        }
    }
    return PF_OK;
}
