/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Steps that choose their length: the error that they were asked for, jumps, landing, and what Newton's method
 * costs. */
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static double run(const char *arguments, const char *key)
{
    assert_ran(plugflow("run %s --quiet --threads 1 --out %s/o", arguments, scratch()), 0, NULL);
    return summary("o", key);
}

/* Over three decades; the flow's own scales of time are 1/2 and more. */
static void the_error_is_the_tolerance(void **state)
{
    double error[4];

    (void)state;
    for (int k = 0; k < 4; k++) {
        double tolerance = pow(10, -1 - k);
        char arguments[200];

        snprintf(arguments, sizeof arguments, "tests/verify/adaptive2d.lua --set tolerance=%g --set n=%d",
                 tolerance, k < 3 ? 16 : 24);
        error[k] = run(arguments, "errors.u.l2") / summary("o", "errors.u.l2_exact");
        print_message("# tolerance %g: error %.3g in %g steps\n", tolerance, error[k], summary("o", "steps"));
        assert_between(error[k] / tolerance, 1.0 / 3, 3);
    }
    assert_between(log10(error[0] / error[3]) / 3, 0.9, 1.1);
}

static void a_jump_is_caught(void **state)
{
    double *t, before = 0, after = 10;
    char path[400];
    int n;

    (void)state;
    assert_between(run("tests/verify/inflow_jump.lua", "results.u"), 1.999, 2.001);
    assert_between(summary("o", "adaptive.jumps"), 1, 3);
    snprintf(path, sizeof path, "%s/o/probes.csv", scratch());
    n = csv_column(path, "t", &t);
    assert_int_equal(n, 21); /* the start, and twenty rows where they were asked for */
    for (int i = 0; i < n; i++)
        assert_between(t[i] - 0.1 * i, -1e-12, 1e-12);
    free(t);
    /* the step that holds the jump is short: the flow knows when it was */
    assert_ran(shell("grep '\"event\": \"solve\"' %s/o/run.jsonl | sed 's/.*\"t\": \\([^,]*\\),.*/\\1/' > %s/t.csv",
                     scratch(), scratch()),
               0, NULL);
    snprintf(path, sizeof path, "%s/t.csv", scratch());
    {
        FILE *f = fopen(path, "r");
        double now;

        assert_non_null(f);
        while (fscanf(f, "%lf", &now) == 1) {
            before = now < 0.4123 && now > before ? now : before;
            after = now >= 0.4123 && now < after ? now : after;
        }
        fclose(f);
    }
    assert_between(after - before, 0, 1e-4);
}

static void a_run_ends_when_the_flow_is_steady(void **state)
{
    (void)state;
    assert_between(run("tests/verify/towards_steady.lua", "results.u"), 0.9999, 1.0001);
    assert_between(summary("o", "stopped_at"), 1.5, 6);
    assert_between(summary("o", "steady_change"), 0, 1e-4);
    assert_ran(plugflow("run tests/verify/towards_steady.lua --set at_most=1 --out %s/o", scratch()), 0,
               "the flow is not steady at t = 1 (at_most)");
}

static void two_runs_are_the_same(void **state)
{
    (void)state;
    for (int k = 0; k < 2; k++)
        assert_ran(
            plugflow("run cases/falling_disk.lua --set tolerance=1e-2 --set n=8 --set stop=0.2 --quiet --threads 2 "
                     "--out %s/r%d",
                     scratch(), k),
            0, NULL);
    assert_ran(
        shell("cmp %s/r0/particles.csv %s/r1/particles.csv && cmp %s/r0/fields_00005.vtu %s/r1/fields_00005.vtu",
              scratch(), scratch(), scratch(), scratch()),
        0, NULL);
}

/* From rest to rest on the floor.  17.454 is the value of the finest run with steps of 2.5 ms, 24 cells per cm. */
static void a_disk_falls_in_few_steps(void **state)
{
    (void)state;
    assert_between(run("cases/falling_disk.lua --set tolerance=1e-3", "results.re_max") / 17.454, 0.998, 1.002);
    print_message("# %g steps, %g matrices\n", summary("o", "steps"), summary("o", "matrices"));
    assert_between(summary("o", "steps"), 20, 130);
    assert_between(summary("o", "results.y"), 0.12, 0.19);
    assert_between(summary("o", "steps_halved"), 0, 0);
}

/* Newton's method stops when what is left is small against the error of the step: it costs one matrix. */
static void a_step_costs_one_matrix(void **state)
{
    double economic = run("cases/falling_disk.lua --set stop=0.3", "results.re_max");
    char arguments[500];

    (void)state;
    assert_between(summary("o", "matrices") / summary("o", "steps"), 1, 1.3);
    snprintf(arguments, sizeof arguments, "%s --set stop=0.3", strict("cases/falling_disk.lua"));
    assert_between(economic / run(arguments, "results.re_max") - 1, -5e-5, 5e-5);
    assert_between(summary("o", "matrices") / summary("o", "steps"), 2, 5);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_error_is_the_tolerance),         cmocka_unit_test(a_jump_is_caught),
        cmocka_unit_test(a_run_ends_when_the_flow_is_steady), cmocka_unit_test(two_runs_are_the_same),
        cmocka_unit_test(a_disk_falls_in_few_steps),          cmocka_unit_test(a_step_costs_one_matrix),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
