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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pressure_in_a_drop_at_rest_is_that_of_laplace),
        cmocka_unit_test(a_disk_stays_where_it_displaces_its_mass),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
