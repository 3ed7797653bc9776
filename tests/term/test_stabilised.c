/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Terms that stabilise convection, assembled: convection made skew-symmetric has no power; grad-div is symmetric,
 * takes power and is as large as its formula says; the streamline term vanishes for exact solutions, takes power
 * along the flow and is as large as its formula says. */
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

static const char *const shapes[] = {"quads", "triangles", "hexes", "tets"};

enum { SHAPES = 4 };

#define CASE                                                                                                       \
    "local shape = param('shape', 'quads', 'shape of the cells')\n"                                                \
    "local solid = shape == 'hexes' or shape == 'tets'\n"                                                          \
    "mesh { box = solid and {{0, 0, 0}, {1.5, 1, 0.8}} or {{0, 0}, {1.5, 1}}, cells = solid and {4, 3, 3} or "     \
    "{5, 4}, shape = shape }\n"                                                                                    \
    "fluid { density = 1.3, viscosity = 0.07 }\n"                                                                  \
    "term 'continuity' {}\ntime { scheme = 'bdf1', step = 0.1, stop = 1 }\n"

static const char periodic_text[] = CASE "local skew = param('skew', true, 'with the term')\n"
                                         "term 'momentum.convection' {}\n"
                                         "if skew then term 'stabilise.skew' {} end\n"
                                         "boundary { periodic = {'left', 'right'} }\n"
                                         "boundary { periodic = {'bottom', 'top'} }\n"
                                         "if solid then boundary { periodic = {'back', 'front'} } end\n";

static const char open_text_of_grad_div[] = CASE "term 'stabilise.grad_div' { grad_div = 0.2 }\n"
                                                 "boundary '*' { natural = true }\n";

static opened *open_shape(const char *text, const char *shape, const char *other)
{
    char set[64];

    snprintf(set, sizeof set, "shape=%s", shape);
    return open_text(text, (const char *[]){set, other}, other ? 2 : 1);
}

/* Residual and matrix at x, in k->p.system. */
static void assemble(opened *k, const double *x)
{
    newton_system *sys = &k->p.system;
    double *zero = calloc((size_t)k->p.space.n_dof, sizeof *zero);
    assembly_state at = {.x = x, .dot = zero, .old = x};

    assert_non_null(zero);
    if (assembly_run(&sys->assembly, &at, sys->residual, sys->linear.value, 1, &k->err))
        fail_msg("assembly: %s", k->err.text);
    free(zero);
}

static int is_velocity(const space *s, int64_t dof)
{
    return strcmp(s->field[s->dof_field[dof]].name, "u") == 0;
}

static double *velocity_of(const opened *k, uint64_t seed)
{
    const space *s = &k->p.space;
    double *x = malloc((size_t)s->n_dof * sizeof *x);

    assert_non_null(x);
    fill_random(x, s->n_dof, seed);
    for (int64_t i = 0; i < s->n_dof; i++)
        x[i] = is_velocity(s, i) ? x[i] : 0;
    return x;
}

/* Power of the convective force at a random velocity, relative to what adds up to it. */
static double power(const char *shape, const char *skew)
{
    opened *k = open_shape(periodic_text, shape, skew);
    double *x = velocity_of(k, 7), sum = 0, size = 0;

    assemble(k, x);
    for (int64_t i = 0; i < k->p.space.n_dof; i++) {
        sum += x[i] * k->p.system.residual[i];
        size += fabs(x[i] * k->p.system.residual[i]);
    }
    free(x);
    close_case(k);
    return fabs(sum) / size;
}

static void skew_convection_has_no_power_in_a_periodic_box(void **state)
{
    (void)state;
    for (int i = 0; i < SHAPES; i++) {
        const double with = power(shapes[i], "skew=true"), without = power(shapes[i], "skew=false");

        print_message("# %s: power with %.1e, without %.1e\n", shapes[i], with, without);
        if (!(with < 1e-13 && without > 1e-4))
            fail_msg("%s: power %g with the term, %g without", shapes[i], with, without);
    }
}

/* y . J z over velocities; the matrix is assembled. */
static double product(const opened *k, const double *y, const double *z)
{
    const space *s = &k->p.space;
    double sum = 0;

    for (int64_t i = 0; i < s->n_free; i++)
        for (int64_t e = s->row[i]; e < s->row[i + 1]; e++)
            if (is_velocity(s, s->dof_of[i]) && is_velocity(s, s->dof_of[s->col[e]]))
                sum += y[s->dof_of[i]] * k->p.system.linear.value[e] * z[s->dof_of[s->col[e]]];
    return sum;
}

static void set_uniform(const space *s, const double *u, double *x)
{
    for (int64_t i = 0; i < s->n_dof; i++)
        x[i] = is_velocity(s, i) ? u[s->dof_comp[i]] : 0;
}

/* About a uniform flow the coefficient is one number in all cells of a size: a(y, y) = c int (div y)^2, and y = (3
 * x, -x, x) has divergence 3. */
static void grad_div_is_symmetric_positive_and_of_the_size_of_its_formula(void **state)
{
    static const double u[3] = {3, -4, 12};

    (void)state;
    for (int i = 0; i < SHAPES; i++) {
        opened *k = open_shape(open_text_of_grad_div, shapes[i], NULL);
        const space *s = &k->p.space;
        const mesh *m = &k->p.mesh;
        double *x = velocity_of(k, 1), *y = velocity_of(k, 2), *z = velocity_of(k, 3), expected = 0, yz;

        set_uniform(s, u, x);
        assemble(k, x);
        yz = product(k, y, z);
        if (!(fabs(yz - product(k, z, y)) <= 1e-12 * fabs(yz)))
            fail_msg("%s: not symmetric: %g, %g", shapes[i], yz, product(k, z, y));
        assert_true(product(k, y, y) > 0 && product(k, z, z) > 0);

        for (int64_t d = 0; d < s->n_dof; d++)
            if (is_velocity(s, d))
                y[d] = m->x[(int64_t)s->dof_node[d] * m->dim] * (s->dof_comp[d] == 0   ? 3
                                                                 : s->dof_comp[d] == 1 ? -1
                                                                                       : 1);
        for (int64_t e = 0; e < m->n_cell; e++) {
            const double r = 1.3 * (m->dim == 3 ? 13 : 5) * m->h[e];

            expected += 9 * 0.2 * r * r / sqrt(r * r + 0.07 * 0.07) * pow(m->h[e], m->dim);
        }
        if (!(fabs(product(k, y, y) - expected) <= 1e-12 * expected))
            fail_msg("%s: %.15g, expected %.15g", shapes[i], product(k, y, y), expected);
        free(x), free(y), free(z);
        close_case(k);
    }
}

/* Also where the coefficient differs from place to place: the power is what is lost, never what is won. */
static void grad_div_takes_power_at_any_velocity(void **state)
{
    (void)state;
    for (int i = 0; i < SHAPES; i++) {
        opened *k = open_shape(open_text_of_grad_div, shapes[i], NULL);

        for (uint64_t seed = 1; seed <= 5; seed++) {
            double *x = velocity_of(k, seed), sum = 0;

            assemble(k, x);
            for (int64_t d = 0; d < k->p.space.n_dof; d++)
                sum += x[d] * k->p.system.residual[d];
            assert_true(sum > 0);
            free(x);
        }
        close_case(k);
    }
}

static const char cut_text[] =
    "local shift = param('shift', 0, 'of the body, in cells')\n"
    "mesh { box = {{0, 0}, {1, 1}}, cells = {10, 10} }\n"
    "fluid { density = 1, viscosity = 1e-4 }\n"
    "term 'continuity' {}\nterm 'momentum' { without = {'convection'} }\nparticulate 'sharp'\n"
    "term 'stabilise.grad_div' {}\n"
    "boundary '*' { u = {0, 0} }\n"
    "particle { shape = disk { radius = 0.2 }, density = 2, at = {0.5 + 0.1 * shift, 0.5 + 0.07 * shift} }\n"
    "time { scheme = 'bdf1', step = 0.1, stop = 1 }\n";

/* Power of grad-div at a velocity that is random at nodes inside of the body, which only cut cells see. */
static double power_in_cut_cells(opened *k, uint64_t seed)
{
    problem *p = &k->p;
    const space *s = &p->space;
    const double *centre = p->state.pose[0].x;
    double *x = velocity_of(k, seed), *zero = calloc((size_t)s->n_dof, sizeof *zero), sum = 0;
    assembly_state at = {.x = x, .dot = zero, .old = x, .bodies = problem_points(p), .only = PF_CONTINUATION};

    assert_non_null(zero);
    for (int64_t d = 0; d < s->n_dof; d++) {
        const double *node = is_velocity(s, d) ? p->mesh.x + (int64_t)s->dof_node[d] * 2 : NULL;

        if (!node || hypot(node[0] - centre[0], node[1] - centre[1]) > 0.2)
            x[d] = 0;
    }
    if (assembly_run(&p->system.assembly, &at, p->system.residual, NULL, 1, &k->err))
        fail_msg("assembly: %s", k->err.text);
    for (int64_t d = 0; d < s->n_dof; d++)
        sum += x[d] * p->system.residual[d];
    free(x), free(zero);
    return sum;
}

/* Some of a cut cell's points have negative weights. */
static void grad_div_takes_power_in_cut_cells(void **state)
{
    (void)state;
    for (int i = 0; i < 8; i++) {
        char set[40];
        opened *k;

        snprintf(set, sizeof set, "shift=%g", i / 8.0);
        k = open_text(cut_text, (const char *[]){set}, 1);
        if (problem_initial(&k->p, &k->err))
            fail_msg("%s", k->err.text);
        for (uint64_t seed = 1; seed <= 10; seed++)
            assert_true(power_in_cut_cells(k, seed) > 0);
        close_case(k);
    }
}

/* The force that a velocity of second order, its rate and a linear pressure need, worked out by hand. */
static const char exact_text[] = CASE
    "local rate = param('rate', 0, 'of the velocity')\nlocal rho, mu = 1.3, 0.07\n"
    "local gx, gy = 0.5, -2\n"
    "local function force(x, y, z)\n"
    "  if solid then\n"
    "    return rho * (rate * x * y + x + y^2 + 2 * y * (z^2 - y) - gx) + 2 - 2 * mu,\n"
    "      rho * (rate * z - z^2 + y + 2 * z * x^2 - gy) - 3 - 2 * mu, rho * (rate + 2 * x * (x + y^2)) + 1 - 2 * "
    "mu\n"
    "  end\n"
    "  return rho * (rate * x * y + x + y^2 + 2 * y * (x^2 - y) - gx) + 2 - 2 * mu,\n"
    "    rho * (rate * y + 2 * x * (x + y^2) - x^2 + y - gy) - 3 - 2 * mu\n"
    "end\n"
    "local gravity = solid and {gx, gy, 0} or {gx, gy}\n"
    "term 'stabilise.streamline' { force = force, gravity = gravity, reduced_pressure = false }\n"
    "boundary '*' { natural = true }\n";

/* Velocity, pressure and rate of exact_text at a place. */
static double exact(const double *x, int dim, int comp, int is_rate)
{
    const double u[2][3] = {{x[0] + x[1] * x[1], x[0] * x[0] - x[1], 0},
                            {x[0] + x[1] * x[1], x[2] * x[2] - x[1], x[0] * x[0]}};
    const double rate[2][3] = {{x[0] * x[1], x[1], 0}, {x[0] * x[1], x[2], 1}};

    return is_rate ? rate[dim == 3][comp] : u[dim == 3][comp];
}

static double largest(const opened *k)
{
    double most = 0;

    for (int64_t i = 0; i < k->p.space.n_dof; i++)
        if (is_velocity(&k->p.space, i))
            most = fmax(most, fabs(k->p.system.residual[i]));
    return most;
}

/* The largest row of the streamline term at the exact solution, and where the pressure is doubled. */
static void rows_of_streamline(const char *shape, double shift, double *at_solution, double *beside)
{
    opened *k = open_shape(exact_text, shape, shift > 0 ? "rate=1" : NULL);
    const space *s = &k->p.space;
    double *x = velocity_of(k, 1), *old = velocity_of(k, 2), *dot = calloc((size_t)s->n_dof, sizeof *dot);
    assembly_state at = {.x = x, .dot = dot, .old = old, .shift = shift};

    assert_non_null(dot);
    for (int64_t d = 0; d < s->n_dof; d++) {
        double place[3] = {0};

        memcpy(place, k->p.mesh.x + (int64_t)s->dof_node[d] * k->p.mesh.dim, (size_t)k->p.mesh.dim * sizeof *place);
        x[d] = is_velocity(s, d) ? exact(place, k->p.mesh.dim, s->dof_comp[d], 0)
                                 : 2 * place[0] - 3 * place[1] + place[2];
        dot[d] = is_velocity(s, d) && shift > 0 ? exact(place, k->p.mesh.dim, s->dof_comp[d], 1) : 0;
    }
    if (assembly_run(&k->p.system.assembly, &at, k->p.system.residual, NULL, 1, &k->err))
        fail_msg("assembly: %s", k->err.text);
    *at_solution = largest(k);
    for (int64_t d = 0; d < s->n_dof; d++)
        x[d] *= is_velocity(s, d) ? 1 : 2;
    if (assembly_run(&k->p.system.assembly, &at, k->p.system.residual, NULL, 1, &k->err))
        fail_msg("assembly: %s", k->err.text);
    *beside = largest(k);
    free(x), free(old), free(dot);
    close_case(k);
}

static void streamline_vanishes_for_an_exact_solution(void **state)
{
    (void)state;
    for (int i = 0; i < 2 * SHAPES; i++) {
        double at_solution, beside;

        rows_of_streamline(shapes[i / 2], i % 2 ? 10 : 0, &at_solution, &beside);
        print_message("# %s, %s: %.1e at the solution, %.1e beside it\n", shapes[i / 2],
                      i % 2 ? "unsteady" : "steady", at_solution, beside);
        if (!(at_solution <= 1e-12 * beside))
            fail_msg("%s: %g at the solution, %g beside it", shapes[i / 2], at_solution, beside);
    }
}

static const char open_text_of_streamline[] =
    CASE "term 'stabilise.streamline' { streamline = 0.2, viscosity = param('viscosity', 1e-20) }\n"
         "boundary '*' { natural = true }\n";

/* About a uniform flow, almost without viscosity: a(y, z) = int tau (rho w . grad y) . (rho w . grad z). */
static void streamline_takes_power_along_a_uniform_flow(void **state)
{
    static const double u[3] = {3, -4, 12};

    (void)state;
    for (int i = 0; i < SHAPES; i++) {
        opened *k = open_shape(open_text_of_streamline, shapes[i], NULL);
        double *x = velocity_of(k, 1), *y = velocity_of(k, 2), *z = velocity_of(k, 3), yz;

        set_uniform(&k->p.space, u, x);
        assemble(k, x);
        yz = product(k, y, z);
        if (!(fabs(yz - product(k, z, y)) <= 1e-12 * fabs(yz)))
            fail_msg("%s: not symmetric: %g, %g", shapes[i], yz, product(k, z, y));
        assert_true(product(k, y, y) > 0 && product(k, z, z) > 0);
        free(x), free(y), free(z);
        close_case(k);
    }
}

/* Cells of 0.3 by 0.25 and of 0.375 by 1/3 by 0.8/3: the metric is diagonal, (2/h_k)^2.  y = (x + 2 y, x - y, 0)
 * has w . grad y = (w_x + 2 w_y, w_x - w_y, 0) and no Laplacian. */
static void streamline_is_of_the_size_of_its_formula(void **state)
{
    static const double u[3] = {3, -4, 12}, h[2][3] = {{0.3, 0.25, 1}, {0.375, 1.0 / 3, 0.8 / 3}};
    static const char *const box[] = {"quads", "hexes"};

    (void)state;
    for (int i = 0; i < 4; i++) {
        const int dim = 2 + i / 2;
        const double mu = i % 2 ? 5 : 1e-20;
        opened *k = open_shape(open_text_of_streamline, box[i / 2], mu > 1 ? "viscosity=5" : NULL);
        const space *s = &k->p.space;
        double *x = velocity_of(k, 1), *y = velocity_of(k, 2), m = 0, expected;

        set_uniform(s, u, x);
        assemble(k, x);
        for (int64_t d = 0; d < s->n_dof; d++) {
            const double *at = k->p.mesh.x + (int64_t)s->dof_node[d] * dim;

            y[d] = !is_velocity(s, d)    ? 0
                   : s->dof_comp[d] == 0 ? at[0] + 2 * at[1]
                   : s->dof_comp[d] == 1 ? at[0] - at[1]
                                         : 0;
        }
        for (int j = 0; j < dim; j++)
            m += pow(1.3 * u[j] * 2 / h[dim - 2][j], 2) + 60 * mu * mu * pow(2 / h[dim - 2][j], 4);
        expected = 0.2 / sqrt(m) * 1.3 * 1.3 * (pow(u[0] + 2 * u[1], 2) + pow(u[0] - u[1], 2)) * 1.5 *
                   (dim == 3 ? 0.8 : 1);
        if (!(fabs(product(k, y, y) - expected) <= 1e-12 * expected))
            fail_msg("%s, viscosity %g: %.15g, expected %.15g", box[i / 2], mu, product(k, y, y), expected);
        free(x), free(y);
        close_case(k);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(skew_convection_has_no_power_in_a_periodic_box),
        cmocka_unit_test(grad_div_is_symmetric_positive_and_of_the_size_of_its_formula),
        cmocka_unit_test(grad_div_takes_power_at_any_velocity),
        cmocka_unit_test(grad_div_takes_power_in_cut_cells),
        cmocka_unit_test(streamline_vanishes_for_an_exact_solution),
        cmocka_unit_test(streamline_takes_power_along_a_uniform_flow),
        cmocka_unit_test(streamline_is_of_the_size_of_its_formula),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
