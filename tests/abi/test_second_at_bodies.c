/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Laplacians and metrics at the points that bodies have: cut cells, inside of bodies, their surfaces.  The terms of
 * laplacians.c vanish there for a T whose Laplacian is known, and the rest of the case has no row of T. */
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

static const char case_text[] =
    "local dim, kind = param('dim', 2, 'dimension'), param('kind', '', 'points')\n"
    "local simplex, curved = param('simplex', false, ''), param('curved', false, '')\n"
    "local off = param('off', 0, 'added to the Laplacian that is expected')\n"
    "local solid, without = dim == 3, {}\n"
    "for _, k in ipairs{'fluid', 'solid', 'surface', 'cells'} do\n"
    "  if k ~= kind then without[#without + 1] = k end\n"
    "end\n"
    "mesh { box = solid and {{0, 0, 0}, {2, 1, 1}} or {{0, 0}, {2, 1}},\n"
    "       cells = solid and {8, 5, 4} or {16, 10},\n"
    "       shape = solid and (simplex and 'tets' or 'hexes') or (simplex and 'triangles' or 'quads'),\n"
    "       map = curved and function(x, y, z)\n"
    "         return x + 0.03 * math.sin(4 * y), y + 0.04 * math.sin(3 * x), z and z + 0.03 * z * math.sin(2 * x)\n"
    "       end or nil }\n"
    "fluid { density = 1, viscosity = 1 }\n"
    "term 'continuity' {}\nterm 'momentum' {}\nparticulate 'sharp'\n"
    "term 'laplacians' { without = without, f = (curved and 0 or solid and 2 or 1) + off,\n"
    "  metric = solid and {64, 100, 64} or {256, 400}, weight = (simplex or curved) and 0 or 1 }\n"
    "boundary '*' { u = solid and {0, 0, 0} or {0, 0} }\ntime { step = 0.1, stop = 1 }\n"
    "particle { shape = solid and sphere { radius = 0.3 } or disk { radius = 0.2 }, density = 2,\n"
    "  motion = 'fixed', at = solid and {0.83, 0.52, 0.48} or {0.83, 0.52} }\n";

/* A linear function on curved cells, whose Laplacian is none but for the curvature; else a quadratic one. */
static double temperature(const double *x, int curved)
{
    double slope = 2 * x[0] - 3 * x[1] + x[2];

    return curved ? slope : slope + 1.5 * x[0] * x[0] - x[1] * x[1] + 0.5 * x[2] * x[2] + 0.7 * x[0] * x[1];
}

/* The largest row of T. */
static double residual(int dim, const char *kind, int simplex, int curved, int off)
{
    char set[5][40];
    const char *sets[5] = {set[0], set[1], set[2], set[3], set[4]};
    double most = 0, *r;
    opened *k;
    problem *p;
    int field;
    error err = {0};

    snprintf(set[0], sizeof set[0], "dim=%d", dim);
    snprintf(set[1], sizeof set[1], "kind=%s", kind);
    snprintf(set[2], sizeof set[2], "simplex=%s", simplex ? "true" : "false");
    snprintf(set[3], sizeof set[3], "curved=%s", curved ? "true" : "false");
    snprintf(set[4], sizeof set[4], "off=%d", off);
    k = open_text(case_text, sets, 5);
    p = &k->p;
    field = space_find_field(&p->space, "T");
    assert_int_equal(problem_initial(p, &err), 0);
    r = calloc((size_t)p->space.n_dof, sizeof *r);
    for (int64_t i = 0; i < p->mesh.n_node; i++) {
        double x[3] = {0};

        memcpy(x, p->mesh.x + i * dim, (size_t)dim * sizeof *x);
        p->state.x[p->space.first[field][i]] = temperature(x, curved);
    }
    if (assembly_run(&p->system.assembly,
                     &(assembly_state){
                         .x = p->state.x, .dot = p->system.step, .old = p->state.x, .bodies = problem_points(p)},
                     r, NULL, 0, &err))
        fail_msg("%s", err.text);
    for (int64_t i = 0; i < p->space.n_dof; i++)
        if (p->space.dof_field[i] == field)
            most = fmax(most, fabs(r[i]));
    free(r);
    close_case(k);
    return most;
}

static void terms_that_know_better_vanish(void **state)
{
    static const char *const kind[] = {"fluid", "solid", "surface", "cells"};

    (void)state;
    for (int dim = 2; dim <= 3; dim++)
        for (int form = 0; form < 4; form++)
            for (int i = 0; i < 4; i++) {
                double none = residual(dim, kind[i], form % 2, form / 2, 0),
                       some = residual(dim, kind[i], form % 2, form / 2, 1);

                print_message("# %dD, %s, %s, %s: %.1e of %.1e\n", dim, form % 2 ? "simplices" : "boxes",
                              form / 2 ? "curved" : "straight", kind[i], none, some);
                assert_true(some > 1e-4 && none < 1e-9 * some);
            }
}

int main(void)
{
    char path[2000];

    snprintf(path, sizeof path, "%s:%s", getenv("PLUGFLOW_PLUGIN_PATH"), getenv("PLUGFLOW_BROKEN_DIR"));
    setenv("PLUGFLOW_PLUGIN_PATH", path, 1);

    const struct CMUnitTest tests[] = {cmocka_unit_test(terms_that_know_better_vanish)};

    return cmocka_run_group_tests(tests, NULL, NULL);
}
