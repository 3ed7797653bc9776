/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Shapes, poses, covered parts of cells. */
#include "particle/particle.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static arena memory; /* of the shapes; freed at the end */

static void make(mesh *m, int dim, int simplex)
{
    mesh_box b = {.dim = dim, .simplex = simplex, .high = {1, 1, 1}, .n = {8, 7, 6}};
    error err;

    assert_int_equal(mesh_create_box(&b, m, &err), 0);
    assert_int_equal(mesh_measure(m, &err), 0);
}

/* A shape and where it is. */
typedef struct body_at {
    shape shape;
    pose at;
} body_at;

static body_at body(int dim, int kind)
{
    body_at p = {.shape = {.kind = kind, .dim = dim, .half = {0.21, 0.13, 0.17}, .exponent = {4, 4}}};
    error err;

    p.at.x[0] = 0.47, p.at.x[1] = 0.52, p.at.x[2] = dim == 3 ? 0.49 : 0;
    p.at.angle = 0.4;
    p.at.q[0] = cos(0.3), p.at.q[1] = sin(0.3) * 0.6, p.at.q[3] = sin(0.3) * 0.8;
    assert_int_equal(shape_measure(&p.shape, &memory, &err), 0);
    return p;
}

/* Volume, first and second moments of the corrected weights, by an integration of its own. */
static void moments(const cut_rule *r, const mesh *m, const solid *p, const int32_t *cell, const double *w,
                    int64_t n, double *volume, double *first, double second[3][3])
{
    *volume = 0;
    memset(first, 0, 3 * sizeof *first);
    memset(second, 0, 9 * sizeof(double));
    for (int64_t i = 0; i < n; i++)
        for (int q = 0; q < r->n; q++) {
            double b[FE_MAX_NODES], db[FE_MAX_NODES][3], x[3] = {0};
            double v = w[i * r->n + q] * pow(m->h[cell[i]], m->dim) / m->type->measure;

            fe_basis(m->type, 2, r->x[q], b, db);
            for (int a = 0; a < m->type->n_node; a++)
                for (int k = 0; k < m->dim; k++)
                    x[k] += b[a] * m->x[(int64_t)m->cell[(int64_t)cell[i] * m->type->n_node + a] * m->dim + k];
            *volume += v;
            for (int k = 0; k < m->dim; k++) {
                first[k] += v * (x[k] - p->at.x[k]);
                for (int l = 0; l < m->dim; l++)
                    second[k][l] += v * (x[k] - p->at.x[k]) * (x[l] - p->at.x[l]);
            }
        }
}

typedef struct surface_sum {
    double area, flux, n[3];
    const solid *p;
} surface_sum;

static void sum_surface(void *ctx, const double *xi, const double *x, const double *nds)
{
    surface_sum *s = ctx;
    double size = 0;

    (void)xi;
    for (int k = 0; k < s->p->shape->dim; k++) {
        size += nds[k] * nds[k];
        s->n[k] += nds[k];
        s->flux += (x[k] - s->p->at.x[k]) * nds[k];
    }
    s->area += sqrt(size);
}

/* Ellipses and ellipsoids on cells of all kinds, before any correction: volume, area (perimeter by Gauss-Kummer,
 * spheroid by formula), closed surface, and Gauss's theorem, int n ds . r = dim V. */
static void volume_and_surface_of_smooth_bodies(void **state)
{
    static const double tolerance[4] = {1e-5, 1e-4, 1e-3, 1e-2};
    error err;

    (void)state;
    for (int t = 0; t < 4; t++) {
        int dim = 2 + t / 2;
        double a = 0.21, b = 0.13, e, area, volume = 0;
        body_at p = body(dim, SHAPE_ELLIPSOID);
        solid here;
        surface_sum s = {.p = &here};
        cut_rule r;
        mesh m;

        p.shape.half[2] = b;
        shape_measure(&p.shape, &memory, &err);
        e = sqrt(1 - b * b / (a * a));
        area = dim == 3 ? 2 * M_PI * b * b * (1 + a / (b * e) * asin(e)) : 0;
        for (int k = 0; dim == 2 && k < 1000; k++) /* trapezoidal rule: exact for a periodic integrand */
            area += 2 * M_PI / 1000 * hypot(a * sin(2 * M_PI * k / 1000), b * cos(2 * M_PI * k / 1000));
        here = solid_at(&p.shape, &p.at);
        make(&m, dim, t % 2);
        assert_int_equal(cut_rule_create(&r, m.type, &err), 0);
        for (int32_t c = 0; c < m.n_cell; c++) {
            double w[CUT_MAX_POINTS];
            enum cut_cover cover;

            assert_int_equal(cut_cell(&r, &m, c, s.p, w, sum_surface, &s, &cover, &err), 0);
            for (int q = 0; q < r.n; q++)
                volume += w[q] * pow(m.h[c], dim) / m.type->measure;
        }
        print_message("# %s: volume %.1e, area %.1e, closure %.1e, Gauss %.1e\n", m.type->name,
                      volume / p.shape.volume - 1, s.area / area - 1,
                      (fabs(s.n[0]) + fabs(s.n[1]) + fabs(s.n[2])) / area, s.flux / (dim * p.shape.volume) - 1);
        assert_true(fabs(volume / p.shape.volume - 1) < tolerance[t]);
        assert_true(fabs(s.area / area - 1) < tolerance[t]);
        assert_true(fabs(s.n[0]) + fabs(s.n[1]) + fabs(s.n[2]) < tolerance[t] * area);
        assert_true(fabs(s.flux / (dim * p.shape.volume) - 1) < tolerance[t]);
        cut_rule_destroy(&r);
        mesh_destroy(&m);
    }
}

/* Bodies with edges: the surface is all there and closed, in 2D and 3D, turned as it may be. */
static void surface_of_bodies_with_edges(void **state)
{
    static const int kinds[] = {SHAPE_BOX, SHAPE_CYLINDER};
    error err;

    (void)state;
    for (int dim = 2; dim <= 3; dim++)
        for (int k = 0; k < dim - 1; k++)
            for (int turned = 0; turned < 2; turned++) {
                body_at p = body(dim, kinds[k]);
                solid here;
                surface_sum s = {.p = &here};
                const double *h = p.shape.half;
                double area = dim == 2                ? 4 * (h[0] + h[1])
                              : kinds[k] == SHAPE_BOX ? 8 * (h[0] * h[1] + h[1] * h[2] + h[2] * h[0])
                                                      : 2 * M_PI * h[0] * (h[0] + 2 * h[2]);
                cut_rule r;
                mesh m;

                if (!turned) {
                    p.at.angle = p.at.q[1] = p.at.q[3] = 0;
                    p.at.q[0] = 1;
                }
                here = solid_at(&p.shape, &p.at);
                make(&m, dim, 0);
                assert_int_equal(cut_rule_create(&r, m.type, &err), 0);
                for (int32_t c = 0; c < m.n_cell; c++) {
                    double w[CUT_MAX_POINTS];
                    enum cut_cover cover;

                    assert_int_equal(cut_cell(&r, &m, c, s.p, w, sum_surface, &s, &cover, &err), 0);
                }
                print_message("# %s %d in %dD%s: area %.1e, closure %.1e\n", "kind", kinds[k], dim,
                              turned ? ", turned" : "", s.area / area - 1,
                              (fabs(s.n[0]) + fabs(s.n[1]) + fabs(s.n[2])) / area);
                assert_true(fabs(s.area / area - 1) < 0.03);
                assert_true(fabs(s.n[0]) + fabs(s.n[1]) + fabs(s.n[2]) < 0.02 * area);
                cut_rule_destroy(&r);
                mesh_destroy(&m);
            }
}

static void volume_centroid_and_inertia_are_exact(void **state)
{
    static const int kinds[] = {SHAPE_ELLIPSOID, SHAPE_BOX, SHAPE_CYLINDER, SHAPE_SUPERELLIPSOID};
    error err;

    (void)state;
    for (int t = 0; t < 4; t++)
        for (int k = 0; k < 4; k++) {
            int dim = 2 + t / 2;
            mesh m;
            cut_rule r;
            body_at p;
            solid here;
            double *w, volume, first[3], second[3][3], raw;
            double(*shift)[3];
            int32_t *cell;
            int64_t n = 0;

            if (kinds[k] == SHAPE_CYLINDER && dim == 2)
                continue;
            make(&m, dim, t % 2);
            p = body(dim, kinds[k]);
            here = solid_at(&p.shape, &p.at);
            assert_int_equal(cut_rule_create(&r, m.type, &err), 0);
            w = malloc((size_t)(m.n_cell * r.n) * sizeof *w);
            cell = malloc((size_t)m.n_cell * sizeof *cell);
            shift = calloc((size_t)m.n_cell, sizeof *shift);
            for (int32_t e = 0; e < m.n_cell; e++) {
                enum cut_cover cover;

                assert_int_equal(cut_cell(&r, &m, e, &here, w + n * r.n, NULL, NULL, &cover, &err), 0);
                if (cover != CUT_NONE)
                    cell[n++] = e;
            }
            moments(&r, &m, &here, cell, w, n, &raw, first, second);
            assert_true(fabs(raw / p.shape.volume - 1) < 0.02); /* the cut itself is near */
            assert_int_equal(cut_correct(&r, &m, &here, cell, (const double(*)[3])shift, w, n, 1, &err), 0);
            moments(&r, &m, &here, cell, w, n, &volume, first, second);
            assert_true(fabs(volume / p.shape.volume - 1) < 1e-12);
            for (int i = 0; i < dim; i++) {
                assert_true(fabs(first[i]) < 1e-12 * p.shape.volume);
                for (int j = 0; j < dim; j++) {
                    double exact = 0;

                    for (int a = 0; a < dim; a++)
                        for (int b = 0; b < dim; b++)
                            exact += here.axes[i][a] * p.shape.moment[a][b] * here.axes[j][b];
                    assert_true(fabs(second[i][j] - exact) < 1e-12 * p.shape.volume);
                }
            }
            free(w);
            free(cell);
            free(shift);
            cut_rule_destroy(&r);
            mesh_destroy(&m);
        }
}

/* A body turned in many small steps about an axis is where one turn puts it. */
static void small_turns_add_up(void **state)
{
    body_at p = body(3, SHAPE_BOX), q = p;

    (void)state;
    for (int i = 0; i < 1000; i++)
        pose_turn(&p.at, 3, (double[3]){0.001, -0.002, 0.0005});
    pose_turn(&q.at, 3, (double[3]){1, -2, 0.5});
    for (int k = 0; k < 4; k++)
        assert_true(fabs(p.at.q[k] - q.at.q[k]) < 1e-12);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(volume_and_surface_of_smooth_bodies),
        cmocka_unit_test(surface_of_bodies_with_edges),
        cmocka_unit_test(volume_centroid_and_inertia_are_exact),
        cmocka_unit_test(small_turns_add_up),
    };

    int failed = cmocka_run_group_tests(tests, NULL, NULL);

    arena_free(&memory);
    return failed;
}
