/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * No position at which sharp bodies degrade: at 500 random places of a disk and of a sphere in their exact flows
 * the symmetric part of the velocity block is positive definite (sparse Cholesky), the linear system is solved to
 * 1e-10, and the force has no outlier. */
#include "support/opened.h"
#include "support/program.h"

#include <cholmod.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { POSITIONS = 500 };

/* What one position gives: largest part of the velocity block that is not positive definite is told by definite =
 * 0. */
typedef struct outcome {
    int definite;
    double smallest, residual, force;
} outcome;

static int is_velocity(const problem *p, int64_t free_unknown)
{
    int32_t d = p->space.dof_of[free_unknown];

    return strcmp(p->space.field[p->space.dof_field[d]].name, "u") == 0 && !p->bodies.now->idle[d];
}

/* Symmetric part of the velocity block, in place in a cholmod matrix (upper triangle by rows = lower by columns).
 */
static cholmod_sparse *velocity_block(const problem *p, cholmod_common *c)
{
    const space *s = &p->space;
    int *number = malloc((size_t)s->n_free * sizeof *number), n = 0;
    cholmod_triplet *t;
    cholmod_sparse *a;

    for (int64_t i = 0; i < s->n_free; i++)
        number[i] = is_velocity(p, i) ? n++ : -1;
    t = cholmod_allocate_triplet((size_t)n, (size_t)n, (size_t)s->row[s->n_free], 1, CHOLMOD_REAL, c);
    for (int64_t i = 0; i < s->n_free; i++)
        for (int64_t e = s->row[i]; number[i] >= 0 && e < s->row[i + 1]; e++) {
            int row = number[i], col = number[space_column(s, i, e)];

            if (col < 0)
                continue; /* entries of (i, j) and (j, i) add up to the symmetric part in the upper triangle */
            ((int *)t->i)[t->nnz] = row < col ? row : col;
            ((int *)t->j)[t->nnz] = row < col ? col : row;
            ((double *)t->x)[t->nnz++] = (row == col ? 1 : 0.5) * p->system.linear.value[e];
        }
    a = cholmod_triplet_to_sparse(t, t->nnz, c);
    cholmod_free_triplet(&t, c);
    free(number);
    return a;
}

/* Smallest eigenvalue relative to the diagonal's mean, by inverse iteration; 0 if the block is not definite. */
static double smallest_eigenvalue(cholmod_sparse *a, cholmod_common *c)
{
    cholmod_factor *l = cholmod_analyze(a, c);
    cholmod_dense *x, *y;
    double value = 0;

    cholmod_factorize(a, l, c);
    if (c->status == CHOLMOD_OK && l->minor == a->nrow) {
        x = cholmod_ones(a->nrow, 1, CHOLMOD_REAL, c);
        for (size_t i = 0; i < a->nrow; i++)
            ((double *)x->x)[i] = sin(1.7 * (double)i) + 0.2;
        for (int k = 0; k < 30; k++) {
            y = cholmod_solve(CHOLMOD_A, l, x, c);
            value = 1 / cholmod_norm_dense(y, 2, c);
            for (size_t i = 0; i < a->nrow; i++)
                ((double *)y->x)[i] *= value;
            cholmod_free_dense(&x, c);
            x = y;
        }
        cholmod_free_dense(&x, c);
    }
    cholmod_free_factor(&l, c);
    return value;
}

static outcome at_position(const char *file, const char *const *sets, int n_set, double unit, cholmod_common *c)
{
    error err = {0};
    opened *k = open_case(file, sets, n_set);
    problem *p = &k->p;
    outcome o = {0};
    newton_report report;
    cholmod_sparse *a;
    int64_t u;

    if (problem_initial(p, &err))
        fail_msg("%s", err.text);
    if (newton_solve(&p->system, &(newton_time){.bodies = problem_points(p)}, &p->newton, p->state.x, &report,
                     &err) ||
        !report.converged)
        fail_msg("%s %s: %s", sets[n_set - 2], sets[n_set - 1], report.why);
    o.residual = p->system.linear.stats.worst_residual;
    if (assembly_run(&p->system.assembly,
                     &(assembly_state){.x = p->state.x,
                                       .dot = p->system.work,
                                       .old = p->state.x,
                                       .bodies = problem_points(p),
                                       .only = PF_FLUID_FORCE},
                     p->system.residual, p->system.linear.value, 0, &err))
        fail_msg("%s", err.text);
    u = bodies_dof(&p->bodies, 0, 0);
    o.force = p->system.residual[u] / unit;
    memset(p->system.work, 0, (size_t)p->space.n_dof * sizeof(double));
    if (assembly_run(&p->system.assembly,
                     &(assembly_state){
                         .x = p->state.x, .dot = p->system.work, .old = p->state.x, .bodies = problem_points(p)},
                     p->system.residual, p->system.linear.value, 0, &err))
        fail_msg("%s", err.text);
    a = velocity_block(p, c);
    o.smallest = smallest_eigenvalue(a, c);
    o.definite = o.smallest > 0;
    cholmod_free_sparse(&a, c);
    close_case(k);
    return o;
}

static void positions(const char *file, const char *name, int n, double unit, double scatter)
{
    unsigned s = 11;
    double least = INFINITY, residual = 0, low = INFINITY, high = -INFINITY, mean = 0, square = 0;
    int indefinite = 0;
    cholmod_common c;

    cholmod_start(&c);
    c.print = 0;
    for (int k = 0; k < POSITIONS; k++) {
        char set[5][40];
        const char *sets[5] = {set[0], set[1], set[2], set[3], set[4]};
        outcome o;

        snprintf(set[0], sizeof set[0], "n=%d", n);
        snprintf(set[1], sizeof set[1], "formulation=sharp");
        for (int i = 0; i < 3; i++) {
            s = s * 1664525u + 1013904223u;
            snprintf(set[2 + i], sizeof set[2 + i], "%c0=%.9f", 'x' + i, ((s >> 8) / 16777216.0 - 0.5) / n);
        }
        o = at_position(file, sets, strstr(file, "sphere") ? 5 : 4, unit, &c);
        indefinite += !o.definite;
        least = fmin(least, o.smallest);
        residual = fmax(residual, o.residual);
        low = fmin(low, o.force - 1);
        high = fmax(high, o.force - 1);
        mean += (o.force - 1) / POSITIONS;
        square += (o.force - 1) * (o.force - 1) / POSITIONS;
    }
    cholmod_finish(&c);
    print_message("# %s, n = %d, %d places: %d indefinite, smallest eigenvalue %.2e, largest residual %.1e, force "
                  "%.3f +- %.3f %%, "
                  "from %.3f to %.3f %%\n",
                  name, n, POSITIONS, indefinite, least, residual, 100 * mean,
                  100 * sqrt(fmax(0, square - mean * mean)), 100 * low, 100 * high);
    assert_int_equal(indefinite, 0);
    assert_between(residual, 0, 1e-10);
    square = sqrt(square - mean * mean);
    assert_between(square, 0, scatter);
    assert_between(low, mean - 5 * square, mean);
    assert_between(high, mean, mean + 5 * square);
}

static void disk_at_500_places(void **state)
{
    (void)state;
    positions("cases/fixed_disk.lua", "disk", 10, 4 * M_PI, 0.001);
}

static void sphere_at_500_places(void **state)
{
    (void)state;
    positions("cases/fixed_sphere.lua", "sphere", 6, 6 * M_PI * 0.25, 0.003);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(disk_at_500_places),
        cmocka_unit_test(sphere_at_500_places),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
