/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Tests that follow from a term's own description, in 2D and in 3D. */
#include "term/selftest_parts.h"

#include <stdlib.h>
#include <string.h>

static int has_dim(const pf_term *t, int dim)
{
    return !(t->flags & (dim == 2 ? PF_ONLY_3D : PF_ONLY_2D));
}

/* With one draw of the parameters. */
static void test_draw(bench *k)
{
    const int before = k->s->failed;

    if (bench_init(k) && selftest_values(k)) {
        selftest_jacobian(k);
        if (k->s->failed == before)
            selftest_states(k);
        if (k->s->failed == before)
            selftest_keys(k);
    }
    bench_done(k);
}

/* The defaults, and told line by line; then other parameters, of which only what is wrong is told. */
static void test_draws(bench *k)
{
    const int before = k->s->failed, n = bench_draws(k);
    int drawn = 0;

    test_draw(k);
    for (int draw = 1; draw < n && k->s->failed == before; draw++) {
        if (!bench_params(k, draw))
            continue;
        drawn++;
        k->quiet = 1;
        bench_random_inputs(k);
        test_draw(k);
        k->quiet = 0;
    }
    if (k->s->failed == before && n > 1)
        bench_line(k, 1, "%s  the same in %dD with %d random draws of its parameters%s", k->t->name, k->dim, drawn,
                   drawn ? "" : ": its check refuses all that were tried");
    bench_params(k, 0);
}

static int test_term(selftest *s, const term_plugin *p, const pf_term *t, uint32_t *live, error *err)
{
    const int before = s->failed;

    *live = 0;
    for (int dim = 2; dim <= 3; dim++) {
        bench *k;
        int status;

        if (!has_dim(t, dim))
            continue;
        if (!(k = malloc(sizeof *k)))
            return error_memory(err, "test of a term", sizeof *k);
        status = bench_create(k, s, p, t, dim, err);
        k->live = *live;
        if (!status)
            test_draws(k);
        *live = k->live;
        if (!status && s->failed == before && !(dim == 2 && has_dim(t, 3)))
            selftest_takes(k);
        for (uint32_t e = 0; e < t->n_example && !status; e++)
            if ((int)t->example[e].dim == dim)
                selftest_example(k, &t->example[e]);
        bench_destroy(k);
        free(k);
        TRY(status);
    }
    return 0;
}

int selftest_run(selftest *s, const term_plugin *p, const char *only, error *err)
{
    const int before = s->failed;
    uint32_t *live = calloc(p->d.n_term + 1, sizeof *live);
    int found = 0, status = 0;

    if (!live)
        return error_memory(err, "test of a term", 0);
    for (uint32_t i = 0; i < p->d.n_term && !status; i++) {
        live[i] = UINT32_MAX; /* of terms that are not tested nothing is said */
        if (!only || strcmp(p->term[i].name, only) == 0) {
            found = 1;
            status = test_term(s, p, &p->term[i], &live[i], err);
        }
    }
    if (!status && s->failed == before)
        selftest_dead_keys(s, p, live);
    free(live);
    return status  ? status
           : found ? 0
                   : error_set(err, ERR_USAGE, "plugin \"%s\" has no term \"%s\"", p->d.name, only);
}
