/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What bodies leave of the cells near them: the weights of the part outside of all bodies.
 *
 * Cells near bodies get the points of cut ones even if none covers any of them: that a surface just touches a cell
 * must not matter by the number of points. */
#include "body/body.h"

#include "space/evaluate.h"

#include <string.h>

/* Enters a cell, with the weights of all of it unless a body covers it. */
static void enter(const bodies *b, placement *p, int32_t cell, int64_t attached)
{
    int listed = p->covered_by[cell] >= 0;

    p->covered_by[cell] = (int32_t)attached;
    if (listed)
        return;
    p->near_cell[p->n_near++] = cell;
    if (p->cover[cell])
        return;
    p->cover[cell] = COVER_PART;
    p->cut_of[cell] = (int32_t)p->n_cut;
    p->cut_cell[p->n_cut] = cell;
    memcpy(p->cut_weight + p->n_cut++ * b->cut.n, b->cut.whole, (size_t)b->cut.n * sizeof *p->cut_weight);
}

int share_weights(const bodies *b, placement *p, error *err)
{
    const space *s = b->space;
    int64_t n_cell = s->mesh->n_cell;
    int n = b->cut.n;

    ARENA_NEW(&p->memory, p->cover, n_cell, err);
    ARENA_NEW(&p->memory, p->cut_of, n_cell, err);
    ARENA_NEW(&p->memory, p->covered_by, n_cell, err);
    ARENA_NEW(&p->memory, p->near_cell, s->n_attached + 1, err);
    ARENA_NEW(&p->memory, p->cut_cell, s->n_attached + 1, err);
    ARENA_NEW(&p->memory, p->cut_weight, s->n_attached * n + 1, err);
    memset(p->covered_by, 0xff, (size_t)n_cell * sizeof *p->covered_by); /* -1 */
    for (int64_t k = 0; k < p->n_covered; k++)
        if (p->covers_all[k])
            p->cover[s->attached_cell[p->covered[k]]] = COVER_WHOLE;
    for (int64_t k = 0; k < p->n_covered; k++) {
        int32_t e = s->attached_cell[p->covered[k]];

        enter(b, p, e, p->covered[k]);
        for (int q = 0; p->cover[e] == COVER_PART && q < n; q++)
            p->cut_weight[p->cut_of[e] * n + q] -= p->covered_weight[k * n + q];
    }
    for (int64_t a = 0; a < s->n_attached; a++)
        if (p->covered_by[s->attached_cell[a]] < 0 && envelope_near(b, p, a, b->envelope.ring))
            enter(b, p, s->attached_cell[a], a);
    return 0;
}

int share_integrals_create(bodies *b, error *err)
{
    const space *s = b->space;

    for (int f = 0; f < s->n_field; f++) {
        if (s->field[f].n_comp != 1 || s->field[f].support != PF_ON_MESH)
            continue;
        ARENA_NEW(&b->memory, b->integral[f], s->n_dof, err);
        TRY(space_integrals(s, f, ASSEMBLE_CELL_DEGREE, b->integral[f], err));
    }
    return 0;
}

int share_integrals(const bodies *b, placement *p, error *err)
{
    const space *s = b->space;
    fe_rule covered = {.n = b->cut.n};

    memcpy(covered.x, b->cut.x, (size_t)b->cut.n * sizeof *b->cut.x);
    for (int f = 0; f < s->n_field; f++) {
        if (!b->integral[f])
            continue;
        ARENA_NEW(&p->memory, p->integral[f], s->n_dof, err);
        memcpy(p->integral[f], b->integral[f], (size_t)s->n_dof * sizeof *p->integral[f]);
        for (int64_t k = 0; k < p->n_near; k++) {
            int32_t e = p->near_cell[k];

            for (int q = 0; q < covered.n; q++)
                covered.w[q] =
                    b->cut.whole[q] - (p->cover[e] == COVER_PART ? p->cut_weight[p->cut_of[e] * b->cut.n + q] : 0);
            space_integrate_basis(s, f, e, &covered, -1, p->integral[f]);
        }
    }
    return 0;
}

double share_fluid(const bodies *b, const placement *p, int32_t cell)
{
    double sum = 0;

    if (p->cover[cell] != COVER_PART)
        return p->cover[cell] ? 0 : 1;
    for (int q = 0; q < b->cut.n; q++)
        sum += p->cut_weight[p->cut_of[cell] * b->cut.n + q];
    return sum / b->space->mesh->type->measure;
}

const fe_rule *bodies_points(const bodies *b, const placement *p, int field, int64_t cell, const fe_rule *whole,
                             fe_rule *own)
{
    if (!p || !b->fluid_only[field] || !p->cover[cell])
        return whole;
    own->n = p->cover[cell] == COVER_PART ? b->cut.n : 0;
    for (int q = 0; q < own->n; q++) {
        memcpy(own->x[q], b->cut.x[q], sizeof own->x[q]);
        own->w[q] = p->cut_weight[p->cut_of[cell] * b->cut.n + q];
    }
    return own;
}

int bodies_at(const bodies *b, const placement *p, int64_t cell, const double *x, double *shift)
{
    const space *s = b->space;

    for (int64_t k = 0; k < p->n_covered; k++) {
        int32_t a = p->covered[k];
        solid here;

        if (s->attached_cell[a] != cell)
            continue;
        here = body_image(b, p, a);
        if (solid_level(&here, x) < 0) {
            if (shift)
                memcpy(shift, b->envelope.shift[a], sizeof b->envelope.shift[a]);
            return s->attached_particle[a];
        }
    }
    return -1;
}
