/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Flows with values in the literature, those that take seconds; the others are in the slow suite. */
#include "verify/ghia.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

static void cavity_at_re_100_agrees_with_ghia(void **state)
{
    ghia_error e;

    (void)state;
    assert_ran(plugflow("run cases/cavity2d.lua --quiet --set n=64 --out %s/cavity", scratch()), 0, NULL);
    e = ghia_compare("cavity", 1);
    print_message("# cavity 64 x 64, Re 100: largest difference %.4f, median %.4f\n", e.largest, e.median);
    assert_between(e.largest, 0, 0.01);
    assert_between(e.median, 0, 0.005);
    assert_between(summary("cavity", "worst_linear_residual"), 0, 1e-10);
}

/* From rest at Re = 1000 plain Newton has a hard time; the program finds a way by itself.  The values are those of
 * Botella and Peyret 1998, Comput. Fluids 27:421 (spectral, 160 x 160): u at the centre and its least value on the
 * vertical centre line.  A lid that pumps fluid through the upper corners is off by 1e-2. */
static void cavity_at_re_1000_is_reached_from_rest(void **state)
{
    ghia_error e;
    double *u, least = 0;
    char file[300];

    (void)state;
    assert_ran(plugflow("run cases/cavity2d.lua --quiet --set n=64 --set re=1000 --out %s/cavity", scratch()), 0,
               NULL);
    e = ghia_compare("cavity", 3);
    assert_between(e.largest, 0, 0.025); /* 0.02 at 128 x 128, in the slow suite */
    snprintf(file, sizeof file, "%s/cavity/lines/vertical.csv", scratch());
    assert_int_equal(csv_column(file, "u", &u), 129);
    for (int i = 0; i < 129; i++)
        least = fmin(u[i], least);
    print_message("# cavity 64 x 64, Re 1000: u at the centre %.7f, least %.7f\n", u[64], least);
    assert_between(u[64] + 0.0620561, -1e-4, 1e-4);
    assert_between(least + 0.3885698, -5e-4, 5e-4);
    free(u);
}

static void steady_cases_go_on_by_continuation(void **state)
{
    ran r = plugflow("run cases/cavity2d.lua --set n=24 --set re=5000 --out %s/cavity", scratch());

    (void)state;
    assert_ran(r, 0, "continuation");
}

static void newton_is_quadratic_on_the_3d_cavity(void **state)
{
    (void)state;
    assert_ran(plugflow("run cases/cavity3d.lua --quiet --out %s/cavity3d", scratch()), 0, NULL);
    print_message("# cavity 8^3, Re 100: %g iterations, observed order %.2f\n",
                  summary("cavity3d", "newton_iterations"), summary("cavity3d", "newton_order"));
    assert_between(summary("cavity3d", "newton_iterations"), 1, 6);
    assert_between(summary("cavity3d", "newton_order"), 1.8, 4);
}

static void dfg_2d_1_has_the_published_coefficients(void **state)
{
    (void)state;
    assert_ran(plugflow("run cases/cylinder2d.lua --quiet --out %s/cylinder", scratch()), 0, NULL);
    print_message("# DFG 2D-1, %g unknowns: cd %.7f, cl %.8f, dp %.7f\n", summary("cylinder", "unknowns"),
                  summary("cylinder", "cd"), summary("cylinder", "cl"), summary("cylinder", "dp"));
    assert_between(summary("cylinder", "unknowns"), 1, 60000);
    assert_between(summary("cylinder", "cd") / 5.57953523384 - 1, -1e-4, 1e-4);
    assert_between(summary("cylinder", "cl") / 0.010618948146 - 1, -1e-3, 1e-3);
    assert_between(summary("cylinder", "dp") / 0.11752016697 - 1, -1e-3, 1e-3);
}

/* Gartling 1990, Int. J. Numer. Meth. Fluids 11:953; Erturk 2008, Comput. Fluids 37:633, in heights of the channel.
 * Erturk's inlet is long, the mesh's two heights. */
static void step_at_re_800_has_the_published_eddies(void **state)
{
    static const struct {
        const char *mesh;
        double reattachment, separation, upper, within;
    } flow[] = {{"box", 6.10, 4.85, 10.48, 0.05}, {"channel", 11.834 / 2, 9.476 / 2, 20.553 / 2, 0.12}};

    (void)state;
    for (int k = 0; k < 2; k++) {
        double within = flow[k].within;

        assert_ran(
            plugflow("run cases/backward_step.lua --quiet --set mesh=%s --out %s/step", flow[k].mesh, scratch()), 0,
            NULL);
        print_message("# step, %s: %.4f, %.4f to %.4f; %g Newton iterations\n", flow[k].mesh,
                      summary("step", "results.reattachment"), summary("step", "results.upper_separation"),
                      summary("step", "results.upper_reattachment"), summary("step", "newton_iterations"));
        assert_between(summary("step", "results.reattachment") - flow[k].reattachment, -within, within);
        assert_between(summary("step", "results.upper_separation") - flow[k].separation, -within, within);
        assert_between(summary("step", "results.upper_reattachment") - flow[k].upper, -within, within);
    }
}

static void cylinder_has_three_cases(void **state)
{
    (void)state;
    assert_ran(plugflow("check cases/cylinder2d.lua --set case=2D-4"), 3, "there are 2D-1, 2D-2 and 2D-3");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cavity_at_re_100_agrees_with_ghia),
        cmocka_unit_test(cavity_at_re_1000_is_reached_from_rest),
        cmocka_unit_test(steady_cases_go_on_by_continuation),
        cmocka_unit_test(newton_is_quadratic_on_the_3d_cavity),
        cmocka_unit_test(dfg_2d_1_has_the_published_coefficients),
        cmocka_unit_test(step_at_re_800_has_the_published_eddies),
        cmocka_unit_test(cylinder_has_three_cases),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
