/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Laws for test_properties: a viscosity that another law's property goes into, and some that cannot be. */
#include <plugflow/term.h>

#define PF_SLOT_cP       SCALAR, cP, "viscosity", PF_PROPERTY, .unit = "cP", .doc = "dynamic viscosity"
#define PF_SLOT_thinning SCALAR, thinning, "thinning", PF_PROPERTY, .unit = "1", .doc = "part that shear leaves"
#define PF_SLOT_a        SCALAR, a, "a", PF_PROPERTY, .unit = "1", .doc = "a"
#define PF_SLOT_b        SCALAR, b_, "b", PF_PROPERTY, .unit = "1", .doc = "b"
#define ALONE            .flags = PF_OPTIONAL, .doc = "\\mu", .cite = "none"

/* 1 / sqrt(1 + |grad u|^2) */
TERM(thins, PF_FLUID, IN(grad_u), OUT(thinning), PARAMS(), ALONE)
{
    LANES (i) {
        NUM square = 1;

        EACH (a)
            EACH (k)
                square += grad_u[a][k][i] * grad_u[a][k][i];
        thinning[i] = 1 / sqrt(square);
    }
}

/* 0.5 + thinning^2 + |u|^2 + p^2/10: on an unknown of its own beside those behind the property */
TERM(chained, PF_FLUID, IN(u, p, thinning), OUT(mu), PARAMS(), ALONE)
{
    LANES (i) {
        mu[i] = 0.5 + thinning[i] * thinning[i] + 0.1 * p[i] * p[i];
        EACH (a)
            mu[i] += u[a][i] * u[a][i];
    }
}

TERM(negative, PF_FLUID, IN(u), OUT(mu), PARAMS(), ALONE)
{
    LANES (i)
        mu[i] = 0.5 - b->x[i] + 0 * u[0][i];
}

TERM(infinite, PF_FLUID, IN(u), OUT(mu), PARAMS(), ALONE)
{
    LANES (i)
        mu[i] = 1 / (0 * u[0][i]);
}

TERM(even, PF_FLUID, IN(), OUT(mu), PARAMS(), ALONE)
{
    LANES (i)
        mu[i] = 0.1;
}

TERM(centipoise, PF_FLUID, IN(), OUT(cP), PARAMS(), ALONE)
{
    LANES (i)
        cP[i] = 100;
}

TERM(a_of_b, PF_FLUID, IN(b), OUT(a), PARAMS(), ALONE)
{
    LANES (i)
        a[i] = b_[i];
}

TERM(b_of_a, PF_FLUID, IN(a), OUT(b), PARAMS(), ALONE)
{
    LANES (i)
        b_[i] = a[i];
}

PLUGIN(laws, "laws of viscosity for tests", FIELDS(u, p),
       TERMS(thins, chained, negative, infinite, even, centipoise, a_of_b, b_of_a), .license = "GPL-3.0-or-later")
#include PF_TWIN
