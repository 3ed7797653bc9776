/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Newton and Euler for rigid bodies (conservative form of appendix B.28-B.39, numerics 4).  The
 * reaction of the fluid comes from another plugin (multiplier); here are weight and inertia, and the
 * inertia and buoyancy of the fluid that the formulation keeps inside the body.  The pressure is the
 * reduced one, so the fluid itself feels no gravity.  r is the arm from the centre of the body; integrated over it
 * these are its mass and its full inertia,
 *
 *     int rho r x (dw/dt x r) = I dw/dt,      int rho r x (w x (w x r)) = w x I w. */
#include <plugflow/term.h>

#include <plugflow/rigid_motion.h>

#define CITE "conservative form of appendix B.28-B.39"

/* rho_P (dU/dt - g) . V */
TERM(translation, PF_SOLID, IN(U_t), OUT(V), PARAMS(DENSITY, GRAVITY), .flags = PF_LINEAR,
     .doc = "\\rho_P(\\dot U-g)\\cdot V", .cite = CITE)
{
    EACH (a)
        LANES (i)
            V[a][i] = b->density[i] * (U_t[a][i] - gravity[a]);
}

/* r x (w_t x r + w x (w x r)) at lane i; in 2D w x (w x r) is along r and gives nothing */
static inline void F(turning)(const pf_batch *b, const NUM *w_t, const NUM *w, uint32_t i, NUM *m)
{
    const double *r = b->arm;
    NUM a[3], c[3];

    if (b->dim == 2) {
        m[0] = w_t[i] * (r[i] * r[i] + r[LD + i] * r[LD + i]);
        return;
    }
    for (uint32_t k = 0; k < 3; k++)
        c[k] = F(pf_turn)(b, w, k, i);
    for (uint32_t k = 0; k < 3; k++) {
        const uint32_t p = (k + 1) % 3, q = (k + 2) % 3;

        a[k] = F(pf_turn)(b, w_t, k, i) + w[p * LD + i] * c[q] - w[q * LD + i] * c[p];
    }
    for (uint32_t k = 0; k < 3; k++) {
        const uint32_t p = (k + 1) % 3, q = (k + 2) % 3;

        m[k] = r[p * LD + i] * a[q] - r[q * LD + i] * a[p];
    }
}

/* rho_P r x (dw/dt x r + w x (w x r)) . xi */
TERM(rotation, PF_SOLID, IN(omega_t, omega), OUT(xi), PARAMS(DENSITY, GRAVITY),
     .doc = "\\rho_P\\,r\\times(\\dot\\omega\\times r+\\omega\\times(\\omega\\times r))\\cdot\\xi", .cite = CITE)
{
    LANES (i) {
        NUM m[3];

        F(turning)(b, omega_t[0], omega[0], i, m);
        EACH_SPIN (a)
            xi[a][i] = b->density[i] * m[a];
    }
}

/* -rho_f (dU/dt - g) . V - rho_f r x (dw/dt x r + w x (w x r)) . xi: the fluid inside, which moves along */
TERM(displaced, PF_SOLID, IN(U_t, omega_t, omega), OUT(V, xi), PARAMS(DENSITY, GRAVITY), .flags = PF_FLUID_FORCE,
     .doc = "-\\rho_f(\\dot U-g)\\cdot V"
            "-\\rho_f\\,r\\times(\\dot\\omega\\times r+\\omega\\times(\\omega\\times r))\\cdot\\xi",
     .cite = CITE)
{
    EACH (a)
        LANES (i)
            V[a][i] = -density * (U_t[a][i] - gravity[a]);
    LANES (i) {
        NUM m[3];

        F(turning)(b, omega_t[0], omega[0], i, m);
        EACH_SPIN (a)
            xi[a][i] = -density * m[a];
    }
}

/* rho_f g . V: the weight of the fluid displaced, all that is left of it if the fluid inside is none */
TERM(buoyancy, PF_SOLID, IN(), OUT(V), PARAMS(DENSITY, GRAVITY), .flags = PF_LINEAR | PF_OPTIONAL | PF_FLUID_FORCE,
     .doc = "\\rho_fg\\cdot V", .cite = CITE)
{
    EACH (a)
        LANES (i)
            V[a][i] = density * gravity[a];
}

PLUGIN(rigid_body, "translation and rotation of rigid bodies", FIELDS(U, omega),
       TERMS(translation, rotation, displaced, buoyancy), .min_minor = 1, .author = "plugflow",
       .license = "GPL-3.0-or-later")
#include PF_TWIN
