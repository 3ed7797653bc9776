/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Magnets in a plane, lines of dipoles: each has a moment of its own, in its own axes, and turns in the other's
 * field.  Per length, with n from the other to the first, s = strength / r^2,
 *
 *     T1 = m1 x B2,   B2 = s (2 n (n.m2) - m2),
 *     F1 = 2 s / r ((n.m2) m1 + (n.m1) m2 + (m1.m2) n - 4 (n.m1)(n.m2) n) */
#include <plugflow/fluid.h>

#include <math.h>

struct magnets {
    double strength;
};

static int pair(const pf_batch *b, const double *const *in, double *const *out)
{
    const struct magnets *p = b->params;
    const size_t ld = b->ld;

    for (uint32_t i = 0; i < b->n; i++) {
        const double *A = b->axes + i, *O = b->other_axes + i; /* row-major, [4][ld] */
        const double m[2] = {A[0] * in[0][i] + A[ld] * in[0][ld + i],
                             A[2 * ld] * in[0][i] + A[3 * ld] * in[0][ld + i]};
        const double o[2] = {O[0] * in[1][i] + O[ld] * in[1][ld + i],
                             O[2 * ld] * in[1][i] + O[3 * ld] * in[1][ld + i]};
        const double d[2] = {b->centre[i] - b->other_centre[i], b->centre[ld + i] - b->other_centre[ld + i]};
        const double r = b->other_id[i] < 0 ? 1 : hypot(d[0], d[1]), n[2] = {d[0] / r, d[1] / r},
                     s = p->strength / (r * r);
        const double nm = n[0] * m[0] + n[1] * m[1], no = n[0] * o[0] + n[1] * o[1], mo = m[0] * o[0] + m[1] * o[1];

        for (int a = 0; a < 2; a++)
            out[0][a * ld + i] = -2 * s / r * (no * m[a] + nm * o[a] + (mo - 4 * nm * no) * n[a]);
        out[1][i] = -s * (m[0] * (2 * n[1] * no - o[1]) - m[1] * (2 * n[0] * no - o[0]));
        out[2][i] = -s * (o[0] * (2 * n[1] * nm - m[1]) - o[1] * (2 * n[0] * nm - m[0]));
    }
    return PF_OK;
}

static double everywhere(const void *params, double size, double h)
{
    (void)params, (void)size, (void)h;
    return INFINITY;
}

static const pf_term pairs = {
    PF_TERM_SIZES,
    .name = "pair",
    .residual = pair,
    .where = PF_PAIR,
    .flags = PF_LINEAR | PF_ONLY_2D,
    .doc = "-F\\cdot(V_1-V_2)-T_1\\xi_1-T_2\\xi_2",
    .cite = "Jackson 1999, (5.56), of lines",
    .reach = everywhere,
    PF_IN({"m", "moment", PF_BODY_KEY, PF_VECTOR, "A m", "magnetic moment in the body's axes", .min = -5, .max = 5},
          {"other_m", "moment", PF_OTHER_KEY, PF_VECTOR}),
    PF_OUT({"V", "U", PF_DEFECT, PF_VECTOR}, {"xi", "omega", PF_VALUE, PF_SPIN},
           {"other_xi", "omega", PF_OTHER, PF_SPIN}),
    PF_PARAMS(struct magnets, PF_NUMBER(struct magnets, strength, "N/A^2", "mu / (2 pi)", .dflt = 0.1))};
static const pf_plugin magnets = {PF_PLUGIN,
                                  .min_minor = 4,
                                  .name = "magnets",
                                  .version = "1.0",
                                  .license = "GPL-3.0-or-later",
                                  .doc = "magnets",
                                  PF_FIELDS(PF_FIELD_BODY_VELOCITY(), PF_FIELD_BODY_SPIN),
                                  PF_TERMS(&pairs)};
PF_ENTRY(magnets)
