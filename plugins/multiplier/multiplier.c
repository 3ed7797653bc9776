/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Rigid motion of the fluid inside bodies, by a Lagrange multiplier on the nodes that they cover
 * (conservative formulation, numerics 4).  Force on the fluid and reaction on the body are the same
 * integral, so what one gives the other takes.  The equations stand in equations.h. */
#include <plugflow/fluid.h>

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

#define PARAMS                                                                                                     \
    PF_PARAMS(struct multiplier, PF_DENSITY(struct multiplier), PF_VISCOSITY(struct multiplier),                   \
              PF_NUMBER(struct multiplier, alpha, "kg/m^3/s", "scale of the multiplier; 0: mu/h^2 + rho c0/dt",    \
                        PF_NOT_NEGATIVE))

static const pf_term force = {
    PF_TERM(force),
    .where = PF_SOLID,
    .flags = PF_LINEAR,
    .doc = "-\\alpha\\lambda\\cdot v",
    .cite = "appendix B.4-B.9",
    PF_IN({"lambda", "lambda", PF_VALUE, PF_VECTOR}),
    PF_OUT({"v", "u", PF_VALUE, PF_VECTOR}),
    PARAMS,
};

static const pf_term rigid_motion = {
    PF_TERM(rigid_motion),
    .where = PF_SOLID,
    .flags = PF_LINEAR,
    .doc = "\\alpha(u-U-\\omega\\times r)\\cdot\\eta",
    .cite = "appendix B.16-B.27",
    PF_IN({"u", "u", PF_VALUE, PF_VECTOR}, {"U", "U", PF_VALUE, PF_VECTOR}, {"omega", "omega", PF_VALUE, PF_SPIN}),
    PF_OUT({"eta", "lambda", PF_VALUE, PF_VECTOR}),
    PARAMS,
};

static const pf_term reaction = {
    PF_TERM(reaction),
    .where = PF_SOLID,
    .flags = PF_LINEAR | PF_FLUID_FORCE,
    .doc = "\\alpha\\lambda\\cdot V+\\alpha(r\\times\\lambda)\\cdot\\xi",
    .cite = "conservative form of appendix B.28-B.35",
    PF_IN({"lambda", "lambda", PF_VALUE, PF_VECTOR}),
    PF_OUT({"V", "U", PF_VALUE, PF_VECTOR}, {"xi", "omega", PF_VALUE, PF_SPIN}),
    PARAMS,
};

static const pf_plugin multiplier = {
    PF_PLUGIN,
    .min_minor = 1,
    .name = "multiplier",
    .version = "1.0",
    .author = "plugflow",
    .license = "GPL-3.0-or-later",
    .doc = "rigid motion inside bodies by a Lagrange multiplier",
    PF_FIELDS(PF_FIELD_VELOCITY, PF_FIELD_MULTIPLIER(.support = PF_IN_PARTICLES, .constrains = "u"),
              PF_FIELD_BODY_VELOCITY(), PF_FIELD_BODY_SPIN),
    PF_TERMS(&force, &rigid_motion, &reaction),
};
PF_ENTRY(multiplier)
