/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Memory of terms: against exact solutions in uniform shear, where all values are the same everywhere; steps that
 * are repeated; what moving bodies carry along. */
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

static void run(const char *name, const char *set, const char *out)
{
    assert_ran(plugflow("run tests/abi/%s.lua %s --plugin %s/memory.so --threads 1 --out %s/%s", name, set,
                        getenv("PLUGFLOW_BROKEN_DIR"), scratch(), out),
               0, "");
}

static double last(const char *out, const char *file, const char *column)
{
    char path[500];
    double *v, x;
    int n;

    snprintf(path, sizeof path, "%s/%s/%s.csv", scratch(), out, file);
    n = csv_column(path, column, &v);
    assert_true(n > 1);
    x = v[n - 1];
    free(v);
    return x;
}

#define assert_near(v, exact, error) assert_between(v, (exact) - (error), (exact) + (error))

/* Rate times time, and of the tensor half of it off the diagonal. */
static void strain_of_uniform_shear_is_rate_times_time(void **state)
{
    static const char *const set[] = {"", "--set shape=triangles", "--set three=true --set shape=hexes",
                                      "--set three=true --set shape=tets", "--set adaptive=true"};

    (void)state;
    for (size_t i = 0; i < sizeof set / sizeof *set; i++) {
        run("couette", set[i], "strain");
        assert_near(last("strain", "probes", "here.strain"), 2, 1e-10);
        assert_near(last("strain", "probes", "here.total_xy"), 1, 1e-10);
        assert_near(last("strain", "probes", "here.total_xx"), 0, 1e-10);
    }
}

/* dl/dt = a (1 - l) - b l G: backward Euler's l_n = l + (1 - l) / (1 + k dt)^n with k = a + b G, l = a / k,
 * exactly; its error falls with dt.  The shear stress has it, too, at the end of the step. */
static void structure_follows_its_equation(void **state)
{
    const double k = 0.7 + 0.4 * 2, rest = 0.7 / k, exact = rest + (1 - rest) * exp(-k);
    double error[2];

    (void)state;
    for (int i = 0; i < 2; i++) {
        const int n = i ? 20 : 10;
        const double euler = rest + (1 - rest) / pow(1 + k / n, n);

        run("couette", i ? "--set what=structure --set step=0.05" : "--set what=structure", "structure");
        assert_near(last("structure", "probes", "here.structure"), euler, 1e-10);
        assert_near(last("structure", "forces", "top.fx"), -(0.5 + 3 * euler) * 2, 1e-8);
        error[i] = last("structure", "probes", "here.structure") - exact;
    }
    assert_between(error[0] / error[1], 1.9, 2.1);
}

/* A viscosity that depends on the structure at the end of the step before; one that is the same everywhere is felt
 * by bodies as if fluid{} had it, at their surfaces and in cut cells, too. */
static void a_law_may_have_a_memory(void **state)
{
    const double k = 0.7 + 0.4 * 2, rest = 0.7 / k, before = rest + (1 - rest) / pow(1 + k / 10, 9);
    double force;

    (void)state;
    run("couette", "--set what=law", "law");
    assert_near(last("law", "forces", "top.fx"), -(0.5 + 3 * before) * 2, 1e-8);
    run("marked", "--set kind=ellipse", "number");
    run("marked", "--set kind=ellipse --set law=true", "law");
    force = last("number", "particles", "fx");
    assert_near(last("law", "particles", "fx"), force, 1e-6 * fabs(force));
}

/* A step that a term refuses, at its end, is repeated in halves; nothing of the try is left. */
static void a_step_that_is_repeated_leaves_nothing(void **state)
{
    (void)state;
    run("couette", "--set longest=0.03 --set swings=true", "halved");
    run("couette", "--set step=0.025 --set swings=true", "short");
    assert_true(summary("halved", "steps_halved") > 0);
    assert_near(last("halved", "probes", "here.strain"), last("short", "probes", "here.strain"), 1e-10);
}

static void the_largest_rate_so_far_is_kept(void **state)
{
    double most = 0;

    (void)state;
    run("couette", "--set what=peak --set swings=true", "peak");
    for (int n = 1; n <= 10; n++)
        most = fmax(most, fabs(2 * sin(0.3 * n)));
    assert_near(last("peak", "probes", "here.peak"), most, 1e-10);
}

/* Paths near a surface follow the body but for a part 3 (d / 8h)^2 of its way, here 0.2 % of it; more comes from
 * cells of which little is fluid, or body, whose parabola is left open: constant there, so by the change across a
 * cell. */
static void marks_go_along_with_bodies(void **state)
{
    static const char *const set[] = {"", "--set kind=ellipse", "--set shape=triangles"};

    (void)state;
    for (size_t i = 0; i < sizeof set / sizeof *set; i++) {
        run("marked", set[i], "marked");
        assert_between(summary("marked", "results.near"), 0, 0.012);
        assert_between(summary("marked", "results.inside"), 0, 0.012);
    }
}

/* A body keeps the way that it has gone, from 5 on, and the largest force up to the step before. */
static void a_body_has_a_memory_of_its_own(void **state)
{
    const double way = 0.2 * sqrt(0.9 * 0.9 + 0.4 * 0.4);
    double *fx, *fy, most = 0;
    char path[500];
    int n;

    (void)state;
    run("marked", "", "odometer");
    assert_near(last("odometer", "particles", "way"), 5 + way, 1e-10);
    snprintf(path, sizeof path, "%s/odometer/particles.csv", scratch());
    n = step_column(path, "fx", &fx);
    assert_int_equal(step_column(path, "fy", &fy), n);
    for (int i = 0; i < n - 1; i++)
        most = fmax(most, hypot(fx[i], fy[i]));
    assert_true(most > 0);
    assert_near(last("odometer", "particles", "most"), most, 1e-9 * most);
    free(fx);
    free(fy);
}

static void a_steady_case_has_no_memory(void **state)
{
    char text[1000];

    (void)state;
    snprintf(text, sizeof text,
             "mesh { box = {{0,0},{1,1}}, cells = {2,2} }\nfluid { density = 1, viscosity = 1 }\n"
             "term 'continuity' {}\nterm 'momentum' {}\nterm 'memory' {}\nboundary '*' { u = {0,0} }\n");
    assert_ran(
        plugflow("check %s --plugin %s/memory.so", put_file("steady.lua", text), getenv("PLUGFLOW_BROKEN_DIR")), 3,
        "steady.lua:5: ", "keeps \"strain\"", "a steady case has no steps");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(strain_of_uniform_shear_is_rate_times_time),
        cmocka_unit_test(structure_follows_its_equation),
        cmocka_unit_test(a_law_may_have_a_memory),
        cmocka_unit_test(a_step_that_is_repeated_leaves_nothing),
        cmocka_unit_test(the_largest_rate_so_far_is_kept),
        cmocka_unit_test(marks_go_along_with_bodies),
        cmocka_unit_test(a_body_has_a_memory_of_its_own),
        cmocka_unit_test(a_steady_case_has_no_memory),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
