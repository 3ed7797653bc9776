/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Tests that follow from a term's own description: worked examples; every output assigned, and
 * finite; the same answer twice and in any batch; the Jacobian block by block against complex
 * step (or differences), with a guess at what is wrong; declared dependencies; linearity. */
#include "term/selftest.h"

#include "term/block.h"

#include <complex.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { LD = 24 };

typedef struct bench {
    selftest *s;
    const term_plugin *p;
    const pf_term *t;
    int dim;
    void *params;
    double *in[TERM_MAX_SLOTS], *out[TERM_MAX_SLOTS], *again[TERM_MAX_SLOTS];
    double *jac[TERM_MAX_SLOTS * TERM_MAX_SLOTS], *truth[TERM_MAX_SLOTS * TERM_MAX_SLOTS];
    double *x, *normal, *h, *arm, *density;
    int32_t *id;
    void *room;
    term_report report;
    pf_batch b;
    unsigned long long seed;
    arena memory;
} bench;

__attribute__((format(printf, 3, 4))) static void line(bench *k, int ok, const char *fmt, ...)
{
    char text[900];
    va_list ap;

    va_start(ap, fmt);
    vsnprintf(text, sizeof text, fmt, ap);
    va_end(ap);
    *(ok ? &k->s->passed : &k->s->failed) += 1;
    k->s->line(k->s->ctx, ok, text);
}

static double random_number(bench *k)
{
    k->seed ^= k->seed >> 12;
    k->seed ^= k->seed << 25;
    k->seed ^= k->seed >> 27;
    return (double)((k->seed * 2685821657736338717ULL) >> 11) * 0x1p-52 - 1;
}

static int comps(const bench *k, const pf_slot *s)
{
    return term_components(s->shape, k->dim);
}

static void random_inputs(bench *k)
{
    for (uint32_t i = 0; i < k->t->n_in; i++)
        for (int c = 0; c < comps(k, &k->t->in[i]) * LD; c++)
            k->in[i][c] = random_number(k) + (k->t->in[i].shape == PF_SCALAR ? 1.5 : 0);
}

/* Writes a parameter: one number, dim numbers of a vector. */
static void put_param(bench *k, const pf_param *p, const double *v)
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
            put_param(k, p, vec);
        else if ((p->type == PF_T_REAL && p->dflt == 0) || (p->type <= PF_T_INT && (p->flags & PF_REQUIRED)))
            put_param(k, p, &v);
    }
}

static int bench_create(bench *k, selftest *s, const term_plugin *p, const pf_term *t, int dim, error *err)
{
    int on_body = t->where == PF_SOLID || t->where == PF_SURFACE || t->where == PF_PAIR;

    memset(k, 0, sizeof *k);
    k->s = s;
    k->p = p;
    k->t = t;
    k->dim = dim;
    k->seed = 88172645463325252ULL;
    ARENA_NEW(&k->memory, k->x, 3 * LD, err);
    ARENA_NEW(&k->memory, k->normal, 3 * LD, err);
    ARENA_NEW(&k->memory, k->h, LD, err);
    ARENA_NEW(&k->memory, k->arm, 3 * LD, err);
    ARENA_NEW(&k->memory, k->density, LD, err);
    ARENA_NEW(&k->memory, k->id, LD, err);
    k->params = arena_alloc(&k->memory, t->params_bytes + 1, 1);
    k->room = arena_alloc(&k->memory, term_jacobian_room(t, dim, LD) + 64, 1);
    k->b.scratch = arena_alloc(&k->memory, t->scratch_bytes + 1, 1);
    if (!k->params || !k->room || !k->b.scratch)
        return error_memory(err, "test of a term", 0);
    for (uint32_t i = 0; i < t->n_in; i++)
        ARENA_NEW(&k->memory, k->in[i], comps(k, &t->in[i]) * LD, err);
    for (uint32_t o = 0; o < t->n_out; o++) {
        ARENA_NEW(&k->memory, k->out[o], comps(k, &t->out[o]) * LD, err);
        ARENA_NEW(&k->memory, k->again[o], comps(k, &t->out[o]) * LD, err);
        for (uint32_t i = 0; i < t->n_in; i++) {
            size_t n = (size_t)(comps(k, &t->out[o]) * comps(k, &t->in[i]) * LD);

            ARENA_NEW(&k->memory, k->jac[o * t->n_in + i], n, err);
            ARENA_NEW(&k->memory, k->truth[o * t->n_in + i], n, err);
        }
    }
    for (int i = 0; i < 3 * LD; i++) {
        k->x[i] = random_number(k);
        k->normal[i] = i / LD == 0 ? 0.6 : i / LD == 1 ? (dim == 2 ? -0.8 : 0.48) : 0.64;
    }
    for (int i = 0; i < LD; i++)
        k->h[i] = 0.1 + 0.01 * i, k->density[i] = 2 + 0.1 * i;
    for (int i = 0; i < 3 * LD; i++)
        k->arm[i] = random_number(k);
    place_params(k);
    random_inputs(k);
    k->report = (term_report){.plugin = p->d.name, .term = t->name};
    k->b = (pf_batch){.size = sizeof k->b,
                      .dim = (uint32_t)dim,
                      .n = LD,
                      .ld = LD,
                      .t = 0.7,
                      .dt = 0.1,
                      .shift = 15,
                      .x = k->x,
                      .normal =
                          t->where == PF_FACET || t->where == PF_SURFACE || t->where == PF_PAIR ? k->normal : NULL,
                      .h = k->h,
                      .arm = t->where == PF_SOLID || t->where == PF_SURFACE ? k->arm : NULL,
                      .density = on_body ? k->density : NULL,
                      .gap = t->where == PF_PAIR ? k->h : NULL,
                      .size_of = t->where == PF_PAIR ? k->density : NULL,
                      .other_size = t->where == PF_PAIR ? k->density : NULL,
                      .other_density = t->where == PF_PAIR ? k->density : NULL,
                      .id = on_body ? k->id : NULL,
                      .params = k->params,
                      .scratch = k->b.scratch,
                      .kernel = &k->report};
    return 0;
}

/* Calls the residual; 1 if it went well, else the line is out. */
static int call(bench *k, double *const *out, const char *what)
{
    int status;

    k->report.status = 0;
    term_now = (term_breadcrumb){k->p->d.name, k->t->name, what, -1};
    status = k->t->residual(&k->b, (const double *const *)k->in, out);
    term_now = (term_breadcrumb){0};
    if (status)
        line(k, 0, "%s  %s returned %d: %s", k->t->name, what, status,
             k->report.status ? k->report.text : "without saying why (host->fail gives the reason)");
    return status == 0;
}

static void test_example(bench *k, const pf_example *e)
{
    const double *in = e->in, *out = e->out, *params = e->params;
    double worst = 0, size = 0, got = 0, expected = 0;
    char where[100] = "";

    for (uint32_t i = 0; params && i < k->t->n_param; i++) {
        put_param(k, &k->t->param[i], params);
        params += k->t->param[i].type == PF_T_VECTOR ? k->dim : 1;
    }
    for (uint32_t i = 0; i < k->t->n_in; i++)
        for (int c = 0; c < comps(k, &k->t->in[i]); c++, in++)
            for (int l = 0; l < LD; l++)
                k->in[i][c * LD + l] = *in;
    if (!call(k, k->out, "residual of the worked example"))
        return;
    for (uint32_t o = 0; o < k->t->n_out; o++)
        for (int c = 0; c < comps(k, &k->t->out[o]); c++, out++) {
            size = fmax(size, fabs(*out));
            if (!(fabs(k->out[o][c * LD] - *out) <= worst)) {
                worst = isnan(k->out[o][c * LD]) ? INFINITY : fabs(k->out[o][c * LD] - *out);
                got = k->out[o][c * LD];
                expected = *out;
                snprintf(where, sizeof where, "%s[%d]", k->t->out[o].name, c);
            }
        }
    if (worst <= e->tol * size)
        line(k, 1, "%s  example \"%s\"", k->t->name, e->name);
    else
        line(k, 0, "%s  example \"%s\": %s is %.15g, expected %.15g", k->t->name, e->name, where, got, expected);
}

/* The residual on outputs that hold `before`; 1 if it went well. */
static int outputs_over(bench *k, double **to, double before)
{
    for (uint32_t o = 0; o < k->t->n_out; o++)
        for (int i = 0; i < comps(k, &k->t->out[o]) * LD; i++)
            to[o][i] = before;
    return call(k, to, "residual on random values");
}

static void test_outputs(bench *k)
{
    if (!outputs_over(k, k->out, 7.7e77) || !outputs_over(k, k->again, -7.7e77))
        return;
    for (uint32_t o = 0; o < k->t->n_out; o++)
        for (int i = 0; i < comps(k, &k->t->out[o]) * LD; i++) {
            double a = k->out[o][i], b = k->again[o][i];
            int kept = a == 7.7e77 && b == -7.7e77, added = fabs(a - b) > 1e70;
            const char *why;

            if (kept && outputs_over(k, k->again, 0))
                added = k->again[o][i] != 0; /* numbers that are small beside 7.7e77 */
            why = !isfinite(a)                    ? "is not a finite number on random values"
                  : added                         ? "is added to; the residual must assign, not add"
                  : kept                          ? "is not written; the residual must assign every output"
                  : memcmp(&a, &b, sizeof a) != 0 ? "differs between two calls with the same values"
                                                  : NULL;
            if (why) {
                line(k, 0, "%s  output \"%s\"[%d] in %dD %s", k->t->name, k->t->out[o].name, i / LD, k->dim, why);
                return;
            }
        }
    line(k, 1, "%s  outputs in %dD assigned, finite, repeatable", k->t->name, k->dim);
}

/* The first n points, in reverse order at the end of the batch before, have the values they had there. */
static int same_values(bench *k, int n)
{
    if (!call(k, k->again, "residual on random values"))
        return 0;
    for (uint32_t o = 0; o < k->t->n_out; o++)
        for (int c = 0; c < comps(k, &k->t->out[o]); c++)
            for (int l = 0; l < n; l++)
                if (k->again[o][c * LD + l] != k->out[o][c * LD + LD - 1 - l]) {
                    line(k, 0, "%s  output \"%s\": a point's value depends on the other points of its batch",
                         k->t->name, k->t->out[o].name);
                    return 0;
                }
    return 1;
}

static void reverse(double *row)
{
    for (int l = 0; l < LD / 2; l++) {
        double swap = row[l];

        row[l] = row[LD - 1 - l], row[LD - 1 - l] = swap;
    }
}

/* The same points in another order give the same values in that order; and a point keeps its
 * values whatever the others are. */
static void test_batches(bench *k)
{
    for (uint32_t i = 0; i < k->t->n_in; i++)
        for (int c = 0; c < comps(k, &k->t->in[i]); c++)
            reverse(k->in[i] + c * LD);
    for (int c = 0; c < 3; c++) {
        reverse(k->x + c * LD);
        reverse(k->arm + c * LD);
    }
    reverse(k->h);
    reverse(k->density);
    if (!same_values(k, LD))
        return;
    for (uint32_t i = 0; i < k->t->n_in; i++)
        for (int j = 0; j < comps(k, &k->t->in[i]) * LD; j++)
            k->in[i][j] *= j % LD ? 1.5 : 1;
    if (same_values(k, 1))
        line(k, 1, "%s  batches in %dD: each point on its own", k->t->name, k->dim);
}

static void compare_block(bench *k, uint32_t o, uint32_t i, const char *how, double tolerance)
{
    const pf_slot *out = &k->t->out[o], *in = &k->t->in[i];
    int rows = comps(k, out), cols = comps(k, in);
    const double *given = k->jac[o * k->t->n_in + i], *truth = k->truth[o * k->t->n_in + i];
    size_t n = (size_t)(rows * cols * LD);
    double size = block_norm(truth, n), e = block_distance(given, truth, 1, n);
    char why[200];

    if (e <= tolerance * size || (size == 0 && e == 0)) {
        line(k, 1, "%s  d %s / d %s in %dD: analytic = %s to %.1e", k->t->name, out->name, in->name, k->dim, how,
             size > 0 ? e / size : 0);
        return;
    }
    selftest_diagnose(given, truth, rows, cols, LD, why, sizeof why);
    for (int kept = 0; kept < 2 && in->shape == PF_TENSOR && strncmp(why, "wrong", 5) == 0; kept++)
        if (block_exchanged_distance(given, truth, rows, k->dim, LD, kept) < 1e-6 * size)
            snprintf(why, sizeof why, "transpose: the %stwo indices of %s %s", kept ? "part with the " : "",
                     in->name, kept ? "exchanged is missing" : "are exchanged");
    line(k, 0, "%s  d %s / d %s in %dD: %s", k->t->name, out->name, in->name, k->dim, why);
}

static int derive(bench *k, enum term_derivative how, double **jac, const char *what)
{
    const pf_term *t = k->t;
    double *given[TERM_MAX_SLOTS * TERM_MAX_SLOTS];
    int status;

    for (uint32_t o = 0; o < t->n_out; o++)
        for (uint32_t i = 0; i < t->n_in; i++) {
            memset(jac[o * t->n_in + i], 0,
                   (size_t)(comps(k, &t->out[o]) * comps(k, &t->in[i]) * LD) * sizeof(double));
            given[o * t->n_in + i] = term_is_unknown(&t->in[i]) ? jac[o * t->n_in + i] : NULL;
        }
    k->report.status = 0;
    term_now = (term_breadcrumb){k->p->d.name, t->name, what, -1};
    status = term_jacobian(t, how, &k->b, (const double *const *)k->in, given, k->room);
    term_now = (term_breadcrumb){0};
    if (status)
        line(k, 0, "%s  %s returned %d: %s", t->name, what, status,
             k->report.status ? k->report.text : "without saying why");
    return status == 0;
}

/* The complex twin must be the same function. */
static void test_twin(bench *k)
{
    double worst = 0, size = 0;
    int status;
    pf_complex *z = k->room, *w[TERM_MAX_SLOTS];
    const pf_complex *in[TERM_MAX_SLOTS];

    for (uint32_t i = 0; i < k->t->n_in; i++) {
        in[i] = z;
        for (int c = 0; c < comps(k, &k->t->in[i]) * LD; c++)
            *z++ = k->in[i][c];
    }
    for (uint32_t o = 0; o < k->t->n_out; o++) {
        w[o] = z;
        z += comps(k, &k->t->out[o]) * LD;
    }
    if (!call(k, k->out, "residual on random values"))
        return;
    term_now = (term_breadcrumb){k->p->d.name, k->t->name, "complex twin", -1};
    status = k->t->residual_c(&k->b, in, w);
    term_now = (term_breadcrumb){0};
    if (status) {
        line(k, 0, "%s  residual_c returned %d where residual returned 0; they must be one source", k->t->name,
             status);
        return;
    }
    for (uint32_t o = 0; o < k->t->n_out; o++)
        for (int c = 0; c < comps(k, &k->t->out[o]) * LD; c++) {
            double e = fabs(creal(w[o][c]) - k->out[o][c]);

            worst = isnan(e) ? INFINITY : fmax(worst, e);
            size = fmax(size, fabs(k->out[o][c]));
        }
    if (worst <= 1e-13 * size)
        line(k, 1, "%s  complex twin in %dD = residual", k->t->name, k->dim);
    else
        line(k, 0, "%s  residual_c differs from residual by %.2g (of %.2g); they must be one source", k->t->name,
             worst, size);
}

/* 1 if the complex step (in truth) and differences agree: the twin is an analytic function. */
static int twin_derives(bench *k)
{
    const pf_term *t = k->t;

    if (!derive(k, TERM_FD, k->jac, "differences"))
        return 0;
    for (uint32_t o = 0; o < t->n_out; o++)
        for (uint32_t i = 0; i < t->n_in; i++) {
            size_t n = (size_t)(comps(k, &t->out[o]) * comps(k, &t->in[i]) * LD);
            const double *a = k->truth[o * t->n_in + i], *b = k->jac[o * t->n_in + i];

            if (term_is_unknown(&t->in[i]) && !(block_distance(a, b, 1, n) <= 1e-3 * block_norm(b, n) + 1e-6)) {
                line(k, 0,
                     "%s  d %s / d %s in %dD: residual_c does not carry the derivative (norm %.6g, by differences "
                     "%.6g); has it fabs, a real part or a real variable in it?",
                     t->name, t->out[o].name, t->in[i].name, k->dim, block_norm(a, n), block_norm(b, n));
                return 0;
            }
        }
    return 1;
}

static void test_jacobian(bench *k)
{
    const pf_term *t = k->t;
    const char *how = t->residual_c ? "complex step" : "differences";
    int unknowns = 0;

    for (uint32_t i = 0; i < t->n_in; i++)
        unknowns += term_is_unknown(&t->in[i]);
    if (!unknowns || !derive(k, t->residual_c ? TERM_COMPLEX : TERM_FD, k->truth, how))
        return;
    if (t->residual_c && !twin_derives(k))
        return;
    for (uint32_t o = 0; o < t->n_out && t->depends; o++)
        for (uint32_t i = 0; i < t->n_in; i++)
            if (!t->depends[o * t->n_in + i] &&
                block_norm(k->truth[o * t->n_in + i], (size_t)(comps(k, &t->out[o]) * comps(k, &t->in[i]) * LD)) >
                    0)
                line(k, 0,
                     "%s  \"%s\" depends on \"%s\", but depends[%u][%u] says it does not: undeclared dependency",
                     t->name, t->out[o].name, t->in[i].name, o, i);
    if (t->jacobian && !derive(k, TERM_ANALYTIC, k->jac, "Jacobian"))
        return;
    for (uint32_t o = 0; o < t->n_out; o++)
        for (uint32_t i = 0; i < t->n_in; i++)
            if (term_is_unknown(&t->in[i]) && t->jacobian)
                compare_block(k, o, i, how, t->residual_c ? SELFTEST_EXACT : SELFTEST_DIFFERENCES);
            else if (term_is_unknown(&t->in[i]))
                line(k, 1, "%s  d %s / d %s in %dD: by %s", t->name, t->out[o].name, t->in[i].name, k->dim, how);
}

static void test_linearity(bench *k)
{
    const pf_term *t = k->t;
    enum term_derivative how = t->residual_c ? TERM_COMPLEX : TERM_FD;

    if (!(t->flags & PF_LINEAR))
        return;
    if (!derive(k, how, k->truth, "derivative"))
        return;
    random_inputs(k);
    if (!derive(k, how, k->jac, "derivative"))
        return;
    for (uint32_t j = 0; j < t->n_out * t->n_in; j++) {
        size_t n = (size_t)(comps(k, &t->out[j / t->n_in]) * comps(k, &t->in[j % t->n_in]) * LD);

        if (term_is_unknown(&t->in[j % t->n_in]) &&
            block_distance(k->jac[j], k->truth[j], 1, n) >
                (t->residual_c ? 1e-12 : 1e-5) * (block_norm(k->truth[j], n) + 1e-300)) {
            line(k, 0, "%s  is flagged PF_LINEAR, but d %s / d %s changes with the state", t->name,
                 t->out[j / t->n_in].name, t->in[j % t->n_in].name);
            return;
        }
    }
    line(k, 1, "%s  linear in %dD, as flagged", t->name, k->dim);
}

static int test_term(selftest *s, const term_plugin *p, const pf_term *t, error *err)
{
    for (int dim = 2; dim <= 3; dim++) {
        bench k;
        int before = s->failed, status = bench_create(&k, s, p, t, dim, err);

        if (!status) {
            test_outputs(&k);
            if (s->failed == before) {
                test_batches(&k);
                if (t->residual_c)
                    test_twin(&k);
                test_jacobian(&k);
                test_linearity(&k);
            }
            for (uint32_t e = 0; e < t->n_example; e++)
                if ((int)t->example[e].dim == dim)
                    test_example(&k, &t->example[e]);
        }
        arena_free(&k.memory);
        TRY(status);
    }
    return 0;
}

int selftest_run(selftest *s, const term_plugin *p, const char *only, error *err)
{
    int found = 0;

    for (uint32_t i = 0; i < p->d.n_term; i++)
        if (!only || strcmp(p->term[i].name, only) == 0) {
            found = 1;
            TRY(test_term(s, p, &p->term[i], err));
        }
    return found ? 0 : error_set(err, ERR_USAGE, "plugin \"%s\" has no term \"%s\"", p->d.name, only);
}
