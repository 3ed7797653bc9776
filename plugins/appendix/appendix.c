/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Particulate flow as the appendix prints it (B.1-B.45): the multiplier lambda lives in all of Omega, is zero
 * in the fluid, and enters the momentum with alpha and mu.  A reference to study the blocks by; read
 * docs/theory.md before computing with it, and use the conservative or the sharp formulation instead.
 * (U, omega) is the motion of the body, r the arm from its centre. */
#include <plugflow/term.h>

#include <plugflow/rigid_motion.h>

#define KEYS                                                                                                       \
    DENSITY, VISCOSITY,                                                                                            \
        REAL(alpha, "kg/m^3/s", "numerical parameter of the multiplier; 0: rho c0/dt", PF_NOT_NEGATIVE), GRAVITY
#define ALPHA (alpha > 0 ? alpha : density * b->shift)

/* -alpha lambda . v - mu grad lambda : grad v  (B.4-B.6, what they add to A.10-A.12) */
TERM(force, PF_CELL, IN(lambda, grad_lambda), OUT(v, grad_v), PARAMS(KEYS), .flags = PF_LINEAR,
     .doc = "-\\alpha\\lambda\\cdot v-\\mu\\nabla\\lambda:\\nabla v", .cite = "appendix B.4-B.9")
{
    LANES (i)
        if (!(ALPHA > 0))
            FAIL(PF_FAIL, "alpha is rho c0/dt unless given, and nothing in a steady case; give it: particulate("
                          "\"appendix\", {alpha = 1e5})");
    EACH (a)
        LANES (i)
            v[a][i] = -ALPHA * lambda[a][i];
    EACH (a)
        EACH (k)
            LANES (i)
                grad_v[a][k][i] = -viscosity * grad_lambda[a][k][i];
}

/* lambda . eta in Omega_f  (B.16-B.18, upper lines) */
TERM(fluid_zero, PF_FLUID, IN(lambda), OUT(eta), PARAMS(KEYS), .flags = PF_LINEAR, .doc = "\\lambda\\cdot\\eta",
     .cite = "appendix B.16-B.19")
{
    EACH (a)
        LANES (i)
            eta[a][i] = lambda[a][i];
}

/* (u - U - omega x r) . eta in Omega_Pk  (B.16-B.18, lower lines) */
TERM(rigid_motion, PF_SOLID, IN(u, U, omega), OUT(eta), PARAMS(KEYS), .flags = PF_LINEAR,
     .doc = "(u-U-\\omega\\times r)\\cdot\\eta", .cite = "appendix B.16-B.18, B.20-B.27")
{
    EACH (a)
        LANES (i)
            eta[a][i] = u[a][i] - U[a][i] - F(pf_turn)(b, omega[0], a, i);
}

/* ((rho_P - rho_f) dU/dt - rho_P g) . V  (B.28-B.30, inertia and weight) */
TERM(translation, PF_SOLID, IN(U_t), OUT(V), PARAMS(KEYS), .flags = PF_LINEAR,
     .doc = "((\\rho_P-\\rho_f)\\dot U-\\rho_Pg)\\cdot V", .cite = "appendix B.28-B.30, B.34")
{
    EACH (a)
        LANES (i)
            V[a][i] = (b->density[i] - density) * U_t[a][i] - b->density[i] * gravity[a];
}

/* (grad p + alpha lambda) . V  (B.28-B.30, what the fluid does) */
TERM(reaction, PF_SOLID, IN(grad_p, lambda), OUT(V), PARAMS(KEYS), .flags = PF_LINEAR | PF_FLUID_FORCE,
     .doc = "(\\nabla p+\\alpha\\lambda)\\cdot V", .cite = "appendix B.28-B.30, B.35-B.38")
{
    EACH (a)
        LANES (i)
            V[a][i] = grad_p[a][i] + ALPHA * lambda[a][i];
}

/* (omega - curl u / 2) . xi  (B.31-B.33) */
TERM(mean_curl, PF_SOLID, IN(grad_u, omega), OUT(xi), PARAMS(KEYS), .flags = PF_LINEAR,
     .doc = "(\\omega-\\frac12\\nabla\\times u)\\cdot\\xi", .cite = "appendix B.31-B.33, B.39-B.45")
{
    EACH_SPIN (a) {
        const uint32_t p = DIM == 2 ? 0 : (a + 1) % 3, q = DIM == 2 ? 1 : (a + 2) % 3;

        LANES (i)
            xi[a][i] = omega[a][i] - 0.5 * (grad_u[q][p][i] - grad_u[p][q][i]);
    }
}

PLUGIN(appendix, "particulate flow as printed: global multiplier with alpha and mu", FIELDS(u, p, lambda, U, omega),
       TERMS(force, fluid_zero, rigid_motion, translation, reaction, mean_curl), .min_minor = 2,
       .author = "plugflow", .license = "GPL-3.0-or-later")
#include PF_TWIN
