/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Particulate flow as the appendix prints it (B.1-B.45): the multiplier lives in all of Omega, is zero
 * in the fluid, and enters the momentum with alpha and mu.  A reference to study the blocks by; read
 * docs/theory.md before computing with it, and use the conservative or the sharp formulation instead.
 * The equations stand in equations.h. */
#include <plugflow/fluid.h>

struct appendix {
    double density;    /* rho_f of the fluid, kg/m^3 */
    double viscosity;  /* mu, Pa s                   */
    double gravity[3]; /* g, m/s^2                   */
    double alpha;      /* kg/m^3/s; 0: rho_f c0/dt   */
};

static inline double alpha_of(const pf_batch *b, const struct appendix *p)
{
    return p->alpha > 0 ? p->alpha : p->density * b->shift;
}

static int no_alpha(const pf_batch *b)
{
    return b->host->fail(b, 0, PF_FAIL,
                         "alpha is rho c0/dt unless given, and nothing in a steady case; give it: particulate("
                         "\"appendix\", {alpha = 1e5})");
}

#include <plugflow/twin_real.h>
#include "equations.h"
#include <plugflow/twin_complex.h>
#include "equations.h"

#define PARAMS                                                                                                     \
    PF_PARAMS(struct appendix, PF_DENSITY(struct appendix), PF_VISCOSITY(struct appendix),                         \
              PF_NUMBER(struct appendix, alpha, "kg/m^3/s", "numerical parameter of the multiplier; 0: rho c0/dt", \
                        PF_NOT_NEGATIVE),                                                                          \
              PF_GRAVITY(struct appendix))

static const pf_term force = {
    PF_TERM(force),
    .where = PF_CELL,
    .flags = PF_LINEAR,
    .doc = "-\\alpha\\lambda\\cdot v-\\mu\\nabla\\lambda:\\nabla v",
    .cite = "appendix B.4-B.9",
    PF_IN({"lambda", "lambda", PF_VALUE, PF_VECTOR}, {"grad_lambda", "lambda", PF_GRAD, PF_TENSOR}),
    PF_OUT({"v", "u", PF_VALUE, PF_VECTOR}, {"grad_v", "u", PF_GRAD, PF_TENSOR}),
    PARAMS,
};

static const pf_term fluid_zero = {
    PF_TERM(fluid_zero),
    .where = PF_FLUID,
    .flags = PF_LINEAR,
    .doc = "\\lambda\\cdot\\eta",
    .cite = "appendix B.16-B.19",
    PF_IN({"lambda", "lambda", PF_VALUE, PF_VECTOR}),
    PF_OUT({"eta", "lambda", PF_VALUE, PF_VECTOR}),
    PARAMS,
};

static const pf_term rigid_motion = {
    PF_TERM(rigid_motion),
    .where = PF_SOLID,
    .flags = PF_LINEAR,
    .doc = "(u-U-\\omega\\times r)\\cdot\\eta",
    .cite = "appendix B.16-B.18, B.20-B.27",
    PF_IN({"u", "u", PF_VALUE, PF_VECTOR}, {"U", "U", PF_VALUE, PF_VECTOR}, {"omega", "omega", PF_VALUE, PF_SPIN}),
    PF_OUT({"eta", "lambda", PF_VALUE, PF_VECTOR}),
    PARAMS,
};

static const pf_term translation = {
    PF_TERM(translation),
    .where = PF_SOLID,
    .flags = PF_LINEAR,
    .doc = "((\\rho_P-\\rho_f)\\dot U-\\rho_Pg)\\cdot V",
    .cite = "appendix B.28-B.30, B.34",
    PF_IN({"U_t", "U", PF_DOT, PF_VECTOR}),
    PF_OUT({"V", "U", PF_VALUE, PF_VECTOR}),
    PARAMS,
};

static const pf_term reaction = {
    PF_TERM(reaction),
    .where = PF_SOLID,
    .flags = PF_LINEAR | PF_FLUID_FORCE,
    .doc = "(\\nabla p+\\alpha\\lambda)\\cdot V",
    .cite = "appendix B.28-B.30, B.35-B.38",
    PF_IN({"grad_p", "p", PF_GRAD, PF_VECTOR}, {"lambda", "lambda", PF_VALUE, PF_VECTOR}),
    PF_OUT({"V", "U", PF_VALUE, PF_VECTOR}),
    PARAMS,
};

static const pf_term mean_curl = {
    PF_TERM(mean_curl),
    .where = PF_SOLID,
    .flags = PF_LINEAR,
    .doc = "(\\omega-\\frac12\\nabla\\times u)\\cdot\\xi",
    .cite = "appendix B.31-B.33, B.39-B.45",
    PF_IN({"grad_u", "u", PF_GRAD, PF_TENSOR}, {"omega", "omega", PF_VALUE, PF_SPIN}),
    PF_OUT({"xi", "omega", PF_VALUE, PF_SPIN}),
    PARAMS,
};

static const pf_plugin appendix = {
    PF_PLUGIN,
    .min_minor = 2,
    .name = "appendix",
    .version = "1.0",
    .author = "plugflow",
    .license = "GPL-3.0-or-later",
    .doc = "particulate flow as printed: global multiplier with alpha and mu",
    PF_FIELDS(PF_FIELD_VELOCITY, PF_FIELD_PRESSURE, PF_FIELD_MULTIPLIER(), PF_FIELD_BODY_VELOCITY(),
              PF_FIELD_BODY_SPIN),
    PF_TERMS(&force, &fluid_zero, &rigid_motion, &translation, &reaction, &mean_curl),
};
PF_ENTRY(appendix)
