/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Flows that lie in the finite element spaces come out exact. */
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static void solve(const char *arguments)
{
    assert_ran(plugflow("run %s --quiet --out %s/o", arguments, scratch()), 0, NULL);
}

static double last(const char *file, const char *column)
{
    char path[400];
    double *v, x;
    int n;

    snprintf(path, sizeof path, "%s/o/%s", scratch(), file);
    n = csv_column(path, column, &v);
    x = n > 0 ? v[n - 1] : NAN;
    free(v);
    return x;
}

static void poiseuille_is_exact(void **state)
{
    (void)state;
    for (int k = 0; k < 2; k++) {
        solve(k ? "cases/channel.lua --set shape=triangles" : "cases/channel.lua");
        assert_between(summary("o", "errors.u.l2"), 0, 1e-11);
        assert_between(summary("o", "errors.p.l2"), 0, 1e-11);
    }
}

static void couette_is_exact(void **state)
{
    (void)state;
    for (int k = 0; k < 2; k++) {
        solve(k ? "cases/couette.lua --set shape=triangles" : "cases/couette.lua");
        assert_between(summary("o", "errors.u.l2"), 0, 1e-11);
        assert_between(summary("o", "errors.p.l2"), 0, 1e-11);
        assert_between(last("forces.csv", "bottom.fx"), 1 - 1e-11, 1 + 1e-11);
        assert_between(last("forces.csv", "top.fx"), -1 - 1e-11, -1 + 1e-11);
    }
}

/* A uniform flow through a periodic box, pushed by a body force: u = t f / rho, the same everywhere. */
static void uniform_flow_through_a_periodic_box_is_exact(void **state)
{
    static const char *const shape[] = {"quads", "triangles", "hexes", "tets"};

    (void)state;
    for (int k = 0; k < 4; k++) {
        int d3 = k >= 2;
        const char *path;
        char text[1500];

        snprintf(text, sizeof text,
                 "mesh { box = {{0,0%s},{2,1%s}}, cells = {3,2%s}, shape = \"%s\" }\n"
                 "fluid { density = 2, viscosity = 0.3 }\n"
                 "term \"continuity\" {}\nterm \"momentum\" { force = {4, 2%s} }\n"
                 "boundary { periodic = {\"left\", \"right\"} }\nboundary { periodic = {\"bottom\", \"top\"} }\n%s"
                 "initial { u = {1, -1%s} }\n"
                 "exact { u = function(x, y%s, t) return 1 + 2 * t, -1 + t%s end, p = 0 }\n"
                 "time { step = 0.1, stop = 0.5 }\n",
                 d3 ? ",0" : "", d3 ? ",1" : "", d3 ? ",2" : "", shape[k], d3 ? ", 0" : "",
                 d3 ? "boundary { periodic = {\"back\", \"front\"} }\n" : "", d3 ? ", 0" : "", d3 ? ", z" : "",
                 d3 ? ", 0" : "");
        path = put_file("uniform.lua", text);
        solve(path);
        assert_between(summary("o", "errors.u.l2"), 0, 1e-11);
        assert_between(summary("o", "errors.u.h1"), 0, 1e-9);
        assert_between(summary("o", "errors.p.l2"), 0, 1e-10);
    }
}

/* Fluid at rest under gravity: the pressure carries it, whatever the direction. */
static void fluid_at_rest_stays_at_rest(void **state)
{
    const char *path =
        put_file("rest.lua", "mesh { box = {{0,0},{1,1}}, cells = {5,4} }\n"
                             "fluid { density = 3, viscosity = 1e-3, gravity = {2, -9.81} }\n"
                             "term \"continuity\" {}\nterm \"momentum\" {}\nboundary \"*\" { u = {0,0} }\n"
                             "exact { u = {0,0}, p = function(x, y) return 3 * (2 * x - 9.81 * y) end }\n");

    (void)state;
    solve(path);
    assert_between(summary("o", "errors.u.l2"), 0, 1e-12);
    assert_between(summary("o", "errors.p.l2"), 0, 1e-12);
}

/* The lower half of a channel with a symmetry line is the lower half of the whole channel. */
static void symmetry_replaces_half_a_channel(void **state)
{
    const char *path = put_file(
        "half.lua", "mesh { box = {{0,0},{2,0.5}}, cells = {4,3} }\nfluid { density = 1, viscosity = 0.1 }\n"
                    "term \"continuity\" {}\nterm \"momentum\" {}\n"
                    "local function profile(x, y) return 4 * y * (1 - y), 0 end\n"
                    "boundary \"left\" { u = profile }\nboundary \"right\" { u = profile }\n"
                    "boundary \"bottom\" { u = {0,0} }\nboundary \"top\" { symmetry = true }\n"
                    "exact { u = profile, p = function(x, y) return -0.8 * x end }\n");

    (void)state;
    solve(path);
    assert_between(summary("o", "errors.u.l2"), 0, 1e-11);
    assert_between(summary("o", "errors.p.l2"), 0, 1e-11);
}

/* Fluid at rest round a body, under a force: the pressure is -10 (y - y_f), y_f the centroid of the fluid; covered
 * parts of cells are known to 1e-8.  (Over the whole box the mean would be 0.15 off.) */
static void the_pressure_has_zero_mean_over_the_fluid(void **state)
{
    const double area = M_PI * 0.15 * 0.15, centre = (0.5 - area * 0.3) / (1 - area);
    char file[300];
    double *p;

    (void)state;
    put_file("round.lua", "mesh { box = {{0,0},{1,1}}, cells = {15,14} }\n"
                          "fluid { density = 1, viscosity = 1 }\n"
                          "term 'continuity' {}\nterm 'momentum' { force = {0,-10} }\nparticulate 'sharp'\n"
                          "boundary '*' { u = {0,0} }\n"
                          "particle { shape = disk{radius=0.15}, density = 1, at = {0.5,0.3}, motion = 'fixed' }\n"
                          "output { probes = { high = {0.1,0.9} } }\n");
    assert_ran(plugflow("run %s/round.lua --quiet --out %s/o", scratch(), scratch()), 0, NULL);
    snprintf(file, sizeof file, "%s/o/probes.csv", scratch());
    assert_int_equal(csv_column(file, "high.p", &p), 1);
    assert_between(p[0] + 10 * (0.9 - centre), -1e-7, 1e-7);
    free(p);
}

/* Channel flow driven by given pressures at both ends: the true ones, with their hydrostatic part, also where the
 * unknown is the reduced pressure. */
static void given_pressures_drive_poiseuille_flow(void **state)
{
    (void)state;
    put_file("driven.lua",
             "local reduced = param('reduced', 0) == 1\nmesh { box = {{0,0},{2,1}}, cells = {6,5} }\n"
             "fluid { density = 2, viscosity = 0.1, gravity = {0,-10}, reduced_pressure = reduced }\n"
             "term 'continuity' {}\nterm 'momentum' {}\n"
             "local function p(x, y) return 1 - 0.2 * x - 20 * y end\n"
             "boundary 'left' { pressure = p, u = {free, 0} }\nboundary 'right' { pressure = p, u = {free, 0} }\n"
             "boundary '*' { u = {0,0} }\n"
             "exact { u = function(x, y) return y * (1 - y), 0 end, "
             "p = function(x, y) return p(x, y) + (reduced and 20 * y or 0) end }\n");
    for (int k = 0; k < 2; k++) {
        assert_ran(plugflow("run %s/driven.lua --quiet --set reduced=%d --out %s/o", scratch(), k, scratch()), 0,
                   NULL);
        assert_between(summary("o", "errors.u.l2"), 0, 1e-11);
        assert_between(summary("o", "errors.p.l2"), 0, 1e-11);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(poiseuille_is_exact),
        cmocka_unit_test(couette_is_exact),
        cmocka_unit_test(uniform_flow_through_a_periodic_box_is_exact),
        cmocka_unit_test(fluid_at_rest_stays_at_rest),
        cmocka_unit_test(symmetry_replaces_half_a_channel),
        cmocka_unit_test(the_pressure_has_zero_mean_over_the_fluid),
        cmocka_unit_test(given_pressures_drive_poiseuille_flow),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
