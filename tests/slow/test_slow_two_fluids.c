/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Two fluids, against a benchmark and Archimedes; minutes each. */
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

/* A disk let go a little above or below its place comes to rest where it displaces its own mass; what is left after
 * 40 units of time is that fluid drains from it ever more slowly. */
static void a_disk_comes_to_rest_where_it_displaces_its_mass(void **state)
{
    static const char *const run[] = {"--set density=1.5", "--set density=1.3",
                                      "--set density=1.7 --set above=-0.1"};

    (void)state;
    for (int k = 0; k < 3; k++) {
        assert_ran(
            plugflow("run cases/floating_between.lua --quiet %s --set stop=40 --out %s/o", run[k], scratch()), 0,
            NULL);
        print_message("# disk between two fluids, %s: %.3g %% of its radius off\n", run[k],
                      100 * summary("o", "results.error"));
        assert_between(summary("o", "results.error"), -0.03, 0.03);
    }
}

/* Hysing et al. 2009, Int. J. Numer. Meth. Fluids 60:1259, case 1. */
static void the_rising_bubble_is_that_of_the_benchmark(void **state)
{
    (void)state;
    assert_ran(plugflow("run cases/rising_bubble.lua --quiet --out %s/o", scratch()), 0, NULL);
    print_message(
        "# bubble, 1/40: centre %.4f (1.081), largest speed %.4f at %.2f (0.2417 at 0.92), least circularity "
        "%.4f at %.2f (0.9013 at 1.90); %.2f %% of the area lost\n",
        summary("o", "results.centre"), summary("o", "results.speed_max"), summary("o", "results.speed_max_at"),
        summary("o", "results.circularity_min"), summary("o", "results.circularity_min_at"),
        100 * (1 - summary("o", "results.area_kept")));
    assert_between(summary("o", "results.centre") / 1.081, 0.98, 1.02);
    assert_between(summary("o", "results.speed_max") / 0.2417, 0.98, 1.02);
    assert_between(summary("o", "results.circularity_min") / 0.9013, 0.98, 1.02);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_rising_bubble_is_that_of_the_benchmark),
        cmocka_unit_test(a_disk_comes_to_rest_where_it_displaces_its_mass),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
