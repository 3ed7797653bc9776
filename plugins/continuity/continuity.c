/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Conservation of volume, div u = 0 (appendix A.1-A.6).  The equation stands in equations.h. */
#include <plugflow/fluid.h>

struct smoothing {
    double density, viscosity; /* of the fluid, kg/m^3, Pa s */
    double epsilon;
};

#include <plugflow/twin_real.h>
#include "equations.h"
#include <plugflow/twin_complex.h>
#include "equations.h"

/* d(div u)/d(div u); A.3-A.5 */
static int divergence_jacobian(const pf_batch *b, const double *const *in, double *const *jac)
{
    (void)in;
    PF_LANES_OF (b, i)
        jac[0][i] = 1;
    return PF_OK;
}

static const pf_term divergence = {
    PF_TERM(divergence),
    .where = PF_CELL,
    .flags = PF_LINEAR,
    .doc = "q\\,\\nabla\\cdot u",
    .cite = "appendix A.1-A.6",
    PF_IN({"div_u", "u", PF_DIV, PF_SCALAR}),
    PF_OUT({"q", "p", PF_VALUE, PF_SCALAR}),
    PF_EXAMPLES({"div u = 3", 2, NULL, (double[]){3}, (double[]){3}, 1e-15}),
    .jacobian = divergence_jacobian,
};

static const pf_term pressure_smoothing = {
    PF_TERM(pressure_smoothing),
    .where = PF_SOLID,
    .flags = PF_LINEAR | PF_OPTIONAL,
    .doc = "\\epsilon h^2/(\\mu+\\rho h^2/\\Delta t)\\,\\nabla p\\cdot\\nabla q",
    .cite = "numerics 4",
    PF_IN({"grad_p", "p", PF_GRAD, PF_VECTOR}),
    PF_OUT({"grad_q", "p", PF_GRAD, PF_VECTOR}),
    PF_PARAMS(struct smoothing, PF_DENSITY(struct smoothing), PF_VISCOSITY(struct smoothing),
              PF_NUMBER(struct smoothing, epsilon, "1", "strength of the smoothing; 0.02 to 0.1", .dflt = 0.05,
                        .min = 0, .max = 10)),
};

static const pf_plugin continuity = {
    PF_PLUGIN,
    .name = "continuity",
    .version = "1.0",
    .author = "plugflow",
    .license = "GPL-3.0-or-later",
    .doc = "conservation of volume",
    PF_FIELDS(PF_FIELD_VELOCITY, PF_FIELD_PRESSURE),
    PF_TERMS(&divergence, &pressure_smoothing),
};
PF_ENTRY(continuity)
