/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Momentum balance of an incompressible fluid (appendix A.7-A.15),
 *
 *     rho (du/dt + (u . grad) u) = div(2 mu D(u) - p I) + rho g + f,
 *
 * as integrators that a case can switch singly.  rho and mu are numbers of the case, or what other terms publish.
 */
#include <plugflow/term.h>

#define WEIGHT DENSITY, GRAVITY, REDUCED_PRESSURE

/* rho du/dt . v */
TERM(inertia, PF_CELL, IN(u_t, rho), OUT(v), PARAMS(DENSITY), .flags = PF_LINEAR, .jacobian = inertia_jacobian,
     .doc = "\\rho\\,\\partial_t u\\cdot v", .cite = "appendix A.7-A.15",
     PF_EXAMPLES({"rho = 2, u_t = (1, -2)", 2, NULL, (double[]){1, -2, 2}, (double[]){2, -4}, 1e-15}))
{
    EACH (a)
        LANES (i)
            v[a][i] = rho[i] * u_t[a][i];
}

/* A.13-A.15, first part */
JACOBIAN(inertia, IN(u_t, rho), PARAMS(DENSITY), BLOCKS(BLOCK(v, u_t), BLOCK(v, rho)))
{
    EACH (a)
        LANES (i) {
            dv_du_t[a][a][i] = rho[i];
            dv_drho[a][i] = u_t[a][i];
        }
}

/* rho (u . grad) u . v */
TERM(convection, PF_CELL, IN(u, grad_u, rho), OUT(v), PARAMS(DENSITY), .flags = PF_CONTINUATION,
     .jacobian = convection_jacobian, .doc = "\\rho\\,(u\\cdot\\nabla)u\\cdot v", .cite = "appendix A.7-A.15",
     PF_EXAMPLES({"rho = 2, u = (1, 2), grad u = (3 4; 5 6): rho (1*3 + 2*4, 1*5 + 2*6)", 2, NULL,
                  (double[]){1, 2, 3, 4, 5, 6, 2}, (double[]){22, 34}, 1e-15}))
{
    EACH (a)
        LANES (i) {
            v[a][i] = 0;
            EACH (k)
                v[a][i] += rho[i] * u[k][i] * grad_u[a][k][i];
        }
}

/* A.13-A.15, second part */
JACOBIAN(convection, IN(u, grad_u, rho), PARAMS(DENSITY), BLOCKS(BLOCK(v, u), BLOCK(v, grad_u), BLOCK(v, rho)))
{
    EACH (a)
        EACH (k)
            LANES (i) {
                dv_du[a][k][i] = rho[i] * grad_u[a][k][i];
                dv_dgrad_u[a][a][k][i] = rho[i] * u[k][i];
                dv_drho[a][i] += u[k][i] * grad_u[a][k][i];
            }
}

/* 2 mu D(u) : grad v */
TERM(viscous, PF_CELL, IN(grad_u, mu), OUT(grad_v), PARAMS(VISCOSITY), .flags = PF_LINEAR,
     .jacobian = viscous_jacobian, .doc = "2\\mu D(u):\\nabla v", .cite = "appendix A.7-A.15",
     PF_EXAMPLES({"grad u = (1 2; 4 -1), mu = 3: mu (2 6; 6 -2)", 2, NULL, (double[]){1, 2, 4, -1, 3},
                  (double[]){6, 18, 18, -6}, 1e-15}))
{
    EACH (a)
        EACH (k)
            LANES (i)
                grad_v[a][k][i] = mu[i] * (grad_u[a][k][i] + grad_u[k][a][i]);
}

/* A.13-A.15, last parts */
JACOBIAN(viscous, IN(grad_u, mu), PARAMS(VISCOSITY), BLOCKS(BLOCK(grad_v, grad_u), BLOCK(grad_v, mu)))
{
    EACH (a)
        EACH (k)
            LANES (i) {
                dgrad_v_dgrad_u[a][k][a][k][i] += mu[i];
                dgrad_v_dgrad_u[a][k][k][a][i] += mu[i];
                dgrad_v_dmu[a][k][i] = grad_u[a][k][i] + grad_u[k][a][i];
            }
}

/* -p div v */
TERM(pressure_gradient, PF_CELL, IN(p), OUT(div_v), PARAMS(), .flags = PF_LINEAR,
     .jacobian = pressure_gradient_jacobian, .doc = "-p\\,\\nabla\\cdot v", .cite = "appendix A.7-A.15",
     PF_EXAMPLES({"p = 7", 2, NULL, (double[]){7}, (double[]){-7}, 1e-15}))
{
    LANES (i)
        div_v[i] = -p[i];
}

JACOBIAN(pressure_gradient, IN(p), PARAMS(), BLOCKS(BLOCK(div_v, p)))
{
    LANES (i)
        ddiv_v_dp[i] = -1;
}

/* -(rho g + f) . v; without rho g if p is the reduced pressure.  One point, worked out by hand: rho = 2,
 * g = (0, -10). */
TERM(body_force, PF_CELL, IN(DATA(force, VECTOR), rho), OUT(v), PARAMS(WEIGHT), .flags = PF_LINEAR,
     .doc = "-(\\rho g+f)\\cdot v", .cite = "appendix A.7-A.15",
     PF_EXAMPLES({"rho = 2, f = (1, 5), g = (0, -10)", 2, (double[]){2, 0, -10, 0}, (double[]){1, 5, 2},
                  (double[]){-1, 15}, 1e-15}))
{
    EACH (a)
        LANES (i)
            v[a][i] = -((reduced_pressure ? 0 : rho[i] * gravity[a]) + force[a][i]);
}

/* -t . v on the boundary */
TERM(traction, PF_FACET, IN(DATA(traction, VECTOR)), OUT(v), PARAMS(), .flags = PF_LINEAR | PF_BY_BOUNDARY,
     .doc = "-t\\cdot v", .cite = "appendix A.7-A.15",
     PF_EXAMPLES({"t = (1, 2)", 2, NULL, (double[]){1, 2}, (double[]){-1, -2}, 1e-15}))
{
    EACH (a)
        LANES (i)
            v[a][i] = -traction[a][i];
}

/* (p_b - rho g.x) n . v, the traction -p_b n of a given pressure p_b; without rho g.x unless p is the reduced
 * pressure */
TERM(pressure, PF_FACET, IN(DATA(pressure, SCALAR), rho), OUT(v), PARAMS(WEIGHT),
     .flags = PF_LINEAR | PF_BY_BOUNDARY, .doc = "p_b\\,n\\cdot v",
     .cite = "Heywood, Rannacher and Turek 1996, Int. J. Numer. Methods Fluids 22:325",
     PF_EXAMPLES({"p_b = 10, n = (0.6, -0.8)", 2, (double[]){2, 0, -10, 0}, (double[]){10, 2}, (double[]){6, -8},
                  1e-15}))
{
    EACH (a)
        LANES (i) {
            NUM hydrostatic = 0;

            EACH (k)
                hydrostatic += rho[i] * gravity[k] * AT(b->x, k);
            v[a][i] = (pressure[i] - (reduced_pressure ? hydrostatic : 0)) * AT(b->normal, a);
        }
}

/* -beta/2 rho (u.n)_- u . v, (s)_- = min(s, 0): takes away the energy that fluid coming back through an outflow
 * would bring */
TERM(backflow, PF_FACET, IN(u, DATA(backflow, SCALAR), rho), OUT(v), PARAMS(DENSITY),
     .flags = PF_BY_BOUNDARY | PF_CONTINUATION, .jacobian = backflow_jacobian,
     .doc = "-\\frac\\beta2\\rho\\,(u\\cdot n)_-\\,u\\cdot v",
     .cite = "Bertoglio and Caiazzo 2014, J. Comput. Phys. 261:162; Braack and Mucha 2014, J. Comput. Math. 32:507",
     PF_EXAMPLES({"rho = 2, n = (0.6, -0.8), u = (1, 2) comes in: u.n = -1", 2, NULL, (double[]){1, 2, 1, 2},
                  (double[]){1, 2}, 1e-15},
                 {"u = (2, 0.25) goes out", 2, NULL, (double[]){2, 0.25, 1, 2}, (double[]){0, 0}, 1e-15}))
{
    LANES (i) {
        NUM inward = 0;

        if (creal(backflow[i]) < 0)
            FAIL(PF_FAIL, "backflow is %g; it must not be negative (1 takes all of the energy)",
                 creal(backflow[i]));
        EACH (a)
            inward += u[a][i] * AT(b->normal, a);
        inward = min(inward, 0);
        EACH (a)
            v[a][i] = -0.5 * backflow[i] * rho[i] * inward * u[a][i];
    }
}

/* Nothing where fluid goes out. */
JACOBIAN(backflow, IN(u, DATA(backflow, SCALAR), rho), PARAMS(DENSITY), BLOCKS(BLOCK(v, u), BLOCK(v, rho)))
{
    LANES (i) {
        double inward = 0, c;

        EACH (a)
            inward += u[a][i] * AT(b->normal, a);
        c = inward < 0 ? -0.5 * backflow[i] : 0;
        EACH (a) {
            dv_drho[a][i] = c * inward * u[a][i];
            EACH (k)
                dv_du[a][k][i] = c * rho[i] * (u[a][i] * AT(b->normal, k) + (a == k ? inward : 0));
        }
    }
}

PLUGIN(momentum, "momentum balance of an incompressible fluid", FIELDS(u, p),
       TERMS(inertia, convection, viscous, pressure_gradient, body_force, traction, pressure, backflow),
       .author = "plugflow", .license = "GPL-3.0-or-later", .min_minor = 4)
#include PF_TWIN
