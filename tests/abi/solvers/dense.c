/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A sound linear solver, small enough to plant faults in (faults.txt): Gauss elimination of the full matrix with
 * partial pivoting.  -DROUGH: the same, offered as a preconditioner. */
#include <plugflow/solver.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef ROUGH
enum { FLAGS = PF_SOLVER_APPROXIMATE };
#else
enum { FLAGS = 0 };
#endif

struct dense {
    int64_t n, *swap;
    double *lu, *a; /* [n][n] factors, and the matrix */
    int done;
};

static double *factors(int64_t n)
{
    return malloc((size_t)(n * n) * sizeof(double));
}

static void forget(struct dense *d)
{
    free(d->lu);
    free(d->a);
    free(d->swap);
    d->lu = d->a = NULL;
    d->swap = NULL;
}

static int create(void **self, int n_thread, char *err, size_t nerr)
{
    (void)n_thread;
    *self = calloc(1, sizeof(struct dense));
    return *self ? PF_SOLVER_OK : (snprintf(err, nerr, "no memory"), PF_SOLVER_MEMORY);
}

static int analyze(void *self, const pf_csr *pattern, pf_solver_cost *cost, char *err, size_t nerr)
{
    struct dense *d = self;
    const double n = (double)pattern->n;

    (void)err, (void)nerr;
    forget(d);
    d->n = pattern->n;
    d->lu = factors(d->n);
    d->a = factors(d->n);
    d->swap = malloc((size_t)d->n * sizeof *d->swap);
    *cost = (pf_solver_cost){.bytes = 16 * n * n, .flops = n * n * n, .fill = n * n};
    return d->lu && d->a && d->swap ? PF_SOLVER_OK : PF_SOLVER_MEMORY;
}

static void copy(struct dense *d, const pf_csr *m)
{
    memset(d->a, 0, (size_t)(d->n * d->n) * sizeof *d->a);
    for (int64_t r = 0; r < m->n; r++)
        for (int64_t k = m->row[r]; k < m->row[r + 1]; k++)
            d->a[r * d->n + m->col[k]] = m->value[k];
}

static int eliminate(struct dense *d, int64_t k)
{
    const int64_t n = d->n;
    double *a = d->lu;
    int64_t p = k;

    for (int64_t i = k + 1; i < n; i++)
        p = fabs(a[i * n + k]) > fabs(a[p * n + k]) ? i : p;
    d->swap[k] = p;
    for (int64_t j = 0; j < n && p != k; j++) {
        const double v = a[k * n + j];

        a[k * n + j] = a[p * n + j];
        a[p * n + j] = v;
    }
    if (FLAGS && fabs(a[k * n + k]) < 1e-10)
        a[k * n + k] = 1;
    if (a[k * n + k] == 0)
        return PF_SOLVER_SINGULAR;
    for (int64_t i = k + 1; i < n; i++) {
        const double l = a[i * n + k] /= a[k * n + k];

        for (int64_t j = k + 1; j < n && l != 0; j++)
            a[i * n + j] -= l * a[k * n + j];
    }
    return PF_SOLVER_OK;
}

static int setup(void *self, const pf_csr *m, char *err, size_t nerr)
{
    struct dense *d = self;

    copy(d, m);
    memcpy(d->lu, d->a, (size_t)(d->n * d->n) * sizeof *d->a);
    for (int64_t k = 0; k < d->n; k++)
        if (eliminate(d, k))
            return snprintf(err, nerr, "pivot %lld is zero", (long long)k), PF_SOLVER_SINGULAR;
    d->done = 1;
    return PF_SOLVER_OK;
}

static int solve(void *self, const double *b, double *x, char *err, size_t nerr)
{
    const struct dense *d = self;
    const int64_t n = d->n;

    (void)err, (void)nerr;
    memcpy(x, b, (size_t)n * sizeof *x);
    for (int64_t k = 0; k < n; k++) {
        const double v = x[d->swap[k]];

        x[d->swap[k]] = x[k];
        x[k] = v;
    }
    for (int64_t i = 0; i < n; i++)
        for (int64_t j = 0; j < i; j++)
            x[i] -= d->lu[i * n + j] * x[j];
    for (int64_t i = n; i-- > 0;) {
        for (int64_t j = i + 1; j < n; j++)
            x[i] -= d->lu[i * n + j] * x[j];
        x[i] /= d->lu[i * n + i];
    }
    return PF_SOLVER_OK;
}

static int update(void *self, const pf_csr *m, char *err, size_t nerr)
{
    (void)err, (void)nerr;
    copy(self, m);
    return PF_SOLVER_OK;
}

static void multiply(void *self, const double *x, double *y)
{
    const struct dense *d = self;

    for (int64_t i = 0; i < d->n; i++) {
        y[i] = 0;
        for (int64_t j = 0; j < d->n; j++)
            y[i] += d->a[i * d->n + j] * x[j];
    }
}

static void destroy(void *self)
{
    forget(self);
    free(self);
}

static const pf_solver dense = {.size = sizeof dense,
                                .major = PF_SOLVER_MAJOR,
                                .sizes = PF_SIZES,
                                .name = "dense",
                                .version = "1.0",
                                .doc = "elimination of the full matrix",
                                .create = create,
                                .analyze = analyze,
                                .setup = setup,
                                .solve = solve,
                                .destroy = destroy,
                                .flags = FLAGS,
                                .update = update,
                                .multiply = multiply};

PF_EXPORT const pf_solver *pf_solver_entry(char *err, size_t nerr)
{
    (void)err, (void)nerr;
    return &dense;
}
