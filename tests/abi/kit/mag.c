/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Forces on bodies on term.h: a trap, a magnetic moment in a field, parallel dipoles. */
#include <plugflow/term.h>

#define PF_SHAPE_theta SPIN /* the angle of the moment, an unknown of each body */

/* -F . V,  F = -k (x - x0), per volume of the body: an electrode trap */
TERM(trap, PF_SOLID, IN(), OUT(V),
     PARAMS(REAL(stiffness, "N/m^4", "of the trap", PF_NOT_NEGATIVE), VECTOR(centre, "m", "of the trap")),
     .flags = PF_OPTIONAL | PF_LINEAR, .doc = "k(x-x_0)\\cdot V", .cite = "Ashkin 1970, Phys. Rev. Lett. 24:156")
{
    EACH (a)
        LANES (i)
            V[a][i] = stiffness * (AT(b->x, a) - AT(b->arm, a) - centre[a]);
}

/* (dtheta/dt - omega) eta */
TERM(orientation, PF_SOLID, IN(DOT(theta), omega), OUT(TEST(theta, eta)), PARAMS(),
     .flags = PF_OPTIONAL | PF_LINEAR | PF_ONLY_2D, .doc = "(\\dot\\theta-\\omega)\\eta", .cite = "kinematics")
{
    LANES (i)
        eta[0][i] = theta_t[0][i] - omega[0][i];
}

/* -(m x B) . xi,  m = moment (cos theta, sin theta) */
TERM(torque, PF_SOLID, IN(VALUE(theta)), OUT(xi),
     PARAMS(REAL(moment, "A/m", "magnetic moment per volume"), VECTOR(field, "T", "magnetic field", .dflt = 1)),
     .flags = PF_OPTIONAL | PF_ONLY_2D, .doc = "-m\\times B\\cdot\\xi", .cite = "Jackson 1999, 5.7")
{
    LANES (i)
        xi[0][i] = -moment * (cos(theta[0][i]) * field[1] - sin(theta[0][i]) * field[0]);
}

/* -F . V on the first of two parallel dipoles along e, at distance r along n:
 * F = C/r^4 ((1 - 5 (e.n)^2) n + 2 (e.n) e) */
TERM(dipole, PF_PAIR, IN(), OUT(SLOT(V, U, DEFECT, VECTOR)),
     PARAMS(REAL(strength, "N m^4", "3 mu0 m^2 / 4 pi"), VECTOR(field, "T", "magnetic field", .dflt = 1)),
     .flags = PF_OPTIONAL | PF_LINEAR, .doc = "-F\\cdot V", .cite = "Jackson 1999, 5.7")
{
    LANES (i) {
        const int wall = b->other_density[i] == 0;
        const double r = b->gap[i] + 0.5 * (b->size_of[i] + (wall ? 0 : b->other_size[i])), r4 = r * r * r * r;
        double B2 = 1e-300, Bn = 0;

        EACH (a) {
            B2 += field[a] * field[a];
            Bn += field[a] * AT(b->normal, a);
        }
        EACH (a)
            V[a][i] =
                wall ? 0 : -strength / r4 * ((1 - 5 * Bn * Bn / B2) * AT(b->normal, a) + 2 * Bn * field[a] / B2);
    }
}

PLUGIN(mag, "forces on bodies",
       FIELDS(U, omega, FIELD(theta, "rad", "angle of the moment", .support = PF_ON_PARTICLE)),
       TERMS(trap, orientation, torque, dipole), .author = "plugflow")
#include PF_TWIN
