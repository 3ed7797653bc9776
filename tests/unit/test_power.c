/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The power of terms (core/assemble/power.c): all of them together against the residual, and what is known of
 * single ones. */
#include "support/opened.h"
#include "support/small_system.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define RHO 1.3
#define MU  0.7

static const char bodies_text[] =
    "local dim = param('dim', 2, 'dimension')\nlocal how = param('how', 'sharp', 'formulation')\n"
    "mesh { box = dim == 3 and {{0, 0, 0}, {2, 1, 1}} or {{0, 0}, {2, 1}},\n"
    "  cells = dim == 3 and {6, 4, 4} or {17, 9}, shape = param('shape', 'quads', 'cells') }\n"
    "fluid { density = 1.3, viscosity = 0.7, gravity = dim == 3 and {0.1, 0, -2} or {0.1, -2} }\n"
    "term 'continuity' {}\nterm 'momentum' { force = function(x, y) return x * y, y - x, 1 end }\n"
    "particulate(how)\nterm 'contact.repulsion' { range = 0.3 }\nterm 'contact.lubrication' {}\n"
    "boundary '*' { u = dim == 3 and {0, 0, 0} or {0, 0} }\nboundary 'left' { pressure = 2 }\n"
    "boundary 'right' { traction = dim == 3 and {1, 2, 3} or {1, 2} }\n"
    "particle { shape = dim == 3 and sphere { radius = 0.3 } or disk { radius = 0.2 }, density = 2,\n"
    "  at = dim == 3 and {0.8, 0.5, 0.4} or {0.8, 0.3} }\n"
    "particle { shape = dim == 3 and sphere { radius = 0.3 } or disk { radius = 0.15 }, density = 3,\n"
    "  at = dim == 3 and {1.5, 0.5, 0.5} or {1.2, 0.35} }\n"
    "time { step = 0.1, stop = 1 }\n";

static const char box_text[] =
    "local dim = param('dim', 2, 'dimension')\n"
    "mesh { box = dim == 3 and {{0, 0, 0}, {2, 1, 1}} or {{0, 0}, {2, 1}},\n"
    "  cells = dim == 3 and {3, 2, 2} or {7, 5}, shape = param('shape', 'quads', 'cells') }\n"
    "fluid { density = 1.3, viscosity = 0.7 }\nterm 'continuity' {}\nterm 'momentum' {}\n"
    "boundary '*' { natural = true }\ntime { step = 0.1, stop = 1 }\n";

typedef struct asked {
    opened *k;
    assembly_power power;
    double *x, *history, *residual;
    newton_time time;
} asked;

static asked ask(const char *text, const char *const *set, int n)
{
    asked q = {.k = open_text(text, set, n)};
    problem *p = &q.k->p;

    assert_int_equal(problem_initial(p, &q.k->err), 0);
    q.power.use = calloc((size_t)p->system.assembly.n_use, sizeof *q.power.use);
    q.x = calloc((size_t)(3 * p->space.n_dof), sizeof *q.x);
    assert_non_null(q.power.use);
    assert_non_null(q.x);
    q.history = q.x + p->space.n_dof;
    q.residual = q.history + p->space.n_dof;
    for (int f = 0; f < p->space.n_field; f++)
        if (strstr(" u U omega ", p->space.field[f].name))
            q.power.fields |= 1u << f;
    q.time = (newton_time){.t = 0.1, .dt = 0.1, .shift = 10, .history = q.history, .bodies = problem_points(p)};
    return q;
}

static void drop(asked *q)
{
    close_case(q->k);
    free(q->power.use);
    free(q->x);
}

static void evaluate(asked *q)
{
    q->time.power = &q->power;
    assert_int_equal(newton_residual(&q->k->p.system, &q->time, q->x, q->residual, &q->k->err), 0);
}

/* The number of a term, by its name. */
static int term(const asked *q, const char *name)
{
    const assembly *a = &q->k->p.system.assembly;

    for (int i = 0; i < a->n_use; i++)
        if (strcmp(a->use[i]->term->name, name) == 0)
            return i;
    fail_msg("no term %s", name);
    return -1;
}

/* Unknowns at random; the powers of all terms are the rows of the velocities times these. */
static void check_sum(const char *dim, const char *how, const char *shape)
{
    const char *set[] = {dim, how, shape};
    asked q = ask(bodies_text, set, 3);
    const space *s = &q.k->p.space;
    double sum = 0, rows = 0, size = 0;

    fill_random(q.x, s->n_dof, 1);
    fill_random(q.history, s->n_dof, 2);
    bodies_clear(&q.k->p.bodies, q.k->p.bodies.now, q.x);
    evaluate(&q);
    for (int i = 0; i < q.k->p.system.assembly.n_use; i++) {
        sum += q.power.use[i][POWER_ALL];
        size += fabs(q.power.use[i][POWER_ALL]);
    }
    for (int64_t d = 0; d < s->n_dof; d++)
        if (q.power.fields >> s->dof_field[d] & 1)
            rows += q.residual[d] * q.x[d];
    assert_true(size > 0);
    if (!(fabs(sum - rows) <= 1e-12 * size))
        fail_msg("%s %s %s: terms %.17g, rows %.17g, of %g", dim, how, shape, sum, rows, size);
    drop(&q);
}

static void powers_add_up_to_the_rows_of_the_velocities(void **state)
{
    (void)state;
    check_sum("dim=2", "how=sharp", "shape=quads");
    check_sum("dim=2", "how=sharp", "shape=triangles");
    check_sum("dim=2", "how=conservative", "shape=quads");
    check_sum("dim=3", "how=sharp", "shape=hexes");
    check_sum("dim=3", "how=conservative", "shape=tets");
}

/* u = (y, 2 x): kinetic energy, and what stress and convection do, by hand. */
static void powers_of_single_terms_are_known(void **state)
{
    static const char *const sets[][2] = {
        {"dim=2", "shape=quads"}, {"dim=2", "shape=triangles"}, {"dim=3", "shape=hexes"}, {"dim=3", "shape=tets"}};
    const double square = 2 * (1.0 / 3 + 4 * 4.0 / 3); /* int |u|^2 over the box */

    (void)state;
    for (size_t k = 0; k < sizeof sets / sizeof *sets; k++) {
        asked q = ask(box_text, sets[k], 2);
        const problem *p = &q.k->p;
        int u = space_find_field(&p->space, "u");
        const double *inertia, *stress, *convection;

        for (int64_t n = 0; n < p->mesh.n_node; n++) {
            const double *x = p->mesh.x + n * p->mesh.dim;

            q.x[p->space.first[u][n]] = x[1];
            q.x[p->space.first[u][n] + 1] = 2 * x[0];
        }
        for (int64_t d = 0; d < p->space.n_dof; d++)
            q.history[d] = -8 * q.x[d]; /* du/dt = 10 u - 8 u */
        evaluate(&q);
        inertia = q.power.use[term(&q, "inertia")];
        stress = q.power.use[term(&q, "viscous")];
        convection = q.power.use[term(&q, "convection")];
        assert_near(inertia[POWER_KINETIC], 0.5 * RHO * square, 1e-12);
        assert_near(inertia[POWER_ALL], 2 * RHO * square, 1e-12);
        assert_near(inertia[POWER_REST], 0, 1e-12);
        assert_near(stress[POWER_ALL], MU * 2 * 9, 1e-12);
        assert_near(stress[POWER_REST], stress[POWER_ALL], 0);
        assert_near(stress[POWER_KINETIC], 0, 0);
        /* (u . grad) u = (2 x, 2 y): times u it is 6 x y, and the integral of x y is 1 */
        assert_near(convection[POWER_ALL], RHO * 6, 1e-12);
        drop(&q);
    }
}

/* Weight stands in one term with the inertia of a body. */
static void a_body_has_its_kinetic_energy_and_its_weight(void **state)
{
    const char *set[] = {"dim=2", "how=sharp"};
    asked q = ask(bodies_text, set, 2);
    const problem *p = &q.k->p;
    const double mass[2] = {2 * M_PI * 0.04, 3 * M_PI * 0.0225};
    const double *move, *turn;
    double kinetic[2] = {0}, weight = 0;

    (void)state;
    for (int k = 0; k < 2; k++) {
        double *v = q.x + bodies_dof(&p->bodies, k, 0), *w = q.x + bodies_dof(&p->bodies, k, 1);
        double radius = k ? 0.15 : 0.2;

        v[0] = 0.3 + k;
        v[1] = -2;
        *w = 4 - k;
        kinetic[0] += 0.5 * mass[k] * (v[0] * v[0] + v[1] * v[1]);
        kinetic[1] += 0.25 * mass[k] * radius * radius * *w * *w;
        weight -= mass[k] * (0.1 * v[0] - 2 * v[1]);
    }
    evaluate(&q);
    move = q.power.use[term(&q, "translation")];
    turn = q.power.use[term(&q, "rotation")];
    assert_near(move[POWER_KINETIC], kinetic[0], 1e-9 * kinetic[0]);
    assert_near(turn[POWER_KINETIC], kinetic[1], 1e-9 * kinetic[1]);
    assert_near(move[POWER_REST], weight, 1e-9 * fabs(weight));
    assert_near(move[POWER_ALL], weight + 20 * kinetic[0], 1e-9 * kinetic[0]); /* du/dt = 10 u */
    drop(&q);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(powers_add_up_to_the_rows_of_the_velocities),
        cmocka_unit_test(powers_of_single_terms_are_known),
        cmocka_unit_test(a_body_has_its_kinetic_energy_and_its_weight),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
