/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Heat carried and conducted by a fluid, and the buoyancy it causes (Boussinesq),
 *
 *     rho c (dT/dt + u . grad T) = div(k grad T) + q,     rho Du/dt = ... + rho (1 - beta (T - T_ref)) g.
 *
 * Bodies with sharp surfaces keep no heat and let none pass; what else they may do the plugin heat_bodies says. */
#include <plugflow/term.h>

#define NO_ZERO          1e-150 /* so that fluid without conductivity may be at rest */
#define INVERSE_ESTIMATE 60.0   /* K in h |lap s| <= sqrt(K) |grad s| of second-order elements */

#define GIVEN         .flags = PF_REQUIRED | PF_SHARED, PF_NOT_NEGATIVE
#define CONDUCTIVITY  REAL(conductivity, "W/(m K)", "thermal conductivity", GIVEN)
#define K             PROPERTY_AS(k, conductivity, "W/(m K)", .min = 0, .max = 1e30)
#define HEAT_CAPACITY REAL(heat_capacity, "J/(kg K)", "heat capacity per mass", GIVEN)

/* rho c dT/dt s */
TERM(storage, PF_FLUID, IN(T_t, rho), OUT(s), PARAMS(HEAT_CAPACITY, DENSITY), .flags = PF_LINEAR,
     .doc = "\\rho c\\,\\partial_t T\\,s", .cite = "Bird, Stewart, Lightfoot (2002), 11.2",
     PF_EXAMPLES({"c = 4, rho = 2: 4*2*3", 2, (double[]){4, 0}, (double[]){3, 2}, (double[]){24}, 1e-15}))
{
    LANES (i)
        s[i] = rho[i] * heat_capacity * T_t[i];
}

/* rho c (u . grad T) s */
TERM(advection, PF_FLUID, IN(u, grad_T, rho), OUT(s), PARAMS(HEAT_CAPACITY, DENSITY), .flags = PF_CONTINUATION,
     .doc = "\\rho c\\,(u\\cdot\\nabla T)\\,s", .cite = "Bird, Stewart, Lightfoot (2002), 11.2",
     PF_EXAMPLES({"u = (1, -2), grad T = (3, 5): 4*2*(1*3 - 2*5)", 2, (double[]){4, 0}, (double[]){1, -2, 3, 5, 2},
                  (double[]){-56}, 1e-15}))
{
    LANES (i)
        s[i] = 0;
    EACH (k)
        LANES (i)
            s[i] += rho[i] * heat_capacity * u[k][i] * grad_T[k][i];
}

/* k grad T . grad s */
TERM(diffusion, PF_FLUID, IN(grad_T, K), OUT(grad_s), PARAMS(CONDUCTIVITY), .flags = PF_LINEAR,
     .doc = "k\\,\\nabla T\\cdot\\nabla s", .cite = "Fourier's law; Carslaw, Jaeger (1959), 1.6",
     PF_EXAMPLES({"k = 3, grad T = (1, -2, 5)", 3, NULL, (double[]){1, -2, 5, 3}, (double[]){3, -6, 15}, 1e-15}))
{
    EACH (a)
        LANES (i)
            grad_s[a][i] = k[i] * grad_T[a][i];
}

/* -q s, heat made in the fluid, per volume */
TERM(source, PF_FLUID, IN(DATA(heat_source, SCALAR)), OUT(s), PARAMS(), .flags = PF_LINEAR, .doc = "-q\\,s",
     .cite = "Bird, Stewart, Lightfoot (2002), 11.2",
     PF_EXAMPLES({"q = 3 W/m^3 into the fluid", 2, NULL, (double[]){3}, (double[]){-3}, 1e-15}))
{
    LANES (i)
        s[i] = -heat_source[i];
}

/* tau (C (dT/dt + u . grad T) - k lap T - q) C (w . grad s),  C = rho c,  C tau = C / sqrt(m),
 * m = C^2 (4 c0^2 + w . G w) + K k^2 G : G, with the metric G and the factor c0 of the time scheme.  w is the
 * velocity; in unsteady flow that of a step ago, so that only the residual moves in Newton's method.  The metric of
 * worked examples is (4 1; 1 2), c0 = 15: m = 4 (900 + 214) + 60 22 = 76^2; residual 2 (13 + 3 - 10) + 7 - 5 = 14.
 */
TERM(
    streamline, PF_FLUID, IN(u, old_u, grad_T, lap_T, T_t, DATA(heat_source, SCALAR), K, rho), OUT(grad_s),
    PARAMS(CONDUCTIVITY, HEAT_CAPACITY, DENSITY), .flags = PF_OPTIONAL | PF_CONTINUATION | PF_METRIC,
    .doc =
        "\\tau\\,(\\rho c\\,\\partial_t T+\\rho c\\,u\\cdot\\nabla T-k\\,\\Delta T-q)\\,\\rho c\\,w\\cdot\\nabla s",
    .cite = "Brooks and Hughes 1982, Comput. Methods Appl. Mech. Eng. 32:199",
    PF_EXAMPLES({"k = 1, rho c = 2; u = (1, -2) is carried by w = (2, 9), grad T = (3, 5), lap T = -7, dT/dt = 13, "
                 "q = 5",
                 2, (double[]){0, 1, 0}, (double[]){1, -2, 2, 9, 3, 5, -7, 13, 5, 1, 2},
                 (double[]){56.0 / 76, 252.0 / 76}, 1e-14}))
{
    LANES (i) {
        const NUM C = rho[i] * heat_capacity;
        NUM r = C * T_t[i] - k[i] * lap_T[i] - heat_source[i], m = 4 * C * C * b->shift * b->shift + NO_ZERO;

        EACH (j) {
            r += C * u[j][i] * grad_T[j][i];
            EACH (l) {
                const NUM w_w = b->shift > 0 ? old_u[j][i] * old_u[l][i] : u[j][i] * u[l][i];
                const double G = AT(b->metric, j, l);

                m += C * C * G * w_w + INVERSE_ESTIMATE * k[i] * k[i] * G * G;
            }
        }
        EACH (j)
            grad_s[j][i] = C / sqrt(m) * r * (b->shift > 0 ? old_u[j][i] : u[j][i]);
    }
}

/* rho beta (T - T_ref) g . v, what remains of -rho(T) g . v beside the -rho g . v of momentum */
TERM(buoyancy, PF_FLUID, IN(T, rho), OUT(v),
     PARAMS(REAL(expansion, "1/K", "relative change of volume with temperature"),
            REAL(reference_temperature, "K", "temperature at which the density holds"), DENSITY, GRAVITY),
     .flags = PF_LINEAR | PF_CONTINUATION, .doc = "\\rho\\beta\\,(T-T_{ref})\\,g\\cdot v",
     .cite = "Gray, Giorgini, Int. J. Heat Mass Transfer 19 (1976) 545-551",
     PF_EXAMPLES({"beta = 0.5, T_ref = 3, rho = 2, g = (0, -10), T = 7", 2, (double[]){0.5, 3, 0, 0, -10},
                  (double[]){7, 2}, (double[]){0, -40}, 1e-15}))
{
    EACH (a)
        LANES (i)
            v[a][i] = rho[i] * expansion * (T[i] - reference_temperature) * gravity[a];
}

/* -q s on a boundary, q > 0 into the fluid */
TERM(heat_flux, PF_FACET, IN(DATA(heat_flux, SCALAR)), OUT(s), PARAMS(), .flags = PF_LINEAR | PF_BY_BOUNDARY,
     .doc = "-q\\,s", .cite = "Carslaw, Jaeger (1959), 1.9",
     PF_EXAMPLES({"q = 3 W/m^2 into the fluid", 2, NULL, (double[]){3}, (double[]){-3}, 1e-15}))
{
    LANES (i)
        s[i] = -heat_flux[i];
}

/* (g_k k/h^2 + g_t rho c c0/dt) dT ds;  d: what differs from the polynomial of the root. */
TERM(tie, PF_CUT, IN(SLOT(dT, T, DEFECT, SCALAR), K, rho), OUT(SLOT(ds, T, DEFECT, SCALAR)),
     PARAMS(CONDUCTIVITY, HEAT_CAPACITY, DENSITY,
            REAL(g_k, "1", "tie of the temperature, in k/h^2", .dflt = 0.1, PF_NOT_NEGATIVE),
            REAL(g_t, "1", "tie of the temperature, in rho c c0/dt", .dflt = 0.1, PF_NOT_NEGATIVE)),
     .flags = PF_LINEAR, .doc = "(g_k k/h^2+g_t\\rho c\\,c_0/\\Delta t)(T-ET)(s-Es)",
     .cite = "Badia, Neiva and Verdugo 2022, Comput. Methods Appl. Mech. Eng. 388:114232 (weak aggregation)",
     PF_EXAMPLES({"k = 2, c = 4, rho = 3, weights 0.1 and 0.2; h = 0.1, c0/dt = 15: (20 + 36) 5", 2,
                  (double[]){0, 4, 0, 0.1, 0.2}, (double[]){5, 2, 3}, (double[]){280}, 1e-14}))
{
    LANES (i)
        ds[i] = (g_k * k[i] / (b->h[i] * b->h[i]) + g_t * rho[i] * heat_capacity * b->shift) * dT[i];
}

PLUGIN(heat, "heat carried and conducted by a fluid, and buoyancy", FIELDS(T, u),
       TERMS(storage, advection, diffusion, source, streamline, buoyancy, heat_flux, tie), .author = "plugflow",
       .license = "GPL-3.0-or-later")
#include PF_TWIN
