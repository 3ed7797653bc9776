/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Seconds of one evaluation of the equations of a case, residual alone and residual with matrix: best of several.
 *
 *     bench_assembly CASE [--set NAME=VALUE ...] [--threads N [--busiest]] [--seconds S | --times N]
 *
 * prints lines "name value unit".  Bodies that are free have come a tenth of a cell in the step, so that history
 * along their paths is there as in a run.  --times N: exactly N evaluations of each kind,
 * for a count of their instructions.  --busiest: processor seconds of the thread that works most, with
 * OMP_WAIT_POLICY=passive, so that waiting is no work. */
#include "base/clock.h"
#include "base/random.h"
#include "problem/problem.h"
#include "solve/stepper.h"
#include "used.h"

#include <math.h>
#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MOVED 0.1 /* cells a step */

enum { LEVELS = 2, LEAST = 3, MOST_THREADS = 256 };

/* A case, and a state of it amid its steps. */
typedef struct bench {
    case_file c;
    registry r;
    problem p;
    bdf scheme;
    double *x, *level[LEVELS], *history;
    pose *then[LEVELS];
    newton_time time;
    double seconds; /* at least so long */
    int times;      /* not 0: exactly so often */
    int busiest;
} bench;

static int parse(int argc, char **argv, bench *b, const char **sets, int *n_set, int *threads, error *err)
{
    for (int i = 2; i < argc; i++) {
        const char *v = i + 1 < argc ? argv[i + 1] : "";

        if (strcmp(argv[i], "--busiest") == 0) {
            b->busiest = 1;
            continue;
        }
        if (strcmp(argv[i], "--set") == 0 && *n_set < CASE_MAX_SETS)
            sets[(*n_set)++] = v;
        else if (strcmp(argv[i], "--threads") == 0)
            *threads = atoi(v);
        else if (strcmp(argv[i], "--seconds") == 0)
            b->seconds = atof(v);
        else if (strcmp(argv[i], "--times") == 0)
            b->times = atoi(v);
        else
            return error_set(err, ERR_USAGE, "unknown option %s", argv[i]);
        i++;
    }
    if (argc < 2 || *threads < 1 || *threads > MOST_THREADS || b->times < 0)
        return error_set(
            err, ERR_USAGE,
            "usage: bench_assembly CASE [--set NAME=VALUE ...] [--threads N] [--seconds S | --times N]");
    return 0;
}

/* Values as in jacobian.c: around the state at the start, at random, where something is free. */
static void fill(const problem *p, double *x, unsigned long long *random)
{
    const space *s = &p->space;
    const uint8_t *idle = p->bodies.now ? p->bodies.now->idle : p->system.assembly.none_idle;

    for (int64_t i = 0; i < s->n_dof; i++)
        x[i] = p->state.x[i] + (idle[i] || s->fixed[i] ? 0 : 2 * random_next(random) - 1);
}

/* The state, its history, and where bodies were. */
static int prepare(bench *b, error *err)
{
    problem *p = &b->p;
    const time_spec *time = &p->description.time;
    unsigned long long random = RANDOM_SEED;
    int64_t n = p->space.n_dof;

    ARENA_NEW(&p->memory, b->x, n, err);
    ARENA_NEW(&p->memory, b->history, n, err);
    fill(p, b->x, &random);
    for (int l = 0; l < LEVELS; l++) {
        ARENA_NEW(&p->memory, b->level[l], n, err);
        ARENA_NEW(&p->memory, b->then[l], p->bodies.n + 1, err);
        fill(p, b->level[l], &random);
        for (int k = 0; k < p->bodies.n; k++) {
            b->then[l][k] = p->state.pose[k];
            b->then[l][k].x[1] += MOVED * (l + 1) * p->bodies.h_mean;
            b->then[l][k].way[1] += MOVED * (l + 1) * p->bodies.h_mean;
        }
    }
    b->time = (newton_time){.t = time->start, .dt = 1, .bodies = problem_points(p)};
    if (time->unsteady) {
        b->scheme = bdf_of(2, time->step, time->step);
        for (int64_t i = 0; i < n; i++)
            b->history[i] = b->scheme.c[0] * b->level[0][i] + b->scheme.c[1] * b->level[1][i];
        b->time.dt = time->step;
        b->time.shift = b->scheme.shift;
        b->time.history = b->history;
        b->time.old = b->level[0];
    }
    return 0;
}

/* The history of a new step: its values at the points are found by the next evaluation. */
static void place_paths(bench *b)
{
    if (b->p.bodies.n && b->time.history)
        b->time.frame = bodies_paths(&b->p.bodies, b->p.bodies.now, LEVELS, b->scheme.c,
                                     (const double *const[]){b->level[0], b->level[1]},
                                     (const pose *const[]){b->then[0], b->then[1]}, b->history);
}

/* What is measured stands in functions of their own, by whose names callgrind is switched on and off. */
__attribute__((noinline)) static int measured_jacobian(bench *b, error *err)
{
    return system_evaluate(&b->p.system, &b->time, b->x, 1, 0, err);
}

__attribute__((noinline)) static int measured_residual(bench *b, error *err)
{
    return system_evaluate(&b->p.system, &b->time, b->x, 0, 0, err);
}

/* A residual with history along new paths. */
__attribute__((noinline)) static int measured_history(bench *b, error *err)
{
    place_paths(b);
    return system_evaluate(&b->p.system, &b->time, b->x, 0, 0, err);
}

/* Clocks at one moment. */
typedef struct moment {
    double used, thread[MOST_THREADS];
} moment;

/* The threads of the team are those that the assembly has: the library keeps them. */
static void look(const bench *b, moment *m)
{
#pragma omp parallel num_threads(b->p.n_thread) if (b->busiest)
    m->thread[omp_get_thread_num()] = used_by_thread();
    m->used = used_seconds(b->p.n_thread);
}

static double between(const bench *b, const moment *from, const moment *to)
{
    double most = 0;

    for (int k = 0; b->busiest && k < b->p.n_thread; k++)
        most = fmax(most, to->thread[k] - from->thread[k]);
    return b->busiest ? most : to->used - from->used;
}

/* Best time of an evaluation. */
static int best_of(bench *b, const char *name, int (*evaluate)(bench *, error *), error *err)
{
    double least = INFINITY, begin = clock_seconds();
    moment start, end;

    for (int k = 0; b->times ? k < b->times : k < LEAST || clock_seconds() - begin < b->seconds; k++) {
        look(b, &start);
        TRY(evaluate(b, err));
        look(b, &end);
        least = fmin(least, between(b, &start, &end));
    }
    printf("%s %.9g s\n", name, least);
    return 0;
}

static int run(bench *b, const char *path, const char **sets, int n_set, int threads, error *err)
{
    problem *p = &b->p;

    TRY(case_load(&b->c, path, sets, n_set, NULL, err));
    TRY(registry_create(&b->r, NULL, 0, err));
    TRY(problem_create(p, &b->c, &b->r, threads, err));
    TRY(problem_initial(p, err));
    TRY(prepare(b, err));
    place_paths(b);
    TRY(system_evaluate(&p->system, &b->time, b->x, 0, 1, err)); /* what is done once */
    printf("cells %lld 1\nunknowns %lld 1\nmatrix_entries %lld 1\n", (long long)p->mesh.n_cell,
           (long long)p->space.n_dof, (long long)p->space.row[p->space.n_free]);
    TRY(best_of(b, "jacobian", measured_jacobian, err));
    TRY(best_of(b, "residual", measured_residual, err));
    if (b->time.frame)
        TRY(best_of(b, "history", measured_history, err));
    return p->bodies.n ? bodies_check(&p->bodies, err) : 0;
}

int main(int argc, char **argv)
{
    static bench b = {.seconds = 1};
    static error err;
    const char *sets[CASE_MAX_SETS];
    int n_set = 0, threads = 1, status = parse(argc, argv, &b, sets, &n_set, &threads, &err);

    if (!status)
        status = run(&b, argv[1], sets, n_set, threads, &err);
    problem_destroy(&b.p);
    case_destroy(&b.c);
    registry_destroy(&b.r);
    if (status)
        fprintf(stderr, "bench_assembly: %s\n", err.text);
    return status;
}
