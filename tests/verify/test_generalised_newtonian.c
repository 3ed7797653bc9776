/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * generalised_newtonian against exact flows in channels; that Nitsche's method on bodies takes its viscosity. */
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>

/* Velocities of elements of second order converge with the third. */
static void power_law_profiles_converge_with_third_order(void **state)
{
    static const char *const shape[] = {"quads", "triangles"}, *const exponent[] = {"0.5", "1.5"};

    (void)state;
    for (int k = 0; k < 4; k++) {
        double e[2], order;

        for (int i = 0; i < 2; i++) {
            assert_ran(
                plugflow("run cases/power_law_channel.lua --quiet --threads 1 --set n=%d --set shape=%s --set "
                         "exponent=%s --out %s/o",
                         4 << i, shape[k % 2], exponent[k / 2], scratch()),
                0, NULL);
            e[i] = summary("o", "errors.u.l2") / summary("o", "errors.u.l2_exact");
        }
        order = log2(e[0] / e[1]);
        print_message("# n = %s, %s: order %.2f, relative error %.2e\n", exponent[k / 2], shape[k % 2], order,
                      e[1]);
        assert_between(order, 2.5, 4);
        assert_between(e[1], 0, 1e-3);
    }
}

/* Against the profile that the balance of forces gives, integrated from point to point. */
static void other_laws_have_the_profile_of_the_balance_of_forces(void **state)
{
    static const char *const law[] = {"carreau", "cross"};

    (void)state;
    for (int k = 0; k < 2; k++) {
        double e[2];

        for (int i = 0; i < 2; i++) {
            assert_ran(
                plugflow("run cases/shear_law_channel.lua --quiet --threads 1 --set n=%d --set law=%s --out %s/o",
                         8 << i, law[k], scratch()),
                0, NULL);
            e[i] = summary("o", "errors.u.l2") / summary("o", "errors.u.l2_exact");
        }
        print_message("# %s: order %.2f, relative error %.2e\n", law[k], log2(e[0] / e[1]), e[1]);
        assert_between(log2(e[0] / e[1]), 2.5, 4.2);
        assert_between(e[1], 0, 1e-4);
    }
}

/* A plug flows in the middle where the stress is below the yield stress.  The regularised law lets it creep with
 * the rate -ln(1 - G y / tau_y) / m, so that between the middle and 0.9 of its edge the velocity falls by 0.6697
 * tau_y / (G m), over 1.8 of the plug 0.0744/m. */
static void a_bingham_fluid_has_a_plug(void **state)
{
    double e[2];

    (void)state;
    for (int i = 0; i < 2; i++) {
        const double m = i ? 300 : 50; /* far beyond, Newton's way depends on round-off */

        assert_ran(
            plugflow("run cases/shear_law_channel.lua --quiet --threads 1 --set n=16 --set law=bingham --set "
                     "m=%g --out %s/o",
                     m, scratch()),
            0, NULL);
        e[i] = fabs(summary("o", "results.plug") / summary("o", "results.plug_exact") - 1);
        print_message("# m = %g: velocity of the plug off by %.2e, over the plug it differs by %.2e\n", m, e[i],
                      summary("o", "results.across"));
        assert_between(summary("o", "results.across") * m, 0.0744 * 0.99, 0.0744 * 1.01);
    }
    assert_between(e[1], 0, 1e-3);
    assert_between(e[1] / e[0], 0, 0.5);
}

/* Power law with n = 1 and K = 0.5 is a Newtonian fluid of viscosity 0.5, on the surface of a body, too; and there
 * is no other viscosity that the drag could depend on. */
static void the_viscosity_reaches_the_surfaces_of_bodies(void **state)
{
    static const char *const box =
        "mesh { box = {{0,0},{2,1}}, cells = {16,8} }\nlocal how = param('how', 'law', '')\n"
        "fluid(how == 'law' and { density = 1 } or { density = 1, viscosity = 0.5 })\n"
        "term 'continuity' {}\nterm 'momentum' {}\n"
        "if how ~= 'number' then term 'generalised_newtonian' { consistency = 0.5, exponent = 1 } end\n"
        "particulate 'sharp'\nboundary '*' { u = {1, 0} }\nboundary 'right' { natural = true }\n"
        "particle { shape = disk { radius = 0.21 }, density = 1, at = {0.913, 0.487}, motion = 'fixed' }\n"
        "results(function(r) return { drag = r.last['p0.fx'] } end)\n";
    double drag[2];

    (void)state;
    put_file("box.lua", box);
    for (int i = 0; i < 2; i++) {
        assert_ran(plugflow("run %s/box.lua --quiet --threads 1 --set how=%s --out %s/o", scratch(),
                            i ? "number" : "law", scratch()),
                   0, NULL);
        drag[i] = summary("o", "results.drag");
    }
    assert_between(drag[1], 1, 100);
    assert_between(drag[0] / drag[1], 1 - 1e-9, 1 + 1e-9);
    assert_ran(plugflow("check %s/box.lua --set how=both", scratch()), 3, "\"viscosity\" is given here",
               "generalised_newtonian.law publishes it");
}

static void the_point_functions_pass_their_tests(void **state)
{
    (void)state;
    assert_ran(plugflow("test generalised_newtonian"), 0, "0 failed");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(power_law_profiles_converge_with_third_order),
        cmocka_unit_test(other_laws_have_the_profile_of_the_balance_of_forces),
        cmocka_unit_test(a_bingham_fluid_has_a_plug),
        cmocka_unit_test(the_viscosity_reaches_the_surfaces_of_bodies),
        cmocka_unit_test(the_point_functions_pass_their_tests),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
