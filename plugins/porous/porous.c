/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Flow through a porous medium and beside it (Brinkman, Forchheimer): momentum loses
 *
 *     mu k u + rho c_F sqrt(k) |u| u,     k = 1/K,
 *
 * where there is a medium of permeability K.  u is the superficial velocity, so that across the edge of a medium
 * flow, velocity and stress are continuous: what slips along it is a result. */
#include <plugflow/term.h>

#define NO_ZERO 1e-150 /* so that fluid may be at rest; above the square of an imaginary part, 1e-200 */

/* Of the fluid there: what a term publishes, or else the number of the case. */
#define MU  SLOT(mu, viscosity, PROPERTY, SCALAR, .unit = "Pa s", .doc = "dynamic viscosity", PF_NOT_NEGATIVE)
#define RHO SLOT(rho, density, PROPERTY, SCALAR, .unit = "kg/m^3", .doc = "mass per volume", PF_NOT_NEGATIVE)

TERM(drag, PF_CELL,
     IN(u, DATA(inverse_permeability, SCALAR, .unit = "1/m^2", .doc = "1/K; 0: free fluid", .min = 0, .max = 1e30),
        MU, RHO),
     OUT(v),
     PARAMS(DENSITY, VISCOSITY,
            REAL(forchheimer, "1", "c_F of the inertial drag; about 0.5 of packed spheres", PF_NOT_NEGATIVE)),
     .flags = PF_CONTINUATION, .doc = "(\\mu K^{-1}+\\rho c_F K^{-1/2}|u|)\\,u\\cdot v",
     .cite =
         "Brinkman 1949, Appl. Sci. Res. A 1:27; Joseph, Nield and Papanicolaou 1982, Water Resour. Res. 18:1049",
     PF_EXAMPLES(
         {"mu = 3, k = 4: 12 u", 2, (double[]){2, 3, 0}, (double[]){1, -2, 4, 3, 2}, (double[]){12, -24}, 1e-15},
         {"and rho = 2, c_F = 0.5, |u| = 5: 12 + 2 0.5 2 5", 2, (double[]){2, 3, 0.5}, (double[]){3, -4, 4, 3, 2},
          (double[]){66, -88}, 1e-15},
         {"free fluid", 3, (double[]){2, 3, 0.5}, (double[]){3, -4, 5, 0, 3, 2}, (double[]){0, 0, 0}, 1e-15}))
{
    LANES (i) {
        const NUM k = inverse_permeability[i];
        NUM square = NO_ZERO;

        if (!(creal(k) >= 0))
            FAIL(PF_FAIL, "inverse_permeability is %g; it must not be negative (0: free fluid)", creal(k));
        EACH (a)
            square += u[a][i] * u[a][i];
        EACH (a)
            v[a][i] = (mu[i] * k + rho[i] * forchheimer * sqrt(k) * sqrt(square)) * u[a][i];
    }
}

PLUGIN(porous, "drag of porous media (Brinkman, Forchheimer)", FIELDS(u), TERMS(drag), .author = "plugflow",
       .license = "GPL-3.0-or-later")
#include PF_TWIN
