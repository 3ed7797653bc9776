/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What keeps bodies apart where the mesh no longer resolves the film between them: a repulsive force
 * of short range and the viscous resistance of the film, between bodies and against walls.  The
 * equations stand in equations.h. */
#include <plugflow/fluid.h>

#include <math.h>

#define PI 3.14159265358979323846

struct contact {
    double density, gravity[3]; /* of the fluid                                      */
    double range;               /* m; 0: a fifth of the body                         */
    double strength;            /* at contact, in weights of a box round the body     */
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

static double repulsion_reach(const void *params, double size, double h)
{
    const struct contact *c = params;

    (void)h;
    return c->range > 0 ? c->range : 0.2 * size;
}

static double film_reach(const void *params, double size, double h)
{
    const struct film *f = params;

    (void)size;
    return f->range * h;
}

#include <plugflow/twin_real.h>
#include "equations.h"
#include <plugflow/twin_complex.h>
#include "equations.h"

static const pf_term repulsion = {
    PF_TERM(repulsion),
    .where = PF_PAIR,
    .flags = PF_LINEAR,
    .doc = "-F_0(1-\\mathrm{gap}/\\mathrm{range})^2\\,n\\cdot V",
    .cite = "Glowinski et al. 1999, Int. J. Multiphase Flow 25:755",
    PF_OUT({"V", "U", PF_DEFECT, PF_VECTOR}),
    PF_PARAMS(struct contact, PF_DENSITY(struct contact), PF_GRAVITY(struct contact),
              PF_NUMBER(struct contact, range, "m", "gap at which the force begins; 0: a fifth of the body",
                        PF_NOT_NEGATIVE),
              PF_NUMBER(struct contact, strength, "1",
                        "force at contact, in units of the weight under water of a box round the body", .dflt = 5,
                        PF_NOT_NEGATIVE),
              PF_NUMBER(struct contact, force, "N", "force at contact, instead of strength", PF_NOT_NEGATIVE)),
    .reach = repulsion_reach,
};

static const pf_term lubrication = {
    PF_TERM(lubrication),
    .where = PF_PAIR,
    .flags = PF_LINEAR | PF_OPTIONAL,
    .doc = "6\\pi\\mu R^2\\left(\\frac1{\\mathrm{gap}}-\\frac1{\\mathrm{range}}\\right)(U\\cdot n)(V\\cdot n)"
           "\\ \\text{(3D)},\\ R=\\frac{R_iR_j}{R_i+R_j}",
    .cite = "Kim and Karrila 1991, Microhydrodynamics, ch. 9; 2D: Jeffrey and Onishi 1981, Q. J. Mech. Appl. Math. "
            "34:129",
    PF_IN({"U", "U", PF_DEFECT, PF_VECTOR}, PF_TAKES_VISCOSITY),
    PF_OUT({"V", "U", PF_DEFECT, PF_VECTOR}),
    PF_PARAMS(struct film, PF_VISCOSITY(struct film),
              PF_NUMBER(struct film, range, "1", "gap below which the mesh does not resolve the film, in cells",
                        .dflt = 2, PF_NOT_NEGATIVE),
              PF_NUMBER(struct film, floor, "1",
                        "gap below which the resistance grows no more (roughness), in cells", .dflt = 0.1,
                        .min = 1e-6, .max = 1e30)),
    .reach = film_reach,
};

static const pf_plugin contact = {
    PF_PLUGIN,
    .min_minor = 4,
    .name = "contact",
    .version = "1.0",
    .author = "plugflow",
    .license = "GPL-3.0-or-later",
    .doc = "short-range forces between bodies and walls",
    PF_FIELDS(PF_FIELD_BODY_VELOCITY()),
    PF_TERMS(&repulsion, &lubrication),
};
PF_ENTRY(contact)
