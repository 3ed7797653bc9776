/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Two fluids that do not mix, with the tension of their interface: a conservative level set phi (Olsson and Kreiss
 * 2005), 0 in the first fluid, of fluid{}, and 1 in the second.  n = grad phi / |grad phi|; d is the distance from
 * the interface, phi = 1/2, across which phi = 1/(1 + exp(d/e)). */
#include <plugflow/term.h>

#define FLAT  0.01 /* e |grad phi| where the fluids count as unmixed */
#define SLACK 1e-4 /* the same for the tension, of which nothing may be lost */

#define NEEDED       .flags = PF_REQUIRED, PF_NOT_NEGATIVE
#define THICKNESS    REAL(thickness, "m", "e of phi = 1/(1 + exp(d/e)); a third of a cell or more", NEEDED)
#define SPEED        REAL(speed, "m/s", "at which the interface is restored; of the size of velocities", NEEDED)
#define TENSION      REAL(tension, "N/m", "tension of the interface", PF_NOT_NEGATIVE)
#define TIE          REAL(g, "1", "tie of phi, in c/h and c0/dt", .dflt = 0.1, PF_NOT_NEGATIVE)
#define OF_SECOND(X) X " of the second fluid"
#define VISCOSITY_2  REAL(viscosity_2, "Pa s", OF_SECOND("dynamic viscosity"), NEEDED)

/* |grad phi| at lane i, which levels off at `least`, so that n dies out where the fluids are unmixed */
static inline NUM F(steepness)(const pf_batch *b, const NUM *grad_phi, double least, uint32_t i)
{
    NUM sum = least * least;

    EACH (k)
        sum += AT(grad_phi, k) * AT(grad_phi, k);
    return sqrt(sum);
}

/* (d phi/dt + u . grad phi) s */
TERM(transport, PF_FLUID, IN(phi_t, u, grad_phi), OUT(test_phi), PARAMS(),
     .doc = "(\\partial_t\\phi+u\\cdot\\nabla\\phi)\\,s",
     .cite = "Olsson and Kreiss 2005, J. Comput. Phys. 210:225",
     PF_EXAMPLES({"d phi/dt = 3, u = (1, -2), grad phi = (3, 5)", 2, NULL, (double[]){3, 1, -2, 3, 5},
                  (double[]){-4}, 1e-15}))
{
    LANES (i)
        test_phi[i] = phi_t[i];
    EACH (k)
        LANES (i)
            test_phi[i] += u[k][i] * grad_phi[k][i];
}

/* c (e grad phi - phi (1 - phi) n) . grad s, at rest for the profile of phi across the interface */
TERM(compression, PF_FLUID, IN(phi, grad_phi), OUT(grad_test_phi), PARAMS(THICKNESS, SPEED),
     .doc = "c\\,(e\\nabla\\phi-\\phi(1-\\phi)\\,n)\\cdot\\nabla s,\\ n=\\nabla\\phi/|\\nabla\\phi|",
     .cite = "Olsson and Kreiss 2005, J. Comput. Phys. 210:225; Chiu and Lin 2011, J. Comput. Phys. 230:185",
     PF_EXAMPLES({"e = 1/1200, c = 2, phi = 1/4, grad phi = (3, -4): 5, and 12 by FLAT, make 13", 2,
                  (double[]){1.0 / 1200, 2}, (double[]){0.25, 3, -4},
                  (double[]){6 * (1.0 / 1200 - 3.0 / 208), -8 * (1.0 / 1200 - 3.0 / 208)}, 1e-14}))
{
    LANES (i) {
        const NUM c =
            speed * (thickness - phi[i] * (1 - phi[i]) / F(steepness)(b, grad_phi[0], FLAT / thickness, i));

        EACH (k)
            grad_test_phi[k][i] = c * grad_phi[k][i];
    }
}

/* sigma |grad phi| (I - n n) : grad v, the tension of the interface drawn out over its thickness */
TERM(tension, PF_FLUID, IN(grad_phi), OUT(grad_v), PARAMS(TENSION, THICKNESS),
     .doc = "\\sigma\\,|\\nabla\\phi|\\,(I-n\\,n):\\nabla v",
     .cite = "Lafaurie et al. 1994, J. Comput. Phys. 113:134",
     PF_EXAMPLES({"sigma = 10, e = 1e6, grad phi = (3, -4): 10/5 (16 12; 12 9)", 2, (double[]){10, 1e6},
                  (double[]){3, -4}, (double[]){32, 24, 24, 18}, 1e-14}))
{
    LANES (i) {
        const NUM steep = F(steepness)(b, grad_phi[0], SLACK / thickness, i);

        EACH (a)
            EACH (k)
                grad_v[a][k][i] = tension * ((a == k ? steep : 0) - grad_phi[a][i] * grad_phi[k][i] / steep);
    }
}

/* rho (du/dt + (u . grad) u - g) . v + 2 mu D(u) : grad v - p div v, without the weight of the first fluid if p is
 * the reduced pressure; rho and mu are those of the fluid at the point */
TERM(momentum, PF_FLUID, IN(phi, u_t, u, grad_u, p), OUT(v, grad_v),
     PARAMS(DENSITY, VISCOSITY, REAL(density_2, "kg/m^3", OF_SECOND("mass per volume"), NEEDED), VISCOSITY_2,
            GRAVITY, REDUCED_PRESSURE),
     .flags = PF_CONTINUATION,
     .replaces = "momentum.inertia momentum.convection momentum.viscous momentum.pressure_gradient "
                 "momentum.body_force",
     .doc = "\\rho\\,(\\partial_t u+(u\\cdot\\nabla)u-g)\\cdot v+(2\\mu D(u)-p\\,I):\\nabla v",
     .cite = "appendix A.7-A.15, with density and viscosity of two fluids",
     PF_EXAMPLES({"phi = 1/2 of rho = 1, 3, mu = 1, 5; g = (0, -10), du/dt = (1, -2), u = (1, 2), grad u = (3 4; 5 "
                  "6), p = 7",
                  2, (double[]){1, 1, 3, 5, 0, -10, 0}, (double[]){0.5, 1, -2, 1, 2, 3, 4, 5, 6, 7},
                  (double[]){24, 50, 11, 27, 27, 29}, 1e-14}))
{
    EACH (a)
        LANES (i) {
            const NUM share = creal(phi[i]) < 0 ? 0 : creal(phi[i]) > 1 ? 1 : phi[i];
            const NUM rho = density + (density_2 - density) * share;
            const NUM mu = viscosity + (viscosity_2 - viscosity) * share;
            NUM rate = u_t[a][i];

            EACH (k) {
                rate += u[k][i] * grad_u[a][k][i];
                grad_v[a][k][i] = mu * (grad_u[a][k][i] + grad_u[k][a][i]) - (a == k ? p[i] : 0);
            }
            v[a][i] = rho * rate - (rho - (reduced_pressure ? density : 0)) * gravity[a];
        }
}

/* g (c/h + c0/dt) dphi ds;  d: what differs from the polynomial of the root */
TERM(tie, PF_CUT, IN(SLOT(dphi, phi, DEFECT, SCALAR)), OUT(SLOT(ds, phi, DEFECT, SCALAR)),
     PARAMS(SPEED, VISCOSITY, VISCOSITY_2, TIE), .flags = PF_LINEAR, .check = tie_check,
     .doc = "g(c/h+c_0/\\Delta t)(\\phi-E\\phi)(s-Es)",
     .cite = "Badia, Neiva and Verdugo 2022, Comput. Methods Appl. Mech. Eng. 388:114232 (weak aggregation)",
     PF_EXAMPLES({"c = 2, g = 0.1, h = 0.1, c0/dt = 15: 0.1 (20 + 15) 3", 2, (double[]){2, 1, 1, 0.1},
                  (double[]){3}, (double[]){10.5}, 1e-14}))
{
    LANES (i)
        ds[i] = g * (speed / b->h[i] + b->shift) * dphi[i];
}

CHECK(tie, PARAMS(SPEED, VISCOSITY, VISCOSITY_2, TIE))
{
    REFUSE_UNLESS(
        viscosity == viscosity_2,
        "the fluids have viscosities %g and %g, but no slip on bodies is held with that of fluid{}: where "
        "there are bodies, viscosity_2 must be the same",
        viscosity, viscosity_2);
}

/* Of the second fluid: volume, its first moments, volume times velocity; and the area of the interface, the mean
 * over the levels of phi near 1/2, as the integral of 2772 phi^5 (1 - phi)^5 is 1: what is smeared elsewhere does
 * not count */
TERM(measures, PF_FLUID, IN(phi, grad_phi, u),
     OUT(INTEGRAL(share, SCALAR, "m^3", OF_SECOND("volume")),
         INTEGRAL(moment, VECTOR, "m^4", OF_SECOND("moment of the volume")),
         INTEGRAL(flow, VECTOR, "m^4/s", OF_SECOND("volume times velocity")),
         INTEGRAL(interface, SCALAR, "m^2", "area of the interface")),
     PARAMS(), .flags = PF_OPTIONAL,
     .doc = "\\phi,\\quad \\phi\\,x,\\quad \\phi\\,u,\\quad 2772\\phi^5(1-\\phi)^5|\\nabla\\phi|",
     .cite = "Hysing et al. 2009, Int. J. Numer. Meth. Fluids 60:1259")
{
    LANES (i) {
        const NUM between = max(0, phi[i] * (1 - phi[i]));
        NUM steep2 = 0;

        share[i] = phi[i];
        EACH (k) {
            moment[k][i] = phi[i] * AT(b->x, k);
            flow[k][i] = phi[i] * u[k][i];
            steep2 += grad_phi[k][i] * grad_phi[k][i];
        }
        interface[i] = 2772 * pow(between, 5) * sqrt(steep2);
    }
}

PLUGIN(level_set, "two fluids that do not mix",
       FIELDS(u, p, FIELD(phi, "1", "share of the second fluid", .order = 2)),
       TERMS(transport, compression, tension, momentum, tie, measures), .author = "plugflow",
       .license = "GPL-3.0-or-later")
#include PF_TWIN
