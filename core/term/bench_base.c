/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What all parts of the bench use: lines of the report, sizes, random numbers. */
#include "term/bench.h"

#include "base/random.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

void bench_line(bench *k, int ok, const char *fmt, ...)
{
    char text[1500];
    va_list ap;
    size_t n;

    if (ok && k->quiet)
        return;
    va_start(ap, fmt);
    vsnprintf(text, sizeof text, fmt, ap);
    va_end(ap);
    n = strlen(text);
    if (!ok)
        snprintf(text + n, sizeof text - n, "%s", k->drawn);
    *(ok ? &k->s->passed : &k->s->failed) += 1;
    k->s->line(k->s->ctx, ok, text);
}

int bench_components(const bench *k, const pf_slot *s)
{
    return term_components(s->shape, k->dim);
}

double bench_number(bench *k, double low, double high)
{
    return low + (high - low) * random_next(&k->random);
}
