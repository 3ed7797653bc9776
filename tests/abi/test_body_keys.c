/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What bodies say for terms: keys of particle{}, how their fields start, and what is refused; and two magnets, in
 * fewer than 80 lines (magnets.c), whose torques are those of the formula. */
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const char head[] = "mesh { box = {{0, 0}, {1.5, 1}}, cells = {18, 12} }\n"
                           "fluid { density = 1e-6, viscosity = 1 }\n"
                           "term 'continuity' {}\nterm 'momentum' {}\nparticulate 'sharp'\n"
                           "boundary '*' { u = {0, 0} }\n";

/* A case with these lines more; the plugins of this folder can be found. */
static ran check(const char *lines)
{
    char text[3000];

    snprintf(text, sizeof text, "%s%s", head, lines);
    return plugflow("check %s", put_file("body.lua", text));
}

static void run_lines(const char *lines)
{
    char text[3000];

    snprintf(text, sizeof text, "%s%s", head, lines);
    assert_ran(plugflow("run %s --quiet --out %s/run", put_file("body.lua", text), scratch()), 0, NULL);
}

static const char *in_run(const char *file)
{
    static char path[600];

    snprintf(path, sizeof path, "%.400s/run/%s", scratch(), file);
    return path;
}

#define DISK(MORE) "particle { shape = disk { radius = 0.15 }, density = 1, at = {0.5, 0.5}" MORE " }\n"

static void keys_of_terms_that_are_off_are_named(void **state)
{
    (void)state;
    assert_ran(check("term 'electro.trap' { stiffness = 1, centre = {0, 0} }\n" DISK(", charge = 3")), 3,
               "body.lua:8: particle: \"charge\" belongs to electro.force, which is off here; term "
               "\"electro.force\" {} switches it on");
}

static void unknown_keys_list_those_of_terms(void **state)
{
    (void)state;
    assert_ran(check("term 'electro.force' { field = {1, 0} }\n" DISK(", chrage = 3")), 3,
               "body.lua:8: particle: unknown key \"chrage\"", "did you mean \"charge\" (charge of the body, C)?",
               "valid keys: angle, at, charge, density");
}

static void keys_keep_to_their_shape_and_range(void **state)
{
    (void)state;
    assert_ran(check("term 'magnets.pair' {}\n" DISK(", moment = {1, 0, 0}")), 3,
               "particle: \"moment\" (magnetic moment in the body's axes, A m): expected 2 numbers, got 3");
    assert_ran(check("term 'magnets.pair' {}\n" DISK(", moment = {1, 7}")), 3,
               "body.lua:8:", "component 2 is 7; it must lie between -5 and 5");
    assert_ran(check("term 'electro.force' { field = {1, 0} }\n" DISK(", charge = {1, 2}")), 3,
               "\"charge\" (charge of the body, C)", "a number");
}

static void a_key_means_one_thing(void **state)
{
    (void)state;
    assert_ran(check("term 'magnets.pair' {}\nterm 'electro.torque' { field = {1, 0} }\n" DISK("")), 3,
               "electro.torque and magnets.pair both have the key \"moment\" of bodies, with another unit");
}

static void terms_of_another_dimension_are_refused(void **state)
{
    (void)state;
    assert_ran(check("term 'electro.screened' { constant = 1, length = 1 }\n" DISK("")), 3,
               "body.lua:7: term \"electro.screened\": electro.screened is for cases in 3D, and this one is in 2D");
}

/* m x B of two parallel magnets at the angle a to their line: -2 s m^2 cos a sin a for both, s = strength / r^2. */
static void torques_of_magnets_are_those_of_the_formula(void **state)
{
    const double torque = 2 * 0.1 / 0.25 * 0.49 * cos(0.8) * sin(0.8);
    double *t;

    (void)state;
    run_lines("term 'magnets' {}\n"
              "for i = 0, 1 do\n"
              "  particle { shape = disk { radius = 0.15 }, density = 1, at = {0.5 + 0.5 * i, 0.5}, angle = 0.8 + "
              "9 * i,\n"
              "    moment = {0.7 * math.cos(9 * i), -0.7 * math.sin(9 * i)}, hold = {'x', 'y'} }\n"
              "end\n");
    assert_int_equal(csv_column(in_run("particles.csv"), "torque", &t), 2);
    assert_between(t[0] / torque - 1, -1e-12, 1e-12);
    assert_between(t[1] / torque - 1, -1e-12, 1e-12);
    free(t);
    assert_ran(shell("cat %s", in_run("case.json")), 0, "\"bodies\": {\"moment\": [[0.7, ");
}

/* The fluid holds against it, in a steady case at this instant. */
static void a_trap_pulls_with_what_its_body_is_away(void **state)
{
    double *force;

    (void)state;
    run_lines("term 'electro.trap' { stiffness = 3, centre = {0.7, 0.4} }\n" DISK(""));
    assert_int_equal(csv_column(in_run("particles.csv"), "fx", &force), 1);
    assert_between(force[0], -0.6 - 1e-9, -0.6 + 1e-9);
    free(force);
    assert_int_equal(csv_column(in_run("particles.csv"), "fy", &force), 1);
    assert_between(force[0], 0.3 - 1e-9, 0.3 + 1e-9);
    free(force);
}

/* theta' = 1 from what initial{} says at the centre, or the body itself; it comes before the bodies' own spin. */
static void fields_of_bodies_start_and_are_shown(void **state)
{
    double *theta, *mean, *x;
    int n;

    (void)state;
    assert_ran(
        plugflow("run %s --quiet --out %s/run",
                 put_file("theta.lua",
                          "mesh { box = {{0, 0}, {1.5, 1}}, cells = {18, 12} }\n"
                          "fluid { density = 1, viscosity = 1, gravity = {0, -10} }\n"
                          "term 'body_probe.turns' {}\nterm 'body_probe.feels' {}\n"
                          "term 'continuity' {}\nterm 'momentum' {}\nparticulate 'sharp'\n"
                          "boundary '*' { u = {0, 0} }\ninitial { theta = function(x, y) return 10 * x end }\n"
                          "particle { shape = disk { radius = 0.15 }, density = 2, at = {0.5, 0.5} }\n"
                          "particle { shape = disk { radius = 0.15 }, density = 3, at = {1, 0.5}, theta = 0.25 }\n"
                          "time { scheme = 'bdf2', step = 0.01, stop = 0.05 }\noutput { every = 0.05 }\n"
                          "results(function(r) return { mean = r.last.mean, theta = r.last['p0.theta'],\n"
                          "  first = r.series['p1.theta'][1] } end)\n"),
                 scratch()),
        0, NULL);
    assert_between(summary("run", "results.theta"), 5.05 - 1e-12, 5.05 + 1e-12);
    assert_between(summary("run", "results.first"), 0.26 - 1e-12, 0.26 + 1e-12);
    assert_between(summary("run", "results.mean"), 2.675 - 1e-12, 2.675 + 1e-12);
    n = csv_column(in_run("particles.csv"), "theta", &theta);
    assert_int_equal(n, 12);
    assert_true(theta[0] == 5 && theta[1] == 0.25);
    n = csv_column(in_run("problem.csv"), "mean", &mean);
    assert_int_equal(n, 6);
    assert_int_equal(csv_column(in_run("particles.csv"), "omega", &x), 12);
    assert_between(fabs(x[11]), 0, 0.1); /* theta is not taken for it */
    assert_ran(shell("tr '\\n' ' ' < %s", in_run("particles_00001.vtp")), 0,
               "Name=\"theta\" NumberOfComponents=\"1\" format=\"ascii\"> 5.05 0.3 ",
               "Name=\"felt\" NumberOfComponents=\"2\"");
    free(theta);
    free(mean);
    free(x);
}

/* What a term reads at a step is what particles.csv says of the step before. */
static void bodies_feel_what_the_fluid_did_last(void **state)
{
    double *felt, *force;

    (void)state;
    assert_int_equal(csv_column(in_run("particles.csv"), "felt_y", &felt), 12);
    assert_int_equal(csv_column(in_run("particles.csv"), "fy", &force), 12);
    for (int i = 4; i < 12; i++)
        assert_between(felt[i] - force[i - 2], -1e-12, 1e-12);
    assert_between(felt[11], 0.1, 10); /* drag and lift under water: of its weight */
    free(felt);
    free(force);
}

int main(void)
{
    char path[2000];
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(keys_of_terms_that_are_off_are_named),
        cmocka_unit_test(unknown_keys_list_those_of_terms),
        cmocka_unit_test(keys_keep_to_their_shape_and_range),
        cmocka_unit_test(a_key_means_one_thing),
        cmocka_unit_test(terms_of_another_dimension_are_refused),
        cmocka_unit_test(torques_of_magnets_are_those_of_the_formula),
        cmocka_unit_test(a_trap_pulls_with_what_its_body_is_away),
        cmocka_unit_test(fields_of_bodies_start_and_are_shown),
        cmocka_unit_test(bodies_feel_what_the_fluid_did_last),
    };

    snprintf(path, sizeof path, "%s:%s", getenv("PLUGFLOW_PLUGIN_PATH"), getenv("PLUGFLOW_BROKEN_DIR"));
    setenv("PLUGFLOW_PLUGIN_PATH", path, 1);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
