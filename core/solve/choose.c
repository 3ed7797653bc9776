/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Which linear solver: by the predicted operations of a factorisation, and by memory. */
#include "base/clock.h"
#include "solve/instance.h"
#include "solve/linear.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* Operations of a factorisation from which an iterative solver is taken: some seconds where one serves for many
 * solutions, some tenths where every step has its own. */
#define MANY_FLOPS           6e10
#define MANY_FLOPS_EACH_STEP 1.5e9
/* The same in 2D, measured: where bodies are near to few cells, the factors of one step serve many (band.h); in
 * suspensions none do. */
#define MANY_FLOPS_FEW_2D   1e10
#define MANY_FLOPS_CROWD_2D 4e8

static double available_memory(void)
{
    FILE *f = fopen("/proc/meminfo", "r");
    char line[200];
    double kb = 0;

    while (f && fgets(line, sizeof line, f))
        if (sscanf(line, "MemAvailable: %lf kB", &kb) == 1)
            break;
    if (f)
        fclose(f);
    return kb > 0 ? 1024 * kb : (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGESIZE);
}

int linear_approximates(const pf_solver *s)
{
    return LINEAR_HAS(s, flags) && (s->flags & PF_SOLVER_APPROXIMATE);
}

int linear_find(linear_choice *c, registry *r, const char *named, error *err)
{
    const pf_solver *s;
    char name[100];
    error ignored;

    if (named) {
        snprintf(name, sizeof name, "%s%s", strncmp(named, "solver_", 7) == 0 ? "" : "solver_", named);
        TRY(registry_solver(r, name, &s, err));
        *(linear_approximates(s) ? &c->iterative : &c->direct) = s;
        return 0;
    }
    if (registry_solver(r, "solver_block", &c->iterative, &ignored))
        c->iterative = NULL;
    return registry_solver(r, "solver_umfpack", &c->direct, err) && !c->iterative ? err->code : 0;
}

const pf_solver *linear_method(const linear *l, int method)
{
    return method == METHOD_DIRECT ? l->choice.direct : l->choice.iterative;
}

const pf_solver *linear_solver(const linear *l)
{
    return l->analyzed || l->band.factors ? linear_method(l, l->at) : NULL;
}

/* Whether the solver reads the matrix as it is. */
static int shares(const pf_solver *s)
{
    return LINEAR_HAS(s, flags) && (s->flags & PF_SOLVER_SHARED_COLUMNS);
}

int linear_holds(const linear *l)
{
    return shares(linear_method(l, l->at)) || packed_holds(&l->packed, l->space);
}

const pf_csr *linear_matrix(linear *l)
{
    if (shares(linear_method(l, l->at)))
        return &l->a;
    packed_values(&l->packed, l->space, &l->a);
    return &l->packed.a;
}

int linear_analyze(linear *l, int method, int *unfit, error *err)
{
    const pf_solver *solver = linear_method(l, method);
    char why[400] = "";
    double t = clock_seconds(), memory = available_memory();
    int status = 0;

    *unfit = 0;
    if (method == METHOD_DIRECT)
        l->band.factors = 0; /* those of before go with the analysis */
    l->stats.cost = (pf_solver_cost){0};
    if (!l->instance[method] &&
        solver_instance(solver, l->choice.params, l->n_thread, &l->instance[method], why, sizeof why))
        return error_set(err, ERR_MEMORY, "linear solver %s: %s", solver->name, why);
    if (!shares(solver))
        TRY(packed_structure(&l->packed, l->space, &l->a, err));
    status = solver->analyze(l->instance[method], shares(solver) ? &l->a : &l->packed.a, &l->stats.cost, why,
                             sizeof why);
    l->stats.analyze_seconds += clock_seconds() - t;
    *unfit = status == PF_SOLVER_UNFIT;
    if (status)
        return error_set(err,
                         status == PF_SOLVER_MEMORY ? ERR_MEMORY
                         : *unfit                   ? ERR_CASE
                                                    : ERR_CONVERGE,
                         "linear solver %s: %s", solver->name, why);
    if (l->memory_limit > 0 && l->memory_limit < memory)
        memory = l->memory_limit;
    if (l->stats.cost.bytes > memory)
        return error_set(
            err, ERR_MEMORY,
            "the %s of %lld unknowns will need %.3g GB (%s) and there are %.3g GB: take fewer cells (%.0f %% in "
            "each "
            "direction would fit), a 2D or symmetric part of the problem, or a machine with more memory%s%s",
            linear_approximates(solver) ? "blocks" : "factors", (long long)l->a.n, l->stats.cost.bytes / 1e9,
            solver->name, memory / 1e9, 100 * pow(memory / l->stats.cost.bytes, 0.25),
            *l->stats.why ? "; the iterative solver: " : "", l->stats.why);
    l->at = method;
    l->analyzed = 1;
    return 0;
}

/* Operations of a sparse factorisation of Taylor-Hood elements after nested dissection: n^(3/2) in 2D, n^2 in 3D;
 * the factors were measured (docs/performance.md). */
static double guess_flops(const linear *l)
{
    double n = (double)l->a.n;

    return l->space->mesh->dim == 2 ? 180 * pow(n, 1.5) : 45 * n * n;
}

static double many_each_step(const space *s)
{
    if (s->mesh->dim == 3)
        return MANY_FLOPS_EACH_STEP;
    return s->crowded ? MANY_FLOPS_CROWD_2D : MANY_FLOPS_FEW_2D;
}

int linear_predict(linear *l, error *err)
{
    error ignored;
    double many = l->choice.each_step ? many_each_step(l->space) : MANY_FLOPS;
    int unfit, status;

    l->stats.direct_flops = 0;
    if (!l->choice.direct)
        return linear_analyze(l, METHOD_ITERATIVE, &unfit, err);
    if (l->choice.iterative && !l->gave_up && guess_flops(l) > many) {
        status = linear_analyze(l, METHOD_ITERATIVE, &unfit, &ignored);
        l->stats.direct_flops = guess_flops(l);
        if (!status)
            return 0;
        snprintf(l->stats.why, sizeof l->stats.why, "%.*s", (int)sizeof l->stats.why - 1, ignored.text);
        l->stats.direct_flops = 0;
    }
    return linear_analyze(l, METHOD_DIRECT, &unfit, err);
}
