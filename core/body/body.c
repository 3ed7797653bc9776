/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What stays while bodies move: found once. */
#include "body/body.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Which fields have equations in the fluid only: there is none for them where there is no fluid. */
static void find_fields(bodies *b)
{
    const description *d = b->description;
    int in_fluid[SPACE_MAX_FIELDS] = {0}, elsewhere[SPACE_MAX_FIELDS] = {0};

    for (int i = 0; i < d->n_use; i++)
        for (uint32_t o = 0; o < d->use[i].term->n_out; o++) {
            const pf_slot *s = &d->use[i].term->out[o];
            int f = term_slot_field(s) ? space_find_field(b->space, s->field) : -1, where = d->use[i].where;

            if (f >= 0 && b->space->field[f].order > 0) {
                in_fluid[f] |= where == PF_FLUID;
                elsewhere[f] |= where == PF_CELL || where == PF_SOLID;
            }
        }
    for (int i = 0; i < d->n_use + d->shown.n; i++) {
        const term_use *u = i < d->n_use ? &d->use[i] : &d->shown.use[i - d->n_use];

        b->is_curved |= u->where == PF_SURFACE && u->plugin->d.min_minor >= 4;
    }
    for (int f = 0; f < b->space->n_field; f++) {
        b->fluid_only[f] = in_fluid[f] && !elsewhere[f];
        b->any_fluid_only |= b->fluid_only[f];
    }
    b->field_velocity = describe_motion(d, 0);
    b->field_spin = describe_motion(d, 1);
}

static int cut_basis(bodies *b, error *err)
{
    const fe_cell *type = b->space->mesh->type;

    ARENA_NEW(&b->memory, b->cut_basis, b->cut.n * type->n_node, err);
    for (int q = 0; q < b->cut.n; q++) {
        double ignored[FE_MAX_NODES][3];

        fe_basis(type, 2, b->cut.x[q], b->cut_basis + q * type->n_node, ignored);
    }
    return 0;
}

/* Bodies that are few cells across, by the mean size of the cells near them. */
static int warn_resolution(const bodies *b, error *err)
{
    const space *s = b->space;
    arena scratch = {0};
    double *h, worst = INFINITY;
    int64_t *n;
    int few = 0, which = 0;

    ARENA_NEW(&scratch, h, b->n, err);
    n = arena_alloc(&scratch, (size_t)b->n, sizeof *n);
    for (int64_t a = 0; n && a < s->n_attached; a++) {
        h[s->attached_particle[a]] += s->mesh->h[s->attached_cell[a]];
        n[s->attached_particle[a]]++;
    }
    for (int k = 0; n && k < b->n; k++) {
        double across = n[k] ? b->spec[k].shape.thickness * (double)n[k] / h[k] : 0;

        few += across < 3.99;
        which = across < worst ? k : which;
        worst = fmin(across, worst);
    }
    arena_free(&scratch);
    if (!n)
        return error_memory(err, "bodies", 8.0 * b->n);
    if (few == 1)
        warning_add(
            b->warnings,
            "particle %d (line %d) is %.3g wide, %.2g cells; below 4 cells across forces are off by more than a "
            "few per cent",
            which, b->spec[which].block->line, b->spec[which].shape.thickness, worst);
    else if (few > 1)
        warning_add(
            b->warnings,
            "%d of %d bodies are less than 4 cells across, the worst of them particle %d (line %d): %.3g wide, "
            "%.2g cells; their forces are off by more than a few per cent",
            few, b->n, which, b->spec[which].block->line, b->spec[which].shape.thickness, worst);
    return 0;
}

/* Whether some term reads distances from walls. */
static int wants_walls(const description *d)
{
    int wants = 0;

    for (int i = 0; i < d->n_use; i++)
        wants |= (d->use[i].term->flags & PF_WALL_DISTANCE) != 0;
    for (int i = 0; i < d->law.n; i++)
        wants |= (d->law.use[i].term->flags & PF_WALL_DISTANCE) != 0;
    for (int i = 0; i < d->shown.n; i++)
        wants |= (d->shown.use[i].term->flags & PF_WALL_DISTANCE) != 0;
    return wants;
}

int bodies_create(bodies *b, const description *d, space *s, const cell_grid *grid, const conditions *c,
                  warning_list *w, error *err)
{
    enum placement_change ignored;
    pose *start;

    memset(b, 0, sizeof *b);
    b->n = d->n_body;
    b->spec = d->body;
    b->description = d;
    b->space = s;
    b->grid = grid;
    b->conditions = c;
    b->warnings = w;
    if (b->n == 0)
        return wants_walls(d) ? pairs_find_walls(b, err) : 0;
    find_fields(b);
    b->has_surface = describe_has(d, PF_SURFACE);
    b->shows_surface = describe_shows(d, PF_SURFACE);
    b->has_ties = describe_has(d, PF_CUT);
    b->has_pairs = describe_has(d, PF_PAIR);
    for (int64_t e = 0; e < s->mesh->n_cell; e++)
        b->h_mean += s->mesh->h[e] / (double)s->mesh->n_cell;
    ARENA_NEW(&b->memory, b->density, b->n, err);
    ARENA_NEW(&b->memory, start, b->n, err);
    for (int k = 0; k < b->n; k++) {
        b->density[k] = d->body[k].density;
        start[k] = d->body[k].start;
    }
    TRY(describe_planes(d, s->mesh, b->plane, &b->n_plane, err));
    TRY(cut_rule_create(&b->cut, s->mesh->type, err));
    TRY(cut_basis(b, err));
    TRY(share_integrals_create(b, err));
    b->n_image = mesh_images(s->mesh, b->image);
    ARENA_NEW(&b->memory, b->near_cell, s->mesh->n_cell, err);
    TRY(envelope_create(b, err));
    TRY(active_create(b, err));
    TRY(paths_create(b, err));
    TRY(pairs_create(b, err));
    bodies_hold(b);
    TRY(bodies_place(b, start, &ignored, err));
    TRY(parts_check(b, err));
    return warn_resolution(b, err);
}

int bodies_check(const bodies *b, error *err)
{
    for (int k = 0; k < b->n; k++)
        TRY(shape_check(&b->spec[k].shape, err));
    return 0;
}

void bodies_destroy(bodies *b)
{
    placements_destroy(b);
    free(b->envelope.next_tie);
    if (b->has_walls)
        wall_destroy(&b->walls);
    box_grid_destroy(&b->paths.near);
    arena_free(&b->envelope.memory);
    cut_rule_destroy(&b->cut);
    arena_free(&b->memory);
    memset(b, 0, sizeof *b);
}
