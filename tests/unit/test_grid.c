/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The search for cells near a point. */
#include "mesh/cell_grid.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void make(mesh *m, int dim, int simplex)
{
    mesh_box b = {.dim = dim, .simplex = simplex, .high = {1, 1, 1}, .n = {8, 7, 6}};
    error err;

    assert_int_equal(mesh_create_box(&b, m, &err), 0);
    assert_int_equal(mesh_measure(m, &err), 0);
}

/* Cells of a straight mesh whose box of vertices meets the ball. */
static int64_t look_at_all(const mesh *m, const double *x, double radius, int32_t *list)
{
    int64_t found = 0;

    for (int64_t e = 0; e < m->n_cell; e++) {
        double d2 = 0;

        for (int k = 0; k < m->dim; k++) {
            double low = INFINITY, high = -INFINITY, d;

            for (int i = 0; i < m->type->n_node; i++) {
                low = fmin(low, m->x[(int64_t)m->cell[e * m->type->n_node + i] * m->dim + k]);
                high = fmax(high, m->x[(int64_t)m->cell[e * m->type->n_node + i] * m->dim + k]);
            }
            d = fmax(0, fmax(low - x[k], x[k] - high));
            d2 += d * d;
        }
        if (d2 <= radius * radius)
            list[found++] = (int32_t)e;
    }
    return found;
}

/* Balls of all sizes, in the mesh, on its lines, and far outside: the same cells, each once, ascending. */
static void the_grid_finds_the_cells_that_a_look_at_all_finds(void **state)
{
    static const double radius[] = {0, 0.05, 0.19, 0.7, 5};
    static const double x[][3] = {
        {0.3, 0.6, 0.4}, {0.25, 3 / 7.0, 0.5}, {0, 0, 0}, {1.04, -0.03, 0.5}, {3, 0.5, -2}};
    error err;

    (void)state;
    for (int t = 0; t < 4; t++) {
        int32_t list[5000], expected[5000];
        cell_grid g;
        mesh m;

        make(&m, 2 + t / 2, t % 2);
        assert_true(m.n_cell < 5000);
        assert_int_equal(cell_grid_create(&g, &m, &err), 0);
        for (int i = 0; i < 25; i++) {
            int64_t n = cell_grid_ball(&g, x[i / 5], radius[i % 5], list);

            assert_int_equal(n, look_at_all(&m, x[i / 5], radius[i % 5], expected));
            assert_memory_equal(list, expected, (size_t)n * sizeof *list);
        }
        cell_grid_destroy(&g);
        mesh_destroy(&m);
    }
}

/* What cannot be a place finds nothing; a ball that holds all finds all; nothing is read outside of the grid. */
static void places_that_are_no_numbers_find_no_cell(void **state)
{
    static const double wild[] = {NAN, 1e300, -1e300, INFINITY, 4e9};
    int32_t list[5000];
    cell_grid g;
    error err;
    mesh m;

    (void)state;
    make(&m, 3, 0);
    assert_int_equal(cell_grid_create(&g, &m, &err), 0);
    for (int i = 0; i < 5; i++) {
        const double x[3] = {0.5, wild[i], 0.5};
        int64_t n;

        assert_int_equal(cell_grid_ball(&g, x, 0.1, list), 0);
        box_grid_at(&g, x, &n);
        assert_true(n > 0 && n < m.n_cell);
    }
    assert_int_equal(cell_grid_ball(&g, (double[3]){0.5, 0.5, 0.5}, 1e300, list), m.n_cell);
    cell_grid_destroy(&g);
    mesh_destroy(&m);
}

/* A long thin mesh, and one with one tiny cell in a large one: buckets stay as many as cells. */
static void buckets_do_not_outnumber_the_cells(void **state)
{
    const double fine[] = {0, 1e-6, 1};
    error err;

    (void)state;
    for (int dim = 2; dim <= 3; dim++) {
        mesh_box b = {.dim = dim, .high = {1, 1, 1}, .n = {2, 2, 2}, .ticks = {fine, fine, fine}};
        cell_grid g;
        mesh m;

        assert_int_equal(mesh_create_box(&b, &m, &err), 0);
        assert_int_equal(mesh_measure(&m, &err), 0);
        for (int64_t e = 0; e < m.n_cell; e++)
            m.h[e] = 1e-4; /* as if nearly all cells were small */
        assert_int_equal(cell_grid_create(&g, &m, &err), 0);
        assert_true((double)g.n[0] * g.n[1] * g.n[2] <= 4.0 * (double)m.n_cell + 64);
        cell_grid_destroy(&g);
        mesh_destroy(&m);
    }
}

/* A cell with a bulging side reaches beyond the box of its nodes, but not out of its own. */
static void the_box_of_a_curved_cell_holds_all_of_it(void **state)
{
    error err;

    (void)state;
    for (int t = 0; t < 4; t++) {
        int dim = 2 + t / 2, beyond = 0;
        mesh_box b = {.dim = dim, .simplex = t % 2, .high = {1, 1, 1}, .n = {1, 1, 1}};
        cell_grid g;
        mesh m;

        assert_int_equal(mesh_create_box(&b, &m, &err), 0);
        for (int64_t i = 0; i < m.n_node; i++) { /* sides like the middle of a sine wave, crest beside the nodes */
            double *x = m.x + i * dim, turn = 0.35;

            x[dim - 1] += 0.3 * (x[0] - 0.5) * (x[0] - turn);
            x[0] += 0.2 * x[1] * (x[1] - 0.8);
        }
        assert_int_equal(mesh_measure(&m, &err), 0);
        assert_int_equal(cell_grid_create(&g, &m, &err), 0);
        for (int64_t e = 0; e < m.n_cell; e++)
            for (int q = 0; q < 11 * 11 * 11; q++) {
                double xi[3] = {q % 11 / 10.0, q / 11 % 11 / 10.0, q / 121 / 10.0}, x[3], j[3][3];

                if (b.simplex) {
                    xi[2] *= dim - 2;
                    xi[1] *= 1 - xi[2];
                    xi[0] *= 1 - xi[1] - xi[2];
                }
                for (int k = 0; k < 3; k++)
                    xi[k] = k >= dim ? 0 : b.simplex ? xi[k] : 2 * xi[k] - 1;
                mesh_place(&m, e, xi, x, j);
                for (int k = 0; k < dim; k++) {
                    double low = INFINITY, high = -INFINITY;

                    for (int i = 0; i < m.type->n_node; i++) {
                        low = fmin(low, m.x[(int64_t)m.cell[e * m.type->n_node + i] * dim + k]);
                        high = fmax(high, m.x[(int64_t)m.cell[e * m.type->n_node + i] * dim + k]);
                    }
                    beyond += x[k] < low - 1e-9 || x[k] > high + 1e-9;
                    assert_true(x[k] >= g.box[e][0][k] - 1e-12 && x[k] <= g.box[e][1][k] + 1e-12);
                }
            }
        assert_true(beyond > 0);
        cell_grid_destroy(&g);
        mesh_destroy(&m);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_grid_finds_the_cells_that_a_look_at_all_finds),
        cmocka_unit_test(places_that_are_no_numbers_find_no_cell),
        cmocka_unit_test(buckets_do_not_outnumber_the_cells),
        cmocka_unit_test(the_box_of_a_curved_cell_holds_all_of_it),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
