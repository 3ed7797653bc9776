/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The solver plugin leaves the process as it was: signals, which METIS takes while it runs, and the threads of
 * BLAS. */
#include "term/term.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <dlfcn.h>
#include <math.h>
#include <pthread.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { SIDE = 200, N = SIDE * SIDE };

static const pf_solver *solver;
static pf_csr grid;
/* Never called: the signal is blocked, as in the program. */
static void handler(int number)
{
    (void)number;
}

/* The five-point stencil of a square grid. */
static pf_csr five_points(void)
{
    int64_t *row = malloc((N + 1) * sizeof *row), *col = malloc(5 * N * sizeof *col),
            *node = malloc((N + 1) * sizeof *node);
    double *value = malloc(5 * N * sizeof *value);
    int64_t k = 0;

    assert_true(row && col && node && value);
    for (int64_t r = 0; r < N; r++) {
        const int64_t i = r % SIDE, j = r / SIDE;
        const int64_t to[] = {r - SIDE, r - 1, r, r + 1, r + SIDE};
        const int there[] = {j > 0, i > 0, 1, i < SIDE - 1, j < SIDE - 1};

        row[r] = k;
        node[r] = r;
        for (int e = 0; e < 5; e++)
            if (there[e]) {
                col[k] = to[e];
                value[k++] = e == 2 ? 4.5 : -1;
            }
    }
    row[N] = k;
    node[N] = N;
    return (pf_csr){.n = N, .row = row, .col = col, .value = value, .n_node = N, .node = node};
}

static int set_up(void **state)
{
    static registry r;
    sigset_t term;
    error err;

    (void)state;
    sigemptyset(&term);
    sigaddset(&term, SIGTERM);
    pthread_sigmask(SIG_BLOCK, &term, NULL); /* before BLAS has threads, which inherit it */
    if (registry_create(&r, NULL, 0, &err) || registry_solver(&r, "solver_umfpack", &solver, &err)) {
        print_error("%s\n", err.text);
        return -1;
    }
    grid = five_points();
    return 0;
}

static pf_solver_cost analyze(void **self)
{
    pf_solver_cost cost;
    char why[400] = "";

    assert_int_equal(solver->create(self, 2, why, sizeof why), PF_SOLVER_OK);
    if (solver->analyze(*self, &grid, &cost, why, sizeof why) != PF_SOLVER_OK)
        fail_msg("analysis: %s", why);
    return cost;
}

/* Sends SIGTERM after so much processor time, when METIS, which takes most of the analysis, is at work. */
static timer_t alarm_after(double seconds)
{
    struct sigevent event = {.sigev_notify = SIGEV_SIGNAL, .sigev_signo = SIGTERM};
    struct itimerspec when = {.it_value = {.tv_nsec = (long)(1e9 * seconds)}};
    timer_t timer;

    assert_int_equal(timer_create(CLOCK_PROCESS_CPUTIME_ID, &event, &timer), 0);
    assert_int_equal(timer_settime(timer, 0, &when, NULL), 0);
    return timer;
}

static double processor_seconds(void)
{
    struct timespec t;

    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Handlers with flags that signal() does not give. */
static void install(void)
{
    struct sigaction mine = {.sa_handler = handler, .sa_flags = SA_RESTART | SA_ONSTACK};

    assert_int_equal(sigaction(SIGTERM, &mine, NULL), 0);
    assert_int_equal(sigaction(SIGABRT, &mine, NULL), 0);
}

static void assert_installed(void)
{
    static const int number[] = {SIGTERM, SIGABRT};
    struct sigaction now;

    for (int k = 0; k < 2; k++) {
        sigaction(number[k], NULL, &now);
        assert_true(now.sa_handler == handler);
        assert_int_equal(now.sa_flags & (SA_RESTART | SA_ONSTACK | (int)SA_RESETHAND | SA_NODEFER),
                         SA_RESTART | SA_ONSTACK);
    }
}

static void handlers_of_signals_are_as_before_after_the_analysis(void **state)
{
    void *self;

    (void)state;
    install();
    analyze(&self);
    solver->destroy(self);
    assert_installed();
}

static void signal_during_the_analysis_is_still_there_after_it_and_the_order_is_the_same(void **state)
{
    double start = processor_seconds(), seconds;
    pf_solver_cost undisturbed, disturbed;
    sigset_t term;
    void *self;

    (void)state;
    undisturbed = analyze(&self);
    solver->destroy(self);
    seconds = processor_seconds() - start;
    sigemptyset(&term);
    sigaddset(&term, SIGTERM);
    install();
    for (int part = 1; part <= 3; part++) { /* METIS has the first half of the time at least */
        timer_t timer = alarm_after(seconds * part / 7);

        disturbed = analyze(&self);
        solver->destroy(self);
        assert_true(disturbed.fill == undisturbed.fill);
        assert_installed();
        assert_int_equal(sigtimedwait(&term, NULL, &(struct timespec){0}), SIGTERM);
        timer_delete(timer); /* after: it may take its signal along */
    }
}

static void threads_of_blas_are_as_before_after_every_call(void **state)
{
    void *blas = dlopen("libopenblas.so.0", RTLD_NOW | RTLD_NOLOAD), *self;
    int (*get)(void);
    void (*set)(int);
    void *get_symbol = blas ? dlsym(blas, "openblas_get_num_threads") : NULL;
    void *set_symbol = blas ? dlsym(blas, "openblas_set_num_threads") : NULL;
    double *b = calloc(2 * N, sizeof *b), *x = b + N, worst = 0;
    char why[400] = "";

    (void)state;
    if (!get_symbol || !set_symbol)
        skip(); /* another BLAS */
    memcpy(&get, &get_symbol, sizeof get);
    memcpy(&set, &set_symbol, sizeof set);
    set(2);
    assert_int_equal(get(), 2);
    analyze(&self);
    assert_int_equal(get(), 2);
    assert_int_equal(solver->setup(self, &grid, why, sizeof why), PF_SOLVER_OK);
    assert_int_equal(get(), 2);
    b[N / 2 + SIDE / 2] = 1;
    assert_int_equal(solver->solve(self, b, x, why, sizeof why), PF_SOLVER_OK);
    assert_int_equal(get(), 2);
    solver->destroy(self);
    for (int64_t r = 0; r < N; r++) {
        double ax = 0;

        for (int64_t k = grid.row[r]; k < grid.row[r + 1]; k++)
            ax += grid.value[k] * x[grid.col[k]];
        worst = fmax(worst, fabs(ax - b[r]));
    }
    assert_true(worst < 1e-13);
    free(b);
}

/* Every entry of a matrix becomes a block of so many rows and columns: as many unknowns at each node. */
static pf_csr with_blocks(const pf_csr *a, int block)
{
    int64_t *row = malloc((size_t)(block * a->n + 1) * sizeof *row),
            *node = malloc((size_t)(a->n + 1) * sizeof *node);
    int64_t *col = malloc((size_t)(block * block * a->row[a->n]) * sizeof *col), k = 0;

    assert_true(row && col && node);
    for (int64_t v = 0; v < a->n; v++) {
        node[v] = block * v;
        for (int i = 0; i < block; i++) {
            row[block * v + i] = k;
            for (int64_t e = a->row[v]; e < a->row[v + 1]; e++)
                for (int j = 0; j < block; j++)
                    col[k++] = block * a->col[e] + j;
        }
    }
    row[block * a->n] = k;
    node[a->n] = block * a->n;
    return (pf_csr){.n = block * a->n, .row = row, .col = col, .n_node = a->n, .node = node};
}

/* Nodes are eliminated whole: their blocks fill as single entries do. */
static void unknowns_of_a_node_are_ordered_as_one(void **state)
{
    pf_csr single = grid;
    double fill = 0;

    (void)state;
    for (int block = 1; block <= 4; block++) {
        pf_solver_cost cost;
        void *self;

        grid = with_blocks(&single, block);
        cost = analyze(&self);
        solver->destroy(self);
        if (block == 1)
            fill = cost.fill;
        if (!(fabs(cost.fill / (block * block * fill) - 1) < 0.03))
            fail_msg("%g entries, with %d unknowns at each node %g", fill, block, cost.fill);
        free((void *)grid.row);
        free((void *)grid.col);
        free((void *)grid.node);
    }
    grid = single;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(handlers_of_signals_are_as_before_after_the_analysis),
        cmocka_unit_test(signal_during_the_analysis_is_still_there_after_it_and_the_order_is_the_same),
        cmocka_unit_test(unknowns_of_a_node_are_ordered_as_one),
        cmocka_unit_test(threads_of_blas_are_as_before_after_every_call),
    };

    return cmocka_run_group_tests(tests, set_up, NULL);
}
