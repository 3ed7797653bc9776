/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Rigid bodies, conservative (numerics 4): what happens at a point of Omega_P, r the arm from the
 * centre of the body.  Integrated over the body these are its mass and its full inertia,
 *
 *     int rho r x (dw/dt x r) = I dw/dt,      int rho r x (w x (w x r)) = w x I w. */
#include <plugflow/rigid_motion.h>

/* rho_P (dU/dt - g) . V */
static int F(translation)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const pf_fluid *f = b->params;
    const NUM *restrict U_t = in[0];
    NUM *restrict V = out[0];

    for (uint32_t a = 0; a < b->dim; a++)
        PF_LANES_OF (b, i)
            V[a * LD + i] = b->density[i] * (U_t[a * LD + i] - f->gravity[a]);
    return PF_OK;
}

/* r x (w_t x r + w x (w x r)) at lane i; in 2D w x (w x r) is along r and gives nothing */
static inline void F(turning)(const pf_batch *b, const NUM *w_t, const NUM *w, uint32_t i, NUM *m)
{
    const double *r = b->arm;
    NUM a[3], c[3];

    if (b->dim == 2) {
        m[0] = w_t[i] * (r[i] * r[i] + r[LD + i] * r[LD + i]);
        return;
    }
    for (uint32_t k = 0; k < 3; k++)
        c[k] = F(pf_turn)(b, w, k, i);
    for (uint32_t k = 0; k < 3; k++) {
        const uint32_t p = (k + 1) % 3, q = (k + 2) % 3;

        a[k] = F(pf_turn)(b, w_t, k, i) + w[p * LD + i] * c[q] - w[q * LD + i] * c[p];
    }
    for (uint32_t k = 0; k < 3; k++) {
        const uint32_t p = (k + 1) % 3, q = (k + 2) % 3;

        m[k] = r[p * LD + i] * a[q] - r[q * LD + i] * a[p];
    }
}

/* rho_P r x (dw/dt x r + w x (w x r)) . xi */
static int F(rotation)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    NUM *restrict xi = out[0];

    PF_LANES_OF (b, i) {
        NUM m[3];

        F(turning)(b, in[0], in[1], i, m);
        for (uint32_t a = 0; a < (b->dim == 2 ? 1 : 3); a++)
            xi[a * LD + i] = b->density[i] * m[a];
    }
    return PF_OK;
}

/* -rho_f (dU/dt - g) . V - rho_f r x (dw/dt x r + w x (w x r)) . xi: the fluid inside, which moves along */
static int F(displaced)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const pf_fluid *f = b->params;
    const NUM *restrict U_t = in[0];
    NUM *restrict V = out[0], *restrict xi = out[1];

    for (uint32_t a = 0; a < b->dim; a++)
        PF_LANES_OF (b, i)
            V[a * LD + i] = -f->density * (U_t[a * LD + i] - f->gravity[a]);
    PF_LANES_OF (b, i) {
        NUM m[3];

        F(turning)(b, in[1], in[2], i, m);
        for (uint32_t a = 0; a < (b->dim == 2 ? 1 : 3); a++)
            xi[a * LD + i] = -f->density * m[a];
    }
    return PF_OK;
}

/* rho_f g . V: the weight of the fluid displaced, all that is left of it if the fluid inside is none */
static int F(buoyancy)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const pf_fluid *f = b->params;
    NUM *restrict V = out[0];

    (void)in;
    for (uint32_t a = 0; a < b->dim; a++)
        PF_LANES_OF (b, i)
            V[a * LD + i] = f->density * f->gravity[a];
    return PF_OK;
}
