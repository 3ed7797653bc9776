/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A linear solver that is not made for any system, and says so: what it says shows that it was found. */
#include <plugflow/solver.h>

#include <stdio.h>

static int create(void **self, int n_thread, char *err, size_t nerr)
{
    static int nothing;

    (void)n_thread, (void)err, (void)nerr;
    *self = &nothing;
    return PF_SOLVER_OK;
}

static int analyze(void *self, const pf_csr *A, pf_solver_cost *cost, char *err, size_t nerr)
{
    (void)self, (void)A, (void)cost;
    snprintf(err, nerr, "the test was here");
    return PF_SOLVER_UNFIT;
}

static int setup(void *self, const pf_csr *A, char *err, size_t nerr)
{
    (void)self, (void)A, (void)err, (void)nerr;
    return PF_SOLVER_SINGULAR;
}

static int solve(void *self, const double *b, double *x, char *err, size_t nerr)
{
    (void)self, (void)b, (void)x, (void)err, (void)nerr;
    return PF_SOLVER_SINGULAR;
}

static void destroy(void *self)
{
    (void)self;
}

static const pf_solver declines = {.size = sizeof declines,
                                   .major = PF_SOLVER_MAJOR,
                                   .sizes = PF_SIZES,
                                   .name = "declines",
                                   .version = "1.0",
                                   .doc = "of a test",
                                   .create = create,
                                   .analyze = analyze,
                                   .setup = setup,
                                   .solve = solve,
                                   .destroy = destroy};

PF_EXPORT const pf_solver *pf_solver_entry(char *err, size_t nerr)
{
    (void)err, (void)nerr;
    return &declines;
}
