/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The balance of kinetic energy and the cell Reynolds number in summary.json, and the warning that a mesh does not
 * carry the flow. */
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FLUID "term 'continuity' {}\nterm 'momentum' {}\n"

static double energy(const char *key)
{
    char keys[80] = "energy.";

    strcat(keys, key);
    return summary("o", keys);
}

/* The work of a term. */
static double work(const char *term)
{
    ran r = shell(
        "python3 -c 'import json; print(json.load(open(\"%s/o/summary.json\"))[\"energy\"][\"terms\"][\"%s\"])'",
        scratch(), term);
    double v = NAN;

    assert_int_equal(sscanf(r.out, "%lf", &v), 1);
    return v;
}

/* 2 mu D(u) - p I */
static double stress(void)
{
    return work("momentum.viscous") + work("momentum.pressure_gradient");
}

/* What was taken in and given out, as far as these flows have it, is the change of kinetic energy. */
static void assert_balanced(double terms, double tolerance)
{
    double change = energy("kinetic_end") - energy("kinetic_start");

    assert_between(energy("in") - terms - energy("convected_out") + energy("made_by_scheme") - change, -tolerance,
                   tolerance);
    assert_between(energy("made_by_time") + energy("made_by_convection") - energy("made_by_scheme"), -tolerance,
                   tolerance);
}

/* |u| falls with exp(-2 nu t), so the energy with exp(-4 nu t); nothing is put in, and viscosity takes it. */
static void taylor_green_vortices_decay_by_viscosity_alone(void **state)
{
    static const struct {
        int n;
        double dt, error;
    } run[] = {{8, 0.025, 2e-2}, {16, 0.05, 1e-3}, {16, 0.025, 1e-3}};
    const double start = M_PI * M_PI, end = start * exp(-4 * 0.1 * 0.5);
    double by_time[3], by_convection[3];

    (void)state;
    for (int k = 0; k < 3; k++) {
        double e = run[k].error;

        assert_ran(plugflow("run %s --set n=%d --set dt=%g --out %s/o", strict("cases/taylor_green.lua"), run[k].n,
                            run[k].dt, scratch()),
                   0, "% of the largest); largest cell Reynolds number ");
        assert_between(energy("kinetic_start") / start, 1 - e, 1 + e);
        assert_between(energy("kinetic_end") / end, 1 - e, 1 + e);
        assert_between(stress() / (start - end), 1 - e, 1 + e);
        assert_between(energy("in"), -1e-12, 1e-12);
        assert_between(energy("convected_out"), -1e-12, 1e-12);
        assert_balanced(stress(), 1e-8);
        by_time[k] = fabs(energy("made_by_time"));
        by_convection[k] = fabs(energy("made_by_convection"));
    }
    assert_between(by_time[1] / by_time[2], 3.6, 4.4); /* second order in the step */
    assert_between(by_time[2] / start, 1e-6, 1e-4);
    assert_between(by_convection[2], 0, by_convection[0] / 8);
    assert_between(summary("o", "resolution.largest_cell_reynolds"), 3.5, 2 * M_PI / 16 / 0.1);
    assert_between(summary("o", "resolution.t"), 0, 0.05);
}

/* u = 4 y (1 - y): mu int |du/dy|^2 = 16 mu a unit of time, and the inflow brings it. */
static void what_drives_a_channel_is_dissipated(void **state)
{
    (void)state;
    assert_ran(plugflow("run %s --out %s/o",
                        put_file("case.lua", "mesh { box = {{0, 0}, {3, 1}}, cells = {6, 4} }\n"
                                             "fluid { density = 2, viscosity = 0.1 }\n" FLUID
                                             "local function u(x, y) return 4 * y * (1 - y), 0 end\n"
                                             "boundary '*' { u = {0, 0} }\nboundary 'left' { u = u }\n"
                                             "boundary 'right' { traction = function(x, y) return 0, 0.4 - 0.8 * y "
                                             "end }\ninitial { u = u }\n"
                                             "time { scheme = 'bdf2', step = 0.1, stop = 1 }\n"),
                        scratch()),
               0, NULL);
    assert_between(energy("kinetic_start"), 1.6 * (1 - 1e-9), 1.6 * (1 + 1e-9));
    assert_between(energy("kinetic_end"), 1.6 * (1 - 1e-9), 1.6 * (1 + 1e-9));
    assert_between(stress(), 1.6 * (1 - 1e-8), 1.6 * (1 + 1e-8));
    assert_between(energy("in"), 1.6 * (1 - 1e-8), 1.6 * (1 + 1e-8));
    assert_between(energy("made_by_scheme"), -1e-8, 1e-8);
    assert_between(summary("o", "resolution.largest_cell_reynolds"), 2 * sqrt(1.0 / 8) / 0.1 * (1 - 1e-9),
                   2 * sqrt(1.0 / 8) / 0.1 * (1 + 1e-9));
}

/* A residual has the rate of the velocity in it, and viscosity, and is neither a kinetic energy nor a stress. */
static void what_stabilises_by_a_residual_only_takes(void **state)
{
    static const char vortices[] = "run tests/verify/unresolved_vortices.lua --set stop=1 --set streamline=";
    double start, reynolds;

    (void)state;
    assert_ran(plugflow("%s0 --out %s/o", vortices, scratch()), 0, NULL);
    start = energy("kinetic_start");
    reynolds = summary("o", "resolution.largest_cell_reynolds");
    assert_ran(plugflow("%s0.1 --out %s/o", vortices, scratch()), 0, NULL);
    assert_between(energy("kinetic_start") / start, 1 - 1e-12, 1 + 1e-12);
    assert_between(summary("o", "resolution.largest_cell_reynolds") / reynolds, 0.99, 1.01);
    assert_between(energy("in"), 0, 0);
    assert_between(work("stabilise.streamline"), 1e-3, 1e-2);
    assert_balanced(stress() + work("stabilise.grad_div") + work("stabilise.streamline"), 2e-6 * start);
}

/* What a falling body loses in height is found again; its surface sweeps the domain of the fluid. */
static void a_falling_body_keeps_the_balance(void **state)
{
    const double weight = (1.25 - 1) * M_PI * 0.125 * 0.125 * 981;
    char path[500];
    double terms, *y, fallen;
    int n;

    (void)state;
    assert_ran(plugflow("run %s --set n=8 --set stop=0.1 --out %s/o", strict("cases/falling_disk.lua"), scratch()),
               0, NULL);
    terms = stress() + work("surface.nitsche") + work("surface.inflow") + work("surface.extension");
    assert_between(energy("kinetic_start"), 0, 0);
    snprintf(path, sizeof path, "%s/o/particles.csv", scratch());
    n = csv_column(path, "y", &y);
    fallen = 4 - y[n - 1];
    free(y);
    assert_between(energy("in") / (weight * fallen), 0.98, 1.02);
    assert_balanced(terms, 1e-6 * energy("in"));
    assert_between(energy("made_by_convection") / energy("kinetic_largest"), -2e-2, 2e-2);
}

/* A cavity at Re = 10000 on 8 x 8 cells blows up; at Re = 100 it does not. */
static void convection_that_makes_energy_is_told(void **state)
{
    static const char text[] = "mesh { box = {{0, 0}, {1, 1}}, cells = {8, 8} }\n"
                               "fluid { density = 1, viscosity = 1 / param('re', 100, 'Re') }\n" FLUID
                               "boundary '*' { u = {0, 0} }\nboundary 'top' { u = {1, 0} }\n"
                               "time { scheme = 'bdf2', step = 0.05, stop = 0.5 }\n";

    (void)state;
    assert_ran(plugflow("run %s --set re=10000 --out %s/o", put_file("case.lua", text), scratch()), 0,
               "the mesh does not resolve this flow: its convection has made ",
               "largest cell Reynolds number is 1.",
               "Refine the mesh there, or switch on a term that stabilises convection");
    assert_ran(shell("grep -c 'does not resolve' %s/o/run.jsonl", scratch()), 0, "1");
    assert_ran(plugflow("run %s --out %s/o", put_file("case.lua", text), scratch()), 0, NULL);
    assert_ran(shell("grep -c 'does not resolve' %s/o/run.jsonl", scratch()), 1, "0");
    assert_ran(shell("grep -c '\"energy\": [0-9.e-]*, \"energy_made\": ' %s/o/run.jsonl", scratch()), 0, "10");
}

static void a_steady_case_has_the_cell_reynolds_number_only(void **state)
{
    const double re = sqrt(3.0 / 16 / 8) / 0.1; /* h = sqrt(area) */

    (void)state;
    assert_ran(plugflow("run cases/channel.lua --out %s/o", scratch()), 0,
               "  largest cell Reynolds number 1.53 at ");
    assert_between(summary("o", "resolution.largest_cell_reynolds"), re * (1 - 1e-9), re * (1 + 1e-9));
    assert_true(isnan(energy("kinetic_end")));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(taylor_green_vortices_decay_by_viscosity_alone),
        cmocka_unit_test(what_drives_a_channel_is_dissipated),
        cmocka_unit_test(what_stabilises_by_a_residual_only_takes),
        cmocka_unit_test(a_falling_body_keeps_the_balance),
        cmocka_unit_test(convection_that_makes_energy_is_told),
        cmocka_unit_test(a_steady_case_has_the_cell_reynolds_number_only),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
