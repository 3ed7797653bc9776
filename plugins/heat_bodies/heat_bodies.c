/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Heat and bodies with sharp surfaces, beside the plugin heat for the fluid.  Bodies that conduct have a
 * temperature of their own, T_body, on the cells that they reach into, so that its slope may jump at their
 * surfaces; heat goes over by Nitsche's method with the flux of the fluid.  Or surfaces hold a temperature, or give
 * off a flux: then nothing is solved inside.  n points out of the fluid; k, c, rho are the fluid's. */
#include <plugflow/term.h>

#define HARDLY 1e-8 /* of the bodies' conductivity, outside of them */

#define PF_SHAPE_T_body SCALAR
#define GIVEN           .flags = PF_REQUIRED | PF_SHARED, PF_NOT_NEGATIVE
#define CONDUCTIVITY    REAL(conductivity, "W/(m K)", "thermal conductivity", GIVEN)
#define K               PROPERTY_AS(k, conductivity, "W/(m K)", .min = 0, .max = 1e30)
#define GAMMA           REAL(gamma, "1", "penalty of a jump at surfaces, in k/h", .dflt = 20, PF_NOT_NEGATIVE)
#define BODY_CONDUCTIVITY                                                                                          \
    REAL(body_conductivity, "W/(m K)", "thermal conductivity of the bodies", .flags = PF_REQUIRED, PF_NOT_NEGATIVE)
#define BODY_HEAT_CAPACITY                                                                                         \
    REAL(body_heat_capacity, "J/(kg K)", "heat capacity per mass of the bodies", PF_NOT_NEGATIVE)

/* What fluid with this slope of T loses to a surface that is colder by w, -k dT/dn + gamma k/h w at lane i, and
 * what grad s gets, k n w: Nitsche's method with the skew sign */
static inline NUM F(loss)(const pf_batch *b, const NUM *grad_T, NUM w, NUM k, double gamma, uint32_t i, NUM *grad_s)
{
    NUM flux = gamma * k / b->h[i] * w;

    EACH (a) {
        flux -= k * AT(grad_T, a) * AT(b->normal, a);
        AT(grad_s, a) = k * w * AT(b->normal, a);
    }
    return flux;
}

/* -k dT/dn s + k ds/dn (T - T_b) + gamma k/h (T - T_b) s: the surface holds the temperature T_b */
TERM(surface_temperature, PF_SURFACE, IN(T, grad_T, DATA(temperature, SCALAR, .flags = PF_REQUIRED), K),
     OUT(s, grad_s), PARAMS(CONDUCTIVITY, GAMMA), .flags = PF_LINEAR | PF_OPTIONAL,
     .doc = "-k\\,\\partial_nT\\,s+k\\,\\partial_ns\\,w+\\gamma\\frac kh\\,w\\,s,\\ w=T-T_b",
     .cite = "Freund and Stenberg 1995 (skew form of Nitsche's method)",
     PF_EXAMPLES({"k = 2, h = 0.1, n = (0.6, -0.8), grad T = (1, 2), 2 warmer than the surface: 20*2/0.1*2 + 2", 2,
                  (double[]){0, 20}, (double[]){3, 1, 2, 1, 2}, (double[]){802, 2.4, -3.2}, 1e-14}))
{
    LANES (i)
        s[i] = F(loss)(b, grad_T[0], T[i] - temperature[i], k[i], gamma, i, grad_s[0]);
}

/* The same with the temperature of the body, which gets what the fluid loses */
TERM(interface, PF_SURFACE, IN(T, grad_T, VALUE(T_body), K), OUT(s, grad_s, TEST(T_body, s_b)),
     PARAMS(CONDUCTIVITY, GAMMA), .flags = PF_LINEAR,
     .doc = "q\\,(s-s_b)+k\\,\\partial_ns\\,(T-T_b),\\ q=-k\\,\\partial_nT+\\gamma\\frac kh(T-T_b)",
     .cite = "Freund and Stenberg 1995 (skew form of Nitsche's method), with the flux of one side",
     PF_EXAMPLES({"k = 2, h = 0.1, n = (0.6, -0.8), grad T = (1, 2), 2 warmer than the body: 20*2/0.1*2 + 2", 2,
                  (double[]){0, 20}, (double[]){3, 1, 2, 1, 2}, (double[]){802, 2.4, -3.2, -802}, 1e-14}))
{
    LANES (i) {
        s[i] = F(loss)(b, grad_T[0], T[i] - T_body[i], k[i], gamma, i, grad_s[0]);
        s_b[i] = -s[i];
    }
}

/* -q s: the surface gives off heat */
TERM(surface_flux, PF_SURFACE, IN(DATA(heat_flux, SCALAR, .flags = PF_REQUIRED)), OUT(s), PARAMS(),
     .flags = PF_LINEAR | PF_OPTIONAL, .doc = "-q\\,s", .cite = "Carslaw, Jaeger (1959), 1.9",
     PF_EXAMPLES({"q = 3 W/m^2 into the fluid", 2, NULL, (double[]){3}, (double[]){-3}, 1e-15}))
{
    LANES (i)
        s[i] = -heat_flux[i];
}

/* k_b grad T_b . grad s_b */
TERM(conduction, PF_SOLID, IN(GRAD(T_body)), OUT(GRAD_TEST(T_body, s_b)), PARAMS(BODY_CONDUCTIVITY),
     .flags = PF_LINEAR, .doc = "k_b\\nabla T_b\\cdot\\nabla s_b", .cite = "Carslaw, Jaeger (1959), 1.6",
     PF_EXAMPLES({"k_b = 3", 2, (double[]){3}, (double[]){1, -2}, (double[]){3, -6}, 1e-15}))
{
    EACH (k)
        LANES (i)
            grad_s_b[k][i] = body_conductivity * grad_T_body[k][i];
}

/* The same, next to nothing of it, outside: some unknowns of cut cells have next to no body */
TERM(continuation, PF_FLUID, IN(GRAD(T_body)), OUT(GRAD_TEST(T_body, s_b)), PARAMS(BODY_CONDUCTIVITY),
     .flags = PF_LINEAR, .doc = "10^{-8}k_b\\nabla T_b\\cdot\\nabla s_b", .cite = "docs/theory.md",
     PF_EXAMPLES({"k_b = 3e8", 2, (double[]){3e8}, (double[]){1, -2}, (double[]){3, -6}, 1e-15}))
{
    EACH (k)
        LANES (i)
            grad_s_b[k][i] = HARDLY * body_conductivity * grad_T_body[k][i];
}

/* rho_P c_b dT_b/dt s_b */
TERM(storage, PF_SOLID, IN(DOT(T_body)), OUT(TEST(T_body, s_b)), PARAMS(BODY_HEAT_CAPACITY), .flags = PF_LINEAR,
     .doc = "\\rho_Pc_b\\,\\partial_tT_b\\,s_b", .cite = "Carslaw, Jaeger (1959), 1.6",
     PF_EXAMPLES({"c_b = 4, rho_P = 2", 2, (double[]){4}, (double[]){3}, (double[]){24}, 1e-15}))
{
    LANES (i)
        s_b[i] = b->density[i] * body_heat_capacity * T_body_t[i];
}

/* -q_b s_b, heat made in the bodies, per volume */
TERM(source, PF_SOLID, IN(DATA(heat_source, SCALAR)), OUT(TEST(T_body, s_b)), PARAMS(), .flags = PF_LINEAR,
     .doc = "-q_b\\,s_b", .cite = "Carslaw, Jaeger (1959), 1.6",
     PF_EXAMPLES({"q_b = 3 W/m^3", 2, NULL, (double[]){3}, (double[]){-3}, 1e-15}))
{
    LANES (i)
        s_b[i] = -heat_source[i];
}

PLUGIN(heat_bodies, "bodies that conduct heat, hold a temperature, or give off heat",
       FIELDS(T, FIELD(T_body, "K", "temperature of bodies", .order = 2, .support = PF_IN_PARTICLES)),
       TERMS(surface_temperature, surface_flux, interface, conduction, continuation, storage, source),
       .author = "plugflow", .license = "GPL-3.0-or-later")
#include PF_TWIN
