/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The envelope: cells within a margin of a body are attached to it.  Their nodes couple with its velocity, and the
 * matrix has room for restricted unknowns (multipliers) at them, and for ties of neighbours among them.  While each
 * body stays within the margin only weights and flags change; beyond, cells are attached anew, and the pattern of
 * the matrix is another one. */
#include "body/body.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Margins of the attached cells, in sizes of a cell; no round numbers: bodies often lie along the lines of the
 * mesh. The narrow one where restricted unknowns at all of them would make the matrix larger, and where bodies are
 * near to more than a part of all cells: some new tie changes the pattern in every step then, and room for all of
 * them would make it much larger. */
#define MARGIN 3.57
#define NARROW 1.07
#define FEW    0.2
/* Attached cells that have the points of cut ones, though no body covers any of them: those so near, or all within
 * the narrow margin.  With a ring of 0.27 what changes the points shows as an error of the step, and steps that
 * choose their length become a third as long. */
#define RING 1.07
/* What of the margin a body needs for the cells that it is near to. */
#define NEEDED        (RING + 0.05)
#define NEEDED_NARROW (0.05 * NARROW)

/* Cells that share a facet with e, by the nodes that they have in common with it; `of` lists the cells at nodes. */
static void find_neighbours(const space *s, const int64_t *start, const int32_t *of, int64_t e, uint8_t *common,
                            int32_t *list)
{
    const fe_cell *c = s->mesh->type;
    int n = 0;

    for (int k = 0; k < 6; k++)
        list[k] = -1;
    for (int pass = 0; pass < 2; pass++)
        for (int i = 0; i < c->n_node; i++) {
            int32_t node = space_carrier(s, e, i);

            for (int64_t k = start[node]; k < start[node + 1]; k++) {
                common[of[k]] = pass ? 0 : (uint8_t)(common[of[k]] + 1);
                if (!pass && of[k] != e && common[of[k]] == c->facet_nodes && n < 6)
                    list[n++] = of[k];
            }
        }
}

int envelope_create(bodies *b, error *err)
{
    const space *s = b->space;
    const mesh *m = s->mesh;
    arena scratch = {0};
    int64_t *start;
    int32_t *of;
    uint8_t *common;

    for (int f = 0; f < s->n_field; f++)
        b->envelope.restricted |= s->field[f].support == PF_IN_PARTICLES;
    ARENA_NEW(&b->memory, b->envelope.first_tie, m->n_cell, err);
    if (!b->has_ties)
        return 0;
    ARENA_NEW(&b->memory, b->envelope.neighbour, m->n_cell, err);
    start = arena_alloc(&scratch, (size_t)m->n_node + 2, sizeof *start);
    of = arena_alloc(&scratch, (size_t)(m->n_cell * m->type->n_node), sizeof *of);
    common = arena_alloc(&scratch, (size_t)m->n_cell, 1);
    if (!start || !of || !common) {
        arena_free(&scratch);
        return error_memory(err, "neighbours of cells", 4.0 * (double)m->n_cell * m->type->n_node);
    }
    for (int64_t e = 0; e < m->n_cell; e++)
        for (int i = 0; i < m->type->n_node; i++)
            start[space_carrier(s, e, i) + 2]++;
    for (int64_t k = 0; k < m->n_node; k++)
        start[k + 1] += start[k];
    for (int64_t e = 0; e < m->n_cell; e++)
        for (int i = 0; i < m->type->n_node; i++)
            of[start[space_carrier(s, e, i) + 1]++] = (int32_t)e;
    for (int64_t e = 0; e < m->n_cell; e++)
        find_neighbours(s, start, of, e, common, b->envelope.neighbour[e]);
    arena_free(&scratch);
    return 0;
}

int envelope_holds(const bodies *b, const pose *at)
{
    const double needed = b->envelope.margin == NARROW ? NEEDED_NARROW : NEEDED;

    if (!b->envelope.stamp)
        return 0;
    for (int k = 0; k < b->n; k++) {
        double d = 0;

        for (int i = 0; i < b->space->mesh->dim; i++)
            d += pow(at[k].x[i] - b->envelope.centre[k][i], 2);
        if (sqrt(d) > (b->envelope.margin - needed) * b->h_mean)
            return 0;
    }
    return 1;
}

int envelope_near(const bodies *b, const placement *p, int64_t attached, double margin)
{
    const double(*box)[3] = (const double(*)[3])b->grid->box[b->space->attached_cell[attached]];
    const solid *body = &p->body[b->space->attached_particle[attached]];
    double reach = body->shape->radius + margin * b->h_mean, d = 0;

    for (int i = 0; i < b->space->mesh->dim; i++) {
        double x = body->at.x[i] + b->envelope.shift[attached][i],
               off = fmax(fmax(box[0][i] - x, x - box[1][i]), 0);

        d += off * off;
    }
    return d <= reach * reach;
}

/* Entries for ties of attached cells with their neighbours.  Not in 3D, where they would make the matrix larger by
 * a third to a half, and hardly any is factored. */
static int spare_ties(bodies *b, error *err)
{
    space *s = b->space;
    int32_t *done = b->near_cell; /* [n_cell] */

    if (!b->has_ties || b->envelope.margin < MARGIN || s->mesh->dim == 3)
        return 0;
    memset(done, 0, (size_t)s->mesh->n_cell * sizeof *done);
    for (int64_t a = 0; a < s->n_attached; a++) {
        int32_t e = s->attached_cell[a];

        for (int k = 0; !done[e] && k < 6 && b->envelope.neighbour[e][k] >= 0; k++)
            if (!done[b->envelope.neighbour[e][k]])
                TRY(space_add_spare(s, e, b->envelope.neighbour[e][k], err));
        done[e] = 1;
    }
    return 0;
}

/* Lists the pairs of cell and body, by body and image; the shift of each to e->shift.  Without lists: counts them.
 */
static int64_t list_pairs(bodies *b, const pose *at, int32_t *cell, int32_t *body)
{
    int64_t n = 0;

    for (int k = 0; k < b->n; k++)
        for (int j = 0; j < b->n_image; j++) {
            double x[3] = {at[k].x[0] + b->image[j][0], at[k].x[1] + b->image[j][1], at[k].x[2] + b->image[j][2]};
            int64_t here =
                cell_grid_ball(b->grid, x, b->spec[k].shape.radius + b->envelope.margin * b->h_mean, b->near_cell);

            for (int64_t i = 0; cell && i < here; i++) {
                cell[n + i] = b->near_cell[i];
                body[n + i] = k;
                memcpy(b->envelope.shift[n + i], b->image[j], sizeof b->image[j]);
            }
            n += here;
        }
    return n;
}

int envelope_attach(bodies *b, const pose *at, error *err)
{
    envelope *e = &b->envelope;
    arena scratch = {0};
    int32_t *cell, *body;
    int64_t n;
    int status;

    e->margin = e->restricted ? NARROW : MARGIN;
    n = list_pairs(b, at, NULL, NULL);
    b->space->crowded = n > FEW * (double)b->space->mesh->n_cell;
    if (b->space->crowded) {
        e->margin = NARROW;
        n = list_pairs(b, at, NULL, NULL);
    }
    e->ring = e->margin == NARROW ? INFINITY : RING;
    arena_free(&e->memory);
    ARENA_NEW(&e->memory, e->centre, b->n, err);
    ARENA_NEW(&e->memory, e->shift, n + 1, err);
    for (int k = 0; k < b->n; k++)
        memcpy(e->centre[k], at[k].x, sizeof e->centre[k]);
    for (int64_t i = 0; i < b->space->mesh->n_cell; i++)
        e->first_tie[i] = -1;
    ARENA_NEW(&scratch, cell, n + 1, err);
    body = arena_alloc(&scratch, (size_t)n + 1, sizeof *body);
    if (body)
        list_pairs(b, at, cell, body);
    status =
        body ? space_attach(b->space, cell, body, n, err) : error_memory(err, "attached cells", 4.0 * (double)n);
    arena_free(&scratch);
    TRY(status);
    TRY(pairs_link(b, at, 2 * b->envelope.margin * b->h_mean, err));
    TRY(spare_ties(b, err));
    e->stamp++;
    e->made++;
    return 0;
}
