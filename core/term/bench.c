/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Points at which a term is tested: random places and values, all different, the same in every run. */
#include "term/bench.h"

#include "base/process.h"
#include "base/random.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

void bench_line(bench *k, int ok, const char *fmt, ...)
{
    char text[900];
    va_list ap;

    va_start(ap, fmt);
    vsnprintf(text, sizeof text, fmt, ap);
    va_end(ap);
    *(ok ? &k->s->passed : &k->s->failed) += 1;
    k->s->line(k->s->ctx, ok, text);
}

int bench_components(const bench *k, const pf_slot *s)
{
    return term_components(s->shape, k->dim);
}

static double random_number(bench *k)
{
    return 2 * random_next(&k->random) - 1;
}

/* Anywhere; of a property where it makes sense. */
static double random_value(bench *k, const pf_slot *s)
{
    double v = random_number(k), low = fmax(s->min, -2), high = fmin(s->max, 2);

    if (s->eval != PF_PROPERTY || s->min >= s->max)
        return v + (s->shape == PF_SCALAR ? 1.5 : 0);
    if (low >= high)
        low = s->min, high = s->max;
    return low + (high - low) * (0.5 + 0.45 * v);
}

void bench_random_inputs(bench *k)
{
    for (uint32_t i = 0; i < k->t->n_in; i++)
        for (int c = 0; c < bench_components(k, &k->t->in[i]) * BENCH_LD; c++)
            k->in[i][c] = random_value(k, &k->t->in[i]);
}

void bench_random_state(bench *k)
{
    for (uint32_t i = 0; i < k->t->n_in; i++)
        for (int c = 0; k->t->in[i].eval != PF_PROPERTY && c < bench_components(k, &k->t->in[i]) * BENCH_LD; c++)
            k->in[i][c] = random_value(k, &k->t->in[i]);
}

void bench_put_param(bench *k, const pf_param *p, const double *v)
{
    char *at = (char *)k->params + p->offset;
    int whole = (int)*v;

    if (p->type == PF_T_REAL || p->type == PF_T_VECTOR)
        memcpy(at, v, (size_t)(p->type == PF_T_REAL ? 1 : k->dim) * sizeof *v);
    else
        memcpy(at, &whole, sizeof whole);
}

/* Parameters: defaults; required ones get a number inside their range, all different. */
static void place_params(bench *k)
{
    term_defaults(k->t, k->params);
    for (uint32_t i = 0; i < k->t->n_param; i++) {
        const pf_param *p = &k->t->param[i];
        double v = 1.25 + 0.5 * i, vec[3] = {0.3, -0.7, 0.9};

        if (p->min < p->max)
            v = v < p->min ? p->min : v > p->max ? 0.5 * (fmax(p->min, -1e6) + p->max) : v;
        if (p->type == PF_T_INT && p->min < p->max)
            v = v < p->max ? ceil(v) : p->max;
        if (p->type == PF_T_VECTOR)
            bench_put_param(k, p, vec);
        else if ((p->type == PF_T_REAL && p->dflt == 0) || (p->type <= PF_T_INT && (p->flags & PF_REQUIRED)))
            bench_put_param(k, p, &v);
    }
}

/* Inputs, outputs, and two Jacobians, one to be compared with the other. */
static int create_values(bench *k, error *err)
{
    const pf_term *t = k->t;

    for (uint32_t i = 0; i < t->n_in; i++)
        ARENA_NEW(&k->memory, k->in[i], bench_components(k, &t->in[i]) * BENCH_LD, err);
    for (uint32_t o = 0; o < t->n_out; o++) {
        ARENA_NEW(&k->memory, k->out[o], bench_components(k, &t->out[o]) * BENCH_LD, err);
        ARENA_NEW(&k->memory, k->again[o], bench_components(k, &t->out[o]) * BENCH_LD, err);
        for (uint32_t i = 0; i < t->n_in; i++) {
            size_t n = (size_t)(bench_components(k, &t->out[o]) * bench_components(k, &t->in[i]) * BENCH_LD);

            ARENA_NEW(&k->memory, k->jac[o * t->n_in + i], n, err);
            ARENA_NEW(&k->memory, k->truth[o * t->n_in + i], n, err);
        }
    }
    return 0;
}

/* A symmetric positive definite matrix at each point, as of elements of different sizes and stretching: A^T A + 1.
 */
static int create_metric(bench *k, error *err)
{
    const int d = k->dim;

    ARENA_NEW(&k->memory, k->metric, d * d * BENCH_LD, err);
    for (int l = 0; l < BENCH_LD; l++) {
        double a[3][3];

        for (int i = 0; i < d * d; i++)
            a[i / d][i % d] = 3 * random_number(k);
        for (int i = 0; i < d * d; i++) {
            double *g = &k->metric[i * BENCH_LD + l];

            *g = i / d == i % d;
            for (int r = 0; r < d; r++)
                *g += a[r][i / d] * a[r][i % d];
        }
    }
    return 0;
}

static int create_points(bench *k, error *err)
{
    ARENA_NEW(&k->memory, k->x, 3 * BENCH_LD, err);
    ARENA_NEW(&k->memory, k->normal, 3 * BENCH_LD, err);
    ARENA_NEW(&k->memory, k->h, BENCH_LD, err);
    ARENA_NEW(&k->memory, k->arm, 3 * BENCH_LD, err);
    ARENA_NEW(&k->memory, k->density, BENCH_LD, err);
    ARENA_NEW(&k->memory, k->id, BENCH_LD, err);
    for (int i = 0; i < 3 * BENCH_LD; i++) {
        k->x[i] = random_number(k);
        k->normal[i] = i / BENCH_LD == 0 ? 0.6 : i / BENCH_LD == 1 ? (k->dim == 2 ? -0.8 : 0.48) : 0.64;
    }
    for (int i = 0; i < BENCH_LD; i++)
        k->h[i] = 0.1 + 0.01 * i, k->density[i] = 2 + 0.1 * i;
    for (int i = 0; i < 3 * BENCH_LD; i++)
        k->arm[i] = random_number(k);
    return 0;
}

/* The batch, with what points of this kind have. */
static pf_batch batch_of(bench *k)
{
    const uint32_t where = k->t->where;
    const int on_pair = where == PF_PAIR, on_body = where == PF_SOLID || where == PF_SURFACE;

    return (pf_batch){
        .size = sizeof(pf_batch),
        .dim = (uint32_t)k->dim,
        .n = BENCH_LD,
        .ld = BENCH_LD,
        .t = 0.7,
        .dt = 0.1,
        .shift = 15,
        .x = k->x,
        .normal = where == PF_FACET || where == PF_SURFACE || on_pair ? k->normal : NULL,
        .h = k->h,
        .arm = on_body ? k->arm : NULL,
        .density = on_body || on_pair ? k->density : NULL,
        .id = on_body || on_pair ? k->id : NULL,
        .gap = on_pair ? k->h : NULL,
        .size_of = on_pair ? k->density : NULL,
        .other_size = on_pair ? k->density : NULL,
        .other_density = on_pair ? k->density : NULL,
        .metric = k->metric,
        .params = k->params,
        .scratch = k->scratch,
        .kernel = &k->report,
        .host = &term_host,
    };
}

int bench_create(bench *k, selftest *s, const term_plugin *p, const pf_term *t, int dim, error *err)
{
    *k = (bench){.s = s,
                 .p = p,
                 .t = t,
                 .dim = dim,
                 .report = {.plugin = p->d.name, .term = t->name},
                 .random = RANDOM_SEED};
    k->params = arena_alloc(&k->memory, t->params_bytes + 1, 1);
    k->room = arena_alloc(&k->memory, term_jacobian_room(t, dim, BENCH_LD) + 64, 1);
    k->scratch = arena_alloc(&k->memory, t->scratch_bytes + 1, 1);
    if (!k->params || !k->room || !k->scratch)
        return error_memory(err, "test of a term", 0);
    TRY(create_values(k, err));
    TRY(create_points(k, err));
    if (t->flags & PF_METRIC)
        TRY(create_metric(k, err));
    place_params(k);
    bench_random_inputs(k);
    k->b = batch_of(k);
    return 0;
}

int bench_call(bench *k, double *const *out, const char *what)
{
    int status;

    k->report.status = 0;
    process_enter(k->p->d.name, k->t->name, what, -1);
    status = k->t->residual(&k->b, (const double *const *)k->in, out);
    process_leave();
    if (status)
        bench_line(k, 0, "%s  %s returned %d: %s", k->t->name, what, status,
                   k->report.status ? k->report.text : "without saying why (host->fail gives the reason)");
    return status == 0;
}
