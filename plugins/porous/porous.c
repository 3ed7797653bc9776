/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Flow through a porous medium and beside it (Brinkman, Forchheimer): momentum loses
 *
 *     mu/K u + rho c_F/sqrt(K) |u| u
 *
 * where the case says that there is a medium, of permeability K.  u is the superficial velocity, so that flow is
 * conserved across the edge of a medium, and so are velocity and stress: what slips along it is a result. */
#include <plugflow/fluid.h>

#include <tgmath.h>

struct medium {
    double density, viscosity; /* rho, kg/m^3; mu, Pa s */
    double forchheimer;        /* c_F                   */
};

#define NO_ZERO 1e-300 /* so that fluid may be at rest */

#include <plugflow/twin_real.h>
#include "equations.h"
#include <plugflow/twin_complex.h>
#include "equations.h"

static int drag_jacobian(const pf_batch *b, const double *const *in, double *const *jac)
{
    const struct medium *m = b->params;
    const double *restrict u = in[0], *restrict k = in[1];

    PF_LANES_OF (b, i) {
        const double inertia = m->density * m->forchheimer * sqrt(k[i]);
        double speed = 0;

        for (uint32_t a = 0; a < b->dim; a++)
            speed += u[a * LD + i] * u[a * LD + i];
        speed = sqrt(speed + NO_ZERO);
        for (uint32_t a = 0; a < b->dim; a++)
            for (uint32_t c = 0; c < b->dim; c++)
                jac[0][(a * b->dim + c) * LD + i] = (a == c ? m->viscosity * k[i] + inertia * speed : 0) +
                                                    inertia * u[a * LD + i] * u[c * LD + i] / speed;
    }
    return PF_OK;
}

static const pf_term drag = {
    PF_TERM(drag),
    .where = PF_FLUID,
    .flags = PF_CONTINUATION,
    .doc = "(\\mu K^{-1}+\\rho c_F K^{-1/2}|u|)\\,u\\cdot v",
    .cite =
        "Brinkman 1949, Appl. Sci. Res. A 1:27; Joseph, Nield and Papanicolaou 1982, Water Resour. Res. 18:1049",
    PF_IN({"u", "u", PF_VALUE, PF_VECTOR}, {"inverse_permeability", NULL, PF_DATA, PF_SCALAR, .unit = "1/m^2",
                                            .doc = "1/K; 0: free fluid", .min = 0, .max = 1e30}),
    PF_OUT({"v", "u", PF_VALUE, PF_VECTOR}),
    PF_PARAMS(struct medium, PF_DENSITY(struct medium), PF_VISCOSITY(struct medium),
              PF_NUMBER(struct medium, forchheimer, "1", "c_F of the inertial drag; about 0.5 of packed spheres",
                        .dflt = 0, PF_NOT_NEGATIVE)),
    PF_EXAMPLES({"mu = 3, 1/K = 4: 12 u", 2, (double[]){2, 3, 0}, (double[]){1, -2, 4}, (double[]){12, -24}, 1e-15},
                {"and rho = 2, c_F = 0.5, |u| = 5: 12 + 2 0.5 2 5", 2, (double[]){2, 3, 0.5}, (double[]){3, -4, 4},
                 (double[]){66, -88}, 1e-15},
                {"free fluid", 3, (double[]){2, 3, 0.5}, (double[]){3, -4, 5, 0}, (double[]){0, 0, 0}, 1e-15}),
    .jacobian = drag_jacobian,
};

static const pf_plugin porous = {
    PF_PLUGIN,
    .min_minor = 4,
    .name = "porous",
    .version = "1.0",
    .author = "plugflow",
    .license = "GPL-3.0-or-later",
    .doc = "drag of porous media (Brinkman, Forchheimer)",
    PF_FIELDS(PF_FIELD_VELOCITY),
    PF_TERMS(&drag),
};
PF_ENTRY(porous)
