/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The sparsity pattern, built on carriers: all rows of a carrier have the same columns, so one
 * offset per pair of carriers of a cell locates a whole block of entries in the matrix.
 *
 * Which carriers couple is kept as a graph.  A change of groups near bodies changes it there: elsewhere lists and
 * offsets stay. */
#include "space/space.h"

#include "base/list.h"
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

/* Groups first..last-1 of each carrier, ascending, in compressed lists. */
static int groups_of_carriers(const space *s, int64_t first, int64_t last, arena *memory, int64_t **start,
                              int32_t **group, error *err)
{
    int64_t room = 0;

    for (int64_t e = first; e < last; e++)
        room += group_size(s, e);
    ARENA_NEW(memory, *start, s->n_carrier + 2, err);
    ARENA_NEW(memory, *group, room + 1, err);
    for (int64_t e = first; e < last; e++)
        for (int i = 0; i < group_size(s, e); i++)
            if (carrier_of(s, e, i) >= 0)
                (*start)[carrier_of(s, e, i) + 2]++;
    for (int64_t c = 0; c <= s->n_carrier; c++)
        (*start)[c + 1] += (*start)[c];
    for (int64_t e = first; e < last; e++)
        for (int i = 0; i < group_size(s, e); i++)
            if (carrier_of(s, e, i) >= 0)
                (*group)[(*start)[carrier_of(s, e, i) + 1]++] = (int32_t)e;
    return 0;
}

/* What a pattern is built with. */
typedef struct builder {
    space *s;
    int64_t *more_start; /* groups beside the cells, of each carrier */
    int32_t *more;
    uint8_t *fresh; /* [n_carrier] 1: the carrier couples otherwise than in the last pattern   */
    uint8_t *seen;  /* [n_carrier] of a list: 1 some group couples it, 2 only a spare pair does */
    int32_t *offset, *list;
    space_graph graph; /* the new one */
    arena memory;
} builder;

static int open_builder(builder *b, space *s, error *err)
{
    const space_graph *old = &s->graph;

    b->s = s;
    TRY(groups_of_carriers(s, s->mesh->n_cell, n_groups(s), &b->memory, &b->more_start, &b->more, err));
    ARENA_NEW(&b->memory, b->fresh, s->n_carrier, err);
    ARENA_NEW(&b->memory, b->seen, s->n_carrier, err);
    ARENA_NEW(&b->memory, b->offset, s->n_carrier, err);
    ARENA_NEW(&b->memory, b->list, s->n_carrier, err);
    ARENA_NEW(&b->graph.memory, b->graph.start, s->n_carrier + 1, err);
    ARENA_NEW(&b->graph.memory, b->graph.unknowns, s->n_carrier, err);
    ARENA_NEW(&b->graph.memory, b->graph.special, s->n_carrier, err);
    memset(b->fresh, !old->start, (size_t)s->n_carrier);
    memset(b->offset, 0xff, (size_t)s->n_carrier * sizeof *b->offset);
    for (int64_t c = 0; c < s->n_carrier; c++) {
        b->graph.unknowns[c] = (int32_t)(s->node_free[c + 1] - s->node_free[c]);
        b->graph.special[c] = b->more_start[c + 1] > b->more_start[c];
        if (!old->start)
            continue;
        b->fresh[c] |= b->graph.special[c] || old->special[c];
        if (b->graph.unknowns[c] == old->unknowns[c])
            continue;
        b->fresh[c] = 1;
        for (int64_t k = s->cell_start[c]; k < s->cell_start[c + 1]; k++)
            for (int i = 0; i < s->cell_carriers; i++)
                if (carrier_of(s, s->cell_list[k], i) >= 0)
                    b->fresh[carrier_of(s, s->cell_list[k], i)] = 1;
    }
    return 0;
}

/* Adds the carriers of a group that have free unknowns to a list of n. */
static int64_t add_carriers(builder *b, int64_t group, int64_t n)
{
    const int kind = group < space_groups(b->s) ? 1 : 2;

    for (int i = 0, size = group_size(b->s, group); i < size; i++) {
        int32_t j = carrier_of(b->s, group, i);

        if (j < 0 || b->seen[j] || b->graph.unknowns[j] == 0)
            continue;
        b->seen[j] = (uint8_t)kind;
        b->list[n++] = j;
    }
    return n;
}

/* Carriers with free unknowns that share a group with c, ascending, each once. */
static int64_t neighbours(builder *b, int64_t c)
{
    const space *s = b->s;
    int64_t n = 0;

    for (int64_t k = s->cell_start[c]; k < s->cell_start[c + 1]; k++)
        n = add_carriers(b, s->cell_list[k], n);
    for (int64_t k = b->more_start[c]; k < b->more_start[c + 1]; k++)
        n = add_carriers(b, b->more[k], n);
    qsort(b->list, (size_t)n, sizeof *b->list, order_int32);
    return n;
}

/* The graph: new lists near bodies, elsewhere those of the last one. */
static int build_graph(builder *b, error *err)
{
    const space_graph *old = &b->s->graph;
    space_graph *g = &b->graph;

    for (int64_t c = 0; c < b->s->n_carrier; c++) {
        const int32_t *list = b->fresh[c] ? b->list : old->list + old->start[c];
        int64_t n = b->fresh[c] ? neighbours(b, c) : old->start[c + 1] - old->start[c];

        LIST_ROOM(g->list, g->start[c] + n, &g->room, err);
        LIST_ROOM(g->spare, g->start[c] + n, &g->spare_room, err);
        memcpy(g->list + g->start[c], list, (size_t)n * sizeof *list);
        memset(g->spare + g->start[c], 0, (size_t)n);
        for (int64_t k = 0; b->fresh[c] && k < n; k++) {
            g->spare[g->start[c] + k] = b->seen[list[k]] == 2;
            b->seen[list[k]] = 0;
        }
        g->start[c + 1] = g->start[c] + n;
    }
    return 0;
}

/* For groups of carrier c: where the columns of each of their carriers start in c's rows. */
static void locate_pairs(builder *b, int64_t c, const int32_t *group, int64_t n_group)
{
    space *s = b->s;

    for (int64_t k = 0; k < n_group && group[k] < space_groups(s); k++) {
        int32_t *pair = (int32_t *)space_pair(s, group[k]);
        int n = space_group_size(s, group[k]);

        for (int i = 0; i < n; i++)
            if (space_carrier(s, group[k], i) == c)
                for (int j = 0; j < n; j++) {
                    int32_t other = space_carrier(s, group[k], j);

                    pair[i * n + j] = other < 0 ? -1 : b->offset[other];
                }
    }
}

/* Offsets of all groups of a carrier that couples otherwise than before. */
static void locate_carrier(builder *b, int64_t c)
{
    const space *s = b->s;
    const space_graph *g = &b->graph;
    int32_t width = 0;

    for (int64_t k = g->start[c]; k < g->start[c + 1]; k++) {
        b->offset[g->list[k]] = width;
        width += g->unknowns[g->list[k]];
    }
    locate_pairs(b, c, s->cell_list + s->cell_start[c], s->cell_start[c + 1] - s->cell_start[c]);
    locate_pairs(b, c, b->more + b->more_start[c], b->more_start[c + 1] - b->more_start[c]);
    for (int64_t k = g->start[c]; k < g->start[c + 1]; k++)
        b->offset[g->list[k]] = -1;
}

/* Rows of carrier c from entry `at` on; returns where they end. */
static int64_t write_rows(space *s, const space_graph *g, int64_t c, int64_t at)
{
    const int64_t first = s->n_col;

    for (int64_t r = s->node_free[c]; r < s->node_free[c + 1]; r++) {
        s->row[r] = at;
        s->col_shift[r] = first - at;
        for (int64_t k = g->start[c]; k < g->start[c + 1]; k++) {
            int32_t j = g->list[k];

            for (int64_t f = s->node_free[j]; f < s->node_free[j + 1] && r == s->node_free[c]; f++)
                s->col[s->n_col++] = (int32_t)f;
            at += g->unknowns[j];
            if (s->unused)
                memset(s->unused + at - g->unknowns[j], g->spare[k], (size_t)g->unknowns[j]);
        }
    }
    return at;
}

/* Entries, and those that the carriers have once. */
static int64_t count_entries(const space_graph *g, int64_t n_carrier, int64_t *once)
{
    int64_t n = 0;

    *once = 0;
    for (int64_t c = 0; c < n_carrier; c++)
        for (int64_t k = g->start[c]; k < g->start[c + 1]; k++) {
            n += (int64_t)g->unknowns[c] * g->unknowns[g->list[k]];
            *once += g->unknowns[c] ? g->unknowns[g->list[k]] : 0;
        }
    return n;
}

static int build(builder *b, space *s, error *err)
{
    int64_t entries, once, at = 0;

    if (n_groups(s) > INT32_MAX)
        return error_set(err, ERR_MEMORY,
                         "%lld cells and pairs of cells and bodies; this build numbers at most 2^31",
                         (long long)n_groups(s));
    if (!s->cell_start) {
        TRY(groups_of_carriers(s, 0, s->mesh->n_cell, &s->memory, &s->cell_start, &s->cell_list, err));
        ARENA_NEW(&s->memory, s->pair, s->mesh->n_cell * s->cell_carriers * s->cell_carriers, err);
    }
    TRY(open_builder(b, s, err));
    TRY(build_graph(b, err));
    entries = count_entries(&b->graph, s->n_carrier, &once);
    ARENA_NEW(&s->pattern_memory, s->row, s->n_free + 1, err);
    ARENA_NEW(&s->pattern_memory, s->more_pair, space_more_pairs(s) + 1, err);
    ARENA_NEW(&s->pattern_memory, s->col, once + 1, err);
    ARENA_NEW(&s->pattern_memory, s->col_shift, s->n_free, err);
    s->n_col = 0;
    if (s->n_spare)
        ARENA_NEW(&s->pattern_memory, s->unused, entries, err);
    for (int64_t c = 0; c < s->n_carrier; c++) {
        if (b->fresh[c])
            locate_carrier(b, c);
        at = write_rows(s, &b->graph, c, at);
    }
    s->row[s->n_free] = at;
    return 0;
}

void space_graph_free(space_graph *g)
{
    free(g->list);
    free(g->spare);
    arena_free(&g->memory);
    memset(g, 0, sizeof *g);
}

int space_constrain(space *s, error *err)
{
    builder b = {0};
    int status;

    arena_free(&s->pattern_memory);
    s->unused = NULL;
    status = number_free(s, err);
    status = status ? status : build(&b, s, err);
    space_graph_free(&s->graph);
    if (status)
        space_graph_free(&b.graph);
    s->graph = b.graph;
    s->outdated = status != 0;
    arena_free(&b.memory);
    return status;
}
