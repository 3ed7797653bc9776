/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * locate.h -- the cell that a point lies in, and fields at that point. */
#ifndef SPACE_LOCATE_H
#define SPACE_LOCATE_H

#include "space/space.h"

typedef struct located {
    int32_t cell; /* -1: outside the mesh */
    double xi[3]; /* reference coordinates */
} located;

/* Reference coordinates of x in a cell: 1 inside, 0 outside (the mapping continued), -1 not found. */
int locate_in_cell(const mesh *m, int64_t cell, const double *x, double *xi);
located locate_point(const mesh *m, const double *x);
/* Value[n_comp] and, unless NULL, gradient[n_comp][dim] of a field there. */
void locate_value(const space *s, const located *at, int field, const double *x, double *value, double *gradient);

#endif
