/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Terms that stabilise convection, assembled: convection made skew-symmetric has no power; grad-div is symmetric,
 * takes power and is as large as its formula says. */
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

static const char periodic_text[] = CASE "local skew = param('skew', true, 'with the term')\n"
                                         "term 'momentum.convection' {}\n"
                                         "if skew then term 'stabilise.skew' {} end\n"
                                         "boundary { periodic = {'left', 'right'} }\n"
                                         "boundary { periodic = {'bottom', 'top'} }\n"
                                         "if solid then boundary { periodic = {'back', 'front'} } end\n";

static const char open_text_of_grad_div[] = CASE "term 'stabilise.grad_div' { grad_div = 0.2 }\n"
                                                 "boundary '*' { natural = true }\n";

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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(skew_convection_has_no_power_in_a_periodic_box),
        cmocka_unit_test(grad_div_is_symmetric_positive_and_of_the_size_of_its_formula),
        cmocka_unit_test(grad_div_takes_power_at_any_velocity),
        cmocka_unit_test(grad_div_takes_power_in_cut_cells),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
