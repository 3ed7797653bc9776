/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Bodies that move on: room in the pattern of the matrix, and factors of before that serve on. */
#include "support/opened.h"
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char disk[] = "local how = param('how', 'sharp', 'formulation')\n"
                           "mesh { box = {{0, 0}, {3, 2}}, cells = {36, 24} }\n"
                           "fluid { density = 1.3, viscosity = 0.2 }\n"
                           "term 'continuity' {}\nterm 'momentum' {}\nparticulate(how)\n"
                           "boundary 'left' { u = {1, 0} }\nboundary 'bottom' { u = {0, 0} }\n"
                           "boundary 'top' { u = {0, 0} }\nboundary 'right' { natural = true }\n"
                           "particle { shape = disk { radius = 0.25 }, density = 2, at = {1.02, 0.97} }\n"
                           "time { scheme = 'bdf2', step = 0.05, stop = 1 }\n";

enum { CELL = 12 }; /* cells of a unit of length */

typedef struct moving {
    opened *k;
    double *x, *rhs, *old, *fresh;
} moving;

static moving open_disk(const char *how)
{
    moving m = {.k = open_text(disk, &how, 1)};
    int64_t n = m.k->p.space.n_dof;
    error err = {0};

    m.x = calloc((size_t)(4 * n), sizeof *m.x);
    assert_non_null(m.x);
    m.rhs = m.x + n;
    m.old = m.x + 2 * n;
    m.fresh = m.x + 3 * n;
    assert_int_equal(problem_initial(&m.k->p, &err), 0);
    fill_random(m.x, n, 1);
    return m;
}

static void drop(moving *m)
{
    free(m->x);
    close_case(m->k);
}

/* Moves the disk by so many cells, and says what became of the pattern. */
static enum placement_change move(moving *m, double cells_x, double cells_y)
{
    problem *p = &m->k->p;
    enum placement_change change;
    error err = {0};

    p->state.pose[0].x[0] += cells_x / CELL;
    p->state.pose[0].x[1] += cells_y / CELL;
    assert_int_equal(bodies_place(&p->bodies, p->state.pose, &change, &err), 0);
    if (change == PLACEMENT_PATTERN)
        assert_int_equal(system_renew(&p->system, &err), 0);
    assert_int_equal(linear_move(&p->system.linear, &p->bodies.now->points, &err), 0);
    return change;
}

/* The matrix of a step at a flow of about 1, and a right-hand side. */
static void form(moving *m)
{
    problem *p = &m->k->p;
    newton_time time = {.dt = 0.05, .shift = 30, .bodies = &p->bodies.now->points};
    error err = {0};

    for (int64_t d = 0; d < p->space.n_dof; d++) /* fields of a size that varies slowly over the mesh */
        m->old[d] = p->space.fixed[d] ? m->x[d] : 0.5 + 0.1 * m->x[d];
    bodies_clear(&p->bodies, p->bodies.now, m->old);
    assert_int_equal(system_evaluate(&p->system, &time, m->old, 1, 0, &err), 0);
    for (int64_t i = 0; i < p->space.n_free; i++)
        m->rhs[i] = p->bodies.now->idle[p->space.dof_of[i]] ? 0 : m->x[p->space.dof_of[i]];
}

static double distance(int64_t n, const double *a, const double *b)
{
    double d = 0, size = 0;

    for (int64_t i = 0; i < n; i++) {
        d += (a[i] - b[i]) * (a[i] - b[i]);
        size += b[i] * b[i];
    }
    return sqrt(d / size);
}

static void a_disk_that_moves_two_cells_keeps_the_pattern(void **state)
{
    moving m = open_disk("how=sharp");
    int64_t entries = m.k->p.space.row[m.k->p.space.n_free];
    int n = 0;

    (void)state;
    for (int i = 0; i < 16; i++) /* obliquely, over lines of the mesh, in steps of an eighth of a cell */
        n += move(&m, 0.1, 0.07) == PLACEMENT_PATTERN;
    print_message("# other patterns: %d\n", n);
    assert_int_equal(n, 0);
    assert_int_equal(m.k->p.space.row[m.k->p.space.n_free], entries);
    assert_true(m.k->p.bodies.now->tie.n > 0);
    for (int i = 0; i < 2; i++)
        n += move(&m, 1, 0) == PLACEMENT_PATTERN;
    assert_int_equal(n, 1); /* beyond the margin cells are attached anew */
    drop(&m);
}

static void *copy(const void *of, size_t bytes)
{
    void *c = malloc(bytes + 1);

    assert_non_null(c);
    if (bytes)
        memcpy(c, of, bytes);
    return c;
}

/* The pattern as it has become while the disk moved, and as it is if nothing is known of the one before. */
static void check_pattern(const char *how)
{
    moving m = open_disk(how);
    space *s = &m.k->p.space;
    const int cell = s->cell_carriers * s->cell_carriers, tie = 4 * s->mesh->type->n_node * s->mesh->type->n_node;
    error err = {0};
    int n = 0;

    for (int i = 0; i < 24; i++) {
        void *kept[6];
        size_t size[6];

        n += move(&m, 0.5, i < 12 ? 0.3 : -0.4) == PLACEMENT_PATTERN;
        for (int pass = 0; pass < 2; pass++) {
            const size_t entries = (size_t)s->row[s->n_free];
            const void *now[] = {s->row, s->col, s->unused, s->pair, s->more_pair, s->tie_pair};
            const size_t bytes[] = {((size_t)s->n_free + 1) * sizeof *s->row,
                                    (size_t)s->n_col * sizeof *s->col,
                                    s->unused ? entries : 0,
                                    (size_t)(s->mesh->n_cell * cell) * sizeof *s->pair,
                                    (size_t)space_more_pairs(s) * sizeof *s->more_pair,
                                    (size_t)(s->n_tie * tie) * sizeof *s->tie_pair};

            for (int k = 0; k < 6; k++) {
                if (pass) {
                    assert_int_equal(bytes[k], size[k]);
                    assert_memory_equal(now[k] ? now[k] : "", kept[k], bytes[k]);
                    free(kept[k]);
                    continue;
                }
                size[k] = bytes[k];
                kept[k] = copy(now[k], bytes[k]);
            }
            space_graph_free(&s->graph);
            assert_int_equal(system_renew(&m.k->p.system, &err), 0);
        }
    }
    print_message("# %s: %d other patterns\n", how, n);
    assert_true(n > 1);
    drop(&m);
}

static void a_pattern_that_changes_locally_is_as_one_from_scratch(void **state)
{
    (void)state;
    check_pattern("how=sharp");
    check_pattern("how=conservative");
}

/* Entries that are there to spare are zero, and a factorisation does not see them. */
static void spare_entries_are_zero_and_not_factored(void **state)
{
    moving m = open_disk("how=sharp");
    const space *s = &m.k->p.space;
    const linear *l = &m.k->p.system.linear;
    int64_t spare = 0, wrong = 0;
    error err = {0};

    (void)state;
    assert_int_not_equal(move(&m, 1.1, 0.6), PLACEMENT_PATTERN);
    form(&m);
    for (int64_t k = 0; k < s->row[s->n_free]; k++) {
        spare += s->unused[k];
        wrong += s->unused[k] && l->value[k] != 0;
    }
    print_message("# %lld of %lld entries to spare\n", (long long)spare, (long long)s->row[s->n_free]);
    assert_true(spare > 1000);
    assert_int_equal(wrong, 0);
    assert_int_equal(linear_solve(&m.k->p.system.linear, m.rhs, m.fresh, 0, &err), 0);
    assert_int_equal(l->packed.a.row[s->n_free], s->row[s->n_free] - spare);
    assert_true(l->stats.worst_residual < 1e-10);
    drop(&m);
}

/* Factors, then the disk moves: the old ones and the band's against fresh ones. */
static void check_band(const char *how, double cells)
{
    moving m = open_disk(how);
    problem *p = &m.k->p;
    linear *l = &p->system.linear;
    error err = {0};
    double off;
    int made, iterations;

    move(&m, 0.05, 0.05);
    form(&m);
    assert_int_equal(linear_solve(l, m.rhs, m.old, 1e-7, &err), 0);
    made = l->stats.factorisations;
    move(&m, cells, -0.4 * cells);
    form(&m);
    iterations = l->stats.gmres_iterations;
    assert_int_equal(linear_solve(l, m.rhs, m.old, 1e-7, &err), 0);
    iterations = l->stats.gmres_iterations - iterations;
    assert_int_equal(l->stats.factorisations, made);
    assert_int_equal(l->stats.band_factorisations, 1);
    linear_forget(l);
    assert_int_equal(linear_solve(l, m.rhs, m.fresh, 0, &err), 0);
    assert_int_equal(l->stats.factorisations, made + 1);
    off = distance(p->space.n_free, m.old, m.fresh);
    print_message("# %s, %g cells: %d iterations, band of %lld in %lld unknowns, off by %.1e\n", how, cells,
                  iterations, (long long)l->band.a.n, (long long)l->a.n, off);
    assert_true(off < 1e-6);
    assert_true(iterations <= 10);
    drop(&m);
}

static void old_factors_and_a_band_solve_as_fresh_ones(void **state)
{
    (void)state;
    check_band("how=sharp", 0.7);
    check_band("how=sharp", 2.1); /* the same pattern */
    check_band("how=sharp", 5.3); /* another one      */
}

/* Other unknowns, as the multipliers of a body come and go with it. */
static void factors_of_other_unknowns_serve_as_well(void **state)
{
    (void)state;
    check_band("how=conservative", 0.7);
    check_band("how=conservative", 3.3);
}

static void a_falling_disk_takes_few_factorisations(void **state)
{
    double steps;
    ran r = plugflow("run cases/falling_disk.lua --set n=10 --set stop=0.25 --threads 1 --out %s/fall", scratch());

    (void)state;
    assert_int_equal(r.code, 0);
    steps = summary("fall", "steps");
    print_message("# %g steps: %g factorisations, %g of the band, %g patterns\n", steps,
                  summary("fall", "factorisations"), summary("fall", "band_factorisations"),
                  summary("fall", "patterns"));
    assert_between(summary("fall", "factorisations"), 1, 0.25 * steps);
    assert_between(summary("fall", "patterns"), 1, 0.4 * steps);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_disk_that_moves_two_cells_keeps_the_pattern),
        cmocka_unit_test(a_pattern_that_changes_locally_is_as_one_from_scratch),
        cmocka_unit_test(spare_entries_are_zero_and_not_factored),
        cmocka_unit_test(old_factors_and_a_band_solve_as_fresh_ones),
        cmocka_unit_test(factors_of_other_unknowns_serve_as_well),
        cmocka_unit_test(a_falling_disk_takes_few_factorisations),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
