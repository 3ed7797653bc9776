/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Newton and Euler for rigid bodies (conservative form of appendix B.28-B.39, numerics 4).  The
 * reaction of the fluid comes from another plugin (multiplier); here are weight and inertia, and the
 * inertia and buoyancy of the fluid that the formulation keeps inside the body.  The pressure is the
 * reduced one, so the fluid itself feels no gravity.  The equations stand in equations.h. */
#include <plugflow/plugin.h>

struct rigid_body {
    double density;    /* rho_f of the fluid, kg/m^3 */
    double gravity[3]; /* g, m/s^2                   */
};

#include <plugflow/twin_real.h>
#include "equations.h"
#include <plugflow/twin_complex.h>
#include "equations.h"

static const pf_param params[] = {
    {.name = "density",
     .unit = "kg/m^3",
     .doc = "mass per volume",
     .type = PF_T_REAL,
     .flags = PF_REQUIRED | PF_SHARED,
     .offset = offsetof(struct rigid_body, density),
     .min = 0,
     .max = 1e30},
    {.name = "gravity",
     .unit = "m/s^2",
     .doc = "acceleration of gravity",
     .type = PF_T_VECTOR,
     .flags = PF_SHARED,
     .offset = offsetof(struct rigid_body, gravity)},
};

static const pf_field fields[] = {
    {.name = "U", .unit = "m/s", .doc = "velocity of a particle", .shape = PF_VECTOR, .support = PF_ON_PARTICLE},
    {.name = "omega",
     .unit = "rad/s",
     .doc = "angular velocity of a particle",
     .shape = PF_SPIN,
     .support = PF_ON_PARTICLE},
};

static const pf_slot U_t[] = {{"U_t", "U", PF_DOT, PF_VECTOR}};
static const pf_slot w_t_w[] = {{"omega_t", "omega", PF_DOT, PF_SPIN}, {"omega", "omega", PF_VALUE, PF_SPIN}};
static const pf_slot all[] = {
    {"U_t", "U", PF_DOT, PF_VECTOR}, {"omega_t", "omega", PF_DOT, PF_SPIN}, {"omega", "omega", PF_VALUE, PF_SPIN}};
static const pf_slot V[] = {{"V", "U", PF_VALUE, PF_VECTOR}};
static const pf_slot xi[] = {{"xi", "omega", PF_VALUE, PF_SPIN}};
static const pf_slot V_xi[] = {{"V", "U", PF_VALUE, PF_VECTOR}, {"xi", "omega", PF_VALUE, PF_SPIN}};

#define INTEGRATOR(NAME, DOC, IN, N_IN, OUT, N_OUT, FLAGS)                                                         \
    static const pf_term NAME = {.size = sizeof(pf_term),                                                          \
                                 .flags = FLAGS,                                                                   \
                                 .where = PF_SOLID,                                                                \
                                 .name = #NAME,                                                                    \
                                 .doc = DOC,                                                                       \
                                 .cite = "conservative form of appendix B.28-B.39",                                \
                                 .in = IN,                                                                         \
                                 .n_in = N_IN,                                                                     \
                                 .out = OUT,                                                                       \
                                 .n_out = N_OUT,                                                                   \
                                 .slot_size = sizeof(pf_slot),                                                     \
                                 .param = params,                                                                  \
                                 .n_param = 2,                                                                     \
                                 .param_size = sizeof(pf_param),                                                   \
                                 .params_bytes = sizeof(struct rigid_body),                                        \
                                 .residual = NAME##_real,                                                          \
                                 .residual_c = NAME##_complex}

INTEGRATOR(translation, "\\rho_P(\\dot U-g)\\cdot V", U_t, 1, V, 1, PF_LINEAR);
INTEGRATOR(rotation, "\\rho_P\\,r\\times(\\dot\\omega\\times r+\\omega\\times(\\omega\\times r))\\cdot\\xi", w_t_w,
           2, xi, 1, 0);
INTEGRATOR(displaced,
           "-\\rho_f(\\dot U-g)\\cdot V-\\rho_f\\,r\\times(\\dot\\omega\\times r+\\omega\\times(\\omega\\times "
           "r))\\cdot\\xi",
           all, 3, V_xi, 2, PF_FLUID_FORCE);

INTEGRATOR(buoyancy, "\\rho_fg\\cdot V", NULL, 0, V, 1, PF_LINEAR | PF_OPTIONAL | PF_FLUID_FORCE);

static const pf_term *const terms[] = {&translation, &rotation, &displaced, &buoyancy};

static const pf_plugin rigid_body = {
    .size = sizeof(pf_plugin),
    .major = PF_ABI_MAJOR,
    .minor = PF_ABI_MINOR,
    .min_minor = 1,
    .sizes = PF_SIZES,
    .name = "rigid_body",
    .version = "1.0",
    .author = "plugflow",
    .license = "GPL-3.0-or-later",
    .doc = "translation and rotation of rigid bodies",
    .term = terms,
    .n_term = 4,
    .field = fields,
    .n_field = 2,
    .field_size = sizeof(pf_field),
};

PF_EXPORT const pf_plugin *pf_plugin_entry(const pf_host *host, char *err, size_t nerr)
{
    (void)host, (void)err, (void)nerr;
    return &rigid_body;
}
