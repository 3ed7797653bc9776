/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * species against concentrations that are known: layers, reactions, walls that take it up, bodies that release it.
 */
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>

static void solve(const char *kind, const char *set)
{
    assert_ran(plugflow("run tests/verify/species.lua --quiet --threads 1 --set kind=%s %s --out %s/o", kind, set,
                        scratch()),
               0, NULL);
}

/* Of the error of c, from n to 2 n cells. */
static double order(const char *kind, int n, const char *set, double *error)
{
    double e[2];

    for (int i = 0; i < 2; i++) {
        char all[200];

        snprintf(all, sizeof all, "--set n=%d %s", n << i, set);
        solve(kind, all);
        e[i] = summary("o", "errors.c.l2");
    }
    *error = e[1];
    return log2(e[0] / e[1]);
}

/* Elements of second order: third order; what stabilises vanishes with the residual, and takes nothing from it. */
static void concentrations_converge_with_third_order(void **state)
{
    static const char *const kind[] = {"layer", "thiele", "laws"};
    static const char *const set[] = {"", "--set shape=triangles", "--set streamline=true",
                                      "--set streamline=true --set shape=triangles"};

    (void)state;
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < (k == 1 ? 2 : 4); i++) {
            double e, p = order(kind[k], 16, set[i], &e);

            print_message("# %s %s: order %.2f, error %.2e\n", kind[k], set[i], p, e);
            assert_between(p, 2.75, 3.5);
            assert_between(e, 0, 1e-4);
        }
}

static void a_flux_and_an_uptake_make_a_straight_line(void **state)
{
    (void)state;
    solve("wall", "");
    assert_between(summary("o", "errors.c.l2"), 0, 1e-11);
    solve("wall", "--set shape=triangles");
    assert_between(summary("o", "errors.c.l2"), 0, 1e-11);
}

/* exp(-k t) of the one and c_0/(1 + k c_0 t) of the other, by a scheme of second order. */
static void two_species_decay_each_by_its_law(void **state)
{
    double e[2][2];

    (void)state;
    for (int i = 0; i < 2; i++) {
        solve("decay", i ? "--set dt=0.0125" : "--set dt=0.025");
        e[i][0] = summary("o", "errors.c.l2");
        e[i][1] = summary("o", "errors.c_2.l2");
    }
    print_message("# orders in time %.2f %.2f\n", log2(e[0][0] / e[1][0]), log2(e[0][1] / e[1][1]));
    assert_between(log2(e[0][0] / e[1][0]), 1.85, 2.15);
    assert_between(log2(e[0][1] / e[1][1]), 1.8, 2.3);
    assert_between(e[1][0], 0, 1e-3);
}

/* The logarithm outside of a disk that cuts through cells; and what is released comes out at the boundary, but for
 * the circumference, which pieces of surface have to 1e-6 or better. */
static void a_disk_dissolves_into_the_logarithm(void **state)
{
    static const char *const shape[] = {"quads", "triangles"};

    (void)state;
    for (int k = 0; k < 2; k++) {
        double e[2];

        for (int i = 0; i < 2; i++) {
            assert_ran(plugflow("run cases/dissolving_disk.lua --quiet --set shape=%s --set n=%d --out %s/o",
                                shape[k], 20 << i, scratch()),
                       0, NULL);
            e[i] = summary("o", "errors.c.l2");
            assert_between(summary("o", "results.released"), 1 - 3e-6, 1 + 3e-6);
        }
        print_message("# %s: order %.2f, error %.2e; released %.9f\n", shape[k], log2(e[0] / e[1]), e[1],
                      summary("o", "results.released"));
        assert_between(log2(e[0] / e[1]), 2.5, 3.5);
    }
}

/* Without any boundary all of it is stored, step by step. */
static void a_closed_box_keeps_what_a_disk_releases(void **state)
{
    (void)state;
    for (int k = 0; k < 2; k++) {
        solve("closed", k ? "--set shape=triangles" : "");
        print_message("# stored %.9f\n", summary("o", "results.stored"));
        assert_between(summary("o", "results.stored"), 1 - 3e-6, 1 + 3e-6);
    }
}

static void the_point_functions_pass_their_tests(void **state)
{
    (void)state;
    assert_ran(plugflow("test species"), 0, "0 failed");
    assert_ran(plugflow("test species_2"), 0, "0 failed");
    assert_ran(plugflow("jacobian tests/verify/species.lua --set kind=laws --set streamline=true --set n=3"), 0,
               NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(concentrations_converge_with_third_order),
        cmocka_unit_test(a_flux_and_an_uptake_make_a_straight_line),
        cmocka_unit_test(two_species_decay_each_by_its_law),
        cmocka_unit_test(a_disk_dissolves_into_the_logarithm),
        cmocka_unit_test(a_closed_box_keeps_what_a_disk_releases),
        cmocka_unit_test(the_point_functions_pass_their_tests),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
