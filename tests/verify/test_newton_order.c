/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Newton's method on the shipped cases: what it costs, and that none is suspected of a wrong Jacobian. */
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <string.h>

static void no_suspicion(ran r, const char *what)
{
    if (r.code != 0 || strstr(r.err, "Jacobian"))
        fail_msg("%s: exit code %d\n%s", what, r.code, r.err);
}

static void shipped_cases_are_not_suspected_of_a_wrong_jacobian(void **state)
{
    static const char *const run[] = {"cavity2d",
                                      "cavity2d.lua --set re=400",
                                      "cavity2d.lua --set re=1000",
                                      "cavity3d",
                                      "channel",
                                      "kovasznay",
                                      "fixed_disk",
                                      "fixed_sphere.lua --set n=6",
                                      "cylinder2d",
                                      "falling_disk.lua --set stop=0.1",
                                      "two_disks.lua --set stop=0.05",
                                      "backward_step.lua --set n=8",
                                      "taylor_green3d.lua --set n=4 --set stop=0.2",
                                      "cylinder2d.lua --set case=2D-3 --set stop=0.03",
                                      "disk_re450.lua --set stop=0.01",
                                      "dkt_re450.lua --set stop=0.01",
                                      "couette_migration.lua --set stop=1",
                                      "poiseuille_migration.lua --set stop=5",
                                      "falling_disk.lua --set stop=0.05 --set formulation=conservative"};

    (void)state;
    for (size_t i = 0; i < sizeof run / sizeof *run; i++)
        no_suspicion(plugflow("run cases/%s%s --out %s/run", run[i], strchr(run[i], '.') ? "" : ".lua", scratch()),
                     run[i]);
}

static void the_example_is_not_suspected_of_a_wrong_jacobian(void **state)
{
    (void)state;
    assert_ran(shell("cc -std=gnu11 -O2 -fPIC -shared -I include "
                     "examples/scalar_transport/scalar_transport.c -o %s/scalar_transport.so",
                     scratch()),
               0, NULL);
    no_suspicion(plugflow("run examples/scalar_transport/heated_cavity.lua --set n=24 --set ra=1e5 --plugin "
                          "%s/scalar_transport.so --out %s/hot",
                          scratch(), scratch()),
                 "heated_cavity");
}

/* As many matrices as steps; one residual more to begin with, one for the last correction, one for the output.  At
 * Re = 400 one step is halved: what was evaluated at its whole length is lost. */
static void an_iteration_takes_one_evaluation(void **state)
{
    double n;

    (void)state;
    assert_ran(plugflow("run cases/cavity2d.lua --quiet --set re=100 --out %s/cost", scratch()), 0, NULL);
    n = summary("cost", "newton_iterations");
    assert_between(summary("cost", "matrices"), n, n);
    assert_between(summary("cost", "evaluations"), n + 1, n + 3);
    assert_ran(plugflow("run cases/cavity2d.lua --quiet --set re=400 --out %s/cost", scratch()), 0, NULL);
    n = summary("cost", "newton_iterations");
    assert_between(summary("cost", "matrices"), n, n + 1);
    assert_between(summary("cost", "evaluations"), n + 1, n + 6);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shipped_cases_are_not_suspected_of_a_wrong_jacobian),
        cmocka_unit_test(the_example_is_not_suspected_of_a_wrong_jacobian),
        cmocka_unit_test(an_iteration_takes_one_evaluation),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
