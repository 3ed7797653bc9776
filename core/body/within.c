/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Bodies that start partly or wholly outside of the mesh.  Periodic boundaries are no obstacle (the body's images
 * are looked at as well), a symmetry plane may cut a body whose centre lies on it, and a body that is fixed may be
 * a part of a wall. */
#include "body/places.h"

#include "base/text.h"

#include <math.h>
#include <string.h>

typedef struct domain {
    const description *d;
    const mesh *mesh;
    double low[3], high[3];
    int n_image;
    double image[27][3];
    outer_facet *facet; /* [mesh->n_facet] by low[0] */
    double widest;      /* of a facet in x */
    const cell_grid *cells;
    int32_t *near; /* [n_cell] room for a search */
    int told, warned;
    arena memory;
} domain;

/* What a body reaches through: by boundary name (the last entry: facets without one). */
typedef struct crossing {
    double by[MESH_MAX_NAMES + 1];
    double normal[MESH_MAX_NAMES + 1][3];
    int symmetric[MESH_MAX_NAMES + 1];
} crossing;

static int open_domain(domain *o, error *err)
{
    TRY(outer_facets(o->d, o->mesh, &o->memory, &o->facet, &o->widest, err));
    ARENA_NEW(&o->memory, o->near, o->mesh->n_cell, err);
    return 0;
}

static int64_t first_facet(const domain *o, double low)
{
    int64_t a = 0, b = o->mesh->n_facet;

    while (a < b) {
        int64_t c = a + (b - a) / 2;

        if (o->facet[c].low[0] < low)
            a = c + 1;
        else
            b = c;
    }
    return a;
}

static void find_crossings(const domain *o, const body_spec *q, crossing *c)
{
    const double r = q->shape.radius;
    const int dim = o->mesh->dim;

    memset(c, 0, sizeof *c);
    for (int i = 0; i < o->n_image; i++) {
        solid b = solid_at(&q->shape, &q->start);

        for (int k = 0; k < dim; k++)
            b.at.x[k] += o->image[i][k];
        for (int64_t n = first_facet(o, b.at.x[0] - r - o->widest); n < o->mesh->n_facet; n++) {
            const outer_facet *f = &o->facet[n];
            int name = f->name < 0 ? MESH_MAX_NAMES : f->name, near = !f->periodic;
            double off = 0;

            if (f->low[0] > b.at.x[0] + r)
                break;
            for (int k = 0; k < dim; k++) {
                near = near && f->low[k] <= b.at.x[k] + r && f->high[k] >= b.at.x[k] - r;
                off += (b.at.x[k] - f->x0[k]) * f->normal[k];
            }
            if (!near || (f->symmetric && fabs(off) <= 1e-9 * r))
                continue;
            off = outer_reach(o->mesh, f, &b);
            if (off > c->by[name]) {
                c->by[name] = off;
                c->symmetric[name] = f->symmetric;
                memcpy(c->normal[name], f->normal, sizeof f->normal);
            }
        }
    }
}

/* Whether a point of a body, or the same of an image, lies in the mesh. */
static int is_in_mesh(domain *o, const double *x)
{
    for (int i = 0; i < o->n_image; i++) {
        double at[3] = {0}, xi[3];
        int64_t n;

        for (int k = 0; k < o->mesh->dim; k++)
            at[k] = x[k] + o->image[i][k];
        n = cell_grid_ball(o->cells, at, 1e-9 * (o->high[0] - o->low[0]), o->near);
        for (int64_t e = 0; e < n; e++)
            if (locate_in_cell(o->mesh, o->near[e], at, xi) > 0)
                return 1;
    }
    return 0;
}

static double first_coordinate(const void *ctx, const double *x)
{
    (void)ctx;
    return x[0];
}

/* A point of the body: its centre, unless that lies in a hole of it. */
static void point_of(const body_spec *q, double *x)
{
    const solid b = solid_at(&q->shape, &q->start);

    memcpy(x, q->start.x, sizeof q->start.x);
    if (solid_level(&b, x) >= 0)
        surface_least(&b, first_coordinate, NULL, 1, x);
}

/* "bottom" by 0.1 and "top" by 0.2 */
static int list_crossings(const domain *o, const crossing *c, text *list)
{
    int n = 0;

    for (int k = 0; k <= MESH_MAX_NAMES; k++)
        if (c->by[k] > 0) {
            text_add(list, "%s%s%s%s%s by %.3g", n ? " and " : "", c->symmetric[k] ? "the symmetry plane " : "",
                     k < MESH_MAX_NAMES ? "\"" : "the boundary", k < MESH_MAX_NAMES ? o->mesh->name[k] : "",
                     k < MESH_MAX_NAMES ? "\"" : "", c->by[k]);
            n++;
        }
    return n;
}

/* Whether it reaches through opposite boundaries. */
static int is_larger(const crossing *c)
{
    for (int i = 0; i <= MESH_MAX_NAMES; i++)
        for (int k = 0; k < i; k++) {
            const double *a = c->normal[i], *b = c->normal[k];

            if (c->by[i] > 0 && c->by[k] > 0 && a[0] * b[0] + a[1] * b[1] + a[2] * b[2] < -0.7)
                return 1;
        }
    return 0;
}

static void tell_crossing(domain *o, int k, const crossing *c, const char *list)
{
    const body_spec *q = &o->d->body[k];
    int symmetric = 0;

    for (int i = 0; i <= MESH_MAX_NAMES; i++)
        symmetric |= c->symmetric[i];
    if (q->motion == BODY_FIXED && !symmetric) {
        if (o->warned++ < PLACES_MOST_TOLD)
            warning_add(o->d->warnings,
                        "%s:%d: particle %d, fixed at %s, reaches through %s: only its part inside counts",
                        q->block->file, q->block->line, k, text_point(q->start.x, o->mesh->dim).s, list);
        return;
    }
    if (o->told++ < PLACES_MOST_TOLD)
        case_wrong(o->d->c, q->block, "at", "particle %d at %s reaches through %s%s; %s", k,
                   text_point(q->start.x, o->mesh->dim).s, list,
                   is_larger(c) ? ", so it is larger than the domain there" : "",
                   symmetric ? "a symmetry plane may cut a body only through its centre"
                             : "a body that can move has to start within the domain");
}

static void check_body(domain *o, int k)
{
    const body_spec *q = &o->d->body[k];
    crossing c;
    text list = {0};
    double x[3];

    find_crossings(o, q, &c);
    point_of(q, x);
    if (list_crossings(o, &c, &list) > 0)
        tell_crossing(o, k, &c, list.s ? list.s : "");
    else if (!is_in_mesh(o, x) && o->told++ < PLACES_MOST_TOLD)
        case_wrong(o->d->c, q->block, "at",
                   "particle %d at %s lies outside of the mesh, which reaches from %s to %s", k,
                   text_point(q->start.x, o->mesh->dim).s, text_point(o->low, o->mesh->dim).s,
                   text_point(o->high, o->mesh->dim).s);
    text_free(&list);
}

int within_check(const description *d, const mesh *m, const cell_grid *grid, error *err)
{
    domain o = {.d = d, .mesh = m, .cells = grid};
    int status;

    describe_bounds(m, o.low, o.high);
    o.n_image = mesh_images(m, o.image);
    status = open_domain(&o, err);
    for (int k = 0; !status && k < d->n_body; k++)
        check_body(&o, k);
    if (o.told > PLACES_MOST_TOLD)
        case_wrong(d->c, NULL, NULL, "%d more bodies reach out of the mesh", o.told - PLACES_MOST_TOLD);
    if (o.warned > PLACES_MOST_TOLD)
        warning_add(d->warnings, "%d more fixed bodies reach out of the mesh", o.warned - PLACES_MOST_TOLD);
    arena_free(&o.memory);
    return status;
}
