/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Momentum balance of an incompressible fluid (appendix A.7-A.15),
 *
 *     rho (du/dt + (u . grad) u) = div(2 mu D(u) - p I) + rho g + f,
 *
 * as integrators that a case can switch singly.  rho and mu are numbers of the case, or what other terms publish.
 * The equations stand in equations.h; this file says which fields they read, which test functions they meet, and
 * what a user may set. */
#include <plugflow/fluid.h>

#include <complex.h>

#include <plugflow/twin_real.h>
#include "equations.h"
#include <plugflow/twin_complex.h>
#include "equations.h"

/* d(rho du/dt)/d(du/dt); A.13-A.15, first part */
static int inertia_jacobian(const pf_batch *b, const double *const *in, double *const *jac)
{
    const double *restrict u_t = in[0], *restrict rho = in[1];
    double *restrict dv_du = jac[0], *restrict dv_drho = jac[1];

    for (uint32_t a = 0; a < b->dim; a++)
        PF_LANES_OF (b, i) {
            dv_du[(a * b->dim + a) * LD + i] = rho[i];
            dv_drho[a * LD + i] = u_t[a * LD + i];
        }
    return PF_OK;
}

/* d(convection)/du and d(convection)/d(grad u); A.13-A.15, second part */
static int convection_jacobian(const pf_batch *b, const double *const *in, double *const *jac)
{
    const double *restrict u = in[0], *restrict grad_u = in[1], *restrict rho = in[2];
    double *restrict dv_du = jac[0], *restrict dv_dgrad = jac[1], *restrict dv_drho = jac[2];
    const uint32_t d = b->dim;

    for (uint32_t a = 0; a < d; a++)
        for (uint32_t k = 0; k < d; k++)
            PF_LANES_OF (b, i) {
                dv_du[(a * d + k) * LD + i] = rho[i] * grad_u[(a * d + k) * LD + i];
                dv_dgrad[(a * d * d + a * d + k) * LD + i] = rho[i] * u[k * LD + i];
                dv_drho[a * LD + i] += u[k * LD + i] * grad_u[(a * d + k) * LD + i];
            }
    return PF_OK;
}

/* d(viscous)/d(grad u) and d(viscous)/d(mu); A.13-A.15, last parts */
static int viscous_jacobian(const pf_batch *b, const double *const *in, double *const *jac)
{
    const double *restrict grad_u = in[0], *restrict mu = in[1];
    double *restrict ds_dgrad = jac[0], *restrict ds_dmu = jac[1];
    const uint32_t d = b->dim, dd = d * d;

    for (uint32_t a = 0; a < d; a++)
        for (uint32_t k = 0; k < d; k++)
            PF_LANES_OF (b, i) {
                ds_dgrad[((a * d + k) * dd + a * d + k) * LD + i] += mu[i];
                ds_dgrad[((a * d + k) * dd + k * d + a) * LD + i] += mu[i];
                ds_dmu[(a * d + k) * LD + i] = grad_u[(a * d + k) * LD + i] + grad_u[(k * d + a) * LD + i];
            }
    return PF_OK;
}

/* d(-p)/dp */
static int pressure_gradient_jacobian(const pf_batch *b, const double *const *in, double *const *jac)
{
    (void)in;
    PF_LANES_OF (b, i)
        jac[0][i] = -1;
    return PF_OK;
}

/* d(backflow)/du, d(backflow)/d(rho); nothing where fluid goes out */
static int backflow_jacobian(const pf_batch *b, const double *const *in, double *const *jac)
{
    const double *restrict u = in[0], *restrict beta = in[1], *restrict rho = in[2];
    double *restrict dv_du = jac[0], *restrict dv_drho = jac[2];
    const uint32_t d = b->dim;

    PF_LANES_OF (b, i) {
        double inward = 0, c;

        for (uint32_t a = 0; a < d; a++)
            inward += u[a * LD + i] * b->normal[a * LD + i];
        c = inward < 0 ? -0.5 * beta[i] : 0;
        for (uint32_t a = 0; a < d; a++) {
            dv_drho[a * LD + i] = c * inward * u[a * LD + i];
            for (uint32_t k = 0; k < d; k++)
                dv_du[(a * d + k) * LD + i] =
                    c * rho[i] * (u[a * LD + i] * b->normal[k * LD + i] + (a == k ? inward : 0));
        }
    }
    return PF_OK;
}

/* One point, worked out by hand: rho = 2, mu = 3, g = (0, -10). */
static const double weight_2d[] = {2, 0, -10, 0};

#define WEIGHT PF_PARAMS(pf_fluid, PF_DENSITY(pf_fluid), PF_GRAVITY(pf_fluid), PF_REDUCED_PRESSURE(pf_fluid))

static const pf_term inertia = {
    PF_TERM(inertia),
    .where = PF_CELL,
    .flags = PF_LINEAR,
    .doc = "\\rho\\,\\partial_t u\\cdot v",
    .cite = "appendix A.7-A.15",
    PF_IN({"u_t", "u", PF_DOT, PF_VECTOR}, PF_TAKES_DENSITY),
    PF_OUT({"v", "u", PF_VALUE, PF_VECTOR}),
    PF_PARAMS(pf_fluid, PF_DENSITY(pf_fluid)),
    PF_EXAMPLES({"rho = 2, u_t = (1, -2)", 2, NULL, (double[]){1, -2, 2}, (double[]){2, -4}, 1e-15}),
    .jacobian = inertia_jacobian,
};

static const pf_term convection = {
    PF_TERM(convection),
    .where = PF_CELL,
    .flags = PF_CONTINUATION,
    .doc = "\\rho\\,(u\\cdot\\nabla)u\\cdot v",
    .cite = "appendix A.7-A.15",
    PF_IN({"u", "u", PF_VALUE, PF_VECTOR}, {"grad_u", "u", PF_GRAD, PF_TENSOR}, PF_TAKES_DENSITY),
    PF_OUT({"v", "u", PF_VALUE, PF_VECTOR}),
    PF_PARAMS(pf_fluid, PF_DENSITY(pf_fluid)),
    PF_EXAMPLES({"rho = 2, u = (1, 2), grad u = (3 4; 5 6): rho (1*3 + 2*4, 1*5 + 2*6)", 2, NULL,
                 (double[]){1, 2, 3, 4, 5, 6, 2}, (double[]){22, 34}, 1e-15}),
    .jacobian = convection_jacobian,
};

static const pf_term viscous = {
    PF_TERM(viscous),
    .where = PF_CELL,
    .flags = PF_LINEAR,
    .doc = "2\\mu D(u):\\nabla v",
    .cite = "appendix A.7-A.15",
    PF_IN({"grad_u", "u", PF_GRAD, PF_TENSOR}, PF_TAKES_VISCOSITY),
    PF_OUT({"grad_v", "u", PF_GRAD, PF_TENSOR}),
    PF_PARAMS(pf_fluid, PF_VISCOSITY(pf_fluid)),
    PF_EXAMPLES({"grad u = (1 2; 4 -1), mu = 3: mu (2 6; 6 -2)", 2, NULL, (double[]){1, 2, 4, -1, 3},
                 (double[]){6, 18, 18, -6}, 1e-15}),
    .jacobian = viscous_jacobian,
};

static const pf_term pressure_gradient = {
    PF_TERM(pressure_gradient),
    .where = PF_CELL,
    .flags = PF_LINEAR,
    .doc = "-p\\,\\nabla\\cdot v",
    .cite = "appendix A.7-A.15",
    PF_IN({"p", "p", PF_VALUE, PF_SCALAR}),
    PF_OUT({"div_v", "u", PF_DIV, PF_SCALAR}),
    PF_EXAMPLES({"p = 7", 2, NULL, (double[]){7}, (double[]){-7}, 1e-15}),
    .jacobian = pressure_gradient_jacobian,
};

static const pf_term body_force = {
    PF_TERM(body_force),
    .where = PF_CELL,
    .flags = PF_LINEAR,
    .doc = "-(\\rho g+f)\\cdot v",
    .cite = "appendix A.7-A.15",
    PF_IN({"force", NULL, PF_DATA, PF_VECTOR}, PF_TAKES_DENSITY),
    PF_OUT({"v", "u", PF_VALUE, PF_VECTOR}),
    WEIGHT,
    PF_EXAMPLES(
        {"rho = 2, f = (1, 5), g = (0, -10)", 2, weight_2d, (double[]){1, 5, 2}, (double[]){-1, 15}, 1e-15}),
};

static const pf_term traction = {
    PF_TERM(traction),
    .where = PF_FACET,
    .flags = PF_LINEAR | PF_BY_BOUNDARY,
    .doc = "-t\\cdot v",
    .cite = "appendix A.7-A.15",
    PF_IN({"traction", NULL, PF_DATA, PF_VECTOR}),
    PF_OUT({"v", "u", PF_VALUE, PF_VECTOR}),
    PF_EXAMPLES({"t = (1, 2)", 2, NULL, (double[]){1, 2}, (double[]){-1, -2}, 1e-15}),
};

static const pf_term pressure = {
    PF_TERM(pressure),
    .where = PF_FACET,
    .flags = PF_LINEAR | PF_BY_BOUNDARY,
    .doc = "p_b\\,n\\cdot v",
    .cite = "Heywood, Rannacher and Turek 1996, Int. J. Numer. Methods Fluids 22:325",
    PF_IN({"pressure", NULL, PF_DATA, PF_SCALAR}, PF_TAKES_DENSITY),
    PF_OUT({"v", "u", PF_VALUE, PF_VECTOR}),
    WEIGHT,
    PF_EXAMPLES({"p_b = 10, n = (0.6, -0.8)", 2, weight_2d, (double[]){10, 2}, (double[]){6, -8}, 1e-15}),
};

static const pf_term backflow = {
    PF_TERM(backflow),
    .where = PF_FACET,
    .flags = PF_BY_BOUNDARY | PF_CONTINUATION,
    .doc = "-\\frac\\beta2\\rho\\,(u\\cdot n)_-\\,u\\cdot v",
    .cite = "Bertoglio and Caiazzo 2014, J. Comput. Phys. 261:162; Braack and Mucha 2014, J. Comput. Math. 32:507",
    PF_IN({"u", "u", PF_VALUE, PF_VECTOR}, {"backflow", NULL, PF_DATA, PF_SCALAR}, PF_TAKES_DENSITY),
    PF_OUT({"v", "u", PF_VALUE, PF_VECTOR}),
    PF_PARAMS(pf_fluid, PF_DENSITY(pf_fluid)),
    PF_EXAMPLES({"rho = 2, n = (0.6, -0.8), u = (1, 2) comes in: u.n = -1", 2, NULL, (double[]){1, 2, 1, 2},
                 (double[]){1, 2}, 1e-15},
                {"u = (2, 0.25) goes out", 2, NULL, (double[]){2, 0.25, 1, 2}, (double[]){0, 0}, 1e-15}),
    .jacobian = backflow_jacobian,
};

static const pf_plugin momentum = {
    PF_PLUGIN,
    .min_minor = 4,
    .name = "momentum",
    .version = "1.0",
    .author = "plugflow",
    .license = "GPL-3.0-or-later",
    .doc = "momentum balance of an incompressible fluid",
    PF_FIELDS(PF_FIELD_VELOCITY, PF_FIELD_PRESSURE),
    PF_TERMS(&inertia, &convection, &viscous, &pressure_gradient, &body_force, &traction, &pressure, &backflow),
};
PF_ENTRY(momentum)
