/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The block preconditioner: its answers are those of the factorisation, its iterations stay few over the range of
 * all numbers, it says what it is not for, and two runs give the same bytes. */
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#define LID "tests/verify/iterative.lua"

/* Runs a case with a solver, into scratch()/solver; accept: where Newton's iteration ends. */
static void solve(const char *path, const char *settings, const char *solver, double tolerance, double accept)
{
    const char *to = put_file("case.lua", "");

    assert_int_equal(shell("{ grep -v '^solve ' %s; printf '\\nsolve { solver = \"%s\", linear_tolerance = %g, "
                           "tolerance = %g }\\n'; "
                           "} > %s",
                           path, solver, tolerance, accept, to)
                         .code,
                     0);
    assert_ran(plugflow("run %s --quiet --threads 1 %s --out %s/%s", to, settings, scratch(), solver), 0, NULL);
}

/* Iterations for a right-hand side. */
static double iterations(const char *dir)
{
    return summary(dir, "gmres_iterations") / summary(dir, "matrices");
}

static void solver_in_use_is(const char *dir, const char *name)
{
    assert_int_equal(shell("grep -q '\"linear_solver\": \"%s\"' %s/%s/summary.json", name, scratch(), dir).code, 0);
}

/* The largest relative difference of results. */
static double difference(const char *const *keys)
{
    double most = 0;

    for (; *keys; keys++) {
        double a = summary("block", *keys), b = summary("umfpack", *keys);

        assert_true(isfinite(a) && isfinite(b) && b != 0);
        most = fmax(most, fabs(a - b) / fabs(b));
    }
    return most;
}

typedef struct flow {
    const char *path, *settings, *keys[4];
} flow;

/* Newton goes on to 1e-10, so that both stand at the solution. */
static void answers_are_those_of_the_factorisation(void **state)
{
    static const flow flows[] = {
        {LID, "--set n=6", {"results.u", "results.p"}},
        {LID, "--set n=6 --set shape=tets", {"results.u", "results.p"}},
        {LID, "--set n=6 --set ratio=0", {"results.u", "results.p"}},
        {LID, "--set n=5 --set count=1 --set radius=0.2", {"results.u", "results.p", "results.fall"}},
        {LID, "--set n=6 --set count=10 --set radius=0.12", {"results.u", "results.fall"}},
        {LID, "--set dim=2 --set n=24 --set count=20 --set radius=0.06", {"results.u", "results.fall"}},
        {"cases/falling_disk.lua", "--set stop=0.05", {"results.re_max"}},
        {"cases/settling_sphere.lua", "--set n=2 --set stop=0.1", {"results.speed_max"}},
    };

    (void)state;
    for (size_t k = 0; k < sizeof flows / sizeof *flows; k++) {
        double d;

        solve(flows[k].path, flows[k].settings, "block", 1e-8, 1e-10);
        solver_in_use_is("block", "solver_block");
        solve(flows[k].path, flows[k].settings, "umfpack", 1e-8, 1e-10);
        solver_in_use_is("umfpack", "solver_umfpack");
        d = difference(flows[k].keys);
        print_message("# %s %s: %.1f iterations, difference %.1e\n", flows[k].path, flows[k].settings,
                      iterations("block"), d);
        assert_between(d, 0, 1e-6);
    }
}

/* A linear problem is solved once, so that its answer is as wrong as the solution of one linear system. */
static void error_of_a_linear_problem_follows_the_tolerance(void **state)
{
    static const char *const keys[] = {"results.u", "results.p", NULL}, *const shape[] = {
                                                                            "--set n=8",
                                                                            "--set n=6 --set shape=tets"};

    (void)state;
    for (int k = 0; k < 2; k++) {
        char settings[200];

        snprintf(settings, sizeof settings, "%s --set ratio=0 --set convection=false", shape[k]);
        solve(LID, settings, "umfpack", 1e-12, 1e-10);
        for (double tolerance = 1e-4; tolerance > 1e-9; tolerance *= 1e-2) {
            double d;

            solve(LID, settings, "block", tolerance, 1e-3);
            assert_true(summary("block", "newton_iterations") == 1);
            assert_between(summary("block", "worst_linear_residual"), 0, 1.01 * tolerance);
            d = difference(keys);
            print_message("# Stokes flow, %s: tolerance %.0e, results differ by %.1e\n", shape[k], tolerance, d);
            assert_between(d, 0, tolerance);
        }
    }
}

/* Iterations per solution of the lid-driven box. */
static double lid(const char *fmt, double number, const char *more)
{
    char setting[100];
    double n;

    snprintf(setting, sizeof setting, fmt, number);
    assert_ran(plugflow("run " LID " --quiet --threads 1 %s %s --out %s/lid", setting, more, scratch()), 0, NULL);
    solver_in_use_is("lid", "solver_block");
    n = iterations("lid");
    print_message("# %s %s: %.1f iterations\n", setting, more, n);
    return n;
}

/* From inertia to viscosity: nu dt / h^2, and no time at all. */
static void iterations_stay_few_from_inertia_to_viscosity(void **state)
{
    static const double ratio[] = {0.01, 0.1, 1, 10, 100, 0}, most[] = {12, 15, 23, 29, 43, 43};

    (void)state;
    for (int k = 0; k < 6; k++) {
        assert_between(lid("--set ratio=%g", ratio[k], "--set n=8"), 1, most[k]);
        assert_between(lid("--set ratio=%g", ratio[k], "--set n=24 --set dim=2"), 1, most[k]);
    }
}

static void iterations_do_not_feel_the_density_of_a_body(void **state)
{
    static const double density[] = {0.01, 1, 1000};

    (void)state;
    for (int k = 0; k < 3; k++) {
        assert_between(lid("--set density=%g", density[k], "--set count=1 --set radius=0.2 --set n=8"), 1, 23);
        assert_between(lid("--set density=%g", density[k], "--set count=1 --set radius=0.2 --set n=24 --set dim=2"),
                       1, 15);
    }
}

static void iterations_do_not_feel_the_number_of_bodies(void **state)
{
    static const double count[] = {1, 20, 50};

    (void)state;
    for (int k = 0; k < 3; k++)
        assert_between(lid("--set count=%g", count[k], "--set radius=0.04 --set n=40 --set dim=2"), 1, 15);
}

/* Over refinements, with inertia and without. */
static void iterations_hardly_grow_with_the_mesh(void **state)
{
    static const char *const more[] = {"--set steps=1", "--set ratio=0",
                                       "--set count=1 --set radius=0.2 --set steps=1"};

    (void)state;
    for (int k = 0; k < 3; k++) {
        double before = 0;

        for (int n = 6; n <= 12; n += 3) {
            double now = lid("--set n=%g", n, more[k]);

            if (before > 0)
                assert_between(now / before, 0, 1.3);
            before = now;
        }
    }
}

static void multipliers_are_refused_where_it_is_named_and_factored_where_not(void **state)
{
    const char *bodies = "--set formulation=conservative --set count=1 --set radius=0.2 --set n=8 --set steps=1";

    (void)state;
    assert_ran(plugflow("run " LID " --quiet --set solver=block %s --out %s/named", bodies, scratch()), 3,
               "there are multipliers inside of bodies", "sharp");
    assert_ran(plugflow("run " LID " --quiet --set solver=auto %s --out %s/auto", bodies, scratch()), 0, NULL);
    solver_in_use_is("auto", "solver_umfpack");
    assert_ran(plugflow("run " LID
                        " --quiet --set solver=auto --set count=1 --set radius=0.2 --set n=8 --set steps=1 "
                        "--out %s/auto",
                        scratch()),
               0, NULL);
    solver_in_use_is("auto", "solver_block");
}

static void two_runs_leave_the_same_bytes(void **state)
{
    static const char *const flows[] = {"--set n=6 --set count=1 --set radius=0.2", "--set n=6 --set ratio=0",
                                        "--set dim=2 --set n=24 --set count=20 --set radius=0.06"};

    (void)state;
    for (size_t k = 0; k < sizeof flows / sizeof *flows; k++)
        for (int threads = 1; threads <= 2; threads++) {
            for (int run = 1; run <= 2; run++)
                assert_ran(
                    plugflow("run " LID " --quiet %s --threads %d --out %s/r%d", flows[k], threads, scratch(), run),
                    0, NULL);
            solver_in_use_is("r1", "solver_block");
            assert_ran(shell("cd %s && for f in $(cd r1; find . -name '*.vtu' -o -name '*.pvd' -o -name '*.csv'); "
                             "do cmp r1/$f r2/$f || exit 1; done",
                             scratch()),
                       0, NULL);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(answers_are_those_of_the_factorisation),
        cmocka_unit_test(error_of_a_linear_problem_follows_the_tolerance),
        cmocka_unit_test(iterations_stay_few_from_inertia_to_viscosity),
        cmocka_unit_test(iterations_do_not_feel_the_density_of_a_body),
        cmocka_unit_test(iterations_do_not_feel_the_number_of_bodies),
        cmocka_unit_test(iterations_hardly_grow_with_the_mesh),
        cmocka_unit_test(multipliers_are_refused_where_it_is_named_and_factored_where_not),
        cmocka_unit_test(two_runs_leave_the_same_bytes),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
