/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Heat and bodies with sharp surfaces, beside the plugin heat for the fluid.  Bodies that conduct have a
 * temperature of their own, T_body, on the cells that they reach into, so that its slope may jump at their
 * surfaces; heat goes over by Nitsche's method with the flux of the fluid.  Or surfaces hold a temperature, or give
 * off a flux: then nothing is solved inside.  The equations stand in equations.h. */
#include <plugflow/fluid.h>

struct heat {
    double conductivity, heat_capacity, density; /* k, c, rho of the fluid, W/(m K), J/(kg K), kg/m^3 */
    double body_conductivity, body_heat_capacity;
    double gamma;    /* penalty of the jump, in k/h                  */
    double g_k, g_t; /* weights of the ties                          */
};

#define HARDLY 1e-8

#include <plugflow/twin_real.h>
#include "equations.h"
#include <plugflow/twin_complex.h>
#include "equations.h"

#define GIVEN         .flags = PF_REQUIRED | PF_SHARED, PF_NOT_NEGATIVE
#define CONDUCTIVITY  PF_NUMBER(struct heat, conductivity, "W/(m K)", "thermal conductivity", GIVEN)
#define HEAT_CAPACITY PF_NUMBER(struct heat, heat_capacity, "J/(kg K)", "heat capacity per mass", GIVEN)
#define BODY_CONDUCTIVITY                                                                                          \
    PF_NUMBER(struct heat, body_conductivity, "W/(m K)", "thermal conductivity of the bodies",                     \
              .flags = PF_REQUIRED, PF_NOT_NEGATIVE)
#define GAMMA                                                                                                      \
    PF_NUMBER(struct heat, gamma, "1", "penalty of a jump at surfaces, in k/h", .dflt = 20, PF_NOT_NEGATIVE)

#define T_SLOT                                                                                                     \
    {                                                                                                              \
        "T", "T", PF_VALUE, PF_SCALAR                                                                              \
    }
#define GRAD_T                                                                                                     \
    {                                                                                                              \
        "grad_T", "T", PF_GRAD, PF_VECTOR                                                                          \
    }
#define GRAD_T_BODY                                                                                                \
    {                                                                                                              \
        "grad_T_b", "T_body", PF_GRAD, PF_VECTOR                                                                   \
    }
#define S                                                                                                          \
    {                                                                                                              \
        "s", "T", PF_VALUE, PF_SCALAR                                                                              \
    }
#define GRAD_S                                                                                                     \
    {                                                                                                              \
        "grad_s", "T", PF_GRAD, PF_VECTOR                                                                          \
    }
#define S_BODY                                                                                                     \
    {                                                                                                              \
        "s_b", "T_body", PF_VALUE, PF_SCALAR                                                                       \
    }
#define GRAD_S_BODY                                                                                                \
    {                                                                                                              \
        "grad_s_b", "T_body", PF_GRAD, PF_VECTOR                                                                   \
    }

static const pf_term tie = {
    PF_TERM(tie),
    .where = PF_CUT,
    .flags = PF_LINEAR,
    .doc = "(g_k k/h^2+g_t\\rho c\\,c_0/\\Delta t)(T-ET)(s-Es)",
    .cite = "Badia, Neiva and Verdugo 2022, Comput. Methods Appl. Mech. Eng. 388:114232 (weak aggregation)",
    PF_IN({"dT", "T", PF_DEFECT, PF_SCALAR}),
    PF_OUT({"ds", "T", PF_DEFECT, PF_SCALAR}),
    PF_PARAMS(
        struct heat, CONDUCTIVITY, HEAT_CAPACITY, PF_DENSITY(struct heat),
        PF_NUMBER(struct heat, g_k, "1", "tie of the temperature, in k/h^2", .dflt = 0.1, PF_NOT_NEGATIVE),
        PF_NUMBER(struct heat, g_t, "1", "tie of the temperature, in rho c c0/dt", .dflt = 0.1, PF_NOT_NEGATIVE)),
};

static const pf_term surface_temperature = {
    PF_TERM(surface_temperature),
    .where = PF_SURFACE,
    .flags = PF_LINEAR | PF_OPTIONAL,
    .doc = "-k\\,\\partial_nT\\,s+k\\,\\partial_ns\\,w+\\gamma\\frac kh\\,w\\,s,\\ w=T-T_b",
    .cite = "Freund and Stenberg 1995 (skew form of Nitsche's method)",
    PF_IN(T_SLOT, GRAD_T, {"temperature", NULL, PF_DATA, PF_SCALAR}),
    PF_OUT(S, GRAD_S),
    PF_PARAMS(struct heat, CONDUCTIVITY, GAMMA),
};

static const pf_term surface_flux = {
    PF_TERM(surface_flux),
    .where = PF_SURFACE,
    .flags = PF_LINEAR | PF_OPTIONAL,
    .doc = "-q\\,s",
    .cite = "Carslaw, Jaeger (1959), 1.9",
    PF_IN({"heat_flux", NULL, PF_DATA, PF_SCALAR}),
    PF_OUT(S),
    PF_EXAMPLES({"q = 3 W/m^2 into the fluid", 2, NULL, (double[]){3}, (double[]){-3}, 1e-15}),
};

static const pf_term interface = {
    PF_TERM(interface),
    .where = PF_SURFACE,
    .flags = PF_LINEAR,
    .doc = "q\\,(s-s_b)+k\\,\\partial_ns\\,(T-T_b),\\ q=-k\\,\\partial_nT+\\gamma\\frac kh(T-T_b)",
    .cite = "Freund and Stenberg 1995 (skew form of Nitsche's method), with the flux of one side",
    PF_IN(T_SLOT, GRAD_T, {"T_b", "T_body", PF_VALUE, PF_SCALAR}),
    PF_OUT(S, GRAD_S, S_BODY),
    PF_PARAMS(struct heat, CONDUCTIVITY, GAMMA),
};

static const pf_term conduction = {
    PF_TERM(conduction),
    .where = PF_SOLID,
    .flags = PF_LINEAR,
    .doc = "k_b\\nabla T_b\\cdot\\nabla s_b",
    .cite = "Carslaw, Jaeger (1959), 1.6",
    PF_IN(GRAD_T_BODY),
    PF_OUT(GRAD_S_BODY),
    PF_PARAMS(struct heat, BODY_CONDUCTIVITY),
    PF_EXAMPLES({"k_b = 3", 2, (double[]){3}, (double[]){1, -2}, (double[]){3, -6}, 1e-15}),
};

static const pf_term storage = {
    PF_TERM(storage),
    .where = PF_SOLID,
    .flags = PF_LINEAR,
    .doc = "\\rho_Pc_b\\,\\partial_tT_b\\,s_b",
    .cite = "Carslaw, Jaeger (1959), 1.6",
    PF_IN({"T_b_t", "T_body", PF_DOT, PF_SCALAR}),
    PF_OUT(S_BODY),
    PF_PARAMS(struct heat, PF_NUMBER(struct heat, body_heat_capacity, "J/(kg K)",
                                     "heat capacity per mass of the bodies", PF_NOT_NEGATIVE)),
};

static const pf_term source = {
    PF_TERM(source),
    .where = PF_SOLID,
    .flags = PF_LINEAR,
    .doc = "-q_b\\,s_b",
    .cite = "Carslaw, Jaeger (1959), 1.6",
    PF_IN({"heat_source", NULL, PF_DATA, PF_SCALAR}),
    PF_OUT(S_BODY),
    PF_EXAMPLES({"q_b = 3 W/m^3", 2, NULL, (double[]){3}, (double[]){-3}, 1e-15}),
};

static const pf_term continuation = {
    PF_TERM(continuation),
    .where = PF_FLUID,
    .flags = PF_LINEAR,
    .doc = "10^{-8}k_b\\nabla T_b\\cdot\\nabla s_b",
    .cite = "docs/theory.md",
    PF_IN(GRAD_T_BODY),
    PF_OUT(GRAD_S_BODY),
    PF_PARAMS(struct heat, BODY_CONDUCTIVITY),
    PF_EXAMPLES({"k_b = 3e8", 2, (double[]){3e8}, (double[]){1, -2}, (double[]){3, -6}, 1e-15}),
};

static const pf_plugin heat_bodies = {
    PF_PLUGIN,
    .min_minor = 1,
    .name = "heat_bodies",
    .version = "1.0",
    .author = "plugflow",
    .license = "GPL-3.0-or-later",
    .doc = "bodies that conduct heat, or hold a temperature",
    PF_FIELDS({.name = "T",
               .unit = "K",
               .doc = "temperature",
               .shape = PF_SCALAR,
               .order = 2,
               .reaction = "heat",
               .reaction_unit = "W"},
              {.name = "T_body",
               .unit = "K",
               .doc = "temperature of bodies",
               .shape = PF_SCALAR,
               .order = 2,
               .support = PF_IN_PARTICLES}),
    PF_TERMS(&tie, &surface_temperature, &surface_flux, &interface, &conduction, &storage, &source, &continuation),
};
PF_ENTRY(heat_bodies)
