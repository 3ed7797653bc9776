/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Bodies that cannot be: without the terms of a formulation, terms without bodies, keys that contradict each other.
 */
#include "support/bad_case.h"
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>

/* One disk in the middle of the channel, line 10. */
#define ONE(KEYS) SHARP BODY(10, "shape = disk { radius = 0.2 }, at = {1, 0.5}" KEYS) TIME
#define REGION    "3 fluid { density = 1, viscosity = 0.1, region = \"outside\" }\n"

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

static void a_repulsion_without_force_is_doubted(void **state)
{
    static const bad_case list[] = {
        {ONE("") "\n12 term \"contact.repulsion\" {}",
         0,
         {"warning: ", "bad.lua:12: contact.repulsion does nothing"}},
        {ONE("") "\n12 term \"contact.repulsion\" { force = 1 }", 0, {"!does nothing"}},
        {"3 fluid { density = 1, viscosity = 0.1, gravity = {0, -1} }\n" ONE(
             "") "\n12 term \"contact.repulsion\" {}",
         0,
         {"!does nothing"}},
        {"3 fluid { density = 2, viscosity = 0.1, gravity = {0, -1} }\n" ONE(
             "") "\n12 term \"contact.repulsion\" {}",
         0,
         {"does nothing"}},
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
        cmocka_unit_test(a_repulsion_without_force_is_doubted),
        cmocka_unit_test(bodies_of_few_cells_are_counted_in_one_warning),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
