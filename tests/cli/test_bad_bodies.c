/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Bodies that cannot be: without the terms of a formulation, terms without bodies, keys that contradict each other,
 * places within each other, through walls or outside of the mesh. */
#include "support/bad_case.h"
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>

#define SHARP "9 particulate \"sharp\"\n"
#define TIME  "\n19 time { step = 0.05, stop = 0.1 }"
/* A body in line N with these keys; density 2. */
#define BODY(N, KEYS) #N " particle { density = 2, " KEYS " }\n"
#define DISK(N, AT)   BODY(N, "shape = disk { radius = 0.2 }, at = " AT)
#define ONE(KEYS)     SHARP BODY(10, "shape = disk { radius = 0.2 }, at = {1, 0.5}" KEYS) TIME
#define TWO(A, B)     SHARP BODY(10, A) BODY(11, B) TIME
#define REGION        "3 fluid { density = 1, viscosity = 0.1, region = \"outside\" }\n"

static void bodies_need_the_terms_of_a_formulation(void **state)
{
    static const bad_case list[] = {
        {DISK(9, "{1, 0.5}") TIME,
         3,
         {"bad.lua:9: particle: no term couples the flow with bodies", "add particulate \"sharp\" after fluid{}"}},
        {"9 particles { n = 2, shape = disk { radius = 0.1 }, density = 1, inside = {{0,0},{2,1}} }" TIME,
         3,
         {"bad.lua:9: particles: no term couples"}},
        {"9 term \"contact\" {}\n" DISK(10, "{1, 0.5}") TIME, 3, {"bad.lua:10: ", "no term couples"}},
        {"9 term \"rigid_body\" {}\n" DISK(10, "{1, 0.5}") TIME, 3, {"bad.lua:10: ", "no term couples"}},
        {"9 term \"multiplier\" {}\n10 term \"rigid_body\" {}\n" DISK(11, "{1, 0.5}") TIME,
         3,
         {"bad.lua:9: term \"multiplier\"", "add term \"continuity.pressure_smoothing\" {}",
          "!rigid_body.translation"}},
        {"9 term \"multiplier\" {}\n" DISK(11, "{1, 0.5}") TIME,
         3,
         {"term \"rigid_body.translation\" {} and term \"rigid_body.rotation\" {} and term "
          "\"rigid_body.displaced\" {}"}},
        {"9 term \"multiplier\" { without = {\"reaction\"} }\n10 term \"rigid_body\" {}\n"
         "11 term \"continuity.pressure_smoothing\" {}\n" DISK(12, "{1, 0.5}") TIME,
         3,
         {"bad.lua:9: ", "add term \"multiplier.reaction\" {}"}},
        {REGION "9 term \"surface\" {}\n" DISK(10, "{1, 0.5}") TIME,
         3,
         {"bad.lua:9: ", "add term \"rigid_body.translation\" {}", "term \"rigid_body.buoyancy\" {}"}},
        {REGION "9 term \"surface.nitsche\" {}\n10 term \"rigid_body\" { without = {\"displaced\"} }\n"
                "11 term \"rigid_body.buoyancy\" {}\n" DISK(12, "{1, 0.5}") TIME,
         3,
         {"bad.lua:9: ", "add term \"surface.extension\" {}"}},
        {REGION "9 term \"surface\" {}\n10 term \"rigid_body\" {}\n11 term \"rigid_body.buoyancy\" {}\n" DISK(
             12, "{1, 0.5}") TIME,
         3,
         {"bad.lua:10: rigid_body.displaced must be off with term \"surface\""}},
        {"9 term \"surface\" {}\n10 term \"rigid_body\" { without = {\"displaced\"} }\n11 term "
         "\"rigid_body.buoyancy\" {}\n" DISK(12, "{1, 0.5}") TIME,
         3,
         {"bad.lua:3: surface.extension", "acts inside of them", "add region = \"outside\" to fluid{}"}},
        {"3 fluid { density = 1, viscosity = 0.1, region = \"outside\", gravity = {0, -1} }\n9 term \"surface\" "
         "{}\n"
         "10 term \"rigid_body\" { without = {\"displaced\"} }\n11 term \"rigid_body.buoyancy\" {}\n" DISK(
             12, "{1, 0.5}") TIME,
         3,
         {"bad.lua:3: fluid: rigid_body.buoyancy", "add reduced_pressure = true"}},
        {REGION "9 particulate \"conservative\"\n" DISK(10, "{1, 0.5}") TIME,
         3,
         {"bad.lua:3: ", "holds u inside of bodies", "leave region = \"outside\""}},
        {"5 term \"momentum\" { over = \"all\" }\n" ONE(""),
         3,
         {"bad.lua:3: surface.extension", "acts inside of them"}},
        {"9 term \"appendix\" {}\n10 term \"surface\" {}\n" DISK(11, "{1, 0.5}") TIME,
         3,
         {"a case has one formulation"}},
        {ONE(""), 0, {"ok"}},
    };

    (void)state;
    assert_bad_cases(list);
}

/* particulate without particle ended in a segmentation fault. */
static void terms_on_bodies_need_bodies(void **state)
{
    static const bad_case list[] = {
        {SHARP TIME,
         3,
         {"bad.lua:9: term \"surface\" (or the particulate", "the case has none", "disk { radius = 0.1 }"}},
        {"9 particulate \"conservative\"" TIME, 3, {"bad.lua:9: term \"multiplier\"", "the case has none"}},
        {"9 particulate(\"appendix\", { alpha = 1e5 })" TIME,
         3,
         {"bad.lua:9: term \"appendix\"", "the case has none"}},
        {"9 term \"contact.repulsion\" {}" TIME, 3, {"bad.lua:9: term \"contact.repulsion\"", "the case has none"}},
        {"9 term \"continuity.pressure_smoothing\" {}" TIME, 3, {"bad.lua:9: ", "the case has none"}},
    };

    (void)state;
    assert_bad_cases(list);
}

static void keys_of_bodies_are_checked(void **state)
{
    static const bad_case list[] = {
        {SHARP "10 particle {}" TIME, 3, {"\"density\" is missing", "\"shape\" is missing", "\"at\" is missing"}},
        {SHARP BODY(10, "shape = \"disk\", radius = 0.1, at = {1, 0.5}") TIME,
         3,
         {"is a string", "shape = disk { radius"}},
        {SHARP BODY(10, "shape = disk, at = {1, 0.5}") TIME, 3, {"is a function", "shape = disk { radius"}},
        {SHARP BODY(10, "shape = { radius = 0.1 }, at = {1, 0.5}") TIME, 3, {"a plain table has no shape"}},
        {SHARP BODY(10, "radius = 0.1, at = {1, 0.5}") TIME, 3, {"did you mean \"shape\"", "!missing"}},
        {SHARP BODY(10, "shape = disk { radius = 0.1 }, position = {1, 0.5}") TIME,
         3,
         {"did you mean \"at\"", "!missing"}},
        {SHARP BODY(10, "shape = disk { radius = 0.1 }, at = {0/0, 1}") TIME,
         3,
         {"\"at\"", "must be a finite number"}},
        {ONE(", rho = 3"), 3, {"unknown key \"rho\"; did you mean \"density\""}},
        {ONE(", fixed = true"), 3, {"did you mean \"motion\"", "motion = \"fixed\""}},
        {ONE(", motion = \"Fixed\""), 3, {"did you mean \"fixed\"?"}},
        {ONE(", motion = \"prescribed\""), 3, {"neither is given", "motion = \"fixed\""}},
        {ONE(", velocity = function(t) return 1, 0 end"),
         3,
         {"bad.lua:10: ", "\"velocity\" is a function", "motion = \"prescribed\""}},
        {ONE(", spin = function(t) return 1 end"), 3, {"\"spin\" is a function"}},
        {ONE(", velocity = {function(t) return t end, 0}, hold = {\"x\"}"), 0, {"ok"}},
        {ONE(", velocity = function(t) return t, 0 end, motion = \"fixed\""), 0, {"ok"}},
        {ONE(", velocity = {free, 0}"), 3, {"free leaves a component open"}},
        {ONE(", hold = {\"z\"}"), 3, {"\"z\" is none of x, y, spin"}},
        {ONE(", hold = {\"x\"}, motion = \"fixed\""), 3, {"leave it out"}},
        {ONE(", orientation = {1, 0, 0, 0}"), 3, {"did you mean \"angle\"", "in radians"}},
        {ONE(", angle = 45"),
         0,
         {"warning: ", "bad.lua:10: particle: angle = 45 is in radians (2578 degrees); math.rad(45)"}},
        {ONE(", angle = 6.28"), 0, {"!radians"}},
        {ONE("") "\n12 initial { U = {1, 0}, omega = 1 }",
         3,
         {"bad.lua:12: initial: \"U\"", "particle { velocity = ... }", "initial: \"omega\"",
          "particle { spin = ... }"}},
        {ONE("") "\n12 exact { U = {1, 0} }", 3, {"bad.lua:12: exact: \"U\"", "of the bodies"}},
        {ONE("") "\n12 output { fields = {\"U\"} }",
         3,
         {"\"U\"", "in particles.csv", "fields of the mesh: u (velocity)"}},
        {ONE("") "\n12 output { forces = {\"disk\"} }", 3, {"forces on bodies are in particles.csv"}},
        {SHARP
         "10 for i = 1, 3 do particle { shape = disk { radius = -0.1 }, density = 1, at = {i, 0.5} } end" TIME,
         3,
         {"-0.1", "!outside"}},
    };

    (void)state;
    assert_bad_cases(list);
}

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

static void bodies_of_few_cells_are_counted_in_one_warning(void **state)
{
    static const char text[] =
        "mesh { box = {{0,0},{2,1}}, cells = {8,4} }\nfluid { density = 1, viscosity = 0.1 }\nterm \"continuity\" "
        "{}\n"
        "term \"momentum\" {}\nparticulate \"sharp\"\nparticle { shape = disk { radius = 0.15 }, density = 1, at = "
        "{0.5, 0.5} }\n"
        "particle { shape = disk { radius = 0.1 }, density = 1, at = {1.4, 0.5} }\nboundary \"*\" { u = {0,0} }\n"
        "time { step = 0.1, stop = 0.1 }\n";
    static const char warning[] =
        "2 of 2 bodies are less than 4 cells across, the worst of them particle 1 (line 7): 0.2 wide, 0.8 cells";
    const char *path = put_file("few.lua", text);

    (void)state;
    assert_ran(plugflow("check %s", path), 0, warning);
    assert_ran(plugflow("run %s --out %s/few", path, scratch()), 0, warning);
    assert_ran(shell("grep '\"event\": *\"warning\"' %s/few/run.jsonl", scratch()), 0, warning);
    assert_ran(shell("grep '\"warnings\"' %s/few/summary.json", scratch()), 0, warning);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bodies_need_the_terms_of_a_formulation),
        cmocka_unit_test(terms_on_bodies_need_bodies),
        cmocka_unit_test(keys_of_bodies_are_checked),
        cmocka_unit_test(bodies_do_not_start_within_each_other),
        cmocka_unit_test(bodies_start_within_the_domain),
        cmocka_unit_test(random_places_lie_within_the_domain),
        cmocka_unit_test(a_symmetry_plane_cuts_bodies_through_the_centre_only),
        cmocka_unit_test(the_same_in_three_dimensions),
        cmocka_unit_test(bodies_of_few_cells_are_counted_in_one_warning),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
