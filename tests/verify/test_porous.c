/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * porous against exact flows: Brinkman's equation in a channel that a medium fills, in part or wholly, and
 * Forchheimer's in a medium without walls. */
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>

/* Velocities of elements of second order converge with the third. */
static void profiles_of_a_channel_converge_with_third_order(void **state)
{
    static const char *const shape[] = {"quads", "triangles"}, *const h[] = {"0", "0.5"};

    (void)state;
    for (int k = 0; k < 4; k++) {
        double e[2], order;

        for (int i = 0; i < 2; i++) {
            assert_ran(
                plugflow("run cases/porous_channel.lua --quiet --set n=%d --set shape=%s --set h=%s --out %s/o",
                         16 << i, shape[k % 2], h[k / 2], scratch()),
                0, NULL);
            e[i] = summary("o", "errors.u.l2") / summary("o", "errors.u.l2_exact");
        }
        order = log2(e[0] / e[1]);
        print_message("# h = %s, %s: order %.2f, relative error %.2e\n", h[k / 2], shape[k % 2], order, e[1]);
        assert_between(order, 2.9, 4.1);
        assert_between(e[1], 0, 1e-3);
    }
}

/* A term with a part of the domain is a term with a coefficient that vanishes elsewhere. */
static void a_part_of_the_domain_is_a_medium(void **state)
{
    double e[2];

    (void)state;
    for (int i = 0; i < 2; i++) {
        assert_ran(plugflow("run cases/porous_channel.lua --quiet --set parts=%s --out %s/o", i ? "true" : "false",
                            scratch()),
                   0, NULL);
        e[i] = summary("o", "errors.u.l2");
    }
    assert_between(e[1] / e[0] - 1, -1e-9, 1e-9);
}

/* Without walls the force is balanced by the drag alone: mu/K u + rho c_F/sqrt(K) u^2 = F, here 1 u + 0.5 u^2 = 4,
 * u = 2. */
static void forchheimer_drag_balances_a_force(void **state)
{
    (void)state;
    put_file("medium.lua", "mesh { box = {{0,0},{1,1}}, cells = {2,3} }\nfluid { density = 2, viscosity = 0.25 }\n"
                           "term 'continuity' {}\nterm 'momentum' { force = {2.4, -3.2} }\n"
                           "term 'porous' { inverse_permeability = 4, forchheimer = 0.125 }\n"
                           "boundary { periodic = {'left', 'right'} }\nboundary { periodic = {'bottom', 'top'} }\n"
                           "exact { u = {1.2, -1.6}, p = 0 }\n");
    assert_ran(plugflow("run %s/medium.lua --quiet --out %s/o", scratch(), scratch()), 0, NULL);
    assert_between(summary("o", "errors.u.l2"), 0, 1e-9);
}

static void a_negative_permeability_is_refused(void **state)
{
    (void)state;
    put_file("bad.lua", "mesh { box = {{0,0},{1,1}}, cells = {2,3} }\nfluid { density = 2, viscosity = 0.25 }\n"
                        "term 'continuity' {}\nterm 'momentum' {}\nboundary '*' { u = {0, 0} }\n"
                        "term 'porous' { inverse_permeability = function(x, y) return y - 0.5 end }\n");
    assert_ran(plugflow("run %s/bad.lua --quiet --out %s/o", scratch(), scratch()), 5, "porous.drag",
               "must not be negative");
}

static void the_point_functions_pass_their_tests(void **state)
{
    (void)state;
    assert_ran(plugflow("test porous"), 0, "0 failed");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(profiles_of_a_channel_converge_with_third_order),
        cmocka_unit_test(a_part_of_the_domain_is_a_medium),
        cmocka_unit_test(forchheimer_drag_balances_a_force),
        cmocka_unit_test(a_negative_permeability_is_refused),
        cmocka_unit_test(the_point_functions_pass_their_tests),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
