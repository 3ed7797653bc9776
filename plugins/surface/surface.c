/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Sharp surfaces of rigid bodies: no slip by Nitsche's method with the skew sign, which keeps the viscous block
 * positive definite at every position (numerics 5), and cells with too little fluid tied to the polynomial
 * of a neighbour.  The fluid's own terms must act outside of the bodies: fluid { region = "outside" }, which
 * particulate "sharp" sets.  The equations stand in equations.h. */
#include <plugflow/fluid.h>

struct surface {
    double viscosity; /* mu, Pa s                  */
    double gamma;     /* penalty of the slip       */
};

struct inflow {
    double density; /* rho, kg/m^3             */
    double inflow;  /* 1: all, 1/2: as much as convection brings */
};

struct extension {
    double density, viscosity; /* rho, kg/m^3; mu, Pa s     */
    double g_u, g_t, g_p;      /* weights of the ties       */
};

#include <tgmath.h>

#include <plugflow/twin_real.h>
#include "equations.h"
#include <plugflow/twin_complex.h>
#include "equations.h"

static const pf_term nitsche = {
    PF_TERM(nitsche),
    .where = PF_SURFACE,
    .flags = PF_LINEAR | PF_FLUID_FORCE,
    .doc = "-(2\\mu D(u)n-pn)\\cdot z+2\\mu D(v)n\\cdot w-q\\,n\\cdot w+\\gamma\\frac{\\mu}{h}w\\cdot z,\\ "
           "w=u-U-\\omega\\times r",
    .cite = "Freund and Stenberg 1995 (skew form of Nitsche's method); docs/theory.md",
    PF_IN({"u", "u", PF_VALUE, PF_VECTOR}, {"grad_u", "u", PF_GRAD, PF_TENSOR}, {"p", "p", PF_VALUE, PF_SCALAR},
          {"U", "U", PF_VALUE, PF_VECTOR}, {"omega", "omega", PF_VALUE, PF_SPIN}, PF_TAKES_VISCOSITY),
    PF_OUT({"v", "u", PF_VALUE, PF_VECTOR}, {"grad_v", "u", PF_GRAD, PF_TENSOR}, {"q", "p", PF_VALUE, PF_SCALAR},
           {"V", "U", PF_VALUE, PF_VECTOR}, {"xi", "omega", PF_VALUE, PF_SPIN}),
    PF_PARAMS(struct surface, PF_VISCOSITY(struct surface),
              PF_NUMBER(struct surface, gamma, "1", "penalty of the slip, in mu/h", .dflt = 20, PF_NOT_NEGATIVE)),
};

static const pf_term inflow = {
    PF_TERM(inflow),
    .where = PF_SURFACE,
    .flags = PF_FLUID_FORCE | PF_CONTINUATION,
    .doc = "-\\beta\\rho\\,(w\\cdot n)_-\\,w\\cdot z",
    .cite = "Bertoglio and Caiazzo 2014, Int. J. Numer. Methods Biomed. Eng. 30:4 (at outflows)",
    PF_IN({"u", "u", PF_VALUE, PF_VECTOR}, {"U", "U", PF_VALUE, PF_VECTOR}, {"omega", "omega", PF_VALUE, PF_SPIN},
          PF_TAKES_DENSITY),
    PF_OUT({"v", "u", PF_VALUE, PF_VECTOR}, {"V", "U", PF_VALUE, PF_VECTOR}, {"xi", "omega", PF_VALUE, PF_SPIN}),
    PF_PARAMS(struct inflow, PF_DENSITY(struct inflow),
              PF_NUMBER(struct inflow, inflow, "1",
                        "strength against inflow through surfaces; 1/2 takes what convection brings", .dflt = 0.5,
                        PF_NOT_NEGATIVE)),
};

static const pf_term extension = {
    PF_TERM(extension),
    .where = PF_CUT,
    .flags = PF_LINEAR,
    .doc = "(g_u\\mu/h^2+g_t\\rho c_0/\\Delta t)(u-Eu)\\cdot(v-Ev)+g_p/\\mu\\,(p-Ep)(q-Eq)",
    .cite = "Badia, Neiva and Verdugo 2022, Comput. Methods Appl. Mech. Eng. 388:114232 (weak aggregation)",
    PF_IN({"du", "u", PF_DEFECT, PF_VECTOR}, {"dp", "p", PF_DEFECT, PF_SCALAR}, PF_TAKES_VISCOSITY,
          PF_TAKES_DENSITY),
    PF_OUT({"dv", "u", PF_DEFECT, PF_VECTOR}, {"dq", "p", PF_DEFECT, PF_SCALAR}),
    PF_PARAMS(
        struct extension, PF_DENSITY(struct extension), PF_VISCOSITY(struct extension),
        PF_NUMBER(struct extension, g_u, "1", "tie of the velocity, in mu/h^2", .dflt = 0.1, PF_NOT_NEGATIVE),
        PF_NUMBER(struct extension, g_t, "1", "tie of the velocity, in rho c0/dt", .dflt = 0.1, PF_NOT_NEGATIVE),
        PF_NUMBER(struct extension, g_p, "1", "tie of the pressure, in 1/mu", .dflt = 0.1, PF_NOT_NEGATIVE)),
};

static const pf_plugin surface = {
    PF_PLUGIN,
    .min_minor = 4,
    .name = "surface",
    .version = "1.0",
    .author = "plugflow",
    .license = "GPL-3.0-or-later",
    .doc = "sharp surfaces of rigid bodies in cut cells",
    PF_FIELDS(PF_FIELD_VELOCITY, PF_FIELD_PRESSURE, PF_FIELD_BODY_VELOCITY(.constrains = "u"), PF_FIELD_BODY_SPIN),
    PF_TERMS(&nitsche, &inflow, &extension),
};
PF_ENTRY(surface)
