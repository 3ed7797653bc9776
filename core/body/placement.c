/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Making a placement: cut, share, ties, active set, near pairs; and the view of it that the assembly reads. */
#include "body/body.h"

#include "base/clock.h"

#include <stdlib.h>
#include <string.h>

static void placement_destroy(placement *p)
{
    if (!p)
        return;
    free(p->surface.attached);
    free(p->surface.ref);
    free(p->surface.normal);
    free(p->surface.weight);
    free(p->surface.curvature);
    free(p->tie.cell);
    free(p->tie.group);
    free(p->tie.weight);
    free(p->tie.ref);
    free(p->pair);
    arena_free(&p->memory);
    free(p);
}

/* The placement as the assembly reads it. */
static body_points view(const bodies *b, const placement *p)
{
    body_points v = {.stamp = p->stamp,
                     .body = p->body,
                     .density = b->density,
                     .idle = p->idle,
                     .shift = (const double(*)[3])b->envelope.shift,
                     .off = p->cover,
                     .n_pair = p->n_pair,
                     .pair = p->pair,
                     .pair_size = b->pair_size,
                     .pair_h = b->h_most,
                     .n_solid = p->n_covered,
                     .n_cut = p->n_cut,
                     .solid = p->covered,
                     .cut = p->cut_cell,
                     .solid_weight = p->covered_weight,
                     .cut_weight = p->cut_weight,
                     .n_surface = p->surface.n,
                     .surface = p->surface.attached,
                     .surface_ref = (const double(*)[3])p->surface.ref,
                     .surface_normal = (const double(*)[3])p->surface.normal,
                     .surface_weight = (const double *)p->surface.weight,
                     .curvature = b->is_curved ? (const double *)p->surface.curvature : NULL,
                     .n_tie = p->tie.n,
                     .tie = p->tie.group,
                     .tie_cell = p->tie.cell,
                     .tie_weight = p->tie.weight,
                     .tie_ref = (const double(*)[3])p->tie.ref};

    for (int f = 0; f < b->space->n_field; f++)
        v.integral[f] = p->integral[f];
    return v;
}

static int fill_placement(bodies *b, placement *p, const pose *at, int *fresh, error *err)
{
    p->stamp = ++b->stamp;
    ARENA_NEW(&p->memory, p->body, b->n, err);
    for (int k = 0; k < b->n; k++)
        p->body[k] = solid_at(&b->spec[k].shape, &at[k]);
    TRY(covered_cut(b, p, err));
    TRY(share_weights(b, p, err));
    TRY(share_integrals(b, p, err));
    if (b->has_ties)
        TRY(ties_make(b, p, fresh, err));
    if (p->tie.n_rootless > 0 && b->rootless++ == 0)
        warning_add(b->warnings,
                    "%lld cells with little fluid have no neighbour to be tied to (a gap narrower than a cell?); "
                    "summary.json counts how often that happens",
                    (long long)p->tie.n_rootless);
    ARENA_NEW(&p->memory, p->idle, b->space->n_dof, err);
    active_set(b, p);
    TRY(pairs_find(b, p, err));
    p->points = view(b, p);
    return 0;
}

/* Whether some body may be elsewhere than before. */
static int any_moves(const bodies *b)
{
    for (int k = 0; k < b->n; k++)
        if (b->spec[k].motion != BODY_FIXED)
            return 1;
    return 0;
}

int bodies_place(bodies *b, const pose *at, enum placement_change *change, error *err)
{
    double start = clock_seconds();
    int again = !envelope_holds(b, at), fresh = 0, status;
    placement *p;

    *change = PLACEMENT_SAME;
    if (!again && b->now && !any_moves(b))
        return 0;
    if (again)
        TRY(envelope_attach(b, at, err));
    p = calloc(1, sizeof *p);
    if (!p)
        return error_memory(err, "placement of bodies", sizeof *p);
    status = fill_placement(b, p, at, &fresh, err);
    placement_destroy(b->now);
    b->now = p;
    *change = again || fresh ? PLACEMENT_PATTERN : PLACEMENT_MOVED;
    b->patterns += *change == PLACEMENT_PATTERN;
    b->seconds += clock_seconds() - start;
    return status;
}

void placements_destroy(bodies *b)
{
    placement_destroy(b->now);
    b->now = NULL;
}
