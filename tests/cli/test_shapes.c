/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * disk{}, sphere{} ... and particulate: what is wrong with them is said in the line of the case, with the remedy.
 */
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>

/* Five lines. */
#define BOX                                                                                                        \
    "mesh { box = {{0,0},{1,1}}, cells = {8,8} }\nfluid { density = 1, viscosity = 0.1 }\n"                        \
    "term \"continuity\" {}\nterm \"momentum\" {}\nboundary \"*\" { u = {0, 0} }\n"
#define CUBE                                                                                                       \
    "mesh { box = {{0,0,0},{1,1,1}}, cells = {4,4,4} }\nfluid { density = 1, viscosity = 0.1 }\n"                  \
    "term \"continuity\" {}\nterm \"momentum\" {}\nboundary \"*\" { u = {0, 0, 0} }\n"

typedef struct shape_case {
    const char *shape, *text; /* text NULL: nothing is wrong */
} shape_case;

static void check_shapes(const shape_case *s, size_t n, const char *box, const char *at)
{
    for (size_t i = 0; i < n; i++) {
        char text[2000];
        ran r;

        snprintf(text, sizeof text,
                 "%sparticulate \"sharp\"\nparticle { density = 1, at = %s,\n  shape = %s }\ntime { step = 1, stop "
                 "= 2 }\n",
                 box, at, s[i].shape);
        r = plugflow("check %s", put_file("case.lua", text));
        if (s[i].text)
            assert_ran(r, 3, "case.lua:8: ", s[i].text);
        else
            assert_ran(r, 0, "case.lua: ok");
    }
}

static void keys_of_shapes_are_checked(void **state)
{
    static const shape_case wrong[] = {
        {"disk { diameter = 0.2 }",
         "disk: unknown key \"diameter\"; did you mean \"radius\" (half of it)? valid keys: radius"},
        {"disk { radios = 0.2 }", "disk: unknown key \"radios\"; did you mean \"radius\"? valid keys: radius"},
        {"ellipse { a = 0.2, c = 0.1 }", "ellipse: unknown key \"c\"; valid keys: a, b"},
        {"disk {}", "disk: \"radius\" is missing"},
        {"disk { radius = \"0.2\" }", "disk: \"radius\" must be a number, got a string"},
        {"disk { radius = -0.2 }", "disk: \"radius\" is -0.2; it must be positive"},
        {"disk { radius = 0 / 0 }", "it must be finite"},
        {"disk { radius = 1 / 0 }", "disk: \"radius\" is inf; it must be finite"},
        {"disk { 0.2 }", "disk: a value without a name; valid keys: radius"},
        {"disk(0.2)", "disk: expected its measures in braces, as in disk{radius = ...}, got number"},
        {"rectangle { width = 0.1 }", "rectangle: \"height\" is missing"},
        {"superellipse { a = 0.2, b = 0.2, exponent = 0.5 }",
         "superellipse: \"exponent\" is 0.5; it must lie between 1 and 50"},
        {"superellipse { a = 0.2, b = 0.2, exponent = 9000 }",
         "superellipse: \"exponent\" is 9000; it must lie between 1 and 50 (sharp edges: rectangle{}, block{})"},
        {"superellipsoid { a = 1, b = 1, c = 1, exponent = 2, exponent_z = 0.5 }",
         "superellipsoid: \"exponent_z\" is 0.5; it must lie between 1 and 50"},
        {"body { half = {0.1, 0.1} }", "body: \"distance\" must be a function"},
        {"body { half = {0.1, -0.1}, distance = function(x, y) return 1 end }",
         "body: \"half[2]\" is -0.1; it must be"},
        {"body { size = {0.1, 0.1}, distance = function(x, y) return 1 end }", "body: unknown key \"size\""},
    };

    (void)state;
    check_shapes(wrong, sizeof wrong / sizeof *wrong, BOX, "{0.5, 0.5}");
}

static void a_shape_of_another_dimension_names_the_right_one(void **state)
{
    static const shape_case in_2d[] = {
        {"sphere { radius = 0.2 }", "shape: sphere{} is a shape in 3D, the mesh is 2D; use disk{}"},
        {"cylinder { radius = 0.2, length = 1 }",
         "cylinder{} is a shape in 3D, the mesh is 2D; use disk{} or rectangle{}"},
    };
    static const shape_case in_3d[] = {
        {"disk { radius = 0.2 }", "shape: disk{} is a shape in 2D, the mesh is 3D; use sphere{}"},
        {"superellipse { a = 0.2, b = 0.2, exponent = 4 }", "the mesh is 3D; use superellipsoid{}"},
    };

    (void)state;
    check_shapes(in_2d, sizeof in_2d / sizeof *in_2d, BOX, "{0.5, 0.5}");
    check_shapes(in_3d, sizeof in_3d / sizeof *in_3d, CUBE, "{0.5, 0.5, 0.5}");
}

static void right_shapes_pass(void **state)
{
    static const shape_case in_2d[] = {
        {"disk { radius = 0.2 }", NULL},
        {"ellipse { a = 0.2, b = 0.1 }", NULL},
        {"rectangle { width = 0.4, height = 0.4 }", NULL},
        {"superellipse { a = 0.2, b = 0.2, exponent = 4 }", NULL},
        {"body { half = {0.2, 0.2}, distance = function(x, y) return math.sqrt(x * x + y * y) - 0.15 end }", NULL},
    };
    static const shape_case in_3d[] = {
        {"superellipsoid { a = 0.3, b = 0.3, c = 0.3, exponent = 2 }", NULL},
        {"superellipsoid { a = 0.3, b = 0.3, c = 0.3, exponent = 2, exponent_z = 3 }", NULL},
    };

    (void)state;
    check_shapes(in_2d, sizeof in_2d / sizeof *in_2d, BOX, "{0.5, 0.5}");
    check_shapes(in_3d, sizeof in_3d / sizeof *in_3d, CUBE, "{0.5, 0.5, 0.5}");
}

static void particulate_says_what_it_expects(void **state)
{
    static const struct {
        const char *line, *text;
    } wrong[] = {
        {"particulate \"sharpp\"",
         "case.lua:6: particulate: expected \"sharp\", \"conservative\" or \"appendix\", got "
         "\"sharpp\"; did you mean \"sharp\"?"},
        {"particulate(sharp)", "\"sharp\" is not defined"},
        {"particulate(5)", "got number"},
        {"particulate(\"sharp\", 5)",
         "case.lua:6: particulate: the options of \"sharp\" must be a table in braces, got a "
         "number"},
        {"particulate(\"conservative\", {gamma = 1})", "particulate: \"conservative\" has no options"},
        {"particulate \"sharp\" particulate \"conservative\"", "the formulation is \"sharp\" already"},
    };

    (void)state;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        char text[2000];

        snprintf(text, sizeof text, BOX "%s\n", wrong[i].line);
        assert_ran(plugflow("check %s", put_file("case.lua", text)), 3, wrong[i].text);
    }
    assert_ran(plugflow("check %s", put_file("case.lua", "local x\nparticulate \"sharp\"\n" BOX)), 3,
               "case.lua:2: particulate: fluid{} must stand before it; put particulate after fluid{}");
}

/* A box with gravity as given, a disk, and one more line. */
static ran check_gravity(const char *gravity, const char *line)
{
    char text[2000];

    snprintf(
        text, sizeof text,
        "mesh { box = {{0,0},{1,1}}, cells = {8,8} }\nfluid { density = 1, viscosity = 0.1, gravity = %s }\n"
        "term \"continuity\" {}\nterm \"momentum\" {}\nboundary \"*\" { u = {0, 0} }\ntime { step = 1, stop = 2 }\n"
        "particulate \"sharp\"\nparticle { shape = disk { radius = 0.2 }, density = 1, at = {0.5, 0.5} }\n%s\n",
        gravity, line);
    return plugflow("check %s", put_file("case.lua", text));
}

static void gravity_of_a_wrong_type_is_reported_by_fluid(void **state)
{
    (void)state;
    assert_ran(check_gravity("5", ""), 3, "case.lua:2: fluid: \"gravity\"",
               "expected 2 numbers in braces, got number");
    assert_ran(check_gravity("{0, \"x\"}", ""), 3, "case.lua:2: fluid: \"gravity\"", "expected numbers");
    assert_ran(check_gravity("{{}, {}}", ""), 3, "case.lua:2: fluid: \"gravity\"", "expected numbers");
    assert_ran(check_gravity("{0, -1}", ""), 0, "case.lua: ok");
}

static void an_offset_beside_that_of_particulate_is_explained(void **state)
{
    (void)state;
    assert_ran(
        check_gravity("{0, -1}", "offset { p = 1 }"), 3,
        "case.lua:9: offset: the case has one already: with gravity in fluid{}, particulate (line 7) adds rho g.x");
    assert_ran(check_gravity("nil", "offset { p = 1 }"), 0, "case.lua: ok");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(keys_of_shapes_are_checked),
        cmocka_unit_test(a_shape_of_another_dimension_names_the_right_one),
        cmocka_unit_test(right_shapes_pass),
        cmocka_unit_test(particulate_says_what_it_expects),
        cmocka_unit_test(gravity_of_a_wrong_type_is_reported_by_fluid),
        cmocka_unit_test(an_offset_beside_that_of_particulate_is_explained),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
