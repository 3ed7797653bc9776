/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Tests of a term in the conditions of a case: points, values and parameters are those of a batch that the assembly
 * was about to compute. */
#include "term/selftest_parts.h"

#include <stdlib.h>
#include <string.h>

/* Members of pf_batch that are numbers of points. */
static const size_t members[] = {
    offsetof(pf_batch, x),
    offsetof(pf_batch, arm),
    offsetof(pf_batch, normal),
    offsetof(pf_batch, h),
    offsetof(pf_batch, density),
    offsetof(pf_batch, gap),
    offsetof(pf_batch, size_of),
    offsetof(pf_batch, other_size),
    offsetof(pf_batch, other_density),
    offsetof(pf_batch, metric),
    offsetof(pf_batch, centre),
    offsetof(pf_batch, axes),
    offsetof(pf_batch, volume),
    offsetof(pf_batch, mass),
    offsetof(pf_batch, inertia),
    offsetof(pf_batch, fluid_force),
    offsetof(pf_batch, fluid_torque),
    offsetof(pf_batch, other_centre),
    offsetof(pf_batch, other_axes),
    offsetof(pf_batch, other_arm),
    offsetof(pf_batch, curvature),
    offsetof(pf_batch, wall_distance),
};

/* The points of the bench are spread over those of the batch. */
static uint32_t lane_of(const pf_batch *b, int l)
{
    return b->ld > BENCH_N ? (uint32_t)l * b->ld / BENCH_N : (uint32_t)l % b->ld;
}

static void copy_rows(const pf_batch *b, const double *from, int rows, double *to)
{
    for (int r = 0; r < rows; r++) {
        for (int l = 0; l < BENCH_N; l++)
            to[r * BENCH_LD + l] = from[(uint32_t)r * b->ld + lane_of(b, l)];
        bench_repeat(to + r * BENCH_LD);
    }
}

static void copy_ids(const pf_batch *b, const int32_t *from, int32_t *to)
{
    for (int l = 0; from && l < BENCH_LD; l++)
        to[l] = from[lane_of(b, l % BENCH_N)];
}

void bench_capture(bench *k, const pf_batch *b, const double *const *in, const void *params)
{
    k->captured = 1;
    if (params)
        memcpy(k->params, params, k->t->params_bytes);
    k->b.t = b->t, k->b.dt = b->dt, k->b.shift = b->shift;
    for (size_t m = 0; m < sizeof members / sizeof *members; m++) {
        const double *from, *to;

        memcpy(&from, (const char *)b + members[m], sizeof from);
        memcpy(&to, (const char *)&k->b + members[m], sizeof to);
        for (int i = 0; from && to && i < k->n_point; i++)
            if (k->point[i] == to)
                copy_rows(b, from, k->rows[i], k->point[i]);
    }
    copy_ids(b, b->id, k->id);
    copy_ids(b, b->other_id, k->other_id);
    for (uint32_t i = 0; i < k->t->n_in; i++)
        copy_rows(b, in[i], bench_components(k, &k->t->in[i]), k->in[i]);
}

int selftest_batch(selftest *s, const term_use *use, const pf_batch *b, const double *const *in, int *some,
                   error *err)
{
    bench *k = malloc(sizeof *k);
    int status, sound;

    if (!k)
        return error_memory(err, "test of a term", sizeof *k);
    status = bench_create(k, s, use->plugin, use->term, (int)b->dim, err);
    if (!status) {
        bench_capture(k, b, in, use->params);
        k->quiet = 1;
        *some = bench_status(k, k->out, "residual on values of the case", &sound) != PF_RETRY;
        if (*some && sound && selftest_values(k))
            selftest_jacobian(k);
    }
    bench_destroy(k);
    free(k);
    return status;
}
