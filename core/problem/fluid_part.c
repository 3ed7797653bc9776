/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The part of the mesh that the bodies leave to the fluid: weights of cut cells, pieces of surface, cells
 * with too little fluid and the roots that they are tied to, unknowns without any fluid.
 *
 * A cell is bad if less than half of it is fluid (or none, but a piece of surface).  Its root is the
 * nearest cell that is not bad; of equidistant ones that further out of the body; if that leaves several,
 * they share the tie, or a symmetric body would drift (numerics 5).  Ties couple the nodes of two cells: the matrix
 * keeps room for those that it has met since cells were attached to the bodies, so that it rarely changes. */
#include "problem/problem.h"

#include "space/locate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define GOOD 0.5 /* fraction of a cell */
/* Distances in h: squares nearer than that are equal; what a cell one h further out gains. */
#define TIED    1e-6
#define OUTWARD 1e-3

/* Doubles the room of a list that has n entries. */
static int grow(void **list, int64_t n, int64_t *room, size_t size, error *err)
{
    void *more;

    if (n < *room)
        return 0;
    more = realloc(*list, (size_t)(2 * n + 64) * size);
    if (!more)
        return error_memory(err, "bodies", (double)(2 * n + 64) * (double)size);
    *list = more;
    *room = 2 * n + 64;
    return 0;
}

/* --- weights --- */

/* Enters a cell, with the weights of all of it unless a body covers it (fluid_off = 2). */
static int enter(problem *p, int32_t cell, int64_t attached, error *err)
{
    TRY(grow((void **)&p->off_cell, p->n_off, &p->off_room, sizeof *p->off_cell, err));
    p->off_cell[p->n_off++] = cell;
    p->covered_by[cell] = (int32_t)attached;
    if (p->fluid_off[cell])
        return 0;
    p->fluid_off[cell] = 1;
    p->cut_of[cell] = (int32_t)p->n_cut;
    p->cut_cell[p->n_cut] = cell;
    memcpy(p->cut_weight + p->n_cut++ * p->cut.n, p->cut.whole, (size_t)p->cut.n * sizeof *p->cut_weight);
    return 0;
}

int fluid_weights(problem *p, error *err)
{
    const space *s = &p->space;
    int n = p->cut.n;

    for (int64_t k = 0; k < p->n_off; k++)
        p->fluid_off[p->off_cell[k]] = 0;
    p->n_cut = p->n_off = 0;
    for (int64_t k = 0; k < p->n_covered; k++)
        if (p->whole_inside[k])
            p->fluid_off[s->attached_cell[p->covered[k]]] = 2;
    for (int64_t k = 0; k < p->n_covered; k++) {
        int32_t e = s->attached_cell[p->covered[k]];

        TRY(enter(p, e, p->covered[k], err));
        for (int q = 0; p->fluid_off[e] == 1 && q < n; q++)
            p->cut_weight[p->cut_of[e] * n + q] -= p->weight[k * n + q];
    }
    /* The other cells near bodies get the same points: a body that touches a cell must not matter by their number.
     */
    for (int64_t a = 0; a < s->n_attached; a++)
        if (!p->fluid_off[s->attached_cell[a]])
            TRY(enter(p, s->attached_cell[a], a, err));
    return 0;
}

double fluid_fraction(const problem *p, int32_t cell)
{
    double sum = 0;

    if (p->fluid_off[cell] != 1)
        return p->fluid_off[cell] ? 0 : 1;
    for (int q = 0; q < p->cut.n; q++)
        sum += p->cut_weight[p->cut_of[cell] * p->cut.n + q];
    return sum / p->mesh.type->measure;
}

const fe_rule *problem_points(const problem *p, int field, int64_t cell, const fe_rule *whole, fe_rule *own)
{
    if (p->n_particle == 0 || !p->fluid_only[field] || !p->fluid_off[cell])
        return whole;
    own->n = p->fluid_off[cell] == 1 ? p->cut.n : 0;
    for (int q = 0; q < own->n; q++) {
        memcpy(own->x[q], p->cut.x[q], sizeof own->x[q]);
        own->w[q] = p->cut_weight[p->cut_of[cell] * p->cut.n + q];
    }
    return own;
}

/* --- pieces of surface --- */

void fluid_add_surface(void *problem_, const double *xi, const double *x, const double *nds)
{
    problem *p = problem_;
    surface_list *s = &p->surface;
    int64_t at = s->n * SURFACE_POINTS + s->n_last;
    double size = 0;

    (void)x;
    for (int k = 0; k < p->dim; k++)
        size += nds[k] * nds[k];
    size = sqrt(size);
    if (!(size > 0) || s->failed)
        return;
    if (s->n_last == 0) {
        int64_t room[3] = {s->room, s->room, s->room}, points = SURFACE_POINTS;
        error ignored;

        s->failed = grow((void **)&s->attached, s->n, &s->room, sizeof *s->attached, &ignored) ||
                    grow((void **)&s->ref, s->n, &room[0], sizeof *s->ref * points, &ignored) ||
                    grow((void **)&s->normal, s->n, &room[1], sizeof *s->normal * points, &ignored) ||
                    grow((void **)&s->weight, s->n, &room[2], sizeof *s->weight * points, &ignored);
        if (s->failed)
            return;
        s->attached[s->n] = s->now;
        memset(s->weight + at, 0, SURFACE_POINTS * sizeof *s->weight);
    }
    for (int i = s->n_last; i < SURFACE_POINTS; i++) /* what is not overwritten fills up */
        for (int k = 0; k < 3; k++) {
            s->ref[s->n * SURFACE_POINTS + i][k] = k < p->dim ? xi[k] : 0;
            s->normal[s->n * SURFACE_POINTS + i][k] = k < p->dim ? -nds[k] / size : 0; /* out of the fluid */
        }
    s->weight[at] = size;
    if (++s->n_last == SURFACE_POINTS)
        fluid_end_surface(p);
}

void fluid_end_surface(problem *p)
{
    p->surface.n += p->surface.n_last > 0;
    p->surface.n_last = 0;
}

/* --- ties --- */

static void centre_of(const problem *p, int32_t cell, double *x)
{
    const fe_cell *c = p->mesh.type;

    memset(x, 0, 3 * sizeof *x);
    for (int i = 0; i < c->n_vertex; i++)
        for (int k = 0; k < p->dim; k++)
            x[k] += p->mesh.x[(int64_t)p->mesh.cell[(int64_t)cell * c->n_node + c->vertex[i]] * p->dim + k] /
                    c->n_vertex;
}

/* Appends a group of carriers; its number. */
int fluid_add_group(problem *p, const int32_t *carrier, int n, error *err)
{
    space *s = &p->space;

    TRY(grow((void **)&s->extra_first, s->n_extra + 1, &p->extra_room[0], sizeof *s->extra_first, err));
    s->extra_first[0] = 0;
    for (int i = 0; i < n; i++) {
        int64_t at = s->extra_first[s->n_extra] + i;

        TRY(grow((void **)&s->extra_carrier, at, &p->extra_room[1], sizeof *s->extra_carrier, err));
        s->extra_carrier[at] = carrier[i];
    }
    s->extra_first[s->n_extra + 1] = s->extra_first[s->n_extra] + n;
    s->n_extra++;
    return 0;
}

/* The group of the nodes of both cells; met for the first time: *fresh. */
static int group_of(problem *p, int32_t bad, int32_t root, int64_t *group, int *fresh, error *err)
{
    const fe_cell *c = p->mesh.type;
    tie_list *t = &p->tie;
    int32_t carrier[2 * FE_MAX_NODES];
    int64_t k = t->first[bad];

    while (k >= 0 && t->root[k] != root)
        k = t->next[k];
    if (k < 0) {
        int64_t room = t->known_room;

        TRY(grow((void **)&t->root, t->n_known, &room, sizeof *t->root, err));
        TRY(grow((void **)&t->next, t->n_known, &t->known_room, sizeof *t->next, err));
        k = t->n_known++;
        t->root[k] = root;
        t->next[k] = t->first[bad];
        t->first[bad] = (int32_t)k;
        for (int i = 0; i < c->n_node; i++) {
            carrier[i] = space_carrier(&p->space, bad, i);
            carrier[c->n_node + i] = space_carrier(&p->space, root, i);
        }
        TRY(fluid_add_group(p, carrier, 2 * c->n_node, err));
        *fresh = 1;
    }
    *group = p->mesh.n_cell + p->space.n_attached + p->n_link + k;
    return 0;
}

typedef struct candidate {
    int32_t cell;
    double distance, shift[3]; /* distance: squared, in h, less what it gains by lying further out */
} candidate;

/* Unit vector out of the body at the centre of a bad cell. */
static void outward(const problem *p, int32_t bad, const double *x, double *n)
{
    particle image = problem_image(p, p->covered_by[bad]);
    solid here = solid_at(&image.shape, &image.at);
    double size = 0;

    solid_slope(&here, x, n);
    for (int k = 0; k < p->dim; k++)
        size += n[k] * n[k];
    for (int k = 0; k < p->dim; k++)
        n[k] /= size > 0 ? sqrt(size) : 1;
}

/* Cells that are not bad within reach of the centre of a bad one, by its images; n of the list. */
static int candidates(problem *p, int32_t bad, double reach, candidate *list, int most)
{
    double x[3], c[3], out[3] = {0}, h = p->mesh.h[bad];
    int n = 0;

    centre_of(p, bad, x);
    outward(p, bad, x, out);
    for (int i = 0; i < p->n_image; i++) {
        double at[3] = {x[0] + p->image[i][0], x[1] + p->image[i][1], x[2] + p->image[i][2]};
        int64_t found = cell_grid_ball(&p->grid, at, reach, p->near_cell);

        for (int64_t k = 0; k < found && n < most; k++) {
            double d = 0, gain = 0;

            if (p->near_cell[k] == bad || fluid_fraction(p, p->near_cell[k]) < GOOD)
                continue;
            centre_of(p, p->near_cell[k], c);
            for (int a = 0; a < p->dim; a++) {
                d += (c[a] - at[a]) * (c[a] - at[a]);
                gain += OUTWARD * h * (c[a] - at[a]) * out[a];
            }
            if (d > reach * reach)
                continue;
            list[n] = (candidate){.cell = p->near_cell[k], .distance = (d - gain) / (h * h)};
            memcpy(list[n++].shift, p->image[i], sizeof p->image[i]);
        }
    }
    return n;
}

/* Ties one bad cell to the nearest of the candidates; how many there are. */
static int tie_cell(problem *p, int32_t bad, const fe_rule *rule, int *fresh, error *err)
{
    static const double reach[] = {1.2, 1.8, 2.6, 4.1};
    candidate list[512];
    tie_list *t = &p->tie;
    double least = INFINITY, h = p->mesh.h[bad];
    int64_t first = t->n;
    int n = 0;

    for (int k = 0; k < 4 && n == 0; k++)
        n = candidates(p, bad, reach[k] * h, list, 512);
    for (int i = 0; i < n; i++)
        least = fmin(least, list[i].distance);
    for (int i = 0; i < n; i++) {
        int64_t room[3] = {t->room, t->room, t->room}, at;
        int ok = 1;

        if (list[i].distance > least + TIED)
            continue;
        TRY(grow((void **)&t->ref, t->n, &room[0], sizeof *t->ref * (size_t)rule->n, err));
        TRY(grow((void **)&t->weight, t->n, &room[1], sizeof *t->weight, err));
        TRY(grow((void **)&t->cell, t->n, &room[2], sizeof *t->cell, err));
        TRY(grow((void **)&t->group, t->n, &t->room, sizeof *t->group, err));
        at = t->n;
        for (int q = 0; q < rule->n && ok; q++) {
            double b[FE_MAX_NODES], db[FE_MAX_NODES][3], x[3], j[3][3];

            fe_basis(p->mesh.type, 2, rule->x[q], b, db);
            mesh_map(&p->mesh, bad, b, (const double(*)[3])db, x, j);
            for (int a = 0; a < p->dim; a++)
                x[a] += list[i].shift[a];
            ok = locate_in_cell(&p->mesh, list[i].cell, x, t->ref[at * rule->n + q]) >= 0;
        }
        if (!ok)
            continue;
        t->cell[at] = bad;
        TRY(group_of(p, bad, list[i].cell, &t->group[at], fresh, err));
        t->n++;
    }
    for (int64_t i = first; i < t->n; i++)
        t->weight[i] = 1.0 / (double)(t->n - first);
    t->n_rootless += t->n == first;
    return 0;
}

int fluid_ties(problem *p, int *fresh, error *err)
{
    fe_rule rule;

    TRY(fe_rule_cell(p->mesh.type, ASSEMBLE_CELL_DEGREE, &rule, err));
    p->tie.n = p->tie.n_rootless = 0;
    for (int64_t i = 0; i < p->surface.n; i++) { /* a piece of surface in a cell without fluid keeps it active */
        int32_t e = p->space.attached_cell[p->surface.attached[i]];

        if (p->fluid_off[e] == 2)
            p->fluid_off[e] = 3;
    }
    for (int64_t i = 0; i < p->n_cut; i++)
        if (fluid_fraction(p, p->cut_cell[i]) < GOOD)
            TRY(tie_cell(p, p->cut_cell[i], &rule, fresh, err));
    for (int64_t i = 0; i < p->n_off; i++)
        if (p->fluid_off[p->off_cell[i]] == 3) {
            TRY(tie_cell(p, p->off_cell[i], &rule, fresh, err));
            p->fluid_off[p->off_cell[i]] = 4; /* tied, and active */
        }
    return 0;
}

/* --- unknowns without fluid --- */

static int is_active(const problem *p, int32_t cell)
{
    return p->fluid_off[cell] != 2;
}

/* Which fields have equations in the fluid only: there is none for them where there is no fluid. */
static void find_fields(problem *p)
{
    for (int i = 0; i < p->n_use; i++)
        for (uint32_t o = 0; o < p->use[i].term->n_out; o++) {
            int f = space_find_field(&p->space, p->use[i].term->out[o].field), where = p->use[i].where;

            if (f >= 0 && p->space.field[f].order > 0) {
                p->fluid_only[f] |= where == PF_FLUID ? 1 : 0;
                p->fluid_only[f] |= where == PF_CELL || where == PF_SOLID ? 2 : 0;
            }
        }
    for (int f = 0; f < p->space.n_field; f++) {
        p->fluid_only[f] = p->fluid_only[f] == 1;
        p->any_fluid_only |= p->fluid_only[f];
    }
}

void fluid_activate(problem *p, double *x)
{
    space *s = &p->space;
    const fe_cell *c = p->mesh.type;

    for (int active = 0; active < 2; active++)
        for (int64_t a = 0; a < s->n_attached; a++)
            for (int i = 0; i < c->n_node && is_active(p, s->attached_cell[a]) == active; i++)
                for (int f = 0; f < s->n_field; f++) {
                    int64_t d = p->fluid_only[f] ? s->first[f][space_carrier(s, p->mesh.n_cell + a, i)] : -1;

                    for (int k = 0; d >= 0 && k < s->field[f].n_comp; k++) {
                        s->idle[d + k] = !active;
                        if (!active && s->field[f].n_comp == 1)
                            x[d + k] = 0;
                    }
                }
}

void fluid_forget(problem *p)
{
    p->tie.n_known = 0;
    for (int64_t e = 0; e < p->mesh.n_cell; e++)
        p->tie.first[e] = -1;
    for (int64_t d = 0; d < p->space.n_dof; d++)
        if (p->fluid_only[p->space.dof_field[d]])
            p->space.idle[d] = 0;
}

int fluid_create(problem *p, error *err)
{
    ARENA_NEW(&p->memory, p->fluid_off, p->mesh.n_cell, err);
    ARENA_NEW(&p->memory, p->cut_of, p->mesh.n_cell, err);
    ARENA_NEW(&p->memory, p->covered_by, p->mesh.n_cell, err);
    ARENA_NEW(&p->memory, p->tie.first, p->mesh.n_cell, err);
    ARENA_NEW(&p->memory, p->near_cell, p->mesh.n_cell, err);
    ARENA_NEW(&p->memory, p->filled, p->space.n_carrier, err);
    find_fields(p);
    for (int i = 0; i < p->n_use; i++) {
        p->has_surface |= p->use[i].where == PF_SURFACE;
        p->has_ties |= p->use[i].where == PF_CUT;
    }
    return 0;
}

void fluid_destroy(problem *p)
{
    free(p->off_cell);
    free(p->surface.attached);
    free(p->surface.ref);
    free(p->surface.normal);
    free(p->surface.weight);
    free(p->tie.cell);
    free(p->tie.group);
    free(p->tie.weight);
    free(p->tie.ref);
    free(p->tie.root);
    free(p->tie.next);
    free(p->space.extra_first);
    free(p->space.extra_carrier);
}
