/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Newton's method with backtracking.
 *
 * A field has converged when |r_f| <= tolerance * scale_f (scale.c), and its last step was small, too.
 *
 * An iteration takes one residual and one matrix: the residual that the line search accepted is that of the next
 * iteration.  While the residuals, falling quadratically, promise that there will be one, a full step is tried with
 * residual and matrix at once; the last matrix, which nobody needs, is not formed.  If all terms are linear,
 * the first matrix serves to the end.
 *
 * Linear systems are solved with the factors of an earlier matrix where that pays, and as far as it serves
 * (forcing.c). */
#include "solve/solve.h"
#include "solve/vector.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* A scaled residual that nothing makes smaller. */
#define ROUND_OFF 1e-14
/* Newton goes on until its last step was smaller than this, relative to the field: what is left is its square. */
#define LAST_STEP 1e-4
/* A step of a linear problem leaves less of the residual than this, or the terms are not what their flags say. */
#define LINEAR_FALL 1e-3
/* A step that may be shorter is given up where three iterations, after some, do not make this of the residual. */
#define SLOW 0.5
enum { LEAST_TRIES = 5 };
/* Norms of plain and of scaled residuals differ: more than this is left by the latter, and it is solved again. */
#define LEFT_SCALED 10
/* Where Newton's method stops early, a correction with the factors there are is tried from this many times what is
 * enough: it costs no matrix. */
#define NEAR 50

/* What s->linear.value holds: the matrix at x; at an iterate before; nothing that is of use. */
enum matrix { MATRIX_HERE, MATRIX_OLD, MATRIX_LOST };

typedef struct iterate {
    newton_system *s;
    const newton_time *time;
    const newton_options *o;
    newton_report *report;
    double *x;
    double scale[SPACE_MAX_FIELDS];
    enum matrix matrix;
    int solved;                            /* the last linear system had this matrix                        */
    int retry;                             /* the last trial was refused by a term, see err                 */
    int linear;                            /* all terms are                                                 */
    double enough, near;                   /* residual to go on to; from which one correction is tried      */
    double length[NEWTON_MAX_ITERATIONS];  /* of the step from iterate k                                    */
    double left;                           /* that the last linear solution may have                        */
    double inexact[NEWTON_MAX_ITERATIONS]; /* residual that its linear solution left, relative to that of k */
} iterate;

static void give_up(newton_report *r, const char *fmt, ...) __attribute__((format(printf, 2, 3)));
static void give_up(newton_report *r, const char *fmt, ...)
{
    va_list ap;

    va_start(ap, fmt);
    vsnprintf(r->why, sizeof r->why, fmt, ap);
    va_end(ap);
}

/* Residual and matrix at x.  *changed: other fields than before are free up to a constant. */
static int form_matrix(iterate *it, int *changed, error *err)
{
    newton_system *s = it->s;

    it->solved = 0;
    it->matrix = MATRIX_LOST;
    TRY(system_evaluate(s, it->time, it->x, 1, 0, err));
    it->matrix = MATRIX_HERE;
    TRY(gauge_detect(s, changed, err));
    gauge_project(s, s->residual);
    return 0;
}

/* One more correction with the factors there are: it costs a solve and a residual, and takes the
 * error down to round-off.  Kept only if the residual falls.  *change: no more than its relative size. */
static int polish(iterate *it, double *change, error *err)
{
    newton_system *s = it->s;
    size_t bytes = (size_t)s->space->n_dof * sizeof *it->x;
    double norm[SPACE_MAX_FIELDS], before = it->report->history[it->report->iterations], own;
    const gauge gauge_before = s->gauge;
    int status;

    vector_negative(s->space, s->residual, s->rhs);
    TRY(gauge_tell(s, err));
    TRY(linear_apply(&s->linear, s->rhs, s->step, err));
    memcpy(s->trial, it->x, bytes);
    memcpy(s->scale, s->residual, bytes);
    vector_step(s->space, 1, s->step, it->x);
    status = system_evaluate(s, it->time, it->x, 0, 0, err);
    if (status && !err->retry)
        return status;
    gauge_project(s, s->residual);
    own = scale_change(s, it->x, 1);
    if (own < *change)
        *change = own;
    if (!status && scale_norms(s, it->scale, norm) < before) {
        memcpy(it->report->norm, norm, sizeof norm);
        it->matrix = it->matrix == MATRIX_HERE ? MATRIX_OLD : it->matrix;
        return 0;
    }
    memcpy(it->x, s->trial, bytes);
    memcpy(s->residual, s->scale, bytes);
    s->gauge = gauge_before;
    return 0;
}

static double largest(int n, const double *v)
{
    double most = 0;

    for (int i = 0; i < n; i++)
        most = vector_worse(v[i], most);
    return most;
}

/* The residual is small enough at iterate k: converged if the last step was small, too, and if the constants that
 * were taken out of the residual are still free with a matrix of near here. */
static int settle(iterate *it, int k, error *err)
{
    newton_system *s = it->s;
    newton_report *r = it->report;
    double change = r->history[k] > 0 && k > 0 ? scale_change(s, it->x, it->length[k - 1]) : 0;
    int changed = 0;

    if (gauge_excess(s, it->scale) > it->enough && !(change <= LAST_STEP) && !it->linear &&
        it->matrix != MATRIX_HERE)
        TRY(form_matrix(it, &changed, err));
    if (changed) {
        r->history[k] = scale_norms(s, it->scale, r->norm);
        return 0;
    }
    if (s->linear.factored && r->history[k] > 0)
        TRY(polish(it, &change, err));
    r->converged = change <= LAST_STEP || r->history[k] <= ROUND_OFF;
    if (it->near > it->enough) { /* of the prediction nothing has been solved yet */
        r->history[k] = largest(s->space->n_field, r->norm);
        r->converged = r->history[k] <= ROUND_OFF || (k > 0 && r->history[k] <= it->enough);
    }
    return 0;
}

/* A matrix for the step from iterate k. */
static int need_matrix(iterate *it, int k, error *err)
{
    newton_report *r = it->report;
    int changed;

    it->linear = it->linear && (k == 0 || r->history[k] <= LINEAR_FALL * r->history[k - 1]);
    if (it->matrix == MATRIX_HERE || it->linear)
        return 0;
    TRY(form_matrix(it, &changed, err));
    if (changed)
        r->history[k] = scale_norms(it->s, it->scale, r->norm);
    return 0;
}

/* What a step must lower: the norms of the fields together, but for those that wait (scale.c).  These depend on
 * fields that have not converged and that do not depend on them.  Their equations are still changing: a quantity
 * derived from a flow starts as 0 = 0, and every step towards the flow makes its residual grow.  It must not forbid
 * the step, as it may grow without harm: what it depends on goes its way whatever it does, and then it is its turn.
 */
static double merit(const newton_system *s, const double *norm, uint32_t waits)
{
    double sum = 0;

    for (int f = 0; f < s->space->n_field; f++)
        sum += waits >> f & 1 ? 0 : norm[f] * norm[f];
    return sqrt(sum);
}

/* s->step: Newton's, of a linear solution that leaves no more than it->left. */
static int solve_step(iterate *it, int k, error *err)
{
    newton_system *s = it->s;
    newton_report *r = it->report;
    int status;

    vector_negative(s->space, s->residual, s->rhs);
    TRY(gauge_tell(s, err));
    if (it->solved)
        linear_keep(&s->linear);
    status = linear_solve(&s->linear, s->rhs, s->step, it->left, err);
    it->solved = 1;
    if (status && !explain_is_finite(s))
        return explain_nan(s, it->time, it->x, err);
    if (status && err->retry) {
        /* what the equations determine may have converged; some unknowns they do not */
        r->singular = 1;
        r->converged = k > 0 && r->history[k] <= 100 * it->o->tolerance;
        explain_singular(s, err);
    }
    return status;
}

/* s->step: Newton's; scales with it; inexact[k]. */
static int correct(iterate *it, int k, error *err)
{
    newton_system *s = it->s;
    newton_report *r = it->report;
    double norm[SPACE_MAX_FIELDS];

    for (it->left = forcing(it->s, it->o, r, it->length, it->enough, k);;
         it->left = fmin(0.1, it->left / it->inexact[k]) * it->left) {
        TRY(solve_step(it, k, err));
        scale_fields(s, it->x, s->step, it->scale);
        if (!isfinite(scale_norms(s, it->scale, r->norm)))
            return explain_nan(s, it->time, it->x, err);
        scale_norms_free(s, s->linear.r, it->scale, norm);
        it->inexact[k] = merit(s, norm, 0) / merit(s, r->norm, 0);
        if (!(it->left > LINEAR_ACCEPT && it->inexact[k] > LEFT_SCALED * it->left &&
              it->inexact[k] > FORCING_LEAST))
            return 0;
    }
}

/* Whether there will be an iteration after the one from k: by residuals that fall quadratically, at first by the
 * solve before.  Not after a step that had to be shortened: it may have to be again. */
static int expects_more(const iterate *it, int k)
{
    const double *h = it->report->history;

    if (it->linear || k + 1 >= it->o->max_iterations)
        return 0;
    if (k == 0)
        return it->s->last_iterations != 1;
    return it->length[k - 1] == 1 && h[k] * fmax(pow(h[k] / h[k - 1], 2), it->inexact[k]) > it->enough;
}

/* One trial of the line search, at s->trial: *after = its merit, or NaN.  An error only if going on makes no sense.
 */
static int try_step(iterate *it, double length, int with_matrix, uint32_t waits, double *after, error *err)
{
    newton_system *s = it->s;
    int status;

    *after = NAN;
    memcpy(s->trial, it->x, (size_t)s->space->n_dof * sizeof *it->x);
    vector_step(s->space, length, s->step, s->trial);
    if (with_matrix) {
        it->matrix = MATRIX_LOST;
        it->solved = 0;
    }
    status = system_evaluate(s, it->time, s->trial, with_matrix, 0, err);
    it->retry = status && err->retry;
    if (status)
        return it->retry ? 0 : status;
    gauge_project(s, s->residual);
    if (isfinite(scale_norms(s, it->scale, it->report->norm)))
        *after = merit(s, it->report->norm, waits);
    return 0;
}

/* Moves x along the step: whole, or halved until the scaled residual falls; length[k] = 0 if it does not. */
static int line_search(iterate *it, int k, uint32_t waits, error *err)
{
    newton_system *s = it->s;
    newton_report *r = it->report;
    double before = merit(s, r->norm, waits), after = 0, *length = &it->length[k];

    it->matrix = MATRIX_OLD;
    for (*length = 1; *length > 1e-3; *length *= 0.5) {
        int both = *length == 1 && expects_more(it, k);

        TRY(try_step(it, *length, both, waits, &after, err));
        if (after <= (1 - 1e-4 * *length) * before || after < 1e-12) {
            memcpy(it->x, s->trial, (size_t)s->space->n_dof * sizeof *it->x);
            it->matrix = both ? MATRIX_HERE : it->matrix;
            return 0;
        }
    }
    *length = 0;
    r->converged = k > 0 && r->history[k] <= 100 * it->o->tolerance; /* round-off: nothing smaller is to be had */
    if (r->converged)
        return 0;
    if (it->retry)
        return err->code;
    if (!isfinite(after)) {
        int status = explain_nan(s, it->time, s->trial, err);

        err->retry = 1; /* x itself is sound, and so may be other ways from it */
        return status;
    }
    give_up(r, "no step along Newton's direction lowers the residual (%.2g)", r->history[k]);
    return 0;
}

/* From iterate k, with its step, to the next; length[k] = 0 if there is none. */
static int advance(iterate *it, int k, error *err)
{
    newton_system *s = it->s;
    newton_report *r = it->report;
    uint32_t waits = scale_waiting(s, r->norm, it->o->tolerance);
    int changed = 0;

    TRY(line_search(it, k, waits, err));
    if (it->length[k] == 0)
        return 0;
    if (it->matrix == MATRIX_LOST) {
        TRY(form_matrix(it, &changed, err));
    } else if (it->matrix == MATRIX_HERE) {
        TRY(gauge_detect(s, &changed, err));
        if (changed)
            TRY(system_evaluate(s, it->time, it->x, 0, 0, err));
        if (changed)
            gauge_project(s, s->residual);
    }
    scale_fields(s, it->x, NULL, it->scale);
    return 0;
}

/* What to go on to, by the residual of the first iterate. */
static void aim(iterate *it)
{
    it->enough = fmax(it->o->tolerance, it->o->fall * it->report->history[0]);
    it->near = it->enough > it->o->tolerance ? NEAR * it->enough : it->enough;
}

/* Iterate k: done (*more = 0), or on to the next. */
static int iterate_once(iterate *it, int k, int *more, error *err)
{
    newton_system *s = it->s;
    newton_report *r = it->report;

    *more = 0;
    r->iterations = k;
    r->history[k] = scale_norms(s, it->scale, r->norm);
    if (!isfinite(r->history[k]))
        return explain_nan(s, it->time, it->x, err);
    if (s->talk)
        s->talk(s->talk_ctx, k, r->history[k], r->norm, k > 0 ? it->length[k - 1] : 0);
    if (k == 0)
        aim(it);
    if (r->history[k] <= it->near)
        TRY(settle(it, k, err));
    if (r->converged)
        return 0;
    if (s->stop && *s->stop) {
        give_up(r, "stopped by a signal");
        return 0;
    }
    if (k >= it->o->max_iterations || k >= NEWTON_MAX_ITERATIONS || (k > 0 && it->length[k - 1] < 0.01)) {
        give_up(r, "residual %.2g after %d iterations", r->history[k], k);
        return 0;
    }
    if (it->o->hurry && k >= LEAST_TRIES && r->history[k] > SLOW * r->history[k - 3] &&
        r->history[k] > 1e3 * it->o->tolerance) {
        give_up(
            r, "Newton's method is too far from the solution: residual %.2g after %d iterations, %.2g three before",
            r->history[k], k, r->history[k - 3]);
        return 0;
    }
    TRY(need_matrix(it, k, err));
    TRY(correct(it, k, err));
    TRY(advance(it, k, err));
    *more = it->length[k] > 0;
    return 0;
}

int newton_solve(newton_system *s, const newton_time *time, const newton_options *o, double *x,
                 newton_report *report, error *err)
{
    iterate it = {.s = s, .time = time, .o = o, .report = report, .x = x, .linear = system_is_linear(s, time)};
    int64_t evaluations = s->evaluations, matrices = s->matrices;
    int more = 1, changed, status;

    memset(report, 0, sizeof *report);
    status = form_matrix(&it, &changed, err);
    if (!status)
        scale_fields(s, x, NULL, it.scale);
    for (int k = 0; !status && more; k++)
        status = iterate_once(&it, k, &more, err);
    s->last_iterations = report->iterations;
    if (report->iterations > 0 && report->converged)
        s->last_fall = fmin(1, report->history[1] / report->history[0]);
    report->evaluations = s->evaluations - evaluations;
    report->matrices = s->matrices - matrices;
    if (status && err->retry) {
        give_up(report, "%s", err->text);
        return 0;
    }
    TRY(status);
    observe_order(report, it.inexact);
    if (!s->gauge.approximate)
        observe_linear(report, it.length, it.inexact);
    return 0;
}
