/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Tables inside of bodies: u is the body's motion, p is empty, the column `body` says whose.  Fields are written at
 * multiples of `every`; what is doubtful is told everywhere. */
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { STEPS = 6 };

/* A disk of 3.9 cells that moves by 0.1 and turns by 2; steps of 0.05 and the times of the fields. */
static const double times[STEPS] = {0.05, 0.07, 0.1, 0.14, 0.15, 0.17};

static int run_disk(void **state)
{
    (void)state;
    put_file("disk.lua",
             "mesh { box = {{0,0},{2,1}}, cells = {20,10} }\nfluid { density = 1, viscosity = 0.1 }\n"
             "term 'continuity' {}\nterm 'momentum' {}\nparticulate(param('formulation', 'sharp'))\n"
             "boundary 'left' { u = function(x, y) return 4*y*(1-y), 0 end }\nboundary 'right' { natural = true }\n"
             "boundary '*' { u = {0,0} }\nparticle { shape = disk{radius=0.195}, density = 1, at = {0.55,0.5}, "
             "motion = 'prescribed', velocity = {0.1,0}, spin = 2 }\ntime { step = 0.05, stop = 0.17 }\n"
             "output { every = 0.07, probes = { inner = {0.6,0.45}, outer = {1.5,0.5}, cut = {0.78,0.45} },\n"
             "  lines = { mid = { from = {0,0.45}, to = {2,0.45}, points = 21 }, cut = { from = {0.77,0.45}, to = "
             "{0.79,0.45}, points = 3 } } }\n");
    for (int k = 0; k < 2; k++) {
        const char *name = k ? "conservative" : "sharp";

        if (plugflow("run %s/disk.lua --quiet --set formulation=%s --out %s/%s", scratch(), name, scratch(), name)
                .code)
            return -1;
    }
    return 0;
}

/* Columns of a table; *n: rows. */
static void read_columns(const char *file, const char *const *name, int n_name, double **v, int *n)
{
    for (int c = 0; c < n_name; c++) {
        int rows = csv_column(file, name[c], &v[c]);

        if (c == 0)
            *n = rows;
        assert_int_equal(rows, *n);
    }
}

static void a_probe_in_a_body_has_its_motion_and_no_pressure(void **state)
{
    static const char *const name[] = {"t",       "inner.u", "inner.v",    "inner.p",
                                       "outer.p", "outer.u", "inner.body", "outer.body"};
    char file[300];
    double *v[8];
    int n;

    (void)state;
    for (int k = 0; k < 2; k++) {
        snprintf(file, sizeof file, "%s/%s/probes.csv", scratch(), k ? "conservative" : "sharp");
        read_columns(file, name, 8, v, &n);
        assert_int_equal(n, STEPS + 1); /* the first row is of the start */
        for (int i = 0; i < n; i++) {
            double t = i ? times[i - 1] : 0;

            assert_between(v[0][i] - t, -1e-12, 1e-12);
            assert_between(v[1][i] - (0.1 + 2 * 0.05), -1e-12, 1e-12);
            assert_between(v[2][i] - 2 * (0.6 - 0.55 - 0.1 * t), -1e-12, 1e-12);
            assert_true(isnan(v[3][i]) && isfinite(v[4][i]) && (i == 0 || v[5][i] > 0.5));
            assert_true(v[6][i] == 0 && v[7][i] == -1);
        }
        for (int c = 0; c < 8; c++)
            free(v[c]);
    }
}

static void a_line_through_a_body_has_its_motion_and_no_pressure(void **state)
{
    static const char *const name[] = {"x", "u", "v", "p", "body"};
    char file[300];
    double *v[5];
    int n, inside = 0;

    (void)state;
    snprintf(file, sizeof file, "%s/sharp/lines/mid.csv", scratch());
    read_columns(file, name, 5, v, &n);
    assert_int_equal(n, 21);
    for (int i = 0; i < n; i++) {
        double x = v[0][i], r = x - 0.55 - 0.1 * 0.17;
        int is_inside = r * r + 0.05 * 0.05 < 0.195 * 0.195;

        inside += is_inside;
        assert_true(v[4][i] == (is_inside ? 0 : -1) && isnan(v[3][i]) == is_inside);
        if (!is_inside)
            continue;
        assert_between(v[1][i] - 0.2, -1e-12, 1e-12);
        assert_between(v[2][i] - 2 * r, -1e-12, 1e-12);
    }
    assert_int_equal(inside, 4);
    for (int c = 0; c < 5; c++)
        free(v[c]);
}

/* In the part of a cell that the surface leaves to the fluid, a line has what a probe has. */
static void lines_and_probes_agree_in_cut_cells(void **state)
{
    static const char *const name[] = {"u", "v", "p"}, *const probe[] = {"cut.u", "cut.v", "cut.p"};
    char file[300];

    (void)state;
    for (int c = 0; c < 3; c++) {
        double *line, *at;

        snprintf(file, sizeof file, "%s/sharp/lines/cut.csv", scratch());
        assert_int_equal(csv_column(file, name[c], &line), 3);
        snprintf(file, sizeof file, "%s/sharp/probes.csv", scratch());
        assert_int_equal(csv_column(file, probe[c], &at), STEPS + 1);
        assert_true(isfinite(line[1]));
        assert_between(line[1] - at[STEPS], -1e-13, 1e-13);
        free(line);
        free(at);
    }
}

static void fields_are_written_at_multiples_of_every(void **state)
{
    (void)state;
    assert_ran(shell("cat %s/sharp/fields.pvd", scratch()), 0, "timestep=\"0\"", "timestep=\"0.07\"",
               "timestep=\"0.14\"", "timestep=\"0.17\"");
}

static void a_warning_is_on_stderr_in_the_log_and_in_the_summary(void **state)
{
    (void)state;
    assert_ran(shell("cp %s/disk.lua '%s/100%%s%%n.lua'", scratch(), scratch()), 0, NULL);
    assert_ran(plugflow("run '%s/100%%s%%n.lua' --quiet --out %s/percent", scratch(), scratch()), 0, "3.9 cells");
    assert_ran(plugflow("run %s/disk.lua --quiet --out %s/again", scratch(), scratch()), 0,
               "warning: particle 0 (line 9) is 0.39 wide, 3.9 cells");
    assert_ran(shell("grep '\"warning\"' %s/again/run.jsonl", scratch()), 0,
               "particle 0 (line 9) is 0.39 wide, 3.9 cells");
    assert_ran(shell("grep '\"warnings\"' %s/again/summary.json", scratch()), 0,
               "particle 0 (line 9) is 0.39 wide, 3.9 cells");
    assert_ran(plugflow("check %s/disk.lua", scratch()), 0, "warning: particle 0 (line 9) is 0.39 wide, 3.9 cells");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_probe_in_a_body_has_its_motion_and_no_pressure),
        cmocka_unit_test(a_line_through_a_body_has_its_motion_and_no_pressure),
        cmocka_unit_test(lines_and_probes_agree_in_cut_cells),
        cmocka_unit_test(fields_are_written_at_multiples_of_every),
        cmocka_unit_test(a_warning_is_on_stderr_in_the_log_and_in_the_summary),
    };

    return cmocka_run_group_tests(tests, run_disk, NULL);
}
