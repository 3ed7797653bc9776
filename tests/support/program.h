/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * program.h -- runs the program as its user does, for tests. */
#ifndef SUPPORT_PROGRAM_H
#define SUPPORT_PROGRAM_H

#include <stddef.h>

typedef struct ran {
    int code;        /* exit code, or 128 + signal */
    char *out, *err; /* what it printed; valid until the next run */
} ran;

/* Runs `plugflow ARGS` (split by a shell) in the source folder; a printf format. */
ran plugflow(const char *fmt, ...) __attribute__((format(printf, 1, 2)));
/* Any command line. */
ran shell(const char *fmt, ...) __attribute__((format(printf, 1, 2)));

/* A folder of this test for its files, empty at the start. */
const char *scratch(void);
/* Writes text into scratch()/name; returns the path (valid until the fourth next call). */
const char *put_file(const char *name, const char *text);

/* A copy of a case, in scratch(), whose steps are solved to round-off. */
const char *strict(const char *path);

/* A number of scratch()/dir/summary.json by its keys, as in "errors.u.l2"; NAN if it is not there. */
double summary(const char *dir, const char *keys);
/* Column of a CSV file; returns the number of rows; *v is malloc'ed. */
int csv_column(const char *path, const char *column, double **v);
/* The same without the first row, which is of the start and not of a step. */
int step_column(const char *path, const char *column, double **v);

/* The test fails, with both numbers, unless low <= v <= high. */
#define assert_between(v, low, high) support_between(#v, (v), (low), (high), __FILE__, __LINE__)
void support_between(const char *what, double v, double low, double high, const char *file, int line);

/* The test fails unless the program ended with this code and printed all of these texts. */
#define assert_ran(r, code, ...)                                                                                   \
    support_ran((r), (code), (const char *const[]){__VA_ARGS__, NULL}, __FILE__, __LINE__)
void support_ran(ran r, int code, const char *const *texts, const char *file, int line);

#endif
