/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Two runs at one thread count leave the same bytes; 1 and 2 threads the same to 1e-10. */
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const char *const cases[] = {"cases/cavity2d.lua --set n=24",
                                    "cases/taylor_green.lua --set n=12 --set stop=0.2",
                                    "cases/cavity3d.lua --set n=4", "cases/cylinder2d.lua"};

static void two_runs_leave_the_same_bytes(void **state)
{
    (void)state;
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++)
        for (int threads = 1; threads <= 2; threads++) {
            for (int run = 1; run <= 2; run++)
                assert_ran(plugflow("run %s --quiet --threads %d --out %s/r%d", cases[k], threads, scratch(), run),
                           0, NULL);
            assert_ran(shell("cd %s && for f in $(cd r1; find . -name '*.vtu' -o -name '*.pvd' -o -name '*.csv'); "
                             "do cmp r1/$f r2/$f || exit 1; done",
                             scratch()),
                       0, NULL);
        }
}

static void one_and_two_threads_agree(void **state)
{
    (void)state;
    for (int threads = 1; threads <= 2; threads++)
        assert_ran(plugflow("run cases/cavity2d.lua --quiet --set n=24 --threads %d --out %s/t%d", threads,
                            scratch(), threads),
                   0, NULL);
    for (int line = 0; line < 2; line++) {
        double *v[2];
        int n = 0;

        for (int t = 0; t < 2; t++) {
            char path[400];

            snprintf(path, sizeof path, "%s/t%d/lines/%s.csv", scratch(), t + 1, line ? "horizontal" : "vertical");
            n = csv_column(path, "u", &v[t]);
        }
        assert_true(n == 129);
        for (int i = 0; i < n; i++)
            assert_between(v[0][i] - v[1][i], -1e-10, 1e-10);
        free(v[0]);
        free(v[1]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(two_runs_leave_the_same_bytes),
        cmocka_unit_test(one_and_two_threads_agree),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
