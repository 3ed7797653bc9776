/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What a residual computes: its worked examples; every output assigned, finite, and the same twice; a point on its
 * own whatever the others of its batch are; the complex twin the same function. */
#include "term/selftest_parts.h"

#include "base/process.h"

#include <complex.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* The residual on outputs that hold `before`; 1 if it went well. */
static int outputs_over(bench *k, double **to, double before)
{
    for (uint32_t o = 0; o < k->t->n_out; o++)
        for (int i = 0; i < bench_components(k, &k->t->out[o]) * BENCH_LD; i++)
            to[o][i] = before;
    return bench_call(k, to, "residual on random values");
}

static void test_outputs(bench *k)
{
    if (!outputs_over(k, k->out, 7.7e77) || !outputs_over(k, k->again, -7.7e77))
        return;
    for (uint32_t o = 0; o < k->t->n_out; o++)
        for (int i = 0; i < bench_components(k, &k->t->out[o]) * BENCH_LD; i++) {
            double a = k->out[o][i], b = k->again[o][i];
            int kept = a == 7.7e77 && b == -7.7e77, added = fabs(a - b) > 1e70;
            const char *why;

            if (kept && outputs_over(k, k->again, 0))
                added = k->again[o][i] != 0; /* numbers that are small beside 7.7e77 */
            why = !isfinite(a)                    ? "is not a finite number on random values"
                  : added                         ? "is added to; the residual must assign, not add"
                  : kept                          ? "is not written; the residual must assign every output"
                  : memcmp(&a, &b, sizeof a) != 0 ? "differs between two calls with the same values"
                                                  : NULL;
            if (why) {
                bench_line(k, 0, "%s  output \"%s\"[%d] in %dD %s", k->t->name, k->t->out[o].name, i / BENCH_LD,
                           k->dim, why);
                return;
            }
        }
    bench_line(k, 1, "%s  outputs in %dD assigned, finite, repeatable", k->t->name, k->dim);
}

/* The first n points, in reverse order at the end of the batch before, have the values they had there. */
static int same_values(bench *k, int n)
{
    if (!bench_call(k, k->again, "residual on random values"))
        return 0;
    for (uint32_t o = 0; o < k->t->n_out; o++)
        for (int c = 0; c < bench_components(k, &k->t->out[o]); c++)
            for (int l = 0; l < n; l++)
                if (k->again[o][c * BENCH_LD + l] != k->out[o][c * BENCH_LD + BENCH_LD - 1 - l]) {
                    bench_line(k, 0, "%s  output \"%s\": a point's value depends on the other points of its batch",
                               k->t->name, k->t->out[o].name);
                    return 0;
                }
    return 1;
}

static void reverse(double *row)
{
    for (int l = 0; l < BENCH_LD / 2; l++) {
        double swap = row[l];

        row[l] = row[BENCH_LD - 1 - l], row[BENCH_LD - 1 - l] = swap;
    }
}

/* The same points in another order give the same values in that order; and a point keeps its
 * values whatever the others are. */
static void test_batches(bench *k)
{
    for (uint32_t i = 0; i < k->t->n_in; i++)
        for (int c = 0; c < bench_components(k, &k->t->in[i]); c++)
            reverse(k->in[i] + c * BENCH_LD);
    for (int c = 0; c < 3; c++) {
        reverse(k->x + c * BENCH_LD);
        reverse(k->arm + c * BENCH_LD);
    }
    for (int c = 0; k->metric && c < k->dim * k->dim; c++)
        reverse(k->metric + c * BENCH_LD);
    reverse(k->h);
    reverse(k->density);
    if (!same_values(k, BENCH_LD))
        return;
    for (uint32_t i = 0; i < k->t->n_in; i++)
        for (int j = 0; j < bench_components(k, &k->t->in[i]) * BENCH_LD; j++)
            k->in[i][j] *= j % BENCH_LD ? 1.5 : 1;
    if (same_values(k, 1))
        bench_line(k, 1, "%s  batches in %dD: each point on its own", k->t->name, k->dim);
}

/* The complex twin must be the same function. */
static void test_twin(bench *k)
{
    double worst = 0, size = 0;
    int status;
    pf_complex *z = k->room, *w[TERM_MAX_SLOTS];
    const pf_complex *in[TERM_MAX_SLOTS];

    for (uint32_t i = 0; i < k->t->n_in; i++) {
        in[i] = z;
        for (int c = 0; c < bench_components(k, &k->t->in[i]) * BENCH_LD; c++)
            *z++ = k->in[i][c];
    }
    for (uint32_t o = 0; o < k->t->n_out; o++) {
        w[o] = z;
        z += bench_components(k, &k->t->out[o]) * BENCH_LD;
    }
    if (!bench_call(k, k->out, "residual on random values"))
        return;
    process_enter(k->p->d.name, k->t->name, "complex twin", -1);
    status = k->t->residual_c(&k->b, in, w);
    process_leave();
    if (status) {
        bench_line(k, 0, "%s  residual_c returned %d where residual returned 0; they must be one source",
                   k->t->name, status);
        return;
    }
    for (uint32_t o = 0; o < k->t->n_out; o++)
        for (int c = 0; c < bench_components(k, &k->t->out[o]) * BENCH_LD; c++) {
            double e = fabs(creal(w[o][c]) - k->out[o][c]);

            worst = isnan(e) ? INFINITY : fmax(worst, e);
            size = fmax(size, fabs(k->out[o][c]));
        }
    if (worst <= 1e-13 * size)
        bench_line(k, 1, "%s  complex twin in %dD = residual", k->t->name, k->dim);
    else
        bench_line(k, 0, "%s  residual_c differs from residual by %.2g (of %.2g); they must be one source",
                   k->t->name, worst, size);
}

/* The metric that worked examples have: (4 1; 1 2), in 3D (4 1 0; 1 2 0; 0 0 1). */
static void place_example_metric(bench *k)
{
    static const double g[3][3] = {{4, 1, 0}, {1, 2, 0}, {0, 0, 1}};

    for (int i = 0; k->metric && i < k->dim * k->dim * BENCH_LD; i++)
        k->metric[i] = g[i / BENCH_LD / k->dim][i / BENCH_LD % k->dim];
}

void selftest_example(bench *k, const pf_example *e)
{
    const double *in = e->in, *out = e->out, *params = e->params;
    double worst = 0, size = 0, got = 0, expected = 0;
    char where[100] = "";

    for (uint32_t i = 0; params && i < k->t->n_param; i++) {
        bench_put_param(k, &k->t->param[i], params);
        params += k->t->param[i].type == PF_T_VECTOR ? k->dim : 1;
    }
    if (!bench_start(k))
        return;
    place_example_metric(k);
    for (uint32_t i = 0; i < k->t->n_in; i++)
        for (int c = 0; c < bench_components(k, &k->t->in[i]); c++, in++)
            for (int l = 0; l < BENCH_LD; l++)
                k->in[i][c * BENCH_LD + l] = *in;
    if (!bench_call(k, k->out, "residual of the worked example"))
        return;
    for (uint32_t o = 0; o < k->t->n_out; o++)
        for (int c = 0; c < bench_components(k, &k->t->out[o]); c++, out++) {
            size = fmax(size, fabs(*out));
            if (!(fabs(k->out[o][c * BENCH_LD] - *out) <= worst)) {
                worst = isnan(k->out[o][c * BENCH_LD]) ? INFINITY : fabs(k->out[o][c * BENCH_LD] - *out);
                got = k->out[o][c * BENCH_LD];
                expected = *out;
                snprintf(where, sizeof where, "%s[%d]", k->t->out[o].name, c);
            }
        }
    if (worst <= e->tol * size)
        bench_line(k, 1, "%s  example \"%s\"", k->t->name, e->name);
    else
        bench_line(k, 0, "%s  example \"%s\": %s is %.15g, expected %.15g", k->t->name, e->name, where, got,
                   expected);
}

int selftest_values(bench *k)
{
    const int before = k->s->failed;

    test_outputs(k);
    if (k->s->failed > before)
        return 0;
    test_batches(k);
    if (k->t->residual_c)
        test_twin(k);
    return 1;
}
