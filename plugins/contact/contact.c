/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What keeps bodies apart where the mesh no longer resolves the film between them: a repulsive force
 * of short range and the viscous resistance of the film, between bodies and against walls.  The
 * equations stand in equations.h. */
#include <plugflow/plugin.h>

#include <math.h>

#define PI 3.14159265358979323846

struct contact {
    double density, gravity[3]; /* of the fluid                                      */
    double range;               /* m; 0: a fifth of the body                         */
    double strength;            /* force at contact in units of the body's weight    */
    double force;               /* N, instead of strength; 0: not given              */
};

struct film {
    double viscosity;    /* mu, Pa s                                    */
    double range, floor; /* gaps between which it acts, in cells        */
};

/* Force at contact: of the heavier body of the two. */
static inline double force_of(const pf_batch *b, const struct contact *c, uint32_t i)
{
    double g = 0, weight[2] = {0};

    for (uint32_t a = 0; a < b->dim; a++)
        g += c->gravity[a] * c->gravity[a];
    weight[0] = fabs(b->density[i] - c->density) * pow(b->size_of[i], b->dim);
    if (b->other_density[i] > 0)
        weight[1] = fabs(b->other_density[i] - c->density) * pow(b->other_size[i], b->dim);
    return c->force > 0 ? c->force : c->strength * sqrt(g) * fmax(weight[0], weight[1]);
}

#include <plugflow/twin_real.h>
#include "equations.h"
#include <plugflow/twin_complex.h>
#include "equations.h"

#define NUMBER(NAME, UNIT, DOC, FLAGS, STRUCT, MEMBER, DEFAULT)                                                    \
    {                                                                                                              \
        .name = NAME, .unit = UNIT, .doc = DOC, .type = PF_T_REAL, .flags = FLAGS,                                 \
        .offset = offsetof(struct STRUCT, MEMBER), .dflt = DEFAULT, .min = 0, .max = 1e30                          \
    }

static const pf_param contact_params[] = {
    NUMBER("density", "kg/m^3", "mass per volume", PF_REQUIRED | PF_SHARED, contact, density, 0),
    {.name = "gravity",
     .unit = "m/s^2",
     .doc = "acceleration of gravity",
     .type = PF_T_VECTOR,
     .flags = PF_SHARED,
     .offset = offsetof(struct contact, gravity)},
    NUMBER("range", "m", "gap at which the force begins; 0: a fifth of the body", 0, contact, range, 0),
    NUMBER("strength", "1", "force at contact, in units of the weight under water of a box round the body", 0,
           contact, strength, 5),
    NUMBER("force", "N", "force at contact, instead of strength", 0, contact, force, 0),
};

static const pf_param film_params[] = {
    NUMBER("viscosity", "Pa s", "dynamic viscosity", PF_REQUIRED | PF_SHARED, film, viscosity, 0),
    NUMBER("range", "1", "gap below which the mesh does not resolve the film, in cells", 0, film, range, 2),
    NUMBER("floor", "1", "gap below which the resistance grows no more (roughness), in cells", 0, film, floor, 0.1),
};

static const pf_field fields[] = {
    {.name = "U", .unit = "m/s", .doc = "velocity of a particle", .shape = PF_VECTOR, .support = PF_ON_PARTICLE},
};

static const pf_slot U[] = {{"U", "U", PF_DEFECT, PF_VECTOR}};
static const pf_slot V[] = {{"V", "U", PF_DEFECT, PF_VECTOR}};

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
    .param = contact_params,
    .n_param = sizeof contact_params / sizeof *contact_params,
    .param_size = sizeof(pf_param),
    .params_bytes = sizeof(struct contact),
    .residual = repulsion_real,
    .residual_c = repulsion_complex,
};

static const pf_term lubrication = {
    .size = sizeof(pf_term),
    .flags = PF_LINEAR | PF_OPTIONAL,
    .where = PF_PAIR,
    .name = "lubrication",
    .doc = "6\\pi\\mu R^2\\left(\\frac1{\\mathrm{gap}}-\\frac1{\\mathrm{range}}\\right)(U\\cdot n)(V\\cdot n)"
           "\\ \\text{(3D)},\\ R=\\frac{R_iR_j}{R_i+R_j}",
    .cite = "Kim and Karrila 1991, Microhydrodynamics, ch. 9; 2D: Jeffrey and Onishi 1981, Q. J. Mech. Appl. Math. "
            "34:129",
    .in = U,
    .n_in = 1,
    .out = V,
    .n_out = 1,
    .slot_size = sizeof(pf_slot),
    .param = film_params,
    .n_param = sizeof film_params / sizeof *film_params,
    .param_size = sizeof(pf_param),
    .params_bytes = sizeof(struct film),
    .residual = lubrication_real,
    .residual_c = lubrication_complex,
};

static const pf_term *const terms[] = {&repulsion, &lubrication};

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
    .n_term = sizeof terms / sizeof *terms,
    .field = fields,
    .n_field = 1,
    .field_size = sizeof(pf_field),
};

PF_EXPORT const pf_plugin *pf_plugin_entry(const pf_host *host, char *err, size_t nerr)
{
    (void)host, (void)err, (void)nerr;
    return &contact;
}
