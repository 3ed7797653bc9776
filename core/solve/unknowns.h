/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * unknowns.h -- the rows of the matrix as a solver plugin sees them (pf_unknowns of solver.h). */
#ifndef SOLVE_UNKNOWNS_H
#define SOLVE_UNKNOWNS_H

#include "base/arena.h"
#include "space/space.h"

#include <plugflow/solver.h>

typedef struct unknowns {
    pf_unknowns view;
    uint8_t *idle;                          /* [n] */
    const double *weight[SPACE_MAX_FIELDS]; /* [n], of free fields; else NULL */
    double *weight_room[SPACE_MAX_FIELDS];  /* the same memory, once a field was free */
    double weight_sum[SPACE_MAX_FIELDS];
} unknowns;

/* All that is fixed, in the arena. */
int unknowns_create(unknowns *u, arena *memory, const space *s, error *err);
/* What belongs to the values: idle [n_dof], and which fields have a free constant, with the integral of each basis
 * function [n_dof] where they have. */
int unknowns_update(unknowns *u, arena *memory, const space *s, const uint8_t *idle, const int *free_fields,
                    const double *const *integral, error *err);
/* Takes out of a right-hand side [n] what equations of free fields cannot meet; takes off a solution what makes one
 * value of each of them, pin [n_field], zero.  That value is the one that a factorisation holds, and not the mean:
 * near bodies a constant is free only nearly, and a mean that jumps as cells come to take part drives a flow. */
void unknowns_project(const unknowns *u, const space *s, double *rows);
void unknowns_level(const unknowns *u, const space *s, const int64_t *pin, double *x);

#endif
