/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * History near bodies that move.  At a place that a body has just left there was no fluid before: so near a body
 * du/dt is taken along a path that follows the body (arbitrary Lagrangian-Eulerian),
 *
 *     du/dt = c_0 u + sum_k c_k u^k(x - s d_k) - w . grad u,      w = -sum_k c_k s d_k,
 *
 * d_k(x): how far the point of the body that is at x now has come since then; s(x) = 1 at its surface, 0 at a
 * distance of PATHS_REACH cells and at other bodies; c_k: coefficients of the time scheme, c_0 + sum_k c_k = 0. Any
 * path through x is right; this one does not leave the fluid, and what a body carries with it is steady along it.
 */
#include "body/body.h"

#include <math.h>
#include <string.h>

#define RESTS 0.01 /* cells a step or two: less is no motion */
#define OUT   0.02 /* cells: far enough from a surface to be in a cell with fluid */

/* Cell at x, and where in it; -1: none. */
static located locate(const bodies *b, const double *x)
{
    double at[3] = {x[0], x[1], x[2]};

    mesh_wrap(b->space->mesh, at);
    return locate_point(b->space->mesh, b->grid, at);
}

/* Moves a point to where the level's gradient leads to, the surface, and OUT cells out from there (side -1: in); 0,
 * and the point stays, if there is no surface within two cells. */
static int find_surface(const moving_body *b, double h, int side, double *x)
{
    double at[3] = {x[0], x[1], x[2]};

    for (int i = 0; i < 30; i++) {
        double level = solid_level(&b->here, at), g[3] = {0}, size = 0, way = 0;
        int found = fabs(level) < 1e-10;

        solid_slope(&b->here, at, g);
        for (int k = 0; k < b->here.shape->dim; k++)
            size += g[k] * g[k];
        for (int k = 0; k < b->here.shape->dim; k++) {
            at[k] += found ? side * OUT * h * g[k] / sqrt(size) : -level * g[k] / size;
            way += (at[k] - x[k]) * (at[k] - x[k]);
        }
        if (!(size > 0) || !(way < 4 * h * h))
            return 0;
        if (found) {
            memcpy(x, at, sizeof at);
            return 1;
        }
    }
    return 0;
}

/* Cells where a path through x was.  One that leaves the mesh has to be shortened: returns by which factor, or
 * 0. */
static double locate_path(const bodies *p, const double *x, double way[PATHS_MAX_LEVELS][3], located *foot)
{
    for (double part = 1; part > 0.05; part *= 0.5) {
        int outside = 0;

        for (int l = 0; l < p->paths.levels; l++) {
            double at[3] = {x[0] - part * way[l][0], x[1] - part * way[l][1], x[2] - part * way[l][2]};

            foot[l] = locate(p, at);
            outside |= foot[l].cell < 0;
        }
        if (!outside)
            return part;
    }
    return 0;
}

/* Whether a body covered all of the cell in which `at` was found: all vertices (fluid there has no values of its
 * own). */
static int was_covered(const mesh *m, const moving_body *b, int l, const located *foot, const double *at)
{
    const fe_cell *type = m->type;
    const int32_t *node = m->cell + (int64_t)foot->cell * type->n_node;
    double basis[FE_MAX_NODES], dn[FE_MAX_NODES][3], found[3], j[3][3];

    fe_basis(type, 2, foot->xi, basis, dn);
    mesh_map(m, foot->cell, basis, (const double(*)[3])dn, found, j);
    for (int i = 0; i < type->n_vertex; i++) {
        double own[3] = {0};

        for (int k = 0; k < m->dim; k++)
            for (int c = 0; c < m->dim; c++) /* found is at, or its image by a period */
                own[k] += b->then[l][c][k] * (m->x[(int64_t)node[type->vertex[i]] * m->dim + c] - found[c] + at[c] -
                                              b->here.at.x[c] + b->way[l][c]);
        if (shape_level(b->here.shape, own) > 0)
            return 0;
    }
    return 1;
}

/* A cut cell has points below the surface, too.  What they need is the fluid beside the surface, continued to first
 * order: moves the foot there, off: from there to the foot.  But the history of a body that all but rests stays in
 * its cell, if there was fluid: it must cancel c_0 u, which is of that cell. */
static void continue_fluid(const bodies *p, const moving_body *b, const double *x, double h, double part,
                           double way[PATHS_MAX_LEVELS][3], located *foot, double off[PATHS_MAX_LEVELS][3])
{
    double from[3] = {x[0], x[1], x[2]};
    int found = -1;

    for (int l = 0; l < p->paths.levels; l++) {
        double at[3], d[3], far = 0;
        located beside;

        for (int k = 0; k < 3; k++) {
            at[k] = x[k] - part * way[l][k];
            far += way[l][k] * way[l][k];
        }
        if (sqrt(far) < RESTS * h && !was_covered(p->space->mesh, b, l, &foot[l], at))
            continue;
        if (found < 0)
            found = find_surface(b, h, 1, from);
        if (!found)
            return;
        paths_travelled(b, l, from, d);
        for (int k = 0; k < p->space->mesh->dim; k++) {
            off[l][k] = at[k];
            at[k] = from[k] - part * d[k];
            off[l][k] -= at[k];
        }
        beside = locate(p, at);
        if (beside.cell >= 0)
            foot[l] = beside;
        else
            memset(off[l], 0, sizeof off[l]);
    }
}

/* sum_k c_k u^k at the feet, continued by `off` to first order. */
static void history_of(const bodies *p, int f, const located *foot, double off[PATHS_MAX_LEVELS][3],
                       double *history)
{
    const body_paths *t = &p->paths;
    int n = p->space->field[f].n_comp, dim = p->space->mesh->dim;

    memset(history, 0, (size_t)n * sizeof *history);
    for (int l = 0; l < t->levels; l++) {
        int further = off[l][0] != 0 || off[l][1] != 0 || off[l][2] != 0;
        double v[VALUE_MAX], g[3 * VALUE_MAX] = {0};

        locate_value(p->space, &foot[l], f, t->u[l], v, further ? g : NULL);
        for (int a = 0; a < n; a++) {
            history[a] += t->c[l] * v[a];
            for (int k = 0; further && k < dim; k++)
                history[a] += t->c[l] * g[a * dim + k] * off[l][k];
        }
    }
}

int paths_at(void *bodies_, int64_t cell, const double *x, double *w, double *history)
{
    const bodies *p = bodies_;
    const body_paths *t = &p->paths;
    double way[PATHS_MAX_LEVELS][3], off[PATHS_MAX_LEVELS][3] = {{0}}, h = p->space->mesh->h[cell], part;
    const moving_body *below;
    located foot[PATHS_MAX_LEVELS];

    if (!t->cell[cell] || !paths_find(t, x, PATHS_REACH * h, way))
        return 0;
    part = locate_path(p, x, way, foot);
    if (part == 0)
        return 0;
    below = paths_below(t, x);
    if (below)
        continue_fluid(p, below, x, h, part, way, foot, off);
    for (int k = 0; k < p->space->mesh->dim; k++) {
        w[k] = 0;
        for (int l = 0; l < t->levels; l++)
            w[k] -= t->c[l] * part * way[l][k];
    }
    for (int f = 0; f < p->space->n_field; f++)
        if (t->frame.fields >> f & 1) {
            history_of(p, f, foot, off, history);
            history += p->space->field[f].n_comp;
        }
    return 1;
}

/* The image of a body that is nearest to x. */
static const moving_body *image_near(const body_paths *t, int n_image, int body, const double *x)
{
    const moving_body *nearest = NULL;
    double least = INFINITY;

    for (int j = 0; j < n_image; j++) {
        const moving_body *b = &t->body[body * n_image + j];
        double d = 0;

        for (int k = 0; k < 3; k++)
            d += (x[k] - b->here.at.x[k]) * (x[k] - b->here.at.x[k]);
        nearest = d < least ? b : nearest;
        least = fmin(d, least);
    }
    return nearest;
}

/* Where the point of a body that is at x now was. */
static int inside_before(const bodies *p, const moving_body *b, double h, const double *x, located *then)
{
    double own[3], at[3] = {0}, from[3] = {x[0], x[1], x[2]};
    int beside;

    if (!b->moves)
        return 0;
    beside = solid_level(&b->here, x) > 0 && find_surface(b, h, -1, from);
    solid_own(&b->here, from, own);
    for (int i = 0; i < p->space->mesh->dim; i++) {
        at[i] = b->here.at.x[i] - b->way[0][i];
        for (int k = 0; k < p->space->mesh->dim; k++)
            at[i] += b->turned[i][k] * own[k];
    }
    *then = locate(p, at);
    return then->cell < 0 ? 0 : beside ? BEFORE_BESIDE : BEFORE_MOVED;
}

int paths_before(void *bodies_, int64_t cell, const double *x, int body, located *then)
{
    const bodies *p = bodies_;
    const body_paths *t = &p->paths;
    double way[PATHS_MAX_LEVELS][3], off[PATHS_MAX_LEVELS][3] = {{0}}, h = p->space->mesh->h[cell], part;
    const moving_body *below;
    located foot[PATHS_MAX_LEVELS];

    if (body >= 0)
        return inside_before(p, image_near(t, p->n_image, body, x), h, x, then);
    if (!t->cell[cell] || !paths_find(t, x, PATHS_REACH * h, way))
        return 0;
    part = locate_path(p, x, way, foot);
    if (part == 0)
        return 0;
    below = paths_below(t, x);
    if (below)
        continue_fluid(p, below, x, h, part, way, foot, off);
    *then = foot[0];
    return below ? BEFORE_BESIDE : BEFORE_MOVED;
}

uint32_t bodies_rated(const bodies *b)
{
    const description *d = b->description;
    uint32_t found = 0;

    for (int i = 0; i < d->n_use; i++)
        for (uint32_t k = 0; k < d->use[i].term->n_in; k++)
            if (d->use[i].term->in[k].eval == PF_DOT)
                found |= 1u << space_find_field(b->space, d->use[i].term->in[k].field);
    return found;
}

/* Fields that the paths matter to: those of the fluid only, with du/dt in some term. */
static uint32_t find_fields(const bodies *b)
{
    uint32_t found = bodies_rated(b);

    for (int f = 0; f < b->space->n_field; f++)
        if (b->space->field[f].order == 0 || !b->fluid_only[f])
            found &= ~(1u << f);
    return found;
}

/* The images of the bodies, now and then. */
static void place(bodies *p, const placement *now, int levels, const pose *const *then)
{
    body_paths *t = &p->paths;

    t->n = 0;
    for (int k = 0; k < p->n; k++)
        for (int j = 0; j < p->n_image; j++) {
            moving_body *b = &t->body[t->n++];

            *b = (moving_body){.here = now->body[k], .moves = p->spec[k].motion != BODY_FIXED};
            for (int l = 0; l < levels; l++) {
                solid turned = shape_is_round(b->here.shape) ? b->here : solid_at(b->here.shape, &then[l][k]);

                memcpy(b->then[l], turned.axes, sizeof turned.axes);
                for (int i = 0; i < p->space->mesh->dim; i++)
                    b->way[l][i] = b->here.at.way[i] - then[l][k].way[i];
            }
            if (levels > 0)
                memcpy(b->turned, solid_at(b->here.shape, &then[0][k]).axes, sizeof b->turned);
            b->round = shape_is_round(b->here.shape);
            for (int i = 0; i < 3; i++)
                b->here.at.x[i] += p->image[j][i];
        }
}

int paths_create(bodies *b, error *err)
{
    ARENA_NEW(&b->memory, b->paths.body, b->n * b->n_image, err);
    ARENA_NEW(&b->memory, b->paths.cell, b->space->mesh->n_cell, err);
    ARENA_NEW(&b->memory, b->paths.seen, b->space->n_carrier, err);
    ARENA_NEW(&b->memory, b->paths.all, b->n * b->n_image + 1, err);
    for (int i = 0; i < b->n * b->n_image; i++)
        b->paths.all[i] = i;
    b->paths.frame.fields = find_fields(b);
    b->paths.frame.cell = b->paths.cell;
    b->paths.frame.ctx = b;
    b->paths.frame.at = paths_at;
    b->paths.frame.before = paths_before;
    for (int k = 0; k < b->n; k++) /* Lua has one thread */
        b->paths.frame.one_thread |= b->spec[k].shape.kind == SHAPE_DISTANCE;
    return 0;
}

int paths_take(bodies *b, const placement *now, int levels, const double *c, const double *const *u,
               const pose *const *then)
{
    body_paths *t = &b->paths;
    double h = 0;
    int any = 0;

    place(b, now, levels, then);
    memset(t->cell, 0, (size_t)b->space->mesh->n_cell);
    for (int i = 0; i < t->n; i++) {
        const solid *q = &t->body[i].here;
        int64_t n = t->body[i].moves
                        ? cell_grid_ball(b->grid, q->at.x, q->shape->radius + PATHS_REACH * b->h_mean, b->near_cell)
                        : 0;

        for (int64_t k = 0; k < n; k++) {
            t->cell[b->near_cell[k]] = 1;
            h = fmax(h, b->space->mesh->h[b->near_cell[k]]);
        }
        any |= n > 0;
    }
    paths_list(t, b->space->mesh->dim, PATHS_REACH * h);
    t->levels = levels;
    for (int l = 0; l < levels; l++) {
        t->c[l] = c[l];
        t->u[l] = u[l];
    }
    return any;
}

const moving_frame *bodies_paths(bodies *b, const placement *now, int levels, const double *c,
                                 const double *const *u, const pose *const *then, const double *history)
{
    body_paths *t = &b->paths;
    int any;

    if (!t->frame.fields && b->space->kept.n == 0)
        return NULL;
    any = paths_take(b, now, levels, c, u, then);
    t->frame.stamp++;
    t->frame.u = history;
    return any ? &t->frame : NULL;
}
