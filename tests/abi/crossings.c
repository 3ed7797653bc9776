/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Terms where one thing that terms may say meets another: memory and rates, the fluid's force among what is shown,
 * a vector of bodies that is no velocity, a property beside a part of the domain. */
#include <plugflow/term.h>

#define PF_SHAPE_height SCALAR
#define PF_SHAPE_dipole VECTOR

#define KNOWN .flags = PF_OPTIONAL, .cite = "test_crossings.c"

/* Memory: the height of each point. */
TERM(keep, PF_FLUID, IN(STATE(old_height, height, SCALAR)), OUT(STATE(height, height, SCALAR)), PARAMS(), KNOWN,
     .doc = "y")
{
    LANES (i)
        height[i] = AT(b->x, 1);
}

/* (memory - y)^2 */
TERM(lost, PF_FLUID, IN(STATE(kept, height, SCALAR)), OUT(INTEGRAL(lost, SCALAR, "m^4", "what memory has lost")),
     PARAMS(), KNOWN, .doc = "(m-y)^2")
{
    LANES (i)
        lost[i] = (kept[i] - AT(b->x, 1)) * (kept[i] - AT(b->x, 1));
}

TERM(rate, PF_FLUID, IN(u_t), OUT(INTEGRAL(rate, VECTOR, "m^3/s^2", "du/dt")), PARAMS(), KNOWN,
     .doc = "\\partial_t u")
{
    EACH (a)
        LANES (i)
            rate[a][i] = u_t[a][i];
}

TERM(force, PF_PARTICLE, IN(), OUT(INTEGRAL(felt, VECTOR, "N", "force of the fluid")), PARAMS(), KNOWN, .doc = "F")
{
    EACH (a)
        LANES (i)
            felt[a][i] = AT(b->fluid_force, a);
}

/* A column that there is already. */
TERM(clash, PF_SURFACE, IN(), OUT(INTEGRAL(fx, SCALAR, "m", "length of the surface")), PARAMS(), KNOWN, .doc = "1")
{
    LANES (i)
        fx[i] = 1;
}

/* A dipole that goes to (100, 100). */
TERM(relax, PF_PARTICLE, IN(VALUE(dipole), DOT(dipole)), OUT(TEST(dipole, e)), PARAMS(), KNOWN,
     .doc = "(\\dot d+5(d-100))e")
{
    EACH (a)
        LANES (i)
            e[a][i] = dipole_t[a][i] + 5 * (dipole[a][i] - 100);
}

/* A viscosity that is none for x < 1/2, and a stress that takes it where the case says. */
TERM(law, PF_FLUID, IN(), OUT(PROPERTY(viscosity, "Pa s", "viscosity")), PARAMS(), KNOWN, .doc = "x-1/2")
{
    LANES (i)
        viscosity[i] = b->x[i] - 0.5;
}

TERM(part, PF_FLUID, IN(grad_u, mu), OUT(grad_v), PARAMS(VISCOSITY), KNOWN, .doc = "2\\mu D(u):\\nabla v")
{
    EACH (a)
        EACH (k)
            LANES (i)
                grad_v[a][k][i] = mu[i] * (grad_u[a][k][i] + grad_u[k][a][i]);
}

TERM(rest, PF_FLUID, IN(grad_u), OUT(grad_v), PARAMS(), KNOWN, .doc = "2D(u):\\nabla v")
{
    EACH (a)
        EACH (k)
            LANES (i)
                grad_v[a][k][i] = grad_u[a][k][i] + grad_u[k][a][i];
}

PLUGIN(crossings, "where features meet",
       FIELDS(u, FIELD(height, "m", "memory of the height", .support = PF_AT_POINTS),
              FIELD(dipole, "C m", "dipole", .support = PF_ON_PARTICLE)),
       TERMS(keep, lost, rate, force, clash, relax, law, part, rest), .author = "plugflow")
#include PF_TWIN
