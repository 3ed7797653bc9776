/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Laplacians of fields and metrics of elements, as terms see them, on all four kinds of cells: against polynomials,
 * against differences of the finite element function, and against what metrics do to edges. */
#include "assemble/batch.h"
#include "support/opened.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_POINTS = 20000 };

/* What a term was given, in the order of the points. */
typedef struct seen {
    int n, dim;
    double x[MAX_POINTS][3], a[MAX_POINTS], b[MAX_POINTS], w[MAX_POINTS][3], metric[MAX_POINTS][9];
} seen;

static int look(const pf_batch *b, const double *const *in, double *const *out)
{
    seen *s = *(seen *const *)b->params;

    for (uint32_t i = 0; i < b->ld; i++) {
        assert_true(s->n < MAX_POINTS);
        for (uint32_t k = 0; k < b->dim; k++) {
            s->x[s->n][k] = b->x[k * b->ld + i];
            s->w[s->n][k] = in[2][k * b->ld + i];
        }
        for (uint32_t k = 0; k < b->dim * b->dim; k++)
            s->metric[s->n][k] = b->metric[k * b->ld + i];
        s->a[s->n] = in[0][i];
        s->b[s->n++] = in[1][i];
        out[0][i] = 0;
    }
    return PF_OK;
}

/* The metric is there for those alone that say so. */
static int look_away(const pf_batch *b, const double *const *in, double *const *out)
{
    (void)in;
    assert_null(b->metric);
    memset(out[0], 0, b->ld * sizeof(double));
    return PF_OK;
}

/* A product of everything: quadratic in the unknowns, so that differences of its residual are exact. */
static int product(const pf_batch *b, const double *const *in, double *const *out)
{
    const double *lap_a = in[0], *lap_b = in[1], *a = in[2], *grad_a = in[3];

    for (uint32_t i = 0; i < b->ld; i++) {
        out[0][i] = lap_a[i] * a[i] + 0.3 * lap_b[i] * grad_a[i] + b->metric[i] * lap_a[i];
        for (uint32_t k = 0; k < b->dim; k++)
            out[1][k * b->ld + i] = lap_a[i] * lap_b[i] + grad_a[k * b->ld + i] * lap_a[i];
        for (uint32_t k = 0; k < b->dim; k++)
            out[2][k * b->ld + i] = in[4][k * b->ld + i] * lap_b[i] + in[4][(1 - k % 2) * b->ld + i];
    }
    return PF_OK;
}

static const pf_slot looked_at[] = {{"lap_a", "a", PF_LAPLACE, PF_SCALAR},
                                    {"lap_b", "b", PF_LAPLACE, PF_SCALAR},
                                    {"lap_w", "w", PF_LAPLACE, PF_VECTOR}};
static const pf_slot multiplied[] = {{"lap_a", "a", PF_LAPLACE, PF_SCALAR},
                                     {"lap_b", "b", PF_LAPLACE, PF_SCALAR},
                                     {"a", "a", PF_VALUE, PF_SCALAR},
                                     {"grad_a", "a", PF_GRAD, PF_VECTOR},
                                     {"lap_w", "w", PF_LAPLACE, PF_VECTOR}};
static const pf_slot tests_of[] = {
    {"s", "a", PF_VALUE, PF_SCALAR}, {"grad_s", "a", PF_GRAD, PF_VECTOR}, {"v", "w", PF_VALUE, PF_VECTOR}};
static const pf_term looks = {.flags = PF_METRIC,
                              .size = sizeof(pf_term),
                              .name = "looks",
                              .in = looked_at,
                              .n_in = 3,
                              .out = tests_of,
                              .n_out = 1,
                              .residual = look};
static const pf_term looks_away = {.size = sizeof(pf_term),
                                   .name = "looks_away",
                                   .in = looked_at,
                                   .n_in = 1,
                                   .out = tests_of,
                                   .n_out = 1,
                                   .residual = look_away};
static const pf_term multiplies = {.flags = PF_METRIC,
                                   .size = sizeof(pf_term),
                                   .name = "multiplies",
                                   .in = multiplied,
                                   .n_in = 5,
                                   .out = tests_of,
                                   .n_out = 3,
                                   .residual = product};

/* Fields a (order 2), b (order 1), w (vector, order 2) on a box that is then deformed. */
typedef struct bench {
    mesh m;
    field_list fields;
    space s;
    registry r;
    assembly a;
    term_plugin plugin;
    term_use use[2];
    uint8_t *facet_on;
    double *x, *residual;
    seen *seen;
    error err;
} bench;

static void start(bench *k, int dim, int simplex, int n, void (*deform)(double *x))
{
    static const pf_field field[] = {{.name = "a", .shape = PF_SCALAR, .order = 2},
                                     {.name = "b", .shape = PF_SCALAR, .order = 1},
                                     {.name = "w", .shape = PF_VECTOR, .order = 2}};
    mesh_box box = {.dim = dim, .simplex = simplex, .high = {1, 1, 1}, .n = {n, n, n}};
    int status;

    memset(k, 0, sizeof *k);
    status = mesh_create_box(&box, &k->m, &k->err);
    for (int64_t i = 0; deform && i < k->m.n_node; i++) {
        double x[3] = {0};

        memcpy(x, k->m.x + i * dim, (size_t)dim * sizeof *x);
        deform(x);
        memcpy(k->m.x + i * dim, x, (size_t)dim * sizeof *x);
    }
    status = status || mesh_measure(&k->m, &k->err);
    for (int i = 0; i < 3 && !status; i++)
        status = fields_add(&k->fields, dim, &field[i], "test", &k->err);
    if (status || space_number(&k->s, &k->fields, &k->m, 0, &k->err) || space_constrain(&k->s, &k->err))
        fail_msg("%s", k->err.text);
    k->x = calloc((size_t)(2 * k->s.n_dof), sizeof *k->x);
    k->residual = k->x + k->s.n_dof;
    k->seen = calloc(1, sizeof *k->seen);
    k->facet_on = malloc((size_t)k->m.n_facet);
    memset(k->facet_on, 1, (size_t)k->m.n_facet);
    k->plugin.d.name = "test";
}

static void finish(bench *k)
{
    free(k->x);
    free(k->seen);
    free(k->facet_on);
    assembly_destroy(&k->a);
    space_destroy(&k->s);
    mesh_destroy(&k->m);
}

static void assemble(bench *k, int where, const pf_term *first, const pf_term *second)
{
    const pf_term *term[2] = {first, second};
    term_use *use[2] = {&k->use[0], &k->use[1]};
    assembly_spec spec = {.where = where, .facet_on = k->facet_on, .n_use = second ? 2 : 1, .use = use};

    for (int i = 0; i < 2; i++)
        k->use[i] = (term_use){.plugin = &k->plugin, .term = term[i], .where = where, .params = &k->seen};
    assembly_destroy(&k->a);
    k->seen->n = 0;
    if (assembly_create(&k->a, &k->s, &spec, 1, 1, &k->err))
        fail_msg("%s", k->err.text);
}

static void run(bench *k, double *residual, double *value)
{
    assembly_state s = {.x = k->x, .dot = k->x, .old = k->x};

    if (assembly_run(&k->a, &s, residual, value, 0, &k->err))
        fail_msg("%s", k->err.text);
}

static void set_field(bench *k, const char *name, double (*f)(int component, const double *x))
{
    int field = space_find_field(&k->s, name);

    for (int64_t i = 0; i < k->m.n_node; i++)
        for (int c = 0; k->s.first[field][i] >= 0 && c < k->s.field[field].n_comp; c++) {
            double x[3] = {0};

            memcpy(x, k->m.x + i * k->m.dim, (size_t)k->m.dim * sizeof *x);
            k->x[k->s.first[field][i] + c] = f(c, x);
        }
}

static void shear(double *x)
{
    double p[3] = {x[0], x[1], x[2]};

    x[0] = 0.3 + 0.7 * p[0] + 0.2 * p[1] - 0.1 * p[2];
    x[1] = -0.1 * p[0] + 1.9 * p[1] + 0.3 * p[2];
    x[2] = 0.2 * p[0] - 0.15 * p[1] + 0.4 * p[2];
}

static void bend(double *x)
{
    double p[3] = {x[0], x[1], x[2]};

    x[0] = p[0] + 0.08 * sin(2 * p[1] + p[2]) + 0.05 * p[0] * p[0];
    x[1] = p[1] + 0.07 * cos(2 * p[0]) * (1 + 0.3 * p[2]) - 0.04 * p[0] * p[1];
    x[2] = p[2] + 0.06 * p[2] * sin(2 * p[0] + p[1]) + 0.05 * p[2] * p[1];
}

/* Quadratics: Laplacians 2 (1.1 - 0.7 + 0.9 z) (1 + c / 2). */
static double quadratic(int c, const double *x)
{
    return (1 + 0.5 * c) * (1.1 * x[0] * x[0] - 0.7 * x[1] * x[1] + 0.9 * x[2] * x[2] + 0.6 * x[0] * x[1] -
                            0.4 * x[1] * x[2] + 0.5 * x[0] * x[2]) +
           3 * x[0] - x[1] + 2 * x[2] - 0.3;
}

static double slanted(int c, const double *x)
{
    return 1 + c + 2 * x[0] - 3 * x[1] + x[2];
}

static void laplacian_of_quadratics_on_affine_cells_is_exact(void **state)
{
    (void)state;
    for (int type = 0; type < 4; type++)
        for (int where = PF_CELL; where <= PF_FACET; where += PF_FACET - PF_CELL) {
            const int dim = 2 + type / 2;
            const double exact = 2 * (1.1 - 0.7 + (dim == 3 ? 0.9 : 0));
            bench k;

            start(&k, dim, type % 2, 3, shear);
            set_field(&k, "a", quadratic);
            set_field(&k, "b", slanted);
            set_field(&k, "w", quadratic);
            assemble(&k, where, &looks, &looks_away);
            run(&k, k.residual, NULL);
            assert_true(k.seen->n > 50);
            for (int i = 0; i < k.seen->n; i++) {
                assert_true(fabs(k.seen->a[i] - exact) < 2e-11);
                assert_true(fabs(k.seen->b[i]) < 2e-11);
                for (int c = 0; c < dim; c++)
                    assert_true(fabs(k.seen->w[i][c] - (1 + 0.5 * c) * exact) < 2e-11);
            }
            finish(&k);
        }
}

/* Value of the finite element function of unknowns x at a place, which some cell holds. */
static int value_in(const bench *k, int field, int64_t cell, const double *at, double *v)
{
    const fe_cell *type = k->m.type;
    double xi[3] = {type->simplex ? 0.3 : 0, type->simplex ? 0.3 : 0, type->simplex && k->m.dim == 3 ? 0.3 : 0},
           n[FE_MAX_NODES], dn[FE_MAX_NODES][3];
    int order = k->s.field[field].order;

    for (int it = 0; it < 30; it++) { /* Newton's method for x(xi) = at, its Jacobian solved by Cramer's rule */
        double x[3] = {0}, j[3][3], det = mesh_place(&k->m, cell, xi, x, j), d[3] = {0}, r[3] = {0};

        for (int a = 0; a < k->m.dim; a++)
            r[a] = at[a] - x[a];
        for (int b = 0; b < k->m.dim; b++) {
            int p = (b + 1) % 3, q = (b + 2) % 3;

            for (int a = 0; a < 3; a++)
                d[b] +=
                    r[a] * (j[(a + 1) % 3][p] * j[(a + 2) % 3][q] - j[(a + 1) % 3][q] * j[(a + 2) % 3][p]) / det;
        }
        for (int b = 0; b < k->m.dim; b++)
            xi[b] += d[b];
    }
    for (int b = 0; b < k->m.dim; b++)
        if (!isfinite(xi[b]) || fabs(xi[b]) > 1.5)
            return 0;
    fe_basis(type, order, xi, n, dn);
    *v = 0;
    for (int i = 0; i < fe_n_basis(type, order); i++)
        *v += n[i] * k->x[k->s.first[field][k->m.cell[cell * type->n_node + assemble_local(&k->s, field, i)]]];
    return 1;
}

/* By differences of fourth order with the mapping inverted: knows nothing of second derivatives. */
static double laplacian_by_differences(const bench *k, int field, int64_t cell, const double *x)
{
    static const double weight[5] = {-1.0 / 12, 4.0 / 3, -5.0 / 2, 4.0 / 3, -1.0 / 12};
    const double h = 2e-3;
    double sum = 0;

    for (int d = 0; d < k->m.dim; d++)
        for (int s = 0; s < 5; s++) {
            double at[3] = {x[0], x[1], x[2]}, v = 0;

            at[d] += (s - 2) * h;
            assert_true(value_in(k, field, cell, at, &v));
            sum += weight[s] * v / (h * h);
        }
    return sum;
}

static void laplacian_on_curved_cells_is_that_of_the_function(void **state)
{
    (void)state;
    for (int type = 0; type < 4; type++) {
        const int dim = 2 + type / 2;
        double worst = 0, size = 0;
        int64_t n_q;
        bench k;

        start(&k, dim, type % 2, 1, bend);
        fill_random(k.x, k.s.n_dof, 5);
        assemble(&k, PF_CELL, &looks, NULL);
        run(&k, k.residual, NULL);
        n_q = k.a.class_[0].n_q;
        for (int64_t cell = 0; cell < k.m.n_cell; cell++)
            for (int64_t q = 0; q < n_q; q += 3) {
                int64_t i = q * 8 + cell; /* one batch, a cell a lane */

                worst = fmax(worst, fabs(laplacian_by_differences(&k, 0, cell, k.seen->x[i]) - k.seen->a[i]));
                worst = fmax(worst, fabs(laplacian_by_differences(&k, 1, cell, k.seen->x[i]) - k.seen->b[i]));
                size = fmax(size, fabs(k.seen->a[i]));
            }
        print_message("# type %d: %.1e of %.3g\n", type, worst, size);
        assert_true(size > 1 && worst < 1e-7 * size);
        finish(&k);
    }
}

static double smooth(int c, const double *x)
{
    return sin(2 * x[0] + c) * cos(1.5 * x[1]) + 0.5 * sin(x[2] + x[0]);
}

static double smooth_laplacian(const double *x, int dim)
{
    return -(4 + 2.25) * sin(2 * x[0]) * cos(1.5 * x[1]) - (dim == 3 ? 1.0 : 0.5) * sin(x[2] + x[0]);
}

/* Second derivatives of quadratic interpolation converge with order 1, of cells that become straight with it. */
static void laplacian_of_interpolants_on_curved_cells_converges(void **state)
{
    (void)state;
    for (int type = 0; type < 4; type++) {
        const int dim = 2 + type / 2;
        double error[2] = {0};

        for (int level = 0; level < 2; level++) {
            int n = (dim == 3 ? 4 : 6) << level;
            bench k;

            start(&k, dim, type % 2, n, bend);
            set_field(&k, "a", smooth);
            assemble(&k, PF_FACET, &looks, NULL);
            run(&k, k.residual, NULL);
            for (int i = 0; i < k.seen->n; i++)
                error[level] = fmax(error[level], fabs(k.seen->a[i] - smooth_laplacian(k.seen->x[i], dim)));
            finish(&k);
        }
        print_message("# type %d: %.3g, %.3g\n", type, error[0], error[1]);
        assert_true(error[1] < error[0] / 1.7);
    }
}

static void matrix_is_the_derivative_of_the_residual(void **state)
{
    const double h = 1e-2;

    (void)state;
    for (int type = 0; type < 4; type++)
        for (int where = PF_CELL; where <= PF_FACET; where += PF_FACET - PF_CELL) {
            bench k;
            double *value, *plus, *minus, *d, size = 0, diff = 0;

            start(&k, 2 + type / 2, type % 2, 2, bend);
            value = calloc((size_t)k.s.row[k.s.n_free], sizeof *value);
            plus = calloc((size_t)(3 * k.s.n_dof), sizeof *plus);
            minus = plus + k.s.n_dof;
            d = minus + k.s.n_dof;
            fill_random(k.x, k.s.n_dof, 1);
            fill_random(d, k.s.n_dof, 2);
            assemble(&k, where, &multiplies, NULL);
            run(&k, k.residual, value);
            for (int sign = 1; sign >= -1; sign -= 2) {
                for (int64_t i = 0; i < k.s.n_dof; i++)
                    k.x[i] += sign * h * d[i];
                run(&k, sign > 0 ? plus : minus, NULL);
                for (int64_t i = 0; i < k.s.n_dof; i++)
                    k.x[i] -= sign * h * d[i];
            }
            for (int64_t i = 0; i < k.s.n_free; i++) {
                double jd = 0, dr = (plus[k.s.dof_of[i]] - minus[k.s.dof_of[i]]) / (2 * h);

                for (int64_t e = k.s.row[i]; e < k.s.row[i + 1]; e++)
                    jd += value[e] * d[k.s.dof_of[space_column(&k.s, i, e)]];
                size = fmax(size, fabs(dr));
                diff = fmax(diff, fabs(jd - dr));
            }
            print_message("# type %d, %d: %.1e\n", type, where, diff / size);
            assert_true(size > 0.1 && diff < 2e-9 * size);
            free(value);
            free(plus);
            finish(&k);
        }
}

/* e G f for two edges, as vectors between vertices of a cell. */
static double product_of_edges(const bench *k, const double *g, int64_t cell, int p, int q, int r, int t)
{
    const int dim = k->m.dim, *v = k->m.type->vertex;
    const int32_t *node = k->m.cell + cell * k->m.type->n_node;
    double sum = 0;

    for (int a = 0; a < dim; a++)
        for (int b = 0; b < dim; b++)
            sum += (k->m.x[node[v[q]] * dim + a] - k->m.x[node[v[p]] * dim + a]) * g[a * dim + b] *
                   (k->m.x[node[v[t]] * dim + b] - k->m.x[node[v[r]] * dim + b]);
    return sum;
}

/* In the metric every edge of a straight element has length 2, and those of quads and hexes stand at right angles:
 * this determines it. */
static void edges_have_length_two_in_the_metric(void **state)
{
    (void)state;
    for (int type = 0; type < 4; type++) {
        bench k;
        int dim = 2 + type / 2, n_vertex;

        start(&k, dim, type % 2, 1, shear);
        assemble(&k, PF_CELL, &looks, NULL);
        run(&k, k.residual, NULL);
        n_vertex = k.m.type->n_vertex;
        for (int64_t i = 0; i < k.seen->n; i++) {
            int64_t cell = i % 8 < k.m.n_cell ? i % 8 : k.m.n_cell - 1;
            const double *g = k.seen->metric[i];

            for (int p = 0; type % 2 && p < n_vertex; p++)
                for (int q = 0; q < p; q++)
                    assert_true(fabs(product_of_edges(&k, g, cell, p, q, p, q) - 4) < 1e-12);
            for (int a = 0; !(type % 2) && a < dim; a++)
                for (int b = 0; b < dim; b++)
                    assert_true(fabs(product_of_edges(&k, g, cell, 0, 1 << a, 0, 1 << b) - (a == b ? 4 : 0)) <
                                1e-12);
        }
        finish(&k);
    }
}

/* Both triangles of the square become regular ones with edges of length 1/2. */
static void make_regular(double *x)
{
    x[0] = 0.5 * (x[0] - 0.5 * x[1]);
    x[1] = 0.25 * sqrt(3) * x[1];
}

static void stretch(double *x)
{
    x[0] *= 0.5, x[1] *= 0.125, x[2] *= 2;
}

/* Numbers the vertices of all simplices anew, by a rotation of the first three. */
static void rotate(bench *k)
{
    static const int triangle[] = {1, 2, 0, 4, 5, 3}, tet[] = {1, 2, 0, 3, 5, 6, 4, 8, 9, 7};
    int n = k->m.type->n_node;

    for (int64_t c = 0; c < k->m.n_cell; c++) {
        int32_t node[FE_MAX_NODES];

        memcpy(node, k->m.cell + c * n, (size_t)n * sizeof *node);
        for (int i = 0; i < n; i++)
            k->m.cell[c * n + i] = node[k->m.dim == 2 ? triangle[i] : tet[i]];
    }
}

static void metrics_of_squares_and_regular_triangles(void **state)
{
    (void)state;
    for (int round = 0; round < 3; round++)
        for (int where = PF_CELL; where <= PF_FACET; where += PF_FACET - PF_CELL) {
            static const double exact[3][9] = {{16, 0, 0, 256}, {16, 0, 0, 16}, {16, 0, 0, 0, 256, 0, 0, 0, 1}};
            bench k;

            start(&k, round == 2 ? 3 : 2, round == 1, 1, round == 1 ? make_regular : stretch);
            assemble(&k, where, &looks, NULL);
            run(&k, k.residual, NULL);
            for (int i = 0; i < k.seen->n; i++)
                for (int c = 0; c < k.m.dim * k.m.dim; c++)
                    assert_true(fabs(k.seen->metric[i][c] - exact[round][c]) < 1e-12 * 256);
            finish(&k);
        }
}

static void metric_does_not_depend_on_the_numbers_of_vertices(void **state)
{
    (void)state;
    for (int dim = 2; dim <= 3; dim++) {
        bench k, other;

        start(&k, dim, 1, 1, shear);
        assemble(&k, PF_CELL, &looks, NULL);
        run(&k, k.residual, NULL);
        start(&other, dim, 1, 1, shear);
        rotate(&other);
        assemble(&other, PF_CELL, &looks, NULL);
        run(&other, other.residual, NULL);
        assert_int_equal(k.seen->n, other.seen->n);
        for (int i = 0; i < k.seen->n; i++)
            for (int c = 0; c < dim * dim; c++)
                assert_true(fabs(k.seen->metric[i][c] - other.seen->metric[i][c]) < 1e-11);
        finish(&k);
        finish(&other);
    }
}

/* Where no term asks, there is nothing of it. */
static void classes_without_such_terms_hold_nothing_of_it(void **state)
{
    static const pf_slot value[] = {{"a", "a", PF_VALUE, PF_SCALAR}};
    static const pf_term plain = {.size = sizeof(pf_term),
                                  .name = "plain",
                                  .in = value,
                                  .n_in = 1,
                                  .out = tests_of,
                                  .n_out = 1,
                                  .residual = look_away};
    bench k;

    (void)state;
    start(&k, 2, 0, 2, NULL);
    assemble(&k, PF_CELL, &plain, NULL);
    run(&k, k.residual, NULL);
    for (int order = 0; order < 3; order++) {
        assert_null(k.a.class_[0].d2n_ref[0][order]);
        assert_null(k.a.work[0].basis[order][LAPLACE_ROW]);
    }
    assert_null(k.a.work[0].metric);
    finish(&k);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(laplacian_of_quadratics_on_affine_cells_is_exact),
        cmocka_unit_test(laplacian_on_curved_cells_is_that_of_the_function),
        cmocka_unit_test(laplacian_of_interpolants_on_curved_cells_converges),
        cmocka_unit_test(matrix_is_the_derivative_of_the_residual),
        cmocka_unit_test(edges_have_length_two_in_the_metric),
        cmocka_unit_test(metrics_of_squares_and_regular_triangles),
        cmocka_unit_test(metric_does_not_depend_on_the_numbers_of_vertices),
        cmocka_unit_test(classes_without_such_terms_hold_nothing_of_it),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
