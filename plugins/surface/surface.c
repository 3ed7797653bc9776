/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Sharp surfaces of rigid bodies: no slip by Nitsche's method with the skew sign, which keeps the viscous block
 * positive definite at every position (numerics 5), and cells with too little fluid tied to the polynomial
 * of a neighbour.  The fluid's own terms must act outside of the bodies: fluid { region = "outside" }, which
 * particulate "sharp" sets.  The equations stand in equations.h. */
#include <plugflow/plugin.h>

struct surface {
    double viscosity; /* mu, Pa s                  */
    double gamma;     /* penalty of the slip       */
};

struct extension {
    double density, viscosity; /* rho, kg/m^3; mu, Pa s     */
    double g_u, g_t, g_p;      /* weights of the ties       */
};

#include <plugflow/twin_real.h>
#include "equations.h"
#include <plugflow/twin_complex.h>
#include "equations.h"

#define NUMBER(NAME, UNIT, DOC, FLAGS, STRUCT, MEMBER, DEFAULT)                                                    \
    {                                                                                                              \
        .name = NAME, .unit = UNIT, .doc = DOC, .type = PF_T_REAL, .flags = FLAGS,                                 \
        .offset = offsetof(struct STRUCT, MEMBER), .dflt = DEFAULT, .min = 0, .max = 1e30                          \
    }

static const pf_param surface_params[] = {
    NUMBER("viscosity", "Pa s", "dynamic viscosity", PF_REQUIRED | PF_SHARED, surface, viscosity, 0),
    NUMBER("gamma", "1", "penalty of the slip, in mu/h", 0, surface, gamma, 20),
};

static const pf_param extension_params[] = {
    NUMBER("density", "kg/m^3", "mass per volume", PF_REQUIRED | PF_SHARED, extension, density, 0),
    NUMBER("viscosity", "Pa s", "dynamic viscosity", PF_REQUIRED | PF_SHARED, extension, viscosity, 0),
    NUMBER("g_u", "1", "tie of the velocity, in mu/h^2", 0, extension, g_u, 0.1),
    NUMBER("g_t", "1", "tie of the velocity, in rho c0/dt", 0, extension, g_t, 0.1),
    NUMBER("g_p", "1", "tie of the pressure, in 1/mu", 0, extension, g_p, 0.1),
};

static const pf_field fields[] = {
    {.name = "u",
     .unit = "m/s",
     .doc = "velocity",
     .shape = PF_VECTOR,
     .order = 2,
     .reaction = "force",
     .reaction_unit = "N"},
    {.name = "p", .unit = "Pa", .doc = "pressure", .shape = PF_SCALAR, .order = 1},
    {.name = "U",
     .unit = "m/s",
     .doc = "velocity of a particle",
     .shape = PF_VECTOR,
     .support = PF_ON_PARTICLE,
     .constrains = "u"},
    {.name = "omega",
     .unit = "rad/s",
     .doc = "angular velocity of a particle",
     .shape = PF_SPIN,
     .support = PF_ON_PARTICLE},
};

static const pf_slot at_surface[] = {{"u", "u", PF_VALUE, PF_VECTOR},
                                     {"grad_u", "u", PF_GRAD, PF_TENSOR},
                                     {"p", "p", PF_VALUE, PF_SCALAR},
                                     {"U", "U", PF_VALUE, PF_VECTOR},
                                     {"omega", "omega", PF_VALUE, PF_SPIN}};
static const pf_slot of_surface[] = {{"v", "u", PF_VALUE, PF_VECTOR},
                                     {"grad_v", "u", PF_GRAD, PF_TENSOR},
                                     {"q", "p", PF_VALUE, PF_SCALAR},
                                     {"V", "U", PF_VALUE, PF_VECTOR},
                                     {"xi", "omega", PF_VALUE, PF_SPIN}};
static const pf_slot defects[] = {{"du", "u", PF_DEFECT, PF_VECTOR}, {"dp", "p", PF_DEFECT, PF_SCALAR}};
static const pf_slot tests[] = {{"dv", "u", PF_DEFECT, PF_VECTOR}, {"dq", "p", PF_DEFECT, PF_SCALAR}};

static const pf_term nitsche = {
    .size = sizeof(pf_term),
    .flags = PF_LINEAR | PF_FLUID_FORCE,
    .where = PF_SURFACE,
    .name = "nitsche",
    .doc = "-(2\\mu D(u)n-pn)\\cdot z+2\\mu D(v)n\\cdot w-q\\,n\\cdot w+\\gamma\\frac{\\mu}{h}w\\cdot z,\\ "
           "w=u-U-\\omega\\times r",
    .cite = "Freund and Stenberg 1995 (skew form of Nitsche's method); docs/theory.md",
    .in = at_surface,
    .n_in = 5,
    .out = of_surface,
    .n_out = 5,
    .slot_size = sizeof(pf_slot),
    .param = surface_params,
    .n_param = sizeof surface_params / sizeof *surface_params,
    .param_size = sizeof(pf_param),
    .params_bytes = sizeof(struct surface),
    .residual = nitsche_real,
    .residual_c = nitsche_complex,
};

static const pf_term extension = {
    .size = sizeof(pf_term),
    .flags = PF_LINEAR,
    .where = PF_CUT,
    .name = "extension",
    .doc = "(g_u\\mu/h^2+g_t\\rho c_0/\\Delta t)(u-Eu)\\cdot(v-Ev)+g_p/\\mu\\,(p-Ep)(q-Eq)",
    .cite = "Badia, Neiva and Verdugo 2022, Comput. Methods Appl. Mech. Eng. 388:114232 (weak aggregation)",
    .in = defects,
    .n_in = 2,
    .out = tests,
    .n_out = 2,
    .slot_size = sizeof(pf_slot),
    .param = extension_params,
    .n_param = sizeof extension_params / sizeof *extension_params,
    .param_size = sizeof(pf_param),
    .params_bytes = sizeof(struct extension),
    .residual = extension_real,
    .residual_c = extension_complex,
};

static const pf_term *const terms[] = {&nitsche, &extension};

static const pf_plugin surface = {
    .size = sizeof(pf_plugin),
    .major = PF_ABI_MAJOR,
    .minor = PF_ABI_MINOR,
    .min_minor = 1,
    .sizes = PF_SIZES,
    .name = "surface",
    .version = "1.0",
    .author = "plugflow",
    .license = "GPL-3.0-or-later",
    .doc = "sharp surfaces of rigid bodies in cut cells",
    .term = terms,
    .n_term = sizeof terms / sizeof *terms,
    .field = fields,
    .n_field = sizeof fields / sizeof *fields,
    .field_size = sizeof(pf_field),
};

PF_EXPORT const pf_plugin *pf_plugin_entry(const pf_host *host, char *err, size_t nerr)
{
    (void)host, (void)err, (void)nerr;
    return &surface;
}
