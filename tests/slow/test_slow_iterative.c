/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The block preconditioner where no factorisation fits: from 90 000 to 800 000 unknowns its iterations grow by 1.3
 * at most, and so does the memory of an unknown. */
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

static void check_growth(const char *settings)
{
    double before = 0, bytes = 0;

    for (int n = 16; n <= 32; n += 8) {
        double now;

        assert_ran(plugflow("run tests/verify/iterative.lua --quiet --set n=%d --set steps=1 %s --out %s/lid", n,
                            settings, scratch()),
                   0, NULL);
        assert_int_equal(shell("grep -q '\"linear_solver\": \"solver_block\"' %s/lid/summary.json", scratch()).code,
                         0);
        now = summary("lid", "gmres_iterations") / summary("lid", "matrices");
        bytes = summary("lid", "peak_memory_bytes") / summary("lid", "free_unknowns");
        print_message("# n = %d %s: %.1f iterations, %.0f bytes an unknown\n", n, settings, now, bytes);
        if (before > 0)
            assert_between(now / before, 0, 1.3);
        assert_between(bytes, 0, 7000);
        before = now;
    }
}

static void iterations_hardly_grow_with_inertia(void **state)
{
    (void)state;
    check_growth("--set ratio=0.1");
}

static void iterations_hardly_grow_with_viscosity(void **state)
{
    (void)state;
    check_growth("--set ratio=0");
}

static void iterations_hardly_grow_with_bodies(void **state)
{
    (void)state;
    check_growth("--set count=10 --set radius=0.12");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(iterations_hardly_grow_with_inertia),
        cmocka_unit_test(iterations_hardly_grow_with_viscosity),
        cmocka_unit_test(iterations_hardly_grow_with_bodies),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
