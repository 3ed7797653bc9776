/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Newton's method on the shipped cases: what it costs, and that none is suspected of a wrong Jacobian. */
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <string.h>

static void no_suspicion(ran r, const char *what)
{
    if (r.code != 0 || strstr(r.err, "Jacobian"))
        fail_msg("%s: exit code %d\n%s", what, r.code, r.err);
}

static void shipped_cases_are_not_suspected_of_a_wrong_jacobian(void **state)
{
    static const char *const run[] = {"cavity2d",
                                      "cavity2d.lua --set re=400",
                                      "cavity2d.lua --set re=1000",
                                      "cavity3d",
                                      "channel",
                                      "kovasznay",
                                      "fixed_disk",
                                      "fixed_sphere.lua --set n=6",
                                      "cylinder2d",
                                      "falling_disk.lua --set stop=0.1",
                                      "two_disks.lua --set stop=0.05",
                                      "backward_step.lua --set n=8",
                                      "taylor_green3d.lua --set n=4 --set stop=0.2",
                                      "cylinder2d.lua --set case=2D-3 --set stop=0.03",
                                      "disk_re450.lua --set stop=0.01",
                                      "dkt_re450.lua --set stop=0.01",
                                      "couette_migration.lua --set stop=1",
                                      "poiseuille_migration.lua --set stop=5",
                                      "falling_disk.lua --set stop=0.05 --set formulation=conservative"};

    (void)state;
    for (size_t i = 0; i < sizeof run / sizeof *run; i++)
        no_suspicion(plugflow("run cases/%s%s --out %s/run", run[i], strchr(run[i], '.') ? "" : ".lua", scratch()),
                     run[i]);
}

static void the_example_is_not_suspected_of_a_wrong_jacobian(void **state)
{
    (void)state;
    assert_ran(shell("cc -std=gnu11 -O2 -fPIC -shared -I include "
                     "examples/scalar_transport/scalar_transport.c -o %s/scalar_transport.so",
                     scratch()),
               0, NULL);
    no_suspicion(plugflow("run examples/scalar_transport/heated_cavity.lua --set n=24 --set ra=1e5 --plugin "
                          "%s/scalar_transport.so --out %s/hot",
                          scratch(), scratch()),
                 "heated_cavity");
}

/* As many matrices as steps; one residual more to begin with, one for the last correction, one for the output.  At
 * Re = 400 one step is halved: what was evaluated at its whole length is lost. */
static void an_iteration_takes_one_evaluation(void **state)
{
    double n;

    (void)state;
    assert_ran(plugflow("run cases/cavity2d.lua --quiet --set re=100 --out %s/cost", scratch()), 0, NULL);
    n = summary("cost", "newton_iterations");
    assert_between(summary("cost", "matrices"), n, n);
    assert_between(summary("cost", "evaluations"), n + 1, n + 3);
    assert_ran(plugflow("run cases/cavity2d.lua --quiet --set re=400 --out %s/cost", scratch()), 0, NULL);
    n = summary("cost", "newton_iterations");
    assert_between(summary("cost", "matrices"), n, n + 1);
    assert_between(summary("cost", "evaluations"), n + 1, n + 6);
}

/* A matrix that hardly changes is factored once: without convection all but the inflow through the surface is
 * linear. */
static void stokes_flow_is_factored_once(void **state)
{
    (void)state;
    assert_ran(plugflow("run cases/fixed_sphere.lua --quiet --set n=6 --out %s/stokes", scratch()), 0, NULL);
    assert_between(summary("stokes", "factorisations"), 1, 1);
}

/* A copy of the cavity with a line for solve{}. */
static ran cavity(const char *solve, const char *args, const char *dir)
{
    assert_ran(shell("sed 's/^output/solve { %s }\\noutput/' cases/cavity2d.lua > %s/cavity.lua", solve, scratch()),
               0, NULL);
    return plugflow("run %s/cavity.lua %s --out %s/%s", scratch(), args, scratch(), dir);
}

/* The solution is the same, wherever it starts; at the higher Reynolds number from rest by continuation. */
static void a_coarse_start_changes_the_cost_only(void **state)
{
    static const int re[] = {100, 1000};

    (void)state;
    for (int i = 0; i < 2; i++) {
        const char *args = re[i] == 100 ? "--set n=40" : "--set n=40 --set re=1000";
        double u, v, drag;

        assert_ran(cavity("coarse_start = false", args, "rest"), 0, "newton  0");
        u = summary("rest", "results.u_centre");
        v = summary("rest", "results.v_centre");
        drag = summary("rest", "results.drag");
        assert_ran(cavity("coarse_start = true", args, "coarse"), 0, "coarse grid 20 x 20: converged in ");
        assert_between(summary("coarse", "results.u_centre") - u, -1e-9, 1e-9);
        assert_between(summary("coarse", "results.v_centre") - v, -1e-9, 1e-9);
        assert_between(summary("coarse", "results.drag") - drag, -1e-9, 1e-9);
        assert_between(summary("coarse", "factorisations"), 1, 1);
        assert_between(summary("coarse", "newton_iterations"), 2, 5);
    }
}

/* Cells that are halved need be neither equal nor even in number, nor quadrilaterals; sides may be periodic. */
static void a_coarse_start_is_had_on_all_kinds_of_boxes(void **state)
{
    (void)state;
    assert_ran(cavity("coarse_start = true", "--set n=25 --set grading=1.5", "graded"), 0,
               "coarse grid 13 x 13: converged in ");
    assert_between(summary("graded", "newton_iterations"), 2, 5);
    put_file("periodic.lua", "case \"Flow between walls, driven by its weight\"\n"
                             "mesh { box = {{0, 0}, {2, 1}}, cells = {13, 24}, shape = \"triangles\" }\n"
                             "fluid { density = 1, viscosity = 0.1, gravity = {0.8, 0} }\n"
                             "term \"continuity\" {}\nterm \"momentum\" {}\n"
                             "boundary { periodic = {\"left\", \"right\"} }\nboundary \"*\" { u = {0, 0} }\n"
                             "solve { coarse_start = true }\noutput { probes = { centre = {0.7, 0.5} } }\n"
                             "results(function(r) return { u = r.last[\"centre.u\"] } end)\n");
    assert_ran(plugflow("run %s/periodic.lua --out %s/periodic", scratch(), scratch()), 0, "coarse grid 7 x 12: ");
    assert_between(summary("periodic", "results.u") - 0.8 / (8 * 0.1), -1e-9, 1e-9);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shipped_cases_are_not_suspected_of_a_wrong_jacobian),
        cmocka_unit_test(the_example_is_not_suspected_of_a_wrong_jacobian),
        cmocka_unit_test(an_iteration_takes_one_evaluation),
        cmocka_unit_test(stokes_flow_is_factored_once),
        cmocka_unit_test(a_coarse_start_changes_the_cost_only),
        cmocka_unit_test(a_coarse_start_is_had_on_all_kinds_of_boxes),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
