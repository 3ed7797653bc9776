/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Sum factorisation against the sums over all points as they are written. */
#include "assemble/tensor.h"
#include "fe/fe.h"
#include "support/opened.h"

#include <plugflow/mesh.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = FE_MAX_POINTS, NODES = FE_MAX_NODES };

/* Points of the product rule, and kinds 0..3 of each basis function there. */
typedef struct direct {
    int dim, n_point, n_node[3];
    double basis[3][TENSOR_KINDS][NODES][MOST];
} direct;

static tensor_rule rule;
static direct plain;
static v8 *room;

static v8 *numbers(int64_t n, uint64_t seed)
{
    v8 *v = aligned_alloc(64, (size_t)n * sizeof *v);

    assert_non_null(v);
    fill_random((double *)v, 8 * n, seed);
    return v;
}

static void make(int dim, int n)
{
    const fe_cell *c = fe_cell_of(dim == 2 ? PF_QUAD9 : PF_HEX27);
    double x[FE_MAX_GAUSS], w[FE_MAX_GAUSS];
    error err;

    assert_int_equal(fe_gauss(n, x, w, &err), 0);
    tensor_create(&rule, dim, n, x);
    plain.dim = dim;
    plain.n_point = dim == 2 ? n * n : n * n * n;
    for (int order = 0; order < 3; order++) {
        plain.n_node[order] = fe_n_basis(c, order);
        for (int q = 0; q < plain.n_point; q++) {
            const double xi[3] = {x[q % n], x[q / n % n], dim == 3 ? x[q / (n * n)] : 0};
            double v[NODES], dv[NODES][3];

            fe_basis(c, order, xi, v, dv);
            for (int i = 0; i < plain.n_node[order]; i++)
                for (int k = 0; k <= dim; k++)
                    plain.basis[order][k][i][q] = k ? dv[i][k - 1] : v[i];
        }
    }
    room = aligned_alloc(64, tensor_room(dim, n) * sizeof *room);
    assert_non_null(room);
}

static void same(v8 a, v8 b)
{
    for (int l = 0; l < 8; l++)
        if (!(fabs(a[l] - b[l]) <= 1e-12))
            fail_msg("lane %d: %.17g for %.17g", l, a[l], b[l]);
}

static void check_values(int order)
{
    int nq = plain.n_point;
    v8 *nodal = numbers(NODES, 3), *out = numbers((int64_t)TENSOR_KINDS * nq, 1);

    for (int kinds = 1; kinds < 1 << (plain.dim + 1); kinds++) {
        v8 *to[TENSOR_KINDS] = {NULL};

        for (int k = 0; k <= plain.dim; k++)
            to[k] = kinds >> k & 1 ? out + k * nq : NULL;
        tensor_values(&rule, order, nodal, to, room);
        for (int k = 0; k <= plain.dim; k++)
            for (int q = 0; to[k] && q < nq; q++) {
                v8 sum = {0};

                for (int i = 0; i < plain.n_node[order]; i++)
                    sum += nodal[i] * plain.basis[order][k][i][q];
                same(to[k][q], sum);
            }
    }
    free(nodal);
    free(out);
}

static void check_vector(int order)
{
    int nq = plain.n_point, at[NODES];
    v8 *s = numbers((int64_t)TENSOR_KINDS * nq, 5), *vec = numbers(2 * NODES, 1);

    for (int i = 0; i < NODES; i++)
        at[i] = 2 * (NODES - 1 - i);
    for (int kinds = 1; kinds < 1 << (plain.dim + 1); kinds++) {
        const v8 *from[TENSOR_KINDS] = {NULL};

        for (int k = 0; k <= plain.dim; k++)
            from[k] = kinds >> k & 1 ? s + k * nq : NULL;
        tensor_vector(&rule, order, from, at, vec, room);
        for (int i = 0; i < plain.n_node[order]; i++) {
            v8 sum = {0};

            for (int k = 0; k <= plain.dim; k++)
                for (int q = 0; from[k] && q < nq; q++)
                    sum += s[k * nq + q] * plain.basis[order][k][i][q];
            same(vec[at[i]], sum);
        }
    }
    free(s);
    free(vec);
}

static v8 matrix_entry(int row_order, int column_order, int i, int j, const v8 *d[TENSOR_KINDS][TENSOR_KINDS])
{
    v8 sum = {0};

    for (int e = 0; e <= plain.dim; e++)
        for (int f = 0; f <= plain.dim; f++)
            for (int q = 0; d[e][f] && q < plain.n_point; q++)
                sum += d[e][f][q] * plain.basis[row_order][e][i][q] * plain.basis[column_order][f][j][q];
    return sum;
}

/* All coefficients, each alone, and sets of them. */
static void check_matrix(int row_order, int column_order)
{
    int nq = plain.n_point, i, j, n = tensor_pairs(plain.dim, row_order, column_order, 0, &i, &j);
    int all = (plain.dim + 1) * (plain.dim + 1);
    v8 *d = numbers((int64_t)TENSOR_KINDS * TENSOR_KINDS * nq, 7), *mat = numbers(NODES * NODES, 1);
    int32_t place[NODES * NODES];

    assert_int_equal(n, plain.n_node[row_order] * plain.n_node[column_order]);
    for (int k = 0; k < n; k++)
        place[k] = n - 1 - k;
    for (int set = 0; set < all + 8; set++) {
        const v8 *on[TENSOR_KINDS][TENSOR_KINDS] = {{NULL}};

        for (int k = 0; k < all; k++)
            if (set < all ? k == set : (set - all + 1) * (k + 3) % 8 < 4)
                on[k / (plain.dim + 1)][k % (plain.dim + 1)] = d + k * nq;
        tensor_matrix(&rule, row_order, column_order, on, place, mat, room);
        for (int k = 0; k < n; k++) {
            tensor_pairs(plain.dim, row_order, column_order, k, &i, &j);
            same(mat[place[k]], matrix_entry(row_order, column_order, i, j, on));
        }
    }
    free(d);
    free(mat);
}

static void sums_are_those_over_all_points(void **state)
{
    (void)state;
    for (int dim = 2; dim <= 3; dim++)
        for (int n = 3; n <= TENSOR_POINTS; n += 2) {
            make(dim, n);
            for (int order = 0; order < 3; order++) {
                check_values(order);
                check_vector(order);
                for (int other = 0; other < 3; other++)
                    check_matrix(order, other);
            }
            free(room);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(sums_are_those_over_all_points)};

    return cmocka_run_group_tests(tests, NULL, NULL);
}
