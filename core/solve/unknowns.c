/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The rows of the matrix as a solver plugin sees them, see unknowns.h. */
#include "solve/unknowns.h"

#include <string.h>

/* For each node of the mesh that is no vertex: shares of the vertices of a cell it belongs to. */
static int find_parents(const space *s, const int32_t *group, arena *memory, pf_unknowns *v, error *err)
{
    const mesh *m = s->mesh;
    const fe_cell *type = m->type;
    double share[FE_MAX_NODES][8], none[8][3];
    int64_t *start;
    int32_t *cell_of, *node;
    uint8_t *local, is_vertex[FE_MAX_NODES] = {0};
    double *weight;

    for (int i = 0; i < type->n_vertex; i++)
        is_vertex[type->vertex[i]] = 1;
    for (int i = 0; i < type->n_node; i++)
        fe_basis(type, 1, type->x[i], share[i], none);
    ARENA_NEW(memory, start, s->n_row_node + 1, err);
    ARENA_NEW(memory, cell_of, s->n_row_node + 1, err); /* some cell of a node, plus 1 */
    ARENA_NEW(memory, local, s->n_row_node + 1, err);
    for (int64_t e = 0; e < m->n_cell; e++)
        for (int i = 0; i < type->n_node; i++) {
            int32_t g = group[space_carrier(s, e, i)];

            if (g >= 0 && !is_vertex[i] && cell_of[g] == 0) {
                cell_of[g] = (int32_t)e + 1;
                local[g] = (uint8_t)i;
            }
        }
    ARENA_NEW(memory, node, s->n_row_node * type->n_vertex + 1, err);
    ARENA_NEW(memory, weight, s->n_row_node * type->n_vertex + 1, err);
    for (int64_t g = 0; g < s->n_row_node; g++) {
        start[g + 1] = start[g];
        for (int i = 0; cell_of[g] && i < type->n_vertex; i++) {
            int32_t parent = group[space_carrier(s, cell_of[g] - 1, type->vertex[i])];

            if (parent < 0 || share[local[g]][i] < 1e-12)
                continue;
            node[start[g + 1]] = parent;
            weight[start[g + 1]++] = share[local[g]][i];
        }
    }
    v->parent = start;
    v->parent_node = node;
    v->parent_weight = weight;
    return 0;
}

static int describe_rows(const space *s, arena *memory, pf_unknowns *v, error *err)
{
    uint8_t *field_of, *comp_of, *kind;
    double *x;
    int dim = s->mesh->dim;

    ARENA_NEW(memory, field_of, s->n_free, err);
    ARENA_NEW(memory, comp_of, s->n_free, err);
    ARENA_NEW(memory, kind, s->n_row_node + 1, err);
    ARENA_NEW(memory, x, s->n_row_node * dim + 1, err);
    for (int64_t i = 0; i < s->n_free; i++) {
        field_of[i] = s->dof_field[s->dof_of[i]];
        comp_of[i] = s->dof_comp[s->dof_of[i]];
    }
    for (int64_t g = 0; g < s->n_row_node; g++) {
        int32_t c = s->dof_node[s->dof_of[s->row_node[g]]];

        double place[3];

        kind[g] = space_place(s, c, place) ? PF_ROWS_OF_NODE
                  : c == s->mesh->n_node   ? PF_ROWS_OF_PROBLEM
                                           : PF_ROWS_OF_BODY;
        if (kind[g] == PF_ROWS_OF_NODE)
            memcpy(x + g * dim, place, (size_t)dim * sizeof *x);
    }
    v->field_of = field_of;
    v->comp_of = comp_of;
    v->kind = kind;
    v->x = x;
    return 0;
}

int unknowns_create(unknowns *u, arena *memory, const space *s, error *err)
{
    pf_row_field *field;
    int32_t *group;

    memset(u, 0, sizeof *u);
    ARENA_NEW(memory, field, s->n_field + 1, err);
    for (int f = 0; f < s->n_field; f++)
        field[f] = (pf_row_field){.name = s->field[f].name,
                                  .n_comp = s->field[f].n_comp,
                                  .order = s->field[f].order,
                                  .inside = s->field[f].support == PF_IN_PARTICLES};
    u->view = (pf_unknowns){.size = sizeof u->view, .dim = s->mesh->dim, .n_field = s->n_field, .field = field};
    ARENA_NEW(memory, group, s->n_carrier + 1, err);
    memset(group, 0xff, (size_t)s->n_carrier * sizeof *group);
    for (int64_t g = 0; g < s->n_row_node; g++)
        group[s->dof_node[s->dof_of[s->row_node[g]]]] = (int32_t)g;
    TRY(describe_rows(s, memory, &u->view, err));
    TRY(find_parents(s, group, memory, &u->view, err));
    ARENA_NEW(memory, u->idle, s->n_free, err);
    u->view.idle = u->idle;
    u->view.weight = u->weight;
    return 0;
}

int unknowns_update(unknowns *u, arena *memory, const space *s, const uint8_t *idle, const int *free_fields,
                    const double *const *integral, error *err)
{
    for (int64_t i = 0; i < s->n_free; i++)
        u->idle[i] = idle[s->dof_of[i]];
    u->view.free_fields = 0;
    for (int f = 0; f < s->n_field; f++) {
        u->weight[f] = NULL;
        if (!free_fields[f])
            continue;
        if (!u->weight_room[f])
            ARENA_NEW(memory, u->weight_room[f], s->n_free, err);
        u->weight[f] = u->weight_room[f];
        u->weight_sum[f] = 0;
        for (int64_t i = 0; i < s->n_free; i++) {
            int takes_part = u->view.field_of[i] == f && !u->idle[i];

            u->weight_room[f][i] = takes_part ? integral[f][s->dof_of[i]] : 0;
            u->weight_sum[f] += u->weight_room[f][i];
        }
        u->view.free_fields |= 1u << f;
    }
    return 0;
}

void unknowns_project(const unknowns *u, const space *s, double *rows)
{
    for (int f = 0; f < s->n_field; f++) {
        double sum = 0;

        if (!(u->view.free_fields >> f & 1))
            continue;
        for (int64_t i = 0; i < s->n_free; i++)
            sum += u->view.field_of[i] == f && !u->idle[i] ? rows[i] : 0;
        for (int64_t i = 0; i < s->n_free; i++)
            rows[i] -= sum / u->weight_sum[f] * u->weight[f][i];
    }
}

void unknowns_level(const unknowns *u, const space *s, const int64_t *pin, double *x)
{
    for (int f = 0; f < s->n_field; f++) {
        double held = u->view.free_fields >> f & 1 ? x[pin[f]] : 0;

        for (int64_t i = 0; held != 0 && i < s->n_free; i++)
            x[i] -= u->view.field_of[i] == f && !u->idle[i] ? held : 0;
    }
}
