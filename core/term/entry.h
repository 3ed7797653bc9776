/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * entry.h -- numbers of slots and Jacobian blocks by name: grad_v[0][1], d v[0] / d p. */
#ifndef TERM_ENTRY_H
#define TERM_ENTRY_H

#include "term/bench.h"

/* "[0][1]": component c of a slot of this shape, "" of a scalar; and with the slot's name.  Both return text. */
const char *entry_index(const pf_slot *s, int dim, int c, char *text, size_t n);
const char *entry_name(const pf_slot *s, int dim, int c, char *text, size_t n);

/* The first wrong entry of the block of output o and input i, with both values, what they are made of, and a guess
 * at what is wrong: "d grad_v[0][1] / d grad_u[1][0] is 0, should be 2.5 = viscosity (missing)"; "" if none is. */
void entry_first_wrong(const bench *k, uint32_t o, uint32_t i, const double *given, const double *truth,
                       double tolerance, char *text, size_t n);

#endif
