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
#include <plugflow/fluid.h>

#include <math.h>

struct electro {
    double constant, length;     /* 1/(4 pi epsilon); of screening, m */
    double stiffness, centre[3]; /* of the trap                       */
};

#define LD     (b->ld)
#define LANES  for (uint32_t i = 0; i < b->n; i++)
#define POINTS PF_TERM_SIZES, .flags = PF_LINEAR | PF_OPTIONAL

/* -q E . V */
static int force(const pf_batch *b, const double *const *in, double *const *out)
{
    for (uint32_t a = 0; a < b->dim; a++)
        LANES
            out[0][a * LD + i] = -in[0][i] * in[1][a * LD + i];
    return PF_OK;
}

/* m in the axes of space, from that in the body's: sum_k axes_ak m_k. */
static void turn(const pf_batch *b, const double *axes, const double *moment, uint32_t i, double m[3])
{
    m[2] = 0;
    for (uint32_t a = 0; a < b->dim; a++) {
        m[a] = 0;
        for (uint32_t k = 0; k < b->dim; k++)
            m[a] += axes[(a * b->dim + k) * LD + i] * moment[k * LD + i];
    }
}

/* out = -m x E, in 2D its third component */
static void put_torque(const pf_batch *b, const double m[3], const double E[3], uint32_t i, double *out)
{
    for (uint32_t a = 0; a < 3; a++) {
        const uint32_t p = (a + 1) % 3, q = (a + 2) % 3;

        if (b->dim == 3 || a == 2)
            out[(b->dim == 3 ? a : 0) * LD + i] = -(m[p] * E[q] - m[q] * E[p]);
    }
}

/* -(m x E) . xi */
static int torque(const pf_batch *b, const double *const *in, double *const *out)
{
    LANES {
        double m[3], E[3] = {0};

        turn(b, b->axes, in[0], i, m);
        for (uint32_t a = 0; a < b->dim; a++)
            E[a] = in[1][a * LD + i];
        put_torque(b, m, E, i, out[0]);
    }
    return PF_OK;
}

/* n = r / |r|, r from the centre of the other to that of the first; returns |r|, of a wall 1. */
static double between(const pf_batch *b, uint32_t i, double n[3])
{
    double r = 0;

    n[2] = 0;
    for (uint32_t a = 0; a < b->dim; a++) {
        n[a] = b->centre[a * LD + i] - b->other_centre[a * LD + i];
        r += n[a] * n[a];
    }
    r = b->other_id[i] < 0 ? 1 : sqrt(r);
    for (uint32_t a = 0; a < b->dim; a++)
        n[a] /= r;
    return r;
}

/* -F n . (V1 - V2):  F = k q1 q2 / r^2,  in 2D 2 k q1 q2 / r */
static int coulomb(const pf_batch *b, const double *const *in, double *const *out)
{
    const struct electro *e = b->params;

    LANES {
        double n[3], r = between(b, i, n), F = e->constant * in[0][i] * in[1][i] / r;

        for (uint32_t a = 0; a < b->dim; a++)
            out[0][a * LD + i] = -F * (b->dim == 2 ? 2 : 1 / r) * n[a];
    }
    return PF_OK;
}

/* -F n . (V1 - V2):  F = k q1 q2 (1/r^2 + 1/(l r)) exp(-r/l), of the potential k q1 q2 exp(-r/l) / r */
static int screened(const pf_batch *b, const double *const *in, double *const *out)
{
    const struct electro *e = b->params;

    LANES {
        double n[3], r = between(b, i, n);
        double F = e->constant * in[0][i] * in[1][i] * (1 / r + 1 / e->length) / r * exp(-r / e->length);

        for (uint32_t a = 0; a < b->dim; a++)
            out[0][a * LD + i] = -F * n[a];
    }
    return PF_OK;
}

/* Field of a dipole m at the place r n:  E = k (3 n (n.m) - m) / r^3,  in 2D 2 k (2 n (n.m) - m) / r^2 */
static void field_of(uint32_t dim, double k, double r, const double n[3], const double m[3], double E[3])
{
    const double along = n[0] * m[0] + n[1] * m[1] + n[2] * m[2];

    for (int a = 0; a < 3; a++)
        E[a] = dim == 2 ? 2 * k * (2 * n[a] * along - m[a]) / (r * r) : k * (3 * n[a] * along - m[a]) / (r * r * r);
}

/* -F . (V1 - V2) - (m1 x E2) . xi1 - (m2 x E1) . xi2:  each turns in the other's field; their torques are no pair
 * of action and reaction, the force makes up for it.  F = grad (m1 . E2) is, with s = 5, c = 3 k / r^4 (in 2D 4, 4
 * k / r^3),
 *
 *     F = c ((n.m2) m1 + (n.m1) m2 + (m1.m2) n - s (n.m1) (n.m2) n) */
static int dipoles(const pf_batch *b, const double *const *in, double *const *out)
{
    const struct electro *e = b->params;
    const int plane = b->dim == 2;

    LANES {
        double n[3], m1[3], m2[3], E1[3], E2[3], n1 = 0, n2 = 0, both = 0;
        const double r = between(b, i, n), c = e->constant * (plane ? 4 / (r * r * r) : 3 / (r * r * r * r));

        turn(b, b->axes, in[0], i, m1);
        turn(b, b->other_axes, in[1], i, m2);
        for (int a = 0; a < 3; a++) {
            n1 += n[a] * m1[a];
            n2 += n[a] * m2[a];
            both += m1[a] * m2[a];
        }
        for (uint32_t a = 0; a < b->dim; a++)
            out[0][a * LD + i] = -c * (n2 * m1[a] + n1 * m2[a] + (both - (plane ? 4 : 5) * n1 * n2) * n[a]);
        field_of(b->dim, e->constant, r, n, m1, E1);
        field_of(b->dim, e->constant, r, n, m2, E2);
        put_torque(b, m1, E2, i, out[1]);
        put_torque(b, m2, E1, i, out[2]);
    }
    return PF_OK;
}

/* k (x - x0) . V */
static int trap(const pf_batch *b, const double *const *in, double *const *out)
{
    const struct electro *e = b->params;

    (void)in;
    for (uint32_t a = 0; a < b->dim; a++)
        LANES
            out[0][a * LD + i] = e->stiffness * (b->centre[a * LD + i] - e->centre[a]);
    return PF_OK;
}

/* Coulomb's force has no end. */
static double everywhere(const void *params, double size, double h)
{
    (void)params, (void)size, (void)h;
    return INFINITY;
}

#define CHARGE(NAME, EVAL)                                                                                         \
    {                                                                                                              \
        NAME, "charge", EVAL, PF_SCALAR, .unit = "C", .doc = "charge of the body"                                  \
    }
#define MOMENT(NAME, EVAL)                                                                                         \
    {                                                                                                              \
        NAME, "moment", EVAL, PF_VECTOR, .unit = "C m", .doc = "dipole moment in the body's axes"                  \
    }
#define CONSTANT                                                                                                   \
    PF_NUMBER(struct electro, constant, "N m^2/C^2", "1/(4 pi epsilon) of the fluid", .flags = PF_REQUIRED,        \
              PF_NOT_NEGATIVE)

static const pf_term force_term = {
    PF_TERM_SIZES,
    .name = "force",
    .residual = force,
    .where = PF_PARTICLE,
    .flags = PF_LINEAR,
    .doc = "-q\\,E\\cdot V",
    .cite = "Jackson 1999, Classical Electrodynamics, (1.2)",
    PF_IN(CHARGE("q", PF_BODY_KEY), {"field", NULL, PF_DATA, PF_VECTOR}),
    PF_OUT({"V", "U", PF_VALUE, PF_VECTOR}),
};

static const pf_term torque_term = {
    POINTS,
    .name = "torque",
    .residual = torque,
    .where = PF_PARTICLE,
    .doc = "-(m\\times E)\\cdot\\xi",
    .cite = "Jackson 1999, Classical Electrodynamics, ch. 4",
    PF_IN(MOMENT("m", PF_BODY_KEY), {"field", NULL, PF_DATA, PF_VECTOR}),
    PF_OUT({"xi", "omega", PF_VALUE, PF_SPIN}),
};

static const pf_term coulomb_term = {
    POINTS,
    .name = "coulomb",
    .residual = coulomb,
    .where = PF_PAIR,
    .doc = "-k\\,q_1q_2\\,\\frac{n}{r^2}\\cdot(V_1-V_2)",
    .cite = "Jackson 1999, Classical Electrodynamics, (1.2)",
    PF_IN(CHARGE("q", PF_BODY_KEY), CHARGE("other_q", PF_OTHER_KEY)),
    PF_OUT({"V", "U", PF_DEFECT, PF_VECTOR}),
    PF_PARAMS(struct electro, CONSTANT),
    .reach = everywhere,
};

static const pf_term screened_term = {
    PF_TERM_SIZES,
    .name = "screened",
    .residual = screened,
    .where = PF_PAIR,
    .flags = PF_LINEAR | PF_OPTIONAL | PF_ONLY_3D,
    .doc = "-k\\,q_1q_2\\left(\\frac1r+\\frac1\\ell\\right)\\frac{e^{-r/\\ell}}r\\,n\\cdot(V_1-V_2)",
    .cite = "Debye and Hueckel 1923, Phys. Z. 24:185",
    PF_IN(CHARGE("q", PF_BODY_KEY), CHARGE("other_q", PF_OTHER_KEY)),
    PF_OUT({"V", "U", PF_DEFECT, PF_VECTOR}),
    PF_PARAMS(struct electro, CONSTANT,
              PF_NUMBER(struct electro, length, "m", "over which charges are screened", .flags = PF_REQUIRED,
                        .min = 1e-300, .max = 1e30)),
    .reach = everywhere,
};

static const pf_term dipoles_term = {
    POINTS,
    .name = "dipoles",
    .residual = dipoles,
    .where = PF_PAIR,
    .doc = "-F\\cdot(V_1-V_2)-(m_1\\times E_2)\\cdot\\xi_1-(m_2\\times E_1)\\cdot\\xi_2",
    .cite = "Jackson 1999, Classical Electrodynamics, (4.13)",
    PF_IN(MOMENT("m", PF_BODY_KEY), MOMENT("other_m", PF_OTHER_KEY)),
    PF_OUT({"V", "U", PF_DEFECT, PF_VECTOR}, {"xi", "omega", PF_VALUE, PF_SPIN},
           {"other_xi", "omega", PF_OTHER, PF_SPIN}),
    PF_PARAMS(struct electro, CONSTANT),
    .reach = everywhere,
};

static const pf_term trap_term = {
    POINTS,
    .name = "trap",
    .residual = trap,
    .where = PF_PARTICLE,
    .doc = "k\\,(x-x_0)\\cdot V",
    .cite = "Ashkin 1986, Opt. Lett. 11:288",
    PF_OUT({"V", "U", PF_VALUE, PF_VECTOR}),
    PF_PARAMS(struct electro,
              PF_NUMBER(struct electro, stiffness, "N/m", "of the trap", .flags = PF_REQUIRED, PF_NOT_NEGATIVE),
              {.name = "centre",
               .unit = "m",
               .doc = "of the trap",
               .type = PF_T_VECTOR,
               .flags = PF_REQUIRED,
               .offset = offsetof(struct electro, centre)}),
};

static const pf_plugin electro = {
    PF_PLUGIN,
    .min_minor = 4,
    .name = "electro",
    .version = "1.0",
    .author = "plugflow",
    .license = "GPL-3.0-or-later",
    .doc = "charged and polarised bodies in a field and near each other",
    PF_FIELDS(PF_FIELD_BODY_VELOCITY(), PF_FIELD_BODY_SPIN),
    PF_TERMS(&force_term, &torque_term, &coulomb_term, &screened_term, &dipoles_term, &trap_term),
};
PF_ENTRY(electro)
