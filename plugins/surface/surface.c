/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Sharp surfaces of rigid bodies: no slip by Nitsche's method with the skew sign, which keeps the viscous block
 * positive definite at every position (numerics 5), and cells with too little fluid tied to the polynomial
 * of a neighbour.  The fluid's own terms must act outside of the bodies: fluid { region = "outside" }, which
 * particulate "sharp" sets.
 *
 * n points out of the fluid, r is the arm from the centre of the body, w = u - U - omega x r the slip; z = v - V -
 * xi x r is what the test functions have of it, so that what the fluid gives the body takes, force and torque.  The
 * q rows have the sign of the printed continuity, + psi div u. */
#include <plugflow/term.h>

#include <plugflow/rigid_motion.h>

#define NITSCHE_KEYS VISCOSITY, REAL(gamma, "1", "penalty of the slip, in mu/h", .dflt = 20, PF_NOT_NEGATIVE)
/* Once inlined, the loops over lanes round them are loops of vectors. */
#define INLINE __attribute__((always_inline)) static inline

#define TIE(NAME, DOC) REAL(NAME, "1", DOC, .dflt = 0.1, PF_NOT_NEGATIVE)

/* w = u - U - omega x r at lane i */
INLINE void F(slip)(const pf_batch *b, const NUM *u, const NUM *U, const NUM *omega, uint32_t i, NUM *w)
{
    EACH (a)
        w[a] = AT(u, a) - AT(U, a) - F(pf_turn)(b, omega, a, i);
}

/* What the test functions meet of z at lane i: the fluid gets it, the body what is opposite, force and torque.  n
 * rows lie between the components of v, V and xi: 1, and of a block of derivatives its columns. */
INLINE void F(give)(const pf_batch *b, const NUM *z, uint32_t n, uint32_t i, NUM *v, NUM *V, NUM *xi)
{
    const double *r = b->arm;

    EACH (a) {
        AT(v, a * n) = z[a];
        AT(V, a * n) = -z[a];
    }
    EACH_SPIN (a) {
        const uint32_t j = DIM == 2 ? 0 : (a + 1) % 3, k = DIM == 2 ? 1 : (a + 2) % 3;

        AT(xi, a * n) = AT(r, k) * z[j] - AT(r, j) * z[k];
    }
}

/* -(2 mu D(u) n - p n) . z  +  2 mu D(v) n . w  -  q n . w  +  gamma mu/h w . z */
TERM(nitsche, PF_SURFACE, IN(u, grad_u, p, U, omega, mu), OUT(v, grad_v, q, V, xi), PARAMS(NITSCHE_KEYS),
     .flags = PF_LINEAR | PF_FLUID_FORCE, .jacobian = nitsche_jacobian,
     .doc = "-(2\\mu D(u)n-pn)\\cdot z+2\\mu D(v)n\\cdot w-q\\,n\\cdot w+\\gamma\\frac{\\mu}{h}w\\cdot z,\\ "
            "w=u-U-\\omega\\times r",
     .cite = "Freund and Stenberg 1995 (skew form of Nitsche's method); docs/theory.md")
{
    const double *n = b->normal;

    LANES (i) {
        NUM w[3], z[3] = {0};

        F(slip)(b, u[0], U[0], omega[0], i, w);
        q[i] = 0;
        EACH (a) {
            NUM t = -p[i] * AT(n, a); /* traction 2 mu D(u) n - p n */

            EACH (k) {
                t += mu[i] * (grad_u[a][k][i] + grad_u[k][a][i]) * AT(n, k);
                grad_v[a][k][i] = mu[i] * (w[a] * AT(n, k) + w[k] * AT(n, a));
            }
            z[a] = gamma * mu[i] / b->h[i] * w[a] - t;
            q[i] -= AT(n, a) * w[a];
        }
        F(give)(b, z, 1, i, v[0], V[0], xi[0]);
    }
}

#if PF_ONCE
/* What moves the slip: by component c of u, of U (the opposite) and of omega, -d (omega x r)_a / d omega_c */
INLINE void moves(const pf_batch *b, uint32_t c, double by, double *dw)
{
    EACH (a)
        dw[a] = a == c ? by : 0;
}

INLINE void turns(const pf_batch *b, uint32_t c, uint32_t i, double *dw)
{
    const double *r = b->arm;

    EACH (a)
        if (DIM == 2)
            dw[a] = a == 0 ? AT(r, 1) : -AT(r, 0);
        else
            dw[a] = a == c ? 0 : c == (a + 1) % 3 ? -AT(r, (a + 2) % 3) : AT(r, (a + 1) % 3);
}

/* A column of the rows of nitsche, n of them a block, by what moves the slip by dw */
INLINE void nitsche_column(const pf_batch *b, const double *dw, double mu, double gamma, uint32_t n, uint32_t i,
                           double *dv, double *dgrad_v, double *dq, double *dV, double *dxi)
{
    double z[3] = {0}, through = 0;

    EACH (a) {
        z[a] = gamma * mu / b->h[i] * dw[a];
        through += AT(b->normal, a) * dw[a];
        EACH (k)
            AT(dgrad_v, (a * DIM + k) * n) = mu * (dw[a] * AT(b->normal, k) + dw[k] * AT(b->normal, a));
    }
    dq[i] = -through;
    give_real(b, z, n, i, dv, dV, dxi);
}

/* A column of the rows of inflow, e = -beta rho where w . n < 0, else 0 */
INLINE void inflow_column(const pf_batch *b, const double *w, const double *dw, double e, uint32_t n, uint32_t i,
                          double *dv, double *dV, double *dxi)
{
    double z[3] = {0}, inward = 0, more = 0;

    EACH (a) {
        inward += w[a] * AT(b->normal, a);
        more += dw[a] * AT(b->normal, a);
    }
    EACH (a)
        z[a] = e * (more * w[a] + inward * dw[a]);
    give_real(b, z, n, i, dv, dV, dxi);
}
#endif

JACOBIAN(nitsche, IN(u, grad_u, p, U, omega, mu), PARAMS(NITSCHE_KEYS),
         BLOCKS(BLOCK(v, u), BLOCK(v, grad_u), BLOCK(v, p), BLOCK(v, U), BLOCK(v, omega), BLOCK(v, mu),
                BLOCK(grad_v, u), BLOCK(grad_v, U), BLOCK(grad_v, omega), BLOCK(grad_v, mu), BLOCK(q, u),
                BLOCK(q, U), BLOCK(q, omega), BLOCK(V, u), BLOCK(V, grad_u), BLOCK(V, p), BLOCK(V, U),
                BLOCK(V, omega), BLOCK(V, mu), BLOCK(xi, u), BLOCK(xi, grad_u), BLOCK(xi, p), BLOCK(xi, U),
                BLOCK(xi, omega), BLOCK(xi, mu)))
{
    const double *n = b->normal;

    EACH (c)
        LANES (i) {
            double dw[3];

            moves(b, c, 1, dw);
            nitsche_column(b, dw, mu[i], gamma, DIM, i, dv_du[0][c], dgrad_v_du[0][0][c], dq_du[c], dV_du[0][c],
                           dxi_du[0][c]);
            moves(b, c, -1, dw);
            nitsche_column(b, dw, mu[i], gamma, DIM, i, dv_dU[0][c], dgrad_v_dU[0][0][c], dq_dU[c], dV_dU[0][c],
                           dxi_dU[0][c]);
        }
    EACH_SPIN (c)
        LANES (i) {
            double dw[3];

            turns(b, c, i, dw);
            nitsche_column(b, dw, mu[i], gamma, PF_SPINS, i, dv_domega[0][c], dgrad_v_domega[0][0][c], dq_domega[c],
                           dV_domega[0][c], dxi_domega[0][c]);
        }
    EACH (c)
        EACH (k)
            LANES (i) {
                double z[3] = {0};

                EACH (a)
                    z[a] = -((a == c ? mu[i] * AT(n, k) : 0) + (a == k ? mu[i] * AT(n, c) : 0));
                give_real(b, z, DIM * DIM, i, dv_dgrad_u[0][c][k], dV_dgrad_u[0][c][k], dxi_dgrad_u[0][c][k]);
            }
    LANES (i) {
        double w[3], by_p[3] = {0}, by_mu[3] = {0};

        slip_real(b, u[0], U[0], omega[0], i, w);
        EACH (a) {
            by_p[a] = AT(n, a);
            by_mu[a] = gamma / b->h[i] * w[a];
            EACH (k) {
                by_mu[a] -= (grad_u[a][k][i] + grad_u[k][a][i]) * AT(n, k);
                dgrad_v_dmu[a][k][i] = w[a] * AT(n, k) + w[k] * AT(n, a);
            }
        }
        give_real(b, by_p, 1, i, dv_dp[0], dV_dp[0], dxi_dp[0]);
        give_real(b, by_mu, 1, i, dv_dmu[0], dV_dmu[0], dxi_dmu[0]);
    }
}

#define INFLOW_KEYS                                                                                                \
    DENSITY, REAL(inflow, "1", "strength against inflow through surfaces; 1/2 takes what convection brings",       \
                  .dflt = 0.5, PF_NOT_NEGATIVE)

/* -beta rho (w . n)_- w . z, (s)_- = min(s, 0): where fluid comes out of the surface, which it should not, the
 * energy that convection brings with it is taken away */
TERM(inflow, PF_SURFACE, IN(u, U, omega, rho), OUT(v, V, xi), PARAMS(INFLOW_KEYS),
     .flags = PF_FLUID_FORCE | PF_CONTINUATION, .jacobian = inflow_jacobian,
     .doc = "-\\beta\\rho\\,(w\\cdot n)_-\\,w\\cdot z",
     .cite = "Bertoglio and Caiazzo 2014, Int. J. Numer. Methods Biomed. Eng. 30:4 (at outflows)")
{
    LANES (i) {
        NUM w[3], z[3] = {0}, inward = 0;

        F(slip)(b, u[0], U[0], omega[0], i, w);
        EACH (a)
            inward += w[a] * AT(b->normal, a);
        inward = creal(inward) < 0 ? inward : 0;
        EACH (a)
            z[a] = -inflow * rho[i] * inward * w[a];
        F(give)(b, z, 1, i, v[0], V[0], xi[0]);
    }
}

JACOBIAN(inflow, IN(u, U, omega, rho), PARAMS(INFLOW_KEYS),
         BLOCKS(BLOCK(v, u), BLOCK(v, U), BLOCK(v, omega), BLOCK(v, rho), BLOCK(V, u), BLOCK(V, U), BLOCK(V, omega),
                BLOCK(V, rho), BLOCK(xi, u), BLOCK(xi, U), BLOCK(xi, omega), BLOCK(xi, rho)))
{
    LANES (i) {
        double w[3], dw[3], z[3] = {0}, inward = 0, c;

        slip_real(b, u[0], U[0], omega[0], i, w);
        EACH (a)
            inward += w[a] * AT(b->normal, a);
        c = inward < 0 ? -inflow : 0;
        EACH (k) {
            moves(b, k, 1, dw);
            inflow_column(b, w, dw, c * rho[i], DIM, i, dv_du[0][k], dV_du[0][k], dxi_du[0][k]);
            moves(b, k, -1, dw);
            inflow_column(b, w, dw, c * rho[i], DIM, i, dv_dU[0][k], dV_dU[0][k], dxi_dU[0][k]);
        }
        EACH_SPIN (k) {
            turns(b, k, i, dw);
            inflow_column(b, w, dw, c * rho[i], PF_SPINS, i, dv_domega[0][k], dV_domega[0][k], dxi_domega[0][k]);
        }
        EACH (a)
            z[a] = c * inward * w[a];
        give_real(b, z, 1, i, dv_drho[0], dV_drho[0], dxi_drho[0]);
    }
}

/* (g_u mu/h^2 + g_t rho c0/dt) du . dv  +  g_p/mu dp dq;  d: what differs from the polynomial of the root */
TERM(extension, PF_CUT, IN(SLOT(du, u, DEFECT, VECTOR), SLOT(dp, p, DEFECT, SCALAR), mu, rho),
     OUT(SLOT(dv, u, DEFECT, VECTOR), SLOT(dq, p, DEFECT, SCALAR)),
     PARAMS(DENSITY, VISCOSITY, TIE(g_u, "tie of the velocity, in mu/h^2"),
            TIE(g_t, "tie of the velocity, in rho c0/dt"), TIE(g_p, "tie of the pressure, in 1/mu")),
     .flags = PF_LINEAR, .doc = "(g_u\\mu/h^2+g_t\\rho c_0/\\Delta t)(u-Eu)\\cdot(v-Ev)+g_p/\\mu\\,(p-Ep)(q-Eq)",
     .cite = "Badia, Neiva and Verdugo 2022, Comput. Methods Appl. Mech. Eng. 388:114232 (weak aggregation)")
{
    EACH (a)
        LANES (i) {
            const NUM c = g_u * mu[i] / (b->h[i] * b->h[i]) + g_t * rho[i] * b->shift;

            dv[a][i] = c * du[a][i];
        }
    LANES (i)
        dq[i] = g_p / mu[i] * dp[i];
}

PLUGIN(surface, "sharp surfaces of rigid bodies in cut cells",
       FIELDS(u, p, FIELD(U, "m/s", "velocity of a particle", .support = PF_ON_PARTICLE, .constrains = "u"), omega),
       TERMS(nitsche, inflow, extension), .author = "plugflow", .license = "GPL-3.0-or-later", .min_minor = 4)
#include PF_TWIN
