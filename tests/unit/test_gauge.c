/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Which constants are free: with bodies wherever they stand and however few cells they have, the level of the
 * pressure of an enclosed flow is, and never with an opening or with an exchange at the body, however weak. */
#include "support/opened.h"
#include "support/small_system.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The matrix at rest, of a case with these lines; whether p is free there. */
static int pressure_is_free(const char *lines, gauge *found)
{
    char text[2000];
    opened *c;
    problem *p;
    error err = {0};
    double *zero;
    int changed, f;

    snprintf(text, sizeof text,
             "fluid { density = 1, viscosity = 1 }\nterm 'continuity' {}\nterm 'momentum' {}\nparticulate 'sharp'\n"
             "boundary '*' { u = {0, 0, 0} }\n%s",
             lines);
    c = open_text(text, NULL, 0);
    p = &c->p;
    f = space_find_field(&p->space, "p");
    zero = calloc((size_t)p->space.n_dof, sizeof *zero);
    assert_non_null(zero);
    if (problem_initial(p, &err) ||
        system_evaluate(&p->system, &(newton_time){.bodies = problem_points(p)}, zero, 1, 0, &err) ||
        gauge_detect(&p->system, &changed, &err))
        fail_msg("%s", err.text);
    *found = p->system.gauge;
    free(zero);
    close_case(c);
    return found->free[f];
}

static const char ball[] = "mesh { box = {{0, 0, 0}, {1, 1, 1}}, cells = {%d, %d, %d}, shape = '%s' }\n%s"
                           "particle { shape = sphere { radius = %g }, density = 1, at = {%g, %g, %g} }\n";

/* A sphere at a place of its own, of 1.6 to 3.2 cells across. */
static int with_ball(int k, const char *shape, const char *boundary, gauge *found)
{
    char lines[1000];
    const double r = 0.2 + 0.05 * (k % 5), wobble = 0.09 * sin(2.7 * k);

    snprintf(lines, sizeof lines, ball, 4, 4, 4, shape, boundary, r, 0.5 + wobble, 0.5 - 0.7 * wobble,
             0.5 + 0.3 * wobble);
    return pressure_is_free(lines, found);
}

static void level_of_an_enclosed_flow_is_free_round_coarse_bodies(void **state)
{
    (void)state;
    for (int k = 0; k < 12; k++) {
        gauge found;
        const char *shape = k % 2 ? "tets" : "hexes";

        if (!with_ball(k, shape, "", &found) || !found.approximate || found.doubt[1] > 0)
            fail_msg("place %d, %s: the pressure is not found free", k, shape);
    }
}

static void level_is_held_by_an_opening(void **state)
{
    static const char *const boundary[] = {"boundary 'left' { natural = true }\n",
                                           "boundary 'top' { pressure = 0 }\n"};

    (void)state;
    for (int k = 0; k < 12; k++) {
        gauge found;
        const char *shape = k / 2 % 2 ? "tets" : "hexes";

        if (with_ball(k, shape, boundary[k % 2], &found))
            fail_msg("place %d, %s: the pressure is taken for free", k, shape);
    }
}

/* A reaction of the field with itself counts, however weak, also where cells are cut. */
static void weak_reaction_holds_the_level(void **state)
{
    small_system f;

    (void)state;
    for (int k = 0; k < 4; k++) {
        int changed;

        SMALL_MAKE(&f, NULL, 0, "a", &small_enclosed);
        f.number[0].c = k == 0 ? 0 : pow(10, -2 * k);
        f.sys.gauge.sharp = 1;
        assert_int_equal(system_evaluate(&f.sys, &(newton_time){0}, f.x, 1, 0, &f.err), 0);
        assert_int_equal(gauge_detect(&f.sys, &changed, &f.err), 0);
        assert_int_equal(f.sys.gauge.free[0], k == 0);
        assert_true(!f.sys.gauge.approximate && f.sys.gauge.doubt[0] == 0);
        small_destroy(&f);
    }
}

/* Near cut cells a constant is free only nearly.  An iteration leaves the same value at zero as a factorisation;
 * their solutions differ by no more than the tolerance then, though |G 1| is not round-off. */
static void iterations_hold_the_value_that_factors_hold(void **state)
{
    static const char *const solver[] = {"umfpack", "block"};
    double *x[2], size = 0;
    int64_t n = 0, pin = 0;
    error err = {0};

    (void)state;
    for (int k = 0; k < 2; k++) {
        char text[1000];
        opened *c;
        newton_system *sys;
        int changed, f;

        snprintf(
            text, sizeof text,
            "fluid { density = 1, viscosity = 1 }\nterm 'continuity' {}\nterm 'momentum' {}\nparticulate 'sharp'\n"
            "mesh { box = {{0, 0}, {1, 1}}, cells = {12, 12} }\nboundary '*' { u = {0, 0} }\n"
            "particle { shape = disk { radius = 0.2 }, density = 2, at = {0.47, 0.53} }\n"
            "time { step = 0.01, stop = 1 }\nsolve { solver = '%s' }\n",
            solver[k]);
        c = open_text(text, NULL, 0);
        sys = &c->p.system;
        f = space_find_field(&c->p.space, "p");
        n = c->p.space.n_free;
        x[k] = calloc((size_t)n, sizeof *x[k]);
        assert_non_null(x[k]);
        fill_random(c->p.state.x, c->p.space.n_dof, 3);
        if (problem_initial(&c->p, &err) ||
            system_evaluate(sys, &(newton_time){.bodies = problem_points(&c->p), .dt = 0.01, .shift = 100},
                            c->p.state.x, 1, 0, &err) ||
            gauge_detect(sys, &changed, &err) || gauge_tell(sys, &err))
            fail_msg("%s", err.text);
        assert_true(sys->gauge.free[f] && sys->gauge.approximate);
        pin = sys->gauge.pin[f];
        fill_random(sys->rhs, n, 7);
        for (int64_t i = 0; i < n; i++)
            sys->rhs[i] = sys->linear.rows.idle[i] ? 0 : sys->rhs[i];
        unknowns_project(&sys->linear.rows, &c->p.space, sys->rhs);
        assert_int_equal(linear_solve(&sys->linear, sys->rhs, x[k], 1e-10, &err), 0);
        assert_true(x[k][pin] == 0);
        close_case(c);
    }
    for (int64_t i = 0; i < n; i++)
        size = fmax(size, fabs(x[0][i]));
    for (int64_t i = 0; i < n; i++)
        assert_true(fabs(x[1][i] - x[0][i]) < 1e-5 * size);
    free(x[0]);
    free(x[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(level_of_an_enclosed_flow_is_free_round_coarse_bodies),
        cmocka_unit_test(level_is_held_by_an_opening),
        cmocka_unit_test(weak_reaction_holds_the_level),
        cmocka_unit_test(iterations_hold_the_value_that_factors_hold),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
