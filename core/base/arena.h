/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * arena.h -- memory with one owner and one lifetime.  Everything an object allocates goes
 * at once in arena_free, however far its construction came. */
#ifndef BASE_ARENA_H
#define BASE_ARENA_H

#include <stddef.h>

typedef struct arena {
    struct arena_block *last;
    size_t bytes; /* handed out so far */
} arena;

/* count * size bytes, zeroed, 64-byte aligned; NULL if there is no such memory. */
void *arena_alloc(arena *a, size_t count, size_t size);
char *arena_strdup(arena *a, const char *s);
void arena_free(arena *a);

/* p = n objects of *p's type, or return ERR_MEMORY. */
#define ARENA_NEW(a, p, n, err)                                                                                    \
    do {                                                                                                           \
        (p) = arena_alloc((a), (size_t)(n), sizeof *(p));                                                          \
        if (!(p))                                                                                                  \
            return error_memory((err), #p, (double)(n) * (double)sizeof *(p));                                     \
    } while (0)

#endif
