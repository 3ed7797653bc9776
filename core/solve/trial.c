/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The test of a linear solver: each kind of system that there is, then the life of an instance, then every choice
 * of its parameters. */
#include "solve/trial_call.h"

#include "solve/linear.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE = 7 }; /* nodes or elements in each direction: hundreds of rows */

/* Kinds by which an instance is judged: those tell most that are not symmetric. */
static const enum trial_kind BY[] = {TRIAL_CONVECTION, TRIAL_OSEEN, TRIAL_STOKES, TRIAL_DIFFUSION};
enum { N_BY = sizeof BY / sizeof *BY };

static int has_params(const pf_solver *s)
{
    return LINEAR_HAS(s, configure) && s->n_param && s->param;
}

static pf_param param(const pf_solver *s, uint32_t i)
{
    pf_param q = {0};

    memcpy(&q, (const char *)s->param + (size_t)i * s->param_size,
           s->param_size < sizeof q ? s->param_size : sizeof q);
    return q;
}

/* Whether the description can be used, as solve {} asks for. */
static int check_params(trials *c)
{
    for (uint32_t i = 0; i < c->solver->n_param; i++) {
        const pf_param q = param(c->solver, i);
        const size_t bytes = q.type == PF_T_REAL     ? sizeof(double)
                             : q.type == PF_T_VECTOR ? 3 * sizeof(double)
                                                     : sizeof(int);

        if (q.name && q.doc && q.unit && q.offset + bytes <= c->solver->params_bytes && q.type >= PF_T_REAL &&
            q.type <= PF_T_CHOICE && (q.type != PF_T_CHOICE || q.choice))
            continue;
        trial_line(c, 0, "parameter %u (%s) has no name, unit, doc, type or choices, or lies outside its struct", i,
                   q.name ? q.name : "without a name");
        return 0;
    }
    return 1;
}

static void set_defaults(const pf_solver *s, void *params)
{
    for (uint32_t i = 0; i < s->n_param; i++) {
        const pf_param q = param(s, i);

        term_defaults(&(pf_term){.n_param = 1, .param = &q}, params);
    }
}

/* One system from beginning to end.  *fits: it is one for this solver. */
static int try_kind(trials *c, enum trial_kind kind, const char *subject, int *fits, error *err)
{
    trial t;
    void *self = NULL;
    int status = trial_create(&t, kind, SIDE, TRIAL_FIRST, err), got;

    *fits = 0;
    if (status)
        return trial_destroy(&t), status;
    got = trial_begin(c, &self, &t);
    if (got == PF_SOLVER_UNFIT && strcmp(c->why, "it does not say why") != 0)
        trial_line(c, 1, "%s: says that it is not for this: %s", subject, c->why);
    else if (got)
        trial_failed(c, subject, got);
    else
        status = trial_check(c, self, &t, subject, NULL, NULL, err);
    *fits = !got;
    trial_drop(c, self);
    trial_destroy(&t);
    return status;
}

/* Every choice of a parameter that has some, the others as they are. */
static int try_choices(trials *c, enum trial_kind kind, char *params, error *err)
{
    for (uint32_t i = 0; i < c->solver->n_param; i++) {
        const pf_param q = param(c->solver, i);

        for (int k = 0; q.type == PF_T_CHOICE && q.choice[k]; k++) {
            char subject[200];
            int fits;

            if (k == (int)q.dflt)
                continue;
            snprintf(subject, sizeof subject, "%s, with %.60s = \"%.60s\"", trial_name(kind), q.name, q.choice[k]);
            memcpy(params + q.offset, &k, sizeof k);
            TRY(try_kind(c, kind, subject, &fits, err));
            set_defaults(c->solver, params);
        }
    }
    return 0;
}

static int run(trials *c, char *params, error *err)
{
    int fits[N_TRIAL] = {0}, by = 0;

    for (int k = 0; k < N_TRIAL; k++) {
        const enum trial_kind not = c->approximate ? TRIAL_HELD : TRIAL_ENCLOSED;

        if (k != (int)not )
            TRY(try_kind(c, (enum trial_kind)k, trial_name((enum trial_kind)k), &fits[k], err));
    }
    while (by < N_BY && !fits[BY[by]])
        by++;
    if (by == N_BY) {
        trial_line(c, 0, "no system is one for this solver: nothing was tested");
        return 0;
    }
    TRY(trial_life(c, BY[by], SIDE, err));
    return params ? try_choices(c, BY[by], params, err) : 0;
}

int trial_run(selftest *s, const pf_solver *solver, error *err)
{
    trials c = {.s = s, .solver = solver, .approximate = linear_approximates(solver)};
    char *params = NULL;
    int status;

    *err->text = 0;
    if (!solver->create || !solver->analyze || !solver->setup || !solver->solve || !solver->destroy) {
        trial_line(&c, 0, "one of create, analyze, setup, solve, destroy is missing");
        return 0;
    }
    if (has_params(solver)) {
        if (!check_params(&c))
            return 0;
        if (!(params = calloc(1, solver->params_bytes + 1)))
            return error_memory(err, "parameters of a solver", solver->params_bytes);
        set_defaults(solver, params);
        trial_line(&c, 1, "%u parameters, at their defaults", solver->n_param);
    }
    c.params = params;
    status = run(&c, params, err);
    free(params);
    return status;
}
