/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "support/opened.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

enum { THREADS = 2 };

static opened *open_on(const char *path, const char *const *sets, int n, int n_thread)
{
    opened *k = calloc(1, sizeof *k);

    assert_non_null(k);
    if (case_load(&k->c, path, sets, n, NULL, &k->err) || registry_create(&k->r, NULL, 0, &k->err) ||
        problem_create(&k->p, &k->c, &k->r, n_thread, &k->err))
        fail_msg("%s %s: %s", path, n ? sets[0] : "", k->err.text);
    return k;
}

opened *open_case(const char *path, const char *const *sets, int n)
{
    return open_on(path, sets, n, THREADS);
}

static opened *write_and_open(const char *text, const char *const *sets, int n, int n_thread)
{
    const char *folder = getenv("TMPDIR");
    char path[400];
    opened *k;
    FILE *file;
    int fd;

    snprintf(path, sizeof path, "%.300s/case-XXXXXX.lua", folder && *folder ? folder : "/tmp");
    fd = mkstemps(path, 4);
    file = fd < 0 ? NULL : fdopen(fd, "w");
    if (!file)
        fail_msg("cannot write %s", path);
    fputs(text, file);
    fclose(file);
    k = open_on(path, sets, n, n_thread);
    unlink(path);
    return k;
}

opened *open_text(const char *text, const char *const *sets, int n)
{
    return write_and_open(text, sets, n, THREADS);
}

opened *open_text_on(const char *text, int n_thread)
{
    return write_and_open(text, NULL, 0, n_thread);
}

void close_case(opened *k)
{
    problem_destroy(&k->p);
    case_destroy(&k->c);
    registry_destroy(&k->r);
    free(k);
}

void fill_random(double *x, int64_t n, uint64_t seed)
{
    uint64_t z = seed * 0x9e3779b97f4a7c15u + 1;

    for (int64_t i = 0; i < n; i++) {
        z = z * 6364136223846793005u + 1442695040888963407u;
        x[i] = (double)(z >> 11) / 4503599627370496.0 - 1;
    }
}
