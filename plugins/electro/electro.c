/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Charged and polarised bodies, by the public interface alone: a field that drives charges and turns dipoles,
 * forces between charges and between dipoles, a trap.  Charges and moments are keys of the bodies,
 *
 *     particle { charge = 3, moment = {0.1, 0} }        the moment in the body's own axes.
 *
 * In 2D charges and dipoles are lines out of the plane, and everything is per length.  V and xi are the test
 * functions of velocity and angular velocity: the power of a force F is F . V, and what drives stands with a minus.
 */
#include <plugflow/term.h>

#define CHARGE   .unit = "C", .doc = "charge of the body"
#define MOMENT   .unit = "C m", .doc = "dipole moment in the body's axes"
#define CONSTANT REAL(constant, "N m^2/C^2", "1/(4 pi epsilon) of the fluid", .flags = PF_REQUIRED, PF_NOT_NEGATIVE)
#define SCREENED_KEYS                                                                                              \
    CONSTANT, REAL(length, "m", "over which charges are screened", .flags = PF_REQUIRED, .min = 1e-300, .max = 1e30)
#define ONE_BY_ONE .flags = PF_LINEAR | PF_OPTIONAL

TERM(force, PF_PARTICLE, IN(SLOT(q, charge, BODY_KEY, SCALAR, CHARGE), DATA(field, VECTOR)), OUT(V), PARAMS(),
     .flags = PF_LINEAR, .doc = "-q\\,E\\cdot V", .cite = "Jackson 1999, Classical Electrodynamics, (1.2)")
{
    EACH (a)
        LANES (i)
            V[a][i] = -q[i] * field[a][i];
}

/* m in the axes of space, from that in the body's: sum_k axes_ak m_k. */
static inline void F(turn)(const pf_batch *b, const double *axes, const NUM *moment, uint32_t i, NUM *m)
{
    m[2] = 0;
    EACH (a) {
        m[a] = 0;
        EACH (k)
            m[a] += AT(axes, a, k) * AT(moment, k);
    }
}

/* out = -m x E, in 2D its third component */
static inline void F(put_torque)(const pf_batch *b, const NUM *m, const NUM *E, uint32_t i, NUM *out)
{
    EACH_SPIN (a) {
        const uint32_t p = DIM == 2 ? 0 : (a + 1) % 3, q = DIM == 2 ? 1 : (a + 2) % 3;

        AT(out, a) = -(m[p] * E[q] - m[q] * E[p]);
    }
}

TERM(torque, PF_PARTICLE, IN(SLOT(m, moment, BODY_KEY, VECTOR, MOMENT), DATA(field, VECTOR)), OUT(xi), PARAMS(),
     ONE_BY_ONE, .doc = "-(m\\times E)\\cdot\\xi", .cite = "Jackson 1999, Classical Electrodynamics, ch. 4")
{
    LANES (i) {
        NUM turned[3], E[3] = {0};

        F(turn)(b, b->axes, m[0], i, turned);
        EACH (a)
            E[a] = field[a][i];
        F(put_torque)(b, turned, E, i, xi[0]);
    }
}

/* n = r / |r|, r from the centre of the other to that of the first; returns |r|, of a wall 1. */
static inline double F(between)(const pf_batch *b, uint32_t i, double *n)
{
    double r = 0;

    n[2] = 0;
    EACH (a) {
        n[a] = AT(b->centre, a) - AT(b->other_centre, a);
        r += n[a] * n[a];
    }
    r = b->other_id[i] < 0 ? 1 : sqrt(r);
    EACH (a)
        n[a] /= r;
    return r;
}

/* -F n . (V1 - V2):  F = k q1 q2 / r^2,  in 2D 2 k q1 q2 / r.  It has no end. */
TERM(coulomb, PF_PAIR,
     IN(SLOT(q, charge, BODY_KEY, SCALAR, CHARGE), SLOT(other_q, charge, OTHER_KEY, SCALAR, CHARGE)),
     OUT(SLOT(V, U, DEFECT, VECTOR)), PARAMS(CONSTANT), ONE_BY_ONE, .reach = coulomb_reach,
     .doc = "-k\\,q_1q_2\\,\\frac{n}{r^2}\\cdot(V_1-V_2)", .cite = "Jackson 1999, Classical Electrodynamics, (1.2)")
{
    LANES (i) {
        double n[3], r = F(between)(b, i, n);
        const NUM F = constant * q[i] * other_q[i] / r;

        EACH (a)
            V[a][i] = -F * (DIM == 2 ? 2 : 1 / r) * n[a];
    }
}

REACH(coulomb, PARAMS(CONSTANT))
{
    return INFINITY;
}

/* -F n . (V1 - V2):  F = k q1 q2 (1/r^2 + 1/(l r)) exp(-r/l), of the potential k q1 q2 exp(-r/l) / r */
TERM(screened, PF_PAIR,
     IN(SLOT(q, charge, BODY_KEY, SCALAR, CHARGE), SLOT(other_q, charge, OTHER_KEY, SCALAR, CHARGE)),
     OUT(SLOT(V, U, DEFECT, VECTOR)), PARAMS(SCREENED_KEYS), .flags = PF_LINEAR | PF_OPTIONAL | PF_ONLY_3D,
     .reach = screened_reach,
     .doc = "-k\\,q_1q_2\\left(\\frac1r+\\frac1\\ell\\right)\\frac{e^{-r/\\ell}}r\\,n\\cdot(V_1-V_2)",
     .cite = "Debye and Hueckel 1923, Phys. Z. 24:185")
{
    LANES (i) {
        double n[3], r = F(between)(b, i, n);
        const NUM F = constant * q[i] * other_q[i] * (1 / r + 1 / length) / r * exp(-r / length);

        EACH (a)
            V[a][i] = -F * n[a];
    }
}

REACH(screened, PARAMS(SCREENED_KEYS))
{
    return INFINITY;
}

/* Field of a dipole m at the place r n:  E = k (3 n (n.m) - m) / r^3,  in 2D 2 k (2 n (n.m) - m) / r^2 */
static inline void F(field_of)(uint32_t dim, double k, double r, const double *n, const NUM *m, NUM *E)
{
    const NUM along = n[0] * m[0] + n[1] * m[1] + n[2] * m[2];

    for (int a = 0; a < 3; a++)
        E[a] = dim == 2 ? 2 * k * (2 * n[a] * along - m[a]) / (r * r) : k * (3 * n[a] * along - m[a]) / (r * r * r);
}

/* -F . (V1 - V2) - (m1 x E2) . xi1 - (m2 x E1) . xi2:  each turns in the other's field; their torques are no pair
 * of action and reaction, the force makes up for it.  F = grad (m1 . E2) is, with s = 5, c = 3 k / r^4 (in 2D 4, 4
 * k / r^3),
 *
 *     F = c ((n.m2) m1 + (n.m1) m2 + (m1.m2) n - s (n.m1) (n.m2) n) */
TERM(dipoles, PF_PAIR,
     IN(SLOT(m, moment, BODY_KEY, VECTOR, MOMENT), SLOT(other_m, moment, OTHER_KEY, VECTOR, MOMENT)),
     OUT(SLOT(V, U, DEFECT, VECTOR), xi, SLOT(other_xi, omega, OTHER, SPIN)), PARAMS(CONSTANT), ONE_BY_ONE,
     .reach = dipoles_reach, .doc = "-F\\cdot(V_1-V_2)-(m_1\\times E_2)\\cdot\\xi_1-(m_2\\times E_1)\\cdot\\xi_2",
     .cite = "Jackson 1999, Classical Electrodynamics, (4.13)")
{
    LANES (i) {
        double n[3], r = F(between)(b, i, n);
        const double c = constant * (DIM == 2 ? 4 / (r * r * r) : 3 / (r * r * r * r)), s = DIM == 2 ? 4 : 5;
        NUM m1[3], m2[3], E1[3], E2[3], n1 = 0, n2 = 0, both = 0;

        F(turn)(b, b->axes, m[0], i, m1);
        F(turn)(b, b->other_axes, other_m[0], i, m2);
        EACH (a) {
            n1 += n[a] * m1[a];
            n2 += n[a] * m2[a];
            both += m1[a] * m2[a];
        }
        EACH (a)
            V[a][i] = -c * (n2 * m1[a] + n1 * m2[a] + (both - s * n1 * n2) * n[a]);
        F(field_of)(DIM, constant, r, n, m1, E1);
        F(field_of)(DIM, constant, r, n, m2, E2);
        F(put_torque)(b, m1, E2, i, xi[0]);
        F(put_torque)(b, m2, E1, i, other_xi[0]);
    }
}

REACH(dipoles, PARAMS(CONSTANT))
{
    return INFINITY;
}

/* k (x - x0) . V */
TERM(trap, PF_PARTICLE, IN(), OUT(V),
     PARAMS(REAL(stiffness, "N/m", "of the trap", .flags = PF_REQUIRED, PF_NOT_NEGATIVE),
            VECTOR(centre, "m", "of the trap", .flags = PF_REQUIRED)),
     ONE_BY_ONE, .doc = "k\\,(x-x_0)\\cdot V", .cite = "Ashkin 1986, Opt. Lett. 11:288")
{
    EACH (a)
        LANES (i)
            V[a][i] = stiffness * (AT(b->centre, a) - centre[a]);
}

PLUGIN(electro, "charged and polarised bodies in a field and near each other", FIELDS(U, omega),
       TERMS(force, torque, coulomb, screened, dipoles, trap), .author = "plugflow", .license = "GPL-3.0-or-later",
       .min_minor = 4)
#include PF_TWIN
