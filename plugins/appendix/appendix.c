/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Particulate flow as the appendix prints it (B.1-B.45): the multiplier lives in all of Omega, is zero
 * in the fluid, and enters the momentum with alpha and mu.  A reference to study the blocks by; read
 * docs/theory.md before computing with it, and use the conservative or the sharp formulation instead.
 * The equations stand in equations.h. */
#include <plugflow/plugin.h>

struct appendix {
    double density;    /* rho_f of the fluid, kg/m^3 */
    double viscosity;  /* mu, Pa s                   */
    double gravity[3]; /* g, m/s^2                   */
    double alpha;      /* kg/m^3/s; 0: rho_f c0/dt   */
};

static const pf_host *host;

static inline double alpha_of(const pf_batch *b, const struct appendix *p)
{
    return p->alpha > 0 ? p->alpha : p->density * b->shift;
}

static int no_alpha(const pf_batch *b)
{
    return host->fail(b, 0, PF_FAIL,
                      "alpha is rho c0/dt unless given, and nothing in a steady case; give it: particulate("
                      "\"appendix\", {alpha = 1e5})");
}

#include <plugflow/twin_real.h>
#include "equations.h"
#include <plugflow/twin_complex.h>
#include "equations.h"

#define NUMBER(NAME, UNIT, DOC, FLAGS, MEMBER)                                                                     \
    {                                                                                                              \
        .name = NAME, .unit = UNIT, .doc = DOC, .type = PF_T_REAL, .flags = FLAGS,                                 \
        .offset = offsetof(struct appendix, MEMBER), .min = 0, .max = 1e30                                         \
    }

static const pf_param params[] = {
    NUMBER("density", "kg/m^3", "mass per volume", PF_REQUIRED | PF_SHARED, density),
    NUMBER("viscosity", "Pa s", "dynamic viscosity", PF_REQUIRED | PF_SHARED, viscosity),
    NUMBER("alpha", "kg/m^3/s", "numerical parameter of the multiplier; 0: rho c0/dt", 0, alpha),
    {.name = "gravity",
     .unit = "m/s^2",
     .doc = "acceleration of gravity",
     .type = PF_T_VECTOR,
     .flags = PF_SHARED,
     .offset = offsetof(struct appendix, gravity)},
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
    {.name = "lambda", .unit = "m/s", .doc = "multiplier of the rigid motion", .shape = PF_VECTOR, .order = 2},
    {.name = "U", .unit = "m/s", .doc = "velocity of a particle", .shape = PF_VECTOR, .support = PF_ON_PARTICLE},
    {.name = "omega",
     .unit = "rad/s",
     .doc = "angular velocity of a particle",
     .shape = PF_SPIN,
     .support = PF_ON_PARTICLE},
};

static const pf_slot lambda[] = {{"lambda", "lambda", PF_VALUE, PF_VECTOR}};
static const pf_slot lambdas[] = {{"lambda", "lambda", PF_VALUE, PF_VECTOR},
                                  {"grad_lambda", "lambda", PF_GRAD, PF_TENSOR}};
static const pf_slot motion[] = {
    {"u", "u", PF_VALUE, PF_VECTOR}, {"U", "U", PF_VALUE, PF_VECTOR}, {"omega", "omega", PF_VALUE, PF_SPIN}};
static const pf_slot U_t[] = {{"U_t", "U", PF_DOT, PF_VECTOR}};
static const pf_slot grad_p_lambda[] = {{"grad_p", "p", PF_GRAD, PF_VECTOR},
                                        {"lambda", "lambda", PF_VALUE, PF_VECTOR}};
static const pf_slot grad_u_omega[] = {{"grad_u", "u", PF_GRAD, PF_TENSOR}, {"omega", "omega", PF_VALUE, PF_SPIN}};
static const pf_slot v[] = {{"v", "u", PF_VALUE, PF_VECTOR}, {"grad_v", "u", PF_GRAD, PF_TENSOR}};
static const pf_slot eta[] = {{"eta", "lambda", PF_VALUE, PF_VECTOR}};
static const pf_slot V[] = {{"V", "U", PF_VALUE, PF_VECTOR}};
static const pf_slot xi[] = {{"xi", "omega", PF_VALUE, PF_SPIN}};

#define INTEGRATOR(NAME, WHERE, DOC, CITE, IN, N_IN, OUT, N_OUT, FLAGS)                                            \
    static const pf_term NAME = {.size = sizeof(pf_term),                                                          \
                                 .flags = PF_LINEAR | (FLAGS),                                                     \
                                 .where = WHERE,                                                                   \
                                 .name = #NAME,                                                                    \
                                 .doc = DOC,                                                                       \
                                 .cite = "appendix " CITE,                                                         \
                                 .in = IN,                                                                         \
                                 .n_in = N_IN,                                                                     \
                                 .out = OUT,                                                                       \
                                 .n_out = N_OUT,                                                                   \
                                 .slot_size = sizeof(pf_slot),                                                     \
                                 .param = params,                                                                  \
                                 .n_param = sizeof params / sizeof *params,                                        \
                                 .param_size = sizeof(pf_param),                                                   \
                                 .params_bytes = sizeof(struct appendix),                                          \
                                 .residual = NAME##_real,                                                          \
                                 .residual_c = NAME##_complex}

INTEGRATOR(force, PF_CELL, "-\\alpha\\lambda\\cdot v-\\mu\\nabla\\lambda:\\nabla v", "B.4-B.9", lambdas, 2, v, 2,
           0);
INTEGRATOR(fluid_zero, PF_FLUID, "\\lambda\\cdot\\eta", "B.16-B.19", lambda, 1, eta, 1, 0);
INTEGRATOR(rigid_motion, PF_SOLID, "(u-U-\\omega\\times r)\\cdot\\eta", "B.16-B.18, B.20-B.27", motion, 3, eta, 1,
           0);
INTEGRATOR(translation, PF_SOLID, "((\\rho_P-\\rho_f)\\dot U-\\rho_Pg)\\cdot V", "B.28-B.30, B.34", U_t, 1, V, 1,
           0);
INTEGRATOR(reaction, PF_SOLID, "(\\nabla p+\\alpha\\lambda)\\cdot V", "B.28-B.30, B.35-B.38", grad_p_lambda, 2, V,
           1, PF_FLUID_FORCE);
INTEGRATOR(mean_curl, PF_SOLID, "(\\omega-\\frac12\\nabla\\times u)\\cdot\\xi", "B.31-B.33, B.39-B.45",
           grad_u_omega, 2, xi, 1, 0);

static const pf_term *const terms[] = {&force, &fluid_zero, &rigid_motion, &translation, &reaction, &mean_curl};

static const pf_plugin appendix = {
    .size = sizeof(pf_plugin),
    .major = PF_ABI_MAJOR,
    .minor = PF_ABI_MINOR,
    .min_minor = 1,
    .sizes = PF_SIZES,
    .name = "appendix",
    .version = "1.0",
    .author = "plugflow",
    .license = "GPL-3.0-or-later",
    .doc = "particulate flow as printed: global multiplier with alpha and mu",
    .term = terms,
    .n_term = sizeof terms / sizeof *terms,
    .field = fields,
    .n_field = sizeof fields / sizeof *fields,
    .field_size = sizeof(pf_field),
};

PF_EXPORT const pf_plugin *pf_plugin_entry(const pf_host *h, char *err, size_t nerr)
{
    (void)err, (void)nerr;
    host = h;
    return &appendix;
}
