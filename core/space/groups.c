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

int32_t space_cell_carrier(const space *s, int64_t cell)
{
    return (int32_t)(s->mesh->n_node + 1 + s->n_particle + cell);
}

int space_place(const space *s, int64_t carrier, double *x)
{
    const mesh *m = s->mesh;
    const int64_t cell = carrier - space_cell_carrier(s, 0);
    const fe_cell *c = m->type;
    double middle[3] = {0}, j[3][3];

    memset(x, 0, 3 * sizeof *x);
    if (carrier < m->n_node)
        memcpy(x, m->x + carrier * m->dim, (size_t)m->dim * sizeof *x);
    for (int i = 0; cell >= 0 && i < c->n_vertex; i++)
        for (int k = 0; k < m->dim; k++)
            middle[k] += c->x[c->vertex[i]][k] / c->n_vertex;
    if (cell >= 0)
        mesh_place(m, cell, middle, x, j);
    return carrier < m->n_node || cell >= 0;
}

/* Carrier i of a cell, attached to a body or not (-1). */
static int32_t cell_carrier(const space *s, int64_t cell, int body, int i)
{
    const mesh *m = s->mesh;

    if (i < m->type->n_node)
        return space_master(s, m->cell[cell * m->type->n_node + i]);
    if (i == m->type->n_node && s->any_problem)
        return (int32_t)m->n_node;
    if (i == m->type->n_node + s->any_problem && s->any_cell)
        return space_cell_carrier(s, cell);
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

int64_t space_more_pairs(const space *s)
{
    return s->n_attached * s->cell_carriers * s->cell_carriers + s->n_link * 4;
}

const int32_t *space_pair(const space *s, int64_t group)
{
    int64_t cell = (int64_t)s->cell_carriers * s->cell_carriers, n = s->mesh->type->n_node,
            k = group - s->mesh->n_cell;

    if (k < 0)
        return s->pair + group * cell;
    if (k < s->n_attached)
        return s->more_pair + k * cell;
    k -= s->n_attached;
    if (k < s->n_link)
        return s->more_pair + s->n_attached * cell + k * 4;
    return s->tie_pair + (k - s->n_link) * 4 * n * n;
}

int space_attach(space *s, const int32_t *cell, const int32_t *body, int64_t n, error *err)
{
    arena_free(&s->attached_memory);
    s->n_attached = s->n_link = s->n_tie = s->n_spare = 0;
    s->outdated = 1;
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

/* Where the columns of carrier j start in the rows of carrier i: found in the pattern, or -1. */
static int32_t find_offset(const space *s, int32_t i, int32_t j)
{
    int64_t row = s->row[s->node_free[i]], low = row, high = s->row[s->node_free[i] + 1];

    while (low < high) {
        int64_t middle = (low + high) / 2;

        if (space_column(s, s->node_free[i], middle) < s->node_free[j])
            low = middle + 1;
        else
            high = middle;
    }
    return low < s->row[s->node_free[i] + 1] && space_column(s, s->node_free[i], low) == s->node_free[j]
               ? (int32_t)(low - row)
               : -1;
}

/* Offsets of a tie in the pattern that there is; 0: it has no entries for it. */
static int locate_tie(const space *s, int64_t tie)
{
    int n = 2 * s->mesh->type->n_node;
    int32_t *pair = s->tie_pair + tie * n * n;

    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            int32_t a = space_carrier(s, space_tie_group(s, tie), i),
                    b = space_carrier(s, space_tie_group(s, tie), j);

            pair[i * n + j] = -1;
            if (s->node_free[a] == s->node_free[a + 1] || s->node_free[b] == s->node_free[b + 1])
                continue;
            pair[i * n + j] = find_offset(s, a, b);
            if (pair[i * n + j] < 0)
                return 0;
        }
    return 1;
}

/* The entries of a located tie are in use. */
static void claim_entries(space *s, int64_t tie)
{
    int n = 2 * s->mesh->type->n_node;
    const int32_t *pair = s->tie_pair + tie * n * n;

    for (int i = 0; s->unused && i < n; i++) {
        int32_t a = space_carrier(s, space_tie_group(s, tie), i);

        for (int j = 0; j < n; j++) {
            int32_t b = space_carrier(s, space_tie_group(s, tie), j);

            for (int64_t r = s->node_free[a]; pair[i * n + j] >= 0 && r < s->node_free[a + 1]; r++)
                memset(s->unused + s->row[r] + pair[i * n + j], 0, (size_t)(s->node_free[b + 1] - s->node_free[b]));
        }
    }
    s->claims++;
}

int space_add_tie(space *s, int32_t bad, int32_t root, int *fits, error *err)
{
    int64_t n = s->mesh->type->n_node;

    LIST_ROOM(s->tie, s->n_tie, &s->tie_room, err);
    LIST_ROOM(s->tie_pair, (s->n_tie + 1) * 4 * n * n, &s->tie_pair_room, err);
    s->tie[s->n_tie][0] = bad;
    s->tie[s->n_tie++][1] = root;
    *fits = !s->outdated && locate_tie(s, s->n_tie - 1);
    s->outdated = !*fits;
    if (*fits)
        claim_entries(s, s->n_tie - 1);
    return 0;
}

int space_add_spare(space *s, int32_t a, int32_t b, error *err)
{
    LIST_ROOM(s->spare, s->n_spare, &s->spare_room, err);
    s->spare[s->n_spare][0] = a;
    s->spare[s->n_spare++][1] = b;
    s->outdated = 1;
    return 0;
}
