/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Mistakes in mesh{}, fluid{}, term "..." {}, time{}, solve{}, output{} and initial{}: each is refused with its
 * line, what was expected and what to write. */
#include "support/bad_case.h"
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

static void names_of_other_codes_are_understood(void **state)
{
    static const bad_case list[] = {
        {"9 time { dt = 0.05, t_end = 1 }",
         3,
         {"bad.lua:9: time: unknown key \"dt\"; did you mean \"step\"", "\"t_end\"; did you mean \"stop\"",
          "!missing"}},
        {"9 time { step = 0.1, n_steps = 10 }", 3, {"did you mean \"stop\"", "stop = start + steps * step"}},
        {"9 time { timestep = 0.1, tmax = 1, t0 = 0 }", 3, {"mean \"step\"", "mean \"stop\"", "mean \"start\""}},
        {"3 fluid { rho = 1, nu = 0.1 }",
         3,
         {"bad.lua:3: fluid: unknown key \"rho\"; did you mean \"density\"", "\"nu\"; did you mean \"viscosity\"",
          "density * kinematic viscosity", "!needs"}},
        {"3 fluid { density = 1, mu = 0.1, g = {0, -1} }",
         3,
         {"mean \"viscosity\"", "mean \"gravity\"", "!kinematic"}},
        {"2 mesh { domain = {{0,0},{2,1}}, resolution = {16,8} }", 3, {"mean \"box\"", "mean \"cells\""}},
        {"2 mesh { box = {{0,0},{2,1}}, nx = 16, ny = 8 }",
         3,
         {"bad.lua:2: ", "did you mean \"cells\"", "{nx, ny}"}},
        {"9 output { interval = 0.1, variables = {\"u\"} }", 3, {"mean \"every\"", "mean \"fields\""}},
        {"9 solve { tol = 1e-3, max_iter = 5 }", 3, {"mean \"tolerance\"", "mean \"max_iterations\""}},
        {"9 initial { velocity = {1, 0}, pressure = 1 }",
         3,
         {"unknown field \"velocity\"; did you mean \"u\"", "mean \"p\""}},
    };

    (void)state;
    assert_bad_cases(list);
}

static void steps_that_choose_their_length_have_a_tolerance_and_an_end(void **state)
{
    static const bad_case list[] = {
        {"9 time { tolerance = 1e-3, stop = 1 }", 0, {"bad.lua: ok"}},
        {"9 time { tolerance = 1e-3, stop = \"steady\", at_most = 5 }", 0, {"bad.lua: ok"}},
        {"9 time { stop = 1 }", 3, {"with tolerance = 1e-3, or another, steps choose their length"}},
        {"9 time { tol = 1e-3, stop = 1 }", 3, {"unknown key \"tol\"; did you mean \"tolerance\""}},
        {"9 time { tolerance = 2, stop = 1 }", 3, {"is 2; it must lie between 1e-08 and 0.5"}},
        {"9 time { tolerance = 1e-3, stop = 1, scheme = \"bdf1\" }", 3, {"with scheme = \"bdf2\" only"}},
        {"9 time { tolerance = 1e-3, stop = 1, step = 2 }", 3, {"step = 2 is longer than the whole run"}},
        {"9 time { tolerance = 1e-3, stop = \"stedy\", at_most = 3 }", 3, {"did you mean \"steady\"?"}},
        {"9 time { tolerance = 1e-3, stop = \"steady\" }", 3, {"\"at_most\" is missing"}},
        {"9 time { tolerance = 1e-3, stop = 1, at_most = 3 }", 3, {"\"at_most\" goes with stop = \"steady\" only"}},
        {"9 time { step = 0.1, stop = 1, steady = 1e-3 }", 3, {"\"steady\" goes with stop = \"steady\" only"}},
        {"9 time { tolerance = 1e-3, stop = 1 }\n10 output { tables_every = 1e-12 }", 3, {"would make 1e+12 rows"}},
        {"9 time { tolerance = 1e-3, stop = 1 }\n10 output { every = 1e-12 }", 3, {"would make 1e+12 files"}},
        {"9 time { tolerance = 1e-3, stop = 1 }\n10 output { tables_every = -1 }", 3, {"it must be positive"}},
    };

    (void)state;
    assert_bad_cases(list);
}

static void a_time_that_cannot_be_is_refused(void **state)
{
    static const bad_case list[] = {
        {"9 time { step = 0.1 }", 3, {"bad.lua:9: time: \"stop\" is missing", "!not after"}},
        {"9 time { stop = 1 }", 3, {"\"step\" is missing", "!\"stop\""}},
        {"9 time {}", 3, {"\"step\" is missing", "\"stop\" is missing"}},
        {"9 time { step = 10, stop = 1 }",
         3,
         {"step = 10 is longer than the whole run, from start = 0 to stop = 1"}},
        {"9 time { step = 1, stop = 1 }", 0, {"bad.lua: ok"}},
        {"9 time { step = 0.1, start = 2, stop = 1 }", 3, {"stop = 1 is not after start = 2"}},
        {"9 time { step = 0, stop = 1 }", 3, {"\"step\"", "is 0; it must be positive"}},
        {"9 time { step = 0/0, stop = 1 }", 3, {"must be a finite number"}},
        {"9 time { step = \"0.1\", stop = 1 }", 3, {"expected a number, got the string \"0.1\""}},
        {"9 time { step = 1e-12, stop = 1 }", 3, {"1e+12 steps are too many"}},
        {"9 time { step = 0.1, stop = 1, scheme = \"BDF2\" }", 3, {"did you mean \"bdf2\"?"}},
        {"9 time { 0.1, 1 }", 3, {"a value without a name"}},
        {"9 time { step = 0.1, stop = 1 }\n10 time { step = 0.1, stop = 2 }",
         3,
         {"bad.lua:10: time: a second block"}},
    };

    (void)state;
    assert_bad_cases(list);
}

static void numbers_of_the_fluid_have_a_meaning(void **state)
{
    static const bad_case list[] = {
        {"3 fluid { density = 1, viscosity = 0 }",
         3,
         {"bad.lua:3: fluid: \"viscosity\"", "is 0; it must be positive"}},
        {"5 term \"momentum\" { viscosity = 0 }",
         3,
         {"bad.lua:5: term \"momentum\": \"viscosity\"", "must be positive"}},
        {"3 fluid { density = 1, viscosity = 0 }\n9 term \"stabilise.streamline\" {}",
         3,
         {"bad.lua:3: fluid: \"viscosity\"", "is 0; it must be positive"}},
        {"3 fluid { density = 1, viscosity = 0 }\n5 term \"momentum\" { without = {\"viscous\"} }", 0, {"ok"}},
        {"3 fluid { density = 0, viscosity = 1 }", 0, {"ok"}},
        {"3 fluid { density = 0, viscosity = 1 }\n9 time { step = 1, stop = 2 }",
         3,
         {"bad.lua:3: fluid: \"density\"", "with time{} it must be positive", "without = {\"inertia\", ...}"}},
        {"3 fluid { density = 0, viscosity = 1 }\n5 term \"momentum\" { without = {\"inertia\", \"convection\"} }\n"
         "9 time { step = 1, stop = 2 }",
         0,
         {"ok"}},
        {"3 fluid { density = 1, viscosity = {0.1} }", 3, {"expected a number, got table"}},
        {"3 fluid { density = math.huge, viscosity = 0.1 }", 3, {"is inf; it must be a finite number"}},
        {"3 fluid { density = 1, viscosity = 1, gravity = {-9.81} }",
         3,
         {"\"gravity\"", "expected 2 numbers, got 1"}},
        {"3 fluid { density = 1, viscosity = 1, gravity = \"down\" }", 3, {"expected 2 numbers in braces"}},
        {"3 fluid { density = 1, viscosity = 1, gravity = {0, 0/0} }",
         3,
         {"\"gravity\"", "must be a finite number"}},
        {"3 fluid { density = 1, viscosity = 1, force = {0, 1} }",
         3,
         {"\"force\" is a key of the line term \"momentum\" {}"}},
        {"3 fluid { density = 1, viscosity = 1, traction = {0, 1} }",
         3,
         {"\"traction\" is a key of boundary \"...\" {}"}},
        {"3 fluid { density = 1, viscosity = 1, region = \"inside\" }", 3, {"\"everywhere\", \"outside\""}},
    };

    (void)state;
    assert_bad_cases(list);
}

static void a_term_line_lists_what_there_is(void **state)
{
    static const bad_case list[] = {
        {"5 term \"momentum\" { without = {\"inertai\"} }",
         3,
         {"bad.lua:5: ", "plugin \"momentum\" has no term \"inertai\"; did you mean \"inertia\"?",
          "its terms: inertia, convection, viscous, pressure_gradient, body_force, traction", "!integrator"}},
        {"5 term \"momentum.viscos\" {}",
         3,
         {"no term \"viscos\"; did you mean \"viscous\"?", "!unknown key", "!prescribed"}},
        {"5 term { name = \"momentum\" }", 3, {"bad.lua:5: term: expected a name in quotes", "!unknown key"}},
        {"4 term \"momentum\" {}\n5 term \"continuity\" { without = {\"divergence\"} }", 3, {"no term is left"}},
        {"5 term \"momentum\" { force = {1, 0}, without = {\"body_force\"} }",
         3,
         {"\"force\" belongs to momentum.body_force, which is off here",
          "term \"momentum.body_force\" {} switches it on"}},
        {"5 term \"momentum\" { traction = {1, 0} }", 3, {"(momentum.traction) is a key of boundary"}},
        {"5 term \"momentum\" { turbulence = \"ke\" }",
         3,
         {"unknown key \"turbulence\"", "valid keys: force, gravity"}},
        {"5 term \"momentum\" { force = {free, 1} }", 3, {"free leaves a component open"}},
        {"5 ", 3, {"bad.lua:4: field \"u\"", "term \"momentum\" {} does", "!unknown key", "!cannot be prescribed"}},
        {"5 term \"momentum\" { without = {\"momentum\"} }\n9 term \"momentum.viscous\" {}",
         3,
         {"has no term \"momentum\"", "bad.lua:9: ", "viscous is on already, by line 5"}},
    };

    (void)state;
    assert_bad_cases(list);
}

static void a_mesh_that_cannot_be_is_refused(void **state)
{
    static const bad_case list[] = {
        {"2 mesh { box = {{0,0},{2,1}}, cells = 16 }", 3, {"\"cells\"", "expected a table in braces, got number"}},
        {"2 mesh { box = {{0,0},{2,1}}, cells = {16} }",
         3,
         {"expected 2 entries, one for each direction of the box, got 1"}},
        {"2 mesh { box = {{0,0},{2,1}}, cells = {16,8,4} }", 3, {"got 3"}},
        {"2 mesh { box = {{0,0},{2,1}}, cells = {16.5,8} }", 3, {"entry 1 is 16.5; it must be a whole number"}},
        {"2 mesh { box = {{0,0},{2,1}}, cells = {1e300,8} }", 3, {"entry 1 is 1e+300"}},
        {"2 mesh { box = {{0,0},{2,1}}, cells = {-1e300,8} }", 3, {"entry 1 is -1e+300"}},
        {"2 mesh { box = {{0,0},{2,1}}, cells = {math.huge,8} }", 3, {"entry 1 is inf"}},
        {"2 mesh { box = {{0,0},{2,1}}, cells = {50000,50000} }",
         8,
         {"bad.lua:2: mesh: 2.5e+09 cells", "take fewer cells"}},
        {"2 mesh { box = {{0,0},{2,1}} }", 3, {"\"cells\" is missing"}},
        {"2 mesh { cells = {16,8} }", 3, {"expected box = {{x, y}, {x, y}}"}},
        {"2 mesh { box = {0,0,2,1}, cells = {16,8} }", 3, {"expected two corners of 2 or 3 finite numbers"}},
        {"2 mesh { box = {{0,0},{math.huge,1}}, cells = {16,8} }", 3, {"finite numbers"}},
        {"2 mesh { box = {{0,0},{2,1},{3,1}}, cells = {16,8} }", 3, {"expected two corners"}},
        {"2 mesh { box = {{0,0},{2,1}}, cells = {16,8}, shape = \"triangle\" }",
         3,
         {"did you mean \"triangles\"?"}},
        {"2 mesh { box = {{0,0},{2,1}}, cells = {{0,2,1},8} }", 3, {"direction 1 must ascend: 2, 1"}},
        {"2 mesh { box = {{0,0},{2,1}}, cells = {{0,1,3},8} }", 3, {"go from 0 to 3, the box from 0 to 2"}},
        {"2 mesh { box = {{0,0},{2,1}}, cells = {{0,\"a\",2},8} }", 3, {"direction 1 must be finite numbers"}},
        {"2 mesh { box = {{0,0},{2,1}}, cells = {16,8}, map = {1,2} }", 3, {"\"map\" must be a function"}},
        {"2 mesh { box = {{0,0},{2,1}}, cells = {16,8}, map = function(x,y) return -x,y end }",
         4,
         {"bad.lua:2: ", "inverted"}},
        {"2 mesh { file = \"a.msh\", box = {{0,0},{2,1}}, cells = {4,4} }", 3, {"both given", "!unknown key"}},
        {"2 mesh { box = {{0,0,0},{2,-1,1}}, cells = {4,4,4} }\n6 boundary \"*\" { u = {0,0,0} }\n7 \n8 ",
         3,
         {"-1 is not > 0", "!expected 2 components"}},
    };

    (void)state;
    assert_bad_cases(list);
}

static void output_lists_what_there_is(void **state)
{
    static const bad_case list[] = {
        {"9 output { fields = {\"vorticity\"} }",
         3,
         {"no field \"vorticity\"; there are: u (velocity), p (pressure)"}},
        {"9 output { fields = {\"u\", \"u\"} }", 3, {"\"u\" stands there twice"}},
        {"9 output { forces = {\"botom\"} }", 3, {"bad.lua:9: output: forces", "did you mean \"bottom\"?"}},
        {"9 output { probes = {{1, 0.5}} }", 3, {"every entry needs a name of its own"}},
        {"9 output { probes = { a = {0/0, 0.5} } }", 3, {"probe \"a\" needs 2 coordinates"}},
        {"9 output { probes = { a = {1, 0.5},\n10 b = {3, 0.5} } }",
         3,
         {"bad.lua:10: output: probe \"b\" at (3, 0.5) lies outside"}},
        {"9 output { probes = { a = {2, 1} } }", 0, {"ok"}},
        {"9 output { lines = { a = { from = {0,0}, to = {1,1}, points = 2.5 } } }",
         3,
         {"\"points\"", "whole number"}},
        {"9 output { lines = { a = { from = {0,0}, to = {1,1}, points = 1e30 } } }",
         3,
         {"must lie between 2 and 1e+07"}},
        {"9 output { lines = { a = { from = {0,0}, to = {1,1}, n = 11 } } }",
         3,
         {"line \"a\": unknown key \"n\"; did you mean \"points\""}},
        {"9 output { lines = { a = { from = {0,0} } } }", 3, {"line \"a\": \"to\" is missing"}},
        {"9 output { lines = { a = { from = {0,2}, to = {2,2} } } }",
         3,
         {"line \"a\" from (0, 2) to (2, 2) lies outside"}},
        {"9 output { lines = { a = { from = {1,-1}, to = {1,2} } } }", 0, {"ok"}},
        {"9 output { about = {0,0,0} }", 3, {"\"about\"", "expected 2 numbers, got 3"}},
    };

    (void)state;
    assert_bad_cases(list);
}

static void initial_and_solve_name_what_there_is(void **state)
{
    static const bad_case list[] = {
        {"9 initial { temperature = 1 }", 3, {"initial: unknown field \"temperature\"", "valid fields: p, u"}},
        {"9 exact { vorticity = 1 }", 3, {"exact: unknown field \"vorticity\"", "valid fields: p, u"}},
        {"9 initial { u = {free, 0} }", 3, {"free leaves a component open"}},
        {"9 initial { u = 1 }", 3, {"expected 2 components"}},
        {"9 solve { continuation = { nu = 1 } }", 3, {"no term has a number called \"nu\""}},
        {"9 solve { continuation = { viscosity = \"a\" } }", 3, {"expected parameters and where they start"}},
        {"9 solve { max_iterations = 1.5 }", 3, {"whole number"}},
        {"6 boundary \"*\" { natural = true }\n7 \n8 ", 3, {"nothing determines \"u\"", "!unknown"}},
        {"6 boundary \"*\" { natural = true }\n7 \n8 \n9 time { step = 1, stop = 2 }", 0, {"ok"}},
    };

    (void)state;
    assert_bad_cases(list);
}

static void a_flow_that_no_cell_resolves_is_doubted(void **state)
{
    static const bad_case list[] = {
        {"3 fluid { density = 1000, viscosity = 1e-3 }",
         0,
         {"warning: the Reynolds number of the smallest cells is 1.2e+05"}},
        {"3 fluid { density = 1, viscosity = 1e-3 }", 0, {"!Reynolds"}},
        {"3 fluid { density = 1000, viscosity = 1e-3 }\n5 term \"momentum\" { without = {\"convection\"} }",
         0,
         {"!Reynolds"}},
    };

    (void)state;
    assert_bad_cases(list);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_of_other_codes_are_understood),
        cmocka_unit_test(a_time_that_cannot_be_is_refused),
        cmocka_unit_test(steps_that_choose_their_length_have_a_tolerance_and_an_end),
        cmocka_unit_test(numbers_of_the_fluid_have_a_meaning),
        cmocka_unit_test(a_term_line_lists_what_there_is),
        cmocka_unit_test(a_mesh_that_cannot_be_is_refused),
        cmocka_unit_test(output_lists_what_there_is),
        cmocka_unit_test(initial_and_solve_name_what_there_is),
        cmocka_unit_test(a_flow_that_no_cell_resolves_is_doubted),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
