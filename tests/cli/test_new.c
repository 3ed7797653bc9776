/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * plugflow new, outside of the source: from nothing to a run, and what is said when it cannot be. */
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

/* The commands that a new author types, in an empty folder. */
static void makes_a_plugin_that_runs(const char *name, const char *options)
{
    assert_ran(shell("cd '%s' && \"$PLUGFLOW_PROGRAM\" new %s %s && "
                     "\"$PLUGFLOW_PROGRAM\" build %s && \"$PLUGFLOW_PROGRAM\" test ./%s/%s.so && "
                     "\"$PLUGFLOW_PROGRAM\" run %s/%s.lua --plugin ./%s/%s.so --threads 1 --out out_%s",
                     scratch(), name, options, name, name, name, name, name, name, name, name),
               0, "plugflow build", ", 0 failed", "ok");
}

static void from_nothing_to_a_run_in_four_commands_and_half_a_minute(void **state)
{
    const time_t from = time(NULL);

    (void)state;
    makes_a_plugin_that_runs("n_heat", "");
    assert_between(difftime(time(NULL), from), 0, 30);
}

static void there_is_a_plugin_for_every_place(void **state)
{
    static const char *const on[] = {"cells", "fluid", "solid", "facets", "surface", "bodies", "pairs"};

    (void)state;
    for (size_t i = 0; i < sizeof on / sizeof *on; i++) {
        char name[40], options[40];

        snprintf(name, sizeof name, "n_%s", on[i]);
        snprintf(options, sizeof options, "--on %s", on[i]);
        makes_a_plugin_that_runs(name, options);
    }
}

static void fields_may_be_known_or_new(void **state)
{
    (void)state;
    makes_a_plugin_that_runs("n_carried", "--fields u,T");
    makes_a_plugin_that_runs("n_salt", "--fields u,salt:scalar:1");
    makes_a_plugin_that_runs("n_swirl", "--fields swirl:vector:2");
}

static void a_line_of_weak_form_is_a_plugin(void **state)
{
    (void)state;
    makes_a_plugin_that_runs("n_stokes",
                             "--weak 'rho*dot(dt(u), v) + mu*inner(grad(u) + transpose(grad(u)), grad(v))'");
    makes_a_plugin_that_runs("n_lorentz", "--weak 'dot(cross(vector(field), u), v)'");
    makes_a_plugin_that_runs("n_law", "--weak 'k = k0*(1 + beta*abs(T)^1.5); k*dot(grad(T), grad(s)) - "
                                      "max(q0, tanh(T))*s/(1 + exp(-T)) + min(T, 2)*log(1 + T^2)*s'");
}

static void refuses(const char *arguments, int code, const char *text)
{
    assert_ran(shell("cd '%s' && \"$PLUGFLOW_PROGRAM\" new %s", scratch(), arguments), code, text);
}

static void what_cannot_be_is_refused(void **state)
{
    (void)state;
    assert_int_equal(shell("mkdir -p '%s/n_there'", scratch()).code, 0);
    refuses("n_there", 7, "n_there exists already; nothing is written over it");
    refuses("9lives", 2, "begins with a letter");
    refuses("momentum", 2, "there is a plugin \"momentum\" already");
    refuses("n_x --on cel", 2, "expected cells, fluid");
    refuses("n_x --fields w", 2, "as in w:scalar:2");
    refuses("n_x --fields w:scalar:3", 2, "with order 1 or 2");
    refuses("n_x --on pairs --weak 'T*s'", 2, "--weak and --fields are for");
    refuses("n_x --on facets --fields T", 2, "needs an equation inside, too");
    assert_ran(plugflow("build nowhere"), 7, "plugflow new NAME makes a folder");
}

static void a_wrong_form_is_shown_where_it_is_wrong(void **state)
{
    (void)state;
    refuses("n_x --weak 'rho*grad(u)'", 2, "the form is a tensor; it must be a scalar");
    refuses("n_x --weak 'T*s + grad(T)'", 2,
            "column 5: scalar + vector: expected two of one kind\n  T*s + grad(T)\n      ^");
    refuses("n_x --weak 'sqr(T)*s'", 2, "did you mean \"sqrt\"?");
    refuses("n_x --weak 'dot(u, T)*q'", 2, "column 1: dot(vector, scalar)");
    refuses("n_x --weak 's*s'", 2, "a product of two test functions");
    refuses("n_x --weak 'eta*inner(grad(u), grad(v))'", 2, "eta (of lambda) and v (of u)");
    refuses("n_x --weak 'T*s/0'", 2, "column 4: division by zero");
    refuses("n_x --weak 'T*s/(1 - 1)'", 2, "column 4: division by zero");
    refuses("n_x --weak '1e400*T*s'", 2, "column 1: the number is too large");
    refuses("n_x --weak 'T*s*1e300*1e300'", 2, "not finite");
    refuses("n_x --weak 'int*T*s'", 2, "column 1: \"int\" is not possible as a name");
    refuses("n_x --weak 'T*s*sqrt'", 2, "column 5: \"sqrt\" is not possible as a name");
    refuses("n_x --weak 'for = 2; for*T*s'", 2, "column 1: \"for\" is not possible as a name");
    refuses("n_x --fields while:scalar:2 --weak 'while*test(while)'", 2, "\"while\" is not possible as a name");
    refuses("n_x --weak 'k = property(k0); T*s'", 2, "column 1: the part \"k\" is not used");
    refuses("n_x --weak 'salt*test(salt)'", 2, "declare it with --fields salt:scalar:2");
    refuses("n_x --weak 'exp(s)'", 2, "not linear");
    refuses("n_x --weak 'T*T'", 2, "no test function");
    refuses("n_x --weak 'T*s + 1'", 2, "one side of \"+\" has a test function");
    refuses("n_x --weak '(T*s'", 2, "column 5: expected \")\"");
    refuses("n_x --weak 'T*s)'", 2, "column 4: expected the end");
    refuses("n_x --weak 'div(T)*s'", 2, "T is a scalar; expected a vector");
    refuses("n_x --weak 'grad(2*T)'", 2, "expected a field");
    refuses("n_x --weak ''", 2, "the form ends too early");
    refuses("n_x --weak 'T = 2; T*s'", 2, "has a meaning already");
    refuses("n_x --weak 'T*s - s*T'", 2, "the form is zero");
    refuses("n_x --weak 'T*s$'", 2, "column 4");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(from_nothing_to_a_run_in_four_commands_and_half_a_minute),
        cmocka_unit_test(there_is_a_plugin_for_every_place),
        cmocka_unit_test(fields_may_be_known_or_new),
        cmocka_unit_test(a_line_of_weak_form_is_a_plugin),
        cmocka_unit_test(what_cannot_be_is_refused),
        cmocka_unit_test(a_wrong_form_is_shown_where_it_is_wrong),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
