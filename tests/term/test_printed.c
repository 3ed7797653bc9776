/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Continuity and momentum against the printed formulas (appendix A.2-A.6, A.10-A.15).
 *
 * On meshes of curved cells, at random states in which all unknowns are free, each component of
 * the residual and each block of the assembled matrix must be what printed_formulas.c computes,
 *
 *     |kernel - printed|_F <= 1e-12 |printed|_F,
 *
 * and the three ways to a derivative (by hand, complex step, differences) must agree. */
#include "printed_formulas.h"
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

enum { STATES = 2 };

#define EXACT       1e-12
#define DIFFERENCES 1e-6

static const printed_fluid fluid = {.rho = 1.3, .mu = 0.7, .g = {1.7, -9.81, 2.9}, .dt = 0.05};

/* More than 8 cells each, so that there are full and partly filled batches and two slabs. */
static const char case_text[] =
    "local shape = param('shape', 'quads', 'shape of the cells')\n"
    "local how = param('how', 'auto', 'how the derivatives are computed')\n"
    "local box = {quads = {4, 3}, triangles = {3, 3}, hexes = {3, 2, 2}, tets = {2, 2, 1}}\n"
    "local cells, sin = box[shape], math.sin\n"
    "local solid = #cells == 3\n"
    "mesh { box = solid and {{0, 0, 0}, {1.5, 1, 0.8}} or {{0, 0}, {1.5, 1}}, cells = cells, shape = shape,\n"
    "  map = solid and function(x, y, z)\n"
    "      return x + 0.06 * sin(5 * y + 2 * z), y + 0.05 * sin(4 * x - 3 * z), z + 0.04 * sin(6 * x + 3 * y)\n"
    "    end or function(x, y) return x + 0.06 * sin(5 * y + 2 * x), y + 0.05 * sin(6 * x) end }\n"
    "fluid { density = %.17g, viscosity = %.17g, gravity = solid and {%.17g, %.17g, %.17g} or {%.17g, %.17g} }\n"
    "term 'continuity' { jacobian = how }\n"
    "term 'momentum' { jacobian = how }\n"
    "boundary '*' { natural = true }\n"
    "time { scheme = 'bdf1', step = %.17g, stop = 1 }\n";

static opened *open_shape(const char *shape, const char *how)
{
    const printed_fluid *f = &fluid;
    char text[4000], set[2][64];
    opened *k;

    snprintf(text, sizeof text, case_text, f->rho, f->mu, f->g[0], f->g[1], f->g[2], f->g[0], f->g[1], f->dt);
    snprintf(set[0], sizeof set[0], "shape=%s", shape);
    snprintf(set[1], sizeof set[1], "how=%s", how);
    k = open_text(text, (const char *[]){set[0], set[1]}, 2);
    if (k->p.space.n_free != k->p.space.n_dof)
        fail_msg("%s: %lld of %lld unknowns are free", shape, (long long)k->p.space.n_free,
                 (long long)k->p.space.n_dof);
    return k;
}

/* --- states --- */

/* Random values at the nodes, now and a step ago; freed with free(). */
static double *random_state(int64_t n, uint64_t seed, printed_state *s)
{
    double *x = malloc((size_t)(2 * PRINTED_COMPONENTS * n) * sizeof *x);

    assert_non_null(x);
    fill_random(x, 2 * PRINTED_COMPONENTS * n, seed);
    for (int k = 0; k < PRINTED_COMPONENTS; k++) {
        s->now[k] = x + k * n;
        s->old[k] = x + (PRINTED_COMPONENTS + k) * n;
    }
    return x;
}

static int component_of(const space *s, int64_t dof)
{
    return strcmp(s->field[s->dof_field[dof]].name, "p") == 0 ? PRINTED_P : s->dof_comp[dof];
}

/* Residual and matrix of the kernel at the state, sorted into blocks. */
static void kernel_blocks(opened *k, const printed_state *state, printed_blocks *b)
{
    const space *s = &k->p.space;
    newton_system *sys = &k->p.system;
    double *x = malloc((size_t)(3 * s->n_dof) * sizeof *x), *old = x + s->n_dof, *dot = old + s->n_dof;
    assembly_state at = {.dt = fluid.dt, .shift = 1 / fluid.dt, .x = x, .dot = dot, .old = old};

    assert_non_null(x);
    assert_int_equal(printed_blocks_create(b, k->p.mesh.n_node), 0);
    for (int64_t i = 0; i < s->n_dof; i++) {
        x[i] = state->now[component_of(s, i)][s->dof_node[i]];
        old[i] = state->old[component_of(s, i)][s->dof_node[i]];
        dot[i] = (x[i] - old[i]) / fluid.dt;
    }
    if (assembly_run(&sys->assembly, &at, sys->residual, sys->linear.value, 1, &k->err))
        fail_msg("assembly: %s", k->err.text);
    for (int64_t i = 0; i < s->n_free; i++) {
        int32_t d = s->dof_of[i], row = component_of(s, d);

        b->r[row][s->dof_node[d]] = sys->residual[d];
        for (int64_t e = s->row[i]; e < s->row[i + 1]; e++) {
            int32_t c = s->dof_of[space_column(s, i, e)];

            b->j[row][component_of(s, c)][s->dof_node[d] * b->n + s->dof_node[c]] = sys->linear.value[e];
        }
    }
    free(x);
}

/* --- comparison --- */

static double distance(const double *a, const double *b, int64_t n)
{
    double sum = 0;

    for (int64_t i = 0; i < n; i++)
        sum += (a[i] - (b ? b[i] : 0)) * (a[i] - (b ? b[i] : 0));
    return sqrt(sum);
}

/* |got - want| <= tolerance |want|; what is zero must be exactly so.  got_name, want_name: where they come from. */
static void assert_block(const char *block, const char *shape, const char *got_name, const double *got,
                         const char *want_name, const double *want, int64_t n, double tolerance)
{
    double d = distance(got, want, n), size = distance(want, NULL, n);

    if (!(d <= tolerance * size))
        fail_msg("%s on %s: |%s - %s| = %.3e > %.0e |%s|; |%s| = %.15g, |%s| = %.15g", block, shape, got_name,
                 want_name, d, tolerance, want_name, got_name, distance(got, NULL, n), want_name, size);
}

static int components(const opened *k, int row)
{
    return row == PRINTED_P || row < k->p.mesh.dim;
}

/* --- tests --- */

/* What a test is about. */
typedef struct claim {
    const char *shape;
    int row;         /* PRINTED_U, ... */
    const char *how; /* derivatives    */
} claim;

/* Kernel and printed formulas at a random state. */
static opened *both_sides(const claim *c, uint64_t seed, printed_blocks *kernel, printed_blocks *printed)
{
    opened *k = open_shape(c->shape, "auto");
    printed_state s;
    double *x = random_state(k->p.mesh.n_node, seed, &s);

    kernel_blocks(k, &s, kernel);
    assert_int_equal(printed_blocks_create(printed, k->p.mesh.n_node), 0);
    printed_assemble(&k->p.mesh, &fluid, &s, printed);
    free(x);
    return k;
}

static void residual_matches(void **state)
{
    const claim *c = *state;

    for (uint64_t seed = 1; seed <= STATES; seed++) {
        printed_blocks kernel, printed;
        opened *k = both_sides(c, seed, &kernel, &printed);

        assert_true(distance(printed.r[c->row], NULL, printed.n) > 0);
        assert_block(printed_row_name[c->row], c->shape, "kernel", kernel.r[c->row], "printed", printed.r[c->row],
                     printed.n, EXACT);
        printed_blocks_destroy(&kernel);
        printed_blocks_destroy(&printed);
        close_case(k);
    }
}

static void jacobian_matches(void **state)
{
    const claim *c = *state;

    for (uint64_t seed = 1; seed <= STATES; seed++) {
        printed_blocks kernel, printed;
        opened *k = both_sides(c, seed, &kernel, &printed);

        for (int col = 0; col < PRINTED_COMPONENTS; col++) {
            int zero = !components(k, col) || (c->row == PRINTED_P && col == PRINTED_P); /* A.6 */

            assert_int_equal(distance(printed.j[c->row][col], NULL, printed.n * printed.n) == 0, zero);
            assert_block(printed_entry_name[c->row][col], c->shape, "kernel", kernel.j[c->row][col], "printed",
                         printed.j[c->row][col], printed.n * printed.n, EXACT);
        }
        printed_blocks_destroy(&kernel);
        printed_blocks_destroy(&printed);
        close_case(k);
    }
}

/* The assembled matrix with derivatives by hand and computed otherwise. */
static void derivatives_agree(void **state)
{
    const claim *c = *state;
    int differences = strcmp(c->how, "fd") == 0, by_hand = 0;
    opened *k[2] = {open_shape(c->shape, "auto"), open_shape(c->shape, c->how)};

    for (int i = 0; i < k[0]->p.description.n_use; i++) {
        by_hand += k[0]->p.description.use[i].how == TERM_AUTO && k[0]->p.description.use[i].term->jacobian;
        assert_int_equal(k[1]->p.description.use[i].how, differences ? TERM_FD : TERM_COMPLEX);
    }
    assert_int_equal(by_hand, 6); /* divergence, inertia, convection, viscous, pressure_gradient, backflow */

    for (uint64_t seed = 11; seed < 11 + STATES; seed++) {
        printed_blocks b[2];
        printed_state s;
        double *x = random_state(k[0]->p.mesh.n_node, seed, &s);

        for (int i = 0; i < 2; i++)
            kernel_blocks(k[i], &s, &b[i]);
        for (int row = 0; row < PRINTED_COMPONENTS; row++)
            for (int col = 0; col < PRINTED_COMPONENTS; col++)
                assert_block(printed_entry_name[row][col], c->shape, c->how, b[1].j[row][col], "by hand",
                             b[0].j[row][col], b[0].n * b[0].n, differences ? DIFFERENCES : EXACT);
        for (int i = 0; i < 2; i++)
            printed_blocks_destroy(&b[i]);
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
    int64_t n = k->p.mesh.n_node, size = PRINTED_COMPONENTS * n;
    printed_state s, t;
    double *x = random_state(n, 21, &s), *d = random_state(n, 22, &t), *jd = calloc((size_t)(2 * n), sizeof *jd);
    printed_blocks at[3];

    assert_non_null(jd);
    for (int i = 0; i < 3; i++) {
        for (int64_t a = 0; a < size; a++)
            x[a] += (i == 0 ? 0 : i == 1 ? 1 : -2) * d[a];
        assert_int_equal(printed_blocks_create(&at[i], n), 0);
        printed_assemble(&k->p.mesh, &fluid, &s, &at[i]);
    }
    for (int row = 0; row < PRINTED_COMPONENTS; row++) {
        for (int64_t i = 0; i < n; i++) {
            jd[i] = 0;
            jd[n + i] = (at[1].r[row][i] - at[2].r[row][i]) / 2;
            for (int col = 0; col < PRINTED_COMPONENTS; col++)
                for (int64_t j = 0; j < n; j++)
                    jd[i] += at[0].j[row][col][i * n + j] * d[col * n + j];
        }
        assert_block(printed_row_name[row], c->shape, "J d", jd, "dR", jd + n, n, EXACT);
    }
    for (int i = 0; i < 3; i++)
        printed_blocks_destroy(&at[i]);
    free(x);
    free(d);
    free(jd);
    close_case(k);
}

/* int x^a y^b z^c over the reference cell. */
static double moment(const printed_cell *c, const int *power)
{
    double product = 1;
    int sum = 0;

    for (int k = 0; k < c->dim; k++) {
        product *= c->simplex ? tgamma(power[k] + 1.0) : (1.0 + (power[k] % 2 ? -1 : 1)) / (power[k] + 1);
        sum += power[k];
    }
    return c->simplex ? product / tgamma(sum + c->dim + 1.0) : product;
}

static void points_are_exact(void **state)
{
    const char *shape = ((const claim *)*state)->shape;
    printed_cell c;

    printed_cell_make(strcmp(shape, "hexes") == 0 || strcmp(shape, "tets") == 0 ? 3 : 2,
                      strcmp(shape, "triangles") == 0 || strcmp(shape, "tets") == 0, &c);
    for (int code = 0; code < 216; code++) {
        int power[3] = {code % 6, code / 6 % 6, code / 36};
        double sum = 0, want = moment(&c, power);

        if ((c.dim == 2 && power[2]) || (c.simplex && power[0] + power[1] + power[2] > 5))
            continue;
        for (int q = 0; q < c.n_point; q++)
            sum += c.weight[q] * pow(c.s[q][0], power[0]) * pow(c.s[q][1], power[1]) * pow(c.s[q][2], power[2]);
        if (!(fabs(sum - want) <= 1e-15 * (c.simplex ? 1 : 8)))
            fail_msg("%s: x^%d y^%d z^%d integrates to %.17g, not %.17g", shape, power[0], power[1], power[2], sum,
                     want);
    }
}

#define TEST(NAME, FUNCTION, SHAPE, ROW, HOW)                                                                      \
    {                                                                                                              \
        .name = NAME "_on_" SHAPE, .test_func = FUNCTION, .initial_state = &(claim)                                \
        {                                                                                                          \
            SHAPE, ROW, HOW                                                                                        \
        }                                                                                                          \
    }

#define TESTS_2D(SHAPE)                                                                                            \
    TEST("printed_points_integrate_degree_5", points_are_exact, SHAPE, 0, NULL),                                   \
        TEST("printed_jacobian_is_derivative_of_printed_residual", printed_derivative, SHAPE, 0, NULL),            \
        TEST("continuity_residual_matches_A2", residual_matches, SHAPE, PRINTED_P, NULL),                          \
        TEST("continuity_jacobian_matches_A3_to_A6", jacobian_matches, SHAPE, PRINTED_P, NULL),                    \
        TEST("x_momentum_residual_matches_A10", residual_matches, SHAPE, PRINTED_U, NULL),                         \
        TEST("x_momentum_jacobian_matches_A13", jacobian_matches, SHAPE, PRINTED_U, NULL),                         \
        TEST("y_momentum_residual_matches_A11", residual_matches, SHAPE, PRINTED_V, NULL),                         \
        TEST("y_momentum_jacobian_matches_A14", jacobian_matches, SHAPE, PRINTED_V, NULL),                         \
        TEST("jacobian_by_hand_matches_complex_step", derivatives_agree, SHAPE, 0, "complex"),                     \
        TEST("jacobian_by_hand_matches_differences", derivatives_agree, SHAPE, 0, "fd")

#define TESTS_3D(SHAPE)                                                                                            \
    TESTS_2D(SHAPE), TEST("z_momentum_residual_matches_A12", residual_matches, SHAPE, PRINTED_W, NULL),            \
        TEST("z_momentum_jacobian_matches_A15", jacobian_matches, SHAPE, PRINTED_W, NULL)

int main(void)
{
    const struct CMUnitTest tests[] = {TESTS_2D("quads"), TESTS_2D("triangles"), TESTS_3D("hexes"),
                                       TESTS_3D("tets")};

    return cmocka_run_group_tests(tests, NULL, NULL);
}
