/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Box meshes, periodic nodes, inverted cells. */
#include "mesh/mesh.h"

#include <plugflow/mesh.h>

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

/* Nodes of both sides off by round-off, where that is most of a difference: halfway between two multiples of the
 * tolerance. */
static void periodic_faces_match_though_their_nodes_are_rounded_differently(void **state)
{
    mesh_box b = {.dim = 3, .high = {1, 1, 1}, .n = {2, 64, 3}};
    unsigned seed = 7;
    error err;
    mesh m;

    (void)state;
    assert_int_equal(mesh_create_box(&b, &m, &err), 0);
    for (int64_t i = 0; i < 3 * m.n_node; i++) {
        seed = seed * 1664525u + 1013904223u;
        m.x[i] += 1e-12 * (seed / 4294967296.0 - 0.5);
    }
    if (mesh_make_periodic(&m, mesh_find_name(&m, "left"), mesh_find_name(&m, "right"), &err))
        fail_msg("%s", err.text);
    for (int64_t i = 0; i < m.n_node; i++) {
        double *x = m.x + 3 * i, *y = m.x + 3 * m.master[i];

        assert_true(m.master[m.master[i]] == m.master[i]);
        assert_int_equal(m.master[i] != i, x[0] > 1 - 1e-6);
        assert_true(fabs(x[1] - y[1]) < 1e-11 && fabs(x[2] - y[2]) < 1e-11);
    }
    mesh_destroy(&m);
}

static void places_go_round_with_the_period(void **state)
{
    mesh_box b = box(3, 0);
    double x[3] = {4.5, 1.5, -2}, d[3] = {1.8, 0.1, -3.9}, shift[MESH_MAX_IMAGES][3];
    error err;
    mesh m;

    (void)state;
    assert_int_equal(mesh_create_box(&b, &m, &err), 0);
    assert_int_equal(mesh_images(&m, shift), 1);
    assert_int_equal(mesh_make_periodic(&m, mesh_find_name(&m, "left"), mesh_find_name(&m, "right"), &err), 0);
    assert_int_equal(mesh_images(&m, shift), 3);
    assert_int_equal(mesh_make_periodic(&m, mesh_find_name(&m, "back"), mesh_find_name(&m, "front"), &err), 0);
    assert_int_equal(mesh_images(&m, shift), 9);
    assert_true(shift[0][0] == 0 && shift[0][1] == 0 && shift[0][2] == 0);
    for (int i = 0; i < 9; i++)
        for (int k = 0; k < i; k++)
            assert_true(fabs(shift[i][0] - shift[k][0]) + fabs(shift[i][2] - shift[k][2]) > 1.99);
    mesh_wrap(&m, x);
    assert_true(fabs(x[0] - 0.5) < 1e-14 && x[1] == 1.5 && fabs(x[2] - 2) < 1e-14);
    mesh_nearest(&m, d);
    assert_true(fabs(d[0] + 0.2) < 1e-14 && d[1] == 0.1 && fabs(d[2] - 0.1) < 1e-14);
    mesh_destroy(&m);
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
    m.x[2] += 1e-3; /* a middle node of the bottom */
    assert_int_equal(mesh_make_periodic(&m, mesh_find_name(&m, "bottom"), mesh_find_name(&m, "top"), &err),
                     ERR_MESH);
    assert_non_null(strstr(err.text, "at (0.334333, 1)"));
    mesh_destroy(&m);
}

/* Two triangles of a square, as a reader would return them. */
typedef struct square {
    double x[9 * 2];
    int64_t cell[12], facet[4];
    int32_t facet_name[2];
    const char *name[2];
    pf_mesh_data data;
} square;

static void make_square(square *s)
{
    static const double x[] = {0, 0, 1, 0, 1, 1, 0, 1, .5, 0, 1, .5, .5, 1, 0, .5, .5, .5};
    static const double reference[] = {0, 0, 1, 0, 0, 1, .5, 0, .5, .5, 0, .5};
    static const int64_t cell[] = {0, 1, 2, 4, 5, 8, 0, 2, 3, 8, 6, 7}, facet[] = {0, 1, 2, 1};

    *s = (square){.facet_name = {0, 1}, .name = {"floor", "side"}};
    memcpy(s->x, x, sizeof x);
    memcpy(s->cell, cell, sizeof cell);
    memcpy(s->facet, facet, sizeof facet);
    s->data = (pf_mesh_data){.size = sizeof s->data,
                             .dim = 2,
                             .type = PF_TRI6,
                             .n_node = 9,
                             .n_cell = 2,
                             .n_facet = 2,
                             .x = s->x,
                             .cell = s->cell,
                             .reference = reference,
                             .facet = s->facet,
                             .facet_vertices = 2,
                             .facet_name = s->facet_name,
                             .n_name = 2,
                             .name = s->name};
}

static void what_a_reader_returns_becomes_a_mesh(void **state)
{
    square s;
    error err;
    mesh m;

    (void)state;
    make_square(&s);
    assert_int_equal(mesh_create_from_data(&s.data, "file", &m, &err), 0);
    assert_int_equal(mesh_measure(&m, &err), 0);
    assert_int_equal(m.n_facet, 4);
    for (int64_t f = 0; f < 4; f++) {
        int64_t cell = m.facet[f].cell, middle = m.cell[6 * cell + m.type->facet[m.facet[f].local][2]];

        assert_int_equal(m.facet[f].names, middle == 4 ? 1 : middle == 5 ? 2 : 0);
    }
    mesh_destroy(&m);
}

static void refuse(square *s, const char *why)
{
    error err;
    mesh m;

    assert_int_equal(mesh_create_from_data(&s->data, "file", &m, &err), ERR_MESH);
    if (!strstr(err.text, why) || !strstr(err.text, "file"))
        fail_msg("\"%s\" does not say \"%s\"", err.text, why);
    mesh_destroy(&m);
    make_square(s);
}

static void nonsense_of_a_reader_is_refused(void **state)
{
    square s;

    (void)state;
    make_square(&s);
    s.data.type = 77;
    refuse(&s, "unknown cell type 77");
    s.data.n_cell = 0;
    refuse(&s, "at least one cell");
    s.data.n_node = (int64_t)1 << 33;
    refuse(&s, "at most");
    s.data.n_name = -1;
    refuse(&s, "-1 boundary names");
    s.data.facet_vertices = 9; /* more than a facet's key has room for */
    refuse(&s, "of 9 vertices");
    s.data.x = NULL;
    refuse(&s, "without arrays");
    s.x[5] = NAN;
    refuse(&s, "node 2");
    s.cell[3] = 9;
    refuse(&s, "cell 0 refers to node 9 of 9");
    s.facet[2] = ((int64_t)1 << 32) + 2; /* node 2 if it were cut to 32 bits */
    refuse(&s, "facet 1 refers to node 4294967298");
    s.facet_name[1] = 70;
    refuse(&s, "name number 70 of 2");
    s.facet[1] = 2;
    refuse(&s, "has a facet inside the mesh");
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
        cmocka_unit_test(periodic_faces_match_though_their_nodes_are_rounded_differently),
        cmocka_unit_test(places_go_round_with_the_period),
        cmocka_unit_test(periodic_faces_that_do_not_match_are_refused),
        cmocka_unit_test(what_a_reader_returns_becomes_a_mesh),
        cmocka_unit_test(nonsense_of_a_reader_is_refused),
        cmocka_unit_test(an_inverted_cell_is_named_with_its_place),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
