/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * list.h -- lists that grow. */
#ifndef BASE_LIST_H
#define BASE_LIST_H

#include "base/error.h"

#include <stdint.h>
#include <stdlib.h>

/* A list of entries of `size` bytes with room for more than n of them: the same one, or moved (then *room is
 * larger); NULL if there is no such memory, and the old list stays. */
static inline void *list_room(void *list, int64_t n, int64_t *room, size_t size)
{
    int64_t more = 2 * n + 64;
    void *moved;

    if (n < *room)
        return list;
    moved = realloc(list, (size_t)more * size);
    if (moved)
        *room = more;
    return moved;
}

/* list = room for entry n, or return ERR_MEMORY. */
#define LIST_ROOM(list, n, room, err)                                                                              \
    do {                                                                                                           \
        void *moved_ = list_room((list), (n), (room), sizeof *(list));                                             \
        if (!moved_)                                                                                               \
            return error_memory((err), #list, (double)(2 * (n) + 64) * (double)sizeof *(list));                    \
        (list) = moved_;                                                                                           \
    } while (0)

#endif
