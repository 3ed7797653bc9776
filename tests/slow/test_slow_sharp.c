/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Bodies with sharp surfaces, what takes minutes; results stand in docs/verification.md. */
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* Largest error of a sphere in its exact flow at ten positions. */
static double worst_sphere(const char *mode, int n)
{
    unsigned s = 7;
    double most = 0;

    for (int k = 0; k < 10; k++) {
        double x[3];

        for (int i = 0; i < 3; i++) {
            s = s * 1664525u + 1013904223u;
            x[i] = ((s >> 8) / 16777216.0 - 0.5) / n;
        }
        assert_ran(plugflow("run cases/fixed_sphere.lua --quiet --set mode=%s --set n=%d --set x0=%.6f --set "
                            "y0=%.6f --set z0=%.6f "
                            "--out %s/sphere",
                            mode, n, x[0], x[1], x[2], scratch()),
                   0, NULL);
        most = fmax(most, fabs(summary("sphere", mode[0] == 't' ? "results.force" : "results.torque") - 1));
    }
    print_message("# sphere, %s, D/h = %d: error at most %.3f %% at 10 positions\n", mode, n / 2, 100 * most);
    return most;
}

static void sphere_at_4_and_6_cells(void **state)
{
    (void)state;
    assert_between(worst_sphere("tr", 8), 0, 0.005);
    assert_between(worst_sphere("rot", 8), 0, 0.002);
    assert_between(worst_sphere("tr", 12), 0, 0.0025);
    assert_between(worst_sphere("rot", 12), 0, 0.0015);
}

static void a_rolling_sphere(void **state)
{
    static const double cfl[] = {0.1, 0.5, 0.7, 1};

    (void)state;
    for (int k = 0; k < 4; k++) {
        assert_ran(plugflow("run tests/verify/moving_sphere.lua --quiet --set cfl=%g --set steps=%d --out %s/roll",
                            cfl[k], k < 2 ? 5 : 3, scratch()),
                   0, NULL);
        print_message("# rolling sphere, CFL %g: error of the torque at most %.3f %%\n", cfl[k],
                      100 * summary("roll", "results.most"));
        assert_between(summary("roll", "results.most"), 0, 0.01);
    }
}

/* Converged 17.42; literature 17.2-17.5. */
static void falling_disk_on_three_meshes(void **state)
{
    static const int n[] = {12, 16, 24};
    double re[3];

    (void)state;
    for (int k = 0; k < 3; k++) {
        assert_ran(
            plugflow("run cases/falling_disk.lua --quiet --set n=%d --set dt=0.0025 --set stop=0.65 --out %s/fall",
                     n[k], scratch()),
            0, NULL);
        re[k] = summary("fall", "results.re_max");
        print_message("# falling disk, h = 1/%d cm, 2.5 ms: Re_max %.3f\n", n[k], re[k]);
        assert_between(re[k], 17.3, 17.55);
        assert_between(re[k] / re[0], 0.995, 1.005);
    }
    assert_ran(plugflow("run cases/falling_disk.lua --quiet --set n=12 --set dt=0.02 --set stop=0.66 --out %s/fall",
                        scratch()),
               0, NULL);
    print_message("# falling disk, h = 1/12 cm, 20 ms: Re_max %.3f\n", summary("fall", "results.re_max"));
    assert_between(summary("fall", "results.re_max") / re[0], 0.99, 1.01);
}

/* Position at a fixed time with three steps, bodies placed once in a step and twice. */
static void falling_disk_is_of_second_order_in_time(void **state)
{
    (void)state;
    for (int iterations = 0; iterations < 2; iterations++) {
        double y[3], order;

        for (int k = 0; k < 3; k++) {
            assert_ran(plugflow("run cases/falling_disk.lua --quiet --set n=12 --set dt=%g --set stop=0.3 --set "
                                "iterations=%d --out "
                                "%s/fall",
                                0.01 / (1 << k), iterations, scratch()),
                       0, NULL);
            y[k] = summary("fall", "results.y");
        }
        order = log2((y[0] - y[1]) / (y[1] - y[2]));
        print_message("# falling disk, %d iterations of the geometry, y(0.3 s) = %.6f, %.6f, %.6f at 10, 5, 2.5 "
                      "ms: order %.2f\n",
                      iterations, y[0], y[1], y[2], order);
        assert_between(order, 1.8, 2.3);
    }
}

/* Jeffery 1922: T = 2 pi (r + 1/r) / shear rate, r = 2. */
static void an_ellipse_turns_with_jefferys_period(void **state)
{
    (void)state;
    assert_ran(plugflow("run cases/jeffery_ellipse.lua --quiet --out %s/jeffery", scratch()), 0, NULL);
    print_message("# ellipse in shear: period %.3f\n", summary("jeffery", "results.period"));
    assert_between(summary("jeffery", "results.period") / 15.707963, 0.99, 1.01);
}

static void many_bodies_meet_without_a_failed_run(void **state)
{
    (void)state;
    assert_ran(plugflow("run cases/two_disks.lua --quiet --out %s/two", scratch()), 0, NULL);
    print_message("# two disks: smallest gap %.3f diameters\n", summary("two", "results.smallest_gap"));
    assert_between(summary("two", "results.smallest_gap"), -0.01, 1);
    assert_ran(plugflow("run cases/fifty_disks.lua --quiet --out %s/fifty", scratch()), 0, NULL);
    print_message("# fifty disks: smallest gap %.3f diameters, %g steps halved\n",
                  summary("fifty", "results.smallest_gap"), summary("fifty", "steps_halved"));
    assert_ran(plugflow("run cases/ten_spheres.lua --quiet --out %s/ten", scratch()), 0, NULL);
    print_message("# ten spheres: smallest gap %.4f, above the floor %.4f, %g steps halved\n",
                  summary("ten", "results.smallest_gap"), summary("ten", "results.above_floor"),
                  summary("ten", "steps_halved"));
    assert_true(summary("ten", "results.above_floor") > 0);
}

/* ten Cate et al. 2002. */
static void settling_spheres_agree_with_the_experiment(void **state)
{
    (void)state;
    assert_ran(plugflow("run cases/settling_sphere.lua --quiet --out %s/settle", scratch()), 0, NULL);
    print_message("# settling sphere, E4, D/h = 4: %.4f of the experiment's speed\n",
                  summary("settle", "results.ratio"));
    assert_between(summary("settle", "results.ratio"), 0.96, 1.04);
    assert_ran(
        plugflow("run cases/settling_sphere.lua --quiet --set case=E1 --set dt=0.05 --set stop=2.5 --out %s/settle",
                 scratch()),
        0, NULL);
    print_message("# settling sphere, E1, D/h = 4: %.4f of the experiment's speed\n",
                  summary("settle", "results.ratio"));
    assert_between(summary("settle", "results.ratio"), 0.96, 1.04);
}

/* Schaefer and Turek 2D-2: cD max 3.22-3.24, cL max 0.99-1.01 (amplitude), St 0.295-0.305. */
static void dfg_2d_2_on_a_box_mesh(void **state)
{
    (void)state;
    assert_ran(plugflow("run cases/cylinder2d_unfitted.lua --quiet --set unsteady=true --out %s/dfg", scratch()), 0,
               NULL);
    print_message("# DFG 2D-2 unfitted: cd max %.4f, cl %.4f to %.4f, St %.4f\n", summary("dfg", "results.cd_max"),
                  summary("dfg", "results.cl_min"), summary("dfg", "results.cl_max"),
                  summary("dfg", "results.strouhal"));
    assert_between(summary("dfg", "results.cd_max"), 3.22, 3.24);
    assert_between(summary("dfg", "results.cl_amplitude"), 0.99, 1.01);
    assert_between(summary("dfg", "results.strouhal"), 0.295, 0.305);
}

/* Feng, Hu and Joseph 1994: 0.463 at t = 60; a second curve of theirs has 0.460. */
static void a_disk_drifts_to_the_middle_of_couette_flow(void **state)
{
    (void)state;
    assert_ran(plugflow("run cases/couette_migration.lua --quiet --out %s/drift", scratch()), 0, NULL);
    print_message("# disk in Couette flow: y = %.4f, %.4f, %.4f at 20, 40, 60\n", summary("drift", "results.y_20"),
                  summary("drift", "results.y_40"), summary("drift", "results.y_60"));
    assert_between(summary("drift", "results.y_20"), 0.33, 0.355);
    assert_between(summary("drift", "results.y_40"), 0.405, 0.43);
    assert_between(summary("drift", "results.y_60"), 0.45, 0.47);
}

/* Pan and Glowinski 2002: 0.2723 in the end. */
static void a_disk_drifts_off_the_middle_of_poiseuille_flow(void **state)
{
    (void)state;
    assert_ran(plugflow("run cases/poiseuille_migration.lua --quiet --out %s/drift", scratch()), 0, NULL);
    print_message("# disk in Poiseuille flow: y = %.4f after a way of %.2f\n", summary("drift", "results.y"),
                  summary("drift", "results.way"));
    assert_between(summary("drift", "results.y") - 0.2723, -0.01, 0.01);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sphere_at_4_and_6_cells),
        cmocka_unit_test(a_rolling_sphere),
        cmocka_unit_test(falling_disk_on_three_meshes),
        cmocka_unit_test(falling_disk_is_of_second_order_in_time),
        cmocka_unit_test(an_ellipse_turns_with_jefferys_period),
        cmocka_unit_test(many_bodies_meet_without_a_failed_run),
        cmocka_unit_test(settling_spheres_agree_with_the_experiment),
        cmocka_unit_test(dfg_2d_2_on_a_box_mesh),
        cmocka_unit_test(a_disk_drifts_to_the_middle_of_couette_flow),
        cmocka_unit_test(a_disk_drifts_off_the_middle_of_poiseuille_flow),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
