/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * step_measure.h -- how large the error of a time step is.
 *
 * BDF2 makes an error of 0.22 (dt/T)^3 a step in a flow that changes within T; those of T/dt steps add up.  So a
 * step is allowed tolerance^(3/2): the sum is then about the tolerance.  The velocity of a body that moves forgets
 * its errors, as the balance of its forces draws it back: there a step is allowed the tolerance itself. */
#ifndef SOLVE_STEP_MEASURE_H
#define SOLVE_STEP_MEASURE_H

#include "body/body.h"
#include "state/state.h"

/* What errors are measured with. */
typedef struct step_measure {
    const space *space;
    const bodies *bodies;
    int moves, free;     /* some body does; by itself */
    uint32_t rated;      /* bit f: some term has du/dt of field f */
    const int *vanishes; /* [n_field] the field is zero but for round-off: it does not count */
    double *weight;      /* [n_carrier] size of the cells at a node of the mesh */
    uint8_t *cut;        /* [n_carrier] 1: a body may cut a cell at the node    */
    int stamp;           /* of the placement that this is of                    */
} step_measure;

typedef struct step_error {
    double error; /* over what is allowed                 */
    double whole; /* Milne's, over the size of the fields */
} step_error;

int measure_create(step_measure *m, const bodies *b, const int *vanishes, arena *memory, error *err);
/* Finds the nodes near bodies, as they are placed now. */
void measure_place(step_measure *m);
/* Largest difference x - from [n_dof] of a field with du/dt, over its size.  A field of the mesh is measured by its
 * mean square over the nodes that are not off (idle, or NULL), one of bodies, in units of velocity, by its largest
 * value.  size: of each field now, at least what it was; least (or NULL): what it is taken for at least; a
 * difference of bodies counts for 1/rough of itself; motion (or NULL): largest size of a velocity. */
double measure_relative(const step_measure *m, const double *x, const double *from, const double *least,
                        const uint8_t *idle, double rough, double *size, double *motion);
/* Error of a step of BDF2 of length dt from a state with two steps behind it to x. */
step_error measure_step(const step_measure *m, const state *now, double tolerance, double dt, const double *x,
                        const double *predicted, const uint8_t *idle, double *size);
/* Of one of the first two steps: x - from is of second order. */
step_error measure_first(const step_measure *m, const state *now, double tolerance, double dt, const double *x,
                         const double *from, const uint8_t *idle, double *size);
/* Free velocities and spins of body k: v [6]. */
void measure_motion(const step_measure *m, int k, const double *x, double *v);
/* The bodies' motion at the end of a step goes to what is remembered of it. */
void measure_remember(const step_measure *m, state *now);

#endif
