/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/arena.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

struct arena_block {
    struct arena_block *previous;
    char pad[64 - sizeof(struct arena_block *)];
};

void *arena_alloc(arena *a, size_t count, size_t size)
{
    size_t bytes;
    struct arena_block *b;

    if (__builtin_mul_overflow(count, size, &bytes) || bytes > SIZE_MAX / 2)
        return NULL;
    bytes = (bytes + 63) & ~(size_t)63;
    b = aligned_alloc(64, bytes + sizeof *b);
    if (!b)
        return NULL;
    memset(b, 0, bytes + sizeof *b);
    b->previous = a->last;
    a->last = b;
    a->bytes += bytes;
    return b + 1;
}

char *arena_strdup(arena *a, const char *s)
{
    size_t n = strlen(s) + 1;
    char *copy = arena_alloc(a, n, 1);

    return copy ? memcpy(copy, s, n) : NULL;
}

void arena_free(arena *a)
{
    while (a->last) {
        struct arena_block *b = a->last;

        a->last = b->previous;
        free(b);
    }
    a->bytes = 0;
}
