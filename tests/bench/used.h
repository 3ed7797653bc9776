/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * used.h -- seconds that a measurement takes. */
#ifndef BENCH_USED_H
#define BENCH_USED_H

#include <time.h>

/* Of one thread those of the processor, which does not count while it works for others; of several those that
 * pass. */
static inline double used_seconds(int threads)
{
    struct timespec t;

    clock_gettime(threads == 1 ? CLOCK_PROCESS_CPUTIME_ID : CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

#endif
