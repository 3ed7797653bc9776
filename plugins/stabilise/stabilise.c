/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Terms that keep convection-dominated flow stable on meshes that do not resolve it.  They are consistent: they
 * vanish for the exact solution.  The equations stand in equations.h, what they are good for in docs/theory.md. */
#include <plugflow/fluid.h>

#include <tgmath.h>

#define NO_ZERO          1e-150 /* so that fluid without viscosity may be at rest; above the square of a complex step, 1e-200 */
#define BY_TIME          2.0    /* tau is less than half of what the time scheme takes */
#define INVERSE_ESTIMATE 60.0   /* C in h |lap v| <= sqrt(C) |grad v| of second-order elements */

struct stabilise {
    double density, viscosity; /* rho, kg/m^3; mu, Pa s           */
    double grad_div;           /* strength, in rho |u| h          */
};

struct streamline {
    double density, viscosity; /* rho, kg/m^3; mu, Pa s                            */
    double gravity[3];         /* g, m/s^2                                         */
    int reduced_pressure;      /* 1: p is the pressure without rho g.x             */
    double streamline;         /* strength c: tau is c h/2|u| where convection prevails */
};

/* Inputs of streamline */
enum { U, OLD_U, GRAD_U, LAP_U, GRAD_P, U_T, FORCE, RHO, MU };

static inline int is_steady(const pf_batch *b)
{
    return !(b->shift > 0);
}

#include <plugflow/twin_real.h>
#include "equations.h"
#include <plugflow/twin_complex.h>
#include "equations.h"

static int skew_jacobian(const pf_batch *b, const double *const *in, double *const *jac)
{
    const double *restrict u = in[0], *restrict div_u = in[1], *restrict rho = in[2];
    double *restrict dv_du = jac[0], *restrict dv_ddiv = jac[1], *restrict dv_drho = jac[2];

    for (uint32_t a = 0; a < b->dim; a++)
        PF_LANES_OF (b, i) {
            dv_du[(a * b->dim + a) * LD + i] = 0.5 * rho[i] * div_u[i];
            dv_ddiv[a * LD + i] = 0.5 * rho[i] * u[a * LD + i];
            dv_drho[a * LD + i] = 0.5 * div_u[i] * u[a * LD + i];
        }
    return PF_OK;
}

/* f = r^2/sqrt(m), m = r^2 + mu^2;  df/dw = rho^2 h^2 w (r^2 + 2 mu^2)/m^(3/2), which counts where w is u;
 * df/drho = rho h^2 w^2 (r^2 + 2 mu^2)/m^(3/2), df/dmu = -mu r^2/m^(3/2) */
static int grad_div_jacobian(const pf_batch *b, const double *const *in, double *const *jac)
{
    const struct stabilise *s = b->params;
    const double *restrict w = is_steady(b) ? in[0] : in[1], *restrict div_u = in[2], *restrict rho = in[3],
                           *restrict mu = in[4];
    const double follows = is_steady(b) ? 1 : 0;
    double *restrict dq_du = jac[0], *restrict dq_ddiv = jac[2], *restrict dq_drho = jac[3],
                     *restrict dq_dmu = jac[4];

    PF_LANES_OF (b, i) {
        const double rho_h = rho[i] * b->h[i], mu2 = mu[i] * mu[i] + NO_ZERO;
        double w2 = 0, r2, root, slope;

        for (uint32_t k = 0; k < b->dim; k++)
            w2 += w[k * LD + i] * w[k * LD + i];
        r2 = rho_h * rho_h * w2;
        root = sqrt(r2 + mu2);
        slope = s->grad_div * (1 + mu2 / (r2 + mu2)) / root * div_u[i];
        dq_drho[i] = slope * rho[i] * b->h[i] * b->h[i] * w2;
        dq_dmu[i] = -s->grad_div * mu[i] * r2 / (root * root * root) * div_u[i];
        slope *= follows * rho_h * rho_h;
        for (uint32_t k = 0; k < b->dim; k++)
            dq_du[k * LD + i] = slope * w[k * LD + i];
        dq_ddiv[i] = s->grad_div * r2 / root;
    }
    return PF_OK;
}

/* T = c rho m^(-1/2) at a point, and its logarithmic slopes by w, which count where w is u, and by mu; its slope by
 * rho. */
struct scale {
    double T, by_w[3], by_mu, by_rho;
};

/* The slopes: -rho^2 G w / m, -C mu G:G / m; c C mu^2 G:G m^(-3/2) */
static struct scale scale_at(const pf_batch *b, const double *const *in, uint32_t i)
{
    const struct streamline *s = b->params;
    const double *restrict w = is_steady(b) ? in[U] : in[OLD_U], *restrict g = b->metric;
    const double m = rate_real(b, in, w, i), rho = in[RHO][i], mu = in[MU][i], c = s->streamline / sqrt(m);
    struct scale t = {.T = c * rho};
    double squares = 0;

    for (uint32_t j = 0; j < b->dim; j++)
        for (uint32_t k = 0; k < b->dim; k++) {
            const double g_jk = g[(j * b->dim + k) * LD + i];

            t.by_w[j] -= rho * rho / m * g_jk * w[k * LD + i];
            squares += INVERSE_ESTIMATE * g_jk * g_jk;
        }
    t.by_mu = -squares * mu / m;
    t.by_rho = c * (squares * mu * mu + NO_ZERO) / m;
    return t;
}

/* Rows of one component of v, d(T r_a w_k), at one point.  */
static void streamline_row(const pf_batch *b, const double *const *in, double *const *jac, uint32_t a, uint32_t i,
                           const struct scale *t)
{
    const double *restrict u = in[U], *restrict w = is_steady(b) ? u : in[OLD_U], *restrict grad_u = in[GRAD_U];
    const double residual = residual_of_real(b, in, a, i), r = t->T * residual, rho = in[RHO][i];
    const double by_rho = t->by_rho * residual + t->T * acceleration_real(b, in, a, i);
    const double by_mu = r * t->by_mu - t->T * in[LAP_U][a * LD + i];
    const uint32_t d = b->dim;

    for (uint32_t k = 0; k < d; k++) {
        const double c = t->T * w[k * LD + i];
        const uint32_t row = a * d + k;

        for (uint32_t j = 0; j < d; j++) {
            jac[U][(row * d + j) * LD + i] = rho * c * grad_u[(a * d + j) * LD + i];
            if (is_steady(b))
                jac[U][(row * d + j) * LD + i] += r * ((j == k) + t->by_w[j] * u[k * LD + i]);
            jac[GRAD_U][(row * d * d + a * d + j) * LD + i] = rho * c * u[j * LD + i];
        }
        jac[LAP_U][(row * d + a) * LD + i] = -in[MU][i] * c;
        jac[GRAD_P][(row * d + a) * LD + i] = c;
        jac[U_T][(row * d + a) * LD + i] = rho * c;
        jac[RHO][row * LD + i] = by_rho * w[k * LD + i];
        jac[MU][row * LD + i] = by_mu * w[k * LD + i];
    }
}

static int streamline_jacobian(const pf_batch *b, const double *const *in, double *const *jac)
{
    PF_LANES_OF (b, i) {
        const struct scale t = scale_at(b, in, i);

        for (uint32_t a = 0; a < b->dim; a++)
            streamline_row(b, in, jac, a, i, &t);
    }
    return PF_OK;
}

static const pf_term skew = {
    PF_TERM(skew),
    .where = PF_CELL,
    .flags = PF_CONTINUATION,
    .doc = "\\frac12\\rho\\,(\\nabla\\cdot u)\\,u\\cdot v",
    .cite = "Temam 1968, Bull. Soc. Math. France 96:115",
    PF_IN({"u", "u", PF_VALUE, PF_VECTOR}, {"div_u", "u", PF_DIV, PF_SCALAR}, PF_TAKES_DENSITY),
    PF_OUT({"v", "u", PF_VALUE, PF_VECTOR}),
    PF_PARAMS(struct stabilise, PF_DENSITY(struct stabilise)),
    PF_EXAMPLES({"rho = 2, u = (1, 2), div u = 3", 2, NULL, (double[]){1, 2, 3, 2}, (double[]){3, 6}, 1e-15}),
    .jacobian = skew_jacobian,
};

static const pf_term grad_div = {
    PF_TERM(grad_div),
    .where = PF_CELL,
    .flags = PF_CONTINUATION,
    .doc = "c\\,\\frac{r^2}{\\sqrt{r^2+\\mu^2}}\\,(\\nabla\\cdot u)(\\nabla\\cdot v),\\ r=\\rho|w|h",
    .cite = "Olshanskii, Lube, Heister and Löwe 2009, Comput. Methods Appl. Mech. Eng. 198:3975",
    PF_IN({"u", "u", PF_VALUE, PF_VECTOR}, {"old_u", "u", PF_OLD, PF_VECTOR}, {"div_u", "u", PF_DIV, PF_SCALAR},
          PF_TAKES_DENSITY, PF_TAKES_VISCOSITY),
    PF_OUT({"div_v", "u", PF_DIV, PF_SCALAR}),
    PF_PARAMS(struct stabilise, PF_DENSITY(struct stabilise), PF_VISCOSITY(struct stabilise),
              PF_NUMBER(struct stabilise, grad_div, "1", "strength of grad-div, in rho |u| h", .dflt = 0.1,
                        .min = 0, .max = 1000)),
    .jacobian = grad_div_jacobian,
};

static const pf_term streamline = {
    PF_TERM(streamline),
    .where = PF_FLUID,
    .flags = PF_OPTIONAL | PF_CONTINUATION | PF_METRIC,
    .doc =
        "c\\,\\tau\\,(\\rho\\,\\partial_t u+\\rho\\,(u\\cdot\\nabla)u+\\nabla p-\\mu\\,\\Delta u-\\rho g-f)\\cdot"
        "\\rho\\,(w\\cdot\\nabla)v",
    .cite =
        "Brooks and Hughes 1982, Comput. Methods Appl. Mech. Eng. 32:199; Bazilevs et al. 2007, Comput. Methods "
        "Appl. Mech. Eng. 197:173",
    PF_IN({"u", "u", PF_VALUE, PF_VECTOR}, {"old_u", "u", PF_OLD, PF_VECTOR}, {"grad_u", "u", PF_GRAD, PF_TENSOR},
          {"lap_u", "u", PF_LAPLACE, PF_VECTOR}, {"grad_p", "p", PF_GRAD, PF_VECTOR},
          {"u_t", "u", PF_DOT, PF_VECTOR}, {"force", NULL, PF_DATA, PF_VECTOR}, PF_TAKES_DENSITY,
          PF_TAKES_VISCOSITY),
    PF_OUT({"grad_v", "u", PF_GRAD, PF_TENSOR}),
    PF_PARAMS(struct streamline, PF_DENSITY(struct streamline), PF_VISCOSITY(struct streamline),
              PF_GRAVITY(struct streamline), PF_REDUCED_PRESSURE(struct streamline),
              PF_NUMBER(struct streamline, streamline, "1", "strength of the streamline term, in h/2|u|",
                        .dflt = 0.01, PF_NOT_NEGATIVE)),
    /* the metric of worked examples is (4 1; 1 2), the factor of the time scheme 15: m = 4 (2 0.1 15)^2 + 4 22 + 60
     * 22, tau = 0.1/38; residual 2 (1 + 11, -2 + 17 + 10) + (7, 1) - (2, -3) - (5, 4) = (24, 50) */
    PF_EXAMPLES(
        {"rho = 2, mu = 1, c = 0.1, g = (0, -10); u = (1, 2) is carried by w = (2, 1), grad u = (3 4; 5 6), "
         "lap u = (2, -3), grad p = (7, 1), du/dt = (1, -2), f = (5, 4)",
         2, (double[]){2, 1, 0, -10, 0, 0.1}, (double[]){1, 2, 2, 1, 3, 4, 5, 6, 2, -3, 7, 1, 1, -2, 5, 4, 2, 1},
         (double[]){48.0 / 190, 24.0 / 190, 100.0 / 190, 50.0 / 190}, 1e-14},
        {"the same with the reduced pressure: residual (24, 30)", 2, (double[]){2, 1, 0, -10, 1, 0.1},
         (double[]){1, 2, 2, 1, 3, 4, 5, 6, 2, -3, 7, 1, 1, -2, 5, 4, 2, 1},
         (double[]){48.0 / 190, 24.0 / 190, 60.0 / 190, 30.0 / 190}, 1e-14}),
    .jacobian = streamline_jacobian,
};

static const pf_plugin stabilise = {
    PF_PLUGIN,
    .min_minor = 4,
    .name = "stabilise",
    .version = "1.0",
    .author = "plugflow",
    .license = "GPL-3.0-or-later",
    .doc = "stability of convection on meshes that do not resolve it",
    PF_FIELDS(PF_FIELD_VELOCITY, PF_FIELD_PRESSURE),
    PF_TERMS(&skew, &grad_div, &streamline),
};
PF_ENTRY(stabilise)
