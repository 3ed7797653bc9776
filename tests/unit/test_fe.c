/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Reference elements and quadrature. */
#include "fe/fe.h"

#include <plugflow/mesh.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>

static const int types[4] = {PF_TRI6, PF_QUAD9, PF_TET10, PF_HEX27};

static void basis_is_one_at_its_node_and_zero_at_others(void **state)
{
    (void)state;
    for (int t = 0; t < 4; t++) {
        const fe_cell *c = fe_cell_of(types[t]);
        double n[FE_MAX_NODES], dn[FE_MAX_NODES][3];

        for (int order = 1; order <= 2; order++)
            for (int i = 0; i < fe_n_basis(c, order); i++) {
                fe_basis(c, order, c->x[order == 2 ? i : c->vertex[i]], n, dn);
                for (int j = 0; j < fe_n_basis(c, order); j++)
                    assert_true(fabs(n[j] - (i == j)) < 1e-15);
            }
    }
}

static void basis_sums_to_one_and_gradients_match_differences(void **state)
{
    const double h = 1e-6, at[3] = {0.21, 0.34, 0.17};

    (void)state;
    for (int t = 0; t < 4; t++)
        for (int order = 1; order <= 2; order++) {
            const fe_cell *c = fe_cell_of(types[t]);
            double n[FE_MAX_NODES], dn[FE_MAX_NODES][3], plus[FE_MAX_NODES], minus[FE_MAX_NODES],
                x[FE_MAX_NODES][3], sum = 0;

            fe_basis(c, order, at, n, dn);
            for (int i = 0; i < fe_n_basis(c, order); i++)
                sum += n[i];
            assert_true(fabs(sum - 1) < 1e-14);
            for (int k = 0; k < c->dim; k++) {
                double p[3] = {at[0], at[1], at[2]};

                p[k] += h;
                fe_basis(c, order, p, plus, x);
                p[k] -= 2 * h;
                fe_basis(c, order, p, minus, x);
                for (int i = 0; i < fe_n_basis(c, order); i++)
                    assert_true(fabs((plus[i] - minus[i]) / (2 * h) - dn[i][k]) < 1e-9);
            }
        }
}

/* On all of the cell, up to its edge; quadratics differ from their differences by round-off alone. */
static void second_derivatives_match_differences_of_gradients(void **state)
{
    static const int of[FE_SECOND][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};
    const double h = 0.125, at[2][3] = {{0.21, 0.34, 0.17}, {0, 1, 0}};

    (void)state;
    for (int t = 0; t < 4; t++)
        for (int order = 0; order <= 2; order++)
            for (int s = 0; s < 2 * FE_SECOND; s++) {
                const fe_cell *c = fe_cell_of(types[t]);
                int k = of[s / 2][0], l = of[s / 2][1];
                double n[FE_MAX_NODES], plus[FE_MAX_NODES][3], minus[FE_MAX_NODES][3], d2n[FE_MAX_NODES][FE_SECOND],
                    p[3];

                fe_basis_second(c, order, at[s % 2], d2n);
                for (int d = 0; d < 3; d++)
                    p[d] = at[s % 2][d];
                p[l] += h;
                fe_basis(c, order, p, n, plus);
                p[l] -= 2 * h;
                fe_basis(c, order, p, n, minus);
                for (int i = 0; i < fe_n_basis(c, order); i++) {
                    double d = k < c->dim && l < c->dim ? (plus[i][k] - minus[i][k]) / (2 * h) : 0;

                    assert_true(fabs(d - d2n[i][s / 2]) < 1e-13);
                }
            }
}

static double factorial(int n)
{
    return n < 2 ? 1 : n * factorial(n - 1);
}

/* Integral of x^a y^b z^c over the reference cell. */
static double monomial(const fe_cell *c, int a, int b, int e)
{
    int power[3] = {a, b, e};
    double v = 1;

    if (c->simplex)
        return factorial(a) * factorial(b) * factorial(e) / factorial(a + b + e + c->dim);
    for (int k = 0; k < c->dim; k++)
        v *= power[k] % 2 ? 0 : 2.0 / (power[k] + 1);
    return v;
}

static void quadrature_is_exact_for_its_degree(void **state)
{
    error err;

    (void)state;
    for (int t = 0; t < 4; t++) {
        const fe_cell *c = fe_cell_of(types[t]);
        fe_rule r;

        assert_int_equal(fe_rule_cell(c, 5, &r, &err), 0);
        for (int a = 0; a <= 5; a++)
            for (int b = 0; b <= 5; b++)
                for (int e = 0; e <= (c->dim == 3 ? 5 : 0); e++) {
                    double sum = 0;

                    if (c->simplex && a + b + e > 5)
                        continue;
                    for (int q = 0; q < r.n; q++)
                        sum += r.w[q] * pow(r.x[q][0], a) * pow(r.x[q][1], b) * pow(r.x[q][2], e);
                    assert_true(fabs(sum - monomial(c, a, b, e)) < 1e-14);
                }
    }
}

/* Divergence theorem for F = x on the reference cell: the sum over facets of x.n is dim times the volume. */
static void facet_rules_close_the_cell(void **state)
{
    error err;

    (void)state;
    for (int t = 0; t < 4; t++) {
        const fe_cell *c = fe_cell_of(types[t]);
        double flux = 0;

        for (int f = 0; f < c->n_facet; f++) {
            fe_rule r;
            double s[2][3], n[3];
            int orient;

            assert_int_equal(fe_rule_facet(c, f, 5, &r, s, &orient, &err), 0);
            if (c->dim == 2) {
                n[0] = orient * s[0][1], n[1] = -orient * s[0][0], n[2] = 0;
            } else {
                n[0] = orient * (s[0][1] * s[1][2] - s[0][2] * s[1][1]);
                n[1] = orient * (s[0][2] * s[1][0] - s[0][0] * s[1][2]);
                n[2] = orient * (s[0][0] * s[1][1] - s[0][1] * s[1][0]);
            }
            for (int q = 0; q < r.n; q++)
                for (int k = 0; k < c->dim; k++)
                    flux += r.w[q] * r.x[q][k] * n[k];
        }
        assert_true(fabs(flux - c->dim * c->measure) < 1e-13);
    }
}

static void facet_nodes_lie_on_the_facet(void **state)
{
    (void)state;
    for (int t = 0; t < 4; t++) {
        const fe_cell *c = fe_cell_of(types[t]);

        for (int f = 0; f < c->n_facet; f++) {
            int on = 0; /* nodes whose basis does not vanish at the middle of the facet's vertices */
            double x[3] = {0}, n[FE_MAX_NODES], dn[FE_MAX_NODES][3];

            for (int v = 0; v < c->facet_vertices; v++)
                for (int k = 0; k < 3; k++)
                    x[k] += c->x[c->facet[f][v]][k] / c->facet_vertices;
            fe_basis(c, 2, x, n, dn);
            for (int i = 0; i < c->n_node; i++) {
                int listed = 0;

                for (int j = 0; j < c->facet_nodes; j++)
                    listed |= c->facet[f][j] == i;
                on += listed;
                assert_true(listed || fabs(n[i]) < 1e-15);
            }
            assert_int_equal(on, c->facet_nodes);
        }
    }
}

/* Degree 2 n - 1, against int_-1^1 x^k; points ascend within the interval. */
static void gauss_rules_are_exact_for_twice_their_number(void **state)
{
    error err;

    (void)state;
    for (int n = 1; n <= FE_MAX_GAUSS; n++) {
        double x[FE_MAX_GAUSS], w[FE_MAX_GAUSS];

        assert_int_equal(fe_gauss(n, x, w, &err), 0);
        for (int k = 0; k < 2 * n; k++) {
            double sum = 0;

            for (int i = 0; i < n; i++)
                sum += w[i] * pow(x[i], k);
            assert_true(fabs(sum - (k % 2 ? 0 : 2.0 / (k + 1))) < 1e-14);
        }
        for (int i = 0; i < n; i++)
            assert_true(x[i] > (i ? x[i - 1] : -1) && x[i] < 1 && w[i] > 0);
    }
    assert_int_equal(fe_gauss(0, (double[1]){0}, (double[1]){0}, &err), ERR_USAGE);
    assert_int_equal(fe_gauss(FE_MAX_GAUSS + 1, (double[1]){0}, (double[1]){0}, &err), ERR_USAGE);
}

/* A random function of second order stays between its Bernstein coefficients, and reaches beyond its nodal values.
 */
static void bernstein_coefficients_bound_a_function(void **state)
{
    unsigned seed = 1;
    int beyond = 0;

    (void)state;
    for (int t = 0; t < 4; t++)
        for (int round = 0; round < 20; round++) {
            const fe_cell *c = fe_cell_of(types[t]);
            double v[FE_MAX_NODES], b[FE_MAX_NODES], low[2] = {1e9, 1e9}, high[2] = {-1e9, -1e9};

            for (int i = 0; i < c->n_node; i++) {
                seed = seed * 1664525u + 1013904223u;
                b[i] = v[i] = seed / 4294967296.0;
            }
            fe_bernstein(c, b);
            for (int i = 0; i < c->n_node; i++) {
                low[0] = fmin(low[0], v[i]), high[0] = fmax(high[0], v[i]);
                low[1] = fmin(low[1], b[i]), high[1] = fmax(high[1], b[i]);
            }
            for (int q = 0; q < 11 * 11 * 11; q++) {
                double at[3] = {q % 11 / 10.0, q / 11 % 11 / 10.0, q / 121 / 10.0}, n[FE_MAX_NODES], u = 0;
                double dn[FE_MAX_NODES][3];

                if (c->simplex) { /* collapsed */
                    at[1] *= 1 - at[2];
                    at[0] *= 1 - at[1] - at[2];
                }
                for (int k = 0; k < 3; k++)
                    at[k] = k >= c->dim ? 0 : c->simplex ? at[k] : 2 * at[k] - 1;
                fe_basis(c, 2, at, n, dn);
                for (int i = 0; i < c->n_node; i++)
                    u += n[i] * v[i];
                assert_true(u > low[1] - 1e-12 && u < high[1] + 1e-12);
                beyond += u < low[0] - 1e-12 || u > high[0] + 1e-12;
            }
        }
    assert_true(beyond > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(basis_is_one_at_its_node_and_zero_at_others),
        cmocka_unit_test(basis_sums_to_one_and_gradients_match_differences),
        cmocka_unit_test(second_derivatives_match_differences_of_gradients),
        cmocka_unit_test(quadrature_is_exact_for_its_degree),
        cmocka_unit_test(facet_rules_close_the_cell),
        cmocka_unit_test(facet_nodes_lie_on_the_facet),
        cmocka_unit_test(gauss_rules_are_exact_for_twice_their_number),
        cmocka_unit_test(bernstein_coefficients_bound_a_function),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
