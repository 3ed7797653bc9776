/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Terms that bring their own: a viscosity, a stress on bodies, a field without a tie, data that must be given. */
#include <plugflow/term.h>

#define ALONE .flags = PF_OPTIONAL, .doc = "none", .cite = "none"
#define VISCOSITY_OF_MY_OWN                                                                                        \
    {                                                                                                              \
        EACH (a)                                                                                                   \
            EACH (k)                                                                                               \
                LANES (i)                                                                                          \
                    grad_v[a][k][i] = eta * (grad_u[a][k][i] + grad_u[k][a][i]);                                   \
    }
#define ETA REAL(eta, "Pa s", "viscosity", .dflt = 1, .min = 0.1, .max = 10)

TERM(stress, PF_FLUID, IN(grad_u), OUT(grad_v), PARAMS(ETA), .replaces = "momentum.viscous", ALONE)
VISCOSITY_OF_MY_OWN
TERM(misspelt, PF_FLUID, IN(grad_u), OUT(grad_v), PARAMS(ETA), .replaces = "momentun.viscous", ALONE)
VISCOSITY_OF_MY_OWN
TERM(unknown, PF_FLUID, IN(grad_u), OUT(grad_v), PARAMS(ETA), .replaces = "somebody_elses_work.viscous", ALONE)
VISCOSITY_OF_MY_OWN

/* The same, of the fluid's viscosity. */
TERM(shares, PF_FLUID, IN(grad_u, mu), OUT(grad_v), PARAMS(VISCOSITY), .replaces = "momentum.viscous", ALONE)
{
    EACH (a)
        EACH (k)
            LANES (i)
                grad_v[a][k][i] = mu[i] * (grad_u[a][k][i] + grad_u[k][a][i]);
}

TERM(skin, PF_SURFACE, IN(p), OUT(v, V), PARAMS(), ALONE)
{
    EACH (a)
        LANES (i)
            V[a][i] = -(v[a][i] = 0.1 * p[i] * AT(b->normal, a));
}
TERM(counted, PF_SURFACE, IN(p), OUT(v, V), PARAMS(), .flags = PF_OPTIONAL | PF_FLUID_FORCE, .doc = "none",
     .cite = "none")
{
    EACH (a)
        LANES (i)
            V[a][i] = -(v[a][i] = 0.1 * p[i] * AT(b->normal, a));
}

TERM(dye, PF_FLUID, IN(GRAD(c)), OUT(GRAD_TEST(c, s)), PARAMS(), ALONE)
{
    EACH (a)
        LANES (i)
            grad_s[a][i] = grad_c[a][i];
}
TERM(tie, PF_CUT, IN(SLOT(dc, c, DEFECT, SCALAR)), OUT(SLOT(ds, c, DEFECT, SCALAR)), PARAMS(), ALONE)
{
    LANES (i)
        ds[i] = dc[i];
}

TERM(source, PF_FLUID, IN(DATA(dye_source, SCALAR, .unit = "1/s", .doc = "dye that comes", .flags = PF_REQUIRED)),
     OUT(TEST(c, s)), PARAMS(), ALONE)
{
    LANES (i)
        s[i] = -dye_source[i];
}
TERM(sink, PF_FLUID, IN(DATA(dye_sink, SCALAR)), OUT(TEST(c, s)), PARAMS(), ALONE)
{
    LANES (i)
        s[i] = dye_sink[i];
}

PLUGIN(own, "terms that bring their own", FIELDS(u, p, U, FIELD(c, "1", "dye", .order = 2)),
       TERMS(stress, misspelt, unknown, shares, skin, counted, dye, tie, source, sink), .author = "plugflow")
#include PF_TWIN
