/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Box meshes, periodic nodes, inverted cells. */
#include "mesh/mesh.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <string.h>

static mesh_box box(int dim, int simplex)
{
    return (mesh_box){.dim = dim, .simplex = simplex, .low = {0, 1, -1}, .high = {2, 2, 3}, .n = {3, 2, 2}};
}

static void box_meshes_fill_the_box(void **state)
{
    error err;

    (void)state;
    for (int k = 0; k < 4; k++) {
        mesh_box b = box(2 + k / 2, k % 2);
        mesh m;
        double volume = 0;

        assert_int_equal(mesh_create_box(&b, &m, &err), 0);
        assert_int_equal(mesh_measure(&m, &err), 0);
        for (int64_t e = 0; e < m.n_cell; e++)
            volume += pow(m.h[e], m.dim);
        assert_true(fabs(volume - (m.dim == 2 ? 2 : 8)) < 1e-13);
        mesh_destroy(&m);
    }
}

/* Every inner facet belongs to two cells with the same nodes: as many vertex sets occur twice as there should be.
 */
static void neighbours_share_all_nodes_of_their_facet(void **state)
{
    error err;

    (void)state;
    for (int k = 0; k < 4; k++) {
        mesh_box b = box(2 + k / 2, k % 2);
        mesh m;
        int64_t single = 0, n;
        const fe_cell *c;

        assert_int_equal(mesh_create_box(&b, &m, &err), 0);
        c = m.type;
        n = m.n_cell * c->n_facet;
        for (int64_t i = 0; i < n; i++) {
            int twins = 0;

            for (int64_t j = 0; j < n; j++) {
                int common = 0;

                for (int p = 0; p < c->facet_nodes; p++)
                    for (int q = 0; q < c->facet_nodes; q++)
                        common += m.cell[i / c->n_facet * c->n_node + c->facet[i % c->n_facet][p]] ==
                                  m.cell[j / c->n_facet * c->n_node + c->facet[j % c->n_facet][q]];
                twins += i != j && common == c->facet_nodes;
            }
            assert_true(twins <= 1);
            single += twins == 0;
        }
        assert_int_equal(single, m.n_facet);
        mesh_destroy(&m);
    }
}

static void grid_lines_are_kept(void **state)
{
    const double x[] = {0, 0.1, 0.5, 2};
    mesh_box b = box(2, 0);
    error err;
    mesh m;

    (void)state;
    b.ticks[0] = x;
    assert_int_equal(mesh_create_box(&b, &m, &err), 0);
    for (int i = 0; i < 7; i++)
        assert_true(fabs(m.x[2 * i] - (i % 2 ? 0.5 * (x[i / 2] + x[i / 2 + 1]) : x[i / 2])) < 1e-15);
    mesh_destroy(&m);
}

static void periodic_faces_carry_their_mid_nodes(void **state)
{
    error err;

    (void)state;
    for (int k = 0; k < 4; k++) {
        mesh_box b = box(2 + k / 2, k % 2);
        mesh m;
        int64_t merged = 0;

        assert_int_equal(mesh_create_box(&b, &m, &err), 0);
        assert_int_equal(mesh_make_periodic(&m, mesh_find_name(&m, "left"), mesh_find_name(&m, "right"), &err), 0);
        for (int64_t i = 0; i < m.n_node; i++)
            merged += m.master[i] != i;
        assert_int_equal(merged, m.dim == 2 ? 5 : 25); /* (2 n_y + 1) (2 n_z + 1) */
        mesh_destroy(&m);
    }
}

static void periodic_faces_that_do_not_match_are_refused(void **state)
{
    mesh_box b = box(2, 0);
    error err;
    mesh m;

    (void)state;
    assert_int_equal(mesh_create_box(&b, &m, &err), 0);
    assert_int_equal(mesh_make_periodic(&m, mesh_find_name(&m, "left"), mesh_find_name(&m, "top"), &err), ERR_MESH);
    assert_non_null(strstr(err.text, "do not match"));
    mesh_destroy(&m);
}

static void an_inverted_cell_is_named_with_its_place(void **state)
{
    mesh_box b = box(2, 0);
    error err;
    mesh m;

    (void)state;
    assert_int_equal(mesh_create_box(&b, &m, &err), 0);
    m.x[2 * 2] = -3; /* a vertex to the far side of its cell */
    assert_int_equal(mesh_measure(&m, &err), ERR_MESH);
    assert_non_null(strstr(err.text, "inverted"));
    assert_non_null(strstr(err.text, "near ("));
    mesh_destroy(&m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(box_meshes_fill_the_box),
        cmocka_unit_test(neighbours_share_all_nodes_of_their_facet),
        cmocka_unit_test(grid_lines_are_kept),
        cmocka_unit_test(periodic_faces_carry_their_mid_nodes),
        cmocka_unit_test(periodic_faces_that_do_not_match_are_refused),
        cmocka_unit_test(an_inverted_cell_is_named_with_its_place),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
