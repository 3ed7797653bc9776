/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Newton's method on small systems: what it costs, its way to the solution, constants that are free, and what
 * residuals are measured against. */
#include "support/small_system.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <string.h>

static small_system f;
static const newton_options tight = {.tolerance = 1e-11, .max_iterations = 25};

static int teardown(void **state)
{
    (void)state;
    small_destroy(&f);
    return 0;
}

/* --- cost --- */

static void an_iteration_takes_one_evaluation(void **state)
{
    (void)state;
    SMALL_MAKE(&f, NULL, 0, "a", &small_cubic);
    small_set(&f, 3);
    assert_int_equal(small_solve(&f, &tight), 0);
    assert_true(f.report.converged && f.report.order > 1.7);
    assert_field(&f, "a", 1);
    assert_int_equal(f.report.matrices, f.report.iterations);
    assert_true(f.report.evaluations <= f.report.iterations + 3); /* the first, the last correction, one to spare */
    assert_int_equal(f.sys.linear.stats.factorisations, f.report.iterations);
    assert_int_equal(f.sys.evaluations, f.report.evaluations);
}

static void a_linear_problem_is_factored_once(void **state)
{
    (void)state;
    SMALL_MAKE(&f, NULL, PF_LINEAR, "a", &small_plain);
    assert_int_equal(small_solve(&f, &tight), 0);
    assert_true(f.report.converged);
    assert_int_equal(f.report.matrices, 1);
    assert_int_equal(f.sys.linear.stats.factorisations, 1);
    f.sys.linear.stats.cost.flops =
        100 * f.sys.linear.stats.cost.fill; /* so that old factors may not pay for long */
    for (int k = 0; k < 200; k++) {
        small_set(&f, k);
        assert_int_equal(
            small_solve(&f, &(newton_options){.tolerance = 1e-11, .max_iterations = 25, .linear_tolerance = 1e-6}),
            0);
        assert_true(f.report.converged);
        assert_int_equal(f.report.matrices, 1);
    }
    assert_int_equal(f.sys.linear.stats.factorisations, 1);
}

static void a_false_flag_linear_costs_no_more_than_time(void **state)
{
    (void)state;
    SMALL_MAKE(&f, NULL, PF_LINEAR, "a", &small_cubic);
    small_set(&f, 3);
    assert_int_equal(small_solve(&f, &tight), 0);
    assert_true(f.report.converged);
    assert_field(&f, "a", 1);
    assert_true(f.report.iterations < 12);
}

/* --- linear systems solved as far as it serves --- */

static const newton_options inexact = {.tolerance = 1e-11, .max_iterations = 25, .linear_tolerance = 0.1};

/* A different value at each place, so that no two matrices are multiples of each other. */
static void set_unequal(double about)
{
    for (int64_t d = 0; d < f.s.n_dof; d++)
        f.x[d] = about + 0.1 * (double)d;
}

/* Factors of one matrix that are dear enough to be kept for good. */
static void make_with_factors(double wrong)
{
    SMALL_MAKE(&f, NULL, 0, "a", &small_cubic);
    f.number[0].wrong = wrong;
    small_set(&f, 1.1);
    assert_int_equal(small_solve(&f, &inexact), 0);
    f.sys.linear.stats.cost.flops = 1e9 * f.sys.linear.stats.cost.fill;
    f.sys.linear.stats.factorisations = 0;
    f.sys.linear.max_iterations = 12;
}

static void old_factors_lead_to_the_same_solution(void **state)
{
    (void)state;
    make_with_factors(1);
    set_unequal(1);
    assert_int_equal(small_solve(&f, &inexact), 0);
    assert_true(f.report.converged && !f.report.linear_only);
    assert_field(&f, "a", 1);
    assert_int_equal(f.sys.linear.stats.factorisations, 0);
    assert_true(f.sys.linear.stats.gmres_iterations > f.report.iterations);
    assert_true(f.report.order == 0 || f.report.order > 1.7);
}

static void a_wrong_jacobian_is_told_with_old_factors(void **state)
{
    static const double wrong[] = {1, 0.8, 1.3};

    (void)state;
    for (int i = 0; i < 3; i++) {
        if (i)
            small_destroy(&f);
        make_with_factors(wrong[i]);
        set_unequal(2);
        assert_int_equal(small_solve(&f, &inexact), 0);
        assert_true(f.report.converged);
        if (f.report.linear_only != (wrong[i] != 1))
            fail_msg("Jacobian times %g: order %g, linear_only %d", wrong[i], f.report.order, f.report.linear_only);
    }
}

static void linear_solutions_leave_a_part_of_what_the_step_leaves(void **state)
{
    newton_report r = {.history = {1, 1e-1, 1e-3, 1e-7, 1e-9}};
    const double length[] = {1, 1, 1, 0.5};
    newton_options o = {.linear_tolerance = 0.1};

    (void)state;
    SMALL_MAKE(&f, NULL, 0, "a", &small_cubic);
    assert_near(forcing(&f.sys, &o, &r, length, 1e-11, 0), 0.05, 1e-15); /* nothing is known */
    f.sys.last_fall = 1e-2;
    assert_near(forcing(&f.sys, &o, &r, length, 1e-11, 0), 5e-4, 1e-15);
    assert_near(forcing(&f.sys, &o, &r, length, 1, 0), 3e-3, 1e-15); /* enough */
    assert_near(forcing(&f.sys, &o, &r, length, 1e-11, 1), 1e-2, 1e-15);
    assert_near(forcing(&f.sys, &o, &r, length, 1e-11, 2), 5e-6, 1e-15); /* 0.05 (1e-2)^2 */
    assert_near(forcing(&f.sys, &o, &r, length, 1e-9, 3), 3e-5, 1e-15);  /* enough */
    assert_near(forcing(&f.sys, &o, &r, length, 1e-14, 3), 1e-6, 1e-15); /* the least */
    assert_near(forcing(&f.sys, &o, &r, length, 1e-14, 4), 0.05, 1e-15); /* after half a step */
    o.linear_tolerance = 1e-8;
    assert_near(forcing(&f.sys, &o, &r, length, 1e-11, 1), 1e-8, 1e-15);
    o.linear_tolerance = 0;
    assert_near(forcing(&f.sys, &o, &r, length, 1e-11, 1), 0, 0);
}

/* --- the way to the solution --- */

static void a_step_too_far_is_shortened(void **state)
{
    (void)state;
    SMALL_MAKE(&f, NULL, 0, "a", &small_arctangent);
    small_set(&f, 3); /* whole steps diverge from 1.39 on */
    assert_int_equal(small_solve(&f, &tight), 0);
    assert_true(f.report.converged);
    assert_field(&f, "a", 0);
}

/* b follows a, and its residual grows before it can fall: from 0 to c |a|, with every step of a. */
static void a_field_that_nothing_depends_on_does_not_veto_a_step(void **state)
{
    (void)state;
    SMALL_MAKE(&f, NULL, 0, "ab", &small_plain, &small_follower);
    f.number[1].c = 100;
    assert_int_equal(small_solve(&f, &tight), 0);
    if (!f.report.converged)
        fail_msg("%s", f.report.why);
    assert_field(&f, "a", 1);
    assert_field(&f, "b", 100);
}

/* ... nor does it let pass a step that is too far for those that it depends on. */
static void a_field_that_nothing_depends_on_does_not_carry_a_step(void **state)
{
    (void)state;
    SMALL_MAKE(&f, NULL, 0, "ab", &small_arctangent, &small_follower);
    small_set(&f, 3);
    assert_int_equal(small_solve(&f, &tight), 0);
    assert_true(f.report.converged);
    assert_field(&f, "a", 0);
    assert_field(&f, "b", 0);
}

static void order_one_gives_a_wrong_jacobian_away(void **state)
{
    static const double wrong[] = {1, 0.8, 1.3, 1.02, 1};

    (void)state;
    for (int i = 0; i < 5; i++) {
        if (i)
            small_destroy(&f);
        SMALL_MAKE(&f, NULL, 0, "a", &small_cubic);
        f.number[0].wrong = wrong[i];
        small_set(&f, 3);
        assert_int_equal(small_solve(&f, &tight), 0);
        assert_true(f.report.converged);
        if (f.report.linear_only != (wrong[i] != 1))
            fail_msg("Jacobian times %g: order %g, linear_only %d", wrong[i], f.report.order, f.report.linear_only);
    }
}

/* --- constants that are free --- */

static double mean_of(const double *weight)
{
    double sum = 0, volume = 0;

    for (int64_t d = 0; d < f.s.n_dof; d++) {
        sum += (weight ? weight[d] : 1) * f.x[d];
        volume += weight ? weight[d] : 1;
    }
    return sum / volume;
}

/* A reaction holds the constant, lets it go, and holds it again. */
static void a_constant_is_found_free_whenever_it_is(void **state)
{
    static const double reaction[] = {1, 0, 2, 0};

    (void)state;
    SMALL_MAKE(&f, NULL, 0, "a", &small_enclosed);
    for (int i = 0; i < 4; i++) {
        f.number[0].c = reaction[i];
        assert_int_equal(small_solve(&f, &tight), 0);
        if (!f.report.converged)
            fail_msg("reaction %g: %s", reaction[i], f.report.why);
        assert_int_equal(f.sys.gauge.free[0], reaction[i] == 0);
        assert_near(f.sys.gauge.defect[0], reaction[i] == 0 ? -0.5 : 0, 1e-12); /* int of x */
        assert_near(f.sys.gauge.volume, i ? 1 : 0, 1e-12);
    }
    gauge_zero_mean(&f.sys, NULL, f.x);
    assert_near(mean_of(f.sys.gauge.whole[0]), 0, 1e-12);
}

/* Free at the first matrix, a = 0, but not at the solution. */
static void a_constant_that_is_free_at_the_start_only_is_held(void **state)
{
    double sum = 0;

    (void)state;
    SMALL_MAKE(&f, NULL, 0, "a", &small_released);
    assert_int_equal(small_solve(&f, &tight), 0);
    if (!f.report.converged)
        fail_msg("%s", f.report.why);
    assert_int_equal(f.sys.gauge.free[0], 0);
    assert_int_equal(newton_residual(&f.sys, &(newton_time){0}, f.x, f.sys.rhs, &f.err), 0);
    for (int64_t d = 0; d < f.s.n_dof; d++)
        sum += f.sys.rhs[d];
    assert_near(sum, 0, 1e-8); /* int of a - tanh a - 1000 x, of which nothing was taken out */
}

/* With bodies the mean is that over the fluid. */
static void the_mean_is_taken_over_the_fluid(void **state)
{
    double weight[100];

    (void)state;
    SMALL_MAKE(&f, NULL, 0, "a", &small_enclosed);
    f.number[0].c = 0;
    for (int64_t d = 0; d < f.s.n_dof; d++) /* of the left half, as it were */
        weight[d] = f.m.x[2 * f.s.dof_node[d]] < 0.5 ? 1.0 / 8 : 0;
    assert_int_equal(small_solve(&f, &tight), 0);
    assert_true(f.report.converged && f.sys.gauge.free[0]);
    gauge_zero_mean(&f.sys, &(body_points){.integral = {weight}}, f.x);
    assert_near(mean_of(weight), 0, 1e-12);
    assert_true(fabs(mean_of(NULL)) > 0.01);
    gauge_zero_mean(&f.sys, NULL, f.x);
    assert_near(mean_of(NULL), 0, 1e-12);
}

/* --- what a residual is measured against --- */

/* Rows that are off are identities, whatever the units of the equations; they do not count. */
static void unknowns_that_are_off_do_not_change_the_measure(void **state)
{
    double on;

    (void)state;
    SMALL_MAKE(&f, NULL, 0, "a", &small_plain);
    f.number[0].c = 1e-6;
    small_set(&f, 1e6);
    f.x[3] *= 1 + 1e-3;
    assert_int_equal(small_solve(&f, &tight), 0);
    on = f.report.history[0];
    assert_true(on > 1e-5 && on < 1e-2);
    small_set(&f, 1e6);
    f.x[3] *= 1 + 1e-3;
    for (int64_t d = 8; d < f.s.n_dof; d++) {
        f.sys.assembly.none_idle[d] = 1; /* as a body would have it */
        f.x[d] = 0;
    }
    f.x[7] = f.x[6] = f.x[5] = 1e6;
    assert_int_equal(small_solve(&f, &tight), 0);
    if (f.report.history[0] < 0.5 * on)
        fail_msg("scaled residual %g, with half of the unknowns off %g", on, f.report.history[0]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(an_iteration_takes_one_evaluation, teardown),
        cmocka_unit_test_teardown(a_linear_problem_is_factored_once, teardown),
        cmocka_unit_test_teardown(a_false_flag_linear_costs_no_more_than_time, teardown),
        cmocka_unit_test_teardown(old_factors_lead_to_the_same_solution, teardown),
        cmocka_unit_test_teardown(a_wrong_jacobian_is_told_with_old_factors, teardown),
        cmocka_unit_test_teardown(linear_solutions_leave_a_part_of_what_the_step_leaves, teardown),
        cmocka_unit_test_teardown(a_step_too_far_is_shortened, teardown),
        cmocka_unit_test_teardown(a_field_that_nothing_depends_on_does_not_veto_a_step, teardown),
        cmocka_unit_test_teardown(a_field_that_nothing_depends_on_does_not_carry_a_step, teardown),
        cmocka_unit_test_teardown(order_one_gives_a_wrong_jacobian_away, teardown),
        cmocka_unit_test_teardown(a_constant_is_found_free_whenever_it_is, teardown),
        cmocka_unit_test_teardown(a_constant_that_is_free_at_the_start_only_is_held, teardown),
        cmocka_unit_test_teardown(the_mean_is_taken_over_the_fluid, teardown),
        cmocka_unit_test_teardown(unknowns_that_are_off_do_not_change_the_measure, teardown),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
