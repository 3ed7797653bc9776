/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Sound terms of all kinds, with Jacobians by hand, in one file: copies of it with one fault each, made by sed as
 * faults.txt says, must not pass plugflow test.  The file includes itself (SELF) twice, for the equations in real
 * and in complex numbers. */
/* Sed needs lines as they are. */
/* clang-format off */
#ifndef EQUATIONS
#include <plugflow/fluid.h>

#include <fenv.h>
#include <locale.h>
#include <stdlib.h>
#include <string.h>
#include <tgmath.h>
#include <unistd.h>

struct law {
    double density, viscosity, n, eps, conductivity, slope, field[3];
    int model, thickens;
};

/* What a fault keeps between calls. */
static double kept;

#define EQUATIONS
#include <plugflow/twin_real.h>
#include SELF
#include <plugflow/twin_complex.h>
#include SELF

/* --- Jacobians by hand --- */

static int stress_jacobian(const pf_batch *b, const double *const *in, double *const *jac)
{
    const struct law *f = b->params;
    double *dG = jac[0], *dp = jac[1];
    const uint32_t d = b->dim, dd = d * d, ld = b->ld;

    (void)in;
    for (uint32_t a = 0; a < d; a++)
        for (uint32_t k = 0; k < d; k++)
            for (uint32_t i = 0; i < ld; i++) {
                dG[((a * d + k) * dd + a * d + k) * ld + i] += f->viscosity; /* straight */
                dG[((a * d + k) * dd + k * d + a) * ld + i] += f->viscosity; /* transposed */
                dp[(a * d + k) * ld + i] = a == k ? -1 : 0; /* pressure */
            }
    return PF_OK;
}

static int convection_jacobian(const pf_batch *b, const double *const *in, double *const *jac)
{
    const struct law *f = b->params;
    const double *u = in[0], *G = in[1];
    double *du = jac[0], *dG = jac[1];
    const uint32_t d = b->dim, ld = b->ld;

    for (uint32_t a = 0; a < d; a++)
        for (uint32_t k = 0; k < d; k++)
            for (uint32_t i = 0; i < ld; i++) {
                du[(a * d + k) * ld + i] = f->density * G[(a * d + k) * ld + i]; /* by u */
                dG[(a * d * d + a * d + k) * ld + i] = f->density * u[k * ld + i]; /* by grad u */
            }
    return PF_OK;
}

/* mu = viscosity g2^((n-1)/2), or viscosity (1 + g2)^((n-1)/2); its derivative by g2 */
static double law_of(const struct law *f, double g2, double *slope)
{
    const double base = f->model ? 1 + g2 : g2, e = 0.5 * (f->n - 1), mu = f->viscosity * pow(base, e);

    *slope = e * mu / base; /* slope of the law */
    if (f->thickens)
        *slope += 1; /* of what thickens */
    return mu + (f->thickens ? g2 : 0);
}

static int power_law_jacobian(const pf_batch *b, const double *const *in, double *const *jac)
{
    const struct law *f = b->params;
    const uint32_t d = b->dim, dd = d * d, ld = b->ld;

    for (uint32_t i = 0; i < ld; i++) {
        double D[9], g2 = f->eps * f->eps, mu, slope;

        for (uint32_t a = 0; a < d; a++)
            for (uint32_t k = 0; k < d; k++) {
                D[a * d + k] = 0.5 * (in[0][(a * d + k) * ld + i] + in[0][(k * d + a) * ld + i]);
                g2 += 2 * D[a * d + k] * D[a * d + k];
            }
        mu = law_of(f, g2, &slope);
        for (uint32_t r = 0; r < dd; r++) {
            for (uint32_t c = 0; c < dd; c++)
                jac[0][(r * dd + c) * ld + i] = 8 * slope * D[r] * D[c]; /* by the law */
            jac[0][(r * dd + r) * ld + i] += mu;
            jac[0][(r * dd + (r % d) * d + r / d) * ld + i] += mu; /* mu, transposed */
        }
    }
    return PF_OK;
}

/* xi = rho r x (w x r) = rho (r.r w - (r.w) r) */
static int spin_jacobian(const pf_batch *b, const double *const *in, double *const *jac)
{
    const uint32_t n = b->dim == 2 ? 1 : 3, ld = b->ld;
    const double *r = b->arm;

    (void)in;
    for (uint32_t i = 0; i < ld; i++) {
        double rr = 0;

        for (uint32_t a = 0; a < b->dim; a++)
            rr += r[a * ld + i] * r[a * ld + i];
        for (uint32_t a = 0; a < n; a++)
            for (uint32_t k = 0; k < n; k++)
                jac[0][(a * n + k) * ld + i] =
                    b->density[i] * ((a == k ? rr : 0) - (n == 3 ? r[a * ld + i] * r[k * ld + i] : 0)); /* spin */
    }
    return PF_OK;
}

static int heat_jacobian(const pf_batch *b, const double *const *in, double *const *jac)
{
    for (uint32_t a = 0; a < b->dim; a++)
        for (uint32_t i = 0; i < b->ld; i++) {
            jac[0][(a * b->dim + a) * b->ld + i] = in[1][i];
            jac[1][a * b->ld + i] = in[0][a * b->ld + i]; /* by conductivity */
        }
    return PF_OK;
}

static int law_jacobian(const pf_batch *b, const double *const *in, double *const *jac)
{
    const struct law *f = b->params;

    for (uint32_t i = 0; i < b->ld; i++)
        jac[0][i] = 2 * f->conductivity * f->slope * in[0][i]; /* law by T */
    return PF_OK;
}

static int relax_jacobian(const pf_batch *b, const double *const *in, double *const *jac)
{
    const struct law *f = b->params;
    const uint32_t n = b->dim * (b->dim + 1) / 2;

    (void)in;
    for (uint32_t c = 0; c < n; c++)
        for (uint32_t i = 0; i < b->ld; i++) {
            jac[0][(c * n + c) * b->ld + i] = 1; /* rate */
            jac[1][(c * n + c) * b->ld + i] = f->slope; /* relaxation */
        }
    return PF_OK;
}

/* --- descriptions --- */

static const char *const models[] = {"power", "carreau", NULL};
#define LAW                                                                                                        \
    PF_PARAMS(struct law, PF_NUMBER(struct law, density, "kg/m^3", "mass per volume", .dflt = 1.5, PF_NOT_NEGATIVE), \
              PF_NUMBER(struct law, viscosity, "Pa s", "viscosity", .dflt = 2.5, PF_NOT_NEGATIVE),                   \
              PF_NUMBER(struct law, n, "1", "exponent", .dflt = 1, .min = 0.1, .max = 3),                          \
              PF_NUMBER(struct law, eps, "1/s", "rate that regularises", .dflt = 0.1, .min = 1e-3, .max = 10),     \
              PF_NUMBER(struct law, conductivity, "W/(m K)", "at 0 K", .dflt = 1, PF_NOT_NEGATIVE),                \
              PF_NUMBER(struct law, slope, "1/s", "rate", .dflt = 3.5, PF_NOT_NEGATIVE),                             \
              {"field", "V/m", "electric field", PF_T_VECTOR, 0, offsetof(struct law, field)},                     \
              {"model", "1", "law", PF_T_CHOICE, 0, offsetof(struct law, model), 0, 0, 0, models},                 \
              {"thickens", "1", "adds the rate", PF_T_BOOL, 0, offsetof(struct law, thickens)})
#define SOURCE .cite = "worked out by hand"

/* rho, mu, n, eps, k, slope, field, model, thickens */
static const double numbers[] = {2, 3, 1, 0, 5, 7, 1, 2, 0, 0};
static const uint8_t both[] = {1, 1}; /* couplings */

static const pf_term stress = {
    PF_TERM(stress),
    .where = PF_FLUID,
    .flags = PF_LINEAR,
    .doc = "(2\\mu D(u)-p\\,I):\\nabla v",
    SOURCE,
    PF_IN({"grad_u", "u", PF_GRAD, PF_TENSOR}, {"p", "p", PF_VALUE, PF_SCALAR}),
    PF_OUT({"grad_v", "u", PF_GRAD, PF_TENSOR}),
    LAW,
    PF_EXAMPLES({"grad u = (1 2; 4 -1), p = 7", 2, numbers, (double[]){1, 2, 4, -1, 7}, (double[]){-1, 18, 18, -13},
                 1e-15}),
    .scratch_bytes = 80,
    .depends = both,
    .jacobian = stress_jacobian,
};

static const pf_term convection = {
    PF_TERM(convection),
    .where = PF_CELL,
    .flags = 0, /* convection's */
    .doc = "\\rho\\,(u\\cdot\\nabla)u\\cdot v",
    SOURCE,
    PF_IN({"u", "u", PF_VALUE, PF_VECTOR}, {"grad_u", "u", PF_GRAD, PF_TENSOR}),
    PF_OUT({"v", "u", PF_VALUE, PF_VECTOR}),
    LAW,
    PF_EXAMPLES(
        {"u = (1, 2), grad u = (3 4; 5 6)", 2, numbers, (double[]){1, 2, 3, 4, 5, 6}, (double[]){22, 34}, 1e-15}),
    .jacobian = convection_jacobian,
};

static const pf_term power_law = {
    PF_TERM(power_law),
    .where = PF_FLUID,
    .doc = "2\\mu(\\dot\\gamma)D(u):\\nabla v",
    SOURCE,
    PF_IN({"grad_u", "u", PF_GRAD, PF_TENSOR}),
    PF_OUT({"grad_v", "u", PF_GRAD, PF_TENSOR}),
    LAW,
    .jacobian = power_law_jacobian,
};

static const pf_term spin = {
    PF_TERM(spin),
    .where = PF_SOLID,
    .flags = PF_LINEAR,
    .doc = "\\rho\\,r\\times(\\omega\\times r)\\cdot\\xi",
    SOURCE,
    PF_IN({"omega", "omega", PF_VALUE, PF_SPIN}),
    PF_OUT({"xi", "omega", PF_VALUE, PF_SPIN}),
    .jacobian = spin_jacobian,
};

static const pf_term slip = {
    PF_TERM(slip),
    .where = PF_SURFACE,
    .flags = PF_LINEAR,
    .doc = "\\mu/h\\,(u-U)_n\\,v_n",
    SOURCE,
    PF_IN({"u", "u", PF_VALUE, PF_VECTOR}, {"U", "U", PF_VALUE, PF_VECTOR}),
    PF_OUT({"v", "u", PF_VALUE, PF_VECTOR}),
    LAW,
};

static const pf_term approach = {
    PF_TERM(approach),
    .where = PF_PAIR,
    .flags = PF_LINEAR,
    .doc = "\\mu/gap\\,(U\\cdot n)(V\\cdot n)",
    SOURCE,
    PF_IN({"U", "U", PF_DEFECT, PF_VECTOR}),
    PF_OUT({"V", "U", PF_DEFECT, PF_VECTOR}),
    LAW,
};

static const pf_term heat = {
    PF_TERM(heat),
    .where = PF_CELL,
    .doc = "k\\,\\nabla T\\cdot\\nabla s",
    SOURCE,
    PF_IN({"grad_T", "T", PF_GRAD, PF_VECTOR}, {"k", "conductivity", PF_PROPERTY, PF_SCALAR}),
    PF_OUT({"grad_s", "T", PF_GRAD, PF_VECTOR}),
    .jacobian = heat_jacobian,
};

static const pf_term conducts = {
    PF_TERM(conducts),
    .where = PF_CELL,
    .doc = "k_0(1+aT^2)",
    SOURCE,
    PF_IN({.name = "T", .field = "T", .eval = PF_VALUE, .shape = PF_SCALAR, .min = 1, .max = 4}),
    PF_OUT({"k", "conductivity", PF_PROPERTY, PF_SCALAR, "W/(m K)", "conductivity"}),
    LAW,
    .jacobian = law_jacobian,
};

static const pf_term charge = {
    PF_TERM(charge),
    .where = PF_PARTICLE,
    .doc = "-q\\,E\\cdot V",
    SOURCE,
    PF_IN({"q", "charge", PF_BODY_KEY, PF_SCALAR, "C", "charge"}, {"age", "age", PF_STATE, PF_SCALAR}),
    PF_OUT({"V", "U", PF_VALUE, PF_VECTOR}, {"age", "age", PF_STATE, PF_SCALAR}),
    LAW,
    PF_EXAMPLES({"q = 3, E = (1, 2)", 2, numbers, (double[]){3, 4}, (double[]){-3, -6, 4.1}, 1e-15}),
};

static const pf_term relax = {
    PF_TERM(relax),
    .where = PF_FLUID,
    .flags = PF_LINEAR,
    .doc = "(\\dot c+a(c-I)):s",
    SOURCE,
    PF_IN({"c_t", "c", PF_DOT, PF_SYMMETRIC}, {"c", "c", PF_VALUE, PF_SYMMETRIC}),
    PF_OUT({"s", "c", PF_VALUE, PF_SYMMETRIC}),
    LAW,
    .jacobian = relax_jacobian,
};

static const pf_plugin laws = {
    PF_PLUGIN,
    .min_minor = 4,
    .name = "laws",
    .version = "1.0",
    .author = "plugflow",
    .license = "GPL-3.0-or-later",
    .doc = "sound terms",
    PF_FIELDS(PF_FIELD_VELOCITY, PF_FIELD_PRESSURE, PF_FIELD_BODY_VELOCITY(), PF_FIELD_BODY_SPIN,
              {.name = "T", .unit = "K", .doc = "temperature", .shape = PF_SCALAR, .order = 2},
              {.name = "c", .unit = "1", .doc = "conformation", .shape = PF_SYMMETRIC, .order = 1},
              {.name = "age", .unit = "s", .doc = "age", .shape = PF_SCALAR, .support = PF_KEPT_BY_PARTICLE}),
    PF_TERMS(&stress, &convection, &power_law, &spin, &slip, &approach, &heat, &conducts, &charge, &relax),
};
PF_ENTRY(laws)

#else /* --- the equations, twice --- */

static int F(stress)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const struct law *f = b->params;
    const uint32_t d = b->dim, ld = b->ld;

    for (uint32_t a = 0; a < d; a++) /* stress, rows */
        for (uint32_t k = 0; k < d; k++)
            for (uint32_t i = 0; i < ld; i++)
                out[0][(a * d + k) * ld + i] =
                    f->viscosity * (in[0][(a * d + k) * ld + i] + in[0][(k * d + a) * ld + i]) -
                    (a == k ? in[1][i] : 0);
    return PF_OK;
}

static int F(convection)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const struct law *f = b->params;
    const uint32_t d = b->dim, ld = b->ld;
    NUM sum;

    (void)kept;
    for (uint32_t a = 0; a < d; a++)
        for (uint32_t i = 0; i < ld; i++) {
            sum = 0;
            for (uint32_t k = 0; k < d; k++)
                sum += in[0][k * ld + i] * in[1][(a * d + k) * ld + i]; /* u . grad u */
            out[0][a * ld + i] = f->density * sum; /* convection's output */
        }
    return PF_OK; /* end of convection */
}

static int F(power_law)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const struct law *f = b->params;
    const uint32_t d = b->dim, ld = b->ld;

    for (uint32_t i = 0; i < ld; i++) {
        NUM D[9], g2 = f->eps * f->eps, mu;

        for (uint32_t a = 0; a < d; a++)
            for (uint32_t k = 0; k < d; k++) {
                D[a * d + k] = 0.5 * (in[0][(a * d + k) * ld + i] + in[0][(k * d + a) * ld + i]);
                g2 += 2 * D[a * d + k] * D[a * d + k];
            }
        mu = f->viscosity * exp(0.5 * (f->n - 1) * log(f->model ? 1 + g2 : g2)) + (f->thickens ? g2 : 0);
        for (uint32_t r = 0; r < d * d; r++)
            out[0][r * ld + i] = 2 * mu * D[r];
    }
    return PF_OK;
}

static int F(spin)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const uint32_t n = b->dim == 2 ? 1 : 3, ld = b->ld;
    const double *r = b->arm;

    for (uint32_t i = 0; i < ld; i++) {
        NUM along = 0;
        double rr = 0;

        for (uint32_t a = 0; a < b->dim; a++)
            rr += r[a * ld + i] * r[a * ld + i];
        for (uint32_t a = 0; n == 3 && a < 3; a++)
            along += r[a * ld + i] * in[0][a * ld + i];
        for (uint32_t a = 0; a < n; a++)
            out[0][a * ld + i] = b->density[i] * (rr * in[0][a * ld + i] - (n == 3 ? along * r[a * ld + i] : 0));
    }
    return PF_OK;
}

static int F(slip)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const struct law *f = b->params;

    for (uint32_t i = 0; i < b->ld; i++) {
        NUM w = 0;

        for (uint32_t a = 0; a < b->dim; a++)
            w += (in[0][a * b->ld + i] - in[1][a * b->ld + i]) * b->normal[a * b->ld + i]; /* slip */
        for (uint32_t a = 0; a < b->dim; a++)
            out[0][a * b->ld + i] = f->viscosity / b->h[i] * w * b->normal[a * b->ld + i]; /* along n */
    }
    return PF_OK;
}

static int F(approach)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const struct law *f = b->params;

    for (uint32_t i = 0; i < b->ld; i++) {
        NUM U_n = 0;

        for (uint32_t a = 0; a < b->dim; a++)
            U_n += in[0][a * b->ld + i] * b->normal[a * b->ld + i]; /* approach */
        for (uint32_t a = 0; a < b->dim; a++)
            out[0][a * b->ld + i] = f->viscosity / b->gap[i] * U_n * b->normal[a * b->ld + i];
    }
    return PF_OK;
}

static int F(heat)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    for (uint32_t a = 0; a < b->dim; a++)
        for (uint32_t i = 0; i < b->ld; i++)
            out[0][a * b->ld + i] = in[1][i] * in[0][a * b->ld + i];
    return PF_OK;
}

static int F(conducts)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const struct law *f = b->params;

    for (uint32_t i = 0; i < b->ld; i++) {
        if (creal(in[0][i]) < 0.9)
            return b->host->fail(b, i, PF_RETRY, "too cold"); /* range */
        out[0][i] = f->conductivity * (1 + f->slope * in[0][i] * in[0][i]);
    }
    return PF_OK;
}

static int F(charge)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const struct law *f = b->params;

    for (uint32_t a = 0; a < b->dim; a++)
        for (uint32_t i = 0; i < b->ld; i++)
            out[0][a * b->ld + i] = -in[0][i] * f->field[a]; /* force of the field */
    for (uint32_t i = 0; i < b->ld; i++)
        out[1][i] = in[1][i] + b->dt; /* age */
    return PF_OK;
}

static int F(relax)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const struct law *f = b->params;
    const uint32_t d = b->dim, n = d * (d + 1) / 2; /* symmetric */

    for (uint32_t c = 0; c < n; c++)
        for (uint32_t i = 0; i < b->ld; i++) {
            const int diagonal = c == 0 || c == n - 1 || (d == 3 && c == 3);

            out[0][c * b->ld + i] = in[0][c * b->ld + i] + f->slope * (in[1][c * b->ld + i] - diagonal);
        }
    return PF_OK;
}
#endif
