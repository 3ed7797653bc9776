/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A plugin outside of the tree whose terms only show: fields and integrals on every kind of points, all of which
 * are known. */
#include <plugflow/term.h>

#define SHOWN .flags = PF_OPTIONAL, .cite = "test_shown.c"

/* |x|^2, and its integral */
TERM(square, PF_CELL, IN(),
     OUT(SHOW(square, SCALAR, "m^2", "distance squared"), INTEGRAL(moment, SCALAR, "m^4", "its integral")),
     PARAMS(), SHOWN, .doc = "|x|^2")
{
    LANES (i) {
        square[i] = 0;
        EACH (a)
            square[i] += AT(b->x, a) * AT(b->x, a);
        moment[i] = square[i];
    }
}

/* du/dt, and what the velocity has grown by since the last step */
TERM(rate, PF_FLUID, IN(u, u_t, old_u),
     OUT(SHOW(acceleration, VECTOR, "m/s^2", "du/dt"), INTEGRAL(total_rate, VECTOR, "m^4/s^2", "integral of du/dt"),
         INTEGRAL(growth, VECTOR, "m^4/s", "of u in a step")),
     PARAMS(), SHOWN, .doc = "\\partial_t u")
{
    EACH (a)
        LANES (i) {
            acceleration[a][i] = total_rate[a][i] = u_t[a][i];
            growth[a][i] = u[a][i] - old_u[a][i];
        }
}

/* Not a number where x > 1/2. */
TERM(logarithm, PF_FACET, IN(), OUT(INTEGRAL(logarithm, SCALAR, "1", "log(1/2 - x)")), PARAMS(), SHOWN,
     .doc = "\\log(1/2-x)")
{
    LANES (i)
        logarithm[i] = log(0.5 - b->x[i]);
}

/* Of a body: what it weighs at its one point, how much of it moves, and how many bodies and walls are near. */
TERM(weight, PF_PARTICLE, IN(), OUT(INTEGRAL(weight, SCALAR, "kg", "mass of the body")), PARAMS(), SHOWN,
     .doc = "m")
{
    LANES (i)
        weight[i] = b->mass[i];
}

TERM(momentum_inside, PF_SOLID, IN(U, omega), OUT(INTEGRAL(momentum, VECTOR, "kg m/s", "of the motion inside")),
     PARAMS(), SHOWN, .doc = "\\rho\\,(U+\\omega\\times r)")
{
    LANES (i) {
        const NUM turn[2] = {-AT(b->arm, 1) * omega[0][i], AT(b->arm, 0) * omega[0][i]};

        EACH (a)
            momentum[a][i] = b->density[i] * (U[a][i] + (a < 2 ? turn[a] : 0));
    }
}

TERM(neighbours, PF_PAIR, IN(), OUT(INTEGRAL(neighbours, SCALAR, "1", "near bodies and walls")), PARAMS(), SHOWN,
     .doc = "1")
{
    LANES (i)
        neighbours[i] = 1;
}

PLUGIN(shown, "known quantities", FIELDS(u, U, omega),
       TERMS(square, rate, logarithm, weight, momentum_inside, neighbours), .author = "plugflow")
#include PF_TWIN
