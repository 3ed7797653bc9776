/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * state.h -- everything that a time step changes, in one place.
 *
 * A step is tried on a copy: to repeat it is to drop the copy.  Members stand in one table (state.c), which copying
 * goes by: a new one has to be entered there. */
#ifndef STATE_STATE_H
#define STATE_STATE_H

#include "base/arena.h"
#include "base/error.h"
#include "particle/particle.h"

#include <stdint.h>

typedef struct state {
    double t, dt_previous;    /* now, and the length of the last step, s                         */
    int64_t n_history;        /* steps behind that a scheme may look back to                    */
    int64_t n_dof, n_body;    /* sizes */
    double *x, *before;       /* [n_dof] unknowns now and a step ago                             */
    pose *pose, *pose_before; /* [n_body] of the bodies now and a step ago                       */
    int64_t steps, halved;    /* steps of the scheme so far; how often one was repeated in halves */
    int64_t shortened;        /* steps that would have carried a body too far */
    int64_t newton_iterations;
    double written; /* time of the last file of fields, s */
    arena memory;
} state;

int state_create(state *s, int64_t n_dof, int64_t n_body, error *err);
/* Both of the same sizes. */
void state_copy(state *to, const state *from);
/* Exchanges two states of the same sizes. */
void state_swap(state *a, state *b);
void state_destroy(state *s);

#endif
