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
    /* Before and after every call of a plugin's function: what of it; afterwards `what` is NULL.  May be NULL. */
    void (*enter)(void *ctx, const char *plugin, const char *term, const char *what);
    void *ctx;
} selftest;

/* Tests all terms of the plugin, or the one called `only`. */
int selftest_run(selftest *s, const term_plugin *p, const char *only, error *err);
/* The same on points, values and parameters of a case, of which a batch is given: only what is wrong is told.
 * *some: 0 if the term cannot be computed there. */
int selftest_batch(selftest *s, const term_use *use, const pf_batch *b, const double *const *in, int *some,
                   error *err);

#endif
