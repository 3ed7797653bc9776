/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Drag of a confined cylinder in an Oldroyd-B fluid on three meshes against published values. */
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>

/* K at Wi = 0.1 ... 0.7, Hulsen, Fattal and Kupferman 2005, J. Non-Newtonian Fluid Mech. 127:27. */
static void drag_converges_to_that_of_the_literature(void **state)
{
    static const struct {
        double wi, k;
    } published[] = {{0.1, 130.36}, {0.5, 118.83}, {0.6, 117.78}, {0.7, 117.32}};

    (void)state;
    for (int n = 8; n <= 24; n += 8) {
        assert_ran(shell("sed 's/n = {12,/n = {%d,/' cases/mesh/confined_cylinder.geo > %s/m.geo", n, scratch()), 0,
                   NULL);
        for (size_t i = 0; i < sizeof published / sizeof published[0]; i++) {
            const double bound = n == 8 ? 0.1 : 0.02;
            double k;

            assert_ran(
                plugflow("run cases/oldroyd_b_cylinder.lua --set wi=%g --set mesh=%s/m.geo --quiet --out %s/o",
                         published[i].wi, scratch(), scratch()),
                0, NULL);
            k = summary("o", "results.K");
            print_message("# n = %d, Wi = %.1f: K = %.4f, published %.2f\n", n, published[i].wi, k, published[i].k);
            assert_between(k, published[i].k - bound, published[i].k + bound);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(drag_converges_to_that_of_the_literature)};

    return cmocka_run_group_tests(tests, NULL, NULL);
}
