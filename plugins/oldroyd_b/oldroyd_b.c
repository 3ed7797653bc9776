/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Dilute polymers in a viscous fluid (Oldroyd-B), in the plane:
 *
 *     tau_p = eta_p/lambda (c - I),     dc/dt + (u . grad) c - L c - c L^T = -(c - I)/lambda,     L = grad u,
 *
 * beside the solvent, whose viscosity is that of momentum.  The unknown is psi = log c, so that the conformation c
 * is positive definite whatever the mesh:
 *
 *     dpsi/dt + (u . grad) psi - (W psi - psi W) - 2 f(ad psi) D = (exp(-psi) - I)/lambda,
 *
 * D and W the symmetric and the skew part of grad u, f(x) = x/2 coth(x/2) of differences of eigenvalues.  This is
 * Knechtges' form of Fattal and Kupferman's equation; it has no decomposition that is singular where eigenvalues
 * are equal.  In the plane psi = m I + (d0 d1; d1 -d0), and every function of psi is one of m and y = d0^2 + d1^2,
 * the square of half the distance of its eigenvalues.  Those needed are analytic in y, also where y = 0, so that
 * equal eigenvalues are a point like any other.  In space there is nothing of the kind, hence the plane only. */
#include <plugflow/term.h>

#define PF_SHAPE_psi SYMMETRIC

#define RELAXATION                                                                                                 \
    REAL(relaxation_time, "s", "time in which polymers relax", .flags = PF_REQUIRED | PF_SHARED, .dflt = 1,        \
         .min = 1e-30, .max = 1e30)
#define POLYMER_VISCOSITY                                                                                          \
    REAL(polymer_viscosity, "Pa s", "what polymers add to the viscosity", .flags = PF_REQUIRED | PF_SHARED,        \
         .dflt = 1, PF_NOT_NEGATIVE)

#if PF_ONCE
#define LOG_2 0.69314718055994530942

enum { SERIES = 9 }; /* terms for y < 1: the next one is below 1e-17 */
/* 2n/(2n+1)! */
static const double difference_factor[SERIES + 1] = {0,
                                                     1.0 / 3,
                                                     1.0 / 30,
                                                     1.0 / 840,
                                                     1.0 / 45360,
                                                     1.0 / 3991680,
                                                     1.0 / 518918400,
                                                     1.0 / 93405312000.0,
                                                     1.0 / 22230464256000.0,
                                                     1.0 / 6758061133824000.0};
#endif

/* cosh(s), sinh(s)/s and (s coth(s) - 1)/s^2 as functions of y = s^2 */
static inline void F(of_square)(NUM y, NUM *cosh_s, NUM *sinh_s, NUM *g)
{
    NUM difference = 0; /* (cosh - sinh/s)/y */

    if (creal(y) < 1) {
        NUM c = 1, q = 1;

        /* sum_n y^n/(2n)!, y^n/(2n+1)!, y^(n-1) 2n/(2n+1)!, from the last term on */
        for (int n = SERIES; n > 0; n--) {
            c = 1 + c * y / ((2 * n - 1) * (2 * n));
            q = 1 + q * y / ((2 * n) * (2 * n + 1));
            difference = difference * y + difference_factor[n];
        }
        *cosh_s = c, *sinh_s = q;
    } else {
        const NUM s = sqrt(y), e = exp(s);

        *cosh_s = 0.5 * (e + 1 / e);
        *sinh_s = 0.5 * (e - 1 / e) / s;
        difference = (*cosh_s - *sinh_s) / y;
    }
    *g = difference / *sinh_s;
}

/* exp(sign psi) to {xx, xy, yy} */
static inline void F(exponential)(double sign, NUM xx, NUM xy, NUM yy, NUM *e)
{
    const NUM m = 0.5 * (xx + yy), d0 = 0.5 * (xx - yy), size = exp(sign * m);
    NUM c, q, g;

    F(of_square)(d0 * d0 + xy * xy, &c, &q, &g);
    e[0] = size * (c + sign * q * d0);
    e[1] = size * sign * q * xy;
    e[2] = size * (c - sign * q * d0);
}

/* eta_p/lambda (exp(psi) - I) : grad v */
TERM(stress, PF_FLUID, IN(VALUE(psi)), OUT(grad_v), PARAMS(RELAXATION, POLYMER_VISCOSITY),
     .flags = PF_CONTINUATION | PF_ONLY_2D, .doc = "\\frac{\\eta_p}{\\lambda}(e^\\psi-I):\\nabla v",
     .cite = "Oldroyd 1950, Proc. R. Soc. Lond. A 200:523",
     PF_EXAMPLES({"at rest, both eigenvalues are equal", 2, (double[]){2, 6}, (double[]){0, 0, 0},
                  (double[]){0, 0, 0, 0}, 1e-15},
                 {"psi = log(2) I: eta_p/lambda (2 - 1)", 2, (double[]){2, 6}, (double[]){LOG_2, 0, LOG_2},
                  (double[]){3, 0, 0, 3}, 1e-15},
                 {"eigenvalues of c 4 and 1 along the diagonals", 2, (double[]){2, 6},
                  (double[]){LOG_2, LOG_2, LOG_2}, (double[]){4.5, 4.5, 4.5, 4.5}, 1e-15}))
{
    LANES (i) {
        NUM e[3];

        F(exponential)(1, psi[0][i], psi[1][i], psi[2][i], e);
        for (uint32_t a = 0; a < 2; a++)
            for (uint32_t k = 0; k < 2; k++)
                grad_v[a][k][i] = polymer_viscosity / relaxation_time * (e[a + k] - (a == k ? 1 : 0));
    }
}

/* The residual r of the equation of psi : (s + tau u . grad s),  tau = k (u . G u + c0^2 + 1/lambda^2)^(-1/2) with
 * the metric G of the element and the factor c0 of the time scheme.  f acts on the part of D that turns the
 * eigenvectors: what its vector (e0, e1) has across (d0, d1) is taken s coth(s) times. */
TERM(constitutive, PF_FLUID, IN(VALUE(psi), DOT(psi), GRAD(psi), u, grad_u), OUT(TEST(psi, s), GRAD_TEST(psi, s)),
     PARAMS(RELAXATION,
            REAL(streamline, "1", "strength of the upwinding along streamlines", .dflt = 1, PF_NOT_NEGATIVE)),
     .flags = PF_METRIC | PF_ONLY_2D,
     .doc = "(\\partial_t\\psi+u\\cdot\\nabla\\psi-[W,\\psi]-2f(\\mathrm{ad}\\,\\psi)D-(e^{-\\psi}-I)/\\lambda):"
            "(s+\\tau\\,u\\cdot\\nabla s)",
     .cite = "Fattal and Kupferman 2004, J. Non-Newtonian Fluid Mech. 123:281; Knechtges, Behr and Elgeti 2014, J. "
             "Non-Newtonian Fluid Mech. 214:78",
     PF_EXAMPLES({"at rest psi grows by 2 D, D = (3 5; 5 -3), from equal eigenvalues", 2, (double[]){2, 0},
                  (double[]){0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 3, 4, 6, -3},
                  (double[]){-6, -10, 6, 0, 0, 0, 0, 0, 0}, 1e-15},
                 {"a rotation with W = (0 1; -1 0) turns psi = (1 2; 2 -1); it relaxes infinitely slowly", 2,
                  (double[]){1e30, 0}, (double[]){1, 2, -1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, -1, 0},
                  (double[]){-4, 2, 4, 0, 0, 0, 0, 0, 0}, 1e-15},
                 {"psi_t = (7 8 9) and u . grad psi = 2 (1 2 3) + 3 (4 5 6); psi = log(2) I: 1/2 (1/2 - 1)", 2,
                  (double[]){2, 0}, (double[]){LOG_2, 0, LOG_2, 7, 8, 9, 1, 4, 2, 5, 3, 6, 2, 3, 0, 0, 0, 0},
                  (double[]){21.25, 27, 33.25, 0, 0, 0, 0, 0, 0}, 1e-15}))
{
    LANES (i) {
        const NUM d0 = 0.5 * (psi[0][i] - psi[2][i]), d1 = psi[1][i], y = d0 * d0 + d1 * d1;
        const NUM half = 0.5 * (grad_u[0][0][i] + grad_u[1][1][i]);
        const NUM w = 0.5 * (grad_u[0][1][i] - grad_u[1][0][i]); /* W = (0 w; -w 0) */
        NUM e0 = 0.5 * (grad_u[0][0][i] - grad_u[1][1][i]), e1 = 0.5 * (grad_u[0][1][i] + grad_u[1][0][i]);
        NUM along = e0 * d0 + e1 * d1, c, q, g, back[3], r[3], rate;

        F(of_square)(y, &c, &q, &g);
        e0 += g * (y * e0 - along * d0);
        e1 += g * (y * e1 - along * d1);
        F(exponential)(-1, psi[0][i], psi[1][i], psi[2][i], back);
        r[0] = -2 * w * d1 - 2 * (half + e0);
        r[1] = 2 * w * d0 - 2 * e1;
        r[2] = 2 * w * d1 - 2 * (half - e0);
        rate = b->shift * b->shift + 1 / (relaxation_time * relaxation_time);
        EACH (a)
            EACH (k)
                rate += u[a][i] * AT(b->metric, a, k) * u[k][i];
        for (uint32_t n = 0; n < 3; n++) {
            r[n] += psi_t[n][i] - (back[n] - (n == 1 ? 0 : 1)) / relaxation_time;
            EACH (k)
                r[n] += u[k][i] * grad_psi[n][k][i];
            s[n][i] = r[n];
            EACH (k)
                grad_s[n][k][i] = streamline / sqrt(rate) * r[n] * u[k][i];
        }
    }
}

/* -tau_p n . (v - V - xi x r) on the surface of a body; n points out of the fluid */
TERM(surface, PF_SURFACE, IN(VALUE(psi)), OUT(v, V, xi), PARAMS(RELAXATION, POLYMER_VISCOSITY),
     .flags = PF_FLUID_FORCE | PF_CONTINUATION | PF_ONLY_2D,
     .doc = "-\\frac{\\eta_p}{\\lambda}(e^\\psi-I)\\,n\\cdot(v-V-\\xi\\times r)",
     .cite = "as surface.nitsche; docs/theory.md")
{
    LANES (i) {
        NUM e[3], z[2];

        F(exponential)(1, psi[0][i], psi[1][i], psi[2][i], e);
        for (uint32_t a = 0; a < 2; a++) {
            z[a] = 0;
            for (uint32_t k = 0; k < 2; k++)
                z[a] -= polymer_viscosity / relaxation_time * (e[a + k] - (a == k ? 1 : 0)) * AT(b->normal, k);
            v[a][i] = z[a];
            V[a][i] = -z[a];
        }
        xi[0][i] = AT(b->arm, 1) * z[0] - AT(b->arm, 0) * z[1];
    }
}

/* g (1/lambda + c0) dpsi : ds, d: what differs from the polynomial of the root */
TERM(extension, PF_CUT, IN(SLOT(dpsi, psi, DEFECT, SYMMETRIC)), OUT(SLOT(ds, psi, DEFECT, SYMMETRIC)),
     PARAMS(RELAXATION,
            REAL(tie, "1", "of cells with little fluid, in 1/lambda + c0/dt", .dflt = 1, PF_NOT_NEGATIVE)),
     .flags = PF_LINEAR, .doc = "g(1/\\lambda+c_0/\\Delta t)(\\psi-E\\psi):(s-Es)",
     .cite = "Badia, Neiva and Verdugo 2022, Comput. Methods Appl. Mech. Eng. 388:114232 (weak aggregation)")
{
    for (uint32_t n = 0; n < DIM * (DIM + 1) / 2; n++)
        LANES (i)
            ds[n][i] = tie * (1 / relaxation_time + b->shift) * dpsi[n][i];
}

PLUGIN(oldroyd_b, "stress of dilute polymers (Oldroyd-B) by the logarithm of their conformation",
       FIELDS(FIELD(psi, "1", "logarithm of the polymers' conformation", .order = 2), u, U, omega),
       TERMS(stress, constitutive, surface, extension), .author = "plugflow", .license = "GPL-3.0-or-later")
#include PF_TWIN
