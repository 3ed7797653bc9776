/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Oldroyd-B in the plane: what happens at one point.  psi = log c, c: conformation of the polymers.  In the plane a
 * symmetric tensor is m I + D, D = (d0 d1; d1 -d0), and every function of psi is one of m and y = d0^2 + d1^2, the
 * square of half the distance of its eigenvalues.  Those below are analytic in y, also where y = 0, so that equal
 * eigenvalues are a point like any other, for complex numbers as well. */

/* cosh(s), sinh(s)/s and (s coth(s) - 1)/s^2 as functions of y = s^2 */
static inline void F(of_square)(NUM y, NUM *cosh_s, NUM *sinh_s, NUM *g)
{
    NUM s, difference; /* (cosh - sinh/s)/y */

    if (creal(y) < 1) {
        NUM c = 1, q = 1, r = 0;

        /* sum_n y^n/(2n)!, y^n/(2n+1)!, y^(n-1) 2n/(2n+1)!, from the last term on */
        for (int n = SERIES; n > 0; n--) {
            c = 1 + c * y / ((2 * n - 1) * (2 * n));
            q = 1 + q * y / ((2 * n) * (2 * n + 1));
        }
        for (int n = SERIES; n > 0; n--)
            r = r * y + difference_factor[n];
        *cosh_s = c, *sinh_s = q, *g = r / q;
        return;
    }
    s = sqrt(y);
    *cosh_s = cosh(s);
    *sinh_s = sinh(s) / s;
    difference = (*cosh_s - *sinh_s) / y;
    *g = difference / *sinh_s;
}

/* exp(sign psi) to {xx, xy, yy} */
static inline void F(exponential)(double sign, const NUM *psi, NUM *e)
{
    const NUM m = 0.5 * (psi[0] + psi[2]), d0 = 0.5 * (psi[0] - psi[2]), size = exp(sign * m);
    NUM c, q, g;

    F(of_square)(d0 * d0 + psi[1] * psi[1], &c, &q, &g);
    e[0] = size * (c + sign * q * d0);
    e[1] = size * sign * q * psi[1];
    e[2] = size * (c - sign * q * d0);
}

/* eta_p/lambda (exp(psi) - I) at lane i */
static inline void F(polymer_stress)(const pf_batch *b, const NUM *psi, uint32_t i, NUM *tau)
{
    const struct polymer *p = b->params;
    const double modulus = p->polymer_viscosity / p->relaxation_time;

    F(exponential)(1, (const NUM[]){psi[i], psi[LD + i], psi[2 * LD + i]}, tau);
    tau[0] = modulus * (tau[0] - 1);
    tau[1] *= modulus;
    tau[2] = modulus * (tau[2] - 1);
}

/* eta_p/lambda (exp(psi) - I) : grad v */
static int F(stress)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    if (b->dim != 2)
        return only_in_the_plane(b);
    PF_LANES_OF (b, i) {
        NUM tau[3];

        F(polymer_stress)(b, in[0], i, tau);
        out[0][i] = tau[0];
        out[0][LD + i] = out[0][2 * LD + i] = tau[1];
        out[0][3 * LD + i] = tau[2];
    }
    return PF_OK;
}

/* r = dpsi/dt + u . grad psi - (W psi - psi W) - 2 f(ad psi) D - (exp(-psi) - I)/lambda, D and W the symmetric and
 * the skew part of grad u.  f(x) = x/2 coth(x/2) acts on the differences of eigenvalues: the part of D that turns
 * the eigenvectors, which is what its vector (e0, e1) has across (d0, d1), is taken s coth(s) times. */
static inline void F(residual_of)(const pf_batch *b, const NUM *const *in, uint32_t i, NUM *r)
{
    const struct polymer *p = b->params;
    const NUM psi[3] = {in[PSI][i], in[PSI][LD + i], in[PSI][2 * LD + i]}, *u = in[U] + i;
    const NUM *grad_u = in[GRAD_U] + i, *grad_psi = in[GRAD_PSI] + i;
    const NUM u_x = grad_u[0], u_y = grad_u[LD], v_x = grad_u[2 * LD], v_y = grad_u[3 * LD];
    const NUM d0 = 0.5 * (psi[0] - psi[2]), d1 = psi[1], y = d0 * d0 + d1 * d1;
    const NUM half = 0.5 * (u_x + v_y), w = 0.5 * (u_y - v_x); /* W = (0 w; -w 0) */
    NUM e0 = 0.5 * (u_x - v_y), e1 = 0.5 * (u_y + v_x), along = e0 * d0 + e1 * d1, c, q, g, back[3];

    F(of_square)(y, &c, &q, &g);
    e0 += g * (y * e0 - along * d0);
    e1 += g * (y * e1 - along * d1);
    F(exponential)(-1, psi, back);
    for (uint32_t k = 0; k < 3; k++)
        r[k] = in[PSI_T][k * LD + i] + u[0] * grad_psi[2 * k * LD] + u[LD] * grad_psi[(2 * k + 1) * LD] -
               (back[k] - (k == 1 ? 0 : 1)) / p->relaxation_time;
    r[0] -= 2 * w * d1 + 2 * (half + e0);
    r[1] -= -2 * w * d0 + 2 * e1;
    r[2] -= -2 * w * d1 + 2 * (half - e0);
}

/* r : (s + tau u . grad s),  tau = k (u.Gu + c0^2 + 1/lambda^2)^(-1/2) with the metric G of the element */
static int F(constitutive)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const struct polymer *p = b->params;
    const double *restrict g = b->metric, rate = 1 / p->relaxation_time;

    if (b->dim != 2)
        return only_in_the_plane(b);
    PF_LANES_OF (b, i) {
        const NUM u = in[U][i], v = in[U][LD + i];
        const NUM tau = p->streamline / sqrt(u * g[i] * u + 2 * u * g[LD + i] * v + v * g[3 * LD + i] * v +
                                             b->shift * b->shift + rate * rate);
        NUM r[3];

        F(residual_of)(b, in, i, r);
        for (uint32_t k = 0; k < 3; k++) {
            out[0][k * LD + i] = r[k];
            out[1][2 * k * LD + i] = tau * r[k] * u;
            out[1][(2 * k + 1) * LD + i] = tau * r[k] * v;
        }
    }
    return PF_OK;
}

/* -tau_p n . (v - V - xi x r) on the surface of a body; n points out of the fluid */
static int F(surface)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const double *restrict n = b->normal, *restrict r = b->arm;

    if (b->dim != 2)
        return only_in_the_plane(b);
    PF_LANES_OF (b, i) {
        NUM tau[3], z[2];

        F(polymer_stress)(b, in[0], i, tau);
        for (uint32_t a = 0; a < 2; a++) {
            z[a] = -(tau[a] * n[i] + tau[a + 1] * n[LD + i]);
            out[0][a * LD + i] = z[a];
            out[1][a * LD + i] = -z[a];
        }
        out[2][i] = r[LD + i] * z[0] - r[i] * z[1];
    }
    return PF_OK;
}

/* g (1/lambda + c0) dpsi : ds, d: what differs from the polynomial of the root */
static int F(extension)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const struct polymer *p = b->params;

    for (uint32_t k = 0; k < b->dim * (b->dim + 1) / 2; k++)
        PF_LANES_OF (b, i)
            out[0][k * LD + i] = p->g_psi * (1 / p->relaxation_time + b->shift) * in[0][k * LD + i];
    return PF_OK;
}
