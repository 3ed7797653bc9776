/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Seven equations of all kinds on term.h. */
#include <plugflow/term.h>

/* New fields: a shear rate, a mean, the stress of an Oldroyd-B fluid in 2D. */
#define PF_SHAPE_rate SCALAR
#define PF_SHAPE_Phi  SCALAR
#define PF_SHAPE_xx   SCALAR
#define PF_SHAPE_xy   SCALAR
#define PF_SHAPE_yy   SCALAR

static inline NUM F(rate2_of)(const NUM *grad_u, const pf_batch *b, uint32_t i)
{
    NUM rate2 = 0;

    EACH (a)
        EACH (k)
            rate2 += 0.5 * pow(AT(grad_u, a, k) + AT(grad_u, k, a), 2);
    return rate2;
}

/* (rate - sqrt(2 D:D)) r, a derived quantity by projection */
TERM(rate, PF_CELL, IN(VALUE(rate), grad_u), OUT(TEST(rate, r)), PARAMS(), .flags = PF_OPTIONAL,
     .doc = "(\\dot\\gamma-\\sqrt{2D:D})r", .cite = "definition")
{
    LANES (i)
        r[i] = rate[i] - sqrt(F(rate2_of)(grad_u[0][0], b, i) + 1e-20);
}

/* (Phi - mu 2 D:D) X, one number: the mean dissipation */
TERM(mean, PF_CELL, IN(VALUE(Phi), grad_u), OUT(TEST(Phi, X)), PARAMS(VISCOSITY), .flags = PF_OPTIONAL,
     .doc = "(\\Phi-2\\mu D:D)X", .cite = "Batchelor 1967, 3.4")
{
    LANES (i)
        X[i] = Phi[i] - viscosity * F(rate2_of)(grad_u[0][0], b, i);
}

/* -(c (I - nn) grad T) . v on a boundary */
TERM(marangoni, PF_FACET, IN(DATA(marangoni, SCALAR), grad_T), OUT(v), PARAMS(),
     .flags = PF_OPTIONAL | PF_BY_BOUNDARY, .doc = "-c\\nabla_sT\\cdot v", .cite = "Scriven and Sternling 1960")
{
    LANES (i) {
        NUM dT_dn = 0;

        EACH (a)
            dT_dn += grad_T[a][i] * AT(b->normal, a);
        EACH (a)
            v[a][i] = -marangoni[i] * (grad_T[a][i] - dT_dn * AT(b->normal, a));
    }
}

/* R test + tau R u . grad test,  R = dphi/dt + u . grad phi */
TERM(levelset, PF_FLUID, IN(phi_t, u, grad_phi), OUT(test_phi, grad_test_phi),
     PARAMS(REAL(supg, "1", "strength along streamlines", .dflt = 1, PF_NOT_NEGATIVE)), .flags = PF_OPTIONAL,
     .doc = "R\\psi+\\tau R\\,u\\cdot\\nabla\\psi", .cite = "Brooks and Hughes 1982")
{
    LANES (i) {
        NUM R = phi_t[i], speed2 = 1e-20, tau;

        EACH (a) {
            R += u[a][i] * grad_phi[a][i];
            speed2 += u[a][i] * u[a][i];
        }
        tau = supg / sqrt((b->dt > 0 ? 4 / (b->dt * b->dt) : 0) + 4 * speed2 / (b->h[i] * b->h[i]));
        test_phi[i] = R;
        EACH (a)
            grad_test_phi[a][i] = tau * R * u[a][i];
    }
}

/* rho_s c_s dT/dt s + k_s grad T . grad s inside of bodies */
TERM(solid_heat, PF_SOLID, IN(T_t, grad_T), OUT(s, grad_s),
     PARAMS(REAL(k_s, "W/(m K)", "conductivity", .dflt = 1, PF_NOT_NEGATIVE),
            REAL(c_s, "J/(kg K)", "heat capacity", .dflt = 1, PF_NOT_NEGATIVE)),
     .flags = PF_OPTIONAL | PF_LINEAR, .doc = "\\rho_sc_s\\dot Ts+k_s\\nabla T\\cdot\\nabla s",
     .cite = "Fourier's law")
{
    LANES (i)
        s[i] = b->density[i] * c_s * T_t[i];
    EACH (a)
        LANES (i)
            grad_s[a][i] = k_s * grad_T[a][i];
}

/* k_f grad T . grad s */
TERM(fluid_heat, PF_FLUID, IN(grad_T), OUT(grad_s),
     PARAMS(REAL(k_f, "W/(m K)", "conductivity", .dflt = 1, PF_NOT_NEGATIVE)), .flags = PF_OPTIONAL | PF_LINEAR,
     .doc = "k_f\\nabla T\\cdot\\nabla s", .cite = "Fourier's law")
{
    EACH (a)
        LANES (i)
            grad_s[a][i] = k_f * grad_T[a][i];
}

/* lambda (dt/dt + u.grad t - G t - t G^T) + t - 2 eta D against S, and t : grad v; G = grad u */
TERM(oldroyd, PF_FLUID,
     IN(u, grad_u, VALUE(xx), VALUE(xy), VALUE(yy), GRAD(xx), GRAD(xy), GRAD(yy), DOT(xx), DOT(xy), DOT(yy)),
     OUT(TEST(xx, s_xx), TEST(xy, s_xy), TEST(yy, s_yy), grad_v),
     PARAMS(REAL(time, "s", "of relaxation", .dflt = 1, PF_NOT_NEGATIVE),
            REAL(eta_p, "Pa s", "viscosity of the polymer", .dflt = 1, PF_NOT_NEGATIVE)),
     .flags = PF_OPTIONAL | PF_ONLY_2D, .doc = "\\lambda\\overset\\nabla\\tau+\\tau-2\\eta_pD",
     .cite = "Oldroyd 1950")
{
    LANES (i) {
        const NUM ux = grad_u[0][0][i], uy = grad_u[0][1][i], vx = grad_u[1][0][i], vy = grad_u[1][1][i];
        const NUM txx = xx[i], txy = xy[i], tyy = yy[i];
        const NUM Dxx = xx_t[i] + u[0][i] * grad_xx[0][i] + u[1][i] * grad_xx[1][i];
        const NUM Dxy = xy_t[i] + u[0][i] * grad_xy[0][i] + u[1][i] * grad_xy[1][i];
        const NUM Dyy = yy_t[i] + u[0][i] * grad_yy[0][i] + u[1][i] * grad_yy[1][i];

        s_xx[i] = time * (Dxx - 2 * (ux * txx + uy * txy)) + txx - 2 * eta_p * ux;
        s_xy[i] = time * (Dxy - ux * txy - uy * tyy - txx * vx - txy * vy) + txy - eta_p * (uy + vx);
        s_yy[i] = time * (Dyy - 2 * (vx * txy + vy * tyy)) + tyy - 2 * eta_p * vy;
        grad_v[0][0][i] = txx;
        grad_v[0][1][i] = grad_v[1][0][i] = txy;
        grad_v[1][1][i] = tyy;
    }
}

PLUGIN(lab, "trials",
       FIELDS(u, T, phi, FIELD(rate, "1/s", "shear rate", .order = 1),
              FIELD(Phi, "W/m^3", "mean dissipation", .support = PF_ON_PROBLEM),
              FIELD(xx, "Pa", "stress", .order = 2), FIELD(xy, "Pa", "stress", .order = 2),
              FIELD(yy, "Pa", "stress", .order = 2)),
       TERMS(rate, mean, marangoni, levelset, solid_heat, fluid_heat, oldroyd), .author = "plugflow")
#include PF_TWIN
