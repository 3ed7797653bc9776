/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Reading blocks of a case, from inside. */
#include "support/opened.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define CAVITY                                                                                                     \
    "mesh { box = {{0,0},{1,1}}, cells = {2,2} }\nfluid { density = 1, viscosity = 1 }\n"                          \
    "term \"continuity\" {}\nterm \"momentum\" {}\nboundary \"*\" { u = {0, 0} }\n"

static void a_key_too_many_is_said_and_not_dropped(void **state)
{
    static char name[CASE_MAX_KEYS + 1][16];
    opened *k = open_text(CAVITY, NULL, 0);
    double v = 0;
    reader r;

    (void)state;
    reader_open(&r, &k->c, case_find(&k->c, "fluid", 0), "fluid");
    for (int i = 0; i <= CASE_MAX_KEYS; i++) {
        snprintf(name[i], sizeof name[i], "key%d", i);
        assert_int_equal(k->c.n_error, 0);
        reader_number(&r, name[i], "a number", 0, 0, &v);
    }
    assert_int_equal(k->c.n_error, 1);
    assert_non_null(strstr(k->c.errors.s, "more than 96 keys here, \"key96\" is one too many"));
    close_case(k);
}

/* The signal comes after the case was read: a later call of one of its functions ends with the signal's code. */
static void after_a_signal_short_functions_go_on_and_long_ones_end(void **state)
{
    static volatile sig_atomic_t stop;
    char path[] = "/tmp/case-XXXXXX";
    int fd = mkstemp(path);
    FILE *file = fd < 0 ? NULL : fdopen(fd, "w");
    case_file c;
    error err = {0};
    double x[3] = {0}, out;
    value v;
    reader r;

    (void)state;
    assert_non_null(file);
    fputs("initial { p = function(x, y) for i = 1, 1e7 * x do end return 4 end }\n", file);
    fclose(file);
    assert_int_equal(case_load(&c, path, NULL, 0, &stop, &err), 0);
    unlink(path);
    reader_open(&r, &c, case_find(&c, "initial", 0), "initial");
    assert_int_equal(reader_value(&r, "p", "pressure", 1, 2, &v), 1);
    assert_int_equal(value_at(&v, x, 0, &out, &err), 0);
    assert_true(out == 4);
    stop = SIGTERM;
    assert_int_equal(value_at(&v, x, 0, &out, &err), 0); /* a step goes on to its end */
    x[0] = 1;
    assert_int_equal(value_at(&v, x, 0, &out, &err), ERR_SIGNAL + SIGTERM);
    assert_int_equal(err.code, ERR_SIGNAL + SIGTERM);
    assert_non_null(strstr(err.text, "function \"p\" at (1, 0), t = 0:"));
    assert_non_null(strstr(err.text, "stopped by a signal"));
    assert_int_equal(lua_gettop(c.lua), 0);
    case_destroy(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_key_too_many_is_said_and_not_dropped),
        cmocka_unit_test(after_a_signal_short_functions_go_on_and_long_ones_end),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
