/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Which linear solver a case names, and the keys that this solver describes: solve { solver = "klu", tolerance =
 * 0.1 }. */
#include "describe/describe.h"

#include <stdio.h>
#include <string.h>

/* 1 if the solver knows of parameters, which early ones do not. */
static int has_params(const pf_solver *s)
{
    return s->size >= offsetof(pf_solver, configure) + sizeof s->configure && s->n_param && s->param &&
           s->configure;
}

/* Defaults, then what the case says. */
static int read_params(description *d, reader *r, const pf_solver *s, error *err)
{
    char *params;

    ARENA_NEW(&d->memory, params, s->params_bytes + 1, err);
    d->solve.solver_params = params;
    for (uint32_t i = 0; i < s->n_param; i++) {
        const size_t stride = s->param_size;
        pf_param q = {0};
        int status;

        memcpy(&q, (const char *)s->param + i * stride, stride < sizeof q ? stride : sizeof q);
        if ((size_t)q.offset + (q.type == PF_T_REAL ? sizeof(double) : sizeof(int)) > s->params_bytes ||
            q.type < PF_T_REAL || q.type > PF_T_CHOICE || !q.name || !q.doc || !q.unit)
            return error_set(err, ERR_PLUGIN,
                             "linear solver %s: parameter %u has no name, unit, doc or type, or lies "
                             "outside its struct",
                             s->name, i);
        term_defaults(&(pf_term){.n_param = 1, .param = &q}, params);
        TRY(describe_read_param(r, &q, d->dim, params, &status, err));
    }
    return 0;
}

int describe_solver(description *d, registry *reg, reader *r, error *err)
{
    const char *named = d->solve.solver, *near;
    const pf_solver *s;
    char name[100];
    error why = {0};

    if (!named || !reg)
        return 0;
    snprintf(name, sizeof name, "%s%s", strncmp(named, "solver_", 7) == 0 ? "" : "solver_", named);
    if (!registry_knows(reg, name, &near)) {
        if (near && strncmp(near, "solver_", 7) == 0)
            case_wrong(d->c, r->b, "solver", "solve: there is no linear solver \"%s\"; did you mean \"%s\"?", named,
                       near + 7);
        else
            case_wrong(
                d->c, r->b, "solver",
                "solve: there is no linear solver \"%s\": no plugin %s.so was found (plugflow plugins lists them)",
                named, name);
        d->solve.solver = NULL;
        return 0;
    }
    if (registry_solver(reg, name, &s, &why)) {
        case_wrong(d->c, r->b, "solver", "solve: linear solver \"%s\": %.900s", named, why.text);
        d->solve.solver = NULL;
        return 0;
    }
    return has_params(s) ? read_params(d, r, s, err) : 0;
}
