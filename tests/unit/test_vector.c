/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Sums over vectors are right, and the same bits whatever the number of threads. */
#include "solve/vector.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <omp.h>
#include <stdlib.h>

/* Below a piece, at its end, over several, and where pieces are longer and threads take part. */
static const int64_t length[] = {0, 1, 7, 4095, 4096, 4097, 100000, 1 << 20, (1 << 20) + 1, 2000003};
enum { N = sizeof length / sizeof *length };

static double *numbers(int64_t n, uint64_t seed)
{
    double *a = malloc((size_t)(n + 1) * sizeof *a);

    assert_non_null(a);
    for (int64_t i = 0; i < n; i++)
        a[i] = sin((double)(seed + 1) * 1.3 * (double)(i % 10007) + 0.1);
    return a;
}

static void dot_products_are_right_and_do_not_depend_on_threads(void **state)
{
    (void)state;
    for (int k = 0; k < N; k++) {
        const int64_t n = length[k];
        double *a = numbers(n, 1), *b = numbers(n, 2), one, two;
        long double sum = 0, size = 0;

        for (int64_t i = 0; i < n; i++) {
            sum += (long double)a[i] * b[i];
            size += fabsl((long double)a[i] * b[i]);
        }
        omp_set_num_threads(1);
        one = vector_dot(n, a, b);
        omp_set_num_threads(3);
        two = vector_dot(n, a, b);
        assert_true(fabsl(one - sum) <= 1e-15L * size);
        assert_true(one == two);
        free(a);
        free(b);
    }
}

static void squares_are_summed_by_field(void **state)
{
    (void)state;
    for (int k = 0; k < N; k++) {
        const int64_t n = length[k];
        double *a = numbers(n, 3), one[3], two[3], free_one[3];
        long double sum[3] = {0};
        uint8_t *field = malloc((size_t)(2 * n + 1));
        int32_t *dof_of = malloc((size_t)(n + 1) * sizeof *dof_of);
        double *dof = calloc((size_t)(2 * n + 1), sizeof *dof);
        const space s = {.n_field = 3, .n_free = n, .n_dof = 2 * n, .dof_field = field, .dof_of = dof_of};

        assert_true(field && dof_of && dof);
        for (int64_t i = 0; i < n; i++) { /* every second unknown is free */
            dof_of[i] = (int32_t)(2 * i + 1);
            field[2 * i] = field[2 * i + 1] = (uint8_t)(i % 3);
            dof[2 * i + 1] = a[i];
            dof[2 * i] = NAN;
            sum[i % 3] += (long double)a[i] * a[i];
        }
        omp_set_num_threads(1);
        vector_squares(&s, dof, one);
        omp_set_num_threads(3);
        vector_squares(&s, dof, two);
        vector_squares_free(&s, a, free_one);
        for (int f = 0; f < 3; f++) {
            assert_true(fabsl(one[f] - sum[f]) <= 1e-14L * sum[f]);
            assert_true(one[f] == two[f] && one[f] == free_one[f]);
        }
        free(a);
        free(field);
        free(dof_of);
        free(dof);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(dot_products_are_right_and_do_not_depend_on_threads),
        cmocka_unit_test(squares_are_summed_by_field),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
