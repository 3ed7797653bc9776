/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Where boundaries with different values of a vector field u meet in a node, the normal component of each is kept,
 *
 *     n_1 . u = n_1 . u_1,   n_2 . u = n_2 . u_2,   ...,
 *
 * and what is left tangentially is that of the later line; so what flows through each boundary is what its own
 * condition says.  (Otherwise the lid of a cavity pumps fluid through the corners of the side walls, and the
 * solution converges with order one only.)  n_k is the direction of int phi n over the facets of boundary k at the
 * node: with it the flux of the finite-element function is exact on curved boundaries, too. */
#include "space/corners.h"

#include "base/list.h"
#include "base/text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Facets of one boundary whose normals differ by less are one side of a corner. */
#define SAME_SIDE 0.87 /* cosine of 30 degrees */
/* A normal that lies nearer to those before gives no condition of its own. */
#define INDEPENDENT 0.2

void facet_element(const mesh *m, int64_t facet, const double *xi, const double (*tangent)[3], int orient,
                   double *x, double *ds)
{
    double n[FE_MAX_NODES], dn[FE_MAX_NODES][3], j[3][3], t[2][3] = {{0}};

    fe_basis(m->type, 2, xi, n, dn);
    mesh_map(m, m->facet[facet].cell, n, (const double(*)[3])dn, x, j);
    for (int s = 0; s < m->dim - 1; s++)
        for (int a = 0; a < m->dim; a++)
            for (int b = 0; b < m->dim; b++)
                t[s][a] += j[a][b] * tangent[s][b];
    memset(ds, 0, 3 * sizeof *ds);
    if (m->dim == 2) {
        ds[0] = orient * t[0][1];
        ds[1] = -orient * t[0][0];
        return;
    }
    for (int a = 0; a < 3; a++)
        ds[a] = orient * (t[0][(a + 1) % 3] * t[1][(a + 2) % 3] - t[0][(a + 2) % 3] * t[1][(a + 1) % 3]);
}

int facet_weights(const mesh *m, int64_t facet, double (*weight)[3], double *all, error *err)
{
    const mesh_facet *f = &m->facet[facet];
    const fe_cell *c = m->type;
    double tangent[2][3];
    fe_rule rule;
    int orient;

    memset(weight, 0, FE_MAX_FACET_NODES * sizeof *weight);
    memset(all, 0, 3 * sizeof *all);
    TRY(fe_rule_facet(c, f->local, 5, &rule, tangent, &orient, err));
    for (int q = 0; q < rule.n; q++) {
        double n[FE_MAX_NODES], dn[FE_MAX_NODES][3], x[3], ds[3];

        fe_basis(c, 2, rule.x[q], n, dn);
        facet_element(m, facet, rule.x[q], (const double(*)[3])tangent, orient, x, ds);
        for (int a = 0; a < m->dim; a++) {
            all[a] += rule.w[q] * ds[a];
            for (int i = 0; i < c->facet_nodes; i++)
                weight[i][a] += rule.w[q] * ds[a] * n[c->facet[f->local][i]];
        }
    }
    return 0;
}

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Whether a line takes part: it prescribes all of the field, or its normal component by symmetry. */
static int takes_part(const boundary_line *l, int field, int n_comp)
{
    int whole = l->has_value[field];

    for (int k = 0; k < n_comp; k++)
        whole &= !l->value[field].free[k];
    return whole || (l->symmetry && !l->has_value[field]);
}

/* A side of a node while it is gathered. */
typedef struct gathered {
    int64_t before; /* side of the same node, or -1 */
    int32_t node;
    int line;
    uint64_t names;
    double flux[3], area[3]; /* sums of int phi n and of int n */
} gathered;

typedef struct gather_list {
    int64_t n, room;
    gathered *side;
    int64_t *last; /* [n_node] last side of the node, or -1 */
} gather_list;

/* Adds a facet's part to the side of the node that it belongs to. */
static int add_part(gather_list *l, int32_t node, int line, uint64_t names, const double *flux, const double *area,
                    error *err)
{
    gathered *to = NULL;

    for (int64_t i = l->last[node]; i >= 0 && !to; i = l->side[i].before) {
        gathered *g = &l->side[i];

        if (g->line == line && g->names == names &&
            dot(g->area, area) > SAME_SIDE * sqrt(dot(g->area, g->area) * dot(area, area)))
            to = g;
    }
    if (!to) {
        LIST_ROOM(l->side, l->n, &l->room, err);
        to = &l->side[l->n++];
        *to = (gathered){.before = l->last[node], .node = node, .line = line, .names = names};
        l->last[node] = l->n - 1;
    }
    for (int a = 0; a < 3; a++) {
        to->flux[a] += flux[a];
        to->area[a] += area[a];
    }
    return 0;
}

/* Bits of the lines that take part at each node; DESCRIBE_MAX_LINES is 64. */
static void mark_lines(const description *d, const space *s, uint8_t *const *facet, int field, uint64_t *lines)
{
    const mesh *m = s->mesh;

    for (int i = 0; i < d->n_line; i++)
        for (int64_t f = 0; takes_part(&d->line[i], field, s->field[field].n_comp) && f < m->n_facet; f++)
            for (int k = 0; facet[i][f] && k < m->type->facet_nodes; k++)
                lines[space_master(s, m->cell[(int64_t)m->facet[f].cell * m->type->n_node +
                                              m->type->facet[m->facet[f].local][k]])] |= (uint64_t)1 << i;
}

/* Whether a line that prescribes single components, and so keeps the old rule, touches the node. */
static void mark_partial(const description *d, const space *s, uint8_t *const *facet, int field, uint64_t *lines)
{
    const mesh *m = s->mesh;

    for (int i = 0; i < d->n_line; i++)
        for (int64_t f = 0; d->line[i].has_value[field] &&
                            !takes_part(&d->line[i], field, s->field[field].n_comp) && f < m->n_facet;
             f++)
            for (int k = 0; facet[i][f] && k < m->type->facet_nodes; k++)
                lines[space_master(s, m->cell[(int64_t)m->facet[f].cell * m->type->n_node +
                                              m->type->facet[m->facet[f].local][k]])] = 0;
}

static int gather(gather_list *l, const description *d, const space *s, uint8_t *const *facet,
                  const uint64_t *lines, error *err)
{
    const mesh *m = s->mesh;

    for (int64_t f = 0; f < m->n_facet; f++) {
        const int32_t *cell = m->cell + (int64_t)m->facet[f].cell * m->type->n_node;
        double weight[FE_MAX_FACET_NODES][3], area[3];
        int known = 0;

        for (int k = 0; k < m->type->facet_nodes; k++) {
            int32_t node = space_master(s, cell[m->type->facet[m->facet[f].local][k]]);

            if (!(lines[node] & (lines[node] - 1))) /* less than two */
                continue;
            if (!known++)
                TRY(facet_weights(m, f, weight, area, err));
            for (int i = 0; i < d->n_line; i++)
                if (facet[i][f] && (lines[node] >> i & 1))
                    TRY(add_part(l, node, i, m->facet[f].names, weight[k], area, err));
        }
    }
    return 0;
}

static int by_node(const void *a, const void *b)
{
    const gathered *p = a, *q = b;

    return p->node != q->node ? (p->node > q->node) - (p->node < q->node) : p->line - q->line;
}

/* The sides of one node, sorted by rank, as a corner; none if no line prescribes all of the field there. */
static int add_corner(corner_list *l, const description *d, const int *rank, int field, const gathered *side, int n,
                      error *err)
{
    corner c = {.node = side->node, .field = field};

    for (int at = 0; at < d->n_line; at++)
        for (int i = 0; i < n && c.n < CORNER_MOST; i++) {
            const gathered *g = &side[i];
            const boundary_line *line = &d->line[g->line];
            corner_side *to = &c.side[c.n];
            double size = sqrt(dot(g->flux, g->flux)), all = sqrt(dot(g->area, g->area));
            /* vertices of P2 triangles have no part in the flux: the normal itself */
            const double *n_of = size > 0.02 * all ? g->flux : g->area;

            if (rank[g->line] != at)
                continue;
            *to = (corner_side){.line = g->line, .value = line->symmetry ? NULL : &line->value[field]};
            size = sqrt(dot(n_of, n_of));
            for (int a = 0; a < 3; a++)
                to->normal[a] = size > 0 ? n_of[a] / size : 0;
            c.last = to->value ? to->value : c.last;
            c.n++;
        }
    if (!c.last)
        return 0;
    LIST_ROOM(l->corner, l->n, &l->room, err);
    l->corner[l->n++] = c;
    return 0;
}

int corners_find(corner_list *l, const description *d, const space *s, uint8_t *const *facet, const int *rank,
                 int field, error *err)
{
    arena scratch = {0};
    gather_list g = {0};
    uint64_t *lines = arena_alloc(&scratch, (size_t)s->mesh->n_node, sizeof *lines);
    int status;

    g.last = lines ? arena_alloc(&scratch, (size_t)s->mesh->n_node, sizeof *g.last) : NULL;
    if (!g.last) {
        arena_free(&scratch);
        return error_memory(err, "corners", 16.0 * (double)s->mesh->n_node);
    }
    memset(g.last, 0xff, (size_t)s->mesh->n_node * sizeof *g.last); /* -1 */
    mark_lines(d, s, facet, field, lines);
    mark_partial(d, s, facet, field, lines);
    status = gather(&g, d, s, facet, lines, err);
    arena_free(&scratch);
    if (g.n)
        qsort(g.side, (size_t)g.n, sizeof *g.side, by_node);
    for (int64_t i = 0, n; i < g.n && !status; i += n) {
        for (n = 1; i + n < g.n && g.side[i + n].node == g.side[i].node; n++)
            ;
        status = add_corner(l, d, rank, field, g.side + i, (int)n, err);
    }
    free(g.side);
    return status;
}

static void say_conflict(const corner *c, const description *d, const space *s, const corner_side *kept,
                         const corner_side *lost, double is, double wanted, warning_list *w)
{
    warning_add(
        w,
        "boundary \"%s\" and \"%s\" meet without an edge at %s, and their conditions on %s differ along the "
        "normal (%.6g and %.6g): the node keeps that of \"%s\"; let one of them fall to the other's value there",
        d->line[kept->line].name, d->line[lost->line].name,
        text_point(s->mesh->x + (int64_t)c->node * s->mesh->dim, s->mesh->dim).s, s->field[c->field].name, is,
        wanted, d->line[kept->line].name);
}

/* Value at one corner: from the last side to the first, each direction that is new is fixed. */
static int corner_value(const corner *c, const description *d, const space *s, const double *at, double t,
                        double *u, warning_list *w, error *err)
{
    double axis[3][3], part[3], value[VALUE_MAX] = {0};
    int n = 0, who[3] = {0};

    TRY(value_at(c->last, at, t, u, err));
    for (int i = c->n - 1; i >= 0; i--) {
        const corner_side *side = &c->side[i];
        double r[3] = {side->normal[0], side->normal[1], side->normal[2]}, rest, size = 0, is = 0;

        memset(value, 0, sizeof value);
        if (side->value)
            TRY(value_at(side->value, at, t, value, err));
        rest = dot(side->normal, value);
        for (int k = 0; k < n; k++) {
            double along = dot(side->normal, axis[k]);

            is += along * part[k];
            for (int a = 0; a < 3; a++)
                r[a] -= along * axis[k][a];
        }
        size = sqrt(dot(r, r));
        if (n < s->mesh->dim && size > INDEPENDENT) {
            for (int a = 0; a < 3; a++)
                axis[n][a] = r[a] / size;
            who[n] = i;
            part[n++] = (rest - is) / size;
        } else if (w && fabs(rest - is) > 1e-9 * (fabs(rest) + fabs(is)) && n > 0) {
            say_conflict(c, d, s, &c->side[who[n - 1]], side, is, rest, w);
        }
    }
    for (int k = 0; k < n; k++) {
        double change = part[k] - dot(axis[k], u);

        for (int a = 0; a < s->mesh->dim; a++)
            u[a] += change * axis[k][a];
    }
    return 0;
}

int corners_apply(const corner_list *l, const description *d, const space *s, double t, double *x, warning_list *w,
                  error *err)
{
    int dim = s->mesh->dim;

    for (int64_t i = 0; i < l->n; i++) {
        const corner *c = &l->corner[i];
        double at[3] = {0}, u[VALUE_MAX] = {0};

        memcpy(at, s->mesh->x + (int64_t)c->node * dim, (size_t)dim * sizeof *at);
        TRY(corner_value(c, d, s, at, t, u, w, err));
        memcpy(x + s->first[c->field][c->node], u, (size_t)dim * sizeof *u);
    }
    return 0;
}

void corners_destroy(corner_list *l)
{
    free(l->corner);
    memset(l, 0, sizeof *l);
}
