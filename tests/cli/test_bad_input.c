/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What is wrong with a case is said with file and line, all at once, with the right exit code;
 * nothing is written. */
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdlib.h>
#include <string.h>

#define MESH  "mesh { box = {{0,0},{1,1}}, cells = {4,4} }\n"
#define FLUID "fluid { density = 1, viscosity = 0.1 }\n"
#define TERMS "term \"continuity\" {}\nterm \"momentum\" {}\n"
#define WALLS "boundary \"*\" { u = {0, 0} }\n"

/* Runs a case given as text; it must end with the code, print all texts, and leave no results. */
#define assert_case(expected, text, ...)                                                                           \
    do {                                                                                                           \
        const char *path_ = put_file("bad.lua", text);                                                             \
                                                                                                                   \
        assert_ran(plugflow("run %s --out %s/bad", path_, scratch()), expected, __VA_ARGS__);                      \
        assert_true(shell("test -e %s/bad/summary.json", scratch()).code != 0);                                    \
    } while (0)

static void a_misspelt_key_is_named_with_its_line_and_the_nearest_key(void **state)
{
    (void)state;
    assert_case(3, MESH "fluid { density = 1,\n  viscosty = 0.1 }\n" TERMS WALLS,
                "bad.lua:3: fluid: unknown key \"viscosty\"",
                "did you mean \"viscosity\" (dynamic viscosity, Pa s)?",
                "valid keys: density, gravity, reduced_pressure, region, viscosity");
}

static void all_mistakes_are_reported_together(void **state)
{
    (void)state;
    assert_case(3,
                "mesh { box = {{0,0},{1,1}}, cells = {4,0} }\n"
                "fluid { density = \"one\", viscosity = -1 }\n" TERMS
                "boundary \"*\" { u = {0} }\ntime { step = 0.1, stop = -1 }\n",
                "bad.lua:1:", "bad.lua:2: fluid: \"density\"", "expected a number, got the string \"one\"",
                "must not be negative", "bad.lua:5:", "expected 2 components", "bad.lua:6:", "is not after start");
}

static void a_boundary_that_matches_nothing_lists_the_names(void **state)
{
    (void)state;
    assert_case(3, MESH FLUID TERMS WALLS "boundary \"topp\" { u = {1, 0} }\n",
                "bad.lua:6:", "did you mean \"top\"?", "left, right, bottom, top");
}

static void a_facet_without_condition_is_an_error(void **state)
{
    (void)state;
    assert_case(3, MESH FLUID TERMS "boundary \"left\" { u = {0, 0} }\nboundary \"right\" { u = {0, 0} }\n",
                "8 boundary facets have no condition", "\"bottom\", \"top\"", "natural = true");
}

static void an_inverted_cell_is_a_mesh_error(void **state)
{
    (void)state;
    assert_case(
        4, "mesh { box = {{0,0},{1,1}}, cells = {4,4}, map = function(x, y) return -x, y end }\n" FLUID TERMS WALLS,
        "inverted or folded near (");
}

static void a_missing_or_damaged_mesh_file_is_a_mesh_error(void **state)
{
    (void)state;
    assert_case(4, "mesh { file = \"nothing.msh\" }\n" FLUID TERMS WALLS, "nothing.msh", "is not there");
    put_file("garbage.msh", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 4 1 4\n2 1");
    assert_case(4, "mesh { file = \"garbage.msh\" }\n" FLUID TERMS WALLS, "garbage.msh");
    put_file("empty.msh", "");
    assert_case(4, "mesh { file = \"empty.msh\" }\n" FLUID TERMS WALLS, "empty.msh");
}

static void an_unknown_plugin_lists_where_it_was_looked_for(void **state)
{
    (void)state;
    assert_case(3, MESH FLUID "term \"continuity\" {}\nterm \"momentun\" {}\n" WALLS,
                "bad.lua:4: term \"momentun\"", "did you mean \"momentum\"?", "looked for:", "momentun.so");
    assert_case(3, MESH FLUID "term \"continuity\" {}\nterm \"momentum.convektion\" {}\n" WALLS,
                "has no term \"convektion\"");
    assert_case(3, MESH FLUID "term \"continuity\" {}\nterm \"momentum\" { without = {\"inertai\"} }\n" WALLS,
                "did you mean \"inertia\"?");
}

static void an_endless_loop_in_the_case_ends(void **state)
{
    (void)state;
    assert_case(3, "while true do end\n", "bad.lua:1:", "endless loop");
}

static void the_sandbox_has_no_doors(void **state)
{
    (void)state;
    assert_case(3, "os.execute('true')\n", "\"os\" is not defined");
    assert_case(3, "local f = io.open('x')\n", "\"io\" is not defined");
    assert_case(3, "require 'x'\n", "\"require\" is not defined");
    assert_case(3, "mehs { }\n", "did you mean \"mesh\"?");
    assert_case(3, "mesh { box = {{0,0},{1,1}} cells = {4,4} }\n", "bad.lua:1:");
}

static void a_function_that_returns_nonsense_is_named_with_place_and_time(void **state)
{
    (void)state;
    assert_case(3, MESH FLUID TERMS "boundary \"*\" { u = function(x, y) return 0 / 0, 1 end }\n",
                "bad.lua:5: function \"u\" at (", "not finite");
    assert_case(3, MESH FLUID TERMS "boundary \"*\" { u = function(x, y) return 1 end }\n",
                "must return 2 numbers");
    assert_case(3, MESH FLUID TERMS "boundary \"*\" { u = function(x, y) return x.y, 1 end }\n",
                "attempt to index");
}

static void an_error_in_a_distance_function_is_named_with_its_line_and_place(void **state)
{
    (void)state;
    assert_case(
        3,
        MESH FLUID TERMS WALLS
        "particulate \"sharp\"\nparticle { density = 1, at = {0.5, 0.5}, shape = body { half = {0.2, 0.2},\n"
        "  distance = function(x, y) return x.y end } }\n",
        "bad.lua:7: function \"distance\" at (", "attempt to index");
    assert_case(
        3,
        MESH FLUID TERMS WALLS
        "particulate \"sharp\"\nparticle { density = 1, at = {0.5, 0.5}, shape = body { half = {0.2, 0.2},\n"
        "  distance = function(x, y) return 1 end } }\n",
        "bad.lua:7: shape: the distance function is nowhere negative");
}

static void a_missing_parameter_or_block_is_named(void **state)
{
    (void)state;
    assert_case(3, MESH "fluid { density = 1 }\n" TERMS WALLS, "needs \"viscosity\"");
    assert_case(3, FLUID TERMS WALLS, "the case has no mesh");
    assert_case(3, MESH FLUID WALLS, "the case has no term");
    assert_case(3, MESH FLUID "term \"continuity\" {}\n" WALLS, "field \"u\"", "no term gives an equation");
    assert_case(3, MESH MESH FLUID TERMS WALLS, "a second block");
    assert_ran(plugflow("run cases/cavity2d.lua --set ree=400 --out %s/bad", scratch()), 3, "did you mean \"re\"?");
    assert_ran(plugflow("run %s/nothing.lua", scratch()), 7, "nothing.lua");
}

static void a_mesh_that_cannot_fit_is_refused_before_it_is_made(void **state)
{
    (void)state;
    assert_case(8,
                "mesh { box = {{0,0,0},{1,1,1}}, cells = {2000,2000,2000} }\n" FLUID TERMS
                "boundary \"*\" { u = {0,0,0} }\n",
                "GB", "take fewer cells");
    assert_ran(plugflow("run cases/cavity2d.lua --memory 0.0001 --out %s/bad8", scratch()), 8, "factors", "GB");
}

static void symmetry_on_an_oblique_boundary_is_refused(void **state)
{
    (void)state;
    assert_case(
        3,
        "mesh { box = {{0,0},{1,1}}, cells = {4,4}, map = function(x, y) return x + 0.3 * y, y end }\n" FLUID TERMS
            WALLS "boundary \"left\" { symmetry = true }\n",
        "symmetry needs a plane");
}

static void a_probe_outside_the_mesh_is_an_error(void **state)
{
    (void)state;
    assert_case(3, MESH FLUID TERMS WALLS "output { probes = { far = {2, 2} } }\n", "probe \"far\"",
                "outside the mesh");
    assert_case(3, MESH FLUID TERMS WALLS "output { forces = {\"lid\"} }\n", "no boundary is called \"lid\"");
}

static void no_steady_state_is_code_6_with_a_hint(void **state)
{
    (void)state;
    assert_ran(plugflow("run %s --out %s/bad6",
                        put_file("hard.lua", MESH "fluid { density = 1, viscosity = 1e-7 }\n" TERMS
                                                  "boundary \"*\" { u = {0,0} }\nboundary \"top\" { u = {1,0} }\n"
                                                  "solve { max_iterations = 2 }\n"),
                        scratch()),
               6, "no steady state found");
    assert_ran(shell("cat %s/bad6/summary.json", scratch()), 0, "\"status\": \"not converged\"");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_misspelt_key_is_named_with_its_line_and_the_nearest_key),
        cmocka_unit_test(all_mistakes_are_reported_together),
        cmocka_unit_test(a_boundary_that_matches_nothing_lists_the_names),
        cmocka_unit_test(a_facet_without_condition_is_an_error),
        cmocka_unit_test(an_inverted_cell_is_a_mesh_error),
        cmocka_unit_test(a_missing_or_damaged_mesh_file_is_a_mesh_error),
        cmocka_unit_test(an_unknown_plugin_lists_where_it_was_looked_for),
        cmocka_unit_test(an_endless_loop_in_the_case_ends),
        cmocka_unit_test(the_sandbox_has_no_doors),
        cmocka_unit_test(a_function_that_returns_nonsense_is_named_with_place_and_time),
        cmocka_unit_test(an_error_in_a_distance_function_is_named_with_its_line_and_place),
        cmocka_unit_test(a_missing_parameter_or_block_is_named),
        cmocka_unit_test(a_mesh_that_cannot_fit_is_refused_before_it_is_made),
        cmocka_unit_test(symmetry_on_an_oblique_boundary_is_refused),
        cmocka_unit_test(a_probe_outside_the_mesh_is_an_error),
        cmocka_unit_test(no_steady_state_is_code_6_with_a_hint),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
