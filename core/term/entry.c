/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The first wrong entry of a Jacobian block.  What a number is made of is guessed: a parameter, an input, their
 * product, with a small factor, if it is that at all points. */
#include "term/entry.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define NEAR 1e-9

/* "xy": component c of a symmetric tensor. */
static const char *symmetric(int dim, int c)
{
    static const char *const plane[] = {"xx", "xy", "yy"}, *const space[] = {"xx", "xy", "xz", "yy", "yz", "zz"};

    return dim == 2 ? plane[c] : space[c];
}

const char *entry_index(const pf_slot *s, int dim, int c, char *text, size_t n)
{
    *text = 0;
    if (s->shape == PF_TENSOR)
        snprintf(text, n, "[%d][%d]", c / dim, c % dim);
    else if (s->shape == PF_TENSOR_GRAD)
        snprintf(text, n, "[%d][%d][%d]", c / dim / dim, c / dim % dim, c % dim);
    else if (s->shape == PF_SYMMETRIC)
        snprintf(text, n, "[%s]", symmetric(dim, c));
    else if (s->shape == PF_SYMMETRIC_GRAD)
        snprintf(text, n, "[%s][%d]", symmetric(dim, c / dim), c % dim);
    else if (s->shape != PF_SCALAR && term_components(s->shape, dim) > 1)
        snprintf(text, n, "[%d]", c);
    return text;
}

const char *entry_name(const pf_slot *s, int dim, int c, char *text, size_t n)
{
    char index[40];

    snprintf(text, n, "%.100s%s", s->name, entry_index(s, dim, c, index, sizeof index));
    return text;
}

/* 1 if v = factor * a * b at all points; b NULL: 1. */
static int is_product(const double *v, double factor, double a, const double *b)
{
    int some = 0;

    for (int l = 0; l < BENCH_N; l++) {
        const double w = factor * a * (b ? b[l] : 1);

        if (!(fabs(v[l] - w) <= NEAR * fabs(w)))
            return 0;
        some |= w != 0;
    }
    return some;
}

/* The parameter's value, or NAN where it is no real number. */
static double real_param(const bench *k, uint32_t i)
{
    double v = NAN;

    if (i < k->t->n_param && k->t->param[i].type == PF_T_REAL)
        memcpy(&v, (const char *)k->params + k->t->param[i].offset, sizeof v);
    return v;
}

/* With one factor: " = 2 viscosity grad_u[0][1]"; 1 if the numbers are that. */
static int made_with(const bench *k, const double *v, double factor, const char *prefix, char *text, size_t n)
{
    for (uint32_t p = 0; p <= k->t->n_param; p++) { /* the last: no parameter */
        const double a = p < k->t->n_param ? real_param(k, p) : 1;
        const char *name = p < k->t->n_param ? k->t->param[p].name : "";

        if (p < k->t->n_param && fabs(a) == 1)
            continue; /* any number is that times others */
        if (p < k->t->n_param && is_product(v, factor, a, NULL)) {
            snprintf(text, n, " = %s%s", prefix, name);
            return 1;
        }
        for (uint32_t i = 0; isfinite(a) && i < k->t->n_in; i++)
            for (int c = 0; c < bench_components(k, &k->t->in[i]); c++)
                if (is_product(v, factor, a, k->in[i] + c * BENCH_LD)) {
                    char entry[160];

                    snprintf(text, n, " = %s%s%s%s", prefix, name, *name ? " " : "",
                             entry_name(&k->t->in[i], k->dim, c, entry, sizeof entry));
                    return 1;
                }
    }
    return 0;
}

static void made_of(const bench *k, const double *v, char *text, size_t n)
{
    static const struct {
        double factor;
        const char *prefix;
    } with[] = {{1, ""}, {-1, "-"}, {2, "2 "}, {-2, "-2 "}, {0.5, "1/2 "}, {-0.5, "-1/2 "}};

    *text = 0;
    for (size_t f = 0; f < sizeof with / sizeof *with; f++)
        if (made_with(k, v, with[f].factor, with[f].prefix, text, n))
            return;
}

/* What turns b into a, for these entries of both: " (sign)"; or the entry of the block that a is. */
static void guess(const bench *k, uint32_t o, uint32_t i, const double *a, const double *b, const double *truth,
                  char *text, size_t n)
{
    const int rows = bench_components(k, &k->t->out[o]), cols = bench_components(k, &k->t->in[i]);
    double most_a = 0, most_b = 0, ab = 0, bb = 0;
    char r[160], c[160];

    for (int l = 0; l < BENCH_N; l++) {
        most_a = fmax(most_a, fabs(a[l])), most_b = fmax(most_b, fabs(b[l]));
        ab += a[l] * b[l], bb += b[l] * b[l];
    }
    *text = 0;
    if (!isfinite(most_a) || !isfinite(ab))
        return;
    if (most_a == 0 || most_b == 0) {
        snprintf(text, n, most_a == 0 ? " (missing)" : " (superfluous)");
        return;
    }
    for (int j = 0; j < rows * cols && !*text; j++) {
        const double *other = truth + (size_t)j * BENCH_LD;
        double e = 0, size = 0;

        for (int l = 0; l < BENCH_N && other != b; l++)
            e = fmax(e, fabs(a[l] - other[l])), size = fmax(size, fabs(other[l]));
        if (other != b && size > 0 && e <= NEAR * size)
            snprintf(text, n, " (exchanged: it is d %s / d %s)",
                     entry_name(&k->t->out[o], k->dim, j / cols, r, sizeof r),
                     entry_name(&k->t->in[i], k->dim, j % cols, c, sizeof c));
    }
    for (int l = 0; l < BENCH_N; l++)
        if (!(fabs(a[l] - ab / bb * b[l]) <= NEAR * most_a))
            return;
    if (fabs(ab / bb + 1) < NEAR)
        snprintf(text, n, " (sign)");
    else
        snprintf(text, n, " (factor %.6g)", ab / bb);
}

void entry_first_wrong(const bench *k, uint32_t o, uint32_t i, const double *given, const double *truth,
                       double tolerance, char *text, size_t n)
{
    const int rows = bench_components(k, &k->t->out[o]), cols = bench_components(k, &k->t->in[i]);
    double size = 0, least = 0;

    *text = 0;
    for (int j = 0; j < rows * cols * BENCH_LD; j++) {
        size = fmax(size, fabs(truth[j]));
        least = fmax(least, isfinite(given[j]) ? 1e-3 * fabs(given[j] - truth[j]) : 0);
    }
    for (int j = 0; j < rows * cols; j++) {
        const double *a = given + (size_t)j * BENCH_LD, *b = truth + (size_t)j * BENCH_LD;
        char r[160], c[160], of_a[200], of_b[200], why[400];
        int worst = 0;

        for (int l = 0; l < BENCH_N; l++)
            worst = !(fabs(a[l] - b[l]) <= fabs(a[worst] - b[worst])) ? l : worst;
        if (fabs(a[worst] - b[worst]) <= fmax(least, tolerance * size))
            continue;
        made_of(k, a, of_a, sizeof of_a);
        made_of(k, b, of_b, sizeof of_b);
        guess(k, o, i, a, b, truth, why, sizeof why);
        snprintf(text, n, "d %s / d %s is %.6g%s, should be %.6g%s%s",
                 entry_name(&k->t->out[o], k->dim, j / cols, r, sizeof r),
                 entry_name(&k->t->in[i], k->dim, j % cols, c, sizeof c), a[worst] + 0.0, of_a, b[worst] + 0.0,
                 of_b, why); /* no -0 */
        return;
    }
}
