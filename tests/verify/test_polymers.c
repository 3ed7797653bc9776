/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * oldroyd_b against exact flows, and the drag of the confined cylinder that the literature agrees on. */
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>

static double error_of(const char *field, const char *arguments)
{
    char key[60];

    assert_ran(plugflow("run %s --quiet --threads 1 --out %s/o", arguments, scratch()), 0, NULL);
    snprintf(key, sizeof key, "errors.%s.l2", field);
    return summary("o", key);
}

static double order(double coarse, double fine)
{
    return log2(coarse / fine);
}

/* Elements of second order: psi converges with the third; u gains from that it is a parabola but for psi. */
static void channel_converges_with_third_order(void **state)
{
    static const char *const shape[] = {"quads", "triangles"};

    (void)state;
    for (int k = 0; k < 2; k++) {
        double e[2], u[2];

        for (int i = 0; i < 2; i++) {
            char arguments[200];

            snprintf(arguments, sizeof arguments, "cases/oldroyd_b_channel.lua --set n=%d --set shape=%s", 8 << i,
                     shape[k]);
            e[i] = error_of("psi", arguments);
            u[i] = summary("o", "errors.u.l2");
        }
        print_message("# %s: order of psi %.2f, of u %.2f; errors %.2e %.2e\n", shape[k], order(e[0], e[1]),
                      order(u[0], u[1]), e[1], u[1]);
        assert_between(order(e[0], e[1]), 2.8, 3.3);
        assert_between(order(u[0], u[1]), 2.8, 5);
        assert_between(e[1], 0, 1e-4 * 1.15);
    }
}

/* In homogeneous shear that starts, or stops, all there is is the scheme in time, of second order. */
static void shear_that_starts_and_stops_follows_its_exponentials(void **state)
{
    (void)state;
    for (int stops = 0; stops < 2; stops++) {
        double e[2];

        for (int i = 0; i < 2; i++) {
            char arguments[200];

            snprintf(arguments, sizeof arguments, "tests/verify/oldroyd_b_shear.lua --set stops=%s --set dt=%g",
                     stops ? "true" : "false", 0.025 / (1 + i));
            e[i] = error_of("psi", arguments);
            assert_between(summary("o", "errors.psi.h1"), 0, 1e-11); /* the same everywhere */
            assert_between(summary("o", "errors.u.l2"), 0, 1e-11);
        }
        print_message("# %s: order in time %.2f, error %.2e\n", stops ? "stops" : "starts", order(e[0], e[1]),
                      e[1]);
        assert_between(order(e[0], e[1]), 1.85, 2.15);
        assert_between(e[1], 0, 1e-3);
    }
}

/* Hulsen, Fattal and Kupferman 2005, J. Non-Newtonian Fluid Mech. 127:27; what several groups agree on to 0.01. */
static void drag_of_the_confined_cylinder_is_that_of_the_literature(void **state)
{
    (void)state;
    assert_ran(plugflow("run cases/oldroyd_b_cylinder.lua --set wi=0.5 --quiet --out %s/o", scratch()), 0, NULL);
    print_message("# Wi = 0.5: K = %.4f\n", summary("o", "results.K"));
    assert_between(summary("o", "results.K"), 118.83 - 0.02, 118.83 + 0.02);
}

/* The same on a grid that the cylinder cuts through: forces of solvent and polymers on its surface. */
static void a_body_feels_the_polymers_on_its_surface(void **state)
{
    (void)state;
    assert_ran(plugflow("run cases/oldroyd_b_cylinder_unfitted.lua --set n=12 --quiet --out %s/o", scratch()), 0,
               NULL);
    print_message("# unfitted, Wi = 0.1: K = %.4f\n", summary("o", "results.K"));
    assert_between(summary("o", "results.K"), 130.36 - 0.1, 130.36 + 0.1);
}

static void matrices_are_the_derivatives(void **state)
{
    (void)state;
    assert_ran(plugflow("test oldroyd_b"), 0, "0 failed");
    assert_ran(plugflow("jacobian cases/oldroyd_b_channel.lua --set n=2"), 0, NULL);
    assert_ran(plugflow("jacobian cases/oldroyd_b_cylinder_unfitted.lua --set n=8"), 0, NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(channel_converges_with_third_order),
        cmocka_unit_test(shear_that_starts_and_stops_follows_its_exponentials),
        cmocka_unit_test(drag_of_the_confined_cylinder_is_that_of_the_literature),
        cmocka_unit_test(a_body_feels_the_polymers_on_its_surface),
        cmocka_unit_test(matrices_are_the_derivatives),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
