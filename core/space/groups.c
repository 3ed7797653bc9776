/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Groups of carriers whose unknowns couple (see space.h): cells, cells attached to bodies, links of bodies, ties of
 * cells.  Groups are numbered in this order. */
#include "space/space.h"

#include "base/list.h"

#include <string.h>

int32_t space_master(const space *s, int32_t node)
{
    while (s->mesh->master && s->mesh->master[node] != node)
        node = s->mesh->master[node];
    return node;
}

int64_t space_groups(const space *s)
{
    return s->mesh->n_cell + s->n_attached + s->n_link + s->n_tie;
}

int64_t space_attached_group(const space *s, int64_t attached)
{
    return s->mesh->n_cell + attached;
}

int64_t space_link_group(const space *s, int64_t link)
{
    return s->mesh->n_cell + s->n_attached + link;
}

int64_t space_tie_group(const space *s, int64_t tie)
{
    return s->mesh->n_cell + s->n_attached + s->n_link + tie;
}

int space_group_size(const space *s, int64_t group)
{
    if (group < space_link_group(s, 0))
        return s->cell_carriers;
    return group < space_tie_group(s, 0) ? 2 : 2 * s->mesh->type->n_node;
}

int32_t space_body_carrier(const space *s, int body)
{
    return body < 0 ? -1 : (int32_t)s->mesh->n_node + 1 + body;
}

/* Carrier i of a cell, attached to a body or not (-1). */
static int32_t cell_carrier(const space *s, int64_t cell, int body, int i)
{
    const mesh *m = s->mesh;

    if (i < m->type->n_node)
        return space_master(s, m->cell[cell * m->type->n_node + i]);
    if (i == m->type->n_node && s->any_problem)
        return (int32_t)m->n_node;
    return space_body_carrier(s, body);
}

int32_t space_carrier(const space *s, int64_t group, int i)
{
    const mesh *m = s->mesh;
    int64_t k = group - m->n_cell;
    int n = m->type->n_node;

    if (k < 0)
        return cell_carrier(s, group, -1, i);
    if (k < s->n_attached)
        return cell_carrier(s, s->attached_cell[k], s->attached_particle[k], i);
    k -= s->n_attached;
    if (k < s->n_link)
        return space_body_carrier(s, s->link[k][i]);
    return cell_carrier(s, s->tie[k - s->n_link][i / n], -1, i % n);
}

int64_t space_pair_offset(const space *s, int64_t group)
{
    int64_t cell = (int64_t)s->cell_carriers * s->cell_carriers, n = s->mesh->type->n_node;
    int64_t plain = space_link_group(s, 0), links = space_tie_group(s, 0);

    if (group < plain)
        return group * cell;
    if (group < links)
        return plain * cell + (group - plain) * 4;
    return plain * cell + s->n_link * 4 + (group - links) * 4 * n * n;
}

const int32_t *space_pair(const space *s, int64_t group)
{
    return s->pair + space_pair_offset(s, group);
}

int space_attach(space *s, const int32_t *cell, const int32_t *body, int64_t n, error *err)
{
    arena_free(&s->attached_memory);
    s->n_attached = s->n_link = s->n_tie = 0;
    if (n >= INT32_MAX) /* placements number them with 32 bits */
        return error_set(err, ERR_CASE, "bodies are near %.3g cells, at most %.3g are possible", (double)n,
                         (double)INT32_MAX);
    ARENA_NEW(&s->attached_memory, s->attached_cell, n + 1, err);
    ARENA_NEW(&s->attached_memory, s->attached_particle, n + 1, err);
    memcpy(s->attached_cell, cell, (size_t)n * sizeof *cell);
    memcpy(s->attached_particle, body, (size_t)n * sizeof *body);
    s->n_attached = n;
    for (int64_t d = 0; d < s->n_dof; d++) {
        int restricted = s->field[s->dof_field[d]].support == PF_IN_PARTICLES;

        s->fixed[d] = (uint8_t)((s->fixed[d] & SPACE_PRESCRIBED) | (restricted ? SPACE_AWAY : 0));
    }
    for (int f = 0; f < s->n_field; f++)
        for (int64_t a = 0; s->field[f].support == PF_IN_PARTICLES && a < n; a++)
            for (int i = 0; i < s->mesh->type->n_node; i++) {
                int64_t d = s->first[f][space_carrier(s, space_attached_group(s, a), i)];

                for (int c = 0; d >= 0 && c < s->field[f].n_comp; c++)
                    s->fixed[d + c] &= SPACE_PRESCRIBED;
            }
    return 0;
}

int space_add_link(space *s, int a, int b, error *err)
{
    LIST_ROOM(s->link, s->n_link, &s->link_room, err);
    s->link[s->n_link][0] = a;
    s->link[s->n_link++][1] = b;
    return 0;
}

int space_add_tie(space *s, int32_t bad, int32_t root, error *err)
{
    LIST_ROOM(s->tie, s->n_tie, &s->tie_room, err);
    s->tie[s->n_tie][0] = bad;
    s->tie[s->n_tie++][1] = root;
    return 0;
}
