/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Rigid motion of the fluid inside bodies, by a Lagrange multiplier on the nodes that they cover
 * (conservative formulation, numerics 4).  Force on the fluid and reaction on the body are the same
 * integral, so what one gives the other takes.  The equations stand in equations.h. */
#include <plugflow/plugin.h>

struct multiplier {
    double density;   /* rho of the fluid, kg/m^3 */
    double viscosity; /* mu, Pa s                 */
    double alpha;     /* kg/m^3/s; 0: automatic   */
};

/* alpha = mu/h^2 + rho c0/dt, unless the case gives it */
static inline double alpha_of(const pf_batch *b, const struct multiplier *m, uint32_t i)
{
    return m->alpha > 0 ? m->alpha : m->viscosity / (b->h[i] * b->h[i]) + m->density * b->shift;
}

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
     .offset = offsetof(struct multiplier, density),
     .min = 0,
     .max = 1e30},
    {.name = "viscosity",
     .unit = "Pa s",
     .doc = "dynamic viscosity",
     .type = PF_T_REAL,
     .flags = PF_REQUIRED | PF_SHARED,
     .offset = offsetof(struct multiplier, viscosity),
     .min = 0,
     .max = 1e30},
    {.name = "alpha",
     .unit = "kg/m^3/s",
     .doc = "scale of the multiplier; 0: mu/h^2 + rho c0/dt",
     .type = PF_T_REAL,
     .offset = offsetof(struct multiplier, alpha),
     .min = 0,
     .max = 1e30},
};

static const pf_field fields[] = {
    {.name = "u",
     .unit = "m/s",
     .doc = "velocity",
     .shape = PF_VECTOR,
     .order = 2,
     .reaction = "force",
     .reaction_unit = "N"},
    {.name = "lambda",
     .unit = "m/s",
     .doc = "multiplier of the rigid motion",
     .shape = PF_VECTOR,
     .order = 2,
     .support = PF_IN_PARTICLES,
     .constrains = "u"},
    {.name = "U", .unit = "m/s", .doc = "velocity of a particle", .shape = PF_VECTOR, .support = PF_ON_PARTICLE},
    {.name = "omega",
     .unit = "rad/s",
     .doc = "angular velocity of a particle",
     .shape = PF_SPIN,
     .support = PF_ON_PARTICLE},
};

static const pf_slot lambda_in[] = {{"lambda", "lambda", PF_VALUE, PF_VECTOR}};
static const pf_slot motion_in[] = {
    {"u", "u", PF_VALUE, PF_VECTOR}, {"U", "U", PF_VALUE, PF_VECTOR}, {"omega", "omega", PF_VALUE, PF_SPIN}};
static const pf_slot v[] = {{"v", "u", PF_VALUE, PF_VECTOR}};
static const pf_slot eta[] = {{"eta", "lambda", PF_VALUE, PF_VECTOR}};
static const pf_slot V_xi[] = {{"V", "U", PF_VALUE, PF_VECTOR}, {"xi", "omega", PF_VALUE, PF_SPIN}};

#define INTEGRATOR(NAME, DOC, CITE, IN, N_IN, OUT, N_OUT, FLAGS)                                                   \
    static const pf_term NAME = {.size = sizeof(pf_term),                                                          \
                                 .flags = PF_LINEAR | (FLAGS),                                                     \
                                 .where = PF_SOLID,                                                                \
                                 .name = #NAME,                                                                    \
                                 .doc = DOC,                                                                       \
                                 .cite = CITE,                                                                     \
                                 .in = IN,                                                                         \
                                 .n_in = N_IN,                                                                     \
                                 .out = OUT,                                                                       \
                                 .n_out = N_OUT,                                                                   \
                                 .slot_size = sizeof(pf_slot),                                                     \
                                 .param = params,                                                                  \
                                 .n_param = 3,                                                                     \
                                 .param_size = sizeof(pf_param),                                                   \
                                 .params_bytes = sizeof(struct multiplier),                                        \
                                 .residual = NAME##_real,                                                          \
                                 .residual_c = NAME##_complex}

INTEGRATOR(force, "-\\alpha\\lambda\\cdot v", "appendix B.4-B.9", lambda_in, 1, v, 1, 0);
INTEGRATOR(rigid_motion, "\\alpha(u-U-\\omega\\times r)\\cdot\\eta", "appendix B.16-B.27", motion_in, 3, eta, 1, 0);
INTEGRATOR(reaction, "\\alpha\\lambda\\cdot V+\\alpha(r\\times\\lambda)\\cdot\\xi",
           "conservative form of appendix B.28-B.35", lambda_in, 1, V_xi, 2, PF_FLUID_FORCE);

static const pf_term *const terms[] = {&force, &rigid_motion, &reaction};

static const pf_plugin multiplier = {
    .size = sizeof(pf_plugin),
    .major = PF_ABI_MAJOR,
    .minor = PF_ABI_MINOR,
    .min_minor = 1,
    .sizes = PF_SIZES,
    .name = "multiplier",
    .version = "1.0",
    .author = "plugflow",
    .license = "GPL-3.0-or-later",
    .doc = "rigid motion inside bodies by a Lagrange multiplier",
    .term = terms,
    .n_term = 3,
    .field = fields,
    .n_field = 4,
    .field_size = sizeof(pf_field),
};

PF_EXPORT const pf_plugin *pf_plugin_entry(const pf_host *host, char *err, size_t nerr)
{
    (void)host, (void)err, (void)nerr;
    return &multiplier;
}
