/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A term on the bench: its arrays, between guarded zones. */
#include "term/bench.h"

#include "base/random.h"

#include <stdio.h>
#include <string.h>

static void *numbers(bench *k, const char *kind, const char *name, int rows, size_t unit, int fixed)
{
    return guard_new(&k->guard, kind, name, (size_t)rows * BENCH_LD, unit, BENCH_LD, fixed);
}

static int create_slots(bench *k)
{
    const pf_term *t = k->t;

    for (uint32_t i = 0; i < t->n_in; i++) {
        const int rows = bench_components(k, &t->in[i]);

        k->in[i] = numbers(k, "input", t->in[i].name, rows, sizeof(double), 1);
        k->z[i] = numbers(k, "input", t->in[i].name, rows, sizeof(pf_complex), 1);
        if (!k->in[i] || !k->z[i])
            return 0;
    }
    for (uint32_t o = 0; o < t->n_out; o++) {
        const int rows = bench_components(k, &t->out[o]);

        k->out[o] = numbers(k, "output", t->out[o].name, rows, sizeof(double), 0);
        k->again[o] = numbers(k, "output", t->out[o].name, rows, sizeof(double), 0);
        k->w[o] = numbers(k, "output", t->out[o].name, rows, sizeof(pf_complex), 0);
        if (!k->out[o] || !k->again[o] || !k->w[o])
            return 0;
    }
    return 1;
}

/* Two Jacobians, one to be compared with the other. */
static int create_blocks(bench *k)
{
    const pf_term *t = k->t;

    for (uint32_t o = 0; o < t->n_out; o++)
        for (uint32_t i = 0; i < t->n_in; i++) {
            const int rows = bench_components(k, &t->out[o]) * bench_components(k, &t->in[i]);
            char name[200], *kept;

            snprintf(name, sizeof name, "d %.90s / d %.90s", t->out[o].name, t->in[i].name);
            kept = arena_strdup(&k->memory, name);
            k->jac[o * t->n_in + i] = numbers(k, "Jacobian block", kept, rows, sizeof(double), 0);
            k->truth[o * t->n_in + i] = numbers(k, "Jacobian block", kept, rows, sizeof(double), 0);
            if (!kept || !k->jac[o * t->n_in + i] || !k->truth[o * t->n_in + i])
                return 0;
        }
    return 1;
}

int bench_create(bench *k, selftest *s, const term_plugin *p, const pf_term *t, int dim, error *err)
{
    *k = (bench){.s = s,
                 .p = p,
                 .t = t,
                 .dim = dim,
                 .report = {.plugin = p->d.name, .term = t->name},
                 .random = RANDOM_SEED};
    k->guard.memory = &k->memory;
    k->params = guard_new(&k->guard, "the parameters", NULL, t->params_bytes, 1, 0, 1);
    k->scratch = guard_new(&k->guard, "the scratch memory", NULL, t->scratch_bytes, 1, 0, 0);
    k->other_params = arena_alloc(&k->memory, t->params_bytes + 1, 1);
    k->room = arena_alloc(&k->memory, term_jacobian_room(t, dim, BENCH_LD) + 64, 1);
    if (!k->params || !k->other_params || !k->room || !k->scratch || !create_slots(k) || !create_blocks(k))
        return error_memory(err, "test of a term", 0);
    surroundings_take(&k->surroundings);
    TRY(bench_points(k, err));
    bench_params(k, 0);
    bench_random_inputs(k);
    return 0;
}

void bench_destroy(bench *k)
{
    bench_done(k);
    surroundings_release(&k->surroundings);
    arena_free(&k->memory);
}
