/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Tests that follow from a term's own description, in 2D and in 3D. */
#include "term/selftest_parts.h"

#include <string.h>

static int test_term(selftest *s, const term_plugin *p, const pf_term *t, error *err)
{
    for (int dim = 2; dim <= 3; dim++) {
        bench k;
        int status = bench_create(&k, s, p, t, dim, err);

        if (!status && bench_start(&k) && selftest_values(&k))
            selftest_jacobian(&k);
        for (uint32_t e = 0; e < t->n_example && !status; e++)
            if ((int)t->example[e].dim == dim)
                selftest_example(&k, &t->example[e]);
        bench_end(&k);
        arena_free(&k.memory);
        TRY(status);
    }
    return 0;
}

int selftest_run(selftest *s, const term_plugin *p, const char *only, error *err)
{
    int found = 0;

    for (uint32_t i = 0; i < p->d.n_term; i++)
        if (!only || strcmp(p->term[i].name, only) == 0) {
            found = 1;
            TRY(test_term(s, p, &p->term[i], err));
        }
    return found ? 0 : error_set(err, ERR_USAGE, "plugin \"%s\" has no term \"%s\"", p->d.name, only);
}
