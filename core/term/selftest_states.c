/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * States that random values never are: a fluid at rest, where every run starts, and scalars below zero, which an
 * iteration reaches on its way.  Roots, logarithms and quotients must have a value and a derivative there. */
#include "term/selftest_parts.h"

#include "term/entry.h"

#include <math.h>
#include <string.h>

/* First number of a point that is none, or -1. */
static int first_bad(const double *v, int rows)
{
    for (int i = 0; i < rows * BENCH_LD; i++)
        if (i % BENCH_LD < BENCH_N && !isfinite(v[i]))
            return i;
    return -1;
}

static const char *advice(const bench *k, int negative)
{
    (void)k;
    return negative ? "; where it makes sense for some values only, say which (.min, .max of the slot), or "
                      "FAIL(PF_RETRY, "
                      "...)"
                    : "; every run starts at rest: add a small number under the root or to the divisor (its square "
                      "root well above 1e-100, the complex step), or give the slot a range (.min, .max) without 0";
}

static const char *state_name(int negative)
{
    return negative ? "with scalars below 0" : "at rest (unknowns 0)";
}

/* 1 if there are values, and all are numbers. */
static int outputs_are_numbers(bench *k, int negative)
{
    int sound, status = bench_status(k, k->out, negative ? "residual below 0" : "residual at rest", &sound);

    if (status || !sound) /* it says itself that it has none there */
        return 0;
    for (uint32_t o = 0; o < k->t->n_out; o++) {
        const int i = first_bad(k->out[o], bench_components(k, &k->t->out[o]));
        char entry[160];

        if (i < 0)
            continue;
        bench_line(k, 0, "%s  %s is not a finite number in %dD %s%s", k->t->name,
                   entry_name(&k->t->out[o], k->dim, i / BENCH_LD, entry, sizeof entry), k->dim,
                   state_name(negative), advice(k, negative));
        return 0;
    }
    return 1;
}

static void derivatives_are_numbers(bench *k, enum term_derivative how, int negative)
{
    const pf_term *t = k->t;
    const char *what = how == TERM_COMPLEX ? "complex step" : "Jacobian";

    if (!selftest_derive(k, how, k->truth, what))
        return;
    for (uint32_t j = 0; j < t->n_out * t->n_in; j++) {
        const pf_slot *out = &t->out[j / t->n_in], *in = &t->in[j % t->n_in];
        const int rows = bench_components(k, out) * bench_components(k, in);

        if (!term_is_derived(in) || out->eval == PF_STATE || first_bad(k->truth[j], rows) < 0)
            continue;
        bench_line(k, 0, "%s  d %s / d %s (%s) is not a finite number in %dD %s%s", t->name, out->name, in->name,
                   what, k->dim, state_name(negative), advice(k, negative));
        return;
    }
}

/* Differences take values beside the state, which say nothing of it. */
static void derivatives(bench *k, int negative)
{
    const int before = k->s->failed;
    int unknowns = 0;

    for (uint32_t i = 0; i < k->t->n_in; i++)
        unknowns += term_is_derived(&k->t->in[i]);
    if (!unknowns || term_kind(k->t) == TERM_SHOWS)
        return;
    if (k->t->residual_c)
        derivatives_are_numbers(k, TERM_COMPLEX, negative);
    if (k->t->jacobian && k->s->failed == before)
        derivatives_are_numbers(k, TERM_ANALYTIC, negative);
}

void selftest_states(bench *k)
{
    const int before = k->s->failed;

    for (int negative = 0; negative < 2 && k->s->failed == before; negative++) {
        bench_random_inputs(k);
        bench_put_state(k, negative);
        if (outputs_are_numbers(k, negative))
            derivatives(k, negative);
    }
    bench_random_inputs(k);
    if (k->s->failed == before)
        bench_line(k, 1, "%s  at rest and with scalars below 0 in %dD: numbers, or refused", k->t->name, k->dim);
}
