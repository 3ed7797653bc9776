/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Places where bodies cannot start: within each other, through walls, outside of the mesh, half behind a symmetry
 * plane. */
#include "support/bad_case.h"
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

/* Two bodies, lines 10 and 11. */
#define TWO(A, B) SHARP BODY(10, A) BODY(11, B) TIME

static void bodies_do_not_start_within_each_other(void **state)
{
    static const bad_case list[] = {
        {SHARP DISK(10, "{1, 0.5}") DISK(11, "{1.1, 0.5}") TIME,
         3,
         {"bad.lua:11: particle 1 at (1.1, 0.5) overlaps particle 0 at (1, 0.5) (line 10) by 0.3"}},
        {SHARP DISK(10, "{1, 0.5}") DISK(11, "{1, 0.5}") TIME, 3, {"by 0.4"}},
        {SHARP DISK(10, "{0.8, 0.5}") DISK(11, "{1.2, 0.5}") TIME, 0, {"ok"}},
        {SHARP DISK(10, "{0.8, 0.5}") DISK(11, "{1.2 - 1e-9, 0.5}") TIME, 3, {"overlaps", "by 1e-09"}},
        {TWO("shape = ellipse { a = 0.2, b = 0.1 }, at = {1, 0.5}",
             "shape = ellipse { a = 0.2, b = 0.1 }, at = {1, 0.5}"),
         3,
         {"bad.lua:11: ", "overlaps"}},
        {TWO("shape = ellipse { a = 0.2, b = 0.1 }, at = {0.8, 0.5}",
             "shape = ellipse { a = 0.2, b = 0.1 }, at = {1.2, 0.5}"),
         0,
         {"ok"}},
        {TWO("shape = ellipse { a = 0.2, b = 0.1 }, at = {0.8, 0.5}",
             "shape = ellipse { a = 0.2, b = 0.1 }, at = {1.1999, 0.5}"),
         3,
         {"overlaps", "by 0.0001"}},
        {TWO("shape = ellipse { a = 0.3, b = 0.05 }, at = {1, 0.4}",
             "shape = ellipse { a = 0.3, b = 0.05 }, at = {1, 0.51}"),
         0,
         {"ok"}},
        {TWO("shape = ellipse { a = 0.3, b = 0.05 }, at = {1, 0.5}",
             "shape = ellipse { a = 0.3, b = 0.05 }, angle = 1.5, at = {1, 0.5}"),
         3,
         {"overlaps"}},
        {TWO("shape = rectangle { width = 0.3, height = 0.3 }, at = {0.8, 0.5}",
             "shape = rectangle { width = 0.3, height = 0.3 }, at = {1.1, 0.5}"),
         0,
         {"ok"}},
        {TWO("shape = rectangle { width = 0.3, height = 0.3 }, at = {0.8, 0.5}",
             "shape = rectangle { width = 0.3, height = 0.3 }, angle = 0.1, at = {1.1, 0.5}"),
         3,
         {"overlaps"}},
        {TWO("shape = disk { radius = 0.4 }, at = {1, 0.5}",
             "shape = ellipse { a = 0.1, b = 0.05 }, at = {1, 0.5}"),
         3,
         {"overlaps"}},
        {"7 boundary { periodic = {\"left\", \"right\"} }\n8 \n" SHARP DISK(10, "{0.1, 0.5}") DISK(11, "{1.9, 0.5}")
             TIME,
         3,
         {"bad.lua:11: ", "(line 10) through a periodic boundary by 0.2"}},
        {"7 boundary { periodic = {\"left\", \"right\"} }\n8 \n" SHARP DISK(10, "{0.1, 0.5}") DISK(11, "{1.7, 0.5}")
             TIME,
         0,
         {"ok"}},
        {"2 mesh { box = {{0,0},{0.6,2}}, cells = {6,20} }\n7 boundary { periodic = {\"left\", \"right\"} }\n8 "
         "\n" SHARP BODY(10, "shape = disk { radius = 0.4 }, at = {0.3, 1}") TIME,
         3,
         {"bad.lua:10: ", "overlaps its own image", "larger than the period"}},
        {SHARP "10 particle { shape = disk { radius = 0.2 }, densty = 1, at = {1, 0.5} }\n" DISK(11, "{1, 0.5}")
             DISK(12, "{1.1, 0.5}") "\n19 time { dt = 1 }",
         3,
         {"bad.lua:10: ", "\"densty\"", "bad.lua:12: particle 1", "bad.lua:19: "}},
    };

    (void)state;
    assert_bad_cases(list);
}

static void bodies_start_within_the_domain(void **state)
{
    static const bad_case list[] = {
        {SHARP DISK(10, "{5, 0.5}") TIME,
         3,
         {"bad.lua:10: particle 0 at (5, 0.5) lies outside of the mesh, which reaches from (0, 0) to (2, 1)"}},
        {SHARP DISK(10, "{1, 0.1}") TIME, 3, {"reaches through \"bottom\" by 0.1"}},
        {SHARP DISK(10, "{1, -0.1}") TIME, 3, {"reaches through \"bottom\" by 0.3"}},
        {SHARP DISK(10, "{1.9, 0.5}") TIME, 3, {"reaches through \"right\" by 0.1"}},
        {SHARP DISK(10, "{0.1, 0.1}") TIME, 3, {"\"left\" by 0.1 and \"bottom\" by 0.1", "!larger"}},
        {SHARP DISK(10, "{1, 0.2}") TIME, 0, {"ok", "!reaches"}},
        {SHARP DISK(10, "{1, 0.2 - 1e-8}") TIME, 3, {"reaches through \"bottom\" by 1e-08"}},
        {SHARP BODY(10, "shape = disk { radius = 3 }, at = {1, 0.5}") TIME, 3, {"larger than the domain"}},
        {SHARP BODY(10, "shape = ellipse { a = 0.6, b = 0.1 }, at = {1, 0.5}") TIME, 0, {"ok"}},
        {SHARP BODY(10, "shape = ellipse { a = 0.6, b = 0.1 }, angle = 1.5, at = {1, 0.5}") TIME,
         3,
         {"\"bottom\" by 0.0985 and \"top\" by 0.0985"}},
        {SHARP BODY(10, "shape = rectangle { width = 0.4, height = 0.95 }, angle = 0.3, at = {1, 0.5}") TIME,
         3,
         {"\"bottom\"", "\"top\""}},
        {SHARP DISK(10, "{1, 0.1}, motion = \"fixed\"") TIME,
         0,
         {"warning: ", "bad.lua:10: particle 0, fixed at (1, 0.1), reaches through \"bottom\" by 0.1"}},
        {SHARP DISK(10, "{1, 5}, motion = \"fixed\"") TIME, 3, {"outside of the mesh"}},
        {SHARP DISK(10, "{1, 0.1}, motion = \"prescribed\", velocity = {1, 0}") TIME, 3, {"reaches through"}},
        {"7 boundary { periodic = {\"left\", \"right\"} }\n8 \n" SHARP DISK(10, "{0.1, 0.5}") TIME, 0, {"ok"}},
        {"7 boundary { periodic = {\"left\", \"right\"} }\n8 \n" SHARP DISK(10, "{0.1, 0.15}") TIME,
         3,
         {"\"bottom\" by 0.05"}},
        {"2 mesh { box = {{0,0},{2,1}}, cells = {16,8}, map = function(x,y) return x, y + 0.1*x end }\n" SHARP DISK(
             10, "{1, 0.2}") TIME,
         3,
         {"bad.lua:10: ", "reaches through \"bottom\" by 0.1"}},
        {"2 mesh { box = {{0,0},{2,1}}, cells = {16,8}, map = function(x,y) return x, y + 0.1*x end }\n" SHARP BODY(
             10, "shape = disk { radius = 0.05 }, at = {1.9, 0.05}") TIME,
         3,
         {"outside of the mesh, which reaches from (0, 0) to (2, 1.2)"}},
        {"2 mesh { box = {{0,0},{2,1}}, cells = {16,8}, map = function(x,y) return x, y + 0.1*x end }\n" SHARP DISK(
             10, "{1, 0.6}") TIME,
         0,
         {"ok"}},
    };

    (void)state;
    assert_bad_cases(list);
}

/* A ring with room for a body in it. */
#define RING                                                                                                       \
    "shape = body { half = {0.4, 0.4}, distance = function(x, y) return math.abs(math.sqrt(x*x + y*y) - 0.35) - "  \
    "0.05 end }"

static void what_lies_in_the_hole_of_a_body_is_outside_of_it(void **state)
{
    static const bad_case list[] = {
        {TWO(RING ", at = {1, 0.5}", "shape = disk { radius = 0.2 }, at = {1, 0.5}"), 0, {"ok"}},
        {TWO(RING ", at = {1, 0.5}", "shape = disk { radius = 0.2 }, at = {1.15, 0.5}"), 3, {"overlaps"}},
        {TWO(RING ", at = {1, 0.5}", "shape = disk { radius = 0.32 }, at = {1, 0.5}"), 3, {"overlaps"}},
        {TWO(RING ", at = {1, 0.5}", "shape = disk { radius = 0.1 }, at = {1.5, 0.5}"), 0, {"ok"}},
        {SHARP BODY(10, RING ", at = {1, 0.3}") TIME, 3, {"reaches through \"bottom\" by 0.1"}},
        {SHARP BODY(10, RING ", at = {4, 0.3}") TIME, 3, {"outside of the mesh"}},
    };

    (void)state;
    assert_bad_cases(list);
}

static void random_places_lie_within_the_domain(void **state)
{
    static const bad_case list[] = {
        {SHARP "10 particles { n = 3, shape = disk { radius = 0.1 }, density = 1, inside = {{0,0},{2,2}} }" TIME,
         3,
         {"bad.lua:10: particles: \"inside\" reaches from (0, 0) to (2, 2), out of the mesh"}},
        {SHARP "10 particles { n = 3, shape = disk { radius = 0.6 }, density = 1, inside = {{0,0},{2,1}} }" TIME,
         3,
         {"up to 1.2 wide, the box \"inside\" only 1"}},
        {SHARP "10 particles { n = 300, shape = disk { radius = 0.1 }, density = 1, inside = {{0,0},{2,1}} }" TIME,
         3,
         {"of 300 bodies find a place"}},
        {SHARP "10 particles { n = 3, shape = disk { radius = 0.1 }, density = 1, inside = {0,0,2,1} }" TIME,
         3,
         {"expected two corners"}},
        {SHARP "10 particles { n = 2.5, shape = disk { radius = 0.1 }, density = 1, inside = {{0,0},{2,1}} }" TIME,
         3,
         {"whole number"}},
        {SHARP "10 particles { n = 3, shape = disk { radius = 0.1 }, density = 1, inside = {{0,0},{2,1}} }" TIME,
         0,
         {"ok"}},
    };

    (void)state;
    assert_bad_cases(list);
}

#define FLOOR "7 boundary \"bottom\" { symmetry = true }\n8 \n" SHARP

static void a_symmetry_plane_cuts_bodies_through_the_centre_only(void **state)
{
    static const bad_case list[] = {
        {FLOOR DISK(10, "{1, 0}, hold = {\"y\", \"spin\"}") TIME, 0, {"ok"}},
        {FLOOR DISK(10, "{1, 0}, motion = \"fixed\"") TIME, 0, {"ok", "!reaches"}},
        {FLOOR DISK(10, "{1, 0}") TIME,
         3,
         {"bad.lua:10: ", "cut by the symmetry plane \"bottom\"", "hold = {\"y\", \"spin\"}"}},
        {FLOOR DISK(10, "{1, 0.05}, hold = {\"y\", \"spin\"}") TIME,
         3,
         {"the symmetry plane \"bottom\" by 0.15", "only through its centre"}},
        {FLOOR DISK(10, "{1, 0.05}, motion = \"fixed\"") TIME, 3, {"only through its centre"}},
        {FLOOR BODY(10, "shape = ellipse { a = 0.2, b = 0.1 }, at = {1, 0}, hold = {\"y\", \"spin\"}") TIME,
         0,
         {"ok"}},
        {FLOOR BODY(10, "shape = ellipse { a = 0.2, b = 0.1 }, angle = 0.5, at = {1, 0}, hold = {\"y\", \"spin\"}")
             TIME,
         3,
         {"about which it is not symmetric"}},
    };

    (void)state;
    assert_bad_cases(list);
}

#define CUBE "2 mesh { box = {{0,0,0},{1,1,1}}, cells = {2,2,2} }\n6 boundary \"*\" { u = {0,0,0} }\n7 \n8 \n" SHARP

static void the_same_in_three_dimensions(void **state)
{
    static const bad_case list[] = {
        {CUBE BODY(10, "shape = sphere { radius = 0.2 }, at = {0.5, 0.5, 0.5}") TIME, 0, {"ok"}},
        {CUBE BODY(10, "shape = sphere { radius = 0.2 }, at = {0.5, 0.5, 0.1}") TIME, 3, {"\"back\" by 0.1"}},
        {CUBE BODY(10, "shape = sphere { radius = 0.2 }, at = {0.5, 0.5, 0.5}, angle = 1") TIME,
         3,
         {"did you mean \"orientation\""}},
        {CUBE BODY(10, "shape = sphere { radius = 0.2 }, at = {0.5, 0.5, 0.5}, orientation = {0, 0, 0, 0}") TIME,
         3,
         {"\"orientation\" is zero"}},
        {CUBE BODY(10, "shape = block { width = 0.1, height = 0.1, depth = 0.8 }, at = {0.5, 0.5, 0.5}")
             BODY(11, "shape = block { width = 0.8, height = 0.1, depth = 0.1 }, at = {0.5, 0.55, 0.5}") TIME,
         3,
         {"bad.lua:11: ", "overlaps"}},
        {CUBE BODY(10, "shape = block { width = 0.1, height = 0.1, depth = 0.8 }, at = {0.5, 0.5, 0.5}")
             BODY(11, "shape = block { width = 0.8, height = 0.1, depth = 0.1 }, at = {0.5, 0.61, 0.5}") TIME,
         0,
         {"ok"}},
        {CUBE BODY(10, "shape = cylinder { radius = 0.1, length = 0.4 }, at = {0.5, 0.5, 0.5}")
             BODY(11, "shape = sphere { radius = 0.1 }, at = {0.5, 0.5, 0.79}") TIME,
         3,
         {"overlaps", "by 0.01"}},
    };

    (void)state;
    assert_bad_cases(list);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bodies_do_not_start_within_each_other),
        cmocka_unit_test(bodies_start_within_the_domain),
        cmocka_unit_test(what_lies_in_the_hole_of_a_body_is_outside_of_it),
        cmocka_unit_test(random_places_lie_within_the_domain),
        cmocka_unit_test(a_symmetry_plane_cuts_bodies_through_the_centre_only),
        cmocka_unit_test(the_same_in_three_dimensions),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
