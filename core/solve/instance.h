/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * instance.h -- an instance of a linear solver, with what the case says of it. */
#ifndef SOLVE_INSTANCE_H
#define SOLVE_INSTANCE_H

#include <plugflow/solver.h>

/* An enum pf_solver_status, and why; params NULL: the case says nothing, or the solver has no parameters. */
int solver_instance(const pf_solver *s, const void *params, int n_thread, void **self, char *why, size_t n);

#endif
