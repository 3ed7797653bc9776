/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * used.h -- seconds that a measurement takes. */
#ifndef BENCH_USED_H
#define BENCH_USED_H

#include <time.h>

static inline double used_clock(clockid_t clock)
{
    struct timespec t;

    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Of one thread those of the processor, which does not count while it works for others; of several those that
 * pass. */
static inline double used_seconds(int threads)
{
    return used_clock(threads == 1 ? CLOCK_PROCESS_CPUTIME_ID : CLOCK_MONOTONIC);
}

/* Of the processor, by the thread that asks. */
static inline double used_by_thread(void)
{
    return used_clock(CLOCK_THREAD_CPUTIME_ID);
}

#endif
