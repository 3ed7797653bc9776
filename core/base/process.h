/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * process.h -- what those need who take signals: the only mutable global object of the program.
 *
 * A handler is called with the number of the signal and nothing else, so what it needs must lie at a known
 * place.  Everything else has an owner and is passed along. */
#ifndef BASE_PROCESS_H
#define BASE_PROCESS_H

#include <omp.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdint.h>

enum { PROCESS_MAX_THREADS = 1024 };

/* Which plugin a thread is in.  The strings are the plugin's own or literals: plugins are never unloaded. */
typedef struct breadcrumb {
    const char *plugin, *term, *phase; /* plugin NULL: in none                        */
    int64_t cell;                      /* first cell of the batch; -1: there is none  */
} breadcrumb;

struct process_state {
    /* Number of the signal that wants the run to end, 0: none.  Written by whoever takes SIGINT, SIGTERM and SIGHUP
     * (a thread of its own, core/cli/signals.c; machines write an int in one piece), read between steps and
     * iterations. */
    volatile sig_atomic_t stop;
    /* 1: a run has begun to write its files, and ends after a step when it is stopped.  Written by the run. */
    volatile sig_atomic_t running;
    /* What is said when the reading of a case does not come back.  Written before the alarm is set. */
    char watchdog[600];
    /* The crash handler runs on it, so that it can tell of a stack that is full. */
    _Alignas(16) char crash_stack[1 << 16];
    /* By OpenMP's thread number.  A thread writes its own only, each has a cache line of its own. */
    struct {
        _Alignas(64) breadcrumb now;
    } thread[PROCESS_MAX_THREADS];
};
extern struct process_state process;

/* The breadcrumb of this thread.  Safe in a handler of a crash: that runs in the thread which crashed, which wrote
 * the breadcrumb itself, before the call into the plugin.  omp_get_thread_num() takes no lock and no memory: it
 * reads a variable that libgomp has in the static part of thread-local storage (a _Thread_local of this library
 * would be in the dynamic part, which may be allocated at the first access).  Threads of others (BLAS) have
 * number 0; they compute while thread 0 is in no plugin of equations.  Beyond PROCESS_MAX_THREADS nothing is kept.
 */
static inline breadcrumb *process_own(void)
{
    int i = omp_get_thread_num();

    return i < PROCESS_MAX_THREADS ? &process.thread[i].now : NULL;
}

/* This thread goes into a plugin: which term, what of it ("residual"), the first cell of the batch or -1. */
static inline void process_enter(const char *plugin, const char *term, const char *phase, int64_t cell)
{
    breadcrumb *b = process_own();

    if (b)
        *b = (breadcrumb){plugin, term, phase, cell};
    atomic_signal_fence(memory_order_seq_cst); /* written before whatever comes next */
}

/* It is out again. */
static inline void process_leave(void)
{
    atomic_signal_fence(memory_order_seq_cst);
    process_enter(NULL, NULL, NULL, -1);
}

/* For the handler of a crash: what this thread is in. */
static inline breadcrumb process_now(void)
{
    const breadcrumb *b = process_own();

    return b ? *b : (breadcrumb){.cell = -1};
}

#endif
