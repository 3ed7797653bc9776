/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Numbering of unknowns, the matrix pattern, points to cells. */
#include "space/evaluate.h"
#include "space/locate.h"
#include "space/space.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <string.h>

static const pf_field velocity = {.name = "u", .shape = PF_VECTOR, .order = 2};
static const pf_field pressure = {.name = "p", .shape = PF_SCALAR, .order = 1};
static const pf_field single = {.name = "flow_rate", .shape = PF_SCALAR, .support = PF_ON_PROBLEM};

/* A mesh and the fields on it; the list must outlive the space. */
static void make(mesh *m, field_list *l, int dim, int simplex, int with_single)
{
    mesh_box b = {.dim = dim, .simplex = simplex, .high = {1, 1, 1}, .n = {3, 2, 2}};
    error err;

    memset(l, 0, sizeof *l);
    assert_int_equal(mesh_create_box(&b, m, &err), 0);
    assert_int_equal(mesh_measure(m, &err), 0);
    assert_int_equal(fields_add(l, dim, &velocity, "test", &err), 0);
    assert_int_equal(fields_add(l, dim, &pressure, "test", &err), 0);
    if (with_single)
        assert_int_equal(fields_add(l, dim, &single, "test", &err), 0);
}

static void unknowns_are_counted_and_interleaved_by_node(void **state)
{
    error err;
    field_list list;
    mesh m;
    space s;

    (void)state;
    make(&m, &list, 2, 0, 0);
    assert_int_equal(space_number(&s, &list, &m, 0, &err), 0);
    assert_int_equal(s.n_dof, 2 * 7 * 5 + 4 * 3);
    for (int64_t d = 1; d < s.n_dof; d++)
        assert_true(s.dof_node[d] >= s.dof_node[d - 1]);
    space_destroy(&s);
    mesh_destroy(&m);
}

/* Entry (i, j) is in the pattern exactly if a cell has both unknowns. */
static void pattern_matches_brute_force(void **state)
{
    error err;

    (void)state;
    for (int k = 0; k < 4; k++) {
        field_list list;
        mesh m;
        space s;
        static uint8_t couple[600][600];

        make(&m, &list, 2 + k / 2, k % 2, k == 0);
        assert_int_equal(space_number(&s, &list, &m, 0, &err), 0);
        for (int64_t d = 0; d < s.n_dof; d += 7)
            s.fixed[d] = 1;
        assert_int_equal(space_constrain(&s, &err), 0);
        assert_true(s.n_free < 600);
        memset(couple, 0, sizeof couple);
        for (int64_t e = 0; e < m.n_cell; e++)
            for (int64_t i = 0; i < s.n_free; i++)
                for (int64_t j = 0; j < s.n_free; j++) {
                    int has_i = 0, has_j = 0;

                    for (int c = 0; c < s.cell_carriers; c++) {
                        has_i |= s.dof_node[s.dof_of[i]] == space_carrier(&s, e, c);
                        has_j |= s.dof_node[s.dof_of[j]] == space_carrier(&s, e, c);
                    }
                    couple[i][j] |= has_i && has_j;
                }
        for (int64_t i = 0; i < s.n_free; i++) {
            int64_t n = 0;

            for (int64_t j = 0; j < s.n_free; j++)
                n += couple[i][j];
            assert_int_equal(n, s.row[i + 1] - s.row[i]);
            for (int64_t e = s.row[i]; e < s.row[i + 1]; e++) {
                assert_true(couple[i][space_column(&s, i, e)]);
                assert_true(e == s.row[i] || space_column(&s, i, e) > space_column(&s, i, e - 1));
            }
        }
        space_destroy(&s);
        mesh_destroy(&m);
    }
}

static void two_plugins_must_agree_on_a_field(void **state)
{
    const pf_field other = {.name = "u", .shape = PF_SCALAR, .order = 2};
    error err;
    field_list list;
    mesh m;

    (void)state;
    make(&m, &list, 2, 0, 0);
    assert_int_equal(fields_add(&list, 2, &velocity, "second", &err), 0);
    assert_int_equal(list.n, 2);
    assert_int_equal(fields_add(&list, 2, &other, "second", &err), ERR_PLUGIN);
    assert_non_null(strstr(err.text, "second"));
    mesh_destroy(&m);
}

static void points_are_found_and_quadratics_interpolated_exactly(void **state)
{
    error err;

    (void)state;
    for (int k = 0; k < 4; k++) {
        field_list list;
        mesh m;
        space s;
        cell_grid grid;
        double x[3000], at[3] = {0.313, 0.742, 0.391};
        int dim = 2 + k / 2;
        located l;
        double v[3], g[9], value = at[0] * at[0] - 2 * at[0] * at[1] + 1;

        make(&m, &list, dim, k % 2, 0);
        assert_int_equal(space_number(&s, &list, &m, 0, &err), 0);
        assert_true(s.n_dof < 3000);
        for (int64_t i = 0; i < m.n_node; i++)
            x[s.first[0][i]] = m.x[i * dim] * m.x[i * dim] - 2 * m.x[i * dim] * m.x[i * dim + 1] + 1;
        assert_int_equal(cell_grid_create(&grid, &m, &err), 0);
        l = locate_point(&m, &grid, at);
        assert_true(l.cell >= 0);
        locate_value(&s, &l, 0, x, v, g);
        assert_true(fabs(v[0] - value) < 1e-13);
        assert_true(fabs(g[0] - 2 * at[0] + 2 * at[1]) < 1e-12);
        assert_true(fabs(g[1] + 2 * at[0]) < 1e-12);
        at[0] = 1.5;
        assert_true(locate_point(&m, &grid, at).cell < 0);
        cell_grid_destroy(&grid);
        space_destroy(&s);
        mesh_destroy(&m);
    }
}

/* Sides of cells that bulge far beyond the box of their nodes, the middle ones away from the crest. */
static void bulge(mesh *m)
{
    error err;

    for (int64_t i = 0; i < m->n_node; i++) {
        double *x = m->x + i * m->dim, y = x[1], z = m->dim == 3 ? x[2] : 0.5;

        x[0] += 0.25 * y * (1 - y) * (1 + y + z * (1 - z));
        x[1] += 0.1 * x[0] * x[0] * (1 - z);
    }
    assert_int_equal(mesh_measure(m, &err), 0);
}

/* Whatever place a curved cell has is found in it, or in a neighbour on their common facet. */
static void places_in_curved_cells_are_found(void **state)
{
    error err;

    (void)state;
    for (int t = 0; t < 4; t++) {
        int dim = 2 + t / 2;
        field_list list;
        cell_grid grid;
        mesh m;

        make(&m, &list, dim, t % 2, 0);
        bulge(&m);
        assert_int_equal(cell_grid_create(&grid, &m, &err), 0);
        for (int64_t e = 0; e < m.n_cell; e++)
            for (int q = 0; q < 7 * 7 * 7; q++) {
                double xi[3] = {q % 7 / 6.0, q / 7 % 7 / 6.0, q / 49 / 6.0}, x[3], at[3], j[3][3];
                located l;

                if (m.type->simplex) {
                    xi[2] *= dim - 2;
                    xi[1] *= 1 - xi[2];
                    xi[0] *= 1 - xi[1] - xi[2];
                }
                for (int k = 0; k < 3; k++)
                    xi[k] = k >= dim ? 0 : m.type->simplex ? xi[k] : 2 * xi[k] - 1;
                mesh_place(&m, e, xi, x, j);
                l = locate_point(&m, &grid, x);
                if (l.cell < 0)
                    fail_msg("%s: (%g, %g, %g) is not found", m.type->name, x[0], x[1], x[2]);
                assert_true(l.cell <= e);
                mesh_place(&m, l.cell, l.xi, at, j);
                for (int k = 0; k < dim; k++)
                    assert_true(fabs(at[k] - x[k]) < 1e-12);
            }
        cell_grid_destroy(&grid);
        mesh_destroy(&m);
    }
}

/* Value, gradient, place and volume element of fields of each order in curved cells, against differences. */
static void fields_are_evaluated_anywhere_in_a_cell(void **state)
{
    const double h = 1e-6;
    error err;

    (void)state;
    for (int t = 0; t < 4; t++) {
        int dim = 2 + t / 2;
        field_list list;
        mesh m;
        space s;
        double x[3000];

        make(&m, &list, dim, t % 2, 1);
        bulge(&m);
        assert_int_equal(space_number(&s, &list, &m, 0, &err), 0);
        for (int64_t d = 0; d < s.n_dof; d++)
            x[d] = sin(1.3 * (double)d);
        for (int f = 0; f < s.n_field; f++) {
            int n = s.field[f].n_comp;
            double xi[3] = {0.21, 0.34, dim == 3 ? 0.17 : 0}, v[3], g[9], place[3], det, j[3][3], only[3];

            space_evaluate(&s, f, x, 3, xi, &(point_values){v, g, place, &det});
            space_evaluate(&s, f, x, 3, xi, &(point_values){.value = only});
            assert_memory_equal(v, only, (size_t)n * sizeof *v);
            assert_true(det == mesh_place(&m, 3, xi, only, j));
            assert_memory_equal(place, only, sizeof place);
            for (int b = 0; b < dim; b++) { /* dv/dxi = dv/dx dx/dxi */
                double high[3], low[3], to[3] = {xi[0], xi[1], xi[2]};

                to[b] += h;
                space_evaluate(&s, f, x, 3, to, &(point_values){.value = high});
                to[b] -= 2 * h;
                space_evaluate(&s, f, x, 3, to, &(point_values){.value = low});
                for (int a = 0; a < n; a++) {
                    double slope = 0;

                    for (int k = 0; k < dim; k++)
                        slope += g[a * dim + k] * j[k][b];
                    assert_true(fabs(slope - (high[a] - low[a]) / (2 * h)) < 1e-8);
                }
            }
        }
        space_destroy(&s);
        mesh_destroy(&m);
    }
}

/* A field of the bodies is nowhere in a cell: no memory before the unknowns is read for it. */
static void a_field_of_particles_has_no_value_in_a_cell(void **state)
{
    static const pf_field motion = {.name = "U", .shape = PF_VECTOR, .support = PF_ON_PARTICLE};
    double x[200] = {0}, v[3] = {0};
    error err;
    field_list list;
    mesh m;
    space s;

    (void)state;
    make(&m, &list, 2, 0, 0);
    assert_int_equal(fields_add(&list, 2, &motion, "test", &err), 0);
    assert_int_equal(space_number(&s, &list, &m, 1, &err), 0);
    assert_true(s.n_dof < 200);
    space_evaluate(&s, 2, x, 0, (double[3]){0}, &(point_values){.value = v});
    assert_true(isnan(v[0]) && isnan(v[1]));
    space_destroy(&s);
    mesh_destroy(&m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(unknowns_are_counted_and_interleaved_by_node),
        cmocka_unit_test(pattern_matches_brute_force),
        cmocka_unit_test(two_plugins_must_agree_on_a_field),
        cmocka_unit_test(points_are_found_and_quadratics_interpolated_exactly),
        cmocka_unit_test(places_in_curved_cells_are_found),
        cmocka_unit_test(fields_are_evaluated_anywhere_in_a_cell),
        cmocka_unit_test(a_field_of_particles_has_no_value_in_a_cell),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
