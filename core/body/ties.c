/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Ties of bad cells.  A cell is bad if less than half of it is fluid (or none, but a piece of surface lies there).
 * Its root is the nearest cell that is not bad; of equidistant ones that further out of the body; if that leaves
 * several, they share the tie, or a symmetric body would drift (numerics 5).  Ties couple the nodes of two cells:
 * the pattern has entries for those of neighbours near bodies (envelope.c), and the space keeps those that it has
 * met since cells were attached to the bodies. */
#include "body/body.h"

#include "base/list.h"

#include <math.h>
#include <string.h>

enum { MOST_CANDIDATES = 64 }; /* equally near */

#define GOOD 0.5 /* fraction of a cell */
/* Of squared distances in h: what differs by less is equal; what a candidate gains for each h that it lies further
 * out of the body. */
#define TIED    1e-6
#define OUTWARD 1e-3

static void centre_of(const mesh *m, int32_t cell, double *x)
{
    const fe_cell *c = m->type;

    memset(x, 0, 3 * sizeof *x);
    for (int i = 0; i < c->n_vertex; i++)
        for (int k = 0; k < m->dim; k++)
            x[k] += m->x[(int64_t)m->cell[(int64_t)cell * c->n_node + c->vertex[i]] * m->dim + k] / c->n_vertex;
}

/* The tie of both cells in the space; *fresh: met for the first time, and the pattern has no entries for it. */
static int group_of(bodies *b, int32_t bad, int32_t root, int64_t *group, int *fresh, error *err)
{
    envelope *e = &b->envelope;
    int64_t k = e->first_tie[bad];
    int fits;

    while (k >= 0 && b->space->tie[k][1] != root)
        k = e->next_tie[k];
    if (k < 0) {
        k = b->space->n_tie;
        LIST_ROOM(e->next_tie, k, &e->next_tie_room, err);
        TRY(space_add_tie(b->space, bad, root, &fits, err));
        e->next_tie[k] = e->first_tie[bad];
        e->first_tie[bad] = (int32_t)k;
        *fresh |= !fits;
    }
    *group = space_tie_group(b->space, k);
    return 0;
}

typedef struct candidate {
    int32_t cell;
    double distance, shift[3]; /* distance: squared, in h, less what it gains by lying further out */
} candidate;

/* Unit vector out of the body at the centre of a bad cell. */
static void outward(const bodies *b, const placement *p, int32_t bad, const double *x, double *n)
{
    solid here = body_image(b, p, p->covered_by[bad]);
    int dim = b->space->mesh->dim;
    double size = 0;

    solid_slope(&here, x, n);
    for (int k = 0; k < dim; k++)
        size += n[k] * n[k];
    for (int k = 0; k < dim; k++)
        n[k] /= size > 0 ? sqrt(size) : 1;
}

/* Adds a candidate if none in the list is nearer, and drops those that it beats; 0: too many are equally near. */
static int keep_nearest(candidate *list, int *n, double *least, const candidate *c)
{
    if (c->distance > *least + TIED)
        return 1;
    if (c->distance < *least) {
        int kept = 0;

        *least = c->distance;
        for (int i = 0; i < *n; i++)
            if (list[i].distance <= *least + TIED)
                list[kept++] = list[i];
        *n = kept;
    }
    if (*n == MOST_CANDIDATES)
        return 0;
    list[(*n)++] = *c;
    return 1;
}

/* The nearest of the cells that are not bad within reach of the centre of a bad one, by its images: n of the list.
 */
static int candidates(const bodies *b, const placement *p, int32_t bad, double reach, candidate *list, int *n,
                      error *err)
{
    const mesh *m = b->space->mesh;
    double x[3], c[3], out[3] = {0}, h = m->h[bad], least = INFINITY;

    *n = 0;
    centre_of(m, bad, x);
    outward(b, p, bad, x, out);
    for (int i = 0; i < b->n_image; i++) {
        double at[3] = {x[0] + b->image[i][0], x[1] + b->image[i][1], x[2] + b->image[i][2]};
        int64_t found = cell_grid_ball(b->grid, at, reach, b->near_cell);

        for (int64_t k = 0; k < found; k++) {
            candidate one = {.cell = b->near_cell[k]};
            double d = 0, gain = 0;

            if (one.cell == bad || share_fluid(b, p, one.cell) < GOOD)
                continue;
            centre_of(m, one.cell, c);
            for (int a = 0; a < m->dim; a++) {
                d += (c[a] - at[a]) * (c[a] - at[a]);
                gain += OUTWARD * h * (c[a] - at[a]) * out[a];
            }
            if (d > reach * reach)
                continue;
            one.distance = (d - gain) / (h * h);
            memcpy(one.shift, b->image[i], sizeof one.shift);
            if (!keep_nearest(list, n, &least, &one))
                return error_set(
                    err, ERR_MESH,
                    "more than %d cells are equally near to cell %d, which a body cuts; is the mesh much "
                    "finer beside it?",
                    MOST_CANDIDATES, bad);
        }
    }
    return 0;
}

/* The points of the bad cell in the root's reference coordinates; 0 if they are not to be found. */
static int continue_points(const mesh *m, int32_t bad, const candidate *root, const fe_rule *rule, double (*ref)[3])
{
    for (int q = 0; q < rule->n; q++) {
        double n[FE_MAX_NODES], dn[FE_MAX_NODES][3], x[3], j[3][3];

        fe_basis(m->type, 2, rule->x[q], n, dn);
        mesh_map(m, bad, n, (const double(*)[3])dn, x, j);
        for (int a = 0; a < m->dim; a++)
            x[a] += root->shift[a];
        if (locate_in_cell(m, root->cell, x, ref[q]) < 0)
            return 0;
    }
    return 1;
}

/* Ties one bad cell to the nearest of the candidates. */
static int tie_cell(bodies *b, placement *p, int32_t bad, const fe_rule *rule, int *fresh, error *err)
{
    static const double reach[] = {1.2, 1.8, 2.6, 4.1};
    const mesh *m = b->space->mesh;
    candidate list[MOST_CANDIDATES];
    tie_list *t = &p->tie;
    int64_t first = t->n;
    int n = 0;

    for (int k = 0; k < 4 && n == 0; k++)
        TRY(candidates(b, p, bad, reach[k] * m->h[bad], list, &n, err));
    for (int i = 0; i < n; i++) {
        int64_t room[2] = {t->room, t->room};

        LIST_ROOM(t->ref, (t->n + 1) * rule->n, &t->ref_room, err);
        LIST_ROOM(t->weight, t->n, &room[0], err);
        LIST_ROOM(t->cell, t->n, &room[1], err);
        LIST_ROOM(t->group, t->n, &t->room, err);
        if (!continue_points(m, bad, &list[i], rule, t->ref + t->n * rule->n))
            continue;
        t->cell[t->n] = bad;
        TRY(group_of(b, bad, list[i].cell, &t->group[t->n], fresh, err));
        t->n++;
    }
    for (int64_t i = first; i < t->n; i++)
        t->weight[i] = 1.0 / (double)(t->n - first);
    t->n_rootless += t->n == first;
    return 0;
}

int ties_make(bodies *b, placement *p, int *fresh, error *err)
{
    fe_rule rule;

    TRY(fe_rule_cell(b->space->mesh->type, ASSEMBLE_CELL_DEGREE, &rule, err));
    p->tie.n_point = rule.n;
    for (int64_t i = 0; i < p->n_cut; i++)
        if (share_fluid(b, p, p->cut_cell[i]) < GOOD)
            TRY(tie_cell(b, p, p->cut_cell[i], &rule, fresh, err));
    for (int64_t i = 0; i < p->surface.n; i++) { /* a piece of surface in a cell without fluid keeps it active */
        int32_t e = b->space->attached_cell[p->surface.attached[i]];

        if (p->cover[e] == COVER_WHOLE)
            p->cover[e] = COVER_TIED;
    }
    for (int64_t i = 0; i < p->n_near; i++)
        if (p->cover[p->near_cell[i]] == COVER_TIED)
            TRY(tie_cell(b, p, p->near_cell[i], &rule, fresh, err));
    return 0;
}
