/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Items of the classes that follow the bodies: which cells, pieces of surface, ties and pairs there are now. */
#include "assemble/batch.h"

int items_room(assembly_class *c, int64_t n, arena *memory, error *err)
{
    c->n_item = n;
    ARENA_NEW(memory, c->cell, n + 1, err);
    ARENA_NEW(memory, c->facet, n + 1, err);
    ARENA_NEW(memory, c->group, n + 1, err);
    ARENA_NEW(memory, c->source, n + 1, err);
    for (int64_t i = 0; i < n; i++)
        c->source[i] = (int32_t)i;
    return 0;
}

int items_order(assembly *a, assembly_class *c, arena *memory, error *err)
{
    TRY(slabs_make(a, c, memory, err));
    c->wall_ready = 0;
    TRY(layout_items(a, c, memory, err));
    TRY(fresh_find(a, c, memory, err));
    return inputs_room(memory, c, err);
}

static int renew_items(assembly_class *c, int64_t n, error *err)
{
    arena_free(&c->item_memory);
    return items_room(c, n, &c->item_memory, err);
}

/* Items of the classes that follow the bodies, one function for each kind of points. */
static int set_pairs(assembly_class *c, const body_points *b, error *err)
{
    TRY(renew_items(c, b->n_pair, err));
    c->pair = b->pair;
    for (int64_t i = 0; i < b->n_pair; i++)
        c->group[i] = b->pair[i].group;
    return 0;
}

/* The problem and each body stand together in the group of any cell near the body. */
static int set_bodies(const space *s, assembly_class *c, error *err)
{
    int64_t n = 0;

    TRY(renew_items(c, s->n_particle, err));
    for (int64_t i = 0; i < s->n_attached && n < s->n_particle; i++)
        if (s->attached_particle[i] == n) { /* the pairs of a body lie together, in the order of the bodies */
            c->cell[n] = s->attached_cell[i];
            c->group[n++] = space_attached_group(s, i);
        }
    return n == s->n_particle ? 0 : error_set(err, ERR_CONVERGE, "particle %d has no cell near it", (int)n);
}

static int set_solid(const space *s, assembly_class *c, const body_points *b, error *err)
{
    TRY(renew_items(c, b->n_solid, err));
    c->weight = b->solid_weight;
    for (int64_t i = 0; i < b->n_solid; i++) {
        c->cell[i] = s->attached_cell[b->solid[i]];
        c->group[i] = space_attached_group(s, b->solid[i]);
    }
    return 0;
}

static int set_cut(assembly_class *c, const body_points *b, error *err)
{
    TRY(renew_items(c, b->n_cut, err));
    c->weight = b->cut_weight;
    for (int64_t i = 0; i < b->n_cut; i++)
        c->group[i] = c->cell[i] = b->cut[i];
    return 0;
}

static int set_surface(const space *s, assembly_class *c, const body_points *b, error *err)
{
    TRY(renew_items(c, b->n_surface, err));
    c->weight = b->surface_weight;
    c->ref = b->surface_ref;
    c->normal = b->surface_normal;
    for (int64_t i = 0; i < b->n_surface; i++) {
        c->cell[i] = s->attached_cell[b->surface[i]];
        c->group[i] = space_attached_group(s, b->surface[i]);
    }
    return 0;
}

static int set_ties(assembly_class *c, const body_points *b, error *err)
{
    TRY(renew_items(c, b->n_tie, err));
    c->weight = b->tie_weight;
    c->ref = b->tie_ref;
    for (int64_t i = 0; i < b->n_tie; i++) {
        c->cell[i] = b->tie_cell[i];
        c->group[i] = b->tie[i];
    }
    return 0;
}

int items_take(assembly *a, const body_points *b, error *err)
{
    a->bodies = b;
    a->idle = b ? b->idle : a->none_idle;
    if (!b || b->stamp == a->bodies_stamp)
        return 0;
    a->bodies_stamp = 0; /* until all is taken */
    for (int k = 0; k < a->n_class; k++) {
        assembly_class *c = &a->class_[k];

        if (c->where == PF_PAIR)
            TRY(set_pairs(c, b, err));
        else if (c->where == PF_PARTICLE)
            TRY(set_bodies(a->space, c, err));
        else if (c->where == PF_SOLID)
            TRY(set_solid(a->space, c, b, err));
        else if (c->where == PF_FLUID && c->follows)
            TRY(set_cut(c, b, err));
        else if (c->where == PF_FLUID)
            c->off = b->off;
        else if (c->where == PF_SURFACE)
            TRY(set_surface(a->space, c, b, err));
        else if (c->where == PF_CUT)
            TRY(set_ties(c, b, err));
        if (c->follows)
            TRY(items_order(a, c, &c->item_memory, err));
    }
    a->bodies_stamp = b->stamp;
    return 0;
}
