/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Two fluids that do not mix. */
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>

/* The jump of the pressure is sigma int |grad phi|/r dr, which the thickness e of the interface makes sigma/R (1 +
 * pi^2/3 (e/R)^2); what is left is the error of space.  Spurious currents would make a capillary number mu u/sigma.
 */
static void pressure_in_a_drop_at_rest_is_that_of_laplace(void **state)
{
    (void)state;
    for (int n = 8; n <= 16; n *= 2) {
        const double e = 0.5 / n, exact = 1 + 3.289868 * e * e;
        double jump, speed;

        assert_ran(plugflow("run cases/static_drop.lua --quiet --set n=%d --set stop=0.5 --out %s/o", n, scratch()),
                   0, NULL);
        jump = summary("o", "results.jump");
        speed = summary("o", "results.speed");
        print_message("# drop at rest, %d cells a radius: pressure %.5f, exact %.5f; capillary number %.2g\n", n,
                      jump, exact, speed);
        assert_between(jump / exact, 1 - 3e-3, 1 + 3e-3);
        assert_between(speed, 0, 3e-3);
    }
}

/* At the depth of Archimedes the disk stays, to a ten-thousandth of its radius, but for the thickness of the
 * interface. */
static void a_disk_stays_where_it_displaces_its_mass(void **state)
{
    (void)state;
    assert_ran(plugflow("run cases/floating_between.lua --quiet --set above=0 --set stop=1 --set density=1.3 --out "
                        "%s/o",
                        scratch()),
               0, NULL);
    print_message("# disk between two fluids: %.2g radii off after one unit of time\n",
                  summary("o", "results.error"));
    assert_between(summary("o", "results.error"), -5e-3, 5e-3);
}

/* No slip on bodies knows one viscosity. */
static void two_viscosities_beside_bodies_are_refused(void **state)
{
    const char *path = put_file(
        "two.lua", "mesh { box = {{0,0},{1,1}}, cells = {8,8} }\nfluid { density = 1, viscosity = 1 }\n"
                   "term \"continuity\" {}\nparticulate \"sharp\"\n"
                   "term \"level_set\" { density_2 = 1, viscosity_2 = 2, thickness = 0.05, speed = 1 }\n"
                   "boundary \"*\" { u = {0,0} }\ntime { step = 0.1, stop = 0.2 }\n"
                   "particle { shape = disk { radius = 0.2 }, density = 1, at = {0.5,0.5}, motion = \"fixed\" }\n");

    (void)state;
    assert_ran(plugflow("check %s", path), 3, "viscosities 1 and 2", "viscosity_2 must be the same");
}

/* term "momentum" beside it changes nothing but that its keys of boundaries are there. */
static void momentum_of_two_fluids_takes_the_place_of_that_of_one(void **state)
{
    const char *path =
        put_file("both.lua", "mesh { box = {{0,0},{1,1}}, cells = {4,4} }\nfluid { density = 1, viscosity = 1 }\n"
                             "term \"continuity\" {}\nterm \"momentum\" {}\n"
                             "term \"level_set\" { density_2 = 1, viscosity_2 = 2, thickness = 0.1, speed = 1 }\n"
                             "boundary \"*\" { u = {0,0} }\nboundary \"right\" { traction = {1,0} }\n"
                             "time { step = 0.1, stop = 0.2 }\n");

    (void)state;
    assert_ran(plugflow("check %s", path), 0, "momentum.viscous is left out: level_set.momentum",
               "momentum.inertia is left out", "momentum.body_force is left out");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pressure_in_a_drop_at_rest_is_that_of_laplace),
        cmocka_unit_test(a_disk_stays_where_it_displaces_its_mass),
        cmocka_unit_test(two_viscosities_beside_bodies_are_refused),
        cmocka_unit_test(momentum_of_two_fluids_takes_the_place_of_that_of_one),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
