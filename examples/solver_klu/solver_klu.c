/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * KLU (Davis and Palamadai Natarajan 2010, ACM Trans. Math. Softw. 37:36), a factorisation with an ordering that is
 * a choice of the case.  It has columns where plugflow has rows: it factors A^T and solves with the transpose of
 * that. */
#include <plugflow/solver.h>

#include <klu.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct options {
    double pivot;
    int ordering;
};

struct klu {
    klu_l_common common;
    klu_l_symbolic *symbolic;
    klu_l_numeric *numeric;
};

static int create(void **self, int n_thread, char *err, size_t nerr)
{
    struct klu *k = *self = calloc(1, sizeof *k);

    (void)n_thread;
    return k && klu_l_defaults(&k->common) ? PF_SOLVER_OK : (snprintf(err, nerr, "no memory"), PF_SOLVER_MEMORY);
}

static int configure(void *self, const void *params, char *err, size_t nerr)
{
    const struct options *o = params;
    struct klu *k = self;

    (void)err, (void)nerr;
    k->common.tol = o->pivot;
    k->common.ordering = o->ordering;
    return PF_SOLVER_OK;
}

static int analyze(void *self, const pf_csr *a, pf_solver_cost *cost, char *err, size_t nerr)
{
    struct klu *k = self;

    klu_l_free_numeric(&k->numeric, &k->common);
    klu_l_free_symbolic(&k->symbolic, &k->common);
    k->symbolic = klu_l_analyze(a->n, (int64_t *)a->row, (int64_t *)a->col, &k->common);
    if (!k->symbolic)
        return snprintf(err, nerr, "klu_l_analyze: status %d", (int)k->common.status), PF_SOLVER_MEMORY;
    cost->fill = k->symbolic->lnz > 0 ? 2 * k->symbolic->lnz : 10. * (double)a->row[a->n]; /* colamd counts none */
    cost->flops = cost->fill * cost->fill / (double)a->n;
    cost->bytes = 16 * cost->fill;
    return PF_SOLVER_OK;
}

static int setup(void *self, const pf_csr *a, char *err, size_t nerr)
{
    struct klu *k = self;

    klu_l_free_numeric(&k->numeric, &k->common);
    k->numeric = klu_l_factor((int64_t *)a->row, (int64_t *)a->col, (double *)a->value, k->symbolic, &k->common);
    if (k->numeric && klu_l_rcond(k->symbolic, k->numeric, &k->common) && k->common.rcond > 1e-18)
        return PF_SOLVER_OK;
    snprintf(err, nerr, "klu_l_factor: status %d, least pivot %g", (int)k->common.status, k->common.rcond);
    return k->common.status == KLU_OUT_OF_MEMORY ? PF_SOLVER_MEMORY : PF_SOLVER_SINGULAR;
}

static int solve(void *self, const double *b, double *x, char *err, size_t nerr)
{
    struct klu *k = self;

    memcpy(x, b, (size_t)k->symbolic->n * sizeof *x);
    if (klu_l_tsolve(k->symbolic, k->numeric, k->symbolic->n, 1, x, &k->common))
        return PF_SOLVER_OK;
    return snprintf(err, nerr, "klu_l_tsolve: status %d", (int)k->common.status), PF_SOLVER_ERROR;
}

static void destroy(void *self)
{
    struct klu *k = self;

    klu_l_free_numeric(&k->numeric, &k->common);
    klu_l_free_symbolic(&k->symbolic, &k->common);
    free(k);
}

static const char *const orderings[] = {"amd", "colamd", NULL};

PF_SOLVER(.name = "klu", .version = "1.0", .doc = "KLU, a factorisation for matrices of few entries",
          .create = create, .analyze = analyze, .setup = setup, .solve = solve, .destroy = destroy,
          .configure = configure,
          PF_PARAMS(struct options,
                    PF_NUMBER(struct options, pivot, "1",
                              "least share of the largest entry that a diagonal pivot has", .dflt = 1e-3, .min = 0,
                              .max = 1),
                    {"ordering", "1", "of the unknowns", PF_T_CHOICE, 0, offsetof(struct options, ordering),
                     .choice = orderings}))
