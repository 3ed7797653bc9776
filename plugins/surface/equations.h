/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * No slip on the surface of bodies that cut through cells (numerics 5).  n points out of the fluid, r is the
 * arm from the centre of the body, w = u - U - omega x r the slip; z = v - V - xi x r is what the test
 * functions have of it, so that what the fluid gives the body takes, force and torque.  The q rows have the
 * sign of the printed continuity, + psi div u. */
#include <plugflow/rigid_motion.h>

/* w = u - U - omega x r at lane i */
static inline void F(slip)(const pf_batch *b, const NUM *u, const NUM *U, const NUM *omega, uint32_t i, NUM *w)
{
    for (uint32_t a = 0; a < b->dim; a++)
        w[a] = u[a * LD + i] - U[a * LD + i] - F(pf_turn)(b, omega, a, i);
}

/* What the test functions meet of z at lane i: the fluid gets it, the body what is opposite, force and torque */
static inline void F(give)(const pf_batch *b, const NUM *z, uint32_t i, NUM *v, NUM *V, NUM *xi)
{
    const double *r = b->arm;

    for (uint32_t a = 0; a < b->dim; a++) {
        v[a * LD + i] = z[a];
        V[a * LD + i] = -z[a];
    }
    if (b->dim == 2)
        xi[i] = r[LD + i] * z[0] - r[i] * z[1];
    for (uint32_t a = 0; b->dim == 3 && a < 3; a++) {
        const uint32_t j = (a + 1) % 3, k = (a + 2) % 3;

        xi[a * LD + i] = r[k * LD + i] * z[j] - r[j * LD + i] * z[k];
    }
}

/* -(2 mu D(u) n - p n) . z  +  2 mu D(v) n . w  -  q n . w  +  gamma mu/h w . z */
static int F(nitsche)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const struct surface *s = b->params;
    const NUM *restrict grad_u = in[1], *restrict p = in[2], *restrict viscosity = in[5];
    const double *restrict n = b->normal;
    const uint32_t dim = b->dim;
    NUM *restrict v = out[0], *restrict grad_v = out[1], *restrict q = out[2], *restrict V = out[3],
                  *restrict xi = out[4];

    PF_LANES_OF (b, i) {
        const NUM mu = viscosity[i];
        NUM w[3], z[3] = {0};

        F(slip)(b, in[0], in[3], in[4], i, w);
        q[i] = 0;
        for (uint32_t a = 0; a < dim; a++) {
            NUM t = -p[i] * n[a * LD + i]; /* traction 2 mu D(u) n - p n */

            for (uint32_t k = 0; k < dim; k++) {
                t += mu * (grad_u[(a * dim + k) * LD + i] + grad_u[(k * dim + a) * LD + i]) * n[k * LD + i];
                grad_v[(a * dim + k) * LD + i] = mu * (w[a] * n[k * LD + i] + w[k] * n[a * LD + i]);
            }
            z[a] = s->gamma * mu / b->h[i] * w[a] - t;
            q[i] -= n[a * LD + i] * w[a];
        }
        F(give)(b, z, i, v, V, xi);
    }
    return PF_OK;
}

/* -beta rho (w . n)_- w . z, (s)_- = min(s, 0): where fluid comes out of the surface, which it should not, the
 * energy that convection brings with it is taken away */
static int F(inflow)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const struct inflow *s = b->params;
    const NUM *restrict rho = in[3];
    const uint32_t dim = b->dim;
    NUM *restrict v = out[0], *restrict V = out[1], *restrict xi = out[2];

    PF_LANES_OF (b, i) {
        NUM w[3], z[3] = {0}, inward = 0;

        F(slip)(b, in[0], in[1], in[2], i, w);
        for (uint32_t a = 0; a < dim; a++)
            inward += w[a] * b->normal[a * LD + i];
        inward = creal(inward) < 0 ? inward : 0;
        for (uint32_t a = 0; a < dim; a++)
            z[a] = -s->inflow * rho[i] * inward * w[a];
        F(give)(b, z, i, v, V, xi);
    }
    return PF_OK;
}

/* (g_u mu/h^2 + g_t rho c0/dt) du . dv  +  g_p/mu dp dq;  d: what differs from the polynomial of the root */
static int F(extension)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const struct extension *e = b->params;
    const NUM *restrict du = in[0], *restrict dp = in[1], *restrict mu = in[2], *restrict rho = in[3];
    NUM *restrict dv = out[0], *restrict dq = out[1];

    for (uint32_t a = 0; a < b->dim; a++)
        PF_LANES_OF (b, i) {
            const NUM c = e->g_u * mu[i] / (b->h[i] * b->h[i]) + e->g_t * rho[i] * b->shift;

            dv[a * LD + i] = c * du[a * LD + i];
        }
    PF_LANES_OF (b, i)
        dq[i] = e->g_p / mu[i] * dp[i];
    return PF_OK;
}
