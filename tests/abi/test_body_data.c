/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What terms read of bodies, against what it is: the terms of body_probe.c put one number each into the row of
 * their body. */
#include "support/opened.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Two bodies near each other through the periodic sides of a box, away from its walls below and above. */
static const char in_2d[] =
    "local where, what, component = param('where', 'body', ''), param('what', 'x', ''), param('component', 0, '')\n"
    "mesh { box = {{0, 0}, {2, 3}}, cells = {20, 30} }\n"
    "fluid { density = 1, viscosity = 1 }\n"
    "term 'continuity' {}\nterm 'momentum' {}\nparticulate 'sharp'\n"
    "term 'body_probe.hold' {}\n"
    "term('body_probe.' .. where) { what = what, component = component }\n"
    "boundary { periodic = {'left', 'right'} }\nboundary '*' { u = {0, 0} }\n"
    "particle { shape = ellipse { a = 0.2, b = 0.1 }, density = 2, at = {1.75, 1.3}, angle = 0.4 }\n"
    "particle { shape = ellipse { a = 0.15, b = 0.1 }, density = 3, at = {0.2, 1.25}, angle = -1.1,\n"
    "  pull = where ~= 'none' and {1, -2} or nil }\n"
    "time { step = 0.1, stop = 1 }\n";

static const char in_3d[] =
    "local where, what, component = param('where', 'body', ''), param('what', 'x', ''), param('component', 0, '')\n"
    "mesh { box = {{0, 0, 0}, {2, 2, 2}}, cells = {8, 8, 8} }\n"
    "fluid { density = 1, viscosity = 1 }\n"
    "term 'continuity' {}\nterm 'momentum' {}\nparticulate 'sharp'\n"
    "term 'body_probe.hold' {}\n"
    "term('body_probe.' .. where) { what = what, component = component }\n"
    "boundary '*' { u = {0, 0, 0} }\n"
    "particle { shape = ellipsoid { a = 0.5, b = 0.4, c = 0.3 }, density = 2, at = {0.9, 1, 1.05},\n"
    "  orientation = {0.8, 0.2, -0.4, 0.4} }\n"
    "time { step = 0.1, stop = 1 }\n";

/* One body over a wall. */
static const char at_wall[] = "local where, what, component = param('where', 'first', ''), param('what', 'x', ''), "
                              "param('component', 0, '')\n"
                              "mesh { box = {{0, 0}, {2, 2}}, cells = {16, 16} }\n"
                              "fluid { density = 1, viscosity = 1 }\n"
                              "term 'continuity' {}\nterm 'momentum' {}\nparticulate 'sharp'\n"
                              "term 'body_probe.hold' {}\n"
                              "term('body_probe.' .. where) { what = what, component = component }\n"
                              "boundary '*' { u = {0, 0} }\n"
                              "particle { shape = disk { radius = 0.2 }, density = 2, at = {1.1, 0.3} }\n"
                              "time { step = 0.1, stop = 1 }\n";

static const double fluid[2][6] = {{0.1, 0.2, 0, 0.3}, {-0.4, 0.5, 0, -0.6}};
static const double fluid_3d[1][6] = {{0.1, 0.2, 0.3, -0.4, -0.5, -0.6}};

/* The rows of field a (or c) of all bodies, at zero. */
static void rows(const char *text, const char *const *sets, int n, const char *name, double *row)
{
    opened *k = open_text(text, sets, n);
    problem *p = &k->p;
    double *r = calloc((size_t)p->space.n_dof, sizeof *r);
    int f = space_find_field(&p->space, name);
    error err = {0};

    assert_int_equal(problem_initial(p, &err), 0);
    if (assembly_run(&p->system.assembly,
                     &(assembly_state){.x = p->state.x,
                                       .dot = p->system.step,
                                       .old = p->state.x,
                                       .bodies = problem_points(p),
                                       .fluid = p->description.dim == 3 ? fluid_3d : fluid},
                     r, NULL, 1, &err))
        fail_msg("%s", err.text);
    for (int i = 0; i < p->bodies.n; i++)
        row[i] = r[p->space.first[f][space_body_carrier(&p->space, i)]];
    free(r);
    close_case(k);
}

static void expect(const char *text, const char *where, const char *what, int component, int body, double value,
                   double tolerance)
{
    char set[3][60];
    const char *sets[3] = {set[0], set[1], set[2]};
    double row[2] = {0};

    snprintf(set[0], sizeof set[0], "where=%s", where);
    snprintf(set[1], sizeof set[1], "what=%s", what);
    snprintf(set[2], sizeof set[2], "component=%d", component);
    rows(text, sets, 3, "a", row);
    if (!(fabs(row[body] - value) <= tolerance * fmax(1, fabs(value))))
        fail_msg("%s of body %d on %s points, component %d: %.15g, expected %.15g", what, body, where, component,
                 row[body], value);
}

#define ROUND 1e-13

static void a_body_in_2d_is_as_it_is(void **state)
{
    const double area = M_PI * 0.02, mass = 2 * area;

    (void)state;
    expect(in_2d, "body", "x", 1, 0, 1.3, ROUND);
    expect(in_2d, "body", "centre", 0, 0, 1.75, ROUND);
    expect(in_2d, "body", "axes", 0, 0, cos(0.4), ROUND);
    expect(in_2d, "body", "axes", 1, 0, -sin(0.4), ROUND);
    expect(in_2d, "body", "axes", 2, 1, sin(-1.1), ROUND);
    expect(in_2d, "body", "volume", 0, 0, area, ROUND);
    expect(in_2d, "body", "mass", 0, 0, mass, ROUND);
    expect(in_2d, "body", "inertia", 0, 0, mass * (0.04 + 0.01) / 4, ROUND);
    expect(in_2d, "body", "density", 0, 1, 3, 0);
    expect(in_2d, "body", "id", 0, 1, 1, 0);
    expect(in_2d, "body", "arm", 1, 1, 0, 0);
    expect(in_2d, "body", "fluid_force", 1, 1, 0.5, 0);
    expect(in_2d, "body", "fluid_torque", 0, 1, -0.6, 0);
    expect(in_2d, "body", "key", 1, 1, -2, 0);
    expect(in_2d, "body", "key", 1, 0, 0.25, 0);
    expect(in_2d, "body", "wall_distance", 0, 0, 1.3, ROUND);
}

/* The weights inside of a body add up to its volume exactly. */
static void points_inside_know_their_body(void **state)
{
    const double area = M_PI * 0.02, mass = 2 * area;

    (void)state;
    expect(in_2d, "solid", "centre", 1, 0, 1.3 * area, 1e-12);
    expect(in_2d, "solid", "axes", 1, 0, -sin(0.4) * area, 1e-12);
    expect(in_2d, "solid", "inertia", 0, 0, mass * (0.04 + 0.01) / 4 * area, 1e-12);
    expect(in_2d, "solid", "key", 0, 1, M_PI * 0.015, 1e-12);
    expect(in_2d, "solid", "wall_distance", 0, 1, 1.25 * M_PI * 0.015, 1e-12);
}

/* The normal of a closed curve turns once. */
static void curvature_along_an_outline_is_a_turn(void **state)
{
    (void)state;
    expect(in_2d, "surface", "curvature", 0, 0, 2 * M_PI, 1e-4);
    expect(at_wall, "surface", "curvature", 0, 0, 2 * M_PI, 1e-6);
}

static void a_body_in_3d_is_as_it_is(void **state)
{
    const double w = 0.8, x = 0.2, y = -0.4, z = 0.4; /* a unit quaternion */
    const double axes[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
                               {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
                               {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
    const double volume = 4.0 / 3 * M_PI * 0.06, mass = 2 * volume;
    const double own[3] = {mass * (0.16 + 0.09) / 5, mass * (0.25 + 0.09) / 5, mass * (0.25 + 0.16) / 5};

    (void)state;
    expect(in_3d, "body", "volume", 0, 0, volume, ROUND);
    expect(in_3d, "body", "mass", 0, 0, mass, ROUND);
    expect(in_3d, "body", "centre", 2, 0, 1.05, ROUND);
    expect(in_3d, "body", "fluid_torque", 2, 0, -0.6, 0);
    for (int i = 0; i < 3; i++) {
        double inertia = 0;
        const int j = (i + 1) % 3;

        for (int k = 0; k < 3; k++)
            inertia += axes[i][k] * own[k] * axes[j][k];
        expect(in_3d, "body", "axes", 3 * i + j, 0, axes[i][j], ROUND);
        expect(in_3d, "body", "inertia", 3 * i + j, 0, inertia, ROUND);
    }
}

static void a_pair_knows_both_bodies(void **state)
{
    (void)state; /* the first is body 1; body 0 is near through the periodic side, at (-0.25, 1.3) */
    expect(in_2d, "first", "id", 0, 1, 1, 0);
    expect(in_2d, "first", "id", 0, 0, 0, 0);
    expect(in_2d, "other", "id", 0, 0, 1, 0);
    expect(in_2d, "first", "other_centre", 0, 1, -0.25, ROUND);
    expect(in_2d, "first", "other_centre", 1, 1, 1.3, ROUND);
    expect(in_2d, "first", "centre", 0, 1, 0.2, ROUND);
    expect(in_2d, "first", "other_axes", 2, 1, sin(0.4), ROUND);
    expect(in_2d, "first", "axes", 2, 1, sin(-1.1), ROUND);
    expect(in_2d, "first", "mass", 0, 1, 3 * M_PI * 0.015, ROUND);
    expect(in_2d, "first", "key", 0, 1, 1, 0);
    expect(in_2d, "first", "other_key", 0, 1, 0.25, 0);
}

/* Arms end in the middle of the gap, on the line of centres. */
static void arms_of_a_pair_meet(void **state)
{
    double arm[2], other[2];
    const char *const names[2] = {"arm", "other_arm"};

    (void)state;
    for (int c = 0; c < 2; c++)
        for (int k = 0; k < 2; k++) {
            char what[40], component[40];
            double row[2];

            snprintf(what, sizeof what, "what=%s", names[k]);
            snprintf(component, sizeof component, "component=%d", c);
            rows(in_2d, (const char *[]){"where=first", what, component}, 3, "a", row);
            (k ? other : arm)[c] = row[1];
        }
    assert_true(fabs(0.2 + arm[0] - (-0.25 + other[0])) < ROUND);
    assert_true(fabs(1.25 + arm[1] - (1.3 + other[1])) < ROUND);
    assert_true(arm[0] < -0.1 && other[0] > 0.1);
}

static void a_wall_is_no_body(void **state)
{
    (void)state;
    expect(at_wall, "first", "other_id", 0, 0, -1, 0);
    expect(at_wall, "first", "other_centre", 1, 0, 0, 0);
    expect(at_wall, "first", "other_axes", 0, 0, 0, 0);
    expect(at_wall, "first", "other_arm", 1, 0, 0, 0);
    expect(at_wall, "first", "arm", 1, 0, -0.25, ROUND);
    expect(at_wall, "first", "other_key", 0, 0, 0, 0);
    expect(at_wall, "other", "arm", 1, 0, 0, 0); /* what a wall is given is dropped */
}

/* kappa_1 + kappa_2 of x^2/a^2 + y^2/b^2 + z^2/c^2 = 1 is
 * (a^2 + b^2 + c^2 - |x|^2) / (a^2 b^2 c^2 (x^2/a^4 + y^2/b^4 + z^2/c^4)^(3/2)). */
static void curvature_is_that_of_the_formula(void **state)
{
    shape ellipse = {.kind = SHAPE_ELLIPSOID, .dim = 2, .half = {0.5, 0.2}, .thickness = 0.4};
    shape super = {
        .kind = SHAPE_SUPERELLIPSOID, .dim = 2, .half = {0.5, 0.2}, .exponent = {2, 2}, .thickness = 0.4};
    shape solid = {.kind = SHAPE_ELLIPSOID, .dim = 3, .half = {0.5, 0.4, 0.3}, .thickness = 0.6};
    shape ball = {.kind = SHAPE_ELLIPSOID, .dim = 3, .half = {0.5, 0.5, 0.5}, .thickness = 1};
    shape cylinder = {.kind = SHAPE_CYLINDER, .dim = 3, .half = {0.5, 0.5, 1}, .thickness = 1};

    (void)state;
    for (int i = 0; i < 12; i++) {
        const double t = 0.1 + 0.5 * i, u = 0.2 + 0.2 * i;
        const double x[3] = {0.5 * cos(t), 0.2 * sin(t), 0};
        const double y[3] = {0.5 * sin(u) * cos(t), 0.4 * sin(u) * sin(t), 0.3 * cos(u)};
        const double b[3] = {0.5 * sin(u) * cos(t), 0.5 * sin(u) * sin(t), 0.5 * cos(u)};
        double plane = 0.1 / pow(0.25 * sin(t) * sin(t) + 0.04 * cos(t) * cos(t), 1.5);
        double square = y[0] * y[0] + y[1] * y[1] + y[2] * y[2];
        double sum = y[0] * y[0] / 0.0625 + y[1] * y[1] / 0.0256 + y[2] * y[2] / 0.0081;
        double space = (0.5 - square) / (0.25 * 0.16 * 0.09 * pow(sum, 1.5));

        assert_true(fabs(shape_curvature(&ellipse, x) / plane - 1) < 1e-13);
        assert_true(fabs(shape_curvature(&super, x) / plane - 1) < 1e-4);
        assert_true(fabs(shape_curvature(&solid, y) / space - 1) < 1e-13);
        assert_true(fabs(shape_curvature(&ball, b) - 4) < 1e-13);
    }
    assert_true(shape_curvature(&cylinder, (double[]){0.3, 0.4, 0.2}) == 2);
    assert_true(shape_curvature(&cylinder, (double[]){0.3, 0.1, 1}) == 0);
}

/* Values, derivatives and test functions of one side of a pair: the matrix is the derivative of the residual. */
static void sides_of_a_pair_are_derived(void **state)
{
    char text[2000];
    const char *last = strstr(in_2d, "term('body_probe.'"), *rest = strchr(last, '\n') + 1;
    const double at[2] = {0.7, -1.3}, step = 1e-6;
    double *r[2], *value;
    int64_t dof[2];
    opened *k;
    problem *p;
    error err = {0};
    assembly_state s;

    (void)state;
    snprintf(text, sizeof text, "%.*sterm 'body_probe.pair' {}\n%s", (int)(last - in_2d), in_2d, rest);
    k = open_text(text, (const char *[]){"where=none"}, 1);
    p = &k->p;
    assert_int_equal(problem_initial(p, &err), 0);
    for (int i = 0; i < 2; i++) {
        r[i] = calloc((size_t)p->space.n_dof, sizeof **r);
        dof[i] = p->space.first[space_find_field(&p->space, "a")][space_body_carrier(&p->space, i)];
        p->state.x[dof[i]] = at[i];
    }
    value = calloc((size_t)p->space.row[p->space.n_free], sizeof *value);
    s = (assembly_state){.x = p->state.x, .dot = p->system.step, .old = p->state.x, .bodies = problem_points(p)};
    assert_int_equal(assembly_run(&p->system.assembly, &s, r[0], value, 1, &err), 0);
    /* the first is body 1: a1 = -1.3, a2 = 0.7, less = -2 */
    assert_true(fabs(r[0][dof[1]] - (-1.3 + (1.69 * 0.7 - 1) + (2 * -2 - 1.3 * 0.7))) < 1e-12);
    assert_true(fabs(r[0][dof[0]] - (0.7 + (-1.3 - 3 * 0.49) - (2 * -2 - 1.3 * 0.7))) < 1e-12);
    for (int j = 0; j < 2; j++) {
        for (int sign = 0; sign < 2; sign++) {
            p->state.x[dof[j]] = at[j] + (sign ? step : -step);
            assert_int_equal(assembly_run(&p->system.assembly, &s, r[sign], NULL, 0, &err), 0);
        }
        p->state.x[dof[j]] = at[j];
        for (int i = 0; i < 2; i++) {
            int32_t row = p->space.free_of[dof[i]], column = p->space.free_of[dof[j]];
            double found = NAN;

            for (int64_t e = p->space.row[row]; e < p->space.row[row + 1]; e++)
                found = space_column(&p->space, row, e) == column ? value[e] : found;
            assert_true(fabs(found - (r[1][dof[i]] - r[0][dof[i]]) / (2 * step)) < 1e-8);
        }
    }
    free(r[0]);
    free(r[1]);
    free(value);
    close_case(k);
}

/* The gap is about 0.11: a term sees it or not, however far another one looks. */
static void a_term_sees_pairs_within_its_own_reach(void **state)
{
    char text[2000];
    const char *last = strstr(in_2d, "term('body_probe.'"), *rest = strchr(last, '\n') + 1;
    double a[2], c[2];

    (void)state;
    snprintf(text, sizeof text,
             "%.*sterm 'body_probe.within' { reach = 0.05 }\nterm 'body_probe.beyond' { far = 0.9 }\n%s",
             (int)(last - in_2d), in_2d, rest);
    rows(text, (const char *[]){"where=none"}, 1, "a", a);
    rows(text, (const char *[]){"where=none"}, 1, "c", c);
    assert_true(a[0] == 0 && a[1] == 0);
    assert_true(c[0] == 0 && c[1] == 1);
    snprintf(text, sizeof text, "%.*sterm 'body_probe.within' { reach = 1e30 }\n%s", (int)(last - in_2d), in_2d,
             rest);
    rows(text, (const char *[]){"where=none"}, 1, "a", a); /* body 1 is the first of the two; both have two walls */
    assert_true(a[0] == 2 && a[1] == 3);
}

/* Without bodies, too; on the middle line of the channel cells meet. */
static void cells_know_how_far_walls_are(void **state)
{
    opened *k = open_text("mesh { box = {{0, 0}, {1.5, 1}}, cells = {6, 8} }\n"
                          "fluid { density = 1, viscosity = 1 }\n"
                          "term 'continuity' {}\nterm 'momentum' {}\nterm 'body_probe.cells' {}\n"
                          "boundary { periodic = {'left', 'right'} }\nboundary '*' { u = {0, 0} }\n",
                          NULL, 0);
    problem *p = &k->p;
    int f = space_find_field(&p->space, "s");
    double *r = calloc((size_t)p->space.n_dof, sizeof *r), sum = 0;
    error err = {0};

    (void)state;
    assert_int_equal(problem_initial(p, &err), 0);
    assert_int_equal(assembly_run(&p->system.assembly,
                                  &(assembly_state){.x = p->state.x, .dot = p->system.step, .old = p->state.x}, r,
                                  NULL, 0, &err),
                     0);
    for (int64_t d = 0; d < p->space.n_dof; d++)
        sum -= p->space.dof_field[d] == f ? r[d] : 0;
    if (!(fabs(sum - 1.5 / 4) < 1e-13))
        fail_msg("integral of the distance %.15g, expected 0.375", sum);
    free(r);
    close_case(k);
}

int main(void)
{
    char path[2000];
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_body_in_2d_is_as_it_is),
        cmocka_unit_test(points_inside_know_their_body),
        cmocka_unit_test(curvature_along_an_outline_is_a_turn),
        cmocka_unit_test(a_body_in_3d_is_as_it_is),
        cmocka_unit_test(a_pair_knows_both_bodies),
        cmocka_unit_test(arms_of_a_pair_meet),
        cmocka_unit_test(a_wall_is_no_body),
        cmocka_unit_test(curvature_is_that_of_the_formula),
        cmocka_unit_test(sides_of_a_pair_are_derived),
        cmocka_unit_test(cells_know_how_far_walls_are),
        cmocka_unit_test(a_term_sees_pairs_within_its_own_reach),
    };

    snprintf(path, sizeof path, "%s:%s", getenv("PLUGFLOW_PLUGIN_PATH"), getenv("PLUGFLOW_BROKEN_DIR"));
    setenv("PLUGFLOW_PLUGIN_PATH", path, 1);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
