/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * problem.h -- a case made concrete: ties description, mesh, unknowns, conditions, bodies, equations and state
 * together. */
#ifndef PROBLEM_PROBLEM_H
#define PROBLEM_PROBLEM_H

#include "body/body.h"
#include "describe/describe.h"
#include "mesh/cell_grid.h"
#include "solve/solve.h"
#include "solve/stepper.h"
#include "state/state.h"

typedef struct problem {
    description description;
    mesh mesh;
    cell_grid grid;
    space space;
    conditions conditions;
    bodies bodies;
    newton_system system;
    newton_options newton;
    continuation continuation;
    state state;
    warning_list warnings;
    int n_thread;
    double setup_seconds, mesh_seconds;
    arena memory;
} problem;

/* Reads everything, reports all mistakes of the case at once, then makes the mesh, numbers the
 * unknowns and plans the assembly. */
int problem_create(problem *p, case_file *c, registry *r, int n_thread, error *err);
/* The problem of a box without bodies on half as many cells; to be destroyed before the fine one, whose
 * description it shares.  Its warnings are its own. */
int problem_create_coarse(problem *p, const problem *fine, error *err);
void problem_destroy(problem *p);

/* The state at the start: initial values (zero where the case gives none), then the prescribed ones. */
int problem_initial(problem *p, error *err);
/* The placement of the bodies as the assembly reads it; NULL: there are none. */
const body_points *problem_points(const problem *p);

/* Warns where the cells are far too large for the flow that is prescribed (resolution.c). */
int problem_check_resolution(problem *p, error *err);
/* Density of the terms that carry the field along with itself, viscosity of those that diffuse it (0: there is
 * none); whether a term is one of the first, on cells: its work is what the field carries with it. */
void problem_numbers(const description *d, const char *field, double *density, double *viscosity);
int problem_carries(const term_use *u, const char *field);
/* Makes the mesh that a description says (make_mesh.c). */
int problem_make_mesh(const description *d, registry *r, mesh *m, error *err);
/* A box with half as many cells in each direction that has two or more. */
int problem_halve(mesh_box *box, arena *memory, error *err);

#endif
