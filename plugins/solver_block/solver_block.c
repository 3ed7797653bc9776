/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Block preconditioner for flows, upper triangular:
 *
 *     p = S^-1 r_p,    u = F^-1 (r_u - G p)
 *
 * F^-1: ILU(0) of the velocities with the bodies last, in single precision; where viscosity prevails over inertia
 * a correction on coarser levels comes before it (levels.h).  S^-1: least squares scaled by the diagonal of F
 * (pressure.h).  Nothing of it depends on the geometry but that nodes that are no vertices lie between vertices. */
#include "ilu.h"
#include "levels.h"
#include "options.h"
#include "pressure.h"
#include "split.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct block_solver {
    int n_thread;
    options options;
    split split;
    ilu ilu;
    pressure pressure;
    levels levels;
    int has_levels;
    float *q, *u, *w;    /* [n blocks][b] */
    double *rp, *p, *p2; /* [n_p]         */
    pool memory;
} block_solver;

static int fail(char *err, size_t nerr, int status, const char *what)
{
    snprintf(err, nerr, "%s", what);
    return status;
}

static int create(void **self, int n_thread, char *err, size_t nerr)
{
    block_solver *s = calloc(1, sizeof *s);

    *self = s;
    if (!s)
        return fail(err, nerr, PF_SOLVER_MEMORY, "out of memory");
    s->n_thread = n_thread < 1 ? 1 : n_thread;
    s->options = (options){
        .viscous = VISCOUS, .strength = STRENGTH, .inner = INNER, .inner_iterations = INNER_MOST, .sweeps = SWEEPS};
    return PF_SOLVER_OK;
}

static int configure(void *self, const void *params, char *err, size_t nerr)
{
    (void)err, (void)nerr;
    ((block_solver *)self)->options = *(const options *)params;
    return PF_SOLVER_OK;
}

static void forget(block_solver *s)
{
    pressure_destroy(&s->pressure);
    levels_destroy(&s->levels);
    pool_free(&s->memory);
    s->has_levels = 0;
}

static int analyze(void *self, const pf_csr *a, pf_solver_cost *cost, char *err, size_t nerr)
{
    block_solver *s = self;
    const char *why;
    int field = 0;
    double entries, products = 0;

    if (split_fits(a, &field, &why))
        return fail(err, nerr, PF_SOLVER_UNFIT, why);
    if (a->n > INT32_MAX)
        return fail(err, nerr, PF_SOLVER_UNFIT, "more than 2^31 unknowns");
    forget(s);
    split_analyze(&s->split, a, field, s->n_thread, &s->memory);
    if (s->memory.failed)
        return fail(err, nerr, PF_SOLVER_MEMORY, "out of memory");
    ilu_create(&s->ilu, &s->split.f, &s->memory);
    TAKE(&s->memory, s->q, (int64_t)s->split.f.n * s->split.b);
    TAKE(&s->memory, s->u, (int64_t)s->split.f.n * s->split.b);
    TAKE(&s->memory, s->w, (int64_t)s->split.f.n * s->split.b);
    TAKE(&s->memory, s->rp, s->split.n_p + 1);
    TAKE(&s->memory, s->p, s->split.n_p + 1);
    TAKE(&s->memory, s->p2, s->split.n_p + 1);
    if (s->memory.failed)
        return fail(err, nerr, PF_SOLVER_MEMORY, "out of memory");
    entries = (double)s->split.f.row[s->split.f.n] * s->split.b * s->split.b;
    for (int32_t i = 0; i < s->split.f.n;
         i++) /* of blocks: with half of each row above, half of which may be kept */
        for (int64_t k = s->split.f.row[i]; k < s->split.f.diagonal[i]; k++) {
            int32_t j = s->split.f.col[k];

            products += 0.25 * fmin((double)(s->split.f.row[j + 1] - s->split.f.row[j]),
                                    (double)(s->split.f.row[i + 1] - s->split.f.row[i]));
        }
    cost->fill = 1.5 * entries;
    cost->flops = 2 * products * s->split.b * s->split.b * s->split.b + 20 * entries;
    cost->bytes = 12 * entries;
    return PF_SOLVER_OK;
}

/* Whether viscosity prevails over inertia: by the median, over some blocks, of row sum over diagonal. */
static int is_viscous(const block_solver *s)
{
    const block_matrix *f = &s->split.f;
    int b = f->b, n = 0, viscous = 0;

    for (int32_t i = 0; i < f->n; i += 13) { /* no divisor of what a line of a box has */
        double sum = 0;

        if (s->split.is_global[i] || !s->split.active[(int64_t)i * b])
            continue;
        for (int64_t k = f->row[i]; k < f->row[i + 1]; k++)
            sum += s->split.is_global[f->col[k]] ? 0 : f->value[k * b * b];
        n++;
        viscous += fabs(sum * s->split.inverse_diagonal[(int64_t)i * b]) < s->options.viscous;
    }
    return 2 * viscous > n;
}

static int setup(void *self, const pf_csr *a, char *err, size_t nerr)
{
    block_solver *s = self;
    int status;

    split_fill(&s->split, a);
    ilu_factor(&s->ilu, s->n_thread);
    pressure_destroy(&s->pressure);
    levels_destroy(&s->levels);
    status = pressure_create(&s->pressure, &s->split, &s->options);
    s->has_levels = is_viscous(s);
    if (!status && s->has_levels)
        status = levels_create(&s->levels, &s->split, &s->options);
    return status ? fail(err, nerr, status,
                         status == PF_SOLVER_MEMORY ? "out of memory" : "a coarse level could not be factored")
                  : PF_SOLVER_OK;
}

static int update(void *self, const pf_csr *a, char *err, size_t nerr)
{
    block_solver *s = self;

    (void)err, (void)nerr;
    split_fill(&s->split, a);
    return PF_SOLVER_OK;
}

/* By the blocks in single precision. */
static void multiply(void *self, const double *x, double *y)
{
    block_solver *s = self;
    const split *q = &s->split;
    int64_t n = (int64_t)q->f.n * q->b;
    double largest = 0;

    for (int64_t i = 0; i < q->n; i++)
        largest = fmax(largest, fabs(x[i]));
    if (!(largest > 0) || !isfinite(largest)) {
        memcpy(y, x, (size_t)q->n * sizeof *x);
        return;
    }
    for (int32_t i = 0; i < q->n_p; i++)
        s->p[i] = x[q->row_of_p[i]];
    for (int64_t i = 0; i < n; i++)
        s->q[i] = q->row_of[i] >= 0 ? (float)(x[q->row_of[i]] / largest) : 0;
    block_multiply(&q->f, s->n_thread, s->q, s->u);
    split_gradient(q, s->p, 1 / largest, s->w);
    for (int64_t i = 0; i < n; i++)
        if (q->row_of[i] >= 0)
            y[q->row_of[i]] = ((double)s->u[i] + s->w[i]) * largest;
    split_divergence(q, s->q, s->rp);
    sparse_multiply(&q->c, s->n_thread, s->p, s->p2);
    for (int32_t i = 0; i < q->n_p; i++)
        y[q->row_of_p[i]] = s->rp[i] * largest + s->p2[i];
}

/* s->u = about F^-1 s->q */
static void solve_velocity(block_solver *s)
{
    int64_t n = (int64_t)s->split.f.n * s->split.b;

    if (!s->has_levels) {
        ilu_solve(&s->ilu, s->n_thread, s->q, s->u);
        return;
    }
    levels_correct(&s->levels, s->q, s->u);
    block_multiply(&s->split.f, s->n_thread, s->u, s->w);
    for (int64_t i = 0; i < n; i++)
        s->w[i] = s->q[i] - s->w[i];
    ilu_solve(&s->ilu, s->n_thread, s->w, s->w);
    for (int64_t i = 0; i < n; i++)
        s->u[i] += s->w[i];
}

static int solve(void *self, const double *b, double *x, char *err, size_t nerr)
{
    block_solver *s = self;
    const split *q = &s->split;
    int64_t n = (int64_t)q->f.n * q->b;
    double largest = 0;

    (void)err, (void)nerr;
    for (int64_t i = 0; i < q->n; i++)
        largest = fmax(largest, fabs(b[i]));
    if (!(largest > 0) || !isfinite(largest)) {
        memcpy(x, b, (size_t)q->n * sizeof *x);
        return PF_SOLVER_OK;
    }
    for (int32_t i = 0; i < q->n_p; i++)
        s->rp[i] = b[q->row_of_p[i]] / largest;
    pressure_solve(&s->pressure, s->rp, s->p);
    split_gradient(q, s->p, 1, s->w);
    for (int64_t i = 0; i < n; i++)
        s->q[i] = q->row_of[i] >= 0 ? (float)(b[q->row_of[i]] / largest) - s->w[i] : 0;
    solve_velocity(s);
    for (int64_t i = 0; i < n; i++)
        if (q->row_of[i] >= 0)
            x[q->row_of[i]] = s->u[i] * largest;
    for (int32_t i = 0; i < q->n_p; i++)
        x[q->row_of_p[i]] = s->p[i] * largest;
    return PF_SOLVER_OK;
}

static void destroy(void *self)
{
    block_solver *s = self;

    forget(s);
    free(s);
}

static const pf_param params[] = {
    PF_NUMBER(options, inner, "1", "part of the residual to which the Laplacian of the pressure is solved",
              .dflt = INNER, .min = 1e-12, .max = 0.9),
    {"inner_iterations", "1", "most iterations of it", PF_T_INT, 0, offsetof(options, inner_iterations),
     .dflt = INNER_MOST, .min = 1, .max = 1000},
    {"sweeps", "1", "of the smoothers on each level, before and after the coarser one", PF_T_INT, 0,
     offsetof(options, sweeps), .dflt = SWEEPS, .min = 1, .max = 20},
    PF_NUMBER(options, strength, "1", "couplings below this share of the diagonals are weak, and make no aggregate",
              .dflt = STRENGTH, .min = 0, .max = 1),
    PF_NUMBER(options, viscous, "1", "row sum over diagonal of the velocities below which they get coarser levels",
              .dflt = VISCOUS, .min = 0, .max = 10),
};

static const pf_solver solver = {
    .size = sizeof(pf_solver),
    .major = PF_SOLVER_MAJOR,
    .name = "solver_block",
    .version = "1.0",
    .doc = "iterative: block triangular, ILU(0) of the velocities, least-squares Schur complement of the pressure",
    .create = create,
    .analyze = analyze,
    .setup = setup,
    .solve = solve,
    .destroy = destroy,
    .flags = PF_SOLVER_APPROXIMATE | PF_SOLVER_SHARED_COLUMNS,
    .update = update,
    .multiply = multiply,
    .n_param = sizeof params / sizeof *params,
    .param_size = sizeof *params,
    .params_bytes = sizeof(options),
    .param = params,
    .configure = configure,
};

__attribute__((visibility("default"))) const pf_solver *pf_solver_entry(char *err, size_t nerr);

const pf_solver *pf_solver_entry(char *err, size_t nerr)
{
    (void)err, (void)nerr;
    return &solver;
}
