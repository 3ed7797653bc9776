/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Small dense matrices. */
#include "base/dense.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <string.h>

/* Numbers in (-1, 1), the same for each seed. */
static void fill(double *a, int n, unsigned long long seed)
{
    unsigned long long s = 88172645463325252ULL + 1000003 * seed;

    for (int i = 0; i < n; i++) {
        s ^= s << 13;
        s ^= s >> 7;
        s ^= s << 17;
        a[i] = (double)(s >> 11) * 0x1p-52 - 1;
    }
}

static void inverse_times_matrix_is_one(void **state)
{
    (void)state;
    for (int round = 0; round < 20; round++) {
        double a[3][3], b[3][3], det;

        fill(&a[0][0], 9, (unsigned long long)round);
        det = dense_inverse3((const double(*)[3])a, b);
        assert_true(fabs(det - dense_determinant((const double(*)[3])a)) == 0);
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) {
                double sum = 0;

                for (int k = 0; k < 3; k++)
                    sum += a[i][k] * b[k][j];
                assert_true(fabs(sum - (i == j)) < 1e-13 / fabs(det));
            }
    }
}

static void the_determinant_of_a_plane_matrix_is_that_of_its_block(void **state)
{
    const double a[3][3] = {{2, 3, 0}, {-1, 5, 0}, {0, 0, 1}};

    (void)state;
    assert_true(dense_determinant(a) == 13);
}

static void systems_are_solved_whatever_the_order_of_their_rows(void **state)
{
    (void)state;
    for (int n = 1; n <= DENSE_MAX; n++) {
        double a[DENSE_MAX * DENSE_MAX], copy[DENSE_MAX * DENSE_MAX], x[DENSE_MAX], b[DENSE_MAX];

        fill(a, n * n, 100 + (unsigned long long)n);
        fill(x, n, 200 + (unsigned long long)n);
        for (int i = 0; i < n; i++) {
            a[i * n + i] = 0; /* no first pivot where elimination without row swaps looks for it */
            a[i * n + (n - 1 - i)] += 4;
        }
        for (int i = 0; i < n; i++) {
            b[i] = 0;
            for (int j = 0; j < n; j++)
                b[i] += a[i * n + j] * x[j];
        }
        memcpy(copy, a, sizeof a);
        assert_int_equal(dense_solve(n, copy, b), 0);
        for (int i = 0; i < n; i++)
            assert_true(fabs(b[i] - x[i]) < 1e-12);
    }
}

static void a_singular_system_is_refused(void **state)
{
    double zero[4] = {0}, twice[4] = {1, 2, 2, 4}, bad[4] = {NAN, 2, 0, 1}, b[2] = {1, 1};
    error err;

    (void)state;
    assert_int_equal(dense_solve(2, zero, b), 1);
    assert_int_equal(dense_solve(2, twice, b), 1);
    b[0] = b[1] = 1;
    assert_int_equal(dense_solve(2, bad, b), 1);
    twice[0] = 1, twice[1] = 2, twice[2] = 2, twice[3] = 4;
    assert_int_equal(dense_invert(2, twice, &err), ERR_USAGE);
    assert_non_null(strstr(err.text, "singular"));
}

static void large_matrices_are_inverted(void **state)
{
    enum { N = 35 };
    double a[N * N], b[N * N];
    error err;

    (void)state;
    fill(a, N * N, 300);
    memcpy(b, a, sizeof a);
    assert_int_equal(dense_invert(N, b, &err), 0);
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++) {
            double sum = 0;

            for (int k = 0; k < N; k++)
                sum += a[i * N + k] * b[k * N + j];
            assert_true(fabs(sum - (i == j)) < 1e-11);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(inverse_times_matrix_is_one),
        cmocka_unit_test(the_determinant_of_a_plane_matrix_is_that_of_its_block),
        cmocka_unit_test(systems_are_solved_whatever_the_order_of_their_rows),
        cmocka_unit_test(a_singular_system_is_refused),
        cmocka_unit_test(large_matrices_are_inverted),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
