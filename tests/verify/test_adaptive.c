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

/* Where all fluid is near a body that moves as it is told, and where it is near one that stands. */
static void fluid_near_bodies_is_measured(void **state)
{
    (void)state;
    for (int k = 0; k < 2; k++) {
        char arguments[200];
        double exact, adaptive;

        snprintf(arguments, sizeof arguments, "tests/verify/stirrer.lua --set motion=%s --set dt=0.02",
                 k ? "fixed" : "prescribed");
        exact = run(arguments, "results.v");
        snprintf(arguments, sizeof arguments, "tests/verify/stirrer.lua --set motion=%s",
                 k ? "fixed" : "prescribed");
        adaptive = run(arguments, "results.v");
        print_message("# v %.4f, with steps of 0.02 %.4f; %g steps\n", adaptive, exact, summary("o", "steps"));
        assert_between(adaptive / exact, 0.97, 1.03);
        assert_between(summary("o", "steps"), 20, 300);
    }
}

/* Dates of files and rows that meet but for round-off are one; so no step is made from one to the other. */
static void dates_that_nearly_meet_are_one(void **state)
{
    static const char *const steps[] = {"tolerance = 1e-2", "step = 0.05"};

    (void)state;
    for (int k = 0; k < 2; k++) {
        char text[1000];

        snprintf(text, sizeof text,
                 "mesh { box = {{0, 0}, {1, 1}}, cells = {4, 4} }\nfluid { density = 1, viscosity = 0.1 }\n"
                 "term 'continuity' {}\nterm 'momentum' {}\nboundary '*' { u = {0, 0} }\n"
                 "boundary 'top' { u = function(x, y, t) return math.sin(t), 0 end }\n"
                 "time { %s, stop = 4 }\n"
                 "output { every = 1, tables_every = 0.333333333, probes = { p = {0.5, 0.5} } }\n",
                 steps[k]);
        assert_ran(plugflow("run %s --quiet --out %s/o", put_file("dates.lua", text), scratch()), 0, NULL);
        assert_between(summary("o", "steps"), 10, k ? 92 : 200);
        assert_ran(shell("grep -c timestep %s/o/fields.pvd", scratch()), 0, "5");
        assert_ran(shell("grep '\"dt\"' %s/o/run.jsonl | sed 's/.*\"dt\": \\([^,]*\\),.*/\\1/' | awk '$1 < 1e-4 { "
                         "print; bad = "
                         "1 } END { exit bad }'",
                         scratch()),
                   0, NULL);
    }
}

static void a_short_first_step_does_no_harm(void **state)
{
    (void)state;
    put_file("first.lua",
             "mesh { box = {{0, 0}, {1, 1}}, cells = {4, 4} }\nfluid { density = 1, viscosity = 0.1 }\n"
             "term 'continuity' {}\nterm 'momentum' {}\nboundary '*' { u = {0, 0} }\n"
             "boundary 'top' { u = {param('lid', 1), 0} }\n"
             "time { tolerance = 1e-2, step = 1e-7, stop = 'steady', at_most = 100 }\n"
             "output { probes = { p = {0.5, 0.5} } }\nresults(function(r) return { u = r.last['p.u'] } end)\n");
    assert_ran(plugflow("run %s/first.lua --quiet --out %s/o", scratch(), scratch()), 0, NULL);
    assert_between(summary("o", "results.u"), -0.22, -0.19);
    assert_between(summary("o", "stopped_at"), 0.5, 50);
    /* at rest nothing drives the steps, and nothing is steady that has not begun */
    assert_ran(plugflow("run %s/first.lua --quiet --set lid=0 --out %s/o", scratch(), scratch()), 0,
               "is not steady");
    assert_between(summary("o", "steps"), 1, 100);
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
        cmocka_unit_test(the_error_is_the_tolerance),      cmocka_unit_test(a_jump_is_caught),
        cmocka_unit_test(fluid_near_bodies_is_measured),   cmocka_unit_test(dates_that_nearly_meet_are_one),
        cmocka_unit_test(a_short_first_step_does_no_harm), cmocka_unit_test(a_run_ends_when_the_flow_is_steady),
        cmocka_unit_test(two_runs_are_the_same),           cmocka_unit_test(a_disk_falls_in_few_steps),
        cmocka_unit_test(a_step_costs_one_matrix),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
