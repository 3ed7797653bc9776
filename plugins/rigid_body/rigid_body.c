/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Newton and Euler for rigid bodies (conservative form of appendix B.28-B.39, numerics 4).  The
 * reaction of the fluid comes from another plugin (multiplier); here are weight and inertia, and the
 * inertia and buoyancy of the fluid that the formulation keeps inside the body.  The pressure is the
 * reduced one, so the fluid itself feels no gravity.  The equations stand in equations.h. */
#include <plugflow/fluid.h>

#include <plugflow/twin_real.h>
#include "equations.h"
#include <plugflow/twin_complex.h>
#include "equations.h"

#define PARAMS PF_PARAMS(pf_fluid, PF_DENSITY(pf_fluid), PF_GRAVITY(pf_fluid))
#define CITE   "conservative form of appendix B.28-B.39"

static const pf_term translation = {
    PF_TERM(translation),
    .where = PF_SOLID,
    .flags = PF_LINEAR,
    .doc = "\\rho_P(\\dot U-g)\\cdot V",
    .cite = CITE,
    PF_IN({"U_t", "U", PF_DOT, PF_VECTOR}),
    PF_OUT({"V", "U", PF_VALUE, PF_VECTOR}),
    PARAMS,
};

static const pf_term rotation = {
    PF_TERM(rotation),
    .where = PF_SOLID,
    .doc = "\\rho_P\\,r\\times(\\dot\\omega\\times r+\\omega\\times(\\omega\\times r))\\cdot\\xi",
    .cite = CITE,
    PF_IN({"omega_t", "omega", PF_DOT, PF_SPIN}, {"omega", "omega", PF_VALUE, PF_SPIN}),
    PF_OUT({"xi", "omega", PF_VALUE, PF_SPIN}),
    PARAMS,
};

static const pf_term displaced = {
    PF_TERM(displaced),
    .where = PF_SOLID,
    .flags = PF_FLUID_FORCE,
    .doc = "-\\rho_f(\\dot U-g)\\cdot V"
           "-\\rho_f\\,r\\times(\\dot\\omega\\times r+\\omega\\times(\\omega\\times r))\\cdot\\xi",
    .cite = CITE,
    PF_IN({"U_t", "U", PF_DOT, PF_VECTOR}, {"omega_t", "omega", PF_DOT, PF_SPIN},
          {"omega", "omega", PF_VALUE, PF_SPIN}),
    PF_OUT({"V", "U", PF_VALUE, PF_VECTOR}, {"xi", "omega", PF_VALUE, PF_SPIN}),
    PARAMS,
};

static const pf_term buoyancy = {
    PF_TERM(buoyancy),
    .where = PF_SOLID,
    .flags = PF_LINEAR | PF_OPTIONAL | PF_FLUID_FORCE,
    .doc = "\\rho_fg\\cdot V",
    .cite = CITE,
    PF_OUT({"V", "U", PF_VALUE, PF_VECTOR}),
    PARAMS,
};

static const pf_plugin rigid_body = {
    PF_PLUGIN,
    .min_minor = 1,
    .name = "rigid_body",
    .version = "1.0",
    .author = "plugflow",
    .license = "GPL-3.0-or-later",
    .doc = "translation and rotation of rigid bodies",
    PF_FIELDS(PF_FIELD_BODY_VELOCITY(), PF_FIELD_BODY_SPIN),
    PF_TERMS(&translation, &rotation, &displaced, &buoyancy),
};
PF_ENTRY(rigid_body)
