/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What would run to a plausible number that is not meant: refused, or doubted in a warning. */
#include "support/bad_case.h"
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#define FIXED(N, KEYS) #N " particle { density = 1, motion = \"fixed\", " KEYS " }\n"

static void bodies_that_mean_something_else_are_doubted(void **state)
{
    static const bad_case list[] = {
        /* the channel is closed, from wall to wall */
        {SHARP FIXED(10, "shape = rectangle { width = 0.5, height = 1 }, at = {1, 0.5}"),
         0,
         {"warning: bodies separate the fluid into 2 parts"}},
        {SHARP FIXED(10, "shape = rectangle { width = 0.5, height = 0.7 }, at = {1, 0.5}"), 0, {"!separate"}},
        {SHARP BODY(10,
                    "shape = disk { radius = 0.3 }, at = {1, 0.5}, motion = \"prescribed\", velocity = {0, -5}"),
         0,
         {"bad.lua:10: particle 0 has a prescribed motion, but the case is steady", "motion = \"fixed\""}},
        {"9 particulate \"conservative\"\n" BODY(10, "shape = disk { radius = 0.005 }, at = {1.02, 0.52}") TIME,
         3,
         {"bad.lua:10: particle 0 is so small that it covers no node"}},
        {"5 term \"momentum\" { viscosity = 1 }\n" SHARP FIXED(10, "shape = disk { radius = 0.3 }, at = {1, 0.5}"),
         0,
         {"warning: \"viscosity\" is 1 in momentum", "and 0.1 in surface"}},
        {"5 term \"momentum\" { force = {1, 0} }\n9 term \"stabilise.streamline\" {}",
         0,
         {"warning: momentum.body_force has \"force\", and stabilise.streamline, which takes the same, has not"}},
        {"9 term \"stabilise.streamline\" { force = {1, 0} }",
         0,
         {"warning: stabilise.streamline has \"force\", and momentum.body_force, which takes the same, has not"}},
        {"5 term \"momentum\" { force = {1, 0} }\n9 term \"stabilise.streamline\" { force = {1, 0} }",
         0,
         {"ok", "!warning"}},
        {"9 term \"stabilise.streamline\" {}", 0, {"ok", "!warning"}},
        {"9 particulate \"conservative\"\n18 term \"stabilise.streamline\" {}\n" DISK(10, "{1, 0.5}") TIME,
         3,
         {"multiplier.rigid_motion holds u inside of bodies",
          "stabilise.streamline acts outside of them only: leave it out"}},
    };

    (void)state;
    assert_bad_cases(list);
}

/* A symmetry plane mirrors what it cuts: its motion, too. */
static void motions_keep_to_the_symmetry(void **state)
{
    static const bad_case list[] = {
        {"6 boundary \"top\" { symmetry = true }\n8 boundary \"right\" { natural = true } boundary \"bottom\" { "
         "symmetry = true }\n" SHARP FIXED(10, "shape = disk { radius = 0.3 }, at = {1, 0}, spin = 5"),
         3,
         {"bad.lua:10: ", "its spin along z must be zero, not 5"}},
        {"6 boundary \"top\" { symmetry = true }\n8 boundary \"right\" { natural = true } boundary \"bottom\" { "
         "symmetry = true }\n" SHARP BODY(10,
                                          "shape = disk { radius = 0.3 }, at = {1, 0}, motion = \"prescribed\", "
                                          "velocity = {0, function(t) return t end}") TIME,
         3,
         {"bad.lua:10: ", "its velocity along y must be zero, not 0.1"}},
        {"6 boundary \"top\" { symmetry = true }\n8 boundary \"right\" { natural = true } boundary \"bottom\" { "
         "symmetry = true }\n" SHARP FIXED(10, "shape = disk { radius = 0.3 }, at = {1, 0}, velocity = {1, 0}"),
         0,
         {"ok"}},
    };

    (void)state;
    assert_bad_cases(list);
}

static void lines_of_a_case_say_what_is_meant(void **state)
{
    static const bad_case list[] = {
        {"9 time = { step = 0.1, stop = 0.2 }", 3, {"bad.lua:9: time = ... declares nothing; write time { ... }"}},
        {"9 output = { every = 1 }", 3, {"bad.lua:9: output = ... declares nothing"}},
        {"9 case \"another\"", 3, {"bad.lua:9: ", "has a title already"}},
        {"9 local n = param(\"n\", {1})", 3, {"bad.lua:9: param: \"n\" has table"}},
        {"9 local n = param(\"n\", 1/0)", 3, {"bad.lua:9: param: \"n\" has inf"}},
        {"3 fluid { density = 1, viscosity = 1e300 }", 3, {"it must lie between 0 and 1e+30"}},
        {"9 time { step = 0.1, stop = 1 }\n10 output { every = 1e-300 }", 3, {"bad.lua:10: ", "a millionth"}},
        {"9 output { lines = { a = { from = {0, 0}, to = {0, 0} } } }", 3, {"begins where it ends"}},
        {"9 output { lines = { [\"a\\0b\"] = { from = {0, 0}, to = {1, 0} } } }", 3, {"a name of its own"}},
        {SHARP BODY(10, "shape = disk { radius = 0.3 }, at = {1, 0.5}") TIME
         "\n20 output { probes = { p0 = {0, 0} } }",
         3,
         {"bad.lua:20: output: probes: \"p0\" is what results call a particle"}},
    };

    (void)state;
    assert_bad_cases(list);
}

static void what_results_ask_for_is_there(void **state)
{
    (void)state;
    assert_ran(plugflow("run %s --quiet --out %s/o",
                        put_file("mean.lua", "mesh { box = {{0,0},{1,1}}, cells = {3,3} }\n"
                                             "fluid { density = 1, viscosity = 1 }\nterm 'continuity' {}\n"
                                             "term 'momentum' {}\nboundary '*' { u = {0,0} }\n"
                                             "results(function(r) return { m = r.mean.u[3] } end)\n"),
                        scratch()),
               3, "mean.lua:6: results: r.mean has a list of components, without \"3\"");
}

/* A distance that is another one each time has no surface to look for. */
static void a_distance_depends_on_the_place_alone(void **state)
{
    static const bad_case list[] = {
        {SHARP FIXED(
             10, "shape = body { half = {0.3, 0.3}, distance = function(x, y) return math.sqrt(x*x+y*y) - 0.2 + "
                 "0.02 * math.random() end }, at = {1, 0.5}"),
         3,
         {"bad.lua:10: shape: distance gives two values at one point"}},
    };

    (void)state;
    assert_bad_cases(list);
}

static void a_line_that_leaves_the_mesh_is_told(void **state)
{
    (void)state;
    assert_ran(
        plugflow("run %s --quiet --out %s/o",
                 put_file("out.lua", "\xef\xbb\xbfmesh { box = {{0,0},{1,1}}, cells = {3,3} }\n"
                                     "fluid { density = 1, viscosity = 1 }\nterm 'continuity' {}\n"
                                     "term 'momentum' {}\nboundary '*' { u = {0,0} }\n"
                                     "output { lines = { a = { from = {0,0.5}, to = {2,0.5}, points = 5 } } }\n"),
                 scratch()),
        0, "out.lua:6: output: line \"a\": 2 of its 5 points lie outside of the mesh");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bodies_that_mean_something_else_are_doubted),
        cmocka_unit_test(motions_keep_to_the_symmetry),
        cmocka_unit_test(lines_of_a_case_say_what_is_meant),
        cmocka_unit_test(what_results_ask_for_is_there),
        cmocka_unit_test(a_distance_depends_on_the_place_alone),
        cmocka_unit_test(a_line_that_leaves_the_mesh_is_told),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
