/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * packed.h -- the matrix with a column for each entry, and without the entries that the pattern has only to spare
 * (space.h): zeros that a factorisation would fill. */
#ifndef SOLVE_PACKED_H
#define SOLVE_PACKED_H

#include "base/arena.h"
#include "base/error.h"
#include "space/space.h"

#include <plugflow/solver.h>

typedef struct packed {
    pf_csr a;
    int claims; /* of the space when it was made */
    arena memory;
} packed;

/* The structure; the values are those of the matrix itself where no entry is unused. */
int packed_structure(packed *p, const space *s, const pf_csr *a, error *err);
/* Whether it is still that of the space. */
int packed_holds(const packed *p, const space *s);
/* Its values, of the same structure. */
void packed_values(packed *p, const space *s, const pf_csr *a);
void packed_destroy(packed *p);

#endif
