/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The table of what a state holds, and what goes by it. */
#include "state/state.h"

#include <stddef.h>
#include <string.h>

/* What a member has one of. */
enum per { PER_STATE, PER_DOF, PER_BODY, PER_KEPT };

static const struct member {
    enum per per;
    size_t offset, size; /* of the value, or of the pointer and one entry */
} table[] = {
    {PER_STATE, offsetof(state, t), sizeof(double)},
    {PER_STATE, offsetof(state, dt_previous), sizeof(double)},
    {PER_STATE, offsetof(state, dt_before), sizeof(double)},
    {PER_STATE, offsetof(state, n_history), sizeof(int64_t)},
    {PER_DOF, offsetof(state, x), sizeof(double)},
    {PER_DOF, offsetof(state, before), sizeof(double)},
    {PER_DOF, offsetof(state, before2), sizeof(double)},
    {PER_KEPT, offsetof(state, kept), sizeof(double)},
    {PER_BODY, offsetof(state, pose), sizeof(pose)},
    {PER_BODY, offsetof(state, pose_before), sizeof(pose)},
    {PER_BODY, offsetof(state, pose_before2), sizeof(pose)},
    {PER_STATE, offsetof(state, count), sizeof(step_counts)},
    {PER_STATE, offsetof(state, control), sizeof(step_control)},
    {PER_BODY, offsetof(state, past), sizeof(body_past)},
    {PER_BODY, offsetof(state, fluid), sizeof(body_fluid)},
    {PER_STATE, offsetof(state, written), sizeof(double)},
};

enum { N_MEMBER = sizeof table / sizeof *table };

static size_t entries(const state *s, const struct member *m)
{
    return m->per == PER_STATE ? 1
                               : (size_t)(m->per == PER_DOF    ? s->n_dof
                                          : m->per == PER_KEPT ? s->n_kept
                                                               : s->n_body);
}

/* Where the values of a member are. */
static void *values(const state *s, const struct member *m)
{
    char *at = (char *)s + m->offset;
    void *array;

    if (m->per == PER_STATE)
        return at;
    memcpy(&array, at, sizeof array);
    return array;
}

int state_create(state *s, int64_t n_dof, int64_t n_body, int64_t n_kept, error *err)
{
    memset(s, 0, sizeof *s);
    s->n_dof = n_dof;
    s->n_body = n_body;
    s->n_kept = n_kept;
    for (int i = 0; i < N_MEMBER; i++) {
        size_t n = entries(s, &table[i]);
        void *array;

        if (table[i].per == PER_STATE)
            continue;
        array = arena_alloc(&s->memory, n + 1, table[i].size);
        if (!array)
            return error_memory(err, "state", (double)n * (double)table[i].size);
        memcpy((char *)s + table[i].offset, &array, sizeof array);
    }
    return 0;
}

void state_copy(state *to, const state *from)
{
    for (int i = 0; i < N_MEMBER; i++)
        memcpy(values(to, &table[i]), values(from, &table[i]), entries(from, &table[i]) * table[i].size);
}

void state_swap(state *a, state *b)
{
    state c = *a;

    *a = *b;
    *b = c;
}

void state_destroy(state *s)
{
    arena_free(&s->memory);
    memset(s, 0, sizeof *s);
}
