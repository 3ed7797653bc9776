/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The streamline term, assembled: it vanishes for exact solutions, also in cut cells, takes power along the flow
 * and is as large as its formula says. */
#include "term/stabilised.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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
    "if param('body', false, 'cuts cells') then\n"
    "  term 'momentum' {}\n  particulate 'sharp'\n"
    "  particle { shape = disk { radius = 0.23 }, density = 1, motion = 'fixed', at = {0.71, 0.52} }\n"
    "end\n"
    "boundary '*' { natural = true }\n";

/* Velocity, pressure and rate of exact_text at a place. */
static double exact(const double *x, int dim, int comp, int is_rate)
{
    const double u[2][3] = {{x[0] + x[1] * x[1], x[0] * x[0] - x[1], 0},
                            {x[0] + x[1] * x[1], x[2] * x[2] - x[1], x[0] * x[0]}};
    const double rate[2][3] = {{x[0] * x[1], x[1], 0}, {x[0] * x[1], x[2], 1}};

    return is_rate ? rate[dim == 3][comp] : u[dim == 3][comp];
}

/* Sum of the sizes of the rows of the velocity. */
static double rows_of(const opened *k)
{
    double sum = 0;

    for (int64_t i = 0; i < k->p.space.n_dof; i++)
        sum += is_velocity(&k->p.space, i) ? fabs(k->p.system.residual[i]) : 0;
    return sum;
}

/* The rows of the streamline term at the exact solution, and where the pressure is doubled. */
static void rows_of_streamline(const char *shape, int body, double shift, double *at_solution, double *beside)
{
    opened *k = open_shape(exact_text, shape, body ? "body=true" : shift > 0 ? "rate=1" : NULL);
    const space *s = &k->p.space;
    double *x = velocity_of(k, 1), *old = velocity_of(k, 2), *dot = calloc((size_t)s->n_dof, sizeof *dot);
    assembly_state at = {.x = x, .dot = dot, .old = old, .shift = shift, .only = PF_METRIC};

    assert_non_null(dot);
    if (body && problem_initial(&k->p, &k->err))
        fail_msg("%s", k->err.text);
    at.bodies = body ? problem_points(&k->p) : NULL;
    for (int64_t d = 0; d < s->n_dof; d++) {
        double place[3] = {0};

        x[d] = 0;
        if (s->dof_node[d] >= k->p.mesh.n_node) /* of the body */
            continue;
        memcpy(place, k->p.mesh.x + (int64_t)s->dof_node[d] * k->p.mesh.dim, (size_t)k->p.mesh.dim * sizeof *place);
        x[d] = is_velocity(s, d) ? exact(place, k->p.mesh.dim, s->dof_comp[d], 0)
                                 : 2 * place[0] - 3 * place[1] + place[2];
        dot[d] = is_velocity(s, d) && shift > 0 ? exact(place, k->p.mesh.dim, s->dof_comp[d], 1) : 0;
    }
    if (assembly_run(&k->p.system.assembly, &at, k->p.system.residual, NULL, 1, &k->err))
        fail_msg("assembly: %s", k->err.text);
    *at_solution = rows_of(k);
    for (int64_t d = 0; d < s->n_dof; d++)
        x[d] *= is_velocity(s, d) ? 1 : 2;
    if (assembly_run(&k->p.system.assembly, &at, k->p.system.residual, NULL, 1, &k->err))
        fail_msg("assembly: %s", k->err.text);
    *beside = rows_of(k);
    free(x), free(old), free(dot);
    close_case(k);
}

static void streamline_vanishes_for_an_exact_solution(void **state)
{
    (void)state;
    for (int i = 0; i < 2 * SHAPES; i++) {
        double at_solution, beside;

        rows_of_streamline(shapes[i / 2], 0, i % 2 ? 10 : 0, &at_solution, &beside);
        print_message("# %s, %s: %.1e at the solution, %.1e beside it\n", shapes[i / 2],
                      i % 2 ? "unsteady" : "steady", at_solution, beside);
        if (!(at_solution <= 1e-12 * beside))
            fail_msg("%s: %g at the solution, %g beside it", shapes[i / 2], at_solution, beside);
    }
}

static void streamline_vanishes_in_cut_cells(void **state)
{
    (void)state;
    for (int i = 0; i < 2; i++) {
        double at_solution, beside;

        rows_of_streamline(shapes[i], 1, 0, &at_solution, &beside);
        print_message("# %s, cut: %.1e at the solution, %.1e beside it\n", shapes[i], at_solution, beside);
        if (!(at_solution <= 1e-12 * beside))
            fail_msg("%s: %g at the solution, %g beside it", shapes[i], at_solution, beside);
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
        cmocka_unit_test(streamline_vanishes_for_an_exact_solution),
        cmocka_unit_test(streamline_vanishes_in_cut_cells),
        cmocka_unit_test(streamline_takes_power_along_a_uniform_flow),
        cmocka_unit_test(streamline_is_of_the_size_of_its_formula),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
