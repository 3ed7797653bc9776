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
    static const char *const run[] = {"--set density=1.5", "--set density=1.3", "--set density=1.7 --set above=-0.1"};

    (void)state;
    for (int k = 0; k < 3; k++) {
        assert_ran(plugflow("run cases/floating_between.lua --quiet %s --set stop=40 --out %s/o", run[k], scratch()),
                   0, NULL);
        print_message("# disk between two fluids, %s: %.3g %% of its radius off\n", run[k],
                      100 * summary("o", "results.error"));
        assert_between(summary("o", "results.error"), -0.03, 0.03);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_disk_comes_to_rest_where_it_displaces_its_mass),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
