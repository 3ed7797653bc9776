/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * opened.h -- a case opened as the program opens it, for tests of what is inside. */
#ifndef SUPPORT_OPENED_H
#define SUPPORT_OPENED_H

#include "problem/problem.h"

typedef struct opened {
    case_file c;
    registry r;
    problem p;
    error err;
} opened;

/* Opens a case file with n parameters "name=value" set, on two threads; the test fails if that fails. */
opened *open_case(const char *path, const char *const *sets, int n);
/* The same for the text of a case. */
opened *open_text(const char *text, const char *const *sets, int n);
/* And on n threads. */
opened *open_text_on(const char *text, int n_thread);
void close_case(opened *k);

/* Reproducible numbers in [-1, 1]. */
void fill_random(double *x, int64_t n, uint64_t seed);

#endif
