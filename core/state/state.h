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

#include "space/space.h"

#include <stdint.h>

enum { STATE_PAST = 9 };

/* Velocity and spin of a body at the last instants, latest first. */
typedef struct body_past {
    double motion[STATE_PAST][6];
} body_past;

/* Force and torque of the fluid on a body at the end of the last step (2D: 4th and on: one torque); 0 at the start.
 */
typedef struct body_fluid {
    double force[6];
} body_fluid;

/* What is remembered of the errors of steps, each over what is allowed; see solve/step_control.h. */
typedef struct step_control {
    double next;                    /* length of the next step, s */
    double before;                  /* error of the last step                       */
    double floor;                   /* error that no shorter step makes smaller     */
    int64_t careful;                /* so many steps may grow by little only */
    int64_t jumped;                 /* the last step held a jump: what is behind it foretells nothing */
    double usual;                   /* length of the longest of the last steps, s   */
    double scale[SPACE_MAX_FIELDS]; /* largest size of each field so far */
    int64_t n_past;
    double past[STATE_PAST]; /* instants that bodies' motion is remembered of, latest first, s */
} step_control;

typedef struct step_counts {
    int64_t steps;     /* of the scheme so far */
    int64_t halved;    /* repeated shorter because Newton did not converge                        */
    int64_t shortened; /* repeated shorter because they would have carried a body too far         */
    int64_t repeated;  /* repeated shorter because of their error                                 */
    int64_t rough;     /* accepted with too large an error, as shorter ones had the same          */
    int64_t restarted; /* at jumps, where the scheme started anew                                 */
    int64_t newton_iterations;
} step_counts;

typedef struct state {
    double t, dt_previous, dt_before;        /* now, and the lengths of the last step and of that before it, s */
    int64_t n_history;                       /* steps behind that a scheme may look back to                    */
    int64_t n_dof, n_body, n_kept;           /* sizes */
    double *x, *before, *before2;            /* [n_dof] unknowns now, a step ago and two                        */
    double *kept;                            /* [n_kept] memory of terms, see space/kept.h                      */
    pose *pose, *pose_before, *pose_before2; /* [n_body] of the bodies */
    step_counts count;
    step_control control; /* of steps that choose their length */
    body_past *past;      /* [n_body] */
    body_fluid *fluid;    /* [n_body] */
    double written;       /* time of the last file of fields, s */
    arena memory;
} state;

int state_create(state *s, int64_t n_dof, int64_t n_body, int64_t n_kept, error *err);
/* Both of the same sizes. */
void state_copy(state *to, const state *from);
/* Exchanges two states of the same sizes. */
void state_swap(state *a, state *b);
void state_destroy(state *s);

#endif
