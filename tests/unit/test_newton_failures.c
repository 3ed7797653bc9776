/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What Newton's method says when numbers are none, when a linear solver returns rubbish, and when the equations
 * leave unknowns open.  None of it is success. */
#include "solve/vector.h"
#include "support/small_system.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <string.h>

static small_system f;
static registry plugins;
static const pf_solver *sound; /* UMFPACK */
static const newton_options tight = {.tolerance = 1e-11, .max_iterations = 25};

static int teardown(void **state)
{
    (void)state;
    small_destroy(&f);
    return 0;
}

/* --- numbers that are none --- */

/* The other field is solved as it stands, and a largest norm taken with < may be that of either. */
static void a_nan_in_one_field_is_no_convergence(void **state)
{
    (void)state;
    for (int in_b = 0; in_b < 2; in_b++) {
        if (in_b)
            small_destroy(&f);
        SMALL_MAKE(&f, NULL, 0, "ab", in_b ? &small_zero : &small_nan_a, in_b ? &small_nan_b : &small_zero_b);
        assert_int_equal(small_solve(&f, &tight), ERR_PLUGIN);
        assert_false(f.report.converged);
        assert_said(f.err.text, "term test.nan_output: output \"s\" is nan at x = (");
    }
}

static void a_nan_in_a_jacobian_is_no_convergence(void **state)
{
    (void)state;
    SMALL_MAKE(&f, NULL, 0, "ab", &small_cubic, &small_nan_jacobian);
    assert_int_equal(small_solve(&f, &tight), ERR_PLUGIN);
    assert_false(f.report.converged);
    assert_said(f.err.text, "term test.zero: derivative of \"s\" by \"b\" is nan at x = (");
}

static void a_nan_beside_a_residual_of_zero_is_no_convergence(void **state)
{
    (void)state;
    SMALL_MAKE(&f, NULL, 0, "ab", &small_zero, &small_nan_jacobian);
    assert_int_equal(small_solve(&f, &tight), ERR_PLUGIN);
    assert_false(f.report.converged);
    assert_said(f.err.text, "derivative of \"s\" by \"b\" is nan");
}

static void a_value_that_is_nan_is_told(void **state)
{
    (void)state;
    SMALL_MAKE(&f, NULL, 0, "a", &small_cubic);
    f.x[5] = NAN;
    assert_int_equal(small_solve(&f, &tight), ERR_PLUGIN);
    assert_said(f.err.text, "output \"s\" is nan");
    small_set(&f, 1e200);
    assert_true(small_solve(&f, &tight) != 0);
    assert_said(f.err.text, "inf");
    small_set(&f, 1e60); /* finite, its square is not */
    assert_int_equal(small_solve(&f, &tight), ERR_CONVERGE);
    assert_said(f.err.text, "too large");
}

/* Every step leads to where there is no residual: the message says whose. */
static void a_nan_ahead_is_told(void **state)
{
    (void)state;
    SMALL_MAKE(&f, NULL, 0, "a", &small_root);
    small_set(&f, 1e-9);
    assert_int_equal(small_solve(&f, &tight), 0);
    assert_false(f.report.converged);
    assert_said(f.report.why, "term test.root: output \"s\" is ");
}

/* --- solvers that fail --- */

static struct {
    enum { ZEROS, FIRST_ONLY, NANS, SOUND } how;
    int n_solve, nan_from; /* not 0: that solve and later ones return NaN */
    int64_t n;
} faulty;

static int faulty_create(void **self, int n_thread, char *err, size_t n)
{
    return sound->create(self, n_thread, err, n);
}

static int faulty_analyze(void *self, const pf_csr *a, pf_solver_cost *cost, char *err, size_t n)
{
    faulty.n = a->n;
    return sound->analyze(self, a, cost, err, n);
}

static int faulty_setup(void *self, const pf_csr *a, char *err, size_t n)
{
    return sound->setup(self, a, err, n);
}

static int faulty_solve(void *self, const double *b, double *x, char *err, size_t n)
{
    int status = sound->solve(self, b, x, err, n), nan;

    nan = faulty.how == NANS || (faulty.nan_from && faulty.n_solve + 1 >= faulty.nan_from);
    faulty.n_solve++;
    for (int64_t i = 0; i < faulty.n; i++)
        x[i] = nan ? NAN : faulty.how == ZEROS || (faulty.how == FIRST_ONLY && i > 0) ? 0 : x[i];
    return status;
}

static void faulty_destroy(void *self)
{
    sound->destroy(self);
}

static const pf_solver faulty_solver = {.size = sizeof(pf_solver),
                                        .major = PF_SOLVER_MAJOR,
                                        .name = "faulty",
                                        .create = faulty_create,
                                        .analyze = faulty_analyze,
                                        .setup = faulty_setup,
                                        .solve = faulty_solve,
                                        .destroy = faulty_destroy};

static void a_solver_that_returns_rubbish_is_told_from_a_singular_matrix(void **state)
{
    (void)state;
    memset(&faulty, 0, sizeof faulty);
    for (int how = ZEROS; how <= NANS; how++) {
        if (how)
            small_destroy(&f);
        faulty.how = how;
        SMALL_MAKE(&f, &faulty_solver, 0, "a", &small_enclosed);
        assert_int_equal(small_solve(&f, &tight), ERR_PLUGIN);
        assert_false(f.report.converged || f.err.retry);
        assert_said(f.err.text, "linear solver faulty left a residual of ");
        assert_said(f.err.text, "after its own factorisation");
        assert_said(f.err.text, how == NANS ? "is not finite" : "solves no system near this one");
    }
}

/* The last correction is an extra: without it the solution is as Newton left it. */
static void a_last_correction_of_nan_is_not_taken(void **state)
{
    (void)state;
    faulty.how = SOUND;
    for (int pass = 0; pass < 2; pass++) {
        if (pass)
            small_destroy(&f);
        faulty.nan_from = pass ? faulty.n_solve : 0;
        faulty.n_solve = 0;
        SMALL_MAKE(&f, &faulty_solver, 0, "a", &small_cubic);
        for (int64_t d = 0; d < f.s.n_dof; d++)
            f.x[d] = 1 + 0.1 * (double)d;
        assert_int_equal(small_solve(&f, &tight), 0);
        assert_true(f.report.converged);
        assert_field(&f, "a", 1);
    }
}

static void unknowns_without_an_equation_are_named(void **state)
{
    (void)state;
    SMALL_MAKE(&f, NULL, 0, "ab", &small_cubic, &small_a_for_b);
    assert_int_equal(small_solve(&f, &tight), 0);
    assert_true(f.report.singular && !f.report.converged);
    assert_said(f.report.why,
                "the linear system is singular: no equation contains b at (0, 0) and 15 other unknowns");
    assert_said(f.report.why, "(linear solver solver_umfpack: the matrix is singular");
}

static void a_combination_that_is_open_is_told(void **state)
{
    (void)state;
    SMALL_MAKE(&f, NULL, 0, "ab", &small_sum_a, &small_sum_b);
    assert_int_equal(small_solve(&f, &tight), 0);
    assert_true(f.report.singular && !f.report.converged);
    assert_said(f.report.why, "some combination of unknowns is left open");
}

static void a_vector_without_a_boundary_condition_is_named(void **state)
{
    (void)state;
    SMALL_MAKE(&f, NULL, 0, "w", &small_floating);
    assert_int_equal(small_solve(&f, &tight), 0);
    assert_true(f.report.singular && !f.report.converged);
    assert_said(f.report.why, "w[1] is fixed only up to a constant; is a boundary condition for w missing?");
}

static void nan_is_worse_than_any_number(void **state)
{
    (void)state;
    assert_true(isnan(vector_worse(NAN, 1)) && isnan(vector_worse(1, NAN)));
    assert_true(vector_worse(2, 1) == 2 && vector_worse(1, 2) == 2);
}

static int load(void **state)
{
    error err;

    (void)state;
    return registry_create(&plugins, NULL, 0, &err) || registry_solver(&plugins, "solver_umfpack", &sound, &err);
}

static int unload(void **state)
{
    (void)state;
    registry_destroy(&plugins);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(a_nan_in_one_field_is_no_convergence, teardown),
        cmocka_unit_test_teardown(a_nan_in_a_jacobian_is_no_convergence, teardown),
        cmocka_unit_test_teardown(a_nan_beside_a_residual_of_zero_is_no_convergence, teardown),
        cmocka_unit_test_teardown(a_value_that_is_nan_is_told, teardown),
        cmocka_unit_test_teardown(a_nan_ahead_is_told, teardown),
        cmocka_unit_test_teardown(a_solver_that_returns_rubbish_is_told_from_a_singular_matrix, teardown),
        cmocka_unit_test_teardown(a_last_correction_of_nan_is_not_taken, teardown),
        cmocka_unit_test_teardown(unknowns_without_an_equation_are_named, teardown),
        cmocka_unit_test_teardown(a_combination_that_is_open_is_told, teardown),
        cmocka_unit_test_teardown(a_vector_without_a_boundary_condition_is_named, teardown),
        cmocka_unit_test(nan_is_worse_than_any_number),
    };

    return cmocka_run_group_tests(tests, load, unload);
}
