/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What one wants to know of a flow: fields (shear rate, vorticity, dissipation), integrals over the fluid (kinetic
 * energy, enstrophy, dissipation), over boundaries (flow rate, pressure, shear, heat) and over bodies.  No term
 * gives an equation, and each is off unless its line, term "show.vorticity" {}, switches it on. */
#include <plugflow/term.h>

#include <plugflow/rigid_motion.h>

#define SHOWN .flags = PF_OPTIONAL, .cite = "docs/plugins.md, Outputs"

/* What makes a reduced pressure the true one. */
#define TRUE_PRESSURE                                                                                              \
    REAL(density, "kg/m^3", "mass per volume", .flags = PF_SHARED, PF_NOT_NEGATIVE), GRAVITY, REDUCED_PRESSURE
#define CONDUCTIVITY                                                                                               \
    REAL(conductivity, "W/(m K)", "thermal conductivity", .flags = PF_REQUIRED | PF_SHARED, PF_NOT_NEGATIVE)

/* --- fields --- */

/* 2 D : D = 1/2 (2 D) : (2 D) at lane i */
static inline NUM F(strain_squared)(const pf_batch *b, const NUM *grad_u, uint32_t i)
{
    NUM sum = 0;

    EACH (a)
        EACH (k) {
            const NUM e = AT(grad_u, a, k) + AT(grad_u, k, a);

            sum += 0.5 * e * e;
        }
    return sum;
}

TERM(shear_rate, PF_FLUID, IN(grad_u), OUT(SHOW(shear_rate, SCALAR, "1/s", "shear rate")), PARAMS(), SHOWN,
     .doc = "\\sqrt{2\\,D(u):D(u)}",
     PF_EXAMPLES({"grad u = (0 3; 1 0): a shear of 4", 2, NULL, (double[]){0, 3, 1, 0}, (double[]){4}, 1e-15}))
{
    LANES (i)
        shear_rate[i] = sqrt(F(strain_squared)(b, grad_u[0][0], i));
}

/* d u_y / dx - d u_x / dy; in 3D component a is d u_{a+2} / d x_{a+1} - d u_{a+1} / d x_{a+2} */
TERM(vorticity, PF_FLUID, IN(grad_u), OUT(SHOW(vorticity, SPIN, "1/s", "vorticity")), PARAMS(), SHOWN,
     .doc = "\\nabla\\times u",
     PF_EXAMPLES({"grad u = (0 3; 1 0)", 2, NULL, (double[]){0, 3, 1, 0}, (double[]){-2}, 1e-15}))
{
    EACH_SPIN (a) {
        const uint32_t p = DIM == 2 ? 0 : (a + 1) % 3, q = DIM == 2 ? 1 : (a + 2) % 3;

        LANES (i)
            vorticity[a][i] = grad_u[q][p][i] - grad_u[p][q][i];
    }
}

TERM(dissipation, PF_FLUID, IN(grad_u, mu),
     OUT(SHOW(dissipation, SCALAR, "W/m^3", "power that viscosity dissipates, per volume"),
         INTEGRAL(dissipated, SCALAR, "W", "power that viscosity dissipates")),
     PARAMS(VISCOSITY), SHOWN, .doc = "2\\mu\\,D(u):D(u)",
     PF_EXAMPLES({"grad u = (0 3; 1 0), mu = 3", 2, (double[]){3}, (double[]){0, 3, 1, 0, 3}, (double[]){48, 48},
                  1e-15}))
{
    LANES (i)
        dissipated[i] = dissipation[i] = F(strain_squared)(b, grad_u[0][0], i) * mu[i];
}

/* --- integrals over the fluid --- */

TERM(kinetic_energy, PF_FLUID, IN(u, rho),
     OUT(INTEGRAL(kinetic_energy, SCALAR, "J", "kinetic energy of the fluid")), PARAMS(DENSITY), SHOWN,
     .doc = "\\frac12\\rho\\,|u|^2",
     PF_EXAMPLES({"u = (3, 4), rho = 2", 2, (double[]){2}, (double[]){3, 4, 2}, (double[]){25}, 1e-15}))
{
    LANES (i) {
        kinetic_energy[i] = 0;
        EACH (a)
            kinetic_energy[i] += 0.5 * rho[i] * u[a][i] * u[a][i];
    }
}

TERM(enstrophy, PF_FLUID, IN(grad_u),
     OUT(INTEGRAL(enstrophy, SCALAR, "m^3/s^2", "half the integral of the vorticity squared")), PARAMS(), SHOWN,
     .doc = "\\frac12\\,|\\nabla\\times u|^2",
     PF_EXAMPLES({"grad u = (0 3; 1 0)", 2, NULL, (double[]){0, 3, 1, 0}, (double[]){2}, 1e-15}))
{
    LANES (i) {
        enstrophy[i] = 0;
        EACH (p)
            for (uint32_t q = p + 1; q < DIM; q++) {
                const NUM w = grad_u[q][p][i] - grad_u[p][q][i];

                enstrophy[i] += 0.5 * w * w;
            }
    }
}

/* --- integrals over boundaries; the normal points out of the domain --- */

/* a . n at lane i */
static inline NUM F(through)(const pf_batch *b, const NUM *vector, uint32_t i)
{
    NUM sum = 0;

    EACH (k)
        sum += AT(vector, k) * AT(b->normal, k);
    return sum;
}

/* The true pressure at lane i: a reduced one is without rho g.x. */
static inline NUM F(true_pressure)(const pf_batch *b, NUM p, double density, const double *gravity, int reduced,
                                   uint32_t i)
{
    for (uint32_t k = 0; reduced && k < DIM; k++)
        p += density * gravity[k] * AT(b->x, k);
    return p;
}

/* Component a of -2 mu D n at lane i */
static inline NUM F(shear)(const pf_batch *b, const NUM *grad_u, NUM mu, uint32_t a, uint32_t i)
{
    NUM sum = 0;

    EACH (k)
        sum -= mu * (AT(grad_u, a, k) + AT(grad_u, k, a)) * AT(b->normal, k);
    return sum;
}

TERM(flow_rate, PF_FACET, IN(u),
     OUT(INTEGRAL(flow_rate, SCALAR, "m^3/s", "volume that flows out through the boundary")), PARAMS(), SHOWN,
     .doc = "u\\cdot n")
{
    LANES (i)
        flow_rate[i] = F(through)(b, u[0], i);
}

TERM(mean_pressure, PF_FACET, IN(p),
     OUT(INTEGRAL(pressure, SCALAR, "N", "integral of the pressure, over the area it is the mean"),
         INTEGRAL(area, SCALAR, "m^2", "area of the boundary")),
     PARAMS(TRUE_PRESSURE), SHOWN, .doc = "p,\\quad 1")
{
    LANES (i) {
        pressure[i] = F(true_pressure)(b, p[i], density, gravity, reduced_pressure, i);
        area[i] = 1;
    }
}

TERM(wall_shear, PF_FACET, IN(grad_u, mu),
     OUT(INTEGRAL(wall_shear, VECTOR, "N", "tangential force of the fluid on the boundary")), PARAMS(VISCOSITY),
     SHOWN, .doc = "-(1-n\\,n^T)\\,2\\mu D(u)\\,n")
{
    LANES (i) {
        NUM normal = 0;

        EACH (a) {
            wall_shear[a][i] = F(shear)(b, grad_u[0][0], mu[i], a, i);
            normal += wall_shear[a][i] * AT(b->normal, a);
        }
        EACH (a)
            wall_shear[a][i] -= normal * AT(b->normal, a);
    }
}

/* -(2 mu D - p) n, of a boundary and of a body */
TERM(wall_force, PF_FACET, IN(grad_u, mu, p),
     OUT(INTEGRAL(wall_force, VECTOR, "N", "force of the fluid on the boundary, by its traction")),
     PARAMS(VISCOSITY, TRUE_PRESSURE), SHOWN, .doc = "-(2\\mu D(u)-p\\,I)\\,n")
{
    LANES (i) {
        const NUM pressure = F(true_pressure)(b, p[i], density, gravity, reduced_pressure, i);

        EACH (a)
            wall_force[a][i] = F(shear)(b, grad_u[0][0], mu[i], a, i) + pressure * AT(b->normal, a);
    }
}

TERM(heat_flux, PF_FACET, IN(grad_T),
     OUT(INTEGRAL(heat_flow, SCALAR, "W", "heat that is conducted out through the boundary")), PARAMS(CONDUCTIVITY),
     SHOWN, .doc = "-k\\,\\nabla T\\cdot n")
{
    LANES (i)
        heat_flow[i] = -conductivity * F(through)(b, grad_T[0], i);
}

/* --- of each body --- */

TERM(surface_force, PF_SURFACE, IN(grad_u, mu, p),
     OUT(INTEGRAL(surface_force, VECTOR, "N", "force of the fluid on the body, by its traction"),
         INTEGRAL(surface_torque, SPIN, "N m", "torque of the fluid on the body, by its traction")),
     PARAMS(VISCOSITY, TRUE_PRESSURE), SHOWN, .doc = "-(2\\mu D(u)-p\\,I)\\,n,\\quad r\\times\\ldots")
{
    LANES (i) {
        const NUM pressure = F(true_pressure)(b, p[i], density, gravity, reduced_pressure, i);

        EACH (a)
            surface_force[a][i] = F(shear)(b, grad_u[0][0], mu[i], a, i) + pressure * AT(b->normal, a);
        EACH_SPIN (a)
            surface_torque[a][i] = F(pf_moment)(b, surface_force[0], a, i);
    }
}

TERM(surface_area, PF_SURFACE, IN(),
     OUT(INTEGRAL(surface_area, SCALAR, "m^2", "surface of the body, as the quadrature sees it")), PARAMS(), SHOWN,
     .doc = "1")
{
    LANES (i)
        surface_area[i] = 1;
}

TERM(covered_volume, PF_SOLID, IN(),
     OUT(INTEGRAL(covered_volume, SCALAR, "m^3", "volume of the body, as the quadrature sees it")), PARAMS(), SHOWN,
     .doc = "1")
{
    LANES (i)
        covered_volume[i] = 1;
}

PLUGIN(show, "quantities of a flow for files and tables; each term by its own line", FIELDS(u, p, T),
       TERMS(shear_rate, vorticity, dissipation, kinetic_energy, enstrophy, flow_rate, mean_pressure, wall_shear,
             wall_force, heat_flux, surface_force, surface_area, covered_volume),
       .author = "plugflow", .license = "GPL-3.0-or-later", .min_minor = 4)
#include PF_TWIN
