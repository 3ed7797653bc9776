/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Calls of a solver under test, and the judgement of an answer.  An exact solver is judged by what it returns, one
 * that approximates by the iteration round it. */
#include "solve/trial_call.h"

#include "solve/gmres.h"
#include "solve/instance.h"
#include "solve/linear.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What the kernel asks of fresh factors; what an iteration comes to, and how many steps a set-up of the same matrix
 * may take (iterative.c). */
#define EXACT    LINEAR_ACCEPT
#define ITERATED 1e-8
enum { MOST_ITERATIONS = 150 };

void trial_line(trials *c, int ok, const char *format, ...)
{
    char text[1000];
    va_list a;

    va_start(a, format);
    vsnprintf(text, sizeof text, format, a);
    va_end(a);
    c->s->line(c->s->ctx, ok, text);
    *(ok ? &c->s->passed : &c->s->failed) += 1;
}

static void enter(trials *c, const char *what)
{
    if (c->s->enter)
        c->s->enter(c->s->ctx, c->solver->name, NULL, what);
}

static int leave(trials *c, int status)
{
    enter(c, NULL);
    if (status && !*c->why)
        snprintf(c->why, sizeof c->why, "it does not say why");
    return status;
}

static const pf_csr *matrix(const trials *c, const trial *t)
{
    return LINEAR_HAS(c->solver, flags) && (c->solver->flags & PF_SOLVER_SHARED_COLUMNS) ? &t->shared : &t->a;
}

int trial_make(trials *c, void **self)
{
    *self = NULL;
    *c->why = 0;
    enter(c, "create");
    return leave(c, solver_instance(c->solver, c->params, 1, self, c->why, sizeof c->why));
}

int trial_analyze(trials *c, void *self, trial *t)
{
    pf_solver_cost cost = {0};
    pf_csr pattern = *matrix(c, t);
    int status;

    pattern.value = NULL;
    *c->why = 0;
    enter(c, "analyze");
    status = leave(c, c->solver->analyze(self, &pattern, &cost, c->why, sizeof c->why));
    if (!status && !(cost.bytes >= 0 && cost.flops >= 0 && cost.fill > 0))
        trial_line(c, 0, "analyze predicts a cost of %g bytes, %g operations, fill %g: the kernel chooses by them",
                   cost.bytes, cost.flops, cost.fill);
    return status;
}

int trial_setup(trials *c, void *self, trial *t)
{
    int status;

    *c->why = 0;
    trial_fill(t);
    enter(c, "setup");
    status = leave(c, c->solver->setup(self, matrix(c, t), c->why, sizeof c->why));
    trial_spoil(t);
    return status;
}

int trial_updates(const trials *c)
{
    return LINEAR_HAS(c->solver, update) != 0;
}

int trial_multiplies(const trials *c)
{
    return LINEAR_HAS(c->solver, multiply) != 0;
}

int trial_update(trials *c, void *self, trial *t)
{
    int status;

    *c->why = 0;
    trial_fill(t);
    enter(c, "update");
    status = leave(c, c->solver->update(self, matrix(c, t), c->why, sizeof c->why));
    trial_spoil(t);
    return status;
}

int trial_apply(trials *c, void *self, const double *b, double *x, int64_t n)
{
    *c->why = 0;
    for (int64_t i = 0; i < n; i++)
        x[i] = NAN;
    enter(c, "solve");
    return leave(c, c->solver->solve(self, b, x, c->why, sizeof c->why));
}

void trial_product(trials *c, void *self, const double *x, double *y)
{
    enter(c, "multiply");
    c->solver->multiply(self, x, y);
    enter(c, NULL);
}

void trial_drop(trials *c, void *self)
{
    enter(c, "destroy");
    if (self)
        c->solver->destroy(self);
    enter(c, NULL);
}

int trial_begin(trials *c, void **self, trial *t)
{
    int status = trial_make(c, self);

    if (!status)
        status = trial_analyze(c, *self, t);
    if (!status)
        status = trial_setup(c, *self, t);
    if (status) {
        trial_drop(c, *self);
        *self = NULL;
    }
    return status;
}

void trial_failed(trials *c, const char *subject, int status)
{
    trial_line(c, 0, "%s: %s (status %d)", subject, c->why, status);
}

/* The iteration as the kernel has it, without the scales of residuals. */
typedef struct iteration {
    trials *c;
    void *self;
    const trial *t;
} iteration;

static int precondition(void *i_, const double *b, double *x, error *err)
{
    iteration *i = i_;
    int status = trial_apply(i->c, i->self, b, x, i->t->a.n);

    return status ? error_set(err, ERR_CONVERGE, "%s", i->c->why) : 0;
}

/* Right-hand sides without what the equations of a free field cannot meet. */
static void project(void *i_, double *rows)
{
    const trial *t = ((const iteration *)i_)->t;
    double sum = 0, all = 0;

    for (int64_t i = 0; i < t->a.n; i++) {
        sum += t->weight[i] > 0 ? rows[i] : 0;
        all += t->weight[i];
    }
    for (int64_t i = 0; i < t->a.n; i++)
        rows[i] -= sum / all * t->weight[i];
}

/* Solutions with a last value of zero. */
static void level(void *i_, double *x)
{
    const trial *t = ((const iteration *)i_)->t;
    const double last = x[t->a.n - 1];

    for (int64_t i = 0; i < t->a.n; i++)
        x[i] -= t->weight[i] > 0 ? last : 0;
}

static int iterate(trials *c, void *self, const trial *t, double *x, double *left, int *n, error *err)
{
    iteration i = {c, self, t};
    pf_csr a = t->shared;
    gmres g = {.a = &a, .n_thread = 1, .apply = precondition, .ctx = &i};
    int status;

    a.value = t->kept;
    if (t->kind == TRIAL_ENCLOSED)
        g.project = project, g.level = level;
    status = gmres_solve(&g, t->b, x, ITERATED, MOST_ITERATIONS, left, n, err);
    gmres_destroy(&g);
    if (!status) /* by the full matrix */
        *left = trial_residual(t, t, 0, x);
    return status;
}

/* Once, as it is; what is wrong is told. */
static int apply_once(trials *c, void *self, const trial *t, const char *subject, double *b, double *x)
{
    const int64_t n = t->a.n;
    int status;

    memcpy(b, t->b, (size_t)n * sizeof *b);
    status = trial_apply(c, self, b, x, n);
    if (status)
        trial_failed(c, subject, status);
    else if (memcmp(b, t->b, (size_t)n * sizeof *b) != 0)
        trial_line(c, 0, "%s: solve writes into the right-hand side", subject);
    else
        return 1;
    return 0;
}

int trial_check(trials *c, void *self, const trial *t, const char *subject, const trial *before,
                const trial *beside, error *err)
{
    double *b = malloc((size_t)t->a.n * sizeof *b), *x = malloc((size_t)t->a.n * sizeof *x),
           *y = malloc((size_t)t->a.n * sizeof *y), left = 0;
    char guess[300];
    int n = 0, sound = 0, iterated = 0;

    if (b && x && y && apply_once(c, self, t, subject, b, x)) {
        if (c->approximate)
            iterated = iterate(c, self, t, y, &left, &n, err);
        else
            left = trial_residual(t, t, 0, x);
        sound = !iterated && left <= (c->approximate ? 1.01 * ITERATED : EXACT);
        if (!sound)
            trial_guess(t, before, beside, x, guess, sizeof guess);
        if (iterated)
            trial_line(c, 0, "%s: %s", subject, err->text);
        else if (!sound)
            trial_line(c, 0, "%s: residual %.2g%s%.0d%s of |b|, expected %.1g%s%s", subject, left,
                       c->approximate ? " after " : "", n, c->approximate ? " iterations" : "",
                       c->approximate ? ITERATED : EXACT, *guess ? "; " : "", guess);
        else if (c->approximate)
            trial_line(c, 1, "%s: %d iterations", subject, n);
        else
            trial_line(c, 1, "%s: residual %.1g", subject, left);
    }
    sound = b && x && y ? sound : -1;
    free(b), free(x), free(y);
    if (sound < 0)
        return error_memory(err, "test of a solver", 3. * (double)t->a.n * (double)sizeof *b);
    *err->text = 0;
    return 0;
}
