/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Parts of the block preconditioner: the incomplete factorisation where it is complete, aggregates, products. */
#include "aggregate.h"
#include "ilu.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <string.h>

enum { MOST = 60 }; /* unknowns */

/* Reproducible numbers in [-1, 1]. */
static double next(void)
{
    static uint64_t s = 1;

    s = s * 6364136223846793005u + 1442695040888963407u;
    return (double)(s >> 11) * 0x1p-52 - 1;
}

/* Random blocks where `couples`; diagonally dominant. */
static block_matrix make(int32_t n, int b, int (*couples)(int32_t, int32_t), pool *p)
{
    block_matrix a = {.n = n, .b = b};

    TAKE(p, a.row, n + 1);
    TAKE(p, a.col, n * n);
    TAKE(p, a.diagonal, n);
    TAKE(p, a.value, n * n * b * b);
    TAKE(p, a.part, n + 1);
    assert_false(p->failed);
    for (int32_t i = 0; i < n; i++) {
        int64_t k = a.row[i];

        for (int32_t j = 0; j < n; j++) {
            if (!couples(i, j))
                continue;
            a.diagonal[i] = i == j ? k : a.diagonal[i];
            for (int e = 0; e < b * b; e++)
                a.value[k * b * b + e] = (float)(next() + (i == j && e % b == e / b) * 1.5 * n * b);
            a.col[k++] = j;
        }
        a.row[i + 1] = k;
    }
    a.n_part = 1;
    a.part[1] = n;
    return a;
}

static int all(int32_t i, int32_t j)
{
    (void)i, (void)j;
    return 1;
}

/* Full blocks 0 .. 3 and 4 .. 7 that only 8 and 9 couple: elimination fills nothing else. */
static int arrow(int32_t i, int32_t j)
{
    return i / 4 == j / 4 || i >= 8 || j >= 8;
}

static int chain(int32_t i, int32_t j)
{
    return i - j <= 1 && j - i <= 1;
}

static int ring(int32_t i, int32_t j)
{
    int32_t apart = (i - j + 10) % 10;

    return apart <= 2 || apart >= 8;
}

static void to_dense(const block_matrix *a, double d[MOST][MOST])
{
    memset(d, 0, sizeof(double[MOST][MOST]));
    for (int32_t i = 0; i < a->n; i++)
        for (int64_t k = a->row[i]; k < a->row[i + 1]; k++)
            for (int r = 0; r < a->b; r++)
                for (int c = 0; c < a->b; c++)
                    d[i * a->b + r][a->col[k] * a->b + c] = a->value[k * a->b * a->b + c * a->b + r];
}

/* x = A^-1 b by elimination in double precision. */
static void solve_dense(int n, double a[MOST][MOST], double *x)
{
    for (int k = 0; k < n; k++)
        for (int i = k + 1; i < n; i++) {
            double l = a[i][k] / a[k][k];

            for (int j = k; j < n; j++)
                a[i][j] -= l * a[k][j];
            x[i] -= l * x[k];
        }
    for (int i = n; i-- > 0;) {
        for (int j = i + 1; j < n; j++)
            x[i] -= a[i][j] * x[j];
        x[i] /= a[i][i];
    }
}

/* What has no fill is factored exactly. */
static void check_exact(block_matrix *a, int n_thread, float *x, pool *p)
{
    static double d[MOST][MOST];
    double expected[MOST], size = 0, error = 0;
    float b[MOST + 8];
    int n = a->n * a->b;
    ilu f;

    ilu_create(&f, a, p);
    assert_false(p->failed);
    ilu_factor(&f, n_thread);
    for (int i = 0; i < n; i++) {
        b[i] = (float)sin(1 + i);
        expected[i] = b[i];
    }
    ilu_solve(&f, n_thread, b, x);
    to_dense(a, d);
    solve_dense(n, d, expected);
    for (int i = 0; i < n; i++) {
        error = fmax(error, fabs(x[i] - expected[i]));
        size = fmax(size, fabs(expected[i]));
    }
    assert_true(size > 0 && error < 2e-6 * size);
}

static void factors_without_fill_are_exact(void **state)
{
    int (*const pattern[])(int32_t, int32_t) = {all, arrow, chain};

    (void)state;
    for (int k = 0; k < 3; k++)
        for (int b = 2; b <= 3; b++) {
            pool p = {0};
            block_matrix a = make(10, b, pattern[k], &p);
            float x[MOST + 8];

            check_exact(&a, 1, x, &p);
            pool_free(&p);
        }
}

static void parts_give_the_same_on_one_thread_and_on_two(void **state)
{
    (void)state;
    for (int b = 2; b <= 3; b++) {
        pool p = {0};
        block_matrix a = make(10, b, arrow, &p);
        float x[2][MOST + 8];

        a.n_part = 2;
        a.part[1] = 4;
        a.part[2] = 8;
        for (int t = 0; t < 2; t++)
            check_exact(&a, t + 1, x[t], &p);
        assert_memory_equal(x[0], x[1], (size_t)(10 * b) * sizeof(float));
        pool_free(&p);
    }
}

/* With fill that is left out, L U has the entries of A on its pattern: ILU(0) by definition. */
static void factors_with_fill_have_the_entries_of_the_matrix(void **state)
{
    static double d[MOST][MOST], l[MOST][MOST], u[MOST][MOST];
    pool p = {0};
    int b = 2;
    ilu f;
    block_matrix a;

    (void)state;
    a = make(10, b, ring, &p);
    ilu_create(&f, &a, &p);
    ilu_factor(&f, 1);
    memset(l, 0, sizeof l);
    memset(u, 0, sizeof u);
    to_dense(&a, d);
    for (int32_t i = 0; i < a.n; i++)
        for (int64_t k = a.row[i]; k < a.row[i + 1]; k++) {
            const float *v = f.value + k * b * b;
            double inverse = v[0] * (double)v[3] - v[1] * (double)v[2];

            for (int r = 0; r < b; r++)
                for (int c = 0; c < b; c++)
                    if (a.col[k] < i)
                        l[i * b + r][a.col[k] * b + c] = v[c * b + r];
                    else if (a.col[k] > i)
                        u[i * b + r][a.col[k] * b + c] = v[c * b + r];
                    else
                        u[i * b + r][i * b + c] = (r == c ? v[3 * (1 - r)] : -(double)v[c * b + r]) / inverse;
        }
    for (int i = 0; i < a.n * b; i++)
        for (int j = 0; j < a.n * b; j++) {
            double v = u[i][j];

            for (int k = 0; k < a.n * b; k++)
                v += l[i][k] * u[k][j];
            if (ring(i / b, j / b))
                assert_true(fabs(v - d[i][j]) < 1e-5 * fabs(d[i][i]));
        }
    pool_free(&p);
}

/* The five-point Laplacian of a square with side `side`, no walls: row sums vanish. */
static sparse laplacian(int side, pool *p)
{
    sparse a = {.n = side * side, .n_col = side * side};
    int64_t n = 0;

    TAKE(p, a.row, a.n + 1);
    TAKE(p, a.col, 5 * a.n);
    TAKE(p, a.value, 5 * a.n);
    assert_false(p->failed);
    for (int32_t i = 0; i < a.n; i++) {
        int x = i % side, y = i / side;
        int32_t to[5] = {i - side, i - 1, i, i + 1, i + side};
        int there[5] = {y > 0, x > 0, 1, x < side - 1, y < side - 1};

        for (int k = 0; k < 5; k++)
            if (there[k]) {
                a.col[n] = to[k];
                a.value[n++] = k == 2 ? there[0] + there[1] + there[3] + there[4] : -1;
            }
        a.row[i + 1] = n;
    }
    return a;
}

static void aggregates_take_all_rows_and_keep_constants(void **state)
{
    pool p = {0};
    sparse a = laplacian(20, &p), q;

    (void)state;
    aggregate(&a, NULL, 0.02, &q, &p);
    assert_false(p.failed);
    assert_true(q.n == 400 && q.n_col > 400 / 15 && q.n_col < 400 / 3);
    for (int32_t i = 0; i < q.n; i++) {
        double sum = 0;

        for (int64_t k = q.row[i]; k < q.row[i + 1]; k++) {
            assert_in_range(q.col[k], 0, q.n_col - 1);
            sum += q.value[k];
        }
        assert_true(fabs(sum - 1) < 1e-12);
    }
    pool_free(&p);
}

static void rows_that_take_no_part_have_no_aggregate(void **state)
{
    uint8_t active[400];
    pool p = {0};
    sparse a = laplacian(20, &p), q;

    (void)state;
    memset(active, 1, sizeof active);
    active[105] = active[106] = 0;
    for (int64_t k = 0; k < a.row[a.n]; k++) /* row 210 stands alone */
        for (int32_t i = 0; i < a.n; i++)
            if (k >= a.row[i] && k < a.row[i + 1] && (i == 210) != (a.col[k] == 210))
                a.value[k] = 0;
    aggregate(&a, active, 0.02, &q, &p);
    assert_false(p.failed);
    for (int32_t i = 0; i < a.n; i++)
        assert_int_equal(q.row[i + 1] == q.row[i], i == 105 || i == 106 || i == 210);
    pool_free(&p);
}

static void products_and_transposes_are_those_of_dense_matrices(void **state)
{
    pool p = {0};
    sparse a = laplacian(6, &p), q, t, aq, taq;
    static double d[36][36], dq[36][36];

    (void)state;
    aggregate(&a, NULL, 0.02, &q, &p);
    sparse_transpose(&q, &t, &p);
    sparse_product(&a, &q, 1, &aq, &p);
    sparse_product(&t, &aq, 2, &taq, &p);
    assert_false(p.failed);
    assert_int_equal(t.n, q.n_col);
    assert_int_equal(taq.n, q.n_col);
    for (int32_t i = 0; i < 36; i++) {
        for (int64_t k = a.row[i]; k < a.row[i + 1]; k++)
            d[i][a.col[k]] = a.value[k];
        for (int64_t k = q.row[i]; k < q.row[i + 1]; k++)
            dq[i][q.col[k]] = q.value[k];
    }
    for (int32_t i = 0; i < taq.n; i++) {
        double row[36] = {0};

        for (int64_t k = taq.row[i]; k < taq.row[i + 1]; k++)
            row[taq.col[k]] += taq.value[k];
        for (int32_t j = 0; j < taq.n_col; j++) {
            double v = 0;

            for (int k = 0; k < 36; k++)
                for (int m = 0; m < 36; m++)
                    v += dq[k][i] * d[k][m] * dq[m][j];
            assert_true(fabs(row[j] - v) < 1e-12);
        }
    }
    pool_free(&p);
}

static void product_of_blocks_is_that_of_the_dense_matrix(void **state)
{
    static double d[MOST][MOST];

    (void)state;
    for (int b = 2; b <= 3; b++) {
        pool p = {0};
        block_matrix a = make(10, b, arrow, &p);
        float x[MOST + 8] = {0}, y[2][MOST + 8];

        for (int i = 0; i < 10 * b; i++)
            x[i] = (float)next();
        to_dense(&a, d);
        for (int t = 0; t < 2; t++)
            block_multiply(&a, t + 1, x, y[t]);
        for (int i = 0; i < 10 * b; i++) {
            double v = 0;

            for (int j = 0; j < 10 * b; j++)
                v += d[i][j] * x[j];
            assert_true(fabs(y[0][i] - v) < 1e-6 * d[i][i]);
            assert_true(y[0][i] == y[1][i]);
        }
        pool_free(&p);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(factors_without_fill_are_exact),
        cmocka_unit_test(parts_give_the_same_on_one_thread_and_on_two),
        cmocka_unit_test(factors_with_fill_have_the_entries_of_the_matrix),
        cmocka_unit_test(aggregates_take_all_rows_and_keep_constants),
        cmocka_unit_test(rows_that_take_no_part_have_no_aggregate),
        cmocka_unit_test(products_and_transposes_are_those_of_dense_matrices),
        cmocka_unit_test(product_of_blocks_is_that_of_the_dense_matrix),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
