/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Rigid motion of the fluid inside bodies, by a Lagrange multiplier lambda on the nodes that they cover
 * (conservative formulation, numerics 4; appendix B.2, B.16-B.18).  Force on the fluid and reaction on the body are
 * the same integral, so what one gives the other takes.  (U, omega) is the motion of the body, r the arm from its
 * centre; alpha = mu/h^2 + rho c0/dt scales lambda and nothing else. */
#include <plugflow/term.h>

#include <plugflow/rigid_motion.h>

#define KEYS                                                                                                       \
    DENSITY, VISCOSITY, REAL(alpha, "kg/m^3/s", "scale of the multiplier; 0: mu/h^2 + rho c0/dt", PF_NOT_NEGATIVE)
#define ALPHA (alpha > 0 ? alpha : viscosity / (b->h[i] * b->h[i]) + density * b->shift)

/* -alpha lambda . v */
TERM(force, PF_SOLID, IN(lambda), OUT(v), PARAMS(KEYS), .flags = PF_LINEAR, .doc = "-\\alpha\\lambda\\cdot v",
     .cite = "appendix B.4-B.9")
{
    EACH (a)
        LANES (i)
            v[a][i] = -ALPHA * lambda[a][i];
}

/* alpha (u - U - omega x r) . eta */
TERM(rigid_motion, PF_SOLID, IN(u, U, omega), OUT(eta), PARAMS(KEYS), .flags = PF_LINEAR,
     .doc = "\\alpha(u-U-\\omega\\times r)\\cdot\\eta", .cite = "appendix B.16-B.27")
{
    EACH (a)
        LANES (i)
            eta[a][i] = ALPHA * (u[a][i] - U[a][i] - F(pf_turn)(b, omega[0], a, i));
}

/* alpha lambda . V + alpha (r x lambda) . xi */
TERM(reaction, PF_SOLID, IN(lambda), OUT(V, xi), PARAMS(KEYS), .flags = PF_LINEAR | PF_FLUID_FORCE,
     .doc = "\\alpha\\lambda\\cdot V+\\alpha(r\\times\\lambda)\\cdot\\xi",
     .cite = "conservative form of appendix B.28-B.35")
{
    EACH (a)
        LANES (i)
            V[a][i] = ALPHA * lambda[a][i];
    EACH_SPIN (a)
        LANES (i)
            xi[a][i] = ALPHA * F(pf_moment)(b, lambda[0], a, i);
}

PLUGIN(multiplier, "rigid motion inside bodies by a Lagrange multiplier",
       FIELDS(u,
              FIELD(lambda, "m/s", "multiplier of the rigid motion", .order = 2, .support = PF_IN_PARTICLES,
                    .constrains = "u"),
              U, omega),
       TERMS(force, rigid_motion, reaction), .min_minor = 1, .author = "plugflow", .license = "GPL-3.0-or-later")
#include PF_TWIN
