/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The Jacobian of a term, block by block against complex step (or differences), with a guess at what is wrong; the
 * couplings that it denies; linearity where it claims it. */
#include "term/selftest_parts.h"

#include "term/block.h"
#include "term/entry.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Relative to the norm of the block; complex step is exact to round-off, differences are not. */
#define EXACT       1e-12
#define DIFFERENCES 1e-6

static void compare_block(bench *k, uint32_t o, uint32_t i, const char *how, double tolerance)
{
    const pf_slot *out = &k->t->out[o], *in = &k->t->in[i];
    int rows = bench_components(k, out), cols = bench_components(k, in);
    const double *given = k->jac[o * k->t->n_in + i], *truth = k->truth[o * k->t->n_in + i];
    size_t n = (size_t)(rows * cols * BENCH_LD);
    double size = block_norm(truth, n), e = block_distance(given, truth, 1, n);
    char why[200], entry[900];

    if (e <= tolerance * size || (size == 0 && e == 0)) {
        bench_line(k, 1, "%s  d %s / d %s in %dD: analytic = %s to %.1e", k->t->name, out->name, in->name, k->dim,
                   how, size > 0 ? e / size : 0);
        return;
    }
    block_diagnose(given, truth, rows, cols, BENCH_LD, why, sizeof why);
    for (int kept = 0; kept < 2 && in->shape == PF_TENSOR && strncmp(why, "wrong", 5) == 0; kept++)
        if (block_exchanged_distance(given, truth, rows, k->dim, BENCH_LD, kept) < 1e-6 * size)
            snprintf(why, sizeof why, "transpose: the %stwo indices of %s %s", kept ? "part with the " : "",
                     in->name, kept ? "exchanged is missing" : "are exchanged");
    entry_first_wrong(k, o, i, given, truth, tolerance, entry, sizeof entry);
    bench_line(k, 0, "%s  d %s / d %s in %dD: %s%s%s", k->t->name, out->name, in->name, k->dim, why,
               *entry ? "; first wrong entry: " : "", entry);
}

/* Lanes that are no points count for nothing. */
static void clear_repeated(double *block, int rows)
{
    for (int r = 0; r < rows; r++)
        memset(block + r * BENCH_LD + BENCH_N, 0, (BENCH_LD - BENCH_N) * sizeof *block);
}

static size_t block_size(const bench *k, uint32_t o, uint32_t i)
{
    return (size_t)(bench_components(k, &k->t->out[o]) * bench_components(k, &k->t->in[i]) * BENCH_LD);
}

/* 1 if there is such a derivative: memory is kept, not solved for. */
static int has_block(const pf_term *t, uint32_t o, uint32_t i)
{
    return term_is_derived(&t->in[i]) && t->out[o].eval != PF_STATE;
}

int selftest_derive(bench *k, enum term_derivative how, double **jac, const char *what)
{
    const pf_term *t = k->t;
    double *given[TERM_MAX_SLOTS * TERM_MAX_SLOTS];
    int status;

    for (uint32_t o = 0; o < t->n_out; o++)
        for (uint32_t i = 0; i < t->n_in; i++) {
            memset(jac[o * t->n_in + i], 0, block_size(k, o, i) * sizeof(double));
            given[o * t->n_in + i] = term_is_derived(&t->in[i]) ? jac[o * t->n_in + i] : NULL;
        }
    bench_enter(k, what);
    status = term_jacobian(t, how, &k->b, (const double *const *)k->in, given, k->room);
    if (!bench_left(k, what))
        return 0;
    if (status)
        bench_line(k, 0, "%s  %s returned %d: %s", t->name, what, status,
                   k->report.status ? k->report.text : "without saying why");
    for (uint32_t j = 0; j < t->n_out * t->n_in; j++)
        clear_repeated(jac[j], (int)(block_size(k, j / t->n_in, j % t->n_in) / BENCH_LD));
    return status == 0;
}

/* 1 if the complex step (in truth) and differences agree: the twin is an analytic function. */
static int twin_derives(bench *k)
{
    const pf_term *t = k->t;

    if (!selftest_derive(k, TERM_FD, k->jac, "differences"))
        return 0;
    for (uint32_t o = 0; o < t->n_out; o++)
        for (uint32_t i = 0; i < t->n_in; i++) {
            size_t n = block_size(k, o, i);
            const double *a = k->truth[o * t->n_in + i], *b = k->jac[o * t->n_in + i];
            char entry[900];

            if (has_block(t, o, i) && !(block_distance(a, b, 1, n) <= 1e-3 * block_norm(b, n) + 1e-6)) {
                entry_first_wrong(k, o, i, a, b, 1e-3, entry, sizeof entry);
                bench_line(
                    k, 0,
                    "%s  d %s / d %s in %dD: residual_c does not carry the derivative (norm %.6g, by differences "
                    "%.6g): %s; has it fabs, a real part or a real variable in it?",
                    t->name, t->out[o].name, t->in[i].name, k->dim, block_norm(a, n), block_norm(b, n), entry);
                return 0;
            }
        }
    return 1;
}

/* What the term says to be no coupling is none. */
static void test_depends(bench *k)
{
    const pf_term *t = k->t;

    for (uint32_t o = 0; o < t->n_out && t->depends; o++)
        for (uint32_t i = 0; i < t->n_in; i++) {
            const double *truth = k->truth[o * t->n_in + i];
            char entry[900];

            if (!has_block(t, o, i) || t->depends[o * t->n_in + i] || block_norm(truth, block_size(k, o, i)) == 0)
                continue;
            memset(k->jac[o * t->n_in + i], 0, block_size(k, o, i) * sizeof(double));
            entry_first_wrong(k, o, i, k->jac[o * t->n_in + i], truth, 0, entry, sizeof entry);
            bench_line(k, 0,
                       "%s  \"%s\" depends on \"%s\", but depends[%u][%u] says it does not: undeclared dependency; "
                       "%s",
                       t->name, t->out[o].name, t->in[i].name, o, i, entry);
        }
}

static void test_jacobian(bench *k)
{
    const pf_term *t = k->t;
    const char *how = t->residual_c ? "complex step" : "differences";
    int unknowns = 0;

    for (uint32_t i = 0; i < t->n_in; i++)
        unknowns += term_is_derived(&t->in[i]);
    if (!unknowns || !selftest_derive(k, t->residual_c ? TERM_COMPLEX : TERM_FD, k->truth, how))
        return;
    /* states of cases lie in kinks, as |u| has at rest, of which differences say nothing */
    if (t->residual_c && !k->captured && !twin_derives(k))
        return;
    test_depends(k);
    if (t->jacobian && !selftest_derive(k, TERM_ANALYTIC, k->jac, "Jacobian"))
        return;
    for (uint32_t o = 0; o < t->n_out; o++)
        for (uint32_t i = 0; i < t->n_in; i++)
            if (has_block(t, o, i) && t->jacobian)
                compare_block(k, o, i, how, t->residual_c ? EXACT : DIFFERENCES);
            else if (has_block(t, o, i))
                bench_line(k, 1, "%s  d %s / d %s in %dD: by %s", t->name, t->out[o].name, t->in[i].name, k->dim,
                           how);
}

static void test_linearity(bench *k)
{
    const pf_term *t = k->t;
    enum term_derivative how = t->residual_c ? TERM_COMPLEX : TERM_FD;
    const double tolerance = t->residual_c ? 1e-12 : 1e-5;

    if (!(t->flags & PF_LINEAR) || k->captured)
        return;
    if (!selftest_derive(k, how, k->truth, "derivative"))
        return;
    bench_random_state(k);
    if (!selftest_derive(k, how, k->jac, "derivative"))
        return;
    for (uint32_t j = 0; j < t->n_out * t->n_in; j++) {
        const uint32_t o = j / t->n_in, i = j % t->n_in;
        size_t n = block_size(k, o, i);
        char entry[900];

        if (!has_block(t, o, i) || !term_is_unknown(&t->in[i]) ||
            block_distance(k->jac[j], k->truth[j], 1, n) <= tolerance * (block_norm(k->truth[j], n) + 1e-300))
            continue;
        entry_first_wrong(k, o, i, k->jac[j], k->truth[j], tolerance, entry, sizeof entry);
        bench_line(k, 0, "%s  is flagged PF_LINEAR, but d %s / d %s changes with the state: %s", t->name,
                   t->out[o].name, t->in[i].name, entry);
        return;
    }
    bench_line(k, 1, "%s  linear in %dD, as flagged", t->name, k->dim);
}

void selftest_jacobian(bench *k)
{
    if (term_kind(k->t) == TERM_SHOWS)
        return;
    test_jacobian(k);
    test_linearity(k);
}
