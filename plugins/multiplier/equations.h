/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Rigid motion by a multiplier (numerics 4; appendix B.2, B.16-B.18): what happens at a point of
 * Omega_P.  lambda is the multiplier, (U, omega) the motion of the body, r the arm from its
 * centre; alpha = mu/h^2 + rho/dt scales lambda and nothing else. */

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
    const double *restrict r = b->arm;
    NUM *restrict eta = out[0];

    for (uint32_t a = 0; a < b->dim; a++)
        PF_LANES_OF (b, i) {
            const uint32_t p = (a + 1) % 3, q = (a + 2) % 3;
            NUM turn;

            if (b->dim == 2)
                turn = a == 0 ? -omega[i] * r[LD + i] : omega[i] * r[i];
            else
                turn = omega[p * LD + i] * r[q * LD + i] - omega[q * LD + i] * r[p * LD + i];
            eta[a * LD + i] = alpha_of(b, m, i) * (u[a * LD + i] - U[a * LD + i] - turn);
        }
    return PF_OK;
}

/* alpha lambda . V + alpha (r x lambda) . xi */
static int F(reaction)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const struct multiplier *m = b->params;
    const NUM *restrict lambda = in[0];
    const double *restrict r = b->arm;
    NUM *restrict V = out[0], *restrict xi = out[1];

    for (uint32_t a = 0; a < b->dim; a++)
        PF_LANES_OF (b, i)
            V[a * LD + i] = alpha_of(b, m, i) * lambda[a * LD + i];
    if (b->dim == 2) {
        PF_LANES_OF (b, i)
            xi[i] = alpha_of(b, m, i) * (r[i] * lambda[LD + i] - r[LD + i] * lambda[i]);
        return PF_OK;
    }
    for (uint32_t a = 0; a < 3; a++)
        PF_LANES_OF (b, i) {
            const uint32_t p = (a + 1) % 3, q = (a + 2) % 3;

            xi[a * LD + i] =
                alpha_of(b, m, i) * (r[p * LD + i] * lambda[q * LD + i] - r[q * LD + i] * lambda[p * LD + i]);
        }
    return PF_OK;
}
