/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Reading a case into its description: memory that ends anywhere on the way is told, not taken for a key that is
 * absent. */
#include "support/opened.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

static long left = -1; /* allocations until one fails; negative: none does */

/* In place of the library's: all arenas come from here. */
__attribute__((visibility("default"))) void *aligned_alloc(size_t alignment, size_t size)
{
    void *p = NULL;

    if (left >= 0 && left-- == 0) {
        errno = ENOMEM;
        return NULL;
    }
    return posix_memalign(&p, alignment, size) ? NULL : p;
}

/* Everything that a case can say. */
static const char everything[] =
    "mesh { box = {{0,0},{2,1}}, cells = {{0, 0.5, 1, 2}, 8}, shape = 'quads', map = function(x, y) return x, y "
    "end }\n"
    "fluid { density = 1, viscosity = 0.1, gravity = {0, -1} }\n"
    "term 'continuity' {}\nterm 'momentum' { force = {1, 0}, jacobian = 'auto', without = {'convection'} }\n"
    "particulate 'sharp'\nterm 'contact.repulsion' { range = 0.1 }\n"
    "boundary { periodic = {'bottom', 'top'} }\nboundary 'left' { u = {1, free} }\nboundary '*' { traction = {1, "
    "0} }\n"
    "particle { shape = disk { radius = 0.1 }, density = 2, at = {0.5, 0.5}, hold = {'x'}, motion = 'free' }\n"
    "particles { n = 3, shape = ellipse { a = 0.05, b = 0.04 }, density = 2, inside = {{1, 0}, {2, 1}} }\n"
    "initial { u = function(x, y) return x, y end, p = 1 }\nexact { p = 2 }\n"
    "time { step = 0.1, stop = 1, scheme = 'bdf1' }\n"
    "output { every = 0.1, fields = {'u'}, probes = { a = {1, 1} }, forces = {'left'},\n"
    "         lines = { b = { from = {0, 0}, to = {1, 1}, points = 3 } } }\n"
    "solve { tolerance = 1e-9 }\n";

/* Status of reading the case when allocation k fails (negative: none); *n: how many it takes. */
static int read_case(const char *path, registry *r, long k, long *n)
{
    static case_file c;
    description d;
    warning_list w = {0};
    error err = {0};
    int status;

    assert_int_equal(case_load(&c, path, NULL, 0, NULL, &err), 0);
    left = k < 0 ? 1000000 : k;
    status = describe(&d, &c, r, &w, &err);
    if (!status)
        status = case_finish(&c, &err);
    if (n)
        *n = 1000000 - left;
    left = -1;
    if (status && status != ERR_MEMORY)
        print_error("%s\n", err.text);
    describe_destroy(&d);
    warning_free(&w);
    case_destroy(&c);
    return status;
}

static void memory_that_ends_while_a_case_is_read_is_told(void **state)
{
    const char *folder = getenv("TMPDIR");
    registry r;
    error err;
    char path[400];
    long n = 0;
    FILE *f;

    (void)state;
    snprintf(path, sizeof path, "%.300s/describe-%ld.lua", folder && *folder ? folder : "/tmp", (long)getpid());
    f = fopen(path, "w");
    assert_non_null(f);
    fputs(everything, f);
    fclose(f);
    assert_int_equal(registry_create(&r, NULL, 0, &err), 0);
    assert_int_equal(read_case(path, &r, -1, NULL), 0); /* loads the plugins */
    assert_int_equal(read_case(path, &r, -1, &n), 0);
    assert_in_range(n, 50, 1000);
    for (long k = 0; k < n; k++) {
        int status = read_case(path, &r, k, NULL);

        if (status != ERR_MEMORY)
            fail_msg("allocation %ld of %ld fails: status %d, expected %d", k, n, status, ERR_MEMORY);
    }
    remove(path);
    registry_destroy(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(memory_that_ends_while_a_case_is_read_is_told),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
