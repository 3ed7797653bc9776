/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Conservation of volume, div u = 0 (appendix A.1-A.6).  The equation stands in equations.h. */
#include <plugflow/plugin.h>

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
    .where = PF_FLUID,
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

static const pf_term *const terms[] = {&divergence};

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
    .n_term = 1,
    .field = fields,
    .n_field = 2,
    .field_size = sizeof(pf_field),
};

PF_EXPORT const pf_plugin *pf_plugin_entry(const pf_host *host, char *err, size_t nerr)
{
    (void)host, (void)err, (void)nerr;
    return &continuity;
}
