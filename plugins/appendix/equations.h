/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Particulate flow as the appendix prints it (B.4-B.45): what happens at a point.  lambda is the
 * multiplier, (U, omega) the motion of the body, r the arm from its centre. */
#include <plugflow/rigid_motion.h>

/* -alpha lambda . v - mu grad lambda : grad v  (B.4-B.6, what they add to A.10-A.12) */
static int F(force)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const struct appendix *p = b->params;
    const double alpha = alpha_of(b, p);
    const NUM *restrict lambda = in[0], *restrict grad_lambda = in[1];
    NUM *restrict v = out[0], *restrict grad_v = out[1];

    if (!(alpha > 0))
        return no_alpha(b);
    for (uint32_t a = 0; a < b->dim; a++)
        PF_LANES_OF (b, i)
            v[a * LD + i] = -alpha * lambda[a * LD + i];
    for (uint32_t k = 0; k < b->dim * b->dim; k++)
        PF_LANES_OF (b, i)
            grad_v[k * LD + i] = -p->viscosity * grad_lambda[k * LD + i];
    return PF_OK;
}

/* lambda . eta in Omega_f  (B.16-B.18, upper lines) */
static int F(fluid_zero)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const NUM *restrict lambda = in[0];
    NUM *restrict eta = out[0];

    for (uint32_t a = 0; a < b->dim; a++)
        PF_LANES_OF (b, i)
            eta[a * LD + i] = lambda[a * LD + i];
    return PF_OK;
}

/* (u - U - omega x r) . eta in Omega_Pk  (B.16-B.18, lower lines) */
static int F(rigid_motion)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const NUM *restrict u = in[0], *restrict U = in[1], *restrict omega = in[2];
    NUM *restrict eta = out[0];

    for (uint32_t a = 0; a < b->dim; a++)
        PF_LANES_OF (b, i)
            eta[a * LD + i] = u[a * LD + i] - U[a * LD + i] - F(pf_turn)(b, omega, a, i);
    return PF_OK;
}

/* ((rho_P - rho_f) dU/dt - rho_P g) . V  (B.28-B.30, inertia and weight) */
static int F(translation)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const struct appendix *p = b->params;
    const NUM *restrict U_t = in[0];
    NUM *restrict V = out[0];

    for (uint32_t a = 0; a < b->dim; a++)
        PF_LANES_OF (b, i)
            V[a * LD + i] = (b->density[i] - p->density) * U_t[a * LD + i] - b->density[i] * p->gravity[a];
    return PF_OK;
}

/* (grad p + alpha lambda) . V  (B.28-B.30, what the fluid does) */
static int F(reaction)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const double alpha = alpha_of(b, b->params);
    const NUM *restrict grad_p = in[0], *restrict lambda = in[1];
    NUM *restrict V = out[0];

    for (uint32_t a = 0; a < b->dim; a++)
        PF_LANES_OF (b, i)
            V[a * LD + i] = grad_p[a * LD + i] + alpha * lambda[a * LD + i];
    return PF_OK;
}

/* (omega - curl u / 2) . xi  (B.31-B.33) */
static int F(mean_curl)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const NUM *restrict grad_u = in[0], *restrict omega = in[1];
    const uint32_t dim = b->dim;
    NUM *restrict xi = out[0];

    for (uint32_t a = 0; a < (dim == 2 ? 1 : 3); a++) {
        const uint32_t p = dim == 2 ? 0 : (a + 1) % 3, q = dim == 2 ? 1 : (a + 2) % 3;

        PF_LANES_OF (b, i)
            xi[a * LD + i] =
                omega[a * LD + i] - 0.5 * (grad_u[(q * dim + p) * LD + i] - grad_u[(p * dim + q) * LD + i]);
    }
    return PF_OK;
}
