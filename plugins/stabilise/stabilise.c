/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Terms that keep convection-dominated flow stable on meshes that do not resolve it.  They are consistent: they
 * vanish with div u or with the residual of momentum, so that the exact solution satisfies the equations with them,
 * too.  What they are good for is in docs/theory.md.
 *
 * w is the velocity; in unsteady flow that of a step ago, so that coefficients, test function and time scale stand
 * still in Newton's method. */
#include <plugflow/term.h>

#define NO_ZERO                                                                                                    \
    1e-150 /* so that fluid without viscosity may be at rest; above the square of a complex step, 1e-200 */
#define BY_TIME          2.0  /* tau is less than half of what the time scheme takes */
#define INVERSE_ESTIMATE 60.0 /* C in h |lap v| <= sqrt(C) |grad v| of second-order elements */

#define IS_STEADY (!(b->shift > 0))
#define GRAD_DIV_KEYS                                                                                              \
    DENSITY, VISCOSITY,                                                                                            \
        REAL(grad_div, "1", "strength of grad-div, in rho |u| h", .dflt = 0.1, .min = 0, .max = 1000)
#define STREAMLINE_KEYS                                                                                            \
    DENSITY, VISCOSITY, GRAVITY, REDUCED_PRESSURE,                                                                 \
        REAL(streamline, "1", "strength of the streamline term, in h/2|u|", .dflt = 0.01, PF_NOT_NEGATIVE)

/* 1/2 rho (div u) u . v: with it convection has no power of its own where div u_h is not zero */
TERM(skew, PF_CELL, IN(u, div_u, rho), OUT(v), PARAMS(DENSITY), .flags = PF_CONTINUATION, .jacobian = skew_jacobian,
     .doc = "\\frac12\\rho\\,(\\nabla\\cdot u)\\,u\\cdot v", .cite = "Temam 1968, Bull. Soc. Math. France 96:115",
     PF_EXAMPLES({"rho = 2, u = (1, 2), div u = 3", 2, NULL, (double[]){1, 2, 3, 2}, (double[]){3, 6}, 1e-15}))
{
    EACH (a)
        LANES (i)
            v[a][i] = 0.5 * rho[i] * div_u[i] * u[a][i];
}

JACOBIAN(skew, IN(u, div_u, rho), PARAMS(DENSITY), BLOCKS(BLOCK(v, u), BLOCK(v, div_u), BLOCK(v, rho)))
{
    EACH (a)
        LANES (i) {
            dv_du[a][a][i] = 0.5 * rho[i] * div_u[i];
            dv_ddiv_u[a][i] = 0.5 * rho[i] * u[a][i];
            dv_drho[a][i] = 0.5 * div_u[i] * u[a][i];
        }
}

/* c r^2/sqrt(r^2 + mu^2) (div u) (div v), r = rho |w| h: c rho |w| h where convection prevails in a cell, of
 * second order in h where viscosity does */
TERM(grad_div, PF_CELL, IN(u, old_u, div_u, rho, mu), OUT(div_v), PARAMS(GRAD_DIV_KEYS), .flags = PF_CONTINUATION,
     .jacobian = grad_div_jacobian,
     .doc = "c\\,\\frac{r^2}{\\sqrt{r^2+\\mu^2}}\\,(\\nabla\\cdot u)(\\nabla\\cdot v),\\ r=\\rho|w|h",
     .cite = "Olshanskii, Lube, Heister and Löwe 2009, Comput. Methods Appl. Mech. Eng. 198:3975")
{
    const NUM(*w)[b->ld] = IS_STEADY ? u : old_u;

    LANES (i) {
        const NUM rho_h = rho[i] * b->h[i];
        NUM r2 = 0;

        EACH (k)
            r2 += w[k][i] * w[k][i];
        r2 *= rho_h * rho_h;
        div_v[i] = grad_div * r2 / sqrt(r2 + mu[i] * mu[i] + NO_ZERO) * div_u[i];
    }
}

/* f = r^2/sqrt(m), m = r^2 + mu^2;  df/dw = rho^2 h^2 w (r^2 + 2 mu^2)/m^(3/2), which counts where w is u;
 * df/drho = rho h^2 w^2 (r^2 + 2 mu^2)/m^(3/2), df/dmu = -mu r^2/m^(3/2) */
JACOBIAN(grad_div, IN(u, old_u, div_u, rho, mu), PARAMS(GRAD_DIV_KEYS),
         BLOCKS(BLOCK(div_v, u), BLOCK(div_v, div_u), BLOCK(div_v, rho), BLOCK(div_v, mu)))
{
    const double(*w)[b->ld] = IS_STEADY ? u : old_u;
    const double follows = IS_STEADY ? 1 : 0;

    LANES (i) {
        const double rho_h = rho[i] * b->h[i], mu2 = mu[i] * mu[i] + NO_ZERO;
        double w2 = 0, r2, root, slope;

        EACH (k)
            w2 += w[k][i] * w[k][i];
        r2 = rho_h * rho_h * w2;
        root = sqrt(r2 + mu2);
        slope = grad_div * (1 + mu2 / (r2 + mu2)) / root * div_u[i];
        ddiv_v_drho[i] = slope * rho[i] * b->h[i] * b->h[i] * w2;
        ddiv_v_dmu[i] = -grad_div * mu[i] * r2 / (root * root * root) * div_u[i];
        slope *= follows * rho_h * rho_h;
        EACH (k)
            ddiv_v_du[k][i] = slope * w[k][i];
        ddiv_v_ddiv_u[i] = grad_div * r2 / root;
    }
}

/* m, which is (c / tau)^2: rho^2 (2 c s)^2 + rho^2 w.G w + C mu^2 G:G, with the metric G and the factor s of the
 * time scheme, so that the strength c weakens tau where convection or viscosity make it, and the step bounds it. No
 * viscosity and no flow: not quite zero. */
static inline NUM F(rate)(const pf_batch *b, NUM rho, NUM mu, const NUM *w, double c, uint32_t i)
{
    const NUM rho2 = rho * rho, mu2 = mu * mu;
    const double by_time = BY_TIME * c * b->shift;
    NUM m = rho2 * by_time * by_time + NO_ZERO;

    EACH (j)
        EACH (k) {
            const double g_jk = AT(b->metric, j, k);

            m += rho2 * AT(w, j) * g_jk * AT(w, k) + INVERSE_ESTIMATE * mu2 * g_jk * g_jk;
        }
    return m;
}

/* Component a of du/dt + (u . grad) u - g; g is 0 if p is the reduced pressure */
static inline NUM F(acceleration)(const pf_batch *b, NUM u_t, const NUM *u, const NUM *grad_u, double g, uint32_t a,
                                  uint32_t i)
{
    NUM rate = u_t - g;

    EACH (k)
        rate += AT(u, k) * AT(grad_u, a, k);
    return rate;
}

/* tau r . rho (w . grad) v with the residual of momentum r = rho (du/dt + (u . grad) u - g) + grad p - mu lap u - f
 * and tau = c m^(-1/2).  Where mu differs from place to place -2 D(u) grad mu is left out.
 *
 * The metric of worked examples is (4 1; 1 2), the factor of the time scheme 15: m = 4 (2 0.1 15)^2 + 4 22 + 60 22,
 * tau = 0.1/38; residual 2 (1 + 11, -2 + 17 + 10) + (7, 1) - (2, -3) - (5, 4) = (24, 50) */
TERM(streamline, PF_FLUID, IN(u, old_u, grad_u, lap_u, grad_p, u_t, DATA(force, VECTOR), rho, mu), OUT(grad_v),
     PARAMS(STREAMLINE_KEYS), .flags = PF_OPTIONAL | PF_CONTINUATION | PF_METRIC, .jacobian = streamline_jacobian,
     .doc =
         "c\\,\\tau\\,(\\rho\\,\\partial_t u+\\rho\\,(u\\cdot\\nabla)u+\\nabla p-\\mu\\,\\Delta u-\\rho g-f)\\cdot"
         "\\rho\\,(w\\cdot\\nabla)v",
     .cite =
         "Brooks and Hughes 1982, Comput. Methods Appl. Mech. Eng. 32:199; Bazilevs et al. 2007, Comput. Methods "
         "Appl. Mech. Eng. 197:173",
     PF_EXAMPLES(
         {"rho = 2, mu = 1, c = 0.1, g = (0, -10); u = (1, 2) is carried by w = (2, 1), grad u = (3 4; 5 6), "
          "lap u = (2, -3), grad p = (7, 1), du/dt = (1, -2), f = (5, 4)",
          2, (double[]){2, 1, 0, -10, 0, 0.1}, (double[]){1, 2, 2, 1, 3, 4, 5, 6, 2, -3, 7, 1, 1, -2, 5, 4, 2, 1},
          (double[]){48.0 / 190, 24.0 / 190, 100.0 / 190, 50.0 / 190}, 1e-14},
         {"the same with the reduced pressure: residual (24, 30)", 2, (double[]){2, 1, 0, -10, 1, 0.1},
          (double[]){1, 2, 2, 1, 3, 4, 5, 6, 2, -3, 7, 1, 1, -2, 5, 4, 2, 1},
          (double[]){48.0 / 190, 24.0 / 190, 60.0 / 190, 30.0 / 190}, 1e-14}))
{
    const NUM(*w)[b->ld] = IS_STEADY ? u : old_u;

    LANES (i) {
        const NUM rho_tau = streamline * rho[i] / sqrt(F(rate)(b, rho[i], mu[i], w[0], streamline, i));

        EACH (a) {
            const double g = reduced_pressure ? 0 : gravity[a];
            const NUM r = rho_tau * (rho[i] * F(acceleration)(b, u_t[a][i], u[0], grad_u[0][0], g, a, i) +
                                     grad_p[a][i] - mu[i] * lap_u[a][i] - force[a][i]);

            EACH (k)
                grad_v[a][k][i] = r * w[k][i];
        }
    }
}

#if PF_ONCE
/* T = c rho m^(-1/2) at a point, and its logarithmic slopes by w, which count where w is u, and by mu; its slope by
 * rho. */
struct scale {
    double T, by_w[3], by_mu, by_rho;
};

/* The slopes: -rho^2 G w / m, -C mu G:G / m; c C mu^2 G:G m^(-3/2) */
static inline struct scale scale_at(const pf_batch *b, double rho, double mu, const double *w, double strength,
                                    uint32_t i)
{
    const double m = rate_real(b, rho, mu, w, strength, i), c = strength / sqrt(m);
    struct scale t = {.T = c * rho};
    double squares = 0;

    EACH (j)
        EACH (k) {
            const double g_jk = AT(b->metric, j, k);

            t.by_w[j] -= rho * rho / m * g_jk * AT(w, k);
            squares += INVERSE_ESTIMATE * g_jk * g_jk;
        }
    t.by_mu = -squares * mu / m;
    t.by_rho = c * (squares * mu * mu + NO_ZERO) / m;
    return t;
}
#endif

/* d(T r_a w_k) */
JACOBIAN(streamline, IN(u, old_u, grad_u, lap_u, grad_p, u_t, DATA(force, VECTOR), rho, mu),
         PARAMS(STREAMLINE_KEYS),
         BLOCKS(BLOCK(grad_v, u), BLOCK(grad_v, grad_u), BLOCK(grad_v, lap_u), BLOCK(grad_v, grad_p),
                BLOCK(grad_v, u_t), BLOCK(grad_v, rho), BLOCK(grad_v, mu)))
{
    const double(*w)[b->ld] = IS_STEADY ? u : old_u;
    const double follows = IS_STEADY ? 1 : 0;

    LANES (i) {
        const struct scale t = scale_at(b, rho[i], mu[i], w[0], streamline, i);

        EACH (a) {
            const double g = reduced_pressure ? 0 : gravity[a];
            const double rate = acceleration_real(b, u_t[a][i], u[0], grad_u[0][0], g, a, i);
            const double residual = rho[i] * rate + grad_p[a][i] - mu[i] * lap_u[a][i] - force[a][i];
            const double r = t.T * residual, by_rho = t.by_rho * residual + t.T * rate;

            EACH (k) {
                const double c = t.T * w[k][i];

                EACH (j) {
                    dgrad_v_du[a][k][j][i] =
                        rho[i] * c * grad_u[a][j][i] + follows * r * ((j == k) + t.by_w[j] * u[k][i]);
                    dgrad_v_dgrad_u[a][k][a][j][i] = rho[i] * c * u[j][i];
                }
                dgrad_v_dlap_u[a][k][a][i] = -mu[i] * c;
                dgrad_v_dgrad_p[a][k][a][i] = c;
                dgrad_v_du_t[a][k][a][i] = rho[i] * c;
                dgrad_v_drho[a][k][i] = by_rho * w[k][i];
                dgrad_v_dmu[a][k][i] = (r * t.by_mu - t.T * lap_u[a][i]) * w[k][i];
            }
        }
    }
}

PLUGIN(stabilise, "stability of convection on meshes that do not resolve it", FIELDS(u, p),
       TERMS(skew, grad_div, streamline), .author = "plugflow", .license = "GPL-3.0-or-later", .min_minor = 4)
#include PF_TWIN
