/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Conservation of volume, div u = 0 (appendix A.1-A.6).  The equation stands in equations.h. */
#include <plugflow/plugin.h>

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

static const pf_field fields[] = {
    {.name = "u",
     .unit = "m/s",
     .doc = "velocity",
     .shape = PF_VECTOR,
     .order = 2,
     .reaction = "force",
     .reaction_unit = "N"},
    {.name = "p", .unit = "Pa", .doc = "pressure", .shape = PF_SCALAR, .order = 1},
};

static const pf_slot div_u[] = {{"div_u", "u", PF_DIV, PF_SCALAR}};
static const pf_slot q[] = {{"q", "p", PF_VALUE, PF_SCALAR}};

static const pf_example examples[] = {{"div u = 3", 2, NULL, (double[]){3}, (double[]){3}, 1e-15}};

static const pf_term divergence = {
    .size = sizeof(pf_term),
    .flags = PF_LINEAR,
    .where = PF_CELL,
    .name = "divergence",
    .doc = "q\\,\\nabla\\cdot u",
    .cite = "appendix A.1-A.6",
    .in = div_u,
    .n_in = 1,
    .out = q,
    .n_out = 1,
    .slot_size = sizeof(pf_slot),
    .example = examples,
    .n_example = 1,
    .example_size = sizeof(pf_example),
    .residual = divergence_real,
    .residual_c = divergence_complex,
    .jacobian = divergence_jacobian,
};

static const pf_param smoothing_params[] = {
    {.name = "density",
     .unit = "kg/m^3",
     .doc = "mass per volume",
     .type = PF_T_REAL,
     .flags = PF_REQUIRED | PF_SHARED,
     .offset = offsetof(struct smoothing, density),
     .min = 0,
     .max = 1e30},
    {.name = "viscosity",
     .unit = "Pa s",
     .doc = "dynamic viscosity",
     .type = PF_T_REAL,
     .flags = PF_REQUIRED | PF_SHARED,
     .offset = offsetof(struct smoothing, viscosity),
     .min = 0,
     .max = 1e30},
    {.name = "epsilon",
     .unit = "1",
     .doc = "strength of the smoothing; 0.02 to 0.1",
     .type = PF_T_REAL,
     .offset = offsetof(struct smoothing, epsilon),
     .dflt = 0.05,
     .min = 0,
     .max = 10},
};

static const pf_slot grad_p[] = {{"grad_p", "p", PF_GRAD, PF_VECTOR}};
static const pf_slot grad_q[] = {{"grad_q", "p", PF_GRAD, PF_VECTOR}};

static const pf_term pressure_smoothing = {
    .size = sizeof(pf_term),
    .flags = PF_LINEAR | PF_OPTIONAL,
    .where = PF_SOLID,
    .name = "pressure_smoothing",
    .doc = "\\epsilon h^2/(\\mu+\\rho h^2/\\Delta t)\\,\\nabla p\\cdot\\nabla q",
    .cite = "numerics 4",
    .in = grad_p,
    .n_in = 1,
    .out = grad_q,
    .n_out = 1,
    .slot_size = sizeof(pf_slot),
    .param = smoothing_params,
    .n_param = 3,
    .param_size = sizeof(pf_param),
    .params_bytes = sizeof(struct smoothing),
    .residual = pressure_smoothing_real,
    .residual_c = pressure_smoothing_complex,
};

static const pf_term *const terms[] = {&divergence, &pressure_smoothing};

static const pf_plugin continuity = {
    .size = sizeof(pf_plugin),
    .major = PF_ABI_MAJOR,
    .minor = PF_ABI_MINOR,
    .sizes = PF_SIZES,
    .name = "continuity",
    .version = "1.0",
    .author = "plugflow",
    .license = "GPL-3.0-or-later",
    .doc = "conservation of volume",
    .term = terms,
    .n_term = 2,
    .field = fields,
    .n_field = 2,
    .field_size = sizeof(pf_field),
};

PF_EXPORT const pf_plugin *pf_plugin_entry(const pf_host *host, char *err, size_t nerr)
{
    (void)host, (void)err, (void)nerr;
    return &continuity;
}
