/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Heat carried and conducted by a fluid, and the buoyancy it causes (Boussinesq),
 *
 *     rho c (dT/dt + u . grad T) = div(k grad T),     rho Du/dt = ... + rho (1 - beta (T - T_ref)) g.
 *
 * A plugin outside plugflow's own tree: a field of its own, T, and terms that couple it to the
 * velocity u of momentum. */
#include <plugflow/term.h>

/* So that fluid without conductivity may be at rest; above the square of a complex step, 1e-200. */
#define NO_ZERO          1e-150
#define INVERSE_ESTIMATE 60.0 /* C in h |lap s| <= sqrt(C) |grad s| of second-order elements */

/* The keys; each term lists its own. */
#define CONDUCTIVITY REAL(conductivity, "W/(m K)", "thermal conductivity", .flags = PF_REQUIRED, PF_NOT_NEGATIVE)
#define HEAT_CAPACITY                                                                                              \
    REAL(heat_capacity, "J/(kg K)", "heat capacity per mass", .flags = PF_REQUIRED, PF_NOT_NEGATIVE)
#define EXPANSION REAL(expansion, "1/K", "relative change of volume with temperature", .dflt = 0)
#define REFERENCE REAL(reference_temperature, "K", "temperature at which density holds", .dflt = 0)

/* rho c dT/dt s.  The example is one point, worked out by hand; its parameters are in the order of the keys. */
TERM(storage, PF_FLUID, IN(T_t), OUT(s), PARAMS(HEAT_CAPACITY, DENSITY), .flags = PF_LINEAR,
     .doc = "\\rho c\\,\\partial_t T\\,s", .cite = "Bird, Stewart, Lightfoot (2002), 11.2",
     PF_EXAMPLES({"c = 4, rho = 2: 4*2*3", 2, (double[]){4, 2}, (double[]){3}, (double[]){24}, 1e-15}))
{
    LANES (i)
        s[i] = density * heat_capacity * T_t[i];
}

/* rho c (u . grad T) s */
TERM(advection, PF_FLUID, IN(u, grad_T), OUT(s), PARAMS(HEAT_CAPACITY, DENSITY), .flags = PF_CONTINUATION,
     .jacobian = advection_jacobian, .doc = "\\rho c\\,(u\\cdot\\nabla T)\\,s",
     .cite = "Bird, Stewart, Lightfoot (2002), 11.2",
     PF_EXAMPLES({"u = (1, -2), grad T = (3, 5): 4*2*(1*3 - 2*5)", 2, (double[]){4, 2}, (double[]){1, -2, 3, 5},
                  (double[]){-56}, 1e-15}))
{
    LANES (i) {
        s[i] = 0;
        EACH (k)
            s[i] += density * heat_capacity * u[k][i] * grad_T[k][i];
    }
}

/* By hand, as an example; the other terms leave their derivatives to the complex twins. */
JACOBIAN(advection, IN(u, grad_T), PARAMS(HEAT_CAPACITY, DENSITY), BLOCKS(BLOCK(s, u), BLOCK(s, grad_T)))
{
    LANES (i)
        EACH (k) {
            ds_du[k][i] = density * heat_capacity * grad_T[k][i];
            ds_dgrad_T[k][i] = density * heat_capacity * u[k][i];
        }
}

/* k grad T . grad s */
TERM(diffusion, PF_FLUID, IN(grad_T), OUT(grad_s), PARAMS(CONDUCTIVITY), .flags = PF_LINEAR,
     .doc = "k\\,\\nabla T\\cdot\\nabla s", .cite = "Fourier's law; Carslaw, Jaeger (1959), 1.6",
     PF_EXAMPLES({"k = 3, grad T = (1, -2, 5)", 3, (double[]){3}, (double[]){1, -2, 5}, (double[]){3, -6, 15},
                  1e-15}))
{
    EACH (k)
        LANES (i)
            grad_s[k][i] = conductivity * grad_T[k][i];
}

/* tau (rho c (dT/dt + u . grad T) - k lap T) rho c (w . grad s),   rho c tau = rho c / sqrt(m),
 * m = (rho c)^2 (4 s^2 + w . G w) + C k^2 G : G, with the metric G and the factor s of the time scheme.  w is the
 * velocity; in unsteady flow that of a step ago, so that only the residual moves in Newton's method.  The metric of
 * worked examples is (4 1; 1 2), the factor of the time scheme 15: m = 4 (900 + 214) + 60 22 = 76^2; residual
 * 2 (13 + 3 - 10) + 7 = 19 */
TERM(streamline, PF_FLUID, IN(u, old_u, grad_T, lap_T, T_t), OUT(grad_s),
     PARAMS(CONDUCTIVITY, HEAT_CAPACITY, DENSITY), .flags = PF_OPTIONAL | PF_CONTINUATION | PF_METRIC,
     .doc =
         "\\tau\\,(\\rho c\\,\\partial_t T+\\rho c\\,u\\cdot\\nabla T-k\\,\\Delta T)\\,\\rho c\\,w\\cdot\\nabla s",
     .cite = "Brooks and Hughes 1982, Comput. Methods Appl. Mech. Eng. 32:199",
     PF_EXAMPLES({"k = 1, rho c = 2; u = (1, -2) is carried by w = (2, 9), grad T = (3, 5), lap T = -7, dT/dt = 13",
                  2, (double[]){1, 0.5, 4}, (double[]){1, -2, 2, 9, 3, 5, -7, 13}, (double[]){1, 4.5}, 1e-14}))
{
    const double rc = density * heat_capacity;

    LANES (i) {
        NUM r = rc * T_t[i] - conductivity * lap_T[i], m = 4 * rc * rc * b->shift * b->shift + NO_ZERO, w[3];

        EACH (j)
            w[j] = b->shift > 0 ? old_u[j][i] : u[j][i];
        EACH (j) {
            r += rc * u[j][i] * grad_T[j][i];
            EACH (k) {
                const double g_jk = AT(b->metric, j, k);

                m += rc * rc * w[j] * g_jk * w[k] + INVERSE_ESTIMATE * conductivity * conductivity * g_jk * g_jk;
            }
        }
        EACH (k)
            grad_s[k][i] = rc / sqrt(m) * r * w[k];
    }
}

/* rho beta (T - T_ref) g . v, what remains of -rho(T) g . v beside the -rho g . v of momentum */
TERM(buoyancy, PF_FLUID, IN(T), OUT(v), PARAMS(DENSITY, EXPANSION, REFERENCE, GRAVITY),
     .flags = PF_LINEAR | PF_CONTINUATION, .doc = "\\rho\\beta\\,(T-T_{ref})\\,g\\cdot v",
     .cite = "Gray, Giorgini, Int. J. Heat Mass Transfer 19 (1976) 545-551",
     PF_EXAMPLES({"hot rises: T - T_ref = 10, 2*0.5*10*(0, -3)", 2, (double[]){2, 0.5, 300, 0, -3}, (double[]){310},
                  (double[]){0, -30}, 1e-15}))
{
    EACH (a)
        LANES (i)
            v[a][i] = density * expansion * (T[i] - reference_temperature) * gravity[a];
}

/* -q s on the boundary, q > 0 into the fluid */
TERM(heat_flux, PF_FACET, IN(DATA(heat_flux, SCALAR)), OUT(s), PARAMS(), .flags = PF_LINEAR | PF_BY_BOUNDARY,
     .doc = "-q\\,s", .cite = "Carslaw, Jaeger (1959), 1.9",
     PF_EXAMPLES({"q = 7", 2, NULL, (double[]){7}, (double[]){-7}, 1e-15}))
{
    LANES (i)
        s[i] = -heat_flux[i];
}

/* u as momentum declares it, T for the first time. */
PLUGIN(scalar_transport, "transport of heat by a fluid, and its buoyancy (Boussinesq)", FIELDS(u, T),
       TERMS(storage, advection, diffusion, streamline, buoyancy, heat_flux), .min_minor = 3, .author = "plugflow",
       .license = "GPL-3.0-or-later")
#include PF_TWIN
