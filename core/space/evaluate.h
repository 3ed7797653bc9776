/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * evaluate.h -- a field at a point of a cell. */
#ifndef SPACE_EVALUATE_H
#define SPACE_EVALUATE_H

#include "space/space.h"

/* What is wanted there; what is NULL is not computed. */
typedef struct point_values {
    double *value;    /* [n_comp]                                                        */
    double *gradient; /* [n_comp][dim], d value_a / d x_k                                */
    double *place;    /* [3], 0 in the unused direction                                  */
    double *det;      /* of the mapping: volume per volume of the reference cell         */
} point_values;

/* Field `field` with unknowns x[n_dof] at reference coordinates xi[dim] of a cell.  One of order 0 is that of the
 * problem as a whole; one that hangs on particles has no value in a cell: NAN, and no gradient. */
void space_evaluate(const space *s, int field, const double *x, int64_t cell, const double *xi,
                    const point_values *want);

/* Adds factor times the integral of each basis function of the field over the cell, by a rule of the reference
 * cell, to integral[n_dof]. */
void space_integrate_basis(const space *s, int field, int64_t cell, const fe_rule *rule, double factor,
                           double *integral);
/* The same over all cells, by the rule of this degree (fe_rule_cell), to integral[n_dof] that is zero before. */
int space_integrals(const space *s, int field, int degree, double *integral, error *err);

#endif
