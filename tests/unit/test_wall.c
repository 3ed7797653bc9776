/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Distances from walls: of boxes, where they are exact, and of round walls of curved facets. */
#include "mesh/wall.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 8 };

typedef void map_fn(double *x);

static mesh make(int dim, int simplex, const int *n, map_fn *map)
{
    mesh_box b = {.dim = dim, .simplex = simplex, .high = {1, 1, 1}, .n = {n[0], n[1], dim == 3 ? n[2] : 1}};
    error err;
    mesh m;

    assert_int_equal(mesh_create_box(&b, &m, &err), 0);
    for (int64_t i = 0; map && i < m.n_node; i++) {
        double x[3] = {m.x[i * dim], m.x[i * dim + 1], dim == 3 ? m.x[i * dim + 2] : 0};

        map(x);
        memcpy(m.x + i * dim, x, (size_t)dim * sizeof *x);
    }
    assert_int_equal(mesh_measure(&m, &err), 0);
    return m;
}

/* All facets whose names are among the bits. */
static wall wall_of(const mesh *m, unsigned names)
{
    uint8_t *on = calloc((size_t)m->n_facet, 1);
    error err;
    wall w;

    for (int64_t i = 0; i < m->n_facet; i++)
        on[i] = (m->facet[i].names & names) != 0;
    assert_int_equal(wall_create(&w, m, on, &err), 0);
    free(on);
    return w;
}

static int near(const wall *w, const double *x, double range, wall_point *list)
{
    error err;
    int n;

    assert_int_equal(wall_near(w, x, range, MOST, list, &n, &err), 0);
    for (int i = 0; i < n; i++) { /* what is said of every point */
        double size = 0;

        assert_true(fabs(list[i].distance) <= range);
        assert_true(i == 0 || fabs(list[i].distance) >= fabs(list[i - 1].distance));
        for (int k = 0; k < w->mesh->dim; k++) {
            size += list[i].normal[k] * list[i].normal[k];
            assert_true(fabs(x[k] - list[i].x[k] - list[i].distance * list[i].normal[k]) < 1e-9);
        }
        assert_true(fabs(size - 1) < 1e-12);
    }
    return n;
}

/* --- boxes --- */

/* A place anywhere in the unit box: every side within range is one wall, exactly as far as it is. */
static void every_side_of_a_box_is_one_wall(void **state)
{
    static const double x[][3] = {{0.5, 0.5, 0.5},      {0.1, 0.2, 0.3},   {0.93, 0.11, 0.37},
                                  {0.25, 0.5, 1 / 3.0}, {0.75, 0.75, 0.6}, {1e-9, 0.4, 0.7}};
    static const double range[] = {0.05, 0.22, 0.45, 2};
    static const int n[3] = {8, 6, 5};

    (void)state;
    for (int t = 0; t < 4; t++) {
        int dim = 2 + t / 2;
        mesh m = make(dim, t % 2, n, NULL);
        wall w = wall_of(&m, ~0u);

        for (int i = 0; i < 6 * 4; i++) {
            const double *at = x[i / 4], r = range[i % 4];
            wall_point list[MOST];
            int found = near(&w, at, r, list), expected = 0;

            for (int side = 0; side < 2 * dim; side++) {
                double d = side % 2 ? 1 - at[side / 2] : at[side / 2];
                int here = -1;

                if (d > r)
                    continue;
                expected++;
                for (int k = 0; k < found; k++)
                    here = list[k].boundary == side ? k : here;
                if (here < 0)
                    fail_msg("%s, (%g, %g, %g), range %g: side %d at %g is not among %d walls", m.type->name, at[0],
                             at[1], at[2], r, side, d, found);
                assert_true(fabs(list[here].distance - d) < 1e-14);
                assert_true(fabs(list[here].normal[side / 2] - (side % 2 ? -1 : 1)) < 1e-14);
                assert_true(m.facet[list[here].facet].names >> side & 1);
            }
            assert_int_equal(found, expected);
        }
        wall_destroy(&w);
        mesh_destroy(&m);
    }
}

/* Only the facets that were asked for are walls; no place has more of them than there is room for. */
static void only_chosen_facets_are_walls(void **state)
{
    static const int n[3] = {4, 4, 4};

    (void)state;
    for (int dim = 2; dim <= 3; dim++) {
        mesh m = make(dim, 0, n, NULL);
        wall bottom = wall_of(&m, 1u << 2), none = wall_of(&m, 0), all = wall_of(&m, ~0u);
        wall_point list[MOST];
        const double x[3] = {0.01, 0.3, 0.01};
        error err;
        int found;

        assert_int_equal(near(&bottom, x, 5, list), 1);
        assert_true(fabs(list[0].distance - 0.3) < 1e-14 && list[0].boundary == 2);
        assert_int_equal(near(&bottom, x, 0.29, list), 0);
        assert_int_equal(near(&none, x, 5, list), 0);
        assert_int_equal(wall_near(&all, x, 5, 2, list, &found, &err), 0);
        assert_int_equal(found, 2);
        assert_true(fabs(list[0].distance - 0.01) < 1e-14);
        wall_destroy(&bottom);
        wall_destroy(&none);
        wall_destroy(&all);
        mesh_destroy(&m);
    }
}

/* A body that went through a wall is told so: the distance is negative, the way back is the normal. */
static void a_place_behind_a_wall_has_a_negative_distance(void **state)
{
    static const int n[3] = {4, 4, 4};

    (void)state;
    for (int t = 0; t < 4; t++) {
        int dim = 2 + t / 2;
        mesh m = make(dim, t % 2, n, NULL);
        wall w = wall_of(&m, ~0u);
        wall_point list[MOST];
        const double out[3] = {-0.1, 0.52, 0.55}, corner[3] = {-0.03, 1.04, 0.5};

        assert_int_equal(near(&w, out, 0.2, list), 1);
        assert_true(fabs(list[0].distance + 0.1) < 1e-14 && fabs(list[0].normal[0] - 1) < 1e-14);
        assert_int_equal(near(&w, corner, 0.2, list), 1);
        assert_true(fabs(list[0].distance + 0.05) < 1e-14);
        assert_true(fabs(list[0].normal[0] - 0.6) < 1e-12 && fabs(list[0].normal[1] + 0.8) < 1e-12);
        wall_destroy(&w);
        mesh_destroy(&m);
    }
}

/* --- an edge that sticks out into the fluid --- */

/* The unit square opened up round the middle of its lower side, from half a turn to three quarters: a wedge of
 * solid, its tip at (0.5, 0), points up into the fluid. */
static void round_a_wedge(double *x)
{
    double r = fmax(fabs(x[0] - 0.5), x[1]), s; /* the square's rings become rings of the wedge */

    if (r == 0)
        return;
    s = x[1] < r ? x[1] / r : 2 - (x[0] - 0.5) / r; /* 0 .. 1 .. 3 .. 4, once round */
    s = x[1] < r && x[0] < 0.5 ? 4 - x[1] / r : s;
    s = x[1] < r && x[0] > 0.5 ? x[1] / r : s;
    s = M_PI * (s / 4 * 1.5 - 0.25); /* from -45 to 225 degrees */
    x[0] = 0.5 + r * cos(s);
    x[1] = r * sin(s);
}

static void a_wall_that_sticks_out_is_met_at_its_edge(void **state)
{
    static const int n[3] = {8, 4, 3};

    (void)state;
    for (int t = 0; t < 4; t += 2) {
        int dim = 2 + t / 2;
        mesh m = make(dim, t % 2, n, round_a_wedge);
        wall w = wall_of(&m, 1u << 2);
        wall_point list[MOST];

        for (int i = -2; i <= 2; i++) { /* above the tip: the tip itself, seen along the line to it */
            double a = M_PI / 2 + 0.3 * i, x[3] = {0.5 + 0.2 * cos(a), 0.2 * sin(a), 0.55};

            assert_int_equal(near(&w, x, 0.3, list), 1);
            assert_true(fabs(list[0].distance - 0.2) < 1e-12);
            assert_true(fabs(list[0].normal[0] - cos(a)) < 1e-9 && fabs(list[0].normal[1] - sin(a)) < 1e-9);
        }
        wall_destroy(&w);
        mesh_destroy(&m);
    }
}

/* --- round walls --- */

static void annulus(double *x)
{
    double r = 1 + x[1], a = -2 * M_PI * x[0];

    x[0] = r * cos(a);
    x[1] = r * sin(a);
}

/* Bottom: a ring of radius 1, top: one of radius 2, open nowhere but along a seam of the mesh that is no wall; in
 * 3D the same between spheres, a part of them round the x axis, like a map of the world. */
static void shell(double *x)
{
    double r = 1 + x[1], a = 0.9 * (1 - 2 * x[0]), b = 0.9 * (2 * x[2] - 1);

    x[0] = r * cos(a) * cos(b);
    x[1] = r * sin(a) * cos(b);
    x[2] = r * sin(b);
}

/* Largest error of the distance from both walls over places between them, with n cells round. */
static double round_error(int dim, int simplex, int n)
{
    const int cells[3] = {n, 3, n};
    mesh m = make(dim, simplex, cells, dim == 2 ? annulus : shell);
    wall w = wall_of(&m, 3u << 2);
    double worst = 0;

    for (int i = 0; i < 40; i++) {
        double r = 1.05 + 0.9 * i / 39, a = dim == 2 ? 2.4 * i : 0.6 * sin(2.4 * i),
               b = dim == 2 ? 0 : 0.5 * sin(1.7 * i);
        double x[3] = {r * cos(a) * cos(b), r * sin(a) * cos(b), r * sin(b)};
        wall_point list[MOST];
        int inner = r < 1.5 ? 0 : 1; /* which is nearer */

        if (near(&w, x, 0.99, list) != 2)
            fail_msg("%dD, %d cells: a place at radius %g is not between two walls", dim, n, r);
        assert_int_equal(list[inner].boundary, 2);
        assert_int_equal(list[1 - inner].boundary, 3);
        worst = fmax(worst, fabs(list[inner].distance - (r - 1)));
        worst = fmax(worst, fabs(list[1 - inner].distance - (2 - r)));
        for (int k = 0; k < dim; k++) {
            assert_true(fabs(list[inner].normal[k] - x[k] / r) < 0.05);
            assert_true(fabs(list[1 - inner].normal[k] + x[k] / r) < 0.05);
        }
    }
    wall_destroy(&w);
    mesh_destroy(&m);
    return worst;
}

/* Facets of second order: the distance converges like h^4 where their middle nodes lie in the middle of the arcs,
 * on triangles of a sphere like h^3. */
static void distances_from_round_walls_converge_with_the_facets(void **state)
{
    (void)state;
    for (int t = 0; t < 4; t++) {
        int dim = 2 + t / 2, n = dim == 2 ? 32 : 12;
        double coarse = round_error(dim, t % 2, n), fine = round_error(dim, t % 2, 2 * n);

        print_message("# %dD, %s: %.1e, %.1e\n", dim, t % 2 ? "simplices" : "boxes", coarse, fine);
        assert_true(log2(coarse / fine) > (t == 3 ? 2.9 : 3.5));
        assert_true(fine < (dim == 2 ? 1e-6 : 1e-5));
    }
}

/* The nearest point is that which a look at very many points of all facets finds. */
static void no_point_of_the_walls_is_nearer_than_the_nearest(void **state)
{
    static const int cells[3] = {5, 2, 5};
    enum { N = 60 };

    (void)state;
    for (int t = 0; t < 4; t++) {
        int dim = 2 + t / 2;
        mesh m = make(dim, t % 2, cells, dim == 2 ? annulus : shell);
        wall w = wall_of(&m, ~0u);

        for (int i = 0; i < 12; i++) {
            double x[3] = {1.5 * cos(0.6 * i) + 0.2 * sin(3 * i), 1.3 * sin(0.6 * i), 0.8 * cos(1.1 * i)},
                   least = 1e9;
            wall_point list[MOST];

            for (int64_t f = 0; f < w.n; f++)
                for (int q = 0; q < (N + 1) * (dim == 3 ? N + 1 : 1); q++) {
                    const facet *g = &w.facet[f];
                    double u = q % (N + 1) / (double)N, v = q / (N + 1) / (double)N, s[2], d = 0;

                    s[0] = g->kind == FACET_TRIANGLE ? u * (1 - v) : 2 * u - 1;
                    s[1] = g->kind == FACET_TRIANGLE ? v : g->kind == FACET_QUAD ? 2 * v - 1 : 0;
                    for (int k = 0; k < dim; k++) {
                        double at = 0;

                        for (int a = 0; a < 3; a++)
                            for (int b = 0; b < 3; b++)
                                at += g->c[k][a][b] * pow(s[0], a) * pow(s[1], b);
                        d += (at - x[k]) * (at - x[k]);
                    }
                    least = fmin(least, sqrt(d));
                }
            assert_true(near(&w, x, 10, list) > 0);
            assert_true(fabs(list[0].distance) < least + 1e-12);
            assert_true(fabs(list[0].distance) > least - 2e-3);
        }
        wall_destroy(&w);
        mesh_destroy(&m);
    }
}

/* A wall goes on through a periodic boundary: no end of it is a wall of its own, and what is near on the other side
 * is found. */
static void a_wall_goes_on_through_a_periodic_boundary(void **state)
{
    static const int n[3] = {6, 4, 3};
    error err;

    (void)state;
    for (int t = 0; t < 4; t++) {
        int dim = 2 + t / 2;
        mesh m = make(dim, t % 2, n, NULL);
        wall_point list[MOST];
        wall w;

        assert_int_equal(mesh_make_periodic(&m, 0, 1, &err), 0);
        w = wall_of(&m, 1u << 2);
        for (int i = 0; i < 5; i++) {
            const double x[3] = {(double[]){-0.2, 0, 0.01, 0.97, 1.1}[i], 0.3, 0.5};

            assert_int_equal(near(&w, x, 0.9, list), 1);
            assert_true(fabs(list[0].distance - 0.3) < 1e-12 && fabs(list[0].normal[1] - 1) < 1e-12);
            assert_true(fabs(list[0].x[0] - x[0]) < 1e-12);
        }
        wall_destroy(&w);
        mesh_destroy(&m);
    }
}

/* A thin plate of solid across a slit mesh: bent by the map, the fluid comes round to its other side.  A body in
 * front of one side does not meet the other, which it is behind of. */
static void round_a_plate(double *x)
{
    double r = 0.02 + 0.98 * x[1], a = -2 * M_PI * x[0];

    x[0] = cosh(1.2 * r) * cos(a); /* confocal ellipses round a plate from -1 to 1 */
    x[1] = sinh(1.2 * r) * sin(a);
}

static void the_far_side_of_a_plate_is_no_wall(void **state)
{
    static const int n[3] = {64, 8, 1};

    (void)state;
    for (int simplex = 0; simplex < 2; simplex++) {
        mesh m = make(2, simplex, n, round_a_plate);
        wall w = wall_of(&m, 1u << 2);
        wall_point list[MOST];

        for (int side = -1; side <= 1; side += 2)
            for (int i = -3; i <= 3; i++) {
                const double x[2] = {0.1 * i, side * 0.3};

                assert_int_equal(near(&w, x, 0.5, list), 1);
                assert_true(fabs(list[0].distance - 0.3) < 0.03 && fabs(list[0].normal[1] - side) < 0.01);
            }
        wall_destroy(&w);
        mesh_destroy(&m);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_side_of_a_box_is_one_wall),
        cmocka_unit_test(only_chosen_facets_are_walls),
        cmocka_unit_test(a_place_behind_a_wall_has_a_negative_distance),
        cmocka_unit_test(a_wall_that_sticks_out_is_met_at_its_edge),
        cmocka_unit_test(distances_from_round_walls_converge_with_the_facets),
        cmocka_unit_test(no_point_of_the_walls_is_nearer_than_the_nearest),
        cmocka_unit_test(a_wall_goes_on_through_a_periodic_boundary),
        cmocka_unit_test(the_far_side_of_a_plate_is_no_wall),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
