/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Terms that give Newton's method or the user a hard time (tests/abi/troubles.c), and what the program says. */
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>
#include <string.h>

#define PLUGIN "--plugin \"$PLUGFLOW_BUILD/tests/abi/troubles.so\""
#define CHANNEL                                                                                                    \
    "mesh { box = {{0,0},{1,1}}, cells = {2,8} }\nfluid { density = 1, viscosity = 1 }\n"                          \
    "term 'continuity' {}\nboundary { periodic = {'left', 'right'} }\nboundary '*' { u = {0,0} }\n"

static const char *channel(const char *name, const char *more)
{
    char text[2000];

    snprintf(text, sizeof text, CHANNEL "%s", more);
    return put_file(name, text);
}

/* At rest the law is 0 times infinity, or has a derivative that is 0/0 beside a residual of zero. */
static void a_law_that_is_no_number_at_rest_is_no_success(void **state)
{
    const char *path = channel("law.lua", "term 'momentum' { without = {'viscous'}, force = {1,0} }\n"
                                          "term 'troubles.power_law' { n = param('n', 0.5) }\n");

    (void)state;
    assert_ran(plugflow("run %s " PLUGIN " --out %s/law", path, scratch()), 5,
               "term troubles.power_law: output \"grad_v\" is", "nan at x = (");
    assert_ran(plugflow("run %s " PLUGIN " --set n=1.5 --out %s/law", path, scratch()), 5,
               "term troubles.power_law: derivative of \"grad_v\" by \"grad_u\" is", "nan at x = (");
}

/* u = 4 y (1 - y) is in the space, and the rate |4 - 8 y| is linear in every cell: exact. */
static void a_rate_that_the_flow_gives_does_not_stop_newton(void **state)
{
    const char *path = channel("rate.lua", "term 'momentum' { force = {8,0} }\nterm 'troubles.rate' {}\n"
                                           "output { probes = { wall = {0.5, 0}, q = {0.5, 0.25} } }\n"
                                           "results(function(r) return { wall = r.last['wall.rate'], "
                                           "q = r.last['q.rate'] } end)\n");

    (void)state;
    assert_ran(plugflow("run %s " PLUGIN " --out %s/rate", path, scratch()), 0, "converged in 2 iterations");
    assert_between(summary("rate", "results.wall"), 4 - 1e-10, 4 + 1e-10);
    assert_between(summary("rate", "results.q"), 2 - 1e-10, 2 + 1e-10);
}

static void a_term_that_does_not_come_back_is_named_by_the_signals(void **state)
{
    const char *path = channel("endless.lua", "term 'momentum' {}\nterm 'troubles.endless' {}\n");

    (void)state;
    assert_ran(shell("sh -c '\"$PLUGFLOW_PROGRAM\" run %s " PLUGIN " --threads 1 --out %s/endless & p=$!; sleep 1; "
                     "kill -TERM $p; sleep 3; kill -TERM $p; wait $p; echo code $?'",
                     path, scratch()),
               0, "the run ends after this step (inside term troubles.endless, residual); another signal",
               "ended at once by a second signal (inside term troubles.endless, residual)", "code 143");
}

static void a_file_that_is_not_called_like_its_plugin_is_told(void **state)
{
    ran r;

    (void)state;
    assert_int_equal(shell("cp \"$PLUGFLOW_BUILD/tests/abi/memory.so\" %s/other.so", scratch()).code, 0);
    assert_ran(plugflow("test %s/other.so", scratch()), 5,
               "WRONG  the file other.so holds a plugin \"memory\": they must have the same name", " 1 failed");
    r = plugflow("test momentum");
    assert_ran(r, 0, "0 failed");
    assert_null(strstr(r.out, "the file"));
}

static void fields_that_cannot_be_written_are_told_from_slips(void **state)
{
    const char *path = channel("fields.lua", "term 'momentum' {}\nterm 'troubles.rate' {}\nterm 'troubles.one' {}\n"
                                             "output { fields = {'theta', 'rat'} }\n");
    ran r = plugflow("check %s " PLUGIN, path);

    (void)state;
    assert_ran(r, 3, "\"theta\" (a number) is not a field of the mesh", "did you mean \"rate\"?");
    assert_null(strstr(r.err, "did you mean \"theta\""));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_law_that_is_no_number_at_rest_is_no_success),
        cmocka_unit_test(a_rate_that_the_flow_gives_does_not_stop_newton),
        cmocka_unit_test(a_term_that_does_not_come_back_is_named_by_the_signals),
        cmocka_unit_test(a_file_that_is_not_called_like_its_plugin_is_told),
        cmocka_unit_test(fields_that_cannot_be_written_are_told_from_slips),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
