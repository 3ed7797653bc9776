/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What keeps bodies apart where the mesh no longer resolves the film between them: a repulsive force
 * of short range, between bodies and against walls.  The equation stands in equations.h. */
#include <plugflow/plugin.h>

#include <math.h>

struct contact {
    double density, gravity[3]; /* of the fluid                                      */
    double range;               /* m; 0: a fifth of the body                         */
    double strength;            /* force at contact in units of the body's weight    */
    double force;               /* N, instead of strength; 0: not given              */
};

#include <plugflow/twin_real.h>
#include "equations.h"

static const pf_param params[] = {
    {.name = "density",
     .unit = "kg/m^3",
     .doc = "mass per volume",
     .type = PF_T_REAL,
     .flags = PF_REQUIRED | PF_SHARED,
     .offset = offsetof(struct contact, density),
     .min = 0,
     .max = 1e30},
    {.name = "gravity",
     .unit = "m/s^2",
     .doc = "acceleration of gravity",
     .type = PF_T_VECTOR,
     .flags = PF_SHARED,
     .offset = offsetof(struct contact, gravity)},
    {.name = "range",
     .unit = "m",
     .doc = "gap at which the force begins; 0: a fifth of the body",
     .type = PF_T_REAL,
     .offset = offsetof(struct contact, range),
     .min = 0,
     .max = 1e30},
    {.name = "strength",
     .unit = "1",
     .doc = "force at contact, in units of the weight under water of a box round the body",
     .type = PF_T_REAL,
     .offset = offsetof(struct contact, strength),
     .dflt = 5,
     .min = 0,
     .max = 1e30},
    {.name = "force",
     .unit = "N",
     .doc = "force at contact, instead of strength",
     .type = PF_T_REAL,
     .offset = offsetof(struct contact, force),
     .min = 0,
     .max = 1e30},
};

static const pf_field fields[] = {
    {.name = "U", .unit = "m/s", .doc = "velocity of a particle", .shape = PF_VECTOR, .support = PF_ON_PARTICLE},
};

static const pf_slot V[] = {{"V", "U", PF_VALUE, PF_VECTOR}};

static const pf_term repulsion = {
    .size = sizeof(pf_term),
    .flags = PF_LINEAR,
    .where = PF_PAIR,
    .name = "repulsion",
    .doc = "-F_0(1-\\mathrm{gap}/\\mathrm{range})^2\\,n\\cdot V",
    .cite = "Glowinski et al. 1999, Int. J. Multiphase Flow 25:755",
    .out = V,
    .n_out = 1,
    .slot_size = sizeof(pf_slot),
    .param = params,
    .n_param = 5,
    .param_size = sizeof(pf_param),
    .params_bytes = sizeof(struct contact),
    .residual = repulsion_real,
};

static const pf_term *const terms[] = {&repulsion};

static const pf_plugin contact = {
    .size = sizeof(pf_plugin),
    .major = PF_ABI_MAJOR,
    .minor = PF_ABI_MINOR,
    .min_minor = 1,
    .sizes = PF_SIZES,
    .name = "contact",
    .version = "1.0",
    .author = "plugflow",
    .license = "GPL-3.0-or-later",
    .doc = "short-range forces between bodies and walls",
    .term = terms,
    .n_term = 1,
    .field = fields,
    .n_field = 1,
    .field_size = sizeof(pf_field),
};

PF_EXPORT const pf_plugin *pf_plugin_entry(const pf_host *host, char *err, size_t nerr)
{
    (void)host, (void)err, (void)nerr;
    return &contact;
}
