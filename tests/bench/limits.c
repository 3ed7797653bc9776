/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What the machine can do at most: bytes to and from memory (triad of McCalpin's STREAM, whose count leaves out
 * that a line is read before it is written), and operations by fused multiply-add.
 *
 *     bench_limits THREADS     prints lines "name value unit" */
#include "used.h"

#include <omp.h>
#include <stdio.h>
#include <stdlib.h>

typedef double v8 __attribute__((vector_size(64)));

enum { N = 1 << 24, TIMES = 8, CHAINS = 16, ROUNDS = 2000000 };

/* Bytes a second; 0: no memory. */
static double triad(int threads)
{
    double *a = malloc(N * sizeof *a), *b = malloc(N * sizeof *b), *c = malloc(N * sizeof *c), best = 1e300;

    for (int k = 0; a && b && c && k < TIMES + 1; k++) {
        double start = used_seconds(threads), taken;

#pragma omp parallel for num_threads(threads) schedule(static)
        for (long i = 0; i < N; i++) {
            if (k == 0) { /* pages go to the thread that will use them */
                b[i] = 1;
                c[i] = 2;
            }
            a[i] = b[i] + 3 * c[i];
        }
        taken = used_seconds(threads) - start;
        if (k > 0 && taken < best)
            best = taken;
    }
    if (a && a[N / 2] != 7)
        best = 1e300;
    free(a);
    free(b);
    free(c);
    return best < 1e300 ? 3.0 * N * sizeof(double) / best : 0;
}

/* Independent chains, so many that the latency of one does not show; CHAINS v8 are as many registers. */
static double chains(double start)
{
    v8 x[CHAINS], factor, sum = {0};

    for (int l = 0; l < 8; l++)
        factor[l] = 1 - 1e-9 * start;
    for (int c = 0; c < CHAINS; c++)
        x[c] = factor * (double)c;
    for (long k = 0; k < ROUNDS; k++)
#pragma GCC unroll 16
        for (int c = 0; c < CHAINS; c++)
            x[c] = x[c] * factor + factor;
    for (int c = 0; c < CHAINS; c++)
        sum += x[c];
    return sum[0] + sum[7];
}

/* Operations a second. */
static double operations(int threads)
{
    double best = 1e300;

    for (int k = 0; k < TIMES; k++) {
        double start = used_seconds(threads), sum = 0, taken;

#pragma omp parallel num_threads(threads) reduction(+ : sum)
        sum += chains(1 + omp_get_thread_num());
        taken = used_seconds(threads) - start;
        if (sum > 0 && taken < best)
            best = taken;
    }
    return 2.0 * 8 * CHAINS * ROUNDS * threads / best;
}

int main(int argc, char **argv)
{
    int threads = argc == 2 ? atoi(argv[1]) : 0;

    if (threads < 1) {
        fprintf(stderr, "usage: bench_limits THREADS\n");
        return 2;
    }
    printf("stream_bytes_per_second %.6g B/s\nflops_per_second %.6g 1/s\n", triad(threads), operations(threads));
    return 0;
}
