/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * guard.h -- arrays between zones that nobody may write, and arrays that must stay as they are: what a point
 * function writes where it should not is found after the call, and told by name. */
#ifndef TERM_GUARD_H
#define TERM_GUARD_H

#include "base/arena.h"
#include "base/error.h"

#include <stddef.h>
#include <stdint.h>

/* More than a point function of one term can have: three times all slots, all blocks twice, the points. */
enum { GUARD_MAX = 420 };

typedef struct guard_array {
    const char *kind, *name;  /* "output", "grad_v"                               */
    unsigned char *at, *kept; /* kept: a copy of what must not change, or NULL   */
    uint64_t mark;            /* what the zones hold                              */
    size_t count, unit;       /* numbers, bytes of one                            */
    size_t row;               /* numbers of a component, 0: it has no components  */
} guard_array;

typedef struct guard {
    int n;
    guard_array array[GUARD_MAX];
    arena *memory;
} guard;

/* Zeroed, 64-byte aligned, with zones before and behind; NULL: no memory.  `fixed`: must not change in a call. */
void *guard_new(guard *g, const char *kind, const char *name, size_t count, size_t unit, size_t row, int fixed);
/* Before a call: what must not change is copied. */
void guard_keep(guard *g);
/* Whether a number was computed from one of the zones, which of them: "output \"v\""; else NULL. */
const char *guard_read(const guard *g, double v, char *text, size_t n);
/* After a call: 1 and what was written where it should not be (and all is as it was); else 0. */
int guard_broken(guard *g, char *text, size_t n);

#endif
