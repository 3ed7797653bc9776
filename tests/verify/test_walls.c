/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Bodies and walls on every mesh: the contact force is that of the formula at the true gap, and no step carries a
 * body through a wall or through another body. */
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define FLUID                                                                                                      \
    "fluid { density = 1, viscosity = 1 }\nterm 'continuity' {}\nterm 'momentum' { without = {'convection'} }\n"   \
    "particulate 'conservative'\n"
#define WALLS "boundary '*' { u = {0,0} }\n"
/* A disk driven at 45 degrees for three steps; it ends 0.02 above the floor of the unit square. */
#define DRIVEN(x, y)                                                                                               \
    "term 'contact.repulsion' { range = 0.1, force = 2 }\n"                                                        \
    "particle { shape = disk{radius=0.15}, density = 2, at = {" x "," y "}, motion = 'prescribed', "               \
    "velocity = {1,-1} }\ntime { step = 0.01, stop = 0.03 }\n"

/* What is printed must be the formula at the gap to the plane wall through the origin with this normal, or to the
 * round wall of radius 0.5 about the origin. */
static void compare(const char *mesh, const char *particle, const double *normal, double bound, int line)
{
    char file[300];
    double *x, *y, *cx, *cy;
    int n;

    put_file("wall.lua", "");
    snprintf(file, sizeof file, "%s/wall.lua", scratch());
    {
        FILE *f = fopen(file, "w");

        assert_non_null(f);
        fprintf(f, "%s%s%s%s", mesh, FLUID, WALLS, particle);
        assert_int_equal(fclose(f), 0);
    }
    assert_ran(plugflow("run %s/wall.lua --quiet --out %s/wall", scratch(), scratch()), 0, NULL);
    snprintf(file, sizeof file, "%s/wall/particles.csv", scratch());
    n = step_column(file, "x", &x);
    assert_int_equal(step_column(file, "y", &y), n);
    assert_int_equal(step_column(file, "contact_x", &cx), n);
    assert_int_equal(step_column(file, "contact_y", &cy), n);
    assert_int_equal(n, 3);
    for (int i = 0; i < n; i++) {
        double r = hypot(x[i], y[i]), nx = normal ? normal[0] : -x[i] / r, ny = normal ? normal[1] : -y[i] / r;
        double gap = (normal ? x[i] * nx + y[i] * ny : 0.5 - r) - 0.15, f = 2 * pow(1 - gap / 0.1, 2);

        if (!(gap > 0 && gap < 0.1 && fabs(cx[i] - f * nx) < bound && fabs(cy[i] - f * ny) < bound))
            fail_msg("line %d: at (%g, %g), gap %g: contact (%.9g, %.9g), expected (%.9g, %.9g)", line, x[i], y[i],
                     gap, cx[i], cy[i], f * nx, f * ny);
    }
    free(x), free(y), free(cx), free(cy);
}

/* The floor of a box, of the box turned by 0.3, and of a mesh by Gmsh: the force is the formula's. */
static void a_plane_wall_pushes_by_the_formula_on_every_mesh(void **state)
{
    static const double up[2] = {0, 1};
    const double turned[2] = {-sin(0.3), cos(0.3)};

    (void)state;
    compare("mesh { box = {{0,0},{1,1}}, cells = {12,12} }\n", DRIVEN("0.5", "0.2"), up, 1e-9, __LINE__);
    compare("local c, s = math.cos(0.3), math.sin(0.3)\nmesh { box = {{0,0},{1,1}}, cells = {12,12}, "
            "map = function(x, y) return c*x - s*y, s*x + c*y end }\n",
            DRIVEN("0.38", "0.345"), turned, 1e-9, __LINE__);
    put_file("square.geo", "SetFactory(\"OpenCASCADE\");\nRectangle(1) = {0, 0, 0, 1, 1};\n"
                           "Mesh.MeshSizeMax = 0.08;\nMesh.RecombineAll = 1;\n"
                           "Physical Curve(\"wall\") = {1, 2, 3, 4};\nPhysical Surface(\"fluid\") = {1};\n");
    compare("mesh { file = 'square.geo' }\n", DRIVEN("0.5", "0.2"), up, 1e-9, __LINE__);
}

/* A round wall: facets of second order, a = 0.1 of the circle each, lie within R a^4/128 = 4e-7 of it; the force
 * changes by at most 40 times the change of the gap. */
static void a_round_wall_pushes_by_the_formula(void **state)
{
    (void)state;
    put_file("round.geo", "SetFactory(\"OpenCASCADE\");\nDisk(1) = {0, 0, 0, 0.5};\nMesh.MeshSizeMax = 0.05;\n"
                          "Mesh.RecombineAll = 1;\nMesh.ElementOrder = 2;\n"
                          "Physical Curve(\"wall\") = {1};\nPhysical Surface(\"fluid\") = {1};\n");
    compare("mesh { file = 'round.geo' }\n", DRIVEN("0.17", "-0.17"), NULL, 2e-5, __LINE__);
}

#define FAST                                                                                                       \
    "mesh { box = {{0,0},{1,1}}, cells = {20,20} }\nfluid { density = 1, viscosity = 0.1, gravity = {0,-100} }\n"  \
    "term 'continuity' {}\nterm 'momentum' {}\nparticulate 'conservative'\n" WALLS

/* A disk that a step would carry through the floor: with a contact force the step is shortened and said so; the
 * disk stays above the floor.  Without one the run ends and names the term. */
static void no_step_carries_a_body_through_a_wall(void **state)
{
    char file[300];
    double *y;
    int n;

    (void)state;
    put_file("fast.lua", "local contact = param('contact', 1)\n" FAST
                         "if contact == 1 then term 'contact.repulsion' { range = 0.1 } end\n"
                         "particle { shape = disk{radius=0.15}, density = 8, at = {0.5,0.35} }\n"
                         "time { step = 0.05, stop = 1 }\n");
    assert_ran(plugflow("run %s/fast.lua --quiet --out %s/fast", scratch(), scratch()), 0, "is shortened",
               "boundary \"bottom\"");
    assert_true(summary("fast", "steps_shortened") > 0);
    snprintf(file, sizeof file, "%s/fast/particles.csv", scratch());
    n = step_column(file, "y", &y);
    assert_int_equal(n, 20);
    for (int i = 0; i < n; i++)
        assert_true(y[i] > 0.15 && y[i] < 0.5);
    free(y);
    assert_ran(plugflow("run %s/fast.lua --quiet --set contact=0 --out %s/fast0", scratch(), scratch()), 6,
               "contact.repulsion", "boundary \"bottom\"");
}

/* Two disks driven at each other: they would change places in one step. */
static void no_step_carries_bodies_through_each_other(void **state)
{
    (void)state;
    put_file("meet.lua", FAST "particle { shape = disk{radius=0.1}, density = 2, at = {0.3,0.5}, motion = "
                              "'prescribed', velocity = {1,0} }\nparticle { shape = disk{radius=0.1}, density = "
                              "2, at = {0.7,0.5}, motion = 'prescribed', velocity = {-1,0} }\n"
                              "time { step = 0.11, stop = 0.33 }\n");
    assert_ran(plugflow("run %s/meet.lua --quiet --out %s/meet", scratch(), scratch()), 6,
               "particles 0 and 1 would come nearer by");
}

/* Paths reach three cells: a longer way in a step is gone in shorter steps, to the same place. */
static void a_long_way_is_gone_in_shorter_steps(void **state)
{
    char file[300];
    double *x;
    int n;

    (void)state;
    put_file("way.lua", FAST "particle { shape = disk{radius=0.1}, density = 2, at = {0.2,0.5}, motion = "
                             "'prescribed', velocity = {1,0} }\ntime { step = 0.28, stop = 0.56 }\n");
    assert_ran(plugflow("run %s/way.lua --quiet --out %s/way", scratch(), scratch()), 0, "cells, at most 3");
    snprintf(file, sizeof file, "%s/way/particles.csv", scratch());
    n = step_column(file, "x", &x);
    assert_int_equal(n, 2);
    assert_between(x[0] - 0.48, -1e-12, 1e-12);
    assert_between(x[1] - 0.76, -1e-12, 1e-12);
    assert_true(summary("way", "steps_shortened") == 2);
    free(x);
}

/* A way of a whole period is no rest, and a long body that turns goes a long way at its ends. */
static void ways_are_seen_whole(void **state)
{
    char file[300];
    double *x;

    (void)state;
    put_file(
        "period.lua",
        "local turn = param('turn', 0)\nmesh { box = {{0,0},{1,1}}, cells = {20,20} }\n"
        "fluid { density = 1, viscosity = 1 }\nterm 'continuity' {}\nterm 'momentum' {}\n"
        "particulate 'conservative'\nboundary { periodic = {'left','right'} }\nboundary '*' { u = {0,0} }\n"
        "particle { shape = turn > 0 and ellipse{a=0.3,b=0.1} or disk{radius=0.1}, density = 2, at = {0.5,0.5}, "
        "motion = 'prescribed', velocity = {turn > 0 and 0 or 10,0}, spin = turn }\n"
        "time { step = 0.1, stop = 0.1 }\n");
    assert_ran(plugflow("run %s/period.lua --quiet --out %s/period", scratch(), scratch()), 0,
               "particle 0 would move by 20 cells");
    assert_true(summary("period", "steps_shortened") >= 3);
    snprintf(file, sizeof file, "%s/period/particles.csv", scratch());
    assert_int_equal(step_column(file, "x", &x), 1);
    assert_between(x[0] - 0.5, -1e-12, 1e-12);
    free(x);
    assert_ran(plugflow("run %s/period.lua --quiet --set turn=10 --out %s/period", scratch(), scratch()), 0,
               "particle 0 would move by 6 cells");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_plane_wall_pushes_by_the_formula_on_every_mesh),
        cmocka_unit_test(a_round_wall_pushes_by_the_formula),
        cmocka_unit_test(no_step_carries_a_body_through_a_wall),
        cmocka_unit_test(no_step_carries_bodies_through_each_other),
        cmocka_unit_test(a_long_way_is_gone_in_shorter_steps),
        cmocka_unit_test(ways_are_seen_whole),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
