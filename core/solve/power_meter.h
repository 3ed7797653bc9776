/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * power_meter.h -- the power of every term at the ends of steps, and its integral over the steps that were
 * accepted.
 *
 * At the solution of a step the rows of all terms of a velocity vanish but where it is prescribed; each times its
 * own unknown, and added up,
 *
 *     sum over terms of their power = sum over prescribed unknowns of reaction times value,
 *
 * to what Newton's method leaves of the residual. */
#ifndef SOLVE_POWER_METER_H
#define SOLVE_POWER_METER_H

#include "solve/solve.h"

/* Of a reading, beside what each term has: */
enum {
    METER_PRESCRIBED, /* power of what holds prescribed unknowns: reaction times value         */
    METER_CARRIED, /* 1/2 |u|^2 u . n over the boundary of the mesh: kinetic energy that flows out, of density 1 */
    METER_SWEPT,   /* the same over surfaces of bodies that cut through cells, as they move */
    METERS
};
_Static_assert((int)METERS <= (int)POWERS, "one more row in a reading");

typedef struct power_meter {
    const space *space;
    int n_use;
    assembly_power now; /* of the last step that was solved; with the row n_use for the meters */
    double (*last)[POWERS], (*held)[POWERS], (*work)[POWERS]; /* of the step before; integrals [n_use + 1] */
    int has_last, holds;
    arena memory;
} power_meter;

/* Of the velocities among the fields: vectors of the mesh whose reaction is a force, and what moves bodies. */
int power_meter_create(power_meter *m, const assembly *a, error *err);
void power_meter_destroy(power_meter *m);
/* What of it the assembly fills; NULL if there is no meter. */
assembly_power *power_meter_ask(power_meter *m);
/* The rest of a reading, at the solution x with these reactions [n_dof] and these bodies (NULL: none). */
int power_meter_read(power_meter *m, const double *x, const double *reaction, const body_points *bodies,
                     error *err);

/* A step of length dt is accepted: work += the integral of the reading over it.  By backward Euler (order 1) the
 * value at its end counts, so that what the scheme loses is a sum of squares; by BDF2 the mean of that and the one
 * before. A first step that is made of two keeps them apart: what was held, and half a step of the reading. */
void power_meter_accept(power_meter *m, int order, double dt);
/* The first of two halves, of length dt; forgets one that was held before. */
void power_meter_hold(power_meter *m, double dt);
void power_meter_drop(power_meter *m);

#endif
