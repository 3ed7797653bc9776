/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Newton's method with backtracking.
 *
 * A field has converged when |r_f| <= tolerance * scale_f.  The scale is what the rows of the
 * field add up before they cancel, | |J| x~ |, x~ the size of the unknowns; a field that vanishes has the
 * size (|J| |x|)_j / |J_jj| that nothing balancing its row would give it: so a velocity that is zero
 * in the end is measured by the forces that might have moved it.  The last step must have been small, too. */
#include "solve/solve.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* A field below this, relative to what its equations might make of it, is zero but for round-off. */
#define VANISHES 1e-12
/* A scaled residual that nothing makes smaller. */
#define ROUND_OFF 1e-14
/* Newton goes on until its last step was smaller than this, relative to the field: what is left is its square. */
#define LAST_STEP 1e-4

int system_create(newton_system *s, space *sp, const assembly_spec *spec, int n_spec, const pf_solver *solver,
                  int n_thread, error *err)
{
    memset(s, 0, sizeof *s);
    s->space = sp;
    TRY(assembly_create(&s->assembly, sp, spec, n_spec, n_thread, err));
    TRY(linear_create(&s->linear, solver, sp, n_thread, err));
    ARENA_NEW(&s->memory, s->residual, sp->n_dof, err);
    ARENA_NEW(&s->memory, s->trial, sp->n_dof, err);
    ARENA_NEW(&s->memory, s->step, sp->n_dof, err);
    ARENA_NEW(&s->memory, s->rhs, sp->n_dof, err);
    ARENA_NEW(&s->memory, s->scale, sp->n_dof, err);
    ARENA_NEW(&s->memory, s->work, sp->n_dof, err);
    return 0;
}

int system_renew(newton_system *s, error *err)
{
    linear_stats stats = s->linear.stats;
    const pf_solver *solver = s->linear.solver;
    double limit = s->linear.memory_limit;

    TRY(space_constrain(s->space, err));
    linear_destroy(&s->linear);
    TRY(linear_create(&s->linear, solver, s->space, s->assembly.n_thread, err));
    s->linear.stats = stats;
    s->linear.memory_limit = limit;
    return 0;
}

void system_destroy(newton_system *s)
{
    assembly_destroy(&s->assembly);
    linear_destroy(&s->linear);
    arena_free(&s->memory);
    memset(s, 0, sizeof *s);
}

static int evaluate(newton_system *s, const newton_time *time, const double *x, int with_matrix, int diagnose,
                    error *err)
{
    const space *sp = s->space;
    assembly_state st = {.t = time->t,
                         .dt = time->dt,
                         .shift = time->shift,
                         .x = x,
                         .dot = s->work,
                         .old = time->old,
                         .bodies = time->bodies,
                         .frame = time->frame,
                         .faded = time->faded,
                         .only = time->only};
    double start = solve_seconds();
    int status;

    for (int64_t d = 0; d < sp->n_dof; d++)
        s->work[d] = time->history ? time->shift * x[d] + time->history[d] : 0;
    if (!st.old)
        st.old = x;
    status = assembly_run(&s->assembly, &st, s->residual, with_matrix ? s->linear.value : NULL, diagnose, err);
    s->assemble_seconds += solve_seconds() - start;
    return status;
}

int newton_residual(newton_system *s, const newton_time *time, const double *x, double *residual, error *err)
{
    TRY(evaluate(s, time, x, 0, 0, err));
    memcpy(residual, s->residual, (size_t)s->space->n_dof * sizeof *residual);
    return 0;
}

/* scale[f] as above, from the matrix at x; with a step, the unknowns count with what they are about to become. */
static void field_scales(newton_system *s, const double *x, const double *step, double *scale)
{
    const space *sp = s->space;
    const double *a = s->linear.value;
    double *size = s->scale, most[SPACE_MAX_FIELDS] = {0}, might[SPACE_MAX_FIELDS] = {0},
           mean[SPACE_MAX_FIELDS] = {0};
    int64_t n[SPACE_MAX_FIELDS] = {0};

    for (int64_t i = 0; i < sp->n_free; i++) {
        int f = sp->dof_field[sp->dof_of[i]];
        double sum = fabs(s->residual[sp->dof_of[i]]), diagonal = 0, largest = 0;

        for (int64_t k = sp->row[i]; k < sp->row[i + 1]; k++) {
            sum += fabs(a[k] * x[sp->dof_of[sp->col[k]]]);
            largest = fmax(largest, fabs(a[k]));
            if (sp->col[k] == i)
                diagonal = fabs(a[k]);
        }
        size[i] = diagonal > 1e-8 * largest ? sum / diagonal : 0;
        most[f] = fmax(most[f], fabs(x[sp->dof_of[i]]));
        might[f] = fmax(might[f], size[i]);
    }
    for (int64_t i = 0; i < sp->n_free; i++) {
        int f = sp->dof_field[sp->dof_of[i]];

        size[i] =
            fabs(x[sp->dof_of[i]]) + (most[f] < VANISHES * might[f] ? size[i] : 0) + (step ? fabs(step[i]) : 0);
        mean[f] += size[i] * size[i];
        n[f]++;
    }
    for (int f = 0; f < sp->n_field; f++) {
        s->vanishes[f] = most[f] < VANISHES * might[f] || most[f] == 0;
        mean[f] = n[f] ? sqrt(mean[f] / (double)n[f]) : 0; /* no component counts for less than this */
        scale[f] = 0;
    }
    for (int64_t i = 0; i < sp->n_free; i++) {
        double sum = 0;

        for (int64_t k = sp->row[i]; k < sp->row[i + 1]; k++)
            sum += fabs(a[k]) * fmax(size[sp->col[k]], mean[sp->dof_field[sp->dof_of[sp->col[k]]]]);
        scale[sp->dof_field[sp->dof_of[i]]] += sum * sum;
    }
    for (int f = 0; f < sp->n_field; f++)
        scale[f] = sqrt(scale[f]);
}

/* Largest relative change of a field by the last step; fields that vanish do not count. */
static double field_change(const newton_system *s, const double *x, double length)
{
    const space *sp = s->space;
    double step[SPACE_MAX_FIELDS] = {0}, size[SPACE_MAX_FIELDS] = {0}, largest = 0;

    for (int64_t i = 0; i < sp->n_free; i++) {
        int f = sp->dof_field[sp->dof_of[i]];
        double v = x[sp->dof_of[i]], d = length * s->step[i];

        step[f] += d * d;
        size[f] += v * v;
    }
    for (int f = 0; f < sp->n_field; f++)
        if (!s->vanishes[f] && size[f] > 0 && !s->gauge.free[f] && sp->field[f].support != PF_IN_PARTICLES)
            largest = fmax(largest, sqrt(step[f] / size[f]));
    return largest;
}

/* Scaled residual of each field; returns the largest. */
static double field_norms(const newton_system *s, const double *scale, double *norm)
{
    const space *sp = s->space;
    double largest = 0;

    for (int f = 0; f < sp->n_field; f++)
        norm[f] = 0;
    for (int64_t i = 0; i < sp->n_free; i++) {
        double r = s->residual[sp->dof_of[i]];

        norm[sp->dof_field[sp->dof_of[i]]] += r * r;
    }
    for (int f = 0; f < sp->n_field; f++) {
        norm[f] = norm[f] > 0 ? sqrt(norm[f]) / (scale[f] > 0 ? scale[f] : 1) : norm[f];
        if (!(norm[f] <= largest))
            largest = norm[f]; /* NaN counts as largest */
    }
    return largest;
}

/* One more correction with the factors there are: it costs a solve and a residual, and takes the
 * error down to round-off.  Kept only if the residual falls.  *change: no more than its relative size. */
static int polish(newton_system *s, const newton_time *time, const double *scale, double *x, double *norm,
                  double *change, error *err)
{
    const space *sp = s->space;
    double before = field_norms(s, scale, norm), after;

    for (int64_t i = 0; i < sp->n_free; i++)
        s->rhs[i] = -s->residual[sp->dof_of[i]];
    gauge_pin(s);
    TRY(linear_apply(&s->linear, s->rhs, s->step, err));
    memcpy(s->trial, x, (size_t)sp->n_dof * sizeof *x);
    for (int64_t i = 0; i < sp->n_free; i++)
        x[sp->dof_of[i]] += s->step[i];
    TRY(evaluate(s, time, x, 0, 0, err));
    gauge_project(s, s->residual);
    after = field_norms(s, scale, norm);
    *change = fmin(*change, field_change(s, x, 1));
    if (after < before)
        return 0;
    memcpy(x, s->trial, (size_t)sp->n_dof * sizeof *x);
    TRY(evaluate(s, time, x, 0, 0, err));
    gauge_project(s, s->residual);
    field_norms(s, scale, norm);
    return 0;
}

static double merit(const newton_system *s, const double *norm)
{
    double sum = 0;

    for (int f = 0; f < s->space->n_field; f++)
        sum += norm[f] * norm[f];
    return sqrt(sum);
}

/* Moves x along the step: whole, or halved until the scaled residual falls.  Returns the length, 0 = failed. */
static int line_search(newton_system *s, const newton_time *time, const double *scale, double before, double *x,
                       double *length, double *norm, error *err)
{
    const space *sp = s->space;

    for (*length = 1; *length > 1e-3; *length *= 0.5) {
        int status;
        double after;

        memcpy(s->trial, x, (size_t)sp->n_dof * sizeof *x);
        for (int64_t i = 0; i < sp->n_free; i++)
            s->trial[sp->dof_of[i]] += *length * s->step[i];
        status = evaluate(s, time, s->trial, 0, 0, err);
        if (status && !err->retry)
            return status;
        gauge_project(s, s->residual);
        field_norms(s, scale, norm);
        after = merit(s, norm);
        if (!status && isfinite(after) && (after <= (1 - 1e-4 * *length) * before || after < 1e-12)) {
            memcpy(x, s->trial, (size_t)sp->n_dof * sizeof *x);
            return 0;
        }
    }
    *length = 0;
    return 0;
}

/* Names who put the NaN there. */
static int explain_nan(newton_system *s, const newton_time *time, const double *x, error *err)
{
    int status = evaluate(s, time, x, 0, 1, err);

    if (!status)
        status = error_set(err, ERR_CONVERGE, "the residual is not a finite number");
    err->retry = time->history != NULL; /* a smaller step may avoid it */
    return status;
}

/* Order and ratio at the last iteration that is above round-off. */
static void observe_order(newton_report *r)
{
    int k = r->iterations;

    while (k > 1 && r->history[k] < 1e-14)
        k--;
    r->ratio = k >= 1 && r->history[k - 1] > 0 ? r->history[k] / (r->history[k - 1] * r->history[k - 1]) : 0;
    if (k >= 2 && r->history[k - 1] < r->history[k - 2])
        r->order = log(r->history[k] / r->history[k - 1]) / log(r->history[k - 1] / r->history[k - 2]);
}

int newton_solve(newton_system *s, const newton_time *time, const newton_options *o, double *x,
                 newton_report *report, error *err)
{
    const space *sp = s->space;
    double scale[SPACE_MAX_FIELDS], length = 0;
    int stalled = 0;

    memset(report, 0, sizeof *report);
    for (int k = 0;; k++) {
        int status = evaluate(s, time, x, 1, 0, err);

        if (status && err->retry) {
            snprintf(report->why, sizeof report->why, "%.280s", err->text);
            return 0;
        }
        TRY(status);
        TRY(gauge_detect(s, err));
        gauge_project(s, s->residual);
        field_scales(s, x, NULL, scale);
        report->iterations = k;
        report->history[k] = field_norms(s, scale, report->norm);
        if (!isfinite(report->history[k])) {
            status = explain_nan(s, time, x, err);
            if (!err->retry)
                return status;
            snprintf(report->why, sizeof report->why, "%.280s", err->text);
            return 0;
        }
        if (s->talk)
            s->talk(s->talk_ctx, k, report->history[k], report->norm, length);
        if (report->history[k] <= o->tolerance && gauge_holds(s)) {
            double change = report->history[k] > 0 && k > 0 ? field_change(s, x, length) : 0;

            if (s->linear.factored && report->history[k] > 0)
                TRY(polish(s, time, scale, x, report->norm, &change, err));
            report->converged = change <= LAST_STEP || report->history[k] <= ROUND_OFF;
            if (report->converged)
                break;
        }
        if (s->stop && *s->stop) {
            snprintf(report->why, sizeof report->why, "stopped by a signal");
            break;
        }
        if (k >= o->max_iterations || k >= NEWTON_MAX_ITERATIONS || stalled) {
            snprintf(report->why, sizeof report->why, "residual %.2g after %d iterations", report->history[k], k);
            break;
        }
        for (int64_t i = 0; i < sp->n_free; i++)
            s->rhs[i] = -s->residual[sp->dof_of[i]];
        gauge_pin(s);
        status = linear_solve(&s->linear, s->rhs, s->step, o->linear_tolerance, err);
        if (status && err->retry) {
            /* what the equations determine has converged; some unknowns they do not */
            report->converged = report->singular = k > 0 && report->history[k] <= 100 * o->tolerance;
            snprintf(report->why, sizeof report->why, "%.280s", err->text);
            return 0;
        }
        TRY(status);
        field_scales(s, x, s->step, scale);
        field_norms(s, scale, report->norm);
        TRY(line_search(s, time, scale, merit(s, report->norm), x, &length, report->norm, err));
        if (length == 0) {
            /* round-off: nothing smaller is to be had */
            if (report->history[k] <= 100 * o->tolerance && k > 0) {
                report->converged = 1;
                break;
            }
            snprintf(report->why, sizeof report->why, "no step along Newton's direction lowers the residual (%.2g)",
                     report->history[k]);
            break;
        }
        stalled = length < 0.01;
    }
    observe_order(report);
    return 0;
}
