/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The commands as their user sees them. */
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static void help_lists_the_commands(void **state)
{
    (void)state;
    assert_ran(plugflow("--help"), 0, "run", "check", "describe", "picture", "exit codes");
}

static void a_slip_on_the_command_line_is_a_usage_error(void **state)
{
    (void)state;
    assert_ran(plugflow("help run"), 0, "exit codes");
    assert_ran(plugflow("help nonsense"), 2, "unknown command \"nonsense\"");
    assert_ran(plugflow("rnu x"), 2, "did you mean \"run\"?");
    assert_ran(plugflow("run cases/couette.lua --threads 1000"), 2, "expected a whole number up to 256");
    assert_ran(plugflow("run cases/couette.lua --threads 1.5"), 2, "expected a whole number up to 256");
    assert_ran(plugflow("plugins > /dev/full"), 7, "standard output cannot be written");
}

static void plugins_lists_what_is_found_and_where(void **state)
{
    (void)state;
    assert_ran(plugflow("plugins"), 0, "continuity", "momentum", "convection", "solver_umfpack", "looked in:");
}

static void describe_gives_weak_form_parameters_and_source(void **state)
{
    (void)state;
    assert_ran(plugflow("describe momentum.convection"), 0, "\\nabla", "appendix A.7-A.15", "density", "kg/m^3",
               "from fluid{}");
    assert_ran(plugflow("describe momentm"), 5, "did you mean \"momentum\"?");
}

static void test_says_one_line_per_block(void **state)
{
    (void)state;
    assert_ran(plugflow("test momentum"), 0, "convection  d v / d grad_u in 3D: analytic = complex step",
               "passed, 0 failed");
    assert_ran(plugflow("test continuity"), 0, "d q / d div_u in 2D", "passed, 0 failed");
}

static void jacobian_agrees_on_the_real_problem(void **state)
{
    (void)state;
    assert_ran(plugflow("jacobian cases/cavity2d.lua --set n=4"), 0, "ok     d R_u / d u", "d R_p / d p  zero");
    assert_ran(plugflow("jacobian cases/beltrami.lua --set n=2"), 0, "ok     d R_u / d u");
    assert_ran(plugflow("jacobian cases/falling_disk.lua --set formulation=conservative --set n=6"), 0,
               "ok     d R_lambda / d omega", "ok     d R_omega / d lambda");
    assert_ran(plugflow("jacobian cases/falling_disk.lua --set n=6"), 0, "ok     d R_u / d omega",
               "ok     d R_omega / d u");
    assert_ran(plugflow("jacobian cases/fixed_sphere.lua --set formulation=conservative --set n=3"), 0,
               "ok     d R_u / d lambda");
}

static void check_counts_and_predicts_and_writes_nothing(void **state)
{
    (void)state;
    assert_ran(shell("cd %s && %s check $PLUGFLOW_SOURCE/cases/cavity2d.lua --set n=16 && ls", scratch(),
                     getenv("PLUGFLOW_PROGRAM")),
               0, "256 cells", "2467", "Reynolds number", "factors (predicted)");
    assert_true(shell("test -e %s/out", scratch()).code != 0);
}

static void json_goes_to_stdout_and_talk_to_stderr(void **state)
{
    ran r = plugflow("run cases/cavity2d.lua --set n=4 --json --out %s/o", scratch());

    (void)state;
    assert_ran(r, 0, "\"status\": \"ok\"", "newton");
    assert_null(strstr(r.out, "newton  "));
    assert_null(strstr(r.err, "\"status\""));
}

static void a_run_leaves_its_files(void **state)
{
    (void)state;
    assert_ran(plugflow("run cases/cavity2d.lua --set n=4 --out %s/o", scratch()), 0, "newton", "converged in",
               "summary.json");
    assert_ran(shell("cd %s/o && ls -1 . lines && cat units.json run.jsonl case.json", scratch()), 0, "fields.pvd",
               "fields_00000.vtu", "forces.csv", "probes.csv", "run.jsonl", "summary.json", "case.json",
               "vertical.csv", "\"top.fx\": \"N\"", "\"event\": \"solve\"", "\"history\"", "momentum.convection",
               "\"re\": \"100\"");
    assert_true(shell("ls %s/o/*.tmp", scratch()).code != 0);
}

static void an_earlier_run_in_the_folder_leaves_nothing_behind(void **state)
{
    (void)state;
    assert_ran(plugflow("run cases/taylor_green.lua --quiet --set n=4 --set stop=0.1 --out %s/again", scratch()), 0,
               NULL);
    assert_ran(shell("ls %s/again", scratch()), 0, "fields_00001.vtu");
    assert_ran(plugflow("run cases/cavity2d.lua --quiet --set n=4 --out %s/again", scratch()), 0, NULL);
    assert_true(shell("ls %s/again/fields_00001.vtu", scratch()).code != 0);
}

static void a_picture_is_drawn_without_a_display(void **state)
{
    (void)state;
    assert_ran(plugflow("run cases/cavity2d.lua --quiet --set n=8 --out %s/o", scratch()), 0, NULL);
    assert_ran(shell("unset DISPLAY; %s picture %s/o", getenv("PLUGFLOW_PROGRAM"), scratch()), 0, "picture.png");
    assert_ran(shell("head -c 8 %s/o/picture.png | od -An -tx1", scratch()), 0, "89 50 4e 47");
    assert_ran(plugflow("picture %s/o --field p --out %s/p.svg", scratch(), scratch()), 0, "p.svg");
    assert_ran(shell("head -c 200 %s/p.svg", scratch()), 0, "<svg");
    assert_ran(plugflow("picture %s/o --field temperature", scratch()), 2, "temperature");
    assert_ran(plugflow("picture %s/nothing", scratch()), 7, "no such folder");
}

static void a_slice_of_a_3d_field_is_drawn(void **state)
{
    (void)state;
    assert_ran(plugflow("run cases/cavity3d.lua --quiet --set n=3 --out %s/o3", scratch()), 0, NULL);
    assert_ran(plugflow("picture %s/o3 --slice z=0.4 --component x", scratch()), 0, "picture.png");
}

/* SVG has a body as a filled shape. */
static void a_body_is_drawn_in_pictures_and_in_slices(void **state)
{
    (void)state;
    assert_ran(plugflow("run cases/fixed_sphere.lua --quiet --set n=4 --out %s/ball", scratch()), 0, NULL);
    assert_ran(plugflow("picture %s/ball --slice x=0.1 --out %s/ball.svg", scratch(), scratch()), 0, "ball.svg");
    assert_ran(shell("grep -c 'fill:rgb(93%%,93%%,93%%)' %s/ball.svg", scratch()), 0, "1");
    assert_ran(plugflow("picture %s/ball --field p --slice z=0.45 --out %s/above.svg", scratch(), scratch()), 0,
               NULL);
    assert_ran(shell("grep -c 'fill:rgb(93%%,93%%,93%%)' %s/above.svg", scratch()), 1, "0");
    assert_ran(shell("tail -n 3 %s/ball/particles_00000.vtp", scratch()), 0, "</VTKFile>");
}

static void what_a_picture_cannot_do_is_a_usage_error(void **state)
{
    (void)state;
    assert_ran(plugflow("run cases/cavity2d.lua --quiet --set n=4 --out %s/plain", scratch()), 0, NULL);
    assert_ran(plugflow("picture %s/plain --slice z=0.5", scratch()), 2, "two dimensions", "leave out the slice");
    assert_ran(plugflow("picture %s/plain --width 100000", scratch()), 2, "100000", "200 to 10000");
    assert_ran(plugflow("picture %s/plain --width 150", scratch()), 2, "150", "200 to 10000");
    assert_ran(plugflow("picture %s/plain --set n=4", scratch()), 2, "takes no --set", "--field", "plugflow run");
    assert_ran(plugflow("picture %s/plain --slice z=half", scratch()), 2, "--slice z=half", "z=0.5");
    assert_ran(plugflow("picture %s/plain --slice ''", scratch()), 2, "expected x, y or z");
    assert_true(shell("test -e %s/plain/picture.png", scratch()).code != 0);
}

static void a_signal_ends_the_run_after_its_step(void **state)
{
    ran r = shell(
        "timeout -s INT 4 %s run cases/taylor_green.lua --set n=24 --set dt=0.001 --set stop=1000 --out %s/long",
        getenv("PLUGFLOW_PROGRAM"), scratch());

    (void)state;
    assert_true(r.code == 124 || r.code == 130); /* timeout's own code, or ours */
    assert_ran(shell("cat %s/long/summary.json", scratch()), 0, "\"status\": \"interrupted\"");
    assert_between(summary("long", "steps"), 0, 1e6);
}

static void the_example_outside_the_tree_builds_tests_and_runs(void **state)
{
    const char *build = getenv("PLUGFLOW_BUILD");

    (void)state;
    assert_ran(shell("PKG_CONFIG_PATH=%s/meson-uninstalled; export PKG_CONFIG_PATH; "
                     "cc -std=gnu11 -O2 -Wall -Wextra -Werror -fPIC -shared $(pkg-config --cflags plugflow) "
                     "examples/scalar_transport/scalar_transport.c -o %s/scalar_transport.so",
                     build, scratch()),
               0, NULL);
    assert_ran(plugflow("test %s/scalar_transport.so", scratch()), 0, "advection", "passed, 0 failed");
    assert_ran(plugflow("run examples/scalar_transport/heated_cavity.lua --quiet --set n=24 --plugin "
                        "%s/scalar_transport.so --out %s/hot",
                        scratch(), scratch()),
               0, NULL);
    /* de Vahl Davis 1983, Ra = 1e4: mean Nusselt number 2.243 */
    assert_between(summary("hot", "results.nu"), 2.243 * 0.995, 2.243 * 1.005);
    assert_ran(
        plugflow("jacobian examples/scalar_transport/heated_cavity.lua --set n=4 --plugin %s/scalar_transport.so",
                 scratch()),
        0, "ok     d R_T / d u", "ok     d R_u / d T");
    assert_ran(plugflow("run examples/scalar_transport/carried_profile.lua --quiet --plugin %s/scalar_transport.so "
                        "--out %s/carried",
                        scratch(), scratch()),
               0, NULL);
    assert_between(summary("carried", "errors.T.l2"), 2.5e-4, 2.9e-4); /* 1.3e-3 without the streamline term */
}

static void a_misspelt_command_or_option_is_a_usage_error(void **state)
{
    (void)state;
    assert_ran(plugflow("rum cases/cavity2d.lua"), 2, "did you mean \"run\"?");
    assert_ran(plugflow("run cases/cavity2d.lua --thread 2"), 2, "unknown option --thread");
    assert_ran(plugflow("run"), 2, "usage: plugflow run CASE");
    assert_ran(plugflow("run cases/cavity2d.lua --threads none"), 2, "expected a number");
    assert_ran(plugflow("run cases/cavity2d.lua --set n"), 2, "NAME=VALUE");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(help_lists_the_commands),
        cmocka_unit_test(a_slip_on_the_command_line_is_a_usage_error),
        cmocka_unit_test(plugins_lists_what_is_found_and_where),
        cmocka_unit_test(describe_gives_weak_form_parameters_and_source),
        cmocka_unit_test(test_says_one_line_per_block),
        cmocka_unit_test(jacobian_agrees_on_the_real_problem),
        cmocka_unit_test(check_counts_and_predicts_and_writes_nothing),
        cmocka_unit_test(json_goes_to_stdout_and_talk_to_stderr),
        cmocka_unit_test(a_run_leaves_its_files),
        cmocka_unit_test(an_earlier_run_in_the_folder_leaves_nothing_behind),
        cmocka_unit_test(a_picture_is_drawn_without_a_display),
        cmocka_unit_test(a_slice_of_a_3d_field_is_drawn),
        cmocka_unit_test(a_body_is_drawn_in_pictures_and_in_slices),
        cmocka_unit_test(what_a_picture_cannot_do_is_a_usage_error),
        cmocka_unit_test(a_signal_ends_the_run_after_its_step),
        cmocka_unit_test(the_example_outside_the_tree_builds_tests_and_runs),
        cmocka_unit_test(a_misspelt_command_or_option_is_a_usage_error),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
