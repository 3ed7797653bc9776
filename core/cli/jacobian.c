/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * plugflow jacobian CASE: the assembled matrix against differences of the assembled residual,
 * per pair of fields, at a random state of the real problem. */
#include "base/random.h"
#include "cli/cli.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { DIRECTIONS = 4 };

/* Sums over rows of field f of (J d - dR)^2 and (J d)^2 for directions d in field g; old values stay. */
static int compare(problem *p, double shift, double *x, const double *old, double *d, double *plus, double *minus,
                   int g, double *diff, double *size, unsigned long long *random, error *err)
{
    const space *s = &p->space;
    newton_system *sys = &p->system;
    const uint8_t *idle = p->bodies.now ? p->bodies.now->idle : sys->assembly.none_idle;
    const double h = 1e-6;

    for (int k = 0; k < DIRECTIONS; k++) {
        assembly_state st = {.t = p->description.time.start,
                             .dt = p->description.time.step,
                             .shift = shift,
                             .x = x,
                             .dot = sys->step,
                             .old = old,
                             .kept = p->state.kept,
                             .bodies = problem_points(p)};

        for (int64_t i = 0; i < s->n_dof; i++)
            d[i] = s->dof_field[i] == g && !s->fixed[i] && !idle[i] ? 2 * random_next(random) - 1 : 0;
        for (int sign = -1; sign <= 1; sign += 2) {
            for (int64_t i = 0; i < s->n_dof; i++) {
                x[i] += sign * h * d[i];
                sys->step[i] = shift * x[i];
            }
            TRY(assembly_run(&sys->assembly, &st, sign < 0 ? minus : plus, NULL, 0, err));
            for (int64_t i = 0; i < s->n_dof; i++)
                x[i] -= sign * h * d[i];
        }
        for (int64_t i = 0; i < s->n_free; i++) {
            int f = s->dof_field[s->dof_of[i]];
            double jd = 0, dr = (plus[s->dof_of[i]] - minus[s->dof_of[i]]) / (2 * h);

            for (int64_t e = s->row[i]; e < s->row[i + 1]; e++)
                jd += sys->linear.value[e] * d[s->dof_of[space_column(s, i, e)]];
            diff[f] += (jd - dr) * (jd - dr);
            size[f] += dr * dr;
        }
    }
    return 0;
}

static int all_pairs(problem *p, error *err)
{
    const space *s = &p->space;
    newton_system *sys = &p->system;
    const uint8_t *idle = p->bodies.now ? p->bodies.now->idle : sys->assembly.none_idle;
    double shift = p->description.time.unsteady ? 1.5 / p->description.time.step : 0, *x, *old, *d, *plus, *minus;
    unsigned long long random = RANDOM_SEED;
    int wrong = 0;

    ARENA_NEW(&p->memory, x, s->n_dof, err);
    ARENA_NEW(&p->memory, old, s->n_dof, err);
    ARENA_NEW(&p->memory, d, s->n_dof, err);
    ARENA_NEW(&p->memory, plus, s->n_dof, err);
    ARENA_NEW(&p->memory, minus, s->n_dof, err);
    for (int64_t i = 0; i < s->n_dof; i++) {
        x[i] = p->state.x[i] + (idle[i] || s->fixed[i] & SPACE_AWAY ? 0 : 2 * random_next(&random) - 1);
        sys->step[i] = shift * x[i];
    }
    memcpy(old, x, (size_t)s->n_dof * sizeof *old);
    TRY(assembly_run(&sys->assembly,
                     &(assembly_state){.t = p->description.time.start,
                                       .dt = p->description.time.step,
                                       .shift = shift,
                                       .x = x,
                                       .dot = sys->step,
                                       .old = old,
                                       .kept = p->state.kept,
                                       .bodies = problem_points(p)},
                     sys->residual, sys->linear.value, 1, err));
    for (int g = 0; g < s->n_field; g++) {
        double diff[SPACE_MAX_FIELDS] = {0}, size[SPACE_MAX_FIELDS] = {0};

        TRY(compare(p, shift, x, old, d, plus, minus, g, diff, size, &random, err));
        for (int f = 0; f < s->n_field; f++) {
            double e = sqrt(diff[f]), n = sqrt(size[f]);
            int ok = e <= 1e-6 * n || e <= 1e-7 * (1 + n);

            wrong += !ok;
            printf("  %s  d R_%s / d %s  %s%.1e\n", ok ? "ok   " : "WRONG", s->field[f].name, s->field[g].name,
                   n == 0 && ok ? "zero, " : "differences agree to ", n > 0 ? e / n : e);
        }
    }
    return wrong ? error_set(err, ERR_PLUGIN,
                             "%d blocks are wrong; plugflow test PLUGIN tests the terms one by one", wrong)
                 : 0;
}

int cli_jacobian(const cli *o, error *err)
{
    cli_case *k = malloc(sizeof *k);
    int status;

    if (!k)
        return error_memory(err, "case", sizeof *k);
    status = cli_open(o, k, err);
    if (!status)
        status = problem_initial(&k->p, err);
    if (!status)
        status = all_pairs(&k->p, err);
    cli_close(k);
    free(k);
    return status;
}
