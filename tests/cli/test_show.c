/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The quantities of the plugin show, on flows for which they are known; and that nothing else of a run changes. */
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FLUID "term 'continuity' {}\nterm 'momentum' {}\n"

static double cell(const char *table, const char *column, int row)
{
    char path[600];
    double *v, x;
    int n;

    snprintf(path, sizeof path, "%s/o/%s", scratch(), table);
    n = csv_column(path, column, &v);
    assert_true(n > row && n > 0);
    x = v[row < 0 ? n - 1 : row];
    free(v);
    return x;
}

static double integral(const char *column)
{
    return cell("integrals.csv", column, -1);
}

static void run(const char *text)
{
    assert_ran(plugflow("run %s --threads 1 --out %s/o", put_file("case.lua", text), scratch()), 0, "ok in");
}

#define assert_close(v, exact, tolerance) assert_between((v) - (exact), -(tolerance), (tolerance))

/* u = 4 y (1 - y) over a length of 3, mu = 0.1: the pressure falls by 2.4, and 2/3 flow through. */
static void poiseuille_flow(const char *shape)
{
    char text[2000];

    snprintf(
        text, sizeof text,
        "mesh { box = {{0,0},{3,1}}, cells = {6, 4}, shape = '%s' }\nfluid { density = 2, viscosity = 0.1 }\n" FLUID
        "term 'show' { only = {'shear_rate', 'vorticity', 'dissipation', 'kinetic_energy', 'enstrophy', "
        "'flow_rate',\n"
        "  'mean_pressure', 'wall_shear', 'wall_force'} }\n"
        "local function profile(x, y) return 4 * y * (1 - y), 0 end\n"
        "boundary 'left' { u = profile }\nboundary '*' { u = {0, 0} }\n"
        "boundary 'right' { traction = function(x, y) return 0, 0.1 * (4 - 8 * y) end }\n"
        "output { probes = { low = {1.31, 0.17}, high = {2.1, 0.84} } }\n"
        "results(function(r) return { mean = r.mean.shear_rate[1], last = r.last['right.flow_rate'] } end)\n",
        shape);
    run(text);
    assert_close(cell("probes.csv", "low.shear_rate", 0), 4 - 8 * 0.17, 1e-11);
    assert_close(cell("probes.csv", "high.shear_rate", 0), 8 * 0.84 - 4, 1e-11);
    assert_close(cell("probes.csv", "low.vorticity", 0), 8 * 0.17 - 4, 1e-11);
    assert_close(cell("probes.csv", "high.vorticity", 0), 8 * 0.84 - 4, 1e-11);
    assert_close(summary("o", "results.mean"), 2, 1e-11);
    assert_close(summary("o", "results.last"), 2.0 / 3, 1e-12);
    assert_close(integral("left.flow_rate"), -2.0 / 3, 1e-12);
    assert_close(integral("top.flow_rate"), 0, 1e-14);
    assert_close(integral("left.pressure") / integral("left.area"), 2.4, 1e-11);
    assert_close(integral("dissipated"), 2.4 * 2 / 3, 1e-11); /* what the pressure puts in */
    assert_close(integral("kinetic_energy"), 3 * 8.0 / 15, 1e-12);
    assert_close(integral("enstrophy"), 3 * 16.0 / 6, 1e-11);
    assert_close(integral("top.wall_shear_x"), 1.2, 1e-11);
    assert_close(integral("bottom.wall_shear_x"), 1.2, 1e-11);
    assert_close(integral("bottom.wall_force_y"), -3.6, 1e-11);
    assert_close(integral("left.wall_force_x"), -2.4, 1e-11);
}

static void all_quantities_of_poiseuille_flow_are_exact(void **state)
{
    (void)state;
    poiseuille_flow("quads");
    poiseuille_flow("triangles");
}

/* In a channel without ends the shear is all that holds the walls. */
static void wall_shear_is_the_reaction_of_the_wall(void **state)
{
    (void)state;
    run("mesh { box = {{0,0},{2,1}}, cells = {4, 5}, shape = 'quads' }\nfluid { density = 1, viscosity = 0.3 }\n"
        "term 'continuity' {}\nterm 'momentum' { force = {0.7, 0} }\nterm 'show.wall_shear' {}\n"
        "boundary { periodic = {'left', 'right'} }\nboundary '*' { u = {0, 0} }\n"
        "output { forces = {'bottom', 'top'}, integrals = {'top', 'bottom'} }\n");
    assert_close(integral("top.wall_shear_x"), 0.7, 1e-12);
    assert_close(integral("top.wall_shear_x"), cell("forces.csv", "top.fx", 0), 1e-12);
    assert_close(integral("bottom.wall_shear_x"), cell("forces.csv", "bottom.fx", 0), 1e-12);
}

static void solid_body_rotation_has_twice_its_spin_as_vorticity(void **state)
{
    (void)state;
    run("mesh { box = {{0,0,0},{1,1,1}}, cells = {2, 3, 2}, shape = 'hexes' }\n"
        "fluid { density = 1, viscosity = 1 }\n" FLUID
        "term 'show.vorticity' {}\nterm 'show.shear_rate' {}\nterm 'show.enstrophy' {}\n"
        "boundary '*' { u = function(x, y, z) return 2 * z - 3 * y, 3 * x - z, y - 2 * x end }\n"
        "output { probes = { a = {0.3, 0.6, 0.2} } }\n");
    assert_close(cell("probes.csv", "a.vorticity_x", 0), 2, 1e-9);
    assert_close(cell("probes.csv", "a.vorticity_y", 0), 4, 1e-9);
    assert_close(cell("probes.csv", "a.vorticity_z", 0), 6, 1e-9);
    assert_close(cell("probes.csv", "a.shear_rate", 0), 0, 1e-9);
    assert_close(integral("enstrophy"), 0.5 * (4 + 16 + 36), 1e-8);
}

/* A wall of conductivity 3 from 1 K to 5 K, 2 m thick: 6 W through each square metre; p is hydrostatic. */
static void heat_and_weight_go_through_boundaries(void **state)
{
    (void)state;
    run("mesh { box = {{0,0},{2,1}}, cells = {3, 2}, shape = 'quads' }\n"
        "fluid { density = 2, viscosity = 1, gravity = {0, -10}, conductivity = 3, heat_capacity = 1 }\n" FLUID
        "term 'heat' {}\nterm 'show.heat_flux' {}\nterm 'show.mean_pressure' {}\n"
        "boundary 'left' { T = 1, u = {0, 0} }\nboundary 'right' { T = 5, u = {0, 0} }\nboundary '*' { u = {0, 0} "
        "}\n");
    assert_close(integral("left.heat_flow"), 6, 1e-10);
    assert_close(integral("right.heat_flow"), -6, 1e-10);
    assert_close(integral("bottom.pressure") - integral("top.pressure"), 2 * 20, 1e-9);
}

/* Volume and surface as the quadrature sees them, and the force by traction against the exact one and the
 * consistent one: it converges, with an order less. */
static void traction_on_a_disk_converges_to_its_force(void **state)
{
    double error[2];

    (void)state;
    for (int k = 0; k < 2; k++) {
        const double force = -4 * M_PI, R = 0.2;

        assert_ran(
            shell("(cat cases/fixed_disk.lua; echo 'term \"show.surface_force\" {} term \"show.surface_area\" {}"
                  " term \"show.covered_volume\" {}') > %s/disk.lua",
                  scratch()),
            0, "");
        assert_ran(plugflow("run %s/disk.lua --set n=%d --threads 1 --out %s/o", scratch(), 20 << k, scratch()), 0,
                   "ok in");
        assert_close(cell("particles.csv", "covered_volume", 0) / (M_PI * R * R), 1, 1e-12);
        assert_close(cell("particles.csv", "surface_area", 0) / (2 * M_PI * R), 1, 1e-9);
        assert_close(cell("particles.csv", "fx", 0) / force, 1, 1e-3);
        error[k] = fabs(cell("particles.csv", "surface_force_x", 0) / force - 1);
    }
    assert_between(error[0], 0, 5e-3);
    assert_between(error[0] / error[1], 3.5, 20);
}

/* Coefficients are forces over half of density, velocity squared and length: on boundaries and on bodies. */
static void coefficients_are_forces_by_the_dynamic_pressure(void **state)
{
    const double unit = 0.5 * 4 * 0.3 * 0.3 * 0.2;

    (void)state;
    run("mesh { box = {{0,0},{1,1}}, cells = {10, 10}, shape = 'quads' }\nfluid { density = 4, viscosity = 1 "
        "}\n" FLUID "particulate 'sharp'\nboundary 'right' { natural = true }\nboundary '*' { u = {0.3, 0} }\n"
        "particle { shape = disk { radius = 0.2 }, density = 1, at = {0.5, 0.53}, motion = 'fixed' }\n"
        "output { forces = {'top', 'bottom'}, coefficients = { density = 4, velocity = 0.3, length = 0.2 } }\n");
    assert_between(cell("particles.csv", "cx", 0), 1, 1000);
    assert_close(cell("particles.csv", "cx", 0) * unit / cell("particles.csv", "fx", 0), 1, 1e-14);
    assert_close(cell("particles.csv", "cy", 0) * unit / cell("particles.csv", "fy", 0), 1, 1e-14);
    assert_close(cell("forces.csv", "top.cx", 0) * unit / cell("forces.csv", "top.fx", 0), 1, 1e-14);
    assert_close(cell("forces.csv", "bottom.cy", 0) * unit / cell("forces.csv", "bottom.fy", 0), 1, 1e-14);
}

/* With everything that can be shown of it, a falling disk falls to the same bits. */
static void what_is_shown_changes_nothing_else(void **state)
{
    static const char *const more[] = {"", " term \"show.vorticity\" {} term \"show.surface_force\" {}"
                                           " term \"show.kinetic_energy\" {} term \"show.flow_rate\" {}"};

    (void)state;
    for (int k = 0; k < 2; k++) {
        assert_ran(shell("(cat cases/falling_disk.lua; echo '%s') > %s/fall.lua", more[k], scratch()), 0, "");
        assert_ran(
            plugflow("run %s/fall.lua --set n=8 --set stop=0.05 --threads 2 --out %s/f%d", scratch(), scratch(), k),
            0, "ok in");
    }
    assert_ran(
        shell("cd %s && cut -d, -f1-14 f1/particles.csv | cmp - f0/particles.csv && cmp f0/particles_00001.vtp "
              "f1/particles_00001.vtp && test ! -e f0/integrals.csv && test -e f1/integrals.csv",
              scratch()),
        0, "");
    /* the weight that the fluid carries is in the pressure, which is the true one here */
    assert_ran(shell("cd %s && rm -rf o && mv f1 o", scratch()), 0, "");
    assert_between(cell("particles.csv", "surface_force_y", -1) / cell("particles.csv", "fy", -1), 0.98, 1.02);
}

/* On one thread and on two the sums have the same order; on each, a run gives the same bytes again. */
static void integrals_are_repeatable(void **state)
{
    (void)state;
    assert_ran(
        shell("(cat cases/fixed_disk.lua; echo 'term \"show.vorticity\" {} term \"show.dissipation\" {} term "
              "\"show.surface_force\" {}') > %s/disk.lua",
              scratch()),
        0, "");
    for (int k = 0; k < 2; k++)
        assert_ran(plugflow("run %s/disk.lua --threads 2 --out %s/t%d", scratch(), scratch(), k), 0, "ok in");
    assert_ran(shell("cd %s && cmp t0/integrals.csv t1/integrals.csv && cmp t0/particles.csv t1/particles.csv && "
                     "cmp t0/fields_00000.vtu t1/fields_00000.vtu",
                     scratch()),
               0, "");
}

static void what_shows_a_field_is_told(void **state)
{
    const char *box = "mesh { box = {{0,0},{1,1}}, cells = {2, 2}, shape = 'quads' }\n"
                      "fluid { density = 1, viscosity = 1 }\n" FLUID "boundary '*' { u = {0, 0} }\n";
    char text[1000];

    (void)state;
    snprintf(text, sizeof text, "%soutput { fields = {'vorticity'} }\n", box);
    assert_ran(plugflow("check %s", put_file("case.lua", text)), 3,
               "output: there is no field \"vorticity\"; there are: u (velocity), p (pressure); the line term "
               "\"show.vorticity\" {} shows it");
    snprintf(text, sizeof text, "%sterm 'show.flow_rate' {}\noutput { integrals = {'lefft'} }\n", box);
    assert_ran(plugflow("check %s", put_file("case.lua", text)), 3,
               "output: integrals: no boundary is called \"lefft\"; did you mean \"left\"?");
    snprintf(text, sizeof text, "%sterm 'show' {}\n", box);
    assert_ran(plugflow("check %s", put_file("case.lua", text)), 3,
               "term \"show\": all its terms are off unless they are named, as in only = {\"shear_rate\"}");
    snprintf(text, sizeof text, "%sterm 'show' { only = {'vorticty'} }\n", box);
    assert_ran(plugflow("check %s", put_file("case.lua", text)), 3,
               "plugin \"show\" has no term \"vorticty\"; did you mean \"vorticity\"?");
    snprintf(text, sizeof text, "%soutput { coefficients = { density = 1, velocity = 2, area = 1 } }\n", box);
    assert_ran(plugflow("check %s", put_file("case.lua", text)), 3, "output: coefficients", "\"area\"", "length");
    assert_ran(plugflow("describe show.dissipation"), 0, "dissipation", "shown, scalar, W/m^3",
               "integral, scalar, W");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_quantities_of_poiseuille_flow_are_exact),
        cmocka_unit_test(wall_shear_is_the_reaction_of_the_wall),
        cmocka_unit_test(solid_body_rotation_has_twice_its_spin_as_vorticity),
        cmocka_unit_test(heat_and_weight_go_through_boundaries),
        cmocka_unit_test(traction_on_a_disk_converges_to_its_force),
        cmocka_unit_test(coefficients_are_forces_by_the_dynamic_pressure),
        cmocka_unit_test(what_is_shown_changes_nothing_else),
        cmocka_unit_test(integrals_are_repeatable),
        cmocka_unit_test(what_shows_a_field_is_told),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
