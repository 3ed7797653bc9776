/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A solver is created, and given its parameters once. */
#include "solve/instance.h"

int solver_instance(const pf_solver *s, const void *params, int n_thread, void **self, char *why, size_t n)
{
    const int knows = s->size >= offsetof(pf_solver, configure) + sizeof s->configure;
    int status = s->create(self, n_thread, why, n);

    return !status && params && knows && s->configure ? s->configure(*self, params, why, n) : status;
}
