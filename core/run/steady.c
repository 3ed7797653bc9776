/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The one solution of a steady case.
 *
 * On a box it starts, where that pays, from the solution on half as many cells in each direction, which starts from
 * one on a quarter, and so on: of the fine grid's matrices one is factored, where Newton's method is about to
 * converge. */
#include "run/run.h"

#include "space/evaluate.h"
#include "space/locate.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Newton's iterations of a steady case, one line each. */
static void tell_newton(void *ctx, int iteration, double norm, const double *field_norm, double length)
{
    const run *r = ctx;
    const space *s = &r->p->space;
    char line[400];
    int n = snprintf(line, sizeof line, "  newton %2d  residual %.2e ", iteration, norm);

    for (int f = 0; f < s->n_field && n < 300; f++)
        n += snprintf(line + n, sizeof line - (size_t)n, "  %s %.1e", s->field[f].name, field_norm[f]);
    if (iteration > 0 && length < 1)
        snprintf(line + n, sizeof line - (size_t)n, "  step %.3g", length);
    run_say(r, "%s", line);
}

static void tell_continuation(void *ctx, double s, int iterations, int converged)
{
    const run *r = ctx;

    if (s >= 1 && !converged)
        run_say(r, "  no convergence from here in %d iterations; going on by continuation", iterations);
    else
        run_say(r, "  continuation at %.3g: %s in %d iterations", s, converged ? "converged" : "no convergence",
                iterations);
}

/* The steady state, from the state of now; if that is one of a coarser grid and leads to none, from the start of
 * the case. */
static int find(problem *p, int started, newton_report *report, int *steps, continuation_talk *talk, void *ctx,
                error *err)
{
    continuation direct = {.bodies = problem_points(p)};

    p->continuation.bodies = direct.bodies;
    if (started) {
        int status =
            continuation_solve(&p->system, &direct, &p->newton, p->state.x, report, steps, NULL, NULL, err);

        if (status == ERR_MEMORY || (!status && (report->converged || (p->system.stop && *p->system.stop))))
            return status;
        TRY(problem_initial(p, err));
    }
    return continuation_solve(&p->system, &p->continuation, &p->newton, p->state.x, report, steps, talk, ctx, err);
}

/* --- a start from a coarser grid --- */

/* Unknowns below which it is not worth a line of output, and cells in a direction that a coarse grid has at least:
 * with fewer the flow may be another one. */
enum { LEAST_UNKNOWNS = 8000, LEAST_CELLS = 6 };

/* The solution on the coarse grid need not be better than that grid is. */
#define COARSE_TOLERANCE 1e-6

static int may_start_coarse(const problem *p)
{
    const description *d = &p->description;
    int fewest = d->mesh.box.n[0];

    for (int k = 1; k < d->dim; k++)
        fewest = d->mesh.box.n[k] < fewest ? d->mesh.box.n[k] : fewest;
    if (!describe_is_box(d) || d->n_body || p->space.any_cell || d->solve.coarse_start == 0)
        return 0;
    return fewest >= 2 * LEAST_CELLS && (d->solve.coarse_start > 0 || p->space.n_dof >= LEAST_UNKNOWNS) &&
           !system_is_linear(&p->system, &(newton_time){0});
}

/* x: the coarse solution at the places of the fine unknowns. */
static int interpolate(const problem *coarse, problem *fine, double *x)
{
    const space *s = &fine->space;

    for (int f = 0; f < s->n_field; f++)
        for (int64_t c = 0; c < s->n_carrier; c++) {
            const double *at = fine->mesh.x + c * fine->mesh.dim;
            located in;

            if (s->first[f][c] < 0)
                continue;
            if (c >= fine->mesh.n_node) { /* of the problem as a whole: carriers after the nodes are the same */
                int64_t same = c - fine->mesh.n_node + coarse->mesh.n_node;

                memcpy(x + s->first[f][c], coarse->state.x + coarse->space.first[f][same],
                       (size_t)s->field[f].n_comp * sizeof *x);
                continue;
            }
            in = locate_point(&coarse->mesh, &coarse->grid, at);
            if (in.cell < 0)
                return 0;
            locate_value(&coarse->space, &in, f, coarse->state.x, x + s->first[f][c], NULL);
        }
    return 1;
}

static int start_coarse(const run *r, problem *p, const volatile sig_atomic_t *stop, int *started, error *err);

static void tell_grid(const run *r, const problem *p, const newton_report *report)
{
    const mesh_box *box = &p->description.mesh.box;
    char line[200];
    int n = snprintf(line, sizeof line, "%d x %d", box->n[0], box->n[1]);

    if (box->dim == 3)
        snprintf(line + n, sizeof line - (size_t)n, " x %d", box->n[2]);
    run_say(r, "  coarse grid %s: %s in %d iterations", line, report->converged ? "converged" : "no convergence",
            report->total);
}

static int solve_coarse(const run *r, problem *p, const problem *fine, const volatile sig_atomic_t *stop,
                        newton_report *report, error *err)
{
    int started, steps;

    TRY(problem_create_coarse(p, fine, err));
    TRY(problem_initial(p, err));
    p->newton.tolerance = fmax(p->newton.tolerance, COARSE_TOLERANCE);
    p->system.stop = stop;
    TRY(start_coarse(r, p, stop, &started, err));
    TRY(find(p, started, report, &steps, NULL, NULL, err));
    tell_grid(r, p, report);
    return 0;
}

/* The state of p: that on a coarser grid, if one is found.  It is a start: what went wrong there is not told. */
static int start_coarse(const run *r, problem *p, const volatile sig_atomic_t *stop, int *started, error *err)
{
    problem *coarse;
    newton_report report;
    error ignored;

    *started = 0;
    if (!may_start_coarse(p))
        return 0;
    ARENA_NEW(&p->memory, coarse, 1, err);
    *started = !solve_coarse(r, coarse, p, stop, &report, &ignored) && report.converged &&
               interpolate(coarse, p, p->state.x);
    problem_destroy(coarse);
    if (!*started)
        return problem_initial(p, err);
    return stepper_prescribe(&p->conditions, &p->bodies, p->state.t, p->state.x, err);
}

int run_steady(run *r, const volatile sig_atomic_t *stop, error *err)
{
    problem *p = r->p;
    newton_report report;
    int steps, started;

    TRY(start_coarse(r, p, stop, &started, err));
    p->system.talk = tell_newton;
    p->system.talk_ctx = r;
    p->system.stop = stop;
    TRY(find(p, started, &report, &steps, tell_continuation, r, err));
    r->result->newton_iterations = report.total;
    r->result->last_newton = report.iterations;
    r->result->newton_order = report.order;
    r->result->newton_ratio = report.ratio;
    r->result->steps = 1;
    run_warn_order(r, &report);
    if (!report.converged && stop && *stop) {
        r->result->status = "interrupted";
        return 0;
    }
    if (!report.converged && report.singular)
        return error_set(err, ERR_CONVERGE, "no steady state found: %s", report.why);
    if (!report.converged)
        return error_set(err, ERR_CONVERGE,
                         "no steady state found: %s; refine the mesh, start from an easier problem (solve { "
                         "continuation = { viscosity = "
                         "... } }), or make the case unsteady with time {}",
                         report.why);
    run_warn_singular(r, &report);
    if (report.order > 0)
        run_say(r, "  converged in %d iterations, observed order %.1f, |r| / |r_before|^2 = %.2g",
                report.iterations, report.order, report.ratio);
    else
        run_say(r, "  converged in %d iterations", report.iterations);
    if (p->bodies.n)
        TRY(bodies_fill(&p->bodies, p->bodies.now, p->state.x, err));
    run_take_solution(r);
    TRY(stepper_steady(r->stepper, err));
    TRY(energy_step(r, err));
    TRY(run_log_solve(r, 0, 0, &report, err));
    run_warn_defect(r);
    TRY(output_take(r, 0, err));
    TRY(tables_add(r, 0, err));
    TRY(particles_write(r, 0, err));
    TRY(output_fields(r, 0, err));
    return lines_write(r, 0, err);
}
