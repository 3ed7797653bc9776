/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The sparsity pattern, built on carriers: all rows of a carrier have the same columns, so one
 * offset per pair of carriers of a cell locates a whole block of entries in the matrix. */
#include "space/space.h"

#include "base/order.h"

#include <stdlib.h>
#include <string.h>

static int number_free(space *s, error *err)
{
    int64_t n = 0, groups = 0;

    ARENA_NEW(&s->pattern_memory, s->free_of, s->n_dof, err);
    ARENA_NEW(&s->pattern_memory, s->node_free, s->n_carrier + 1, err);
    for (int64_t d = 0; d < s->n_dof; d++)
        s->free_of[d] = s->fixed[d] ? -1 : (int32_t)n++;
    s->n_free = n;
    if (n == 0)
        return error_set(err, ERR_CASE, "no unknown is left: boundary conditions fix all of them; refine the mesh");
    ARENA_NEW(&s->pattern_memory, s->dof_of, n, err);
    for (int64_t d = 0; d < s->n_dof; d++)
        if (s->free_of[d] >= 0) {
            s->dof_of[s->free_of[d]] = (int32_t)d;
            s->node_free[s->dof_node[d] + 1]++;
        }
    for (int64_t c = 0; c < s->n_carrier; c++) {
        groups += s->node_free[c + 1] > 0;
        s->node_free[c + 1] += s->node_free[c];
    }
    ARENA_NEW(&s->pattern_memory, s->row_node, groups + 1, err);
    s->n_row_node = 0;
    for (int64_t c = 0; c < s->n_carrier; c++)
        if (s->node_free[c + 1] > s->node_free[c])
            s->row_node[s->n_row_node++] = s->node_free[c];
    s->row_node[s->n_row_node] = n;
    return 0;
}

/* After the groups come the spare pairs of cells: as ties, but without offsets of their own. */
static int64_t n_groups(const space *s)
{
    return space_groups(s) + s->n_spare;
}

static int group_size(const space *s, int64_t g)
{
    return g < space_groups(s) ? space_group_size(s, g) : 2 * s->mesh->type->n_node;
}

static int32_t carrier_of(const space *s, int64_t g, int i)
{
    int n = s->mesh->type->n_node;

    return g < space_groups(s) ? space_carrier(s, g, i)
                               : space_carrier(s, s->spare[g - space_groups(s)][i / n], i % n);
}

/* Groups of each carrier, in compressed lists. */
static int groups_of_carriers(space *s, int64_t **start, int32_t **cell, error *err)
{
    int64_t n = n_groups(s), room = 0;

    if (n > INT32_MAX)
        return error_set(err, ERR_MEMORY,
                         "%lld cells and pairs of cells and bodies; this build numbers at most 2^31", (long long)n);
    ARENA_NEW(&s->memory, *start, s->n_carrier + 2, err);
    for (int64_t e = 0; e < n; e++)
        room += group_size(s, e);
    ARENA_NEW(&s->memory, *cell, room, err);
    for (int64_t e = 0; e < n; e++)
        for (int i = 0; i < group_size(s, e); i++)
            if (carrier_of(s, e, i) >= 0)
                (*start)[carrier_of(s, e, i) + 2]++;
    for (int64_t c = 0; c <= s->n_carrier; c++)
        (*start)[c + 1] += (*start)[c];
    for (int64_t e = 0; e < n; e++)
        for (int i = 0; i < group_size(s, e); i++)
            if (carrier_of(s, e, i) >= 0)
                (*cell)[(*start)[carrier_of(s, e, i) + 1]++] = (int32_t)e;
    return 0;
}

/* Carriers with free unknowns that share a group with c, ascending, each once.  seen: 1 if the group is one, 2 if
 * it is but a spare pair. */
static int64_t neighbours(const space *s, const int64_t *start, const int32_t *cell, int64_t c, int32_t *list,
                          uint8_t *seen)
{
    int64_t n = 0;

    for (int64_t k = start[c]; k < start[c + 1]; k++)
        for (int i = 0, size = group_size(s, cell[k]); i < size; i++) {
            int32_t j = carrier_of(s, cell[k], i);

            if (j < 0 || seen[j] || s->node_free[j + 1] == s->node_free[j])
                continue;
            seen[j] = cell[k] < space_groups(s) ? 1 : 2;
            list[n++] = j;
        }
    qsort(list, (size_t)n, sizeof *list, order_int32);
    return n;
}

/* For the cells of carrier c: where the columns of each of their carriers start in c's rows. */
static void locate_pairs(space *s, const int64_t *start, const int32_t *cell, int64_t c, int32_t *offset)
{
    for (int64_t k = start[c]; k < start[c + 1] && cell[k] < space_groups(s); k++) {
        int32_t *pair = (int32_t *)space_pair(s, cell[k]);
        int n = space_group_size(s, cell[k]);

        for (int i = 0; i < n; i++)
            if (carrier_of(s, cell[k], i) == c)
                for (int j = 0; j < n; j++) {
                    int32_t other = carrier_of(s, cell[k], j);

                    pair[i * n + j] = other < 0 ? -1 : offset[other];
                }
    }
}

/* Rows of carrier c, from entry `at` on, and with offsets their columns; returns where they end. */
static int64_t write_rows(space *s, int64_t c, const int32_t *list, int64_t n, int64_t width, const int32_t *offset,
                          const uint8_t *seen, int64_t at)
{
    for (int64_t r = s->node_free[c]; r < s->node_free[c + 1]; r++) {
        s->row[r] = at;
        for (int64_t k = 0; offset && k < n; k++)
            for (int64_t f = s->node_free[list[k]]; f < s->node_free[list[k] + 1]; f++) {
                int64_t entry = at + offset[list[k]] + f - s->node_free[list[k]];

                s->col[entry] = f;
                if (s->unused)
                    s->unused[entry] = seen[list[k]] == 2;
            }
        at += width;
    }
    return at;
}

int space_constrain(space *s, error *err)
{
    arena scratch = {0};
    arena keep;
    int64_t *start = NULL, entries = 0;
    int32_t *cell = NULL, *list, *offset;
    uint8_t *seen;
    int status = 0;

    arena_free(&s->pattern_memory);
    s->unused = NULL;
    TRY(number_free(s, err));
    ARENA_NEW(&s->pattern_memory, s->row, s->n_free + 1, err);
    ARENA_NEW(&s->pattern_memory, s->pair, space_pairs(s), err);
    keep = s->memory; /* what follows is needed only here */
    s->memory = scratch;
    status = groups_of_carriers(s, &start, &cell, err);
    list = arena_alloc(&s->memory, (size_t)s->n_carrier, sizeof *list);
    offset = arena_alloc(&s->memory, (size_t)s->n_carrier, sizeof *offset);
    seen = arena_alloc(&s->memory, (size_t)s->n_carrier, 1);
    scratch = s->memory;
    s->memory = keep;
    if (status || !list || !offset || !seen) {
        arena_free(&scratch);
        return status ? status : error_memory(err, "matrix pattern", (double)s->n_carrier * 9);
    }
    for (int pass = 0; pass < 2 && !status; pass++) {
        int64_t at = 0;

        memset(offset, 0xff, (size_t)s->n_carrier * sizeof *offset);
        for (int64_t c = 0; c < s->n_carrier; c++) {
            int64_t n = neighbours(s, start, cell, c, list, seen), width = 0;

            for (int64_t k = 0; k < n; k++) {
                offset[list[k]] = (int32_t)width;
                width += s->node_free[list[k] + 1] - s->node_free[list[k]];
            }
            if (pass)
                locate_pairs(s, start, cell, c, offset);
            at = write_rows(s, c, list, n, width, pass ? offset : NULL, seen, at);
            for (int64_t k = 0; k < n; k++) {
                offset[list[k]] = -1;
                seen[list[k]] = 0;
            }
        }
        s->row[s->n_free] = entries = at;
        if (!pass && ((s->n_spare && !(s->unused = arena_alloc(&s->pattern_memory, (size_t)entries, 1))) ||
                      !(s->col = arena_alloc(&s->pattern_memory, (size_t)entries, sizeof *s->col))))
            status = error_memory(err, "matrix pattern", 9.0 * (double)entries);
    }
    arena_free(&scratch);
    s->outdated = status != 0;
    return status;
}
