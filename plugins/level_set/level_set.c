/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Two fluids that do not mix, with the tension of their interface: a conservative level set phi (Olsson and Kreiss
 * 2005), 0 in the first fluid, of fluid{}, and 1 in the second.  The equations stand in equations.h. */
#include <plugflow/fluid.h>

#include <tgmath.h>

#define FLAT 1e-2 /* e |grad phi| where the fluids count as unmixed */

struct level_set {
    double density, viscosity;     /* of the first fluid, kg/m^3, Pa s  */
    double density_2, viscosity_2; /* of the second                     */
    double gravity[3];             /* g, m/s^2                          */
    int reduced_pressure;          /* 1: p is the pressure without rho g.x of the first */
    double tension;                /* sigma, N/m                        */
    double thickness;              /* e, m                              */
    double speed;                  /* c, m/s                            */
};

#include <plugflow/twin_real.h>
#include "equations.h"
#include <plugflow/twin_complex.h>
#include "equations.h"

#define KEY(MEMBER, UNIT, DOC) PF_NUMBER(struct level_set, MEMBER, UNIT, DOC, .flags = PF_REQUIRED, PF_NOT_NEGATIVE)

#define THICKNESS KEY(thickness, "m", "e of the interface, phi = 1/(1 + exp(d/e)); half a cell or more")

static const pf_term transport = {
    PF_TERM(transport),
    .where = PF_FLUID,
    .doc = "(\\partial_t\\phi+u\\cdot\\nabla\\phi)\\,s",
    .cite = "Olsson and Kreiss 2005, J. Comput. Phys. 210:225",
    PF_IN({"phi_t", "phi", PF_DOT, PF_SCALAR}, {"u", "u", PF_VALUE, PF_VECTOR},
          {"grad_phi", "phi", PF_GRAD, PF_VECTOR}),
    PF_OUT({"s", "phi", PF_VALUE, PF_SCALAR}),
    PF_EXAMPLES({"d phi/dt = 3, u = (1, -2), grad phi = (3, 5)", 2, NULL, (double[]){3, 1, -2, 3, 5},
                 (double[]){-4}, 1e-15}),
};

static const pf_term compression = {
    PF_TERM(compression),
    .where = PF_FLUID,
    .doc = "c\\,(e\\nabla\\phi-\\phi(1-\\phi)\\,n)\\cdot\\nabla s,\\ n=\\nabla\\phi/|\\nabla\\phi|",
    .cite = "Olsson and Kreiss 2005, J. Comput. Phys. 210:225; Chiu and Lin 2011, J. Comput. Phys. 230:185",
    PF_IN({"phi", "phi", PF_VALUE, PF_SCALAR}, {"grad_phi", "phi", PF_GRAD, PF_VECTOR}),
    PF_OUT({"grad_s", "phi", PF_GRAD, PF_VECTOR}),
    PF_PARAMS(struct level_set, THICKNESS,
              KEY(speed, "m/s", "at which the interface is restored; about the largest velocity")),
    PF_EXAMPLES({"e = 0.1, c = 2, phi = 1/4, grad phi = (3, -4): 2 (0.1 - 3/80) grad phi", 2, (double[]){0.1, 2},
                 (double[]){0.25, 3, -4}, (double[]){0.375, -0.5}, 1e-5}),
};

static const pf_term tension = {
    PF_TERM(tension),
    .where = PF_FLUID,
    .doc = "\\sigma\\,|\\nabla\\phi|\\,(I-n\\,n):\\nabla v",
    .cite = "Lafaurie et al. 1994, J. Comput. Phys. 113:134",
    PF_IN({"grad_phi", "phi", PF_GRAD, PF_VECTOR}),
    PF_OUT({"grad_v", "u", PF_GRAD, PF_TENSOR}),
    PF_PARAMS(struct level_set,
              PF_NUMBER(struct level_set, tension, "N/m", "tension of the interface", PF_NOT_NEGATIVE), THICKNESS),
    PF_EXAMPLES({"sigma = 10, grad phi = (3, -4): 10/5 (16 12; 12 9)", 2, (double[]){10, 1}, (double[]){3, -4},
                 (double[]){32, 24, 24, 18}, 1e-7}),
};

static const pf_term momentum = {
    PF_TERM(momentum),
    .where = PF_FLUID,
    .flags = PF_CONTINUATION,
    .doc = "\\rho\\,(\\partial_t u+(u\\cdot\\nabla)u-g)\\cdot v+(2\\mu D(u)-p\\,I):\\nabla v",
    .cite = "appendix A.7-A.15, with density and viscosity of two fluids",
    PF_IN({"phi", "phi", PF_VALUE, PF_SCALAR}, {"u_t", "u", PF_DOT, PF_VECTOR}, {"u", "u", PF_VALUE, PF_VECTOR},
          {"grad_u", "u", PF_GRAD, PF_TENSOR}, {"p", "p", PF_VALUE, PF_SCALAR}),
    PF_OUT({"v", "u", PF_VALUE, PF_VECTOR}, {"grad_v", "u", PF_GRAD, PF_TENSOR}),
    PF_PARAMS(struct level_set, PF_DENSITY(struct level_set), PF_VISCOSITY(struct level_set),
              KEY(density_2, "kg/m^3", "mass per volume of the second fluid"),
              KEY(viscosity_2, "Pa s", "dynamic viscosity of the second fluid"), PF_GRAVITY(struct level_set),
              PF_REDUCED_PRESSURE(struct level_set)),
    PF_EXAMPLES({"phi = 1/2 of rho = 1, 3, mu = 1, 5; g = (0, -10), du/dt = (1, -2), u = (1, 2), grad u = (3 4; 5 "
                 "6), p = 7",
                 2, (double[]){1, 1, 3, 5, 0, -10, 0}, (double[]){0.5, 1, -2, 1, 2, 3, 4, 5, 6, 7},
                 (double[]){24, 50, 11, 27, 27, 29}, 1e-14}),
};

static const pf_plugin level_set = {
    PF_PLUGIN,
    .min_minor = 0,
    .name = "level_set",
    .version = "1.0",
    .author = "plugflow",
    .license = "GPL-3.0-or-later",
    .doc = "two fluids that do not mix",
    PF_FIELDS(PF_FIELD_VELOCITY, PF_FIELD_PRESSURE,
              {.name = "phi", .unit = "1", .doc = "share of the second fluid", .shape = PF_SCALAR, .order = 2}),
    PF_TERMS(&transport, &compression, &tension, &momentum),
};
PF_ENTRY(level_set)
