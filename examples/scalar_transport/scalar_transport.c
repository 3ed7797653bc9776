/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Heat carried and conducted by a fluid, and the buoyancy it causes (Boussinesq),
 *
 *     rho c (dT/dt + u . grad T) = div(k grad T),     rho Du/dt = ... + rho (1 - beta (T - T_ref)) g.
 *
 * A plugin outside plugflow's own tree: a field of its own, T, and terms that couple it to the
 * velocity u of momentum.  The equations stand in equations.h. */
#include <plugflow/plugin.h>

struct heat {
    double conductivity;          /* k, W/(m K)    */
    double heat_capacity;         /* c, J/(kg K)   */
    double density;               /* rho, kg/m^3   */
    double expansion;             /* beta, 1/K     */
    double reference_temperature; /* T_ref, K      */
    double gravity[3];            /* g, m/s^2      */
};

#include <plugflow/twin_real.h>
#include "equations.h"
#include <plugflow/twin_complex.h>
#include "equations.h"

/* d(advection)/du = rho c grad T and d(advection)/d(grad T) = rho c u.  The other terms leave
 * their derivatives to the complex twins. */
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

/* u as momentum declares it, T for the first time. */
static const pf_field fields[] = {
    {.name = "u",
     .unit = "m/s",
     .doc = "velocity",
     .shape = PF_VECTOR,
     .order = 2,
     .reaction = "force",
     .reaction_unit = "N"},
    {.name = "T",
     .unit = "K",
     .doc = "temperature",
     .shape = PF_SCALAR,
     .order = 2,
     .reaction = "heat",
     .reaction_unit = "W"},
};

#define KEY(NAME, UNIT, DOC, TYPE, FLAGS, MAX)                                                                     \
    {                                                                                                              \
        .name = #NAME, .unit = UNIT, .doc = DOC, .type = TYPE, .flags = FLAGS,                                     \
        .offset = offsetof(struct heat, NAME), .max = MAX                                                          \
    }

/* Each term lists its own keys; all read the same struct. */
#define CONDUCTIVITY  KEY(conductivity, "W/(m K)", "thermal conductivity", PF_T_REAL, PF_REQUIRED, 1e30)
#define HEAT_CAPACITY KEY(heat_capacity, "J/(kg K)", "heat capacity per mass", PF_T_REAL, PF_REQUIRED, 1e30)
#define DENSITY       KEY(density, "kg/m^3", "mass per volume", PF_T_REAL, PF_REQUIRED | PF_SHARED, 1e30)
#define EXPANSION     KEY(expansion, "1/K", "relative change of volume with temperature", PF_T_REAL, 0, 0)
#define REFERENCE     KEY(reference_temperature, "K", "temperature at which density holds", PF_T_REAL, 0, 0)
#define GRAVITY       KEY(gravity, "m/s^2", "acceleration of gravity", PF_T_VECTOR, PF_SHARED, 0)

static const pf_param storage_params[] = {HEAT_CAPACITY, DENSITY};
static const pf_param advection_params[] = {HEAT_CAPACITY, DENSITY};
static const pf_param diffusion_params[] = {CONDUCTIVITY};
static const pf_param buoyancy_params[] = {DENSITY, EXPANSION, REFERENCE, GRAVITY};

static const pf_slot T_t[] = {{"T_t", "T", PF_DOT, PF_SCALAR}};
static const pf_slot u_grad_T[] = {{"u", "u", PF_VALUE, PF_VECTOR}, {"grad_T", "T", PF_GRAD, PF_VECTOR}};
static const pf_slot grad_T[] = {{"grad_T", "T", PF_GRAD, PF_VECTOR}};
static const pf_slot temperature[] = {{"T", "T", PF_VALUE, PF_SCALAR}};
static const pf_slot flux_data[] = {{"heat_flux", NULL, PF_DATA, PF_SCALAR}};
static const pf_slot s[] = {{"s", "T", PF_VALUE, PF_SCALAR}};
static const pf_slot grad_s[] = {{"grad_s", "T", PF_GRAD, PF_VECTOR}};
static const pf_slot v[] = {{"v", "u", PF_VALUE, PF_VECTOR}};

/* One point each, worked out by hand; params in the order of the keys. */
static const pf_example storage_example[] = {
    {"c = 4, rho = 2: 4*2*3", 2, (double[]){4, 2}, (double[]){3}, (double[]){24}, 1e-15}};
static const pf_example advection_example[] = {{"u = (1, -2), grad T = (3, 5): 4*2*(1*3 - 2*5)", 2,
                                                (double[]){4, 2}, (double[]){1, -2, 3, 5}, (double[]){-56}, 1e-15}};
static const pf_example diffusion_example[] = {
    {"k = 3, grad T = (1, -2, 5)", 3, (double[]){3}, (double[]){1, -2, 5}, (double[]){3, -6, 15}, 1e-15}};
static const pf_example buoyancy_example[] = {{"hot rises: T - T_ref = 10, 2*0.5*10*(0, -3)", 2,
                                               (double[]){2, 0.5, 300, 0, -3}, (double[]){310}, (double[]){0, -30},
                                               1e-15}};
static const pf_example flux_example[] = {{"q = 7", 2, NULL, (double[]){7}, (double[]){-7}, 1e-15}};

#define COUNT(A) (sizeof(A) / sizeof(A)[0])
#define TERM(NAME, WHERE, FLAGS, WEAK, CITE, IN, OUT, EXAMPLE, ...)                                                \
    static const pf_term NAME = {.size = sizeof(pf_term),                                                          \
                                 .slot_size = sizeof(pf_slot),                                                     \
                                 .param_size = sizeof(pf_param),                                                   \
                                 .example_size = sizeof(pf_example),                                               \
                                 .params_bytes = sizeof(struct heat),                                              \
                                 .name = #NAME,                                                                    \
                                 .where = WHERE,                                                                   \
                                 .flags = FLAGS,                                                                   \
                                 .doc = WEAK,                                                                      \
                                 .cite = CITE,                                                                     \
                                 .in = IN,                                                                         \
                                 .n_in = COUNT(IN),                                                                \
                                 .out = OUT,                                                                       \
                                 .n_out = 1,                                                                       \
                                 .example = EXAMPLE,                                                               \
                                 .n_example = 1,                                                                   \
                                 .residual = NAME##_real,                                                          \
                                 .residual_c = NAME##_complex,                                                     \
                                 __VA_ARGS__}
#define WITH(PARAMS) .param = PARAMS, .n_param = COUNT(PARAMS)

TERM(storage, PF_FLUID, PF_LINEAR, "\\rho c\\,\\partial_t T\\,s", "Bird, Stewart, Lightfoot (2002), 11.2", T_t, s,
     storage_example, WITH(storage_params));
TERM(advection, PF_FLUID, PF_CONTINUATION, "\\rho c\\,(u\\cdot\\nabla T)\\,s",
     "Bird, Stewart, Lightfoot (2002), 11.2", u_grad_T, s, advection_example, WITH(advection_params),
     .jacobian = advection_jacobian);
TERM(diffusion, PF_FLUID, PF_LINEAR, "k\\,\\nabla T\\cdot\\nabla s", "Fourier's law; Carslaw, Jaeger (1959), 1.6",
     grad_T, grad_s, diffusion_example, WITH(diffusion_params));
TERM(buoyancy, PF_FLUID, PF_LINEAR | PF_CONTINUATION, "\\rho\\beta\\,(T-T_{ref})\\,g\\cdot v",
     "Gray, Giorgini, Int. J. Heat Mass Transfer 19 (1976) 545-551", temperature, v, buoyancy_example,
     WITH(buoyancy_params));
TERM(heat_flux, PF_FACET, PF_LINEAR | PF_BY_BOUNDARY, "-q\\,s", "Carslaw, Jaeger (1959), 1.9", flux_data, s,
     flux_example, .n_param = 0);

static const pf_term *const terms[] = {&storage, &advection, &diffusion, &buoyancy, &heat_flux};

static const pf_plugin scalar_transport = {
    .size = sizeof(pf_plugin),
    .major = PF_ABI_MAJOR,
    .minor = PF_ABI_MINOR,
    .sizes = PF_SIZES,
    .name = "scalar_transport",
    .version = "1.0",
    .author = "plugflow",
    .license = "GPL-3.0-or-later",
    .doc = "transport of heat by a fluid, and its buoyancy (Boussinesq)",
    .term = terms,
    .n_term = COUNT(terms),
    .field = fields,
    .n_field = COUNT(fields),
    .field_size = sizeof(pf_field),
};

PF_EXPORT const pf_plugin *pf_plugin_entry(const pf_host *host, char *err, size_t nerr)
{
    (void)host, (void)err, (void)nerr;
    return &scalar_transport;
}
