/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Bodies that meet, that go through periodic boundaries, that leave; what bodies report. */
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A disk driven through a periodic channel: where it starts makes no difference to how it moves. */
static void periodic_boundaries_are_not_noticed(void **state)
{
    static const char *const start[] = {"0.5", "0", "0.25", "0.9375"};
    double speed[4], spin[4];

    (void)state;
    put_file(
        "round.lua",
        "local x0 = param('x0', 0.5)\nmesh { box = {{0,0},{1,1}}, cells = {16,16} }\n"
        "fluid { density = 1, viscosity = 0.1, gravity = {2,0} }\nterm 'continuity' {}\nterm 'momentum' {}\n"
        "particulate 'conservative'\nboundary { periodic = {'left','right'} }\nboundary '*' { u = {0,0} }\n"
        "particle { shape = disk{radius=0.15}, density = 2, at = {x0,0.4} }\ntime { step = 0.05, stop = 1 }\n"
        "results(function(r) return { x = r.last['p0.x'], u = r.last['p0.u'], w = r.last['p0.omega'] } end)\n");
    for (int k = 0; k < 4; k++) {
        assert_ran(plugflow("run %s/round.lua --quiet --set x0=%s --out %s/round", scratch(), start[k], scratch()),
                   0, NULL);
        speed[k] = summary("round", "results.u");
        spin[k] = summary("round", "results.w");
        assert_between(speed[k] / speed[0] - 1, -1e-10, 1e-10);
        assert_between(spin[k] / spin[0] - 1, -1e-9, 1e-9);
        assert_between(summary("round", "results.x"), 0, 1);
    }
}

/* Forces in particles.csv are those of the step's own equations: with backward Euler rho_P V du/dt = f + rho_P V g
 * and I domega/dt = torque hold to Newton's tolerance, also in the step that takes the body through a periodic
 * boundary; and where it crosses makes no difference. */
static void forces_are_those_of_the_step_that_was_solved(void **state)
{
    static const char *const start[] = {"0.25", "0.9375"}; /* the second one crosses */
    static const char *const name[] = {"u", "v", "omega", "fx", "fy", "torque"};
    const double volume = M_PI * 0.15 * 0.15, inertia = 2 * volume * 0.15 * 0.15 / 2, dt = 0.05;
    double *column[2][6], size[6] = {0};
    int n = 0;

    (void)state;
    put_file("seam.lua",
             "local x0 = param('x0', 0.5)\nmesh { box = {{0,0},{1,1}}, cells = {16,16} }\n"
             "fluid { density = 1, viscosity = 0.1, gravity = {2,0} }\nterm 'continuity' {}\nterm 'momentum' {}\n"
             "particulate 'sharp'\nboundary { periodic = {'left','right'} }\nboundary '*' { u = {0,0} }\n"
             "particle { shape = disk{radius=0.15}, density = 2, at = {x0,0.4} }\n"
             "time { scheme = 'bdf1', step = 0.05, stop = 1 }\nsolve { tolerance = 1e-11 }\n");
    for (int k = 0; k < 2; k++) {
        char file[300];

        assert_ran(
            plugflow("run %s/seam.lua --quiet --set x0=%s --out %s/seam%d", scratch(), start[k], scratch(), k), 0,
            NULL);
        snprintf(file, sizeof file, "%s/seam%d/particles.csv", scratch(), k);
        for (int c = 0; c < 6; c++)
            n = step_column(file, name[c], &column[k][c]);
        assert_int_equal(n, 20);
        for (int i = 0; i < n; i++) {
            const double *u = column[k][0], *w = column[k][2];
            double ax = (u[i] - (i ? u[i - 1] : 0)) / dt, aw = (w[i] - (i ? w[i - 1] : 0)) / dt;

            assert_between(2 * volume * (ax - 2) - column[k][3][i], -1e-9, 1e-9);
            assert_between(inertia * aw - column[k][5][i], -1e-9, 1e-9);
        }
    }
    for (int c = 0; c < 6; c++) {
        for (int i = 0; i < n; i++)
            size[c] = fmax(size[c], fabs(column[0][c][i]));
        if (c == 1 || c == 4) /* across the channel: by the size along it */
            size[c] = size[c - 1];
        for (int i = 0; i < n; i++)
            assert_between((column[1][c][i] - column[0][c][i]) / size[c], -1e-6,
                           1e-6); /* Newton stops at 1e-11, cuts are round-off apart */
        free(column[0][c]);
        free(column[1][c]);
    }
}

/* One disk pushes another through the film between them: the film passes on a force, what one gets the other
 * gives, and the second goes faster than with what the mesh resolves of the film. */
static void lubrication_acts_between_bodies(void **state)
{
    double speed[2];

    (void)state;
    put_file("film.lua",
             "local film = param('film', 1)\nmesh { box = {{0,0},{1,1}}, cells = {16,16} }\n"
             "fluid { density = 1, viscosity = 1 }\nterm 'continuity' {}\n"
             "term 'momentum' { without = {'convection'} }\nparticulate 'conservative'\n"
             "if film == 1 then term 'contact.lubrication' {} end\nboundary '*' { u = {0,0} }\n"
             "particle { shape = disk{radius=0.12}, density = 2, at = {0.36,0.5}, motion = 'prescribed', "
             "velocity = {0.5,0} }\n"
             "particle { shape = disk{radius=0.12}, density = 3, at = {0.64,0.5}, hold = {'y','spin'} }\n"
             "time { step = 0.01, stop = 0.03 }\n");
    for (int film = 0; film < 2; film++) {
        char file[300];
        double *u, *c;
        int n;

        assert_ran(plugflow("run %s/film.lua --quiet --set film=%d --out %s/film", scratch(), film, scratch()), 0,
                   NULL);
        snprintf(file, sizeof file, "%s/film/particles.csv", scratch());
        n = step_column(file, "u", &u);
        assert_int_equal(step_column(file, "contact_x", &c), n);
        speed[film] = u[n - 1];
        assert_true(film ? c[n - 1] > 0.1 : c[n - 1] == 0);
        assert_between(c[n - 1] + c[n - 2], -1e-12, 1e-12);
        free(u);
        free(c);
    }
    assert_true(speed[1] > 1.02 * speed[0] && speed[1] < 0.5);
}

static void a_body_that_leaves_is_told_when_and_where(void **state)
{
    (void)state;
    assert_ran(
        plugflow(
            "run %s --quiet --out %s/leave",
            put_file("leave.lua",
                     "mesh { box = {{0,0},{1,1}}, cells = {8,8} }\nfluid { density = 1, viscosity = 0.1 }\n"
                     "term 'continuity' {}\nterm 'momentum' {}\nparticulate 'conservative'\n"
                     "boundary 'right' { natural = true }\nboundary '*' { u = {1,0} }\n"
                     "particle { shape = disk{radius=0.2}, density = 1, at = {0.5,0.5}, motion = 'prescribed', "
                     "velocity = {1,0} }\ntime { step = 0.1, stop = 2 }\n"),
            scratch()),
        6, "t = 0.7: particle 0 has left the domain: its centre is at (1.2, 0.5)");
}

/* Kinetic energy by hand; what bodies take from the fluid the fluid takes from bodies, every step. */
static void the_log_has_energy_and_balance(void **state)
{
    char file[300], line[4000];
    FILE *f;
    int n = 0;

    (void)state;
    assert_ran(plugflow("run cases/falling_disk.lua --quiet --set formulation=conservative --set n=8 --set "
                        "stop=0.1 --out %s/log",
                        scratch()),
               0, NULL);
    snprintf(file, sizeof file, "%s/log/run.jsonl", scratch());
    f = fopen(file, "r");
    assert_non_null(f);
    while (fgets(line, sizeof line, f)) {
        const char *energy = strstr(line, "\"kinetic_energy\": "), *defect = strstr(line, "\"momentum_defect\": ");

        if (!strstr(line, "\"solve\""))
            continue;
        n++;
        assert_non_null(strstr(line, "\"particles\": 1"));
        assert_true(energy && strtod(energy + 18, NULL) > 0);
        assert_true(defect && strtod(defect + 19, NULL) < 1e-12);
    }
    fclose(f);
    assert_int_equal(n, 10);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(periodic_boundaries_are_not_noticed),
        cmocka_unit_test(forces_are_those_of_the_step_that_was_solved),
        cmocka_unit_test(lubrication_acts_between_bodies),
        cmocka_unit_test(a_body_that_leaves_is_told_when_and_where),
        cmocka_unit_test(the_log_has_energy_and_balance),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
