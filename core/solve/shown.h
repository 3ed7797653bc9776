/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * shown.h -- terms whose results are shown: integrals, and fields that are projected. */
#ifndef SOLVE_SHOWN_H
#define SOLVE_SHOWN_H

#include "assemble/assemble.h"

enum { SHOWN_MOST = 64 }; /* integrals */

/* What the values of an integral belong to. */
enum shown_per { SHOWN_WHOLE, SHOWN_BOUNDARY, SHOWN_BODY };

typedef struct shown_integral {
    const term_use *use;
    const pf_slot *slot;
    enum shown_per per;
    int n_comp, n; /* n: 1, names of boundaries, bodies */
    double *value; /* [n][n_comp] */
} shown_integral;

typedef struct shown_field {
    const term_use *use;
    int where;      /* enum pf_where of its points */
    double mean[9]; /* over them                   */
} shown_field;

typedef struct shown {
    const space *from; /* of the unknowns */
    space space;       /* of the fields that are shown, of order 1 */
    assembly assembly;
    assembly_shown out;
    int n_integral, n_body;
    shown_integral integral[SHOWN_MOST];
    shown_field field[SPACE_MAX_FIELDS];
    double *x; /* [space.n_dof] after shown_project; NaN at vertices that no point is near */
    arena memory;
} shown;

/* Terms by the points that they act on, as for the equations; PF_FACET must be on all facets.  fields: of the slots
 * PF_SHOW, called like them. */
int shown_create(shown *p, const space *from, const field_list *fields, const assembly_spec *spec, int n_spec,
                 int n_thread, error *err);
/* Integrals and means at a state; errors as assembly_show. */
int shown_evaluate(shown *p, assembly_state at, error *err);
/* Then: x, the L2 projections. */
int shown_project(shown *p, error *err);
void shown_destroy(shown *p);
/* 1: the term reads rates or values of the last step, which there are none of before the first. */
int shown_needs_step(const pf_term *t);

/* --- project.c --- */

/* x of the fields whose points are of this kind. */
int project_fields(shown *p, int where, error *err);

#endif
