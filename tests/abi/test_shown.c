/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Terms of a plugin outside of the tree that only show (shown.c): fields, rates, integrals over boundaries and
 * bodies, all of which are known; what is refused. */
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FLUID         "fluid { density = 1, viscosity = 1 }\nterm 'continuity' {}\nterm 'momentum' {}\n"
#define BOX(N, SHAPE) "mesh { box = {{0,0},{1,1}}, cells = {" N ", " N "}, shape = '" SHAPE "' }\n"

static ran run(const char *text, const char *out)
{
    return plugflow("run %s --plugin %s/shown.so --threads 1 --out %s/%s", put_file("case.lua", text),
                    getenv("PLUGFLOW_BROKEN_DIR"), scratch(), out);
}

/* The value of a column in a row of a table; row -1: the last. */
static double cell(const char *out, const char *table, const char *column, int row)
{
    char path[600];
    double *v, x;
    int n;

    snprintf(path, sizeof path, "%s/%s/%s", scratch(), out, table);
    n = csv_column(path, column, &v);
    assert_true(n > row && n > 0);
    x = v[row < 0 ? n - 1 : row];
    free(v);
    return x;
}

/* Largest difference of the projected |x|^2 from it along a line that meets no symmetry of the mesh. */
static double error_of_square(const char *n, const char *shape)
{
    char text[1000], path[600];
    double *v, *x, *y, most = 0;
    int points;

    snprintf(text, sizeof text,
             "mesh { box = {{0,0},{1,1}}, cells = {%s, %s}, shape = '%s' }\n" FLUID
             "term 'shown.square' {}\nboundary '*' { u = {0, 0} }\n"
             "output { lines = { a = { from = {0.01, 0.07}, to = {0.97, 0.93}, points = 201 } } }\n"
             "results(function(r) return { mean = r.mean.square[1] } end)\n",
             n, n, shape);
    assert_ran(run(text, "o"), 0, "ok in");
    snprintf(path, sizeof path, "%s/o/lines/a.csv", scratch());
    points = csv_column(path, "square", &v);
    assert_int_equal(csv_column(path, "x", &x), points);
    assert_int_equal(csv_column(path, "y", &y), points);
    assert_int_equal(points, 201);
    for (int i = 0; i < points; i++)
        most = fmax(most, fabs(v[i] - x[i] * x[i] - y[i] * y[i]));
    free(v);
    free(x);
    free(y);
    assert_between(summary("o", "results.mean") - 2.0 / 3, -1e-13, 1e-13);
    assert_between(cell("o", "integrals.csv", "moment", 0) - 2.0 / 3, -1e-13, 1e-13);
    return most;
}

/* Integrals are those of the function, not of its projection, and both are exact; the projection is of second
 * order. On squares of side h it differs from a parabola by h^2/6 at most where the boundary is far. */
static void a_projection_has_second_order_and_the_mean_of_what_it_projects(void **state)
{
    static const char *const shape[] = {"quads", "triangles"};

    (void)state;
    for (int k = 0; k < 2; k++) {
        double coarse = error_of_square("6", shape[k]), fine = error_of_square("12", shape[k]);

        assert_between(fine, 1.0 / 144 / 12, 3.0 / 144);
        assert_between(coarse / fine, 3.6, 4.4);
    }
}

/* The fluid and a disk in it move as one, u = (t, 2t): du/dt is (1, 2) everywhere, and u has grown by it times dt.
 */
static void rates_are_those_of_the_scheme_also_near_a_body_that_moves(void **state)
{
    const double volume = 1 - M_PI * 0.04;

    (void)state;
    assert_ran(
        run(BOX("10", "quads") FLUID
            "particulate 'sharp'\nterm 'shown.rate' {}\n"
            "boundary '*' { u = function(x, y, t) return t, 2 * t end }\n"
            "particle { shape = disk { radius = 0.2 }, density = 1, at = {0.41, 0.43}, motion = 'prescribed',\n"
            "  velocity = function(t) return t, 2 * t end, spin = 0 }\n"
            "time { scheme = 'bdf2', step = 0.05, stop = 0.2 }\n"
            "output { probes = { near = {0.66, 0.5}, inside = {0.42, 0.45} } }\n",
            "r"),
        0, "ok in");
    assert_true(isnan(cell("r", "integrals.csv", "total_rate_x", 0))); /* no step has been made */
    for (int row = 1; row < 5; row++) {
        assert_between(cell("r", "integrals.csv", "total_rate_x", row) / volume - 1, -1e-6, 1e-6);
        assert_between(cell("r", "integrals.csv", "total_rate_y", row) / volume - 2, -1e-6, 1e-6);
        assert_between(cell("r", "integrals.csv", "growth_y", row) / volume - 0.1, -1e-6, 1e-6);
        assert_between(cell("r", "probes.csv", "near.acceleration_x", row) - 1, -1e-5, 1e-5);
        assert_true(isnan(cell("r", "probes.csv", "inside.acceleration_x", row)));
    }
}

/* Mass and momentum of two disks that move, and who is near whom: the first of a pair of bodies counts it. */
static void values_of_bodies_are_columns_of_particles(void **state)
{
    (void)state;
    assert_ran(
        run(BOX("16", "quads") FLUID
            "particulate 'sharp'\nterm 'contact.repulsion' { force = 1e-9 }\n"
            "term 'shown.weight' {}\nterm 'shown.momentum_inside' {}\nterm 'shown.neighbours' {}\n"
            "boundary '*' { u = {0, 0} }\n"
            "particle { shape = disk { radius = 0.1 }, density = 3, at = {0.3, 0.51}, motion = 'prescribed',\n"
            "  velocity = {0.5, -1}, spin = 2 }\n"
            "particle { shape = disk { radius = 0.1 }, density = 2, at = {0.52, 0.5}, motion = 'fixed' }\n"
            "time { step = 0.001, stop = 0.001 }\n",
            "b"),
        0, "ok in");
    for (int start = 0; start < 4; start += 2) { /* two bodies a row; at the start as well */
        assert_between(cell("b", "particles.csv", "weight", start) / (M_PI * 0.03) - 1, -1e-13, 1e-13);
        assert_between(cell("b", "particles.csv", "weight", start + 1) / (M_PI * 0.02) - 1, -1e-13, 1e-13);
        assert_between(cell("b", "particles.csv", "momentum_x", start) / (M_PI * 0.015) - 1, -1e-11, 1e-11);
        assert_between(cell("b", "particles.csv", "momentum_y", start) / (M_PI * 0.03) + 1, -1e-11, 1e-11);
        assert_between(cell("b", "particles.csv", "momentum_x", start + 1), -1e-13, 1e-13);
        assert_between(cell("b", "particles.csv", "neighbours", start) +
                           cell("b", "particles.csv", "neighbours", start + 1),
                       1, 1);
    }
}

/* The halves of the square, each by a line of its own; the field is that of both. */
static void lines_of_one_term_have_columns_each_and_one_field(void **state)
{
    (void)state;
    assert_ran(run(BOX("8", "quads") FLUID
                   "term 'shown.square' { name = 'left', inside = function(x, y) return x < 0.5 end }\n"
                   "term 'shown.square' { name = 'right', inside = function(x, y) return x >= 0.5 end }\n"
                   "boundary '*' { u = {0, 0} }\nresults(function(r) return { mean = r.mean.square[1] } end)\n",
                   "l"),
               0, "ok in");
    assert_between(cell("l", "integrals.csv", "left.moment", 0) - (1.0 / 24 + 1.0 / 6), -1e-13, 1e-13);
    assert_between(cell("l", "integrals.csv", "right.moment", 0) - (7.0 / 24 + 1.0 / 6), -1e-13, 1e-13);
    assert_between(summary("l", "results.mean") - 2.0 / 3, -1e-13, 1e-13);
}

static void what_cannot_be_shown_is_refused_with_why(void **state)
{
    (void)state;
    assert_ran(run(BOX("4", "quads") FLUID "term 'shown.logarithm' {}\nboundary '*' { u = {0, 0} }\n", "n"), 5,
               "term shown.logarithm: output \"logarithm\" is", "nan at x = (0.", "t = 0");
    assert_ran(run(BOX("4", "quads") FLUID "term 'shown.weight' {}\nboundary '*' { u = {0, 0} }\n", "n"), 3,
               "case.lua:5: term \"shown.weight\": shown.weight is about bodies, and the case has none");
    assert_ran(run(BOX("8", "quads") FLUID
                   "particulate 'sharp'\nterm 'shown.neighbours' {}\nboundary '*' { u = {0, 0} }\n"
                   "particle { shape = disk { radius = 0.3 }, density = 1, at = {0.5, 0.5}, motion = 'fixed' }\n",
                   "n"),
               3, "shown.neighbours is about near pairs, which are looked for where a term acts on them",
               "contact.lubrication");
    assert_ran(run(BOX("4", "quads") FLUID "term 'shown.square' { inside = function(x, y) return x < 0.5 end }\n"
                                           "term 'shown.square' { inside = function(x, y) return x >= 0.5 end }\n"
                                           "boundary '*' { u = {0, 0} }\n",
                   "n"),
               3,
               "case.lua:6: term \"shown.square\": shown.square shows \"moment\", and so does shown.square; give "
               "each line a name = \"...\" for its columns");
    assert_ran(run(BOX("4", "quads") FLUID "boundary '*' { u = {0, 0} }\noutput { fields = {'square'} }\n", "n"), 3,
               "there is no field \"square\"; there are: ", "; the line term \"shown.square\" {} shows it");
    assert_ran(run(BOX("4", "quads") FLUID
                   "term 'shown.rate' {}\nboundary '*' { u = {0, 0} }\noutput { integrals = {'left'} }\n",
                   "n"),
               3, "output: integrals: no term of the case gives an integral over boundaries");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_projection_has_second_order_and_the_mean_of_what_it_projects),
        cmocka_unit_test(rates_are_those_of_the_scheme_also_near_a_body_that_moves),
        cmocka_unit_test(values_of_bodies_are_columns_of_particles),
        cmocka_unit_test(lines_of_one_term_have_columns_each_and_one_field),
        cmocka_unit_test(what_cannot_be_shown_is_refused_with_why),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
