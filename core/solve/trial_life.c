/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What happens to instances of a solver: other values, another pattern, several at once, a matrix that is singular.
 */
#include "solve/trial_call.h"

#include "solve/vector.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A product in single precision. */
#define PRODUCT 1e-5

/* Three of one pattern, one of another size. */
typedef struct systems {
    trial first, other, near_, larger;
    double *y[3]; /* [n] of those of one pattern */
} systems;

static double distance(int64_t n, const double *a, const double *b)
{
    double sum = 0;

    for (int64_t i = 0; i < n; i++)
        sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sqrt(sum) / vector_norm(n, b);
}

/* The same right-hand side after a setup, after another one, and after that one alone. */
static int ignores_values(trials *c, void *self, systems *q, int *ignores)
{
    const int64_t n = q->other.a.n;
    void *fresh;
    int status = trial_apply(c, self, q->other.b, q->y[0], n);

    *ignores = 0;
    if (!status)
        status = trial_setup(c, self, &q->other);
    if (!status)
        status = trial_apply(c, self, q->other.b, q->y[1], n);
    if (!status)
        status = trial_begin(c, &fresh, &q->other);
    if (status)
        return status;
    status = trial_apply(c, fresh, q->other.b, q->y[2], n);
    *ignores = distance(n, q->y[1], q->y[0]) < 1e-12 && distance(n, q->y[2], q->y[0]) > 1e-6;
    trial_drop(c, fresh);
    return status;
}

static int new_values(trials *c, systems *q, error *err)
{
    const char *what = "set up again with other values";
    void *self;
    int ignores, ended = 0, status = trial_begin(c, &self, &q->first);

    if (!status)
        status = ignores_values(c, self, q, &ignores);
    if (status)
        trial_failed(c, what, status);
    else if (ignores)
        trial_line(c, 0,
                   "%s: it answers as before, and a new instance does not: it solves with the values of the setup "
                   "before; the new ones are ignored",
                   what);
    else
        ended = trial_check(c, self, &q->other, what, &q->first, NULL, err);
    trial_drop(c, self);
    return ended;
}

static void check_product(trials *c, void *self, const trial *t, const trial *old, const char *when, systems *q)
{
    const int64_t n = t->a.n;
    double off, off_old = 1;

    trial_multiply(t, 0, t->x, q->y[0]);
    trial_product(c, self, t->x, q->y[1]);
    off = distance(n, q->y[1], q->y[0]);
    if (old) {
        trial_multiply(old, 0, t->x, q->y[0]);
        off_old = distance(n, q->y[1], q->y[0]);
    }
    if (off <= PRODUCT)
        trial_line(c, 1, "multiply after %s: the product, to %.1g", when, off);
    else
        trial_line(c, 0, "multiply after %s: differs from A x by %.2g%s", when, off,
                   off_old <= PRODUCT ? "; it is the product with the matrix before" : "");
}

/* What was set up stays, for a matrix that is near; then it is set up again. */
static int update(trials *c, void *self, systems *q, error *err)
{
    int status = trial_update(c, self, &q->near_);

    if (status)
        return trial_failed(c, "update", status), 0;
    if (trial_multiplies(c))
        check_product(c, self, &q->near_, &q->first, "update", q);
    if (c->approximate)
        TRY(trial_check(c, self, &q->near_, "updated, with what was set up before", NULL, NULL, err));
    status = trial_setup(c, self, &q->first);
    if (status)
        return trial_failed(c, "set up after an update", status), 0;
    return trial_check(c, self, &q->first, "set up after an update", &q->near_, NULL, err);
}

/* What a solver may have or not. */
static int optional_functions(trials *c, systems *q, error *err)
{
    void *self;
    int ended = 0, status;

    if (!trial_updates(c) && !trial_multiplies(c))
        return 0;
    status = trial_begin(c, &self, &q->first);
    if (status)
        return trial_failed(c, "set up once more", status), 0;
    if (trial_multiplies(c))
        check_product(c, self, &q->first, NULL, "setup", q);
    if (trial_updates(c))
        ended = update(c, self, q, err);
    trial_drop(c, self);
    return ended;
}

/* Each with its matrix; what the first answers is not to change by the second. */
static int set_up_both(trials *c, void **self, trial *const *t, systems *q)
{
    const int64_t n = t[0]->a.n;
    int status = 0;

    for (int k = 0; k < 2 && !status; k++)
        status = trial_make(c, &self[k]);
    for (int k = 0; k < 2 && !status; k++)
        status = trial_analyze(c, self[k], t[k]);
    if (!status)
        status = trial_setup(c, self[0], t[0]);
    if (!status)
        status = trial_apply(c, self[0], t[0]->b, q->y[0], n);
    if (!status)
        status = trial_setup(c, self[1], t[1]);
    if (!status)
        status = trial_apply(c, self[0], t[0]->b, q->y[1], n);
    if (!status && distance(n, q->y[1], q->y[0]) > 1e-6)
        trial_line(
            c, 0,
            "two instances: the first answers otherwise once the second is set up: they share what should be "
            "their own");
    return status;
}

static int two_at_once(trials *c, systems *q, error *err)
{
    const char *const said[2] = {"two instances, first", "two instances, second"};
    trial *t[2] = {&q->first, &q->other};
    void *self[2] = {NULL, NULL};
    int ended = 0, status = set_up_both(c, self, t, q);

    if (status)
        trial_failed(c, "two instances", status);
    for (int k = 0; k < 2 && !status && !ended; k++)
        ended = trial_check(c, self[k], t[k], said[k], NULL, t[1 - k], err);
    trial_drop(c, self[1]);
    if (!status && !ended)
        ended = trial_check(c, self[0], t[0], "the first when the second is gone", NULL, t[1], err);
    trial_drop(c, self[0]);
    return ended;
}

/* Another size, and the first again, with one instance. */
static int other_pattern(trials *c, systems *q, error *err)
{
    trial *const t[2] = {&q->larger, &q->first};
    const char *const said[2] = {"analysed again for a larger pattern", "and for the smaller one again"};
    void *self;
    int status = trial_begin(c, &self, &q->first), ended = 0;

    for (int k = 0; k < 2 && !status && !ended; k++) {
        status = trial_analyze(c, self, t[k]);
        if (!status)
            status = trial_setup(c, self, t[k]);
        if (!status)
            ended = trial_check(c, self, t[k], said[k], NULL, NULL, err);
    }
    if (status)
        trial_failed(c, said[0], status);
    trial_drop(c, self);
    return ended;
}

/* Gone before anything is set up, twice; then a new one. */
static int made_again(trials *c, systems *q, error *err)
{
    const char *what = "destroyed, and made again";
    void *self;
    int status = 0, ended;

    for (int analyzed = 0; analyzed < 2 && !status; analyzed++) {
        status = trial_make(c, &self);
        if (!status && analyzed)
            status = trial_analyze(c, self, &q->first);
        trial_drop(c, self);
    }
    if (!status)
        status = trial_begin(c, &self, &q->first);
    if (status)
        return trial_failed(c, what, status), 0;
    ended = trial_check(c, self, &q->first, what, NULL, NULL, err);
    trial_drop(c, self);
    return ended;
}

/* A row and a column of zeros.  Only an exact solver must say so: an iteration finds it out by itself. */
static int singular(trials *c, systems *q)
{
    const char *what = "a matrix with a row and a column of zeros";
    trial *t = &q->other;
    const int64_t n = t->a.n, gone = n / 2;
    const char *in = "setup";
    void *self;
    int status = trial_make(c, &self);

    for (int64_t i = 0; i < n; i++)
        t->full[gone * n + i] = t->full[i * n + gone] = 0;
    if (!status)
        status = trial_analyze(c, self, t);
    if (status)
        return trial_failed(c, what, status), trial_drop(c, self), 0;
    status = trial_setup(c, self, t);
    if (!status) {
        in = "solve";
        status = trial_apply(c, self, q->first.b, q->y[0], n);
    }
    if (status == PF_SOLVER_SINGULAR || (status == PF_SOLVER_ERROR && strcmp(c->why, "it does not say why") != 0))
        trial_line(c, 1, "%s: %s says \"%s\"", what, in, c->why);
    else if (status)
        trial_line(c, 0, "%s: %s returns the status %d (%s), expected PF_SOLVER_SINGULAR", what, in, status,
                   c->why);
    else if (c->approximate)
        trial_line(c, 1, "%s: it goes on; the iteration finds it out", what);
    else
        trial_line(c, 0,
                   "%s: setup and solve say that all is well: it hides that the matrix is singular; setup should "
                   "return PF_SOLVER_SINGULAR",
                   what);
    trial_drop(c, self);
    return 0;
}

static int live(trials *c, systems *q, error *err)
{
    TRY(new_values(c, q, err));
    TRY(optional_functions(c, q, err));
    TRY(two_at_once(c, q, err));
    TRY(other_pattern(c, q, err));
    TRY(made_again(c, q, err));
    return singular(c, q);
}

int trial_life(trials *c, enum trial_kind kind, int side, error *err)
{
    systems q = {0};
    int status = trial_create(&q.first, kind, side, TRIAL_FIRST, err);

    if (!status)
        status = trial_create(&q.other, kind, side, TRIAL_FAR, err);
    if (!status)
        status = trial_create(&q.near_, kind, side, TRIAL_NEAR, err);
    if (!status)
        status = trial_create(&q.larger, kind, side + 3, TRIAL_FIRST, err);
    for (int k = 0; k < 3 && !status; k++) {
        q.y[k] = calloc((size_t)q.first.a.n, sizeof **q.y);
        status = q.y[k] ? 0 : error_memory(err, "test of a solver", (double)q.first.a.n * (double)sizeof **q.y);
    }
    if (!status)
        status = live(c, &q, err);
    for (int k = 0; k < 3; k++)
        free(q.y[k]);
    trial_destroy(&q.first);
    trial_destroy(&q.other);
    trial_destroy(&q.near_);
    trial_destroy(&q.larger);
    return status;
}
