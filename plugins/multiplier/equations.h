/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Rigid motion by a multiplier (numerics 4; appendix B.2, B.16-B.18): what happens at a point of
 * Omega_P.  lambda is the multiplier, (U, omega) the motion of the body, r the arm from its
 * centre; alpha = mu/h^2 + rho/dt scales lambda and nothing else. */
#include <plugflow/rigid_motion.h>

/* -alpha lambda . v */
static int F(force)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const struct multiplier *m = b->params;
    const NUM *restrict lambda = in[0];
    NUM *restrict v = out[0];

    for (uint32_t a = 0; a < b->dim; a++)
        PF_LANES_OF (b, i)
            v[a * LD + i] = -alpha_of(b, m, i) * lambda[a * LD + i];
    return PF_OK;
}

/* alpha (u - U - omega x r) . eta */
static int F(rigid_motion)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const struct multiplier *m = b->params;
    const NUM *restrict u = in[0], *restrict U = in[1], *restrict omega = in[2];
    NUM *restrict eta = out[0];

    for (uint32_t a = 0; a < b->dim; a++)
        PF_LANES_OF (b, i)
            eta[a * LD + i] = alpha_of(b, m, i) * (u[a * LD + i] - U[a * LD + i] - F(pf_turn)(b, omega, a, i));
    return PF_OK;
}

/* alpha lambda . V + alpha (r x lambda) . xi */
static int F(reaction)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const struct multiplier *m = b->params;
    const NUM *restrict lambda = in[0];
    NUM *restrict V = out[0], *restrict xi = out[1];

    for (uint32_t a = 0; a < b->dim; a++)
        PF_LANES_OF (b, i)
            V[a * LD + i] = alpha_of(b, m, i) * lambda[a * LD + i];
    for (uint32_t a = 0; a < (b->dim == 2 ? 1 : 3); a++)
        PF_LANES_OF (b, i)
            xi[a * LD + i] = alpha_of(b, m, i) * F(pf_moment)(b, lambda, a, i);
    return PF_OK;
}
