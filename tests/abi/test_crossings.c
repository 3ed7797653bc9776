/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Where one feature of the interface meets another (crossings.c). */
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>

#define FLUID "term 'continuity' {}\nterm 'momentum' {}\n"
#define FALLING                                                                                                    \
    "mesh { box = {{0,0},{2,3}}, cells = {20, 30} }\n"                                                             \
    "fluid { density = 1, viscosity = 0.1, gravity = {0, -981} }\n" FLUID                                          \
    "particulate 'sharp'\nboundary '*' { u = {0, 0} }\n"                                                           \
    "particle { shape = disk { radius = 0.2 }, density = 1.25, at = {1, 2} }\n"                                    \
    "time { scheme = 'bdf2', step = 0.01, stop = 0.05 }\n"
#define CAVITY                                                                                                     \
    "mesh { box = {{0,0},{1,1}}, cells = {8, 8} }\nfluid { density = 1 }\n"                                        \
    "boundary 'top' { u = {1, 0} }\nboundary '*' { u = {0, 0} }\n"

static ran run(const char *text, const char *out)
{
    return plugflow("run %s --plugin %s/crossings.so --threads 1 --out %s/%s", put_file("case.lua", text),
                    getenv("PLUGFLOW_BROKEN_DIR"), scratch(), out);
}

static double last(const char *out, const char *table, const char *column)
{
    char path[600];
    double *v, x;
    int n;

    snprintf(path, sizeof path, "%s/%s/%s", scratch(), out, table);
    n = csv_column(path, column, &v);
    assert_true(n > 0);
    x = v[n - 1];
    free(v);
    return x;
}

/* Memory is that of the instant shown: a rate beside it, which comes along paths, does not carry it back. */
static void what_is_shown_has_the_memory_and_the_force_of_its_instant(void **state)
{
    (void)state;
    assert_ran(run(FALLING "initial { height = function(x, y) return y end }\nterm 'crossings.keep' {}\n"
                           "term 'crossings.lost' {}\nterm 'crossings.rate' {}\nterm 'crossings.force' {}\n",
                   "o"),
               0, "ok in");
    assert_between(last("o", "integrals.csv", "lost"), 0, 1e-9);
    assert_between(last("o", "particles.csv", "felt_y") / last("o", "particles.csv", "fy") - 1, -1e-12, 1e-12);
}

/* Its unit tells it from the velocity: it carries no energy, and a fixed body may have one that changes. */
static void a_vector_of_bodies_is_no_velocity(void **state)
{
    double energy;

    (void)state;
    assert_ran(run(FALLING, "without"), 0, "ok in");
    assert_ran(run(FALLING "term 'crossings.relax' {}\n", "with"), 0, "ok in");
    energy = summary("without", "energy.kinetic_end");
    assert_between(summary("with", "energy.kinetic_end") / energy - 1, -1e-4, 1e-4);
    assert_ran(run("mesh { box = {{0,0},{1,1}}, cells = {8, 8} }\nfluid { density = 1, conductivity = 1, "
                   "heat_capacity = 1 }\nterm 'heat' { without = {'advection', 'buoyancy'} }\n"
                   "term 'heat_bodies' { body_conductivity = 2 }\nterm 'crossings.relax' {}\n"
                   "boundary '*' { T = function(x) return x end }\nparticle { shape = disk { radius = 0.25 }, "
                   "density = 1, at = {0.51, 0.49}, motion = 'fixed' }\n",
                   "steady"),
               0, "ok in");
    assert_between(last("steady", "particles.csv", "dipole_x"), 100 - 1e-8, 100 + 1e-8);
}

static void a_property_counts_where_a_term_takes_it(void **state)
{
    (void)state;
    assert_ran(run(CAVITY
                   "term 'continuity' {}\nterm 'momentum' { without = {'viscous'} }\nterm 'crossings.law' {}\n"
                   "term 'crossings.rest' {}\n"
                   "term 'crossings.part' { inside = function(x, y) return x > 0.75 end }\n",
                   "o"),
               0, "ok in");
    assert_ran(run(CAVITY
                   "term 'continuity' {}\nterm 'momentum' { without = {'viscous'} }\nterm 'crossings.law' {}\n"
                   "term 'crossings.rest' {}\nterm 'crossings.part' {}\n",
                   "o"),
               6, "\"viscosity\" is -0.");
}

static void means_are_there_without_files(void **state)
{
    static const char *const output[] = {"", "output { fields = {'u'} }\n"};
    double mean[2];

    (void)state;
    for (int k = 0; k < 2; k++) {
        char text[1000];

        snprintf(text, sizeof text,
                 "mesh { box = {{0,0},{1,1}}, cells = {8, 8} }\nfluid { density = 1, viscosity = 0.1 }\n" FLUID
                 "boundary 'top' { u = {1, 0} }\nboundary '*' { u = {0, 0} }\nterm 'show.shear_rate' {}\n"
                 "%sresults(function(r) return { mean = r.mean.shear_rate[1] } end)\n",
                 output[k]);
        assert_ran(run(text, k ? "b" : "a"), 0, "ok in");
        mean[k] = summary(k ? "b" : "a", "results.mean");
    }
    assert_true(mean[0] > 1 && mean[0] == mean[1]);
}

static void what_cannot_be_is_refused(void **state)
{
    (void)state;
    assert_ran(run(FALLING "term 'crossings.clash' {}\n", "n"), 3, "would have two columns \"fx\"",
               "give its line a name");
    assert_ran(run(FALLING "term 'crossings.force' { name = 'a,b' }\n", "n"), 3,
               "term \"crossings.force\": \"name\" is a part of names of columns: expected at most 24 letters");
    assert_ran(run(CAVITY FLUID "term 'generalised_newtonian' { consistency = 0.1, exponent = 0.8 }\n"
                                "solve { continuation = { viscosity = 1 } }\n",
                   "n"),
               3, "\"viscosity\" is published by generalised_newtonian.law; continue in a number of that term");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_shown_has_the_memory_and_the_force_of_its_instant),
        cmocka_unit_test(a_vector_of_bodies_is_no_velocity),
        cmocka_unit_test(a_property_counts_where_a_term_takes_it),
        cmocka_unit_test(means_are_there_without_files),
        cmocka_unit_test(what_cannot_be_is_refused),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
