/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Heat in a fluid and in bodies, against exact temperatures and published flows. */
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>

/* de Vahl Davis 1983, Int. J. Numer. Meth. Fluids 3:249, and finer grids since: Hortmann, Peric and Scheuerer 1990,
 * Int. J. Numer. Meth. Fluids 11:189. */
static void cavity(const char *ra, int n, double davis, double finer)
{
    double nu;

    assert_ran(plugflow("run cases/natural_convection.lua --quiet --set ra=%s --set n=%d --out %s/cavity", ra, n,
                        scratch()),
               0, NULL);
    nu = summary("cavity", "results.nu");
    print_message("# cavity, Ra %s, %d x %d: Nu %.5f, %.3f %% off de Vahl Davis, %.4f %% off the finer one\n", ra,
                  n, n, nu, 100 * (nu / davis - 1), 100 * (nu / finer - 1));
    assert_between(nu / davis, 1 - 3e-3, 1 + 3e-3);
    assert_between(nu / finer, 1 - 3e-4, 1 + 3e-4);
    assert_between(summary("cavity", "results.defect"), -1e-9, 1e-9); /* what comes in goes out */
}

static void nusselt_numbers_of_the_cavity_are_those_of_the_benchmark(void **state)
{
    (void)state;
    cavity("1e3", 16, 1.118, 1.118);
    cavity("1e4", 16, 2.243, 2.24475);
    cavity("1e5", 16, 4.519, 4.52164);
    cavity("1e6", 32, 8.800, 8.82513);
}

/* Errors in L2 on n and 2n cells: those of T fall with `order`, those inside with second order at least. */
static void falls(const char *run, int n, int inside, double order)
{
    double T[2], body[2] = {1, 0};

    for (int k = 0; k < 2; k++) {
        assert_ran(plugflow("run %s --quiet --set n=%d --out %s/o", run, n << k, scratch()), 0, NULL);
        T[k] = summary("o", "errors.T.l2");
        if (inside)
            body[k] = summary("o", "errors.T_body.l2");
    }
    print_message("# %s, n = %d, %d: T %.3g, %.3g, order %.2f", run, n, 2 * n, T[0], T[1], log2(T[0] / T[1]));
    if (inside)
        print_message("; inside %.3g, %.3g, order %.2f", body[0], body[1], log2(body[0] / body[1]));
    print_message("\n");
    assert_between(log2(T[0] / T[1]), order, 4);
    assert_between(body[1] / body[0], 0, 0.25);
}

static void a_conducting_disk_is_of_second_order_and_more(void **state)
{
    (void)state;
    falls("cases/conjugate_disk.lua --set k=10", 8, 1, 2.5);
    falls("cases/conjugate_disk.lua --set k=10", 16, 1, 2.5);
    falls("cases/conjugate_disk.lua --set k=0.1", 16, 1, 2.5);
    falls("cases/conjugate_disk.lua --set k=1000", 16, 1, 2.5);
    falls("cases/conjugate_disk.lua --set k=10 --set shape=triangles", 16, 1, 2.5);
}

static void a_conducting_sphere_is_of_second_order_and_more(void **state)
{
    (void)state;
    falls("tests/verify/heat_bodies.lua --set mode=sphere", 4, 1, 2.2);
}

static void surfaces_hold_a_temperature_or_give_off_a_flux(void **state)
{
    (void)state;
    falls("tests/verify/heat_bodies.lua --set mode=isothermal", 16, 0, 2.5);
    falls("tests/verify/heat_bodies.lua --set mode=flux", 16, 0, 2.5);
}

/* All that is made inside goes out, but for what is not known of the body's volume (1e-7). */
static void heat_made_in_a_disk_leaves_through_the_walls(void **state)
{
    (void)state;
    falls("tests/verify/heat_bodies.lua --set mode=source", 8, 1, 2.5);
    assert_between(summary("o", "results.heat"), 1 - 1e-6, 1 + 1e-6);
}

/* The final temperature is that of the heat at the start over the capacity of both; as exact as volumes of cut
 * cells in the sums of fluid and body are, 1e-5. */
static void a_hot_disk_in_a_closed_box_shares_its_heat(void **state)
{
    (void)state;
    assert_ran(
        plugflow("run tests/verify/heat_bodies.lua --quiet --set mode=equal --set n=8 --out %s/o", scratch()), 0,
        NULL);
    assert_between(summary("o", "errors.T.l2"), 0, 5e-5);
    assert_between(summary("o", "errors.T_body.l2"), 0, 5e-5);
}

/* What bodies keep does not go along with them yet, and is no silent wrong answer. */
static void bodies_that_keep_heat_may_not_move(void **state)
{
    const char *path =
        put_file("moves.lua", "mesh { box = {{0,0},{1,1}}, cells = {8,8} }\n"
                              "fluid { density = 1, viscosity = 1, conductivity = 1, heat_capacity = 1 }\n"
                              "term \"continuity\" {}\nterm \"momentum\" {}\nterm \"heat\" {}\n"
                              "particulate \"sharp\"\nterm \"heat_bodies\" { body_conductivity = 1 }\n"
                              "boundary \"*\" { u = {0,0}, T = 0 }\n"
                              "particle { shape = disk { radius = 0.2 }, density = 1, at = {0.5,0.5} }\n"
                              "time { step = 0.1, stop = 0.2 }\n");

    (void)state;
    assert_ran(plugflow("check %s", path), 3, "heat_bodies.storage", "motion = \"fixed\"",
               "without = {\"storage\"}");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nusselt_numbers_of_the_cavity_are_those_of_the_benchmark),
        cmocka_unit_test(a_conducting_disk_is_of_second_order_and_more),
        cmocka_unit_test(a_conducting_sphere_is_of_second_order_and_more),
        cmocka_unit_test(surfaces_hold_a_temperature_or_give_off_a_flux),
        cmocka_unit_test(heat_made_in_a_disk_leaves_through_the_walls),
        cmocka_unit_test(a_hot_disk_in_a_closed_box_shares_its_heat),
        cmocka_unit_test(bodies_that_keep_heat_may_not_move),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
