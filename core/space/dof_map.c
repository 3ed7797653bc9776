/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Fields and the numbering of their unknowns. */
#include "space/space.h"

#include <stdlib.h>
#include <string.h>

int space_find_field(const space *s, const char *name)
{
    for (int i = 0; i < s->n_field; i++)
        if (strcmp(s->field[i].name, name) == 0)
            return i;
    return -1;
}

/* What fields a carrier has: marks order 2 on all nodes of cells, order 1 on their vertices. */
static int mark_carriers(space *s, uint8_t *order, error *err)
{
    const mesh *m = s->mesh;

    for (int64_t e = 0; e < m->n_cell; e++) {
        for (int i = 0; i < m->type->n_node; i++)
            order[space_carrier(s, e, i)] |= 2;
        for (int i = 0; i < m->type->n_vertex; i++)
            order[space_carrier(s, e, m->type->vertex[i])] |= 1;
    }
    for (int f = 0; f < s->n_field; f++) {
        ARENA_NEW(&s->memory, s->first[f], s->n_carrier, err);
        memset(s->first[f], 0xff, (size_t)s->n_carrier * sizeof(int32_t));
    }
    return 0;
}

int space_number(space *s, const field_list *fields, const mesh *m, int n_body, error *err)
{
    uint8_t *order;

    memset(s, 0, sizeof *s);
    s->mesh = m;
    s->field = fields->f;
    s->n_field = fields->n;
    s->n_particle = n_body;
    for (int f = 0; f < s->n_field; f++) {
        s->any_problem |= s->field[f].support == PF_ON_PROBLEM;
        s->any_cell |= space_of_cells(&s->field[f]);
    }
    s->n_carrier = m->n_node + 1 + s->n_particle + (s->any_cell ? m->n_cell : 0);
    if (s->n_carrier > INT32_MAX - 64)
        return error_set(err, ERR_MEMORY, "more than 2^31 nodes and cells; this build numbers at most that many");
    s->cell_carriers = m->type->n_node + s->any_problem + s->any_cell + (s->n_particle > 0);
    ARENA_NEW(&s->memory, order, s->n_carrier, err);
    TRY(mark_carriers(s, order, err));
    for (int pass = 0; pass < 2; pass++) {
        int64_t n = 0;

        for (int64_t c = 0; c < s->n_carrier; c++)
            for (int f = 0; f < s->n_field; f++) {
                const field_spec *g = &s->field[f];
                int here = g->support == PF_ON_PROBLEM    ? c == m->n_node
                           : g->support == PF_ON_PARTICLE ? c > m->n_node && c < space_cell_carrier(s, 0)
                           : space_of_cells(g)            ? c >= space_cell_carrier(s, 0)
                                                          : c < m->n_node && (order[c] & g->order);

                if (!here)
                    continue;
                s->first[f][c] = (int32_t)n;
                for (int k = 0; pass && k < g->n_comp; k++) {
                    s->dof_field[n + k] = (uint8_t)f;
                    s->dof_comp[n + k] = (uint8_t)k;
                    s->dof_node[n + k] = (int32_t)c;
                }
                n += g->n_comp;
                if (n > INT32_MAX - 64)
                    return error_set(err, ERR_MEMORY,
                                     "more than 2^31 unknowns; this build numbers at most that many");
            }
        s->n_dof = n;
        if (pass)
            break;
        ARENA_NEW(&s->memory, s->dof_field, n, err);
        ARENA_NEW(&s->memory, s->dof_comp, n, err);
        ARENA_NEW(&s->memory, s->dof_node, n, err);
        ARENA_NEW(&s->memory, s->fixed, n, err);
    }
    /* Nodes that share a master show its unknowns. */
    for (int64_t c = 0; m->master && c < m->n_node; c++) {
        int32_t r = space_master(s, (int32_t)c);

        for (int f = 0; f < s->n_field; f++)
            s->first[f][c] = s->first[f][r];
    }
    return 0;
}

void space_destroy(space *s)
{
    free(s->link);
    free(s->tie);
    free(s->tie_pair);
    free(s->spare);
    space_graph_free(&s->graph);
    arena_free(&s->attached_memory);
    arena_free(&s->pattern_memory);
    arena_free(&s->memory);
    memset(s, 0, sizeof *s);
}
