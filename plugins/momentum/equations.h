/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Momentum (appendix A.7-A.15): what happens at one point.
 *
 * Compiled twice (twin_real.h, twin_complex.h), with NUM = double and NUM = pf_complex.  Arrays are
 * [component][lane]; a plain loop over lanes vectorises. */

/* rho du/dt . v */
static int F(inertia)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const NUM *restrict u_t = in[0], *restrict rho = in[1];
    NUM *restrict v = out[0];

    for (uint32_t a = 0; a < b->dim; a++)
        PF_LANES_OF (b, i)
            v[a * LD + i] = rho[i] * u_t[a * LD + i];
    return PF_OK;
}

/* rho (u . grad) u . v */
static int F(convection)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const NUM *restrict u = in[0], *restrict grad_u = in[1], *restrict rho = in[2];
    NUM *restrict v = out[0];
    const uint32_t d = b->dim;

    for (uint32_t a = 0; a < d; a++) {
        PF_LANES_OF (b, i)
            v[a * LD + i] = 0;
        for (uint32_t k = 0; k < d; k++)
            PF_LANES_OF (b, i)
                v[a * LD + i] += rho[i] * u[k * LD + i] * grad_u[(a * d + k) * LD + i];
    }
    return PF_OK;
}

/* 2 mu D(u) : grad v */
static int F(viscous)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const NUM *restrict grad_u = in[0], *restrict mu = in[1];
    NUM *restrict grad_v = out[0];
    const uint32_t d = b->dim;

    for (uint32_t a = 0; a < d; a++)
        for (uint32_t k = 0; k < d; k++)
            PF_LANES_OF (b, i)
                grad_v[(a * d + k) * LD + i] =
                    mu[i] * (grad_u[(a * d + k) * LD + i] + grad_u[(k * d + a) * LD + i]);
    return PF_OK;
}

/* -p div v */
static int F(pressure_gradient)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    PF_LANES_OF (b, i)
        out[0][i] = -in[0][i];
    return PF_OK;
}

/* -(rho g + f) . v; without rho g if p is the reduced pressure */
static int F(body_force)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const pf_fluid *f = b->params;
    const NUM *restrict force = in[0], *restrict rho = in[1];
    NUM *restrict v = out[0];

    for (uint32_t a = 0; a < b->dim; a++)
        PF_LANES_OF (b, i)
            v[a * LD + i] = -((f->reduced_pressure ? 0 : rho[i] * f->gravity[a]) + force[a * LD + i]);
    return PF_OK;
}

/* -t . v on the boundary */
static int F(traction)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const NUM *restrict traction = in[0];
    NUM *restrict v = out[0];

    for (uint32_t a = 0; a < b->dim; a++)
        PF_LANES_OF (b, i)
            v[a * LD + i] = -traction[a * LD + i];
    return PF_OK;
}

/* (p_b - rho g.x) n . v, the traction -p_b n of a given pressure p_b; without rho g.x unless p is the reduced
 * pressure */
static int F(pressure)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const pf_fluid *f = b->params;
    const NUM *restrict pressure = in[0], *restrict rho = in[1];
    NUM *restrict v = out[0];

    for (uint32_t a = 0; a < b->dim; a++)
        PF_LANES_OF (b, i) {
            NUM hydrostatic = 0;

            for (uint32_t k = 0; k < b->dim; k++)
                hydrostatic += rho[i] * f->gravity[k] * b->x[k * LD + i];
            v[a * LD + i] = (pressure[i] - (f->reduced_pressure ? hydrostatic : 0)) * b->normal[a * LD + i];
        }
    return PF_OK;
}

/* -beta/2 rho (u.n)_- u . v, (s)_- = min(s, 0): takes away the energy that fluid coming back through an outflow
 * would bring */
static int F(backflow)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const NUM *restrict u = in[0], *restrict beta = in[1], *restrict rho = in[2];
    NUM *restrict v = out[0];

    PF_LANES_OF (b, i) {
        NUM inward = 0;

        if (creal(beta[i]) < 0)
            return b->host->fail(b, i, PF_FAIL,
                                 "backflow is %g; it must not be negative (1 takes all of the energy)",
                                 creal(beta[i]));
        for (uint32_t a = 0; a < b->dim; a++)
            inward += u[a * LD + i] * b->normal[a * LD + i];
        inward = creal(inward) < 0 ? inward : 0;
        for (uint32_t a = 0; a < b->dim; a++)
            v[a * LD + i] = -0.5 * beta[i] * rho[i] * inward * u[a * LD + i];
    }
    return PF_OK;
}
