/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Momentum balance of an incompressible Newtonian fluid (appendix A.7-A.15),
 *
 *     rho (du/dt + (u . grad) u) = div(2 mu D(u) - p I) + rho g + f,
 *
 * as integrators that a case can switch singly.  The equations stand in equations.h; this file
 * says which fields they read, which test functions they meet, and what a user may set. */
#include <plugflow/plugin.h>

struct fluid {
    double density;    /* rho, kg/m^3 */
    double viscosity;  /* mu, Pa s    */
    double gravity[3]; /* g, m/s^2    */
    int reduced;       /* 1: p is the pressure without rho g.x, so gravity is no force */
};

#include <plugflow/twin_real.h>
#include "equations.h"
#include <plugflow/twin_complex.h>
#include "equations.h"

/* d(rho du/dt)/d(du/dt); A.13-A.15, first part */
static int inertia_jacobian(const pf_batch *b, const double *const *in, double *const *jac)
{
    const struct fluid *f = b->params;

    (void)in;
    for (uint32_t a = 0; a < b->dim; a++)
        PF_LANES_OF (b, i)
            jac[0][(a * b->dim + a) * LD + i] = f->density;
    return PF_OK;
}

/* d(convection)/du and d(convection)/d(grad u); A.13-A.15, second part */
static int convection_jacobian(const pf_batch *b, const double *const *in, double *const *jac)
{
    const struct fluid *f = b->params;
    const double *restrict u = in[0], *restrict grad_u = in[1];
    double *restrict dv_du = jac[0], *restrict dv_dgrad = jac[1];
    const uint32_t d = b->dim;

    for (uint32_t a = 0; a < d; a++)
        for (uint32_t k = 0; k < d; k++)
            PF_LANES_OF (b, i) {
                dv_du[(a * d + k) * LD + i] = f->density * grad_u[(a * d + k) * LD + i];
                dv_dgrad[(a * d * d + a * d + k) * LD + i] = f->density * u[k * LD + i];
            }
    return PF_OK;
}

/* d(stress)/d(grad u) and d(stress)/dp; A.13-A.15, last parts */
static int stress_jacobian(const pf_batch *b, const double *const *in, double *const *jac)
{
    const struct fluid *f = b->params;
    double *restrict ds_dgrad = jac[0], *restrict ds_dp = jac[1];
    const uint32_t d = b->dim, dd = d * d;

    (void)in;
    for (uint32_t a = 0; a < d; a++)
        for (uint32_t k = 0; k < d; k++)
            PF_LANES_OF (b, i) {
                ds_dgrad[((a * d + k) * dd + a * d + k) * LD + i] += f->viscosity;
                ds_dgrad[((a * d + k) * dd + k * d + a) * LD + i] += f->viscosity;
                ds_dp[(a * d + k) * LD + i] = a == k ? -1 : 0;
            }
    return PF_OK;
}

static const pf_param fluid_params[] = {
    {.name = "density",
     .unit = "kg/m^3",
     .doc = "mass per volume",
     .type = PF_T_REAL,
     .flags = PF_REQUIRED | PF_SHARED,
     .offset = offsetof(struct fluid, density),
     .min = 0,
     .max = 1e30},
    {.name = "viscosity",
     .unit = "Pa s",
     .doc = "dynamic viscosity",
     .type = PF_T_REAL,
     .flags = PF_REQUIRED | PF_SHARED,
     .offset = offsetof(struct fluid, viscosity),
     .min = 0,
     .max = 1e30},
    {.name = "gravity",
     .unit = "m/s^2",
     .doc = "acceleration of gravity",
     .type = PF_T_VECTOR,
     .flags = PF_SHARED,
     .offset = offsetof(struct fluid, gravity)},
    {.name = "reduced_pressure",
     .unit = "1",
     .doc = "p without its hydrostatic part rho g.x",
     .type = PF_T_BOOL,
     .flags = PF_SHARED,
     .offset = offsetof(struct fluid, reduced)},
};

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

static const pf_slot u_t[] = {{"u_t", "u", PF_DOT, PF_VECTOR}};
static const pf_slot u_grad_u[] = {{"u", "u", PF_VALUE, PF_VECTOR}, {"grad_u", "u", PF_GRAD, PF_TENSOR}};
static const pf_slot grad_u_p[] = {{"grad_u", "u", PF_GRAD, PF_TENSOR}, {"p", "p", PF_VALUE, PF_SCALAR}};
static const pf_slot force[] = {{"force", NULL, PF_DATA, PF_VECTOR}};
static const pf_slot traction_data[] = {{"traction", NULL, PF_DATA, PF_VECTOR}};
static const pf_slot v[] = {{"v", "u", PF_VALUE, PF_VECTOR}};
static const pf_slot grad_v[] = {{"grad_v", "u", PF_GRAD, PF_TENSOR}};

/* One point, worked out by hand: rho = 2, mu = 3, g = (0, -10). */
static const double params_2d[] = {2, 3, 0, -10, 0};
static const pf_example inertia_2d[] = {
    {"u_t = (1, -2)", 2, params_2d, (double[]){1, -2}, (double[]){2, -4}, 1e-15}};
static const pf_example convection_2d[] = {{"u = (1, 2), grad u = (3 4; 5 6): rho (1*3 + 2*4, 1*5 + 2*6)", 2,
                                            params_2d, (double[]){1, 2, 3, 4, 5, 6}, (double[]){22, 34}, 1e-15}};
static const pf_example stress_2d[] = {{"grad u = (1 2; 4 -1), p = 7: mu (2 6; 6 -2) - 7 I", 2, params_2d,
                                        (double[]){1, 2, 4, -1, 7}, (double[]){-1, 18, 18, -13}, 1e-15}};
static const pf_example body_force_2d[] = {
    {"f = (1, 5), g = (0, -10)", 2, params_2d, (double[]){1, 5}, (double[]){-1, 15}, 1e-15}};
static const pf_example traction_2d[] = {{"t = (1, 2)", 2, params_2d, (double[]){1, 2}, (double[]){-1, -2}, 1e-15}};

#define INTEGRATOR(NAME, WHERE, DOC, IN, N_IN, OUT, ...)                                                           \
    static const pf_term NAME = {.size = sizeof(pf_term),                                                          \
                                 .where = WHERE,                                                                   \
                                 .name = #NAME,                                                                    \
                                 .doc = DOC,                                                                       \
                                 .cite = "appendix A.7-A.15",                                                      \
                                 .in = IN,                                                                         \
                                 .n_in = N_IN,                                                                     \
                                 .out = OUT,                                                                       \
                                 .n_out = 1,                                                                       \
                                 .slot_size = sizeof(pf_slot),                                                     \
                                 .param = fluid_params,                                                            \
                                 .n_param = 4,                                                                     \
                                 .param_size = sizeof(pf_param),                                                   \
                                 .params_bytes = sizeof(struct fluid),                                             \
                                 .example = NAME##_2d,                                                             \
                                 .n_example = 1,                                                                   \
                                 .example_size = sizeof(pf_example),                                               \
                                 .residual = NAME##_real,                                                          \
                                 .residual_c = NAME##_complex,                                                     \
                                 __VA_ARGS__}

INTEGRATOR(inertia, PF_CELL, "\\rho\\,\\partial_t u\\cdot v", u_t, 1, v, .flags = PF_LINEAR,
           .jacobian = inertia_jacobian);
INTEGRATOR(convection, PF_CELL, "\\rho\\,(u\\cdot\\nabla)u\\cdot v", u_grad_u, 2, v, .flags = PF_CONTINUATION,
           .jacobian = convection_jacobian);
INTEGRATOR(stress, PF_CELL, "(2\\mu D(u)-p\\,I):\\nabla v", grad_u_p, 2, grad_v, .flags = PF_LINEAR,
           .jacobian = stress_jacobian);
INTEGRATOR(body_force, PF_CELL, "-(\\rho g+f)\\cdot v", force, 1, v, .flags = PF_LINEAR);
INTEGRATOR(traction, PF_FACET, "-t\\cdot v", traction_data, 1, v, .flags = PF_LINEAR | PF_BY_BOUNDARY);

static const pf_term *const terms[] = {&inertia, &convection, &stress, &body_force, &traction};

static const pf_plugin momentum = {
    .size = sizeof(pf_plugin),
    .major = PF_ABI_MAJOR,
    .minor = PF_ABI_MINOR,
    .sizes = PF_SIZES,
    .name = "momentum",
    .version = "1.0",
    .author = "plugflow",
    .license = "GPL-3.0-or-later",
    .doc = "momentum balance of an incompressible Newtonian fluid",
    .term = terms,
    .n_term = 5,
    .field = fields,
    .n_field = 2,
    .field_size = sizeof(pf_field),
};

PF_EXPORT const pf_plugin *pf_plugin_entry(const pf_host *host, char *err, size_t nerr)
{
    (void)host, (void)err, (void)nerr;
    return &momentum;
}
