/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * selftest.h -- every block of a plugin in isolation: no mesh, no case, points with random values. */
#ifndef TERM_SELFTEST_H
#define TERM_SELFTEST_H

#include "term/term.h"

typedef struct selftest {
    int passed, failed;
    /* One line of the report; ok = 0: what is wrong. */
    void (*line)(void *ctx, int ok, const char *text);
    void *ctx;
} selftest;

/* Relative to the norm of the block; complex step is exact to round-off, differences are not. */
#define SELFTEST_EXACT       1e-12
#define SELFTEST_DIFFERENCES 1e-6

/* Tests all terms of the plugin, or the one called `only`. */
int selftest_run(selftest *s, const term_plugin *p, const char *only, error *err);

/* What turns the given block (rows x cols, [row][col][ld]) into the true one: "sign", "factor 2", "transpose",
 * "missing", or "" -- into text. */
void selftest_diagnose(const double *given, const double *truth, int rows, int cols, size_t ld, char *text,
                       size_t n);

#endif
