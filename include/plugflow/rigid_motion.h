/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * rigid_motion.h -- how the points of a rigid body move, for equations on PF_SOLID and PF_SURFACE.  Include it
 * after term.h (or a twin, twin_real.h): it is compiled for real numbers and for complex ones.
 *
 * r: the batch's arm, from the body's centre.  Spins have one component in 2D, out of the plane, three in 3D. */

/* Component a of omega x r in lane i. */
static inline NUM F(pf_turn)(const pf_batch *b, const NUM *omega, uint32_t a, uint32_t i)
{
    const double *r = b->arm;
    const uint32_t p = (a + 1) % 3, q = (a + 2) % 3;

    if (b->dim == 2)
        return a == 0 ? -omega[i] * r[LD + i] : omega[i] * r[i];
    return omega[p * LD + i] * r[q * LD + i] - omega[q * LD + i] * r[p * LD + i];
}

/* Component a of r x f in lane i, f a vector [dim][ld]; in 2D the only one, a = 0. */
static inline NUM F(pf_moment)(const pf_batch *b, const NUM *f, uint32_t a, uint32_t i)
{
    const double *r = b->arm;
    const uint32_t p = b->dim == 2 ? 0 : (a + 1) % 3, q = b->dim == 2 ? 1 : (a + 2) % 3;

    return r[p * LD + i] * f[q * LD + i] - r[q * LD + i] * f[p * LD + i];
}
