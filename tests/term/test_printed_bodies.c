/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Flow with bodies (plugin "appendix") against the printed formulas (appendix B.1-B.9, B.16-B.45).
 *
 * Two bodies in a mesh of curved cells, random states in which all unknowns are free: each component
 * of the residual and each block of the assembled matrix must be what printed_bodies.c computes,
 *
 *     |kernel - printed|_F <= 1e-12 |printed|_F,
 *
 * and what is not printed must be exactly zero.  Points and weights inside and outside of the bodies
 * are the kernel's; that they add up to whole cells is a test of its own. */
#include "printed_bodies.h"
#include "printed_shapes.h"

#include "support/opened.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { STATES = 2, BODIES = 2 };

#define EXACT 1e-12
#define ALPHA 37.0

static const printed_fluid fluid = {.rho = 1.3, .mu = 0.7, .g = {1.7, -9.81, 2.9}, .dt = 0.05};

/* A wide body that covers whole cells and a narrow one so near to it that they share a cell. */
static const char case_text[] =
    "local shape = param('shape', 'quads', 'shape of the cells')\n"
    "local how = param('how', 'auto', 'how the derivatives are computed')\n"
    "local box = {quads = {8, 6}, triangles = {6, 5}, hexes = {4, 3, 3}, tets = {4, 3, 3}}\n"
    "local cells, sin = box[shape], math.sin\n"
    "local solid = #cells == 3\n"
    "mesh { box = solid and {{0, 0, 0}, {1.5, 1, 0.8}} or {{0, 0}, {1.5, 1}}, cells = cells, shape = shape,\n"
    "  map = solid and function(x, y, z)\n"
    "      return x + 0.06 * sin(5 * y + 2 * z), y + 0.05 * sin(4 * x - 3 * z), z + 0.04 * sin(6 * x + 3 * y)\n"
    "    end or function(x, y) return x + 0.06 * sin(5 * y + 2 * x), y + 0.05 * sin(6 * x) end }\n"
    "fluid { density = %.17g, viscosity = %.17g, gravity = solid and {%.17g, %.17g, %.17g} or {%.17g, %.17g} }\n"
    "term 'continuity' { jacobian = how }\n"
    "term 'momentum' { jacobian = how }\n"
    "term 'appendix' { alpha = %.17g, jacobian = how }\n"
    "if solid then\n"
    "  particle { shape = sphere { radius = 0.33 }, density = 2.5, at = {0.56, 0.5, 0.4} }\n"
    "  particle { shape = ellipsoid { a = 0.19, b = 0.27, c = 0.22 }, density = 0.6, at = {1.13, 0.53, 0.4},\n"
    "             orientation = {0.9, 0.1, -0.2, 0.3} }\n"
    "else\n"
    "  particle { shape = disk { radius = 0.3 }, density = 2.5, at = {0.47, 0.52} }\n"
    "  particle { shape = ellipse { a = 0.28, b = 0.17 }, density = 0.6, at = {1.01, 0.49}, angle = 0.9 }\n"
    "end\n"
    "boundary '*' { natural = true }\n"
    "time { scheme = 'bdf1', step = %.17g, stop = 1 }\n";

static opened *open_shape(const char *shape, const char *how)
{
    const printed_fluid *f = &fluid;
    char text[4000], set[2][64];
    opened *k;

    snprintf(text, sizeof text, case_text, f->rho, f->mu, f->g[0], f->g[1], f->g[2], f->g[0], f->g[1], ALPHA,
             f->dt);
    snprintf(set[0], sizeof set[0], "shape=%s", shape);
    snprintf(set[1], sizeof set[1], "how=%s", how);
    k = open_text(text, (const char *[]){set[0], set[1]}, 2);
    if (k->p.space.n_free != k->p.space.n_dof)
        fail_msg("%s: %lld of %lld unknowns are free", shape, (long long)k->p.space.n_free,
                 (long long)k->p.space.n_dof);
    assert_int_equal(k->p.bodies.n, BODIES);
    return k;
}

/* --- states --- */

static int64_t slots(const opened *k, int component)
{
    return component < BODIES_UP ? k->p.mesh.n_node : k->p.bodies.n;
}

static int64_t state_size(const opened *k)
{
    int64_t n = 0;

    for (int c = 0; c < BODIES_COMPONENTS; c++)
        n += slots(k, c);
    return n;
}

/* Random values, now and a step ago, one component after the other; freed with free(). */
static double *random_state(const opened *k, uint64_t seed, bodies_state *s)
{
    int64_t n = state_size(k), at = 0;
    double *x = malloc((size_t)(2 * n) * sizeof *x);

    assert_non_null(x);
    fill_random(x, 2 * n, seed);
    for (int c = 0; c < BODIES_COMPONENTS; c++) {
        s->now[c] = x + at;
        s->old[c] = x + n + at;
        at += slots(k, c);
    }
    return x;
}

static int component_of(const space *s, int64_t dof)
{
    static const struct {
        const char *field;
        int first;
    } of[] = {{"u", BODIES_U}, {"p", BODIES_P}, {"lambda", BODIES_LX}, {"U", BODIES_UP}, {"omega", BODIES_OX}};
    const char *name = s->field[s->dof_field[dof]].name;

    for (size_t i = 0; i < sizeof of / sizeof *of; i++)
        if (strcmp(name, of[i].field) == 0)
            return of[i].first == BODIES_OX && s->mesh->dim == 2 ? BODIES_OZ : of[i].first + s->dof_comp[dof];
    fail_msg("a field \"%s\" is not of the appendix", name);
    return -1;
}

static int64_t slot_of(const space *s, int64_t dof)
{
    return s->dof_node[dof] - (component_of(s, dof) < BODIES_UP ? 0 : s->mesh->n_node + 1);
}

/* --- both sides --- */

/* Residual and matrix of the kernel at the state, sorted into blocks. */
static void kernel_blocks(opened *k, const bodies_state *state, bodies_blocks *b)
{
    const space *s = &k->p.space;
    newton_system *sys = &k->p.system;
    double *x = malloc((size_t)(3 * s->n_dof) * sizeof *x), *old = x + s->n_dof, *dot = old + s->n_dof;
    assembly_state at = {
        .dt = fluid.dt, .shift = 1 / fluid.dt, .x = x, .dot = dot, .old = old, .bodies = problem_points(&k->p)};

    assert_non_null(x);
    assert_int_equal(bodies_blocks_create(b, k->p.mesh.n_node, k->p.bodies.n), 0);
    for (int64_t i = 0; i < s->n_dof; i++) {
        x[i] = state->now[component_of(s, i)][slot_of(s, i)];
        old[i] = state->old[component_of(s, i)][slot_of(s, i)];
        dot[i] = (x[i] - old[i]) / fluid.dt;
    }
    if (assembly_run(&sys->assembly, &at, sys->residual, sys->linear.value, 1, &k->err))
        fail_msg("assembly: %s", k->err.text);
    for (int64_t i = 0; i < s->n_free; i++) {
        int32_t d = s->dof_of[i], row = component_of(s, d);

        b->r[row][slot_of(s, d)] = sys->residual[d];
        for (int64_t e = s->row[i]; e < s->row[i + 1]; e++) {
            int32_t c = s->dof_of[space_column(s, i, e)], col = component_of(s, c);

            b->j[row][col][slot_of(s, d) * b->n[col] + slot_of(s, c)] = sys->linear.value[e];
        }
    }
    free(x);
}

/* Everything over Omega, Omega_f and the Omega_Pk. */
static void printed_blocks_of(const opened *k, const bodies_state *s, bodies_blocks *b)
{
    const problem *p = &k->p;
    const double(*cut_x)[3] = (const double(*)[3])p->bodies.cut.x;
    bodies_body body[BODIES];
    bodies_data data = {.fluid = &fluid, .alpha = ALPHA, .body = body};
    printed_cell c;

    for (int i = 0; i < BODIES; i++) {
        body[i].rho = p->bodies.spec[i].density;
        memcpy(body[i].x, p->bodies.now->body[i].at.x, sizeof body[i].x);
    }
    printed_cell_make(p->mesh.dim, p->mesh.type->simplex, &c);
    assert_int_equal(bodies_blocks_create(b, p->mesh.n_node, p->bodies.n), 0);
    for (int64_t e = 0; e < p->mesh.n_cell; e++) {
        bodies_part part = {BODIES_OMEGA, e, -1, c.n_point, (const double(*)[3])c.s, c.weight};

        bodies_add(&p->mesh, &data, s, &part, b);
        part.domain = BODIES_OMEGA_F;
        if (!p->bodies.now->cover[e])
            bodies_add(&p->mesh, &data, s, &part, b);
    }
    for (int64_t i = 0; i < p->bodies.now->n_cut; i++) {
        bodies_part part = {BODIES_OMEGA_F,
                            p->bodies.now->cut_cell[i],
                            -1,
                            p->bodies.cut.n,
                            cut_x,
                            p->bodies.now->cut_weight + i * p->bodies.cut.n};

        bodies_add(&p->mesh, &data, s, &part, b);
    }
    for (int64_t i = 0; i < p->bodies.now->n_covered; i++) {
        int32_t a = p->bodies.now->covered[i];
        bodies_part part = {BODIES_OMEGA_P,
                            p->space.attached_cell[a],
                            p->space.attached_particle[a],
                            p->bodies.cut.n,
                            cut_x,
                            p->bodies.now->covered_weight + i * p->bodies.cut.n};

        bodies_add(&p->mesh, &data, s, &part, b);
    }
}

/* --- comparison --- */

static double distance(const double *a, const double *b, int64_t n)
{
    double sum = 0;

    for (int64_t i = 0; i < n; i++)
        sum += (a[i] - (b ? b[i] : 0)) * (a[i] - (b ? b[i] : 0));
    return sqrt(sum);
}

static double largest[2]; /* relative difference: residuals, blocks */

/* |got - want| <= EXACT |want|; what is zero must be exactly so.  col: -1 for a residual. */
static void assert_block(int row, int col, const char *shape, const char *got_name, const double *got,
                         const char *want_name, const double *want, int64_t n)
{
    double d = distance(got, want, n), size = distance(want, NULL, n);

    if (!(d <= EXACT * size))
        fail_msg("%s%s%s on %s: |%s - %s| = %.3e > %.0e |%s|; |%s| = %.15g, |%s| = %.15g", bodies_row_name[row],
                 col < 0 ? "" : ", derivative by ", col < 0 ? "" : bodies_col_name[col], shape, got_name, want_name,
                 d, EXACT, want_name, got_name, distance(got, NULL, n), want_name, size);
    if (size > 0)
        largest[col >= 0] = fmax(largest[col >= 0], d / size);
}

/* --- tests --- */

/* What a test is about. */
typedef struct claim {
    const char *shape;
    int row; /* BODIES_U, ... */
} claim;

/* Kernel and printed formulas at random states, for the shape asked for last: the tests of a shape follow each
 * other. */
typedef struct sides {
    const char *shape;
    opened *k;
    bodies_blocks kernel[STATES], printed[STATES];
} sides;

static sides last;

static void forget_sides(void)
{
    for (int i = 0; last.k && i < STATES; i++) {
        bodies_blocks_destroy(&last.kernel[i]);
        bodies_blocks_destroy(&last.printed[i]);
    }
    if (last.k)
        close_case(last.k);
    last = (sides){0};
}

static sides *both_sides(const claim *c)
{
    if (last.k && strcmp(last.shape, c->shape) == 0)
        return &last;
    forget_sides();
    last.shape = c->shape;
    last.k = open_shape(c->shape, "auto");
    for (int i = 0; i < STATES; i++) {
        bodies_state s;
        double *x = random_state(last.k, (uint64_t)i + 1, &s);

        kernel_blocks(last.k, &s, &last.kernel[i]);
        printed_blocks_of(last.k, &s, &last.printed[i]);
        free(x);
    }
    return &last;
}

static void residual_matches(void **state)
{
    const claim *c = *state;
    const sides *at = both_sides(c);

    for (int i = 0; i < STATES; i++) {
        const bodies_blocks *kernel = &at->kernel[i], *printed = &at->printed[i];

        assert_true(distance(printed->r[c->row], NULL, printed->n[c->row]) > 0);
        assert_block(c->row, -1, c->shape, "kernel", kernel->r[c->row], "printed", printed->r[c->row],
                     printed->n[c->row]);
    }
}

static void jacobian_matches(void **state)
{
    const claim *c = *state;
    const sides *at = both_sides(c);

    for (int i = 0; i < STATES; i++)
        for (int col = 0; col < BODIES_COMPONENTS; col++) {
            const bodies_blocks *kernel = &at->kernel[i], *printed = &at->printed[i];
            int zero = !bodies_component(at->k->p.mesh.dim, col) || !bodies_entry(c->row, col);
            int64_t n = printed->n[c->row] * printed->n[col];

            assert_int_equal(distance(printed->j[c->row][col], NULL, n) == 0, zero);
            assert_block(c->row, col, c->shape, "kernel", kernel->j[c->row][col], "printed",
                         printed->j[c->row][col], n);
        }
}

/* The assembled matrix with derivatives as the terms have them and by complex step. */
static void derivatives_agree(void **state)
{
    const claim *c = *state;
    opened *k[2] = {open_shape(c->shape, "auto"), open_shape(c->shape, "complex")};

    for (int i = 0; i < k[0]->p.description.n_use; i++) {
        assert_int_equal(k[0]->p.description.use[i].how, TERM_AUTO);
        assert_int_equal(k[1]->p.description.use[i].how, TERM_COMPLEX);
    }
    for (uint64_t seed = 11; seed < 11 + STATES; seed++) {
        bodies_blocks b[2];
        bodies_state s;
        double *x = random_state(k[0], seed, &s);

        for (int i = 0; i < 2; i++)
            kernel_blocks(k[i], &s, &b[i]);
        for (int row = 0; row < BODIES_COMPONENTS; row++)
            for (int col = 0; col < BODIES_COMPONENTS; col++)
                assert_block(row, col, c->shape, "complex", b[1].j[row][col], "auto", b[0].j[row][col],
                             b[0].n[row] * b[0].n[col]);
        for (int i = 0; i < 2; i++)
            bodies_blocks_destroy(&b[i]);
        free(x);
    }
    for (int i = 0; i < 2; i++)
        close_case(k[i]);
}

/* The residual is quadratic in the unknowns: (R(x + d) - R(x - d)) / 2 = J(x) d for d of any size. */
static void printed_derivative(void **state)
{
    const claim *c = *state;
    opened *k = open_shape(c->shape, "auto");
    int64_t room = k->p.mesh.n_node + k->p.bodies.n, size = state_size(k);
    bodies_state s, t;
    double *x = random_state(k, 21, &s), *d = random_state(k, 22, &t);
    double *jd = calloc((size_t)(2 * room), sizeof *jd), *dr = jd + room;
    bodies_blocks at[3];

    assert_non_null(jd);
    for (int i = 0; i < 3; i++) {
        for (int64_t a = 0; a < size; a++)
            x[a] += (i == 0 ? 0 : i == 1 ? 1 : -2) * d[a];
        printed_blocks_of(k, &s, &at[i]);
    }
    for (int row = 0; row < BODIES_COMPONENTS; row++) {
        for (int64_t i = 0; i < at[0].n[row]; i++) {
            jd[i] = 0;
            dr[i] = (at[1].r[row][i] - at[2].r[row][i]) / 2;
            for (int col = 0; col < BODIES_COMPONENTS; col++)
                for (int64_t j = 0; j < at[0].n[col]; j++)
                    jd[i] += at[0].j[row][col][i * at[0].n[col] + j] * t.now[col][j];
        }
        assert_block(row, -1, c->shape, "J d", jd, "dR", dr, at[0].n[row]);
    }
    for (int i = 0; i < 3; i++)
        bodies_blocks_destroy(&at[i]);
    free(x);
    free(d);
    free(jd);
    close_case(k);
}

/* In every cell the fluid's weights and those of all bodies are the whole cell's, unless a body covers
 * all of it; there are cells of each sort, and bodies that share one. */
static void weights_add_up(void **state)
{
    const claim *c = *state;
    opened *k = open_shape(c->shape, "auto");
    const problem *p = &k->p;
    int64_t n = p->bodies.cut.n, n_cell = p->mesh.n_cell, whole = 0, free_cells = 0, shared = 0;
    double *sum = calloc((size_t)(n_cell * n), sizeof *sum), scale = 0;
    int *parts = calloc((size_t)(2 * n_cell), sizeof *parts), *bodies = parts + n_cell;

    assert_non_null(sum);
    assert_non_null(parts);
    for (int64_t i = 0; i < p->bodies.now->n_cut; i++) {
        parts[p->bodies.now->cut_cell[i]]++;
        for (int64_t q = 0; q < n; q++)
            sum[p->bodies.now->cut_cell[i] * n + q] += p->bodies.now->cut_weight[i * n + q];
    }
    for (int64_t i = 0; i < p->bodies.now->n_covered; i++) {
        int32_t e = p->space.attached_cell[p->bodies.now->covered[i]];

        bodies[e]++;
        for (int64_t q = 0; q < n; q++)
            sum[e * n + q] += p->bodies.now->covered_weight[i * n + q];
    }
    for (int64_t q = 0; q < n; q++)
        scale = fmax(scale, fabs(p->bodies.cut.whole[q]));
    for (int64_t e = 0; e < n_cell; e++) {
        assert_int_equal(parts[e],
                         p->bodies.now->cover[e] ==
                             COVER_PART); /* listed once, and only if near a body that leaves some of it */
        assert_true(p->bodies.now->cover[e] != 0 || bodies[e] == 0);
        free_cells += bodies[e] == 0;
        whole += bodies[e] && !parts[e];
        shared += bodies[e] > 1;
        for (int64_t q = 0; parts[e] && q < n; q++)
            if (!(fabs(sum[e * n + q] - p->bodies.cut.whole[q]) <= EXACT * scale))
                fail_msg("%s, cell %lld, point %lld: weights add up to %.17g, not %.17g", c->shape, (long long)e,
                         (long long)q, sum[e * n + q], p->bodies.cut.whole[q]);
    }
    assert_true(free_cells > 0 && shared > 0 && p->bodies.now->n_cut > 0);
    assert_true(whole > 0 || strcmp(c->shape, "hexes") == 0); /* too coarse for that */
    free(sum);
    free(parts);
    close_case(k);
}

static int report(void **state)
{
    (void)state;
    forget_sides();
    print_message("# largest relative difference: residuals %.2e, blocks %.2e\n", largest[0], largest[1]);
    return 0;
}

#define TEST(NAME, FUNCTION, SHAPE, ROW)                                                                           \
    {                                                                                                              \
        .name = NAME "_on_" SHAPE, .test_func = FUNCTION, .initial_state = &(claim)                                \
        {                                                                                                          \
            SHAPE, ROW                                                                                             \
        }                                                                                                          \
    }

#define ROW(NAME, SHAPE, R, PRINTED_R, PRINTED_J)                                                                  \
    TEST(NAME "_residual_matches_" PRINTED_R, residual_matches, SHAPE, R),                                         \
        TEST(NAME "_jacobian_matches_" PRINTED_J, jacobian_matches, SHAPE, R)

#define TESTS_2D(SHAPE)                                                                                            \
    TEST("weights_add_up_to_whole_cells", weights_add_up, SHAPE, 0),                                               \
        TEST("printed_jacobian_is_derivative_of_printed_residual", printed_derivative, SHAPE, 0),                  \
        ROW("x_momentum", SHAPE, BODIES_U, "B4", "B7"), ROW("y_momentum", SHAPE, BODIES_V, "B5", "B8"),            \
        ROW("continuity", SHAPE, BODIES_P, "B1", "B1"), ROW("lambda_x", SHAPE, BODIES_LX, "B16", "B19_to_B23"),    \
        ROW("lambda_y", SHAPE, BODIES_LY, "B17", "B19_to_B25"),                                                    \
        ROW("x_velocity", SHAPE, BODIES_UP, "B28", "B34_to_B36"),                                                  \
        ROW("y_velocity", SHAPE, BODIES_VP, "B29", "B34_to_B37"),                                                  \
        ROW("omega_z", SHAPE, BODIES_OZ, "B33", "B39_B44_B45"),                                                    \
        TEST("jacobian_matches_complex_step", derivatives_agree, SHAPE, 0)

#define TESTS_3D(SHAPE)                                                                                            \
    TESTS_2D(SHAPE), ROW("z_momentum", SHAPE, BODIES_W, "B6", "B9"),                                               \
        ROW("lambda_z", SHAPE, BODIES_LZ, "B18", "B19_to_B27"),                                                    \
        ROW("z_velocity", SHAPE, BODIES_WP, "B30", "B34_to_B38"),                                                  \
        ROW("omega_x", SHAPE, BODIES_OX, "B31", "B39_to_B41"),                                                     \
        ROW("omega_y", SHAPE, BODIES_OY, "B32", "B39_B42_B43")

int main(void)
{
    const struct CMUnitTest tests[] = {TESTS_2D("quads"), TESTS_2D("triangles"), TESTS_3D("hexes"),
                                       TESTS_3D("tets")};

    return cmocka_run_group_tests(tests, NULL, report);
}
