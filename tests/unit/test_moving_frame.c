/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * History near moving bodies (core/body/paths.c): what holds for any path, what the paths of the design
 * do, and the derivative of du/dt along them. */
#include "support/opened.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char case_text[] = "local dim = param('dim', 2, 'dimension')\n"
                                "local solid = dim == 3\n"
                                "mesh { box = solid and {{0, 0, 0}, {2, 1, 1}} or {{0, 0}, {2, 1}}, cells = solid "
                                "and {10, 5, 5} or {24, 12} }\n"
                                "fluid { density = 1.3, viscosity = 0.7, region = 'outside' }\n"
                                "term 'continuity' {}\nterm 'momentum' {}\nparticulate('sharp', { inflow = 0 })\n"
                                "boundary '*' { u = solid and {0, 0, 0} or {0, 0} }\n"
                                "particle { shape = solid and ellipsoid { a = 0.3, b = 0.25, c = 0.25 } or ellipse "
                                "{ a = 0.2, b = 0.15 }, density = 2,\n"
                                "  at = solid and {0.8, 0.5, 0.5} or {0.8, 0.5} }\n"
                                "particle { shape = solid and sphere { radius = 0.25 } or disk { radius = 0.12 }, "
                                "density = 2, motion = 'fixed',\n"
                                "  at = solid and {1.62, 0.5, 0.5} or {1.3, 0.5} }\n"
                                "time { scheme = 'bdf2', step = 0.1, stop = 1 }\n";

/* Coefficients of BDF2 with dt = 0.1. */
static const double now = 15, then[2] = {-20, 5};
static const double way[3] = {0.06, 0.021, 0.013}, turn[3] = {0.04, -0.03, 0.05};

typedef struct moved {
    opened *k;
    double *u[2], *history;
    pose then[2]; /* a step ago */
    const moving_frame *frame;
} moved;

/* The first body has come two steps of `way` and, unless still, of `turn`. */
static moved move_body(int dim, int turns)
{
    const char *set[] = {dim == 3 ? "dim=3" : "dim=2"};
    moved m = {.k = open_text(case_text, set, 1)};
    problem *p = &m.k->p;
    enum placement_change change;
    error err = {0};

    m.history = calloc((size_t)(3 * p->space.n_dof), sizeof(double));
    assert_non_null(m.history);
    for (int l = 0; l < 2; l++)
        m.u[l] = m.history + (l + 1) * p->space.n_dof;
    assert_int_equal(problem_initial(p, &err), 0);
    for (int step = 0; step < 3; step++) { /* two steps ago, a step ago, now */
        if (step == 2)
            memcpy(m.then, p->state.pose, 2 * sizeof *m.then);
        for (int b = 0; step && b < dim; b++) {
            p->state.pose[0].x[b] += way[b];
            p->state.pose[0].way[b] += way[b];
        }
        if (step && turns)
            pose_turn(&p->state.pose[0], dim, turn);
    }
    assert_int_equal(bodies_place(&p->bodies, p->state.pose, &change, &err), 0);
    if (change == PLACEMENT_PATTERN)
        assert_int_equal(system_renew(&p->system, &err), 0);
    bodies_clear(&p->bodies, p->bodies.now, p->state.x);
    return m;
}

static void drop(moved *m)
{
    free(m->history);
    close_case(m->k);
}

/* A velocity that is linear in x, and its gradient. */
static double sheared(int a, const double *x, double *gradient)
{
    static const double g[3][3] = {{0.7, -1.1, 0.4}, {0.9, 0.3, -0.6}, {-0.2, 0.5, -1.0}};
    double v = 0.3 + a;

    for (int b = 0; b < 3; b++) {
        v += g[a][b] * x[b];
        gradient[b] = g[a][b];
    }
    return v;
}

/* Sets the velocity of both levels, f(place less `carried` times the way gone until now). */
static void set_levels(moved *m, double (*f)(int, const double *, double *), double carried)
{
    problem *p = &m->k->p;
    int u = space_find_field(&p->space, "u");

    for (int l = 0; l < 2; l++)
        for (int64_t n = 0; n < p->mesh.n_node; n++) {
            double x[3] = {0}, ignored[3];

            for (int b = 0; b < p->mesh.dim; b++)
                x[b] = p->mesh.x[n * p->mesh.dim + b] + carried * (l + 1) * way[b];
            for (int a = 0; a < p->mesh.dim; a++)
                m->u[l][p->space.first[u][n] + a] = f(a, x, ignored);
        }
    for (int64_t d = 0; d < p->space.n_dof; d++)
        m->history[d] = then[0] * m->u[0][d] + then[1] * m->u[1][d];
    m->frame = bodies_paths(&p->bodies, p->bodies.now, 2, then, (const double *[]){m->u[0], m->u[1]},
                            (const pose *[]){m->then, p->state.pose_before}, m->history);
    assert_non_null(m->frame);
}

static void centre(const problem *p, int64_t cell, int i, double *x)
{
    memset(x, 0, 3 * sizeof *x);
    for (int b = 0; b < p->mesh.dim; b++) /* a node, a little towards the opposite one */
        x[b] = 0.9 * p->mesh.x[(int64_t)p->mesh.cell[cell * p->mesh.type->n_node + i] * p->mesh.dim + b] +
               0.1 * p->mesh.x[(int64_t)p->mesh.cell[cell * p->mesh.type->n_node + (i ? 0 : 2)] * p->mesh.dim + b];
}

/* c_0 u + history - w . grad u = 0: a steady velocity that is linear in x has no du/dt, whatever the path. */
static void a_linear_velocity_has_no_rate(void **state)
{
    (void)state;
    for (int dim = 2; dim <= 3; dim++) {
        moved m = move_body(dim, 1);
        problem *p = &m.k->p;
        int64_t moves = 0;

        set_levels(&m, sheared, 0);
        for (int64_t cell = 0; cell < p->mesh.n_cell; cell++)
            for (int i = 0; i < p->mesh.type->n_node; i++) {
                double x[3], w[3], h[3], g[3];

                centre(p, cell, i, x);
                if (p->bodies.now->cover[cell] > COVER_PART || !m.frame->at(m.frame->ctx, cell, x, w, h))
                    continue;
                moves++;
                for (int a = 0; a < dim; a++) {
                    double rate = now * sheared(a, x, g) + h[a];

                    for (int b = 0; b < dim; b++)
                        rate -= w[b] * g[b];
                    assert_true(fabs(rate) < 1e-11 * now);
                }
            }
        assert_true(moves > (dim == 2 ? 400 : 1000));
        drop(&m);
    }
}

/* Bodies all round, in a periodic box: a path does not depend on whether those near it are looked up in the grid.
 */
static void the_grid_of_bodies_misses_none(void **state)
{
    static const char text[] = "case 'Disks'\nmesh { box = {{0, 0}, {2, 1}}, cells = {48, 24} }\n"
                               "fluid { density = 1, viscosity = 1, region = 'outside' }\n"
                               "term 'continuity' {}\nterm 'momentum' {}\nparticulate('sharp', { inflow = 0 })\n"
                               "boundary { periodic = {'left', 'right'} }\n"
                               "boundary 'bottom' { u = {0, 0} }\nboundary 'top' { u = {0, 0} }\n"
                               "particles { n = 12, shape = disk { radius = 0.09 }, density = 2,\n"
                               "  inside = {{0.1, 0.1}, {1.9, 0.9}}, gap = 0.01, seed = 2 }\n"
                               "particle { shape = ellipse { a = 0.05, b = 0.03 }, density = 2, at = {0, 0.5} }\n"
                               "time { scheme = 'bdf2', step = 0.1, stop = 1 }\n";
    moved m = {.k = open_text(text, NULL, 0)};
    problem *p = &m.k->p;
    pose old[2][13];
    int64_t moves = 0;

    (void)state;
    assert_int_equal(problem_initial(p, &m.k->err), 0);
    m.history = calloc((size_t)(3 * p->space.n_dof), sizeof(double));
    assert_non_null(m.history);
    fill_random(m.history, 3 * p->space.n_dof, 4);
    for (int l = 0; l < 2; l++)
        for (int b = 0; b < 13; b++) {
            old[l][b] = p->state.pose[b];
            for (int k = 0; k < 2; k++)
                old[l][b].way[k] -= (l + 1) * way[k] * (1 + 0.1 * b);
        }
    m.frame =
        bodies_paths(&p->bodies, p->bodies.now, 2, then, (const double *[]){m.history, m.history + p->space.n_dof},
                     (const pose *[]){old[0], old[1]}, m.history + 2 * p->space.n_dof);
    assert_non_null(m.frame);
    assert_true(p->bodies.paths.near.n_box > 13);
    for (int64_t cell = 0; cell < p->mesh.n_cell; cell++) {
        int64_t n = p->bodies.paths.near.n_box;
        double x[3], w[2][3] = {{0}}, h[2][3] = {{0}};
        int any[2];

        centre(p, cell, 1, x);
        any[0] = m.frame->at(m.frame->ctx, cell, x, w[0], h[0]);
        p->bodies.paths.near.n_box = 0; /* without a grid all are looked at */
        any[1] = m.frame->at(m.frame->ctx, cell, x, w[1], h[1]);
        p->bodies.paths.near.n_box = n;
        assert_int_equal(any[0], any[1]);
        assert_memory_equal(w[0], w[1], sizeof w[0]);
        assert_memory_equal(h[0], h[1], sizeof h[0]);
        moves += any[0];
    }
    assert_true(moves > 500);
    drop(&m);
}

static double bent(int a, const double *x, double *gradient)
{
    (void)gradient;
    return (a + 1) * x[0] * x[0] - x[0] * x[1] + (0.5 - a) * x[1] * x[1] + 0.3 * x[2] * x[2];
}

/* What the body carries with it is steady in its frame: beside the surface, where the path is the body's, history
 * cancels c_0 u, and w is the velocity of the body; at the other body, which stands, nothing moves. */
static void what_a_body_carries_is_steady_along_its_path(void **state)
{
    (void)state;
    for (int dim = 2; dim <= 3; dim++) {
        moved m = move_body(dim, 0);
        problem *p = &m.k->p;

        set_levels(&m, bent, 1);
        for (int side = 0; side < 2 * dim; side++)
            for (int body = 0; body < 2; body++) {
                const solid *q = &p->bodies.now->body[body];
                double x[3] = {q->at.x[0], q->at.x[1], q->at.x[2]}, w[3] = {0}, h[3], ignored[3];
                int64_t cell;
                int moves;

                x[side / 2] += (side % 2 ? 1 : -1) * (q->shape->half[side / 2] * (1 + 1e-9));
                cell_grid_ball(p->bodies.grid, x, 0, p->bodies.near_cell);
                cell = p->bodies.near_cell[0];
                moves = m.frame->at(m.frame->ctx, cell, x, w, h);
                assert_true(moves == (body == 0) || (body == 1 && fabs(w[0]) < 1e-6));
                for (int a = 0; body == 0 && a < dim; a++) {
                    assert_true(fabs(w[a] - way[a] * 10) < 1e-6);
                    assert_true(fabs(now * bent(a, x, ignored) + h[a]) < 1e-5);
                }
            }
        drop(&m);
    }
}

/* The matrix is the derivative of the residual: central differences are exact where this is quadratic, as it is but
 * for surface.inflow, which the case here switches off. */
static void the_jacobian_knows_the_paths(void **state)
{
    (void)state;
    for (int dim = 2; dim <= 3; dim++) {
        moved m = move_body(dim, 1);
        problem *p = &m.k->p;
        space *s = &p->space;
        int64_t n = s->n_dof;
        double *x = calloc((size_t)(6 * n), sizeof *x), *v = x + n, *y = x + 2 * n, *dot = x + 3 * n,
               *r = x + 4 * n;
        double *product = x + 5 * n, worst = 0, size = 0;
        assembly_state at = {
            .t = 0.3, .dt = 0.1, .shift = now, .x = y, .dot = dot, .old = y, .bodies = problem_points(p)};
        error err = {0};

        set_levels(&m, bent, 1);
        at.frame = m.frame;
        fill_random(x, n, 5);
        fill_random(v, n, 7);
        for (int64_t d = 0; d < n; d++)
            v[d] *= s->fixed[d] || p->bodies.now->idle[d] ? 0 : 1;
        for (int side = 1; side >= -1; side -= 1) { /* r(x + v) - r(x - v), then the matrix at x */
            for (int64_t d = 0; d < n; d++) {
                y[d] = x[d] + side * v[d];
                dot[d] = now * y[d] + m.history[d];
            }
            if (side == 0)
                continue;
            assert_int_equal(assembly_run(&p->system.assembly, &at, p->system.residual, NULL, 0, &err), 0);
            for (int64_t d = 0; d < n; d++)
                r[d] += 0.5 * side * p->system.residual[d];
        }
        memcpy(y, x, (size_t)n * sizeof *y);
        for (int64_t d = 0; d < n; d++)
            dot[d] = now * y[d] + m.history[d];
        assert_int_equal(
            assembly_run(&p->system.assembly, &at, p->system.residual, p->system.linear.value, 0, &err), 0);
        for (int64_t i = 0; i < s->n_free; i++)
            for (int64_t k = s->row[i]; k < s->row[i + 1]; k++)
                product[s->dof_of[i]] += p->system.linear.value[k] * v[s->dof_of[space_column(s, i, k)]];
        for (int64_t i = 0; i < s->n_free; i++) {
            int64_t d = s->dof_of[i];

            worst = fmax(worst, fabs(product[d] - r[d]));
            size = fmax(size, fabs(r[d]));
        }
        print_message("# %dD: matrix against differences of the residual %.1e\n", dim, worst / size);
        assert_true(worst < 1e-10 * size);
        free(x);
        drop(&m);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_linear_velocity_has_no_rate),
        cmocka_unit_test(the_grid_of_bodies_misses_none),
        cmocka_unit_test(what_a_body_carries_is_steady_along_its_path),
        cmocka_unit_test(the_jacobian_knows_the_paths),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
