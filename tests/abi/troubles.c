/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Terms that are sound enough to pass their checks, and give Newton's method or the user a hard time. */
#include <plugflow/plugin.h>

#include <math.h>

struct troubles {
    double n;
};

/* 2 D:D at lane i */
static double shear(const pf_batch *b, const double *grad_u, uint32_t i)
{
    const uint32_t d = b->dim;
    double sum = 0;

    for (uint32_t a = 0; a < d; a++)
        for (uint32_t k = 0; k < d; k++) {
            const double twice = grad_u[(a * d + k) * b->ld + i] + grad_u[(k * d + a) * b->ld + i];

            sum += 0.5 * twice * twice;
        }
    return sum;
}

/* K (2 D:D)^((n-1)/2) 2 D : grad v, which at rest is 0 times infinity for n < 1; for n > 1 only its derivative as
 * written here, 0/0, is none. */
static int power_law(const pf_batch *b, const double *const *in, double *const *out)
{
    const struct troubles *f = b->params;
    const uint32_t d = b->dim;

    for (uint32_t i = 0; i < b->ld; i++) {
        const double mu = pow(shear(b, in[0], i), 0.5 * (f->n - 1));

        for (uint32_t a = 0; a < d; a++)
            for (uint32_t k = 0; k < d; k++)
                out[0][(a * d + k) * b->ld + i] =
                    mu * (in[0][(a * d + k) * b->ld + i] + in[0][(k * d + a) * b->ld + i]);
    }
    return PF_OK;
}

static int power_law_jacobian(const pf_batch *b, const double *const *in, double *const *jac)
{
    const struct troubles *f = b->params;
    const uint32_t d = b->dim, dd = d * d, ld = b->ld;

    for (uint32_t i = 0; i < ld; i++) {
        const double g2 = shear(b, in[0], i), mu = pow(g2, 0.5 * (f->n - 1)), slope = 0.5 * (f->n - 1) * mu / g2;

        for (uint32_t r = 0; r < dd; r++) {
            const uint32_t turned = r % d * d + r / d;

            for (uint32_t c = 0; c < dd; c++)
                jac[0][(r * dd + c) * ld + i] = 2 * slope * (in[0][r * ld + i] + in[0][turned * ld + i]) *
                                                (in[0][c * ld + i] + in[0][(c % d * d + c / d) * ld + i]);
            jac[0][(r * dd + r) * ld + i] += mu;
            jac[0][(r * dd + turned) * ld + i] += mu;
        }
    }
    return PF_OK;
}

/* (rate - sqrt(2 D:D)) s: the flow gives the rate, and the rate gives the flow nothing. */
static int rate(const pf_batch *b, const double *const *in, double *const *out)
{
    for (uint32_t i = 0; i < b->ld; i++)
        out[0][i] = in[0][i] - sqrt(1e-20 + shear(b, in[1], i));
    return PF_OK;
}

static int rate_jacobian(const pf_batch *b, const double *const *in, double *const *jac)
{
    const uint32_t d = b->dim, ld = b->ld;

    for (uint32_t i = 0; i < ld; i++) {
        jac[0][i] = 1;
        for (uint32_t c = 0; c < d * d; c++)
            jac[1][c * ld + i] =
                -(in[1][c * ld + i] + in[1][(c % d * d + c / d) * ld + i]) / sqrt(1e-20 + shear(b, in[1], i));
    }
    return PF_OK;
}

/* (theta - 1) X */
static int one(const pf_batch *b, const double *const *in, double *const *out)
{
    for (uint32_t i = 0; i < b->ld; i++)
        out[0][i] = in[0][i] - 1;
    return PF_OK;
}

static int endless(const pf_batch *b, const double *const *in, double *const *out)
{
    for (volatile uint32_t i = 0; b->n; i++)
        out[0][0] = in[0][0] + i;
    return PF_OK;
}

static const pf_term power_law_term = {
    PF_TERM_SIZES,
    .name = "power_law",
    .where = PF_CELL,
    .flags = PF_OPTIONAL,
    .doc = "(2D:D)^{(n-1)/2}\\,2D:\\nabla v",
    .cite = "Ostwald 1925",
    PF_IN({"grad_u", "u", PF_GRAD, PF_TENSOR}),
    PF_OUT({"grad_v", "u", PF_GRAD, PF_TENSOR}),
    PF_PARAMS(struct troubles, PF_NUMBER(struct troubles, n, "1", "exponent", .dflt = 0.5, .min = 0, .max = 10)),
    .residual = power_law,
    .jacobian = power_law_jacobian,
};
static const pf_term rate_term = {
    PF_TERM_SIZES,
    .name = "rate",
    .where = PF_CELL,
    .flags = PF_OPTIONAL,
    .doc = "(\\dot\\gamma-\\sqrt{2D:D})\\,s",
    .cite = "definition of the shear rate",
    PF_IN({"rate", "rate", PF_VALUE, PF_SCALAR}, {"grad_u", "u", PF_GRAD, PF_TENSOR}),
    PF_OUT({"s", "rate", PF_VALUE, PF_SCALAR}),
    .residual = rate,
    .jacobian = rate_jacobian,
};
static const pf_term endless_term = {
    PF_TERM_SIZES,
    .name = "endless",
    .where = PF_CELL,
    .flags = PF_OPTIONAL,
    .doc = "\\infty\\,s",
    .cite = "none",
    PF_IN({"rate", "rate", PF_VALUE, PF_SCALAR}),
    PF_OUT({"s", "rate", PF_VALUE, PF_SCALAR}),
    .residual = endless,
};
static const pf_term one_term = {
    PF_TERM_SIZES,
    .name = "one",
    .where = PF_CELL,
    .flags = PF_OPTIONAL | PF_LINEAR,
    .doc = "(\\theta-1)\\,X",
    .cite = "none",
    PF_IN({"theta", "theta", PF_VALUE, PF_SCALAR}),
    PF_OUT({"X", "theta", PF_VALUE, PF_SCALAR}),
    .residual = one,
};
static const pf_plugin troubles = {
    PF_PLUGIN,
    .name = "troubles",
    .version = "1.0",
    .author = "plugflow",
    .license = "GPL-3.0-or-later",
    .doc = "terms that make trouble",
    PF_FIELDS({.name = "u",
               .unit = "m/s",
               .doc = "velocity",
               .shape = PF_VECTOR,
               .order = 2,
               .reaction = "force",
               .reaction_unit = "N"},
              {.name = "rate", .unit = "1/s", .doc = "shear rate", .shape = PF_SCALAR, .order = 1},
              {.name = "theta", .unit = "1", .doc = "a number", .shape = PF_SCALAR, .support = PF_ON_PROBLEM}),
    PF_TERMS(&power_law_term, &rate_term, &endless_term, &one_term),
};
PF_ENTRY(troubles)
