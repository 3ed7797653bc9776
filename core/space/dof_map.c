/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Fields and the numbering of their unknowns. */
#include "space/space.h"

#include <string.h>

int space_find_field(const space *s, const char *name)
{
    for (int i = 0; i < s->n_field; i++)
        if (strcmp(s->field[i].name, name) == 0)
            return i;
    return -1;
}

int space_add_field(space *s, int dim, const pf_field *f, const char *plugin, error *err)
{
    int i = space_find_field(s, f->name);
    space_field *g = &s->field[i < 0 ? 0 : i];
    int order = f->support == PF_ON_MESH || f->support == PF_IN_PARTICLES ? (int)f->order : 0;

    if (i >= 0) {
        if (g->shape != (int)f->shape || g->order != order || g->support != (int)f->support)
            return error_set(
                err, ERR_PLUGIN,
                "field \"%s\": plugin \"%s\" declares it as %s of order %d, plugin \"%s\" as %s of order %d; "
                "one of them needs another name for its field",
                f->name, g->declared_by, g->shape == PF_VECTOR ? "vector" : "scalar", g->order, plugin,
                f->shape == PF_VECTOR ? "vector" : "scalar", order);
        if (!g->constrains)
            g->constrains = f->constrains;
        return 0;
    }
    if (s->n_field == SPACE_MAX_FIELDS)
        return error_set(err, ERR_PLUGIN, "field \"%s\" of plugin \"%s\": more than %d fields", f->name, plugin,
                         SPACE_MAX_FIELDS);
    s->field[s->n_field++] = (space_field){
        .name = f->name,
        .unit = f->unit ? f->unit : "1",
        .doc = f->doc ? f->doc : "",
        .reaction = f->reaction,
        .reaction_unit = f->reaction_unit ? f->reaction_unit : "",
        .declared_by = plugin,
        .constrains = f->constrains,
        .shape = (int)f->shape,
        .n_comp = f->shape == PF_VECTOR             ? dim
                  : f->shape == PF_SPIN && dim == 3 ? 3
                                                    : 1,
        .order = order,
        .support = (int)f->support,
    };
    return 0;
}

int64_t space_groups(const space *s)
{
    return s->mesh->n_cell + s->n_attached + s->n_extra;
}

int32_t space_master(const space *s, int32_t node)
{
    while (s->mesh->master && s->mesh->master[node] != node)
        node = s->mesh->master[node];
    return node;
}

int space_group_size(const space *s, int64_t group)
{
    int64_t extra = group - s->mesh->n_cell - s->n_attached;

    return extra < 0 ? s->cell_carriers : (int)(s->extra_first[extra + 1] - s->extra_first[extra]);
}

int32_t space_carrier(const space *s, int64_t group, int i)
{
    const mesh *m = s->mesh;
    int64_t attached = group - m->n_cell, cell = group;

    if (attached >= s->n_attached)
        return s->extra_carrier[s->extra_first[attached - s->n_attached] + i];
    if (attached >= 0)
        cell = s->attached_cell[attached];
    if (i >= m->type->n_node) {
        if (i == m->type->n_node && s->any_problem)
            return (int32_t)m->n_node;
        return attached >= 0 ? (int32_t)m->n_node + 1 + s->attached_particle[attached] : -1;
    }
    return space_master(s, m->cell[cell * m->type->n_node + i]);
}

const int32_t *space_pair(const space *s, int64_t group)
{
    int64_t base = s->mesh->n_cell + s->n_attached;

    return s->pair + (group < base ? group * s->cell_carriers * s->cell_carriers : s->extra_pair[group - base]);
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

int space_number(space *s, mesh *m, error *err)
{
    uint8_t *order;

    s->mesh = m;
    s->n_carrier = m->n_node + 1 + s->n_particle;
    for (int f = 0; f < s->n_field; f++)
        s->any_problem |= s->field[f].support == PF_ON_PROBLEM;
    s->cell_carriers = m->type->n_node + s->any_problem + (s->n_particle > 0);
    ARENA_NEW(&s->memory, order, s->n_carrier, err);
    TRY(mark_carriers(s, order, err));
    for (int pass = 0; pass < 2; pass++) {
        int64_t n = 0;

        for (int64_t c = 0; c < s->n_carrier; c++)
            for (int f = 0; f < s->n_field; f++) {
                const space_field *g = &s->field[f];
                int here = g->support == PF_ON_PROBLEM    ? c == m->n_node
                           : g->support == PF_ON_PARTICLE ? c > m->n_node
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
        ARENA_NEW(&s->memory, s->idle, n, err);
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
    arena_free(&s->pattern_memory);
    arena_free(&s->memory);
    memset(s, 0, sizeof *s);
}
