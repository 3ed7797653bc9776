/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The linear solver plugin, GMRES on old factors, memory that does not suffice. */
#include "solve/solve.h"
#include "term/term.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <string.h>

enum { N = 400 };

/* A convection-diffusion-like matrix on a line, unknowns in groups of two; s moves it. */
static void fill(const space *s, double *value, double shift)
{
    for (int64_t i = 0; i < s->n_free; i++)
        for (int64_t k = s->row[i]; k < s->row[i + 1]; k++) {
            int64_t j = space_column(s, i, k);

            value[k] = i == j ? 4 + shift : 1.0 / (1 + fabs((double)(i - j))) * (i < j ? -0.8 : -0.6);
        }
}

typedef struct fixture {
    mesh m;
    field_list fields;
    space s;
    registry r;
    linear l;
} fixture;

static int setup(void **state)
{
    static fixture f;
    const pf_field u = {.name = "u", .shape = PF_VECTOR, .order = 2};
    mesh_box b = {.dim = 2, .high = {1, 1}, .n = {8, 8}};
    const pf_solver *solver;
    error err;

    memset(&f, 0, sizeof f);
    if (mesh_create_box(&b, &f.m, &err) || mesh_measure(&f.m, &err) || fields_add(&f.fields, 2, &u, "test", &err) ||
        space_number(&f.s, &f.fields, &f.m, 0, &err) || space_constrain(&f.s, &err) ||
        registry_create(&f.r, NULL, 0, &err) || registry_solver(&f.r, "solver_umfpack", &solver, &err) ||
        linear_create(&f.l, &(linear_choice){.direct = solver}, &f.s, 1, &err))
        return -1;
    *state = &f;
    return 0;
}

static int teardown(void **state)
{
    fixture *f = *state;

    linear_destroy(&f->l);
    registry_destroy(&f->r);
    space_destroy(&f->s);
    mesh_destroy(&f->m);
    return 0;
}

static double residual(const linear *l, const double *b, const double *x)
{
    double r = 0, size = 0;

    for (int64_t i = 0; i < l->a.n; i++) {
        double d = b[i];

        for (int64_t k = l->a.row[i]; k < l->a.row[i + 1]; k++)
            d -= l->value[k] * x[pf_column(&l->a, i, k)];
        r += d * d;
        size += b[i] * b[i];
    }
    return sqrt(r / size);
}

static void fresh_factors_solve_to_round_off(void **state)
{
    fixture *f = *state;
    double b[1000], x[1000];
    error err;

    assert_true(f->s.n_free < 1000);
    fill(&f->s, f->l.value, 0);
    for (int64_t i = 0; i < f->s.n_free; i++)
        b[i] = sin((double)i);
    assert_int_equal(linear_solve(&f->l, b, x, 0, &err), 0);
    assert_true(residual(&f->l, b, x) < 1e-13);
    assert_true(f->l.stats.worst_residual < 1e-12);
    assert_int_equal(f->l.stats.factorisations, 1);
}

static void old_factors_precondition_a_matrix_that_moved(void **state)
{
    fixture *f = *state;
    double b[1000], x[1000];
    error err;

    fill(&f->s, f->l.value, 0);
    for (int64_t i = 0; i < f->s.n_free; i++)
        b[i] = cos((double)i);
    assert_int_equal(linear_solve(&f->l, b, x, 1e-8, &err), 0);
    fill(&f->s, f->l.value, 0.4);
    assert_int_equal(linear_solve(&f->l, b, x, 1e-8, &err), 0);
    assert_true(residual(&f->l, b, x) < 1.1e-8);
    assert_int_equal(f->l.stats.factorisations, 1);
    assert_true(f->l.stats.gmres_iterations > 1);
}

static void a_singular_matrix_is_said_to_be_one(void **state)
{
    fixture *f = *state;
    double b[1000], x[1000];
    error err;

    memset(f->l.value, 0, (size_t)f->s.row[f->s.n_free] * sizeof *f->l.value);
    for (int64_t i = 0; i < f->s.n_free; i++)
        b[i] = 1;
    assert_int_equal(linear_solve(&f->l, b, x, 0, &err), ERR_CONVERGE);
    assert_non_null(strstr(err.text, "singular"));
    assert_true(err.retry);
}

static void memory_is_predicted_before_factoring(void **state)
{
    fixture *f = *state;
    error err;

    f->l.memory_limit = 1000;
    assert_int_equal(linear_predict(&f->l, &err), ERR_MEMORY);
    assert_non_null(strstr(err.text, "GB"));
    assert_true(f->l.stats.cost.bytes > 1000 && f->l.stats.cost.flops > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(fresh_factors_solve_to_round_off, setup, teardown),
        cmocka_unit_test_setup_teardown(old_factors_precondition_a_matrix_that_moved, setup, teardown),
        cmocka_unit_test_setup_teardown(a_singular_matrix_is_said_to_be_one, setup, teardown),
        cmocka_unit_test_setup_teardown(memory_is_predicted_before_factoring, setup, teardown),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
