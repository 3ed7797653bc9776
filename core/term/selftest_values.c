/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What a residual computes: its worked examples; every output assigned, finite, and the same twice; a point on its
 * own whatever the others of its batch are; the complex twin the same function. */
#include "term/selftest_parts.h"

#include "term/entry.h"

#include <complex.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* What the calls of this file are, in messages. */
static const char *values_of(const bench *k)
{
    return k->captured ? "residual on values of the case" : "residual on random values";
}

static void fill(bench *k, double **to, double before)
{
    for (uint32_t o = 0; o < k->t->n_out; o++)
        for (int i = 0; i < bench_components(k, &k->t->out[o]) * BENCH_LD; i++)
            to[o][i] = before;
}

/* The residual on outputs that hold `before`; 1 if it went well. */
static int outputs_over(bench *k, double **to, double before)
{
    fill(k, to, before);
    return bench_call(k, to, values_of(k));
}

/* Values on which the term can be computed: it may refuse some, if its slots have ranges, within which only some
 * belong together. */
static int find_values(bench *k)
{
    int sound = 1;

    for (int i = 0; i < 20 && bench_has_range(k) && !k->captured; i++) {
        fill(k, k->out, 0);
        if (bench_status(k, k->out, values_of(k), &sound) != PF_RETRY || !sound)
            break;
        bench_random_inputs(k);
    }
    return sound;
}

static void test_outputs(bench *k)
{
    if (!find_values(k) || !outputs_over(k, k->out, 7.7e77) || !outputs_over(k, k->again, -7.7e77))
        return;
    for (uint32_t o = 0; o < k->t->n_out; o++)
        for (int i = 0; i < bench_components(k, &k->t->out[o]) * BENCH_LD; i++) {
            double a = k->out[o][i], b = k->again[o][i];
            int kept = a == 7.7e77 && b == -7.7e77, added = fabs(a - b) > 1e70;
            const char *why;
            char entry[160], read[240], zone[160];

            if (i % BENCH_LD >= BENCH_N)
                continue;
            if (kept && outputs_over(k, k->again, 0))
                added = k->again[o][i] != 0; /* numbers that are small beside 7.7e77 */
            snprintf(read, sizeof read, "comes from outside of %s: a slot is read past its end",
                     guard_read(&k->guard, a, zone, sizeof zone) ? zone : "");
            why = guard_read(&k->guard, a, zone, sizeof zone) ? read
                  : !isfinite(a)                              ? "is not a finite number on random values"
                  : added                                     ? "is added to; the residual must assign, not add"
                  : kept                          ? "is not written; the residual must assign every output"
                  : memcmp(&a, &b, sizeof a) != 0 ? "differs between two calls with the same values"
                                                  : NULL;
            if (why) {
                bench_line(k, 0, "%s  output \"%s\"%s in %dD %s", k->t->name, k->t->out[o].name,
                           entry_index(&k->t->out[o], k->dim, i / BENCH_LD, entry, sizeof entry), k->dim, why);
                return;
            }
        }
    bench_line(k, 1, "%s  outputs in %dD assigned, finite, repeatable", k->t->name, k->dim);
}

/* The first n points, in reverse order at the end of the points before, have the values they had there. */
static int same_values(bench *k, int n)
{
    if (!bench_call(k, k->again, values_of(k)))
        return 0;
    for (uint32_t o = 0; o < k->t->n_out; o++)
        for (int c = 0; c < bench_components(k, &k->t->out[o]); c++)
            for (int l = 0; l < n; l++) {
                char entry[160];

                if (k->again[o][c * BENCH_LD + l] == k->out[o][c * BENCH_LD + BENCH_N - 1 - l])
                    continue;
                bench_line(k, 0, "%s  output \"%s\": a point's value depends on the other points of its batch (%s)",
                           k->t->name, k->t->out[o].name,
                           entry_name(&k->t->out[o], k->dim, c, entry, sizeof entry));
                return 0;
            }
    return 1;
}

/* The same points in another order give the same values in that order; and a point keeps its
 * values whatever the others are (as it is itself). */
static void test_batches(bench *k)
{
    bench_reverse(k);
    if (!same_values(k, BENCH_N))
        return;
    for (uint32_t i = 0; i < k->t->n_in; i++)
        for (int j = 0; j < bench_components(k, &k->t->in[i]) * BENCH_LD; j++)
            k->in[i][j] = k->in[i][j - j % BENCH_LD];
    if (same_values(k, 1))
        bench_line(k, 1, "%s  batches in %dD: each point on its own", k->t->name, k->dim);
    if (!k->captured)
        bench_random_inputs(k), find_values(k);
}

/* Where the twin differs most; 0: nowhere. */
static double twin_differs(bench *k, double size, char *text, size_t n)
{
    double worst = 0;

    *text = 0;
    for (uint32_t o = 0; o < k->t->n_out; o++)
        for (int c = 0; c < bench_components(k, &k->t->out[o]) * BENCH_LD; c++) {
            const double twin = creal(k->w[o][c]), e = fabs(twin - k->out[o][c]);
            char entry[160];

            if (c % BENCH_LD >= BENCH_N || !(e > worst || isnan(e)) || isinf(worst))
                continue;
            worst = isnan(e) ? INFINITY : e;
            snprintf(text, n, "%s is %.6g there, %.6g here",
                     entry_name(&k->t->out[o], k->dim, c / BENCH_LD, entry, sizeof entry), twin, k->out[o][c]);
        }
    return worst <= 1e-13 * size ? 0 : worst;
}

/* The complex twin must be the same function. */
static void test_twin(bench *k)
{
    double worst, size = 0;
    char where[300];
    int status;

    for (uint32_t i = 0; i < k->t->n_in; i++)
        for (int c = 0; c < bench_components(k, &k->t->in[i]) * BENCH_LD; c++)
            k->z[i][c] = k->in[i][c];
    if (!bench_call(k, k->out, values_of(k)))
        return;
    bench_enter(k, "complex twin");
    status = k->t->residual_c(&k->b, (const pf_complex *const *)k->z, k->w);
    if (!bench_left(k, "complex twin"))
        return;
    if (status) {
        bench_line(k, 0, "%s  residual_c returned %d where residual returned 0; they must be one source",
                   k->t->name, status);
        return;
    }
    for (uint32_t o = 0; o < k->t->n_out; o++)
        for (int c = 0; c < bench_components(k, &k->t->out[o]) * BENCH_LD; c++)
            size = fmax(size, c % BENCH_LD < BENCH_N ? fabs(k->out[o][c]) : 0);
    worst = twin_differs(k, size, where, sizeof where);
    if (worst == 0)
        bench_line(k, 1, "%s  complex twin in %dD = residual", k->t->name, k->dim);
    else
        bench_line(k, 0, "%s  residual_c differs from residual by %.2g (of %.2g); they must be one source: %s",
                   k->t->name, worst, size, where);
}

/* What a term keeps between calls must not show: with its own parameters again it gives what it gave. */
static void test_memory(bench *k)
{
    const size_t bytes = k->t->params_bytes;

    if (!k->t->n_param || k->captured || !bench_call(k, k->out, values_of(k)))
        return;
    memcpy(k->other_params, k->params, bytes);
    for (uint32_t i = 0; i < k->t->n_param; i++)
        if (k->t->param[i].type == PF_T_REAL && k->t->param[i].min >= k->t->param[i].max) {
            double v = 1 + i;

            bench_put_param(k, &k->t->param[i], &v);
        }
    /* whatever it says to these */
    bench_enter(k, "residual with other parameters");
    k->t->residual(&k->b, (const double *const *)k->in, k->again);
    bench_left(k, "residual with other parameters");
    memcpy(k->params, k->other_params, bytes);
    if (!bench_call(k, k->again, values_of(k)))
        return;
    for (uint32_t o = 0; o < k->t->n_out; o++)
        for (int i = 0; i < bench_components(k, &k->t->out[o]) * BENCH_LD; i++)
            if (i % BENCH_LD < BENCH_N && memcmp(&k->out[o][i], &k->again[o][i], sizeof(double)) != 0) {
                bench_line(k, 0,
                           "%s  output \"%s\" depends on what the term was called with before: it keeps something "
                           "between calls",
                           k->t->name, k->t->out[o].name);
                return;
            }
}

void selftest_example(bench *k, const pf_example *e)
{
    const double *in = e->in, *out = e->out, *params = e->params;
    double worst = 0, size = 0, got = 0, expected = 0;
    char where[160] = "";

    for (uint32_t i = 0; params && i < k->t->n_param; i++) {
        bench_put_param(k, &k->t->param[i], params);
        params += k->t->param[i].type == PF_T_VECTOR ? k->dim : 1;
    }
    bench_example_points(k);
    for (uint32_t i = 0; i < k->t->n_in; i++)
        for (int c = 0; c < bench_components(k, &k->t->in[i]); c++, in++)
            for (int l = 0; l < BENCH_LD; l++)
                k->in[i][c * BENCH_LD + l] = *in;
    if (!bench_init(k) || !bench_call(k, k->out, "residual of the worked example"))
        return;
    for (uint32_t o = 0; o < k->t->n_out; o++)
        for (int c = 0; c < bench_components(k, &k->t->out[o]); c++, out++) {
            size = fmax(size, fabs(*out));
            if (!(fabs(k->out[o][c * BENCH_LD] - *out) <= worst)) {
                worst = isnan(k->out[o][c * BENCH_LD]) ? INFINITY : fabs(k->out[o][c * BENCH_LD] - *out);
                got = k->out[o][c * BENCH_LD];
                expected = *out;
                entry_name(&k->t->out[o], k->dim, c, where, sizeof where);
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
    if (k->t->residual_c && k->s->failed == before)
        test_twin(k);
    if (k->s->failed == before)
        test_memory(k);
    return 1;
}
