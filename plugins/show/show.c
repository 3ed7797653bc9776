/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What one wants to know of a flow: fields (shear rate, vorticity, dissipation), integrals over the fluid (kinetic
 * energy, enstrophy, dissipation), over boundaries (flow rate, pressure, shear, heat) and over bodies.  No term
 * gives an equation, and each is off unless its line, term "show.vorticity" {}, switches it on. */
#include <plugflow/fluid.h>

#include <math.h>

#include <plugflow/twin_real.h>

/* The struct of heat_flux. */
typedef struct conductor {
    double conductivity; /* W/(m K) */
} conductor;

#include "quantities.h"

/* A term without derivatives, as nothing is solved for. */
#define SHOWS(FUNCTION)                                                                                            \
    PF_TERM_SIZES, .name = #FUNCTION, .residual = FUNCTION, .flags = PF_OPTIONAL, .cite = "docs/plugins.md, Outputs"

#define VELOCITY                                                                                                   \
    {                                                                                                              \
        "u", "u", PF_VALUE, PF_VECTOR                                                                              \
    }
#define VELOCITY_GRADIENT                                                                                          \
    {                                                                                                              \
        "grad_u", "u", PF_GRAD, PF_TENSOR                                                                          \
    }
#define PRESSURE                                                                                                   \
    {                                                                                                              \
        "p", "p", PF_VALUE, PF_SCALAR                                                                              \
    }

#define SHOW(NAME, SHAPE, UNIT, DOC)                                                                               \
    {                                                                                                              \
        .name = NAME, .eval = PF_SHOW, .shape = SHAPE, .unit = UNIT, .doc = DOC                                    \
    }
#define INTEGRAL(NAME, SHAPE, UNIT, DOC)                                                                           \
    {                                                                                                              \
        .name = NAME, .eval = PF_INTEGRAL, .shape = SHAPE, .unit = UNIT, .doc = DOC                                \
    }

/* What makes a reduced pressure the true one. */
#define TRUE_PRESSURE                                                                                              \
    PF_NUMBER(pf_fluid, density, "kg/m^3", "mass per volume", .flags = PF_SHARED, PF_NOT_NEGATIVE),                \
        PF_GRAVITY(pf_fluid), PF_REDUCED_PRESSURE(pf_fluid)
#define VISCOUS PF_PARAMS(pf_fluid, PF_VISCOSITY(pf_fluid))

static const double viscosity_3[] = {3}, density_2[] = {2};

/* --- fields --- */

static const pf_term term_shear_rate = {
    SHOWS(shear_rate),
    .where = PF_FLUID,
    .doc = "\\sqrt{2\\,D(u):D(u)}",
    PF_IN(VELOCITY_GRADIENT),
    PF_OUT(SHOW("shear_rate", PF_SCALAR, "1/s", "shear rate")),
    PF_EXAMPLES({"grad u = (0 3; 1 0): a shear of 4", 2, NULL, (double[]){0, 3, 1, 0}, (double[]){4}, 1e-15}),
};

static const pf_term term_vorticity = {
    SHOWS(vorticity),
    .where = PF_FLUID,
    .doc = "\\nabla\\times u",
    PF_IN(VELOCITY_GRADIENT),
    PF_OUT(SHOW("vorticity", PF_SPIN, "1/s", "vorticity")),
    PF_EXAMPLES({"grad u = (0 3; 1 0)", 2, NULL, (double[]){0, 3, 1, 0}, (double[]){-2}, 1e-15}),
};

static const pf_term term_dissipation = {
    SHOWS(dissipation),
    .where = PF_FLUID,
    .doc = "2\\mu\\,D(u):D(u)",
    PF_IN(VELOCITY_GRADIENT, PF_TAKES_VISCOSITY),
    PF_OUT(SHOW("dissipation", PF_SCALAR, "W/m^3", "power that viscosity dissipates, per volume"),
           INTEGRAL("dissipated", PF_SCALAR, "W", "power that viscosity dissipates")),
    VISCOUS,
    PF_EXAMPLES(
        {"grad u = (0 3; 1 0), mu = 3", 2, viscosity_3, (double[]){0, 3, 1, 0, 3}, (double[]){48, 48}, 1e-15}),
};

/* --- integrals over the fluid --- */

static const pf_term term_kinetic_energy = {
    SHOWS(kinetic_energy),
    .where = PF_FLUID,
    .doc = "\\frac12\\rho\\,|u|^2",
    PF_IN(VELOCITY, PF_TAKES_DENSITY),
    PF_OUT(INTEGRAL("kinetic_energy", PF_SCALAR, "J", "kinetic energy of the fluid")),
    PF_PARAMS(pf_fluid, PF_DENSITY(pf_fluid)),
    PF_EXAMPLES({"u = (3, 4), rho = 2", 2, density_2, (double[]){3, 4, 2}, (double[]){25}, 1e-15}),
};

static const pf_term term_enstrophy = {
    SHOWS(enstrophy),
    .where = PF_FLUID,
    .doc = "\\frac12\\,|\\nabla\\times u|^2",
    PF_IN(VELOCITY_GRADIENT),
    PF_OUT(INTEGRAL("enstrophy", PF_SCALAR, "m^3/s^2", "half the integral of the vorticity squared")),
    PF_EXAMPLES({"grad u = (0 3; 1 0)", 2, NULL, (double[]){0, 3, 1, 0}, (double[]){2}, 1e-15}),
};

/* --- integrals over boundaries; the normal points out of the domain --- */

static const pf_term term_flow_rate = {
    SHOWS(flow_rate),
    .where = PF_FACET,
    .doc = "u\\cdot n",
    PF_IN(VELOCITY),
    PF_OUT(INTEGRAL("flow_rate", PF_SCALAR, "m^3/s", "volume that flows out through the boundary")),
};

static const pf_term term_mean_pressure = {
    SHOWS(mean_pressure),
    .where = PF_FACET,
    .doc = "p,\\quad 1",
    PF_IN(PRESSURE),
    PF_OUT(INTEGRAL("pressure", PF_SCALAR, "N", "integral of the pressure, over the area it is the mean"),
           INTEGRAL("area", PF_SCALAR, "m^2", "area of the boundary")),
    PF_PARAMS(pf_fluid, TRUE_PRESSURE),
};

static const pf_term term_wall_shear = {
    SHOWS(wall_shear),
    .where = PF_FACET,
    .doc = "-(1-n\\,n^T)\\,2\\mu D(u)\\,n",
    PF_IN(VELOCITY_GRADIENT, PF_TAKES_VISCOSITY),
    PF_OUT(INTEGRAL("wall_shear", PF_VECTOR, "N", "tangential force of the fluid on the boundary")),
    VISCOUS,
};

static const pf_term term_wall_force = {
    SHOWS(wall_force),
    .where = PF_FACET,
    .doc = "-(2\\mu D(u)-p\\,I)\\,n",
    PF_IN(VELOCITY_GRADIENT, PF_TAKES_VISCOSITY, PRESSURE),
    PF_OUT(INTEGRAL("wall_force", PF_VECTOR, "N", "force of the fluid on the boundary, by its traction")),
    PF_PARAMS(pf_fluid, PF_VISCOSITY(pf_fluid), TRUE_PRESSURE),
};

static const pf_term term_heat_flux = {
    SHOWS(heat_flux),
    .where = PF_FACET,
    .doc = "-k\\,\\nabla T\\cdot n",
    PF_IN({"grad_T", "T", PF_GRAD, PF_VECTOR}),
    PF_OUT(INTEGRAL("heat_flow", PF_SCALAR, "W", "heat that is conducted out through the boundary")),
    PF_PARAMS(conductor, PF_NUMBER(conductor, conductivity, "W/(m K)", "thermal conductivity",
                                   .flags = PF_REQUIRED | PF_SHARED, PF_NOT_NEGATIVE)),
};

/* --- of each body --- */

static const pf_term term_surface_force = {
    SHOWS(surface_force),
    .where = PF_SURFACE,
    .doc = "-(2\\mu D(u)-p\\,I)\\,n,\\quad r\\times\\ldots",
    PF_IN(VELOCITY_GRADIENT, PF_TAKES_VISCOSITY, PRESSURE),
    PF_OUT(INTEGRAL("surface_force", PF_VECTOR, "N", "force of the fluid on the body, by its traction"),
           INTEGRAL("surface_torque", PF_SPIN, "N m", "torque of the fluid on the body, by its traction")),
    PF_PARAMS(pf_fluid, PF_VISCOSITY(pf_fluid), TRUE_PRESSURE),
};

static const pf_term term_surface_area = {
    SHOWS(surface_area),
    .where = PF_SURFACE,
    .doc = "1",
    PF_OUT(INTEGRAL("surface_area", PF_SCALAR, "m^2", "surface of the body, as the quadrature sees it")),
};

static const pf_term term_covered_volume = {
    SHOWS(covered_volume),
    .where = PF_SOLID,
    .doc = "1",
    PF_OUT(INTEGRAL("covered_volume", PF_SCALAR, "m^3", "volume of the body, as the quadrature sees it")),
};

static const pf_plugin show = {
    PF_PLUGIN,
    .min_minor = 4,
    .name = "show",
    .version = "1.0",
    .author = "plugflow",
    .license = "GPL-3.0-or-later",
    .doc = "quantities of a flow for files and tables; each term by its own line",
    PF_FIELDS(PF_FIELD_VELOCITY, PF_FIELD_PRESSURE,
              {.name = "T", .unit = "K", .doc = "temperature", .shape = PF_SCALAR, .order = 2}),
    PF_TERMS(&term_shear_rate, &term_vorticity, &term_dissipation, &term_kinetic_energy, &term_enstrophy,
             &term_flow_rate, &term_mean_pressure, &term_wall_shear, &term_wall_force, &term_heat_flux,
             &term_surface_force, &term_surface_area, &term_covered_volume),
};
PF_ENTRY(show)
