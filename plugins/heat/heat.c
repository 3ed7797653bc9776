/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Heat carried and conducted by a fluid, and the buoyancy it causes (Boussinesq),
 *
 *     rho c (dT/dt + u . grad T) = div(k grad T) + q,     rho Du/dt = ... + rho (1 - beta (T - T_ref)) g.
 *
 * The equations stand in equations.h; bodies in the fluid are the subject of the plugin heat_bodies. */
#include <plugflow/fluid.h>

#include <tgmath.h>

struct heat {
    double conductivity;          /* k, W/(m K)    */
    double heat_capacity;         /* c, J/(kg K)   */
    double density;               /* rho, kg/m^3   */
    double expansion;             /* beta, 1/K     */
    double reference_temperature; /* T_ref, K      */
    double gravity[3];            /* g, m/s^2      */
};

#define NO_ZERO          1e-300 /* so that fluid without conductivity may be at rest */
#define INVERSE_ESTIMATE 60.0   /* K in h |lap s| <= sqrt(K) |grad s| of second-order elements */

#include <plugflow/twin_real.h>
#include "equations.h"
#include <plugflow/twin_complex.h>
#include "equations.h"

static int advection_jacobian(const pf_batch *b, const double *const *in, double *const *jac)
{
    const struct heat *h = b->params;
    const double *restrict u = in[0], *restrict grad_T = in[1];
    double *restrict ds_du = jac[0], *restrict ds_dgrad = jac[1];

    for (uint32_t k = 0; k < b->dim; k++)
        PF_LANES_OF (b, i) {
            ds_du[k * LD + i] = h->density * h->heat_capacity * grad_T[k * LD + i];
            ds_dgrad[k * LD + i] = h->density * h->heat_capacity * u[k * LD + i];
        }
    return PF_OK;
}

#define CONDUCTIVITY                                                                                               \
    PF_NUMBER(struct heat, conductivity, "W/(m K)", "thermal conductivity", .flags = PF_REQUIRED | PF_SHARED,      \
              PF_NOT_NEGATIVE)
#define HEAT_CAPACITY                                                                                              \
    PF_NUMBER(struct heat, heat_capacity, "J/(kg K)", "heat capacity per mass", .flags = PF_REQUIRED | PF_SHARED,  \
              PF_NOT_NEGATIVE)
#define SOURCE                                                                                                     \
    {                                                                                                              \
        "heat_source", NULL, PF_DATA, PF_SCALAR                                                                    \
    }

static const pf_term storage = {
    PF_TERM(storage),
    .where = PF_FLUID,
    .flags = PF_LINEAR,
    .doc = "\\rho c\\,\\partial_t T\\,s",
    .cite = "Bird, Stewart, Lightfoot (2002), 11.2",
    PF_IN({"T_t", "T", PF_DOT, PF_SCALAR}),
    PF_OUT({"s", "T", PF_VALUE, PF_SCALAR}),
    PF_PARAMS(struct heat, HEAT_CAPACITY, PF_DENSITY(struct heat)),
    PF_EXAMPLES({"c = 4, rho = 2: 4*2*3", 2, (double[]){4, 2}, (double[]){3}, (double[]){24}, 1e-15}),
};

static const pf_term advection = {
    PF_TERM(advection),
    .where = PF_FLUID,
    .flags = PF_CONTINUATION,
    .doc = "\\rho c\\,(u\\cdot\\nabla T)\\,s",
    .cite = "Bird, Stewart, Lightfoot (2002), 11.2",
    PF_IN({"u", "u", PF_VALUE, PF_VECTOR}, {"grad_T", "T", PF_GRAD, PF_VECTOR}),
    PF_OUT({"s", "T", PF_VALUE, PF_SCALAR}),
    PF_PARAMS(struct heat, HEAT_CAPACITY, PF_DENSITY(struct heat)),
    PF_EXAMPLES({"u = (1, -2), grad T = (3, 5): 4*2*(1*3 - 2*5)", 2, (double[]){4, 2}, (double[]){1, -2, 3, 5},
                 (double[]){-56}, 1e-15}),
    .jacobian = advection_jacobian,
};

static const pf_term diffusion = {
    PF_TERM(diffusion),
    .where = PF_FLUID,
    .flags = PF_LINEAR,
    .doc = "k\\,\\nabla T\\cdot\\nabla s",
    .cite = "Fourier's law; Carslaw, Jaeger (1959), 1.6",
    PF_IN({"grad_T", "T", PF_GRAD, PF_VECTOR}),
    PF_OUT({"grad_s", "T", PF_GRAD, PF_VECTOR}),
    PF_PARAMS(struct heat, CONDUCTIVITY),
    PF_EXAMPLES(
        {"k = 3, grad T = (1, -2, 5)", 3, (double[]){3}, (double[]){1, -2, 5}, (double[]){3, -6, 15}, 1e-15}),
};

static const pf_term source = {
    PF_TERM(source),
    .where = PF_FLUID,
    .flags = PF_LINEAR,
    .doc = "-q\\,s",
    .cite = "Bird, Stewart, Lightfoot (2002), 11.2",
    PF_IN(SOURCE),
    PF_OUT({"s", "T", PF_VALUE, PF_SCALAR}),
    PF_EXAMPLES({"q = 3 W/m^3 into the fluid", 2, NULL, (double[]){3}, (double[]){-3}, 1e-15}),
};

static const pf_term streamline = {
    PF_TERM(streamline),
    .where = PF_FLUID,
    .flags = PF_OPTIONAL | PF_CONTINUATION | PF_METRIC,
    .doc =
        "\\tau\\,(\\rho c\\,\\partial_t T+\\rho c\\,u\\cdot\\nabla T-k\\,\\Delta T-q)\\,\\rho c\\,w\\cdot\\nabla "
        "s",
    .cite = "Brooks and Hughes 1982, Comput. Methods Appl. Mech. Eng. 32:199",
    PF_IN({"u", "u", PF_VALUE, PF_VECTOR}, {"old_u", "u", PF_OLD, PF_VECTOR}, {"grad_T", "T", PF_GRAD, PF_VECTOR},
          {"lap_T", "T", PF_LAPLACE, PF_SCALAR}, {"T_t", "T", PF_DOT, PF_SCALAR}, SOURCE),
    PF_OUT({"grad_s", "T", PF_GRAD, PF_VECTOR}),
    PF_PARAMS(struct heat, CONDUCTIVITY, HEAT_CAPACITY, PF_DENSITY(struct heat)),
    /* the metric of worked examples is (4 1; 1 2), the factor of the time scheme 15: m = 4 (900 + 214) + 60 22 =
     * 76^2; residual 2 (13 + 3 - 10) + 7 - 5 = 14 */
    PF_EXAMPLES({"k = 1, rho c = 2; u = (1, -2) is carried by w = (2, 9), grad T = (3, 5), lap T = -7, dT/dt = 13, "
                 "q = 5",
                 2, (double[]){1, 1, 2}, (double[]){1, -2, 2, 9, 3, 5, -7, 13, 5},
                 (double[]){56.0 / 76, 252.0 / 76}, 1e-14}),
};

static const pf_term buoyancy = {
    PF_TERM(buoyancy),
    .where = PF_FLUID,
    .flags = PF_LINEAR | PF_CONTINUATION,
    .doc = "\\rho\\beta\\,(T-T_{ref})\\,g\\cdot v",
    .cite = "Boussinesq 1903; de Vahl Davis 1983, Int. J. Numer. Meth. Fluids 3:249",
    PF_IN({"T", "T", PF_VALUE, PF_SCALAR}),
    PF_OUT({"v", "u", PF_VALUE, PF_VECTOR}),
    PF_PARAMS(struct heat,
              PF_NUMBER(struct heat, expansion, "1/K", "relative change of volume with temperature", .dflt = 0),
              PF_NUMBER(struct heat, reference_temperature, "K", "temperature at which density holds", .dflt = 0),
              PF_DENSITY(struct heat), PF_GRAVITY(struct heat)),
    PF_EXAMPLES({"beta = 0.5, T_ref = 3, rho = 2, g = (0, -10), T = 7", 2, (double[]){0.5, 3, 2, 0, -10},
                 (double[]){7}, (double[]){0, -40}, 1e-15}),
};

static const pf_term heat_flux = {
    PF_TERM(heat_flux),
    .where = PF_FACET,
    .flags = PF_LINEAR | PF_BY_BOUNDARY,
    .doc = "-q\\,s",
    .cite = "Carslaw, Jaeger (1959), 1.9",
    PF_IN({"heat_flux", NULL, PF_DATA, PF_SCALAR}),
    PF_OUT({"s", "T", PF_VALUE, PF_SCALAR}),
    PF_EXAMPLES({"q = 3 W/m^2 into the fluid", 2, NULL, (double[]){3}, (double[]){-3}, 1e-15}),
};

static const pf_plugin heat = {
    PF_PLUGIN,
    .min_minor = 3,
    .name = "heat",
    .version = "1.0",
    .author = "plugflow",
    .license = "GPL-3.0-or-later",
    .doc = "heat carried and conducted by a fluid, and buoyancy",
    PF_FIELDS({.name = "T",
               .unit = "K",
               .doc = "temperature",
               .shape = PF_SCALAR,
               .order = 2,
               .reaction = "heat",
               .reaction_unit = "W"},
              PF_FIELD_VELOCITY),
    PF_TERMS(&storage, &advection, &diffusion, &source, &streamline, &buoyancy, &heat_flux),
};
PF_ENTRY(heat)
