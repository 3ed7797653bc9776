/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Bodies by multipliers: exact Stokes forces, balance of momentum, bodies that must not move. */
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static void disk(const char *mode, int n, double largest, double mean)
{
    static const char *const place[] = {"--set x0=0.013 --set y0=0.0091", "--set x0=0 --set y0=0",
                                        "--set x0=0.0231 --set y0=-0.0177"};
    double sum = 0;

    for (int k = 0; k < 3; k++) {
        double e;

        assert_ran(plugflow("run cases/fixed_disk.lua --quiet --set formulation=conservative --set mode=%s --set "
                            "n=%d %s --out %s/disk",
                            mode, n, place[k], scratch()),
                   0, NULL);
        e = summary("disk", mode[0] == 't' ? "results.force" : "results.torque") - 1;
        print_message("# disk, %s, D/h = %g, place %d: error %.2f %%\n", mode, 0.4 * n, k, 100 * e);
        assert_between(e, -largest, largest);
        sum += e;
    }
    assert_between(sum / 3, -mean, mean);
}

static void force_on_a_disk_at_8_cells(void **state)
{
    (void)state;
    disk("tr", 20, 0.07, 0.05);
}

static void torque_on_a_disk_at_8_cells(void **state)
{
    (void)state;
    disk("rot", 20, 0.07, 0.035);
}

static void force_on_a_disk_at_16_cells(void **state)
{
    (void)state;
    disk("tr", 40, 0.015, 0.015);
}

static void torque_on_a_disk_at_16_cells(void **state)
{
    (void)state;
    disk("rot", 40, 0.015, 0.015);
}

/* What the body takes, the walls give: on a steady creeping flow all forces add up to zero.  The sides
 * without tangential forces leave the inflow and the body to balance along x. */
static void momentum_balance_is_closed(void **state)
{
    const char *path = put_file(
        "balance.lua",
        "mesh { box = {{-0.5,-0.5},{0.5,0.5}}, cells = {14,14} }\nfluid { density = 1, viscosity = 0.1 }\n"
        "term \"continuity\" {}\nterm \"momentum\" { without = {\"convection\"} }\nparticulate \"conservative\"\n"
        "boundary \"left\" { u = function(x, y) return 1 - 4*y*y, 0 end }\nboundary \"right\" { natural = true }\n"
        "boundary \"top\" { symmetry = true }\nboundary \"bottom\" { symmetry = true }\n"
        "particle { shape = disk{radius=0.2}, density = 1, at = {0.01,0.02}, motion = \"fixed\" }\n"
        "output { forces = {\"left\"} }\n");
    char file[300];
    double *body, *wall;

    (void)state;
    assert_ran(plugflow("run %s --quiet --out %s/balance", path, scratch()), 0, NULL);
    snprintf(file, sizeof file, "%s/balance/particles.csv", scratch());
    assert_true(csv_column(file, "fx", &body) == 1);
    snprintf(file, sizeof file, "%s/balance/forces.csv", scratch());
    assert_true(csv_column(file, "left.fx", &wall) == 1);
    assert_true(fabs(body[0]) > 0.1);
    assert_between((body[0] + wall[0]) / body[0], -1e-10, 1e-10);
    free(body);
    free(wall);
}

/* A free neutral disk in shear turns with half the shear rate; in the centre its velocity is zero but for
 * round-off. */
static void a_disk_in_shear_turns_with_half_the_rate(void **state)
{
    static const char *const place[] = {"--set x0=0.013 --set y0=0.0091", "--set x0=0 --set y0=0",
                                        "--set x0=0.0231 --set y0=-0.0177"};

    (void)state;
    for (int k = 0; k < 3; k++) {
        assert_ran(plugflow("run cases/sheared_disk.lua --quiet --set formulation=conservative %s --out %s/shear",
                            place[k], scratch()),
                   0, NULL);
        print_message("# disk in shear, D/h = 11, place %d: omega %.4f\n", k, summary("shear", "results.omega"));
        assert_between(summary("shear", "results.omega"), -0.5 * 1.025, -0.5 * 0.975);
    }
}

/* The same in 3D, off the middle, and where the sphere may only turn. */
static void a_sphere_in_shear_turns_with_half_the_rate(void **state)
{
    static const char *const hold[] = {"nothing", "place"};

    (void)state;
    for (int k = 0; k < 2; k++) {
        assert_ran(
            plugflow(
                "run cases/sheared_sphere.lua --quiet --set formulation=conservative --set hold=%s --out %s/shear",
                hold[k], scratch()),
            0, NULL);
        print_message("# sphere in shear, D/h = 5, hold = %s: omega %.4f\n", hold[k],
                      summary("shear", "results.omega"));
        assert_between(summary("shear", "results.omega"), -0.5 * 1.03, -0.5 * 0.97);
    }
}

static void a_turning_disk_has_its_torque_and_angle(void **state)
{
    (void)state;
    assert_ran(
        plugflow("run cases/rotating_disk.lua --quiet --set formulation=conservative --out %s/turn", scratch()), 0,
        NULL);
    assert_between(summary("turn", "results.torque"), 0.93, 1.07);
    assert_between(summary("turn", "results.angle"), 0.5 - 1e-12, 0.5 + 1e-12);
}

/* Order of a result from three steps, each half of the one before. */
static double order_in_time(const char *arguments, const char *result)
{
    double v[3];

    for (int k = 0; k < 3; k++) {
        char name[100];

        assert_ran(plugflow("run tests/verify/spinning_disk.lua --quiet %s --set dt=%g --out %s/spin", arguments,
                            0.05 / (1 << k), scratch()),
                   0, NULL);
        snprintf(name, sizeof name, "results.%s", result);
        v[k] = summary("spin", name);
    }
    return log2((v[0] - v[1]) / (v[1] - v[2]));
}

static void bodies_are_of_second_order_in_time(void **state)
{
    static const struct {
        const char *arguments, *result;
    } what[] = {{"", "v"},
                {"", "torque"},
                {"--set free=true", "omega"},
                {"--set free=true", "angle"},
                {"--set free=true", "v"}};

    (void)state;
    for (int k = 0; k < 5; k++) {
        double order = order_in_time(what[k].arguments, what[k].result);

        print_message("# order in time of %s (%s): %.2f\n", what[k].result,
                      *what[k].arguments ? "free" : "prescribed", order);
        assert_between(order, 1.8, 2.4);
    }
}

static void a_neutral_body_does_not_notice_gravity(void **state)
{
    (void)state;
    assert_ran(plugflow("run cases/neutral.lua --quiet --set formulation=conservative --out %s/neutral", scratch()),
               0, NULL);
    assert_between(summary("neutral", "results.relative"), 0, 1e-9);
}

static void a_neutral_body_in_3d_does_not_notice_gravity(void **state)
{
    static const char *const column[] = {"u", "v", "w", "omega_x", "omega_y", "omega_z"};
    char file[300];

    (void)state;
    assert_ran(plugflow("run %s --quiet --out %s/neutral3",
                        put_file("neutral3.lua",
                                 "mesh { box = {{0,0,0},{1,1,1}}, cells = {5,5,5} }\n"
                                 "fluid { density = 1, viscosity = 0.01, gravity = {3, -9.81, 5} }\n"
                                 "term \"continuity\" {}\nterm \"momentum\" {}\nparticulate \"conservative\"\n"
                                 "boundary \"*\" { u = {0,0,0} }\n"
                                 "particle { shape = ellipsoid { a = 0.3, b = 0.25, c = 0.28 }, density = 1,\n"
                                 "  at = {0.47, 0.53, 0.51}, orientation = {0.9, 0.1, 0.3, 0.2} }\n"
                                 "time { step = 1e-2, stop = 1 }\n"),
                        scratch()),
               0, NULL);
    snprintf(file, sizeof file, "%s/neutral3/particles.csv", scratch());
    for (int k = 0; k < 6; k++) {
        double *v;
        int n = step_column(file, column[k], &v);

        assert_int_equal(n, 100);
        for (int i = 0; i < n; i++)
            assert_between(v[i], -1e-9 * 0.11, 1e-9 * 0.11);
        free(v);
    }
}

/* Zick and Homsy (1982): K = 2.008 and 2.810; a sphere cut by two symmetry planes, periodic along the flow. */
static void drag_of_a_periodic_array_of_spheres(void **state)
{
    static const struct {
        double phi, k;
    } table[] = {{0.027, 2.008}, {0.064, 2.81}};

    (void)state;
    for (int i = 0; i < 2; i++) {
        double e[2];

        for (int n = 0; n < 2; n++) {
            assert_ran(plugflow("run cases/sphere_array.lua --quiet --set formulation=conservative --set n=%d "
                                "--set phi=%g --out %s/array",
                                n ? 12 : 8, table[i].phi, scratch()),
                       0, NULL);
            e[n] = summary("array", "results.K") / table[i].k - 1;
        }
        print_message("# array of spheres, volume fraction %g: K off by %.2f %% (n = 8), %.2f %% (n = 12)\n",
                      table[i].phi, 100 * e[0], 100 * e[1]);
        assert_between(e[1], -0.03, 0.03);
        assert_between(fabs(e[1]), 0, fabs(e[0]));
    }
}

/* The pressure that is written is the full one. */
static void the_hydrostatic_pressure_is_written(void **state)
{
    char file[300];
    double *v;

    (void)state;
    assert_ran(
        plugflow(
            "run %s --quiet --out %s/rest",
            put_file("rest.lua",
                     "mesh { box = {{0,0},{1,1}}, cells = {10,10} }\n"
                     "fluid { density = 2, viscosity = 0.1, gravity = {0, -10} }\n"
                     "term \"continuity\" {}\nterm \"momentum\" {}\nparticulate \"conservative\"\n"
                     "boundary \"*\" { u = {0,0} }\n"
                     "particle { shape = disk{radius=0.2}, density = 2, at = {0.5,0.5} }\n"
                     "time { step = 0.1, stop = 0.2 }\noutput { probes = { low = {0.5,0}, high = {0.5,1} } }\n"),
            scratch()),
        0, NULL);
    snprintf(file, sizeof file, "%s/rest/probes.csv", scratch());
    assert_true(csv_column(file, "low.p", &v) > 0);
    assert_between(v[0], -1e-9, 1e-9); /* rho g.y at y = 0 */
    free(v);
    csv_column(file, "high.p", &v);
    assert_between(v[0], -20 - 1e-9, -20 + 1e-9);
    free(v);
}

static void light_and_heavy_bodies_are_stable_at_one_step(void **state)
{
    static const char *const density[] = {"0.5", "1", "1.001", "1.25", "10"};
    double before = 10;

    (void)state;
    for (int k = 0; k < 5; k++) {
        assert_ran(plugflow("run cases/falling_disk.lua --quiet --set formulation=conservative --set n=10 --set "
                            "dt=0.005 --set density=%s --set "
                            "stop=0.05 --out %s/d",
                            density[k], scratch()),
                   0, NULL);
        assert_between(summary("d", "steps_halved"), 0, 0);
        assert_between(summary("d", "results.y"), 3, before - (k ? 1e-6 : 0)); /* the heavier, the lower */
        before = summary("d", "results.y");
    }
}

/* Terminal velocity is reached within a few per cent even at three cells per diameter. */
static void a_disk_falls_and_rests_above_the_floor(void **state)
{
    (void)state;
    assert_ran(plugflow("run cases/falling_disk.lua --quiet --set formulation=conservative --set n=12 --set "
                        "dt=0.01 --set stop=0.9 --out %s/fall",
                        scratch()),
               0, NULL);
    print_message("# falling disk, 12 cells per cm: Re_max %.2f, at rest at y = %.4f\n",
                  summary("fall", "results.re_max"), summary("fall", "results.y"));
    assert_between(summary("fall", "results.re_max"), 16, 18);
    assert_between(summary("fall", "results.y"), 0.125, 0.125 + 0.06);
}

static void a_body_outside_the_mesh_or_misspelt_is_told(void **state)
{
    (void)state;
    assert_ran(
        plugflow("run %s --out %s/bad",
                 put_file("far.lua",
                          "mesh { box = {{0,0},{1,1}}, cells = {8,8} }\nfluid { density = 1, viscosity = 1 }\n"
                          "term \"continuity\" {}\nterm \"momentum\" {}\nparticulate \"conservative\"\n"
                          "boundary \"*\" { u = {0,0} }\n"
                          "particle { shape = disk{radius=0.2}, density = 2, at = {3,0.5} }\ntime { step = 0.1, "
                          "stop = 1 }\n"),
                 scratch()),
        3, "far.lua:7: particle 0 at (3, 0.5) lies outside of the mesh");
    assert_ran(
        plugflow("run %s --out %s/bad",
                 put_file("slip.lua",
                          "mesh { box = {{0,0},{1,1}}, cells = {8,8} }\nfluid { density = 1, viscosity = 1 }\n"
                          "term \"continuity\" {}\nterm \"momentum\" {}\nparticulate \"conservative\"\n"
                          "boundary \"*\" { u = {0,0} }\n"
                          "particle { shape = disk{radius=0.2}, denstiy = 2, at = {0.5,0.5} }\n"),
                 scratch()),
        3, "slip.lua:7: particle: unknown key \"denstiy\"; did you mean \"density\"");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(force_on_a_disk_at_8_cells),
        cmocka_unit_test(torque_on_a_disk_at_8_cells),
        cmocka_unit_test(force_on_a_disk_at_16_cells),
        cmocka_unit_test(torque_on_a_disk_at_16_cells),
        cmocka_unit_test(momentum_balance_is_closed),
        cmocka_unit_test(a_disk_in_shear_turns_with_half_the_rate),
        cmocka_unit_test(a_sphere_in_shear_turns_with_half_the_rate),
        cmocka_unit_test(a_turning_disk_has_its_torque_and_angle),
        cmocka_unit_test(bodies_are_of_second_order_in_time),
        cmocka_unit_test(a_neutral_body_does_not_notice_gravity),
        cmocka_unit_test(a_neutral_body_in_3d_does_not_notice_gravity),
        cmocka_unit_test(drag_of_a_periodic_array_of_spheres),
        cmocka_unit_test(the_hydrostatic_pressure_is_written),
        cmocka_unit_test(light_and_heavy_bodies_are_stable_at_one_step),
        cmocka_unit_test(a_disk_falls_and_rests_above_the_floor),
        cmocka_unit_test(a_body_outside_the_mesh_or_misspelt_is_told),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
