/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Boundary facets as obstacles.  A body reaches through one if its level is negative somewhere on it: the least
 * level is searched on the part of the facet that the ball round the body can touch, on ever finer grids. */
#include "body/places.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { GRID_2D = 17, GRID_3D = 9, ZOOMS = 16 };

/* Half the window of the next grid, in steps of the last one. */
#define WINDOW 1.5

static double dot(const double *a, const double *b, int n)
{
    double v = 0;

    for (int k = 0; k < n; k++)
        v += a[k] * b[k];
    return v;
}

static void place(const mesh *m, const outer_facet *f, const double *s, double *x)
{
    double xi[3] = {0}, n[FE_MAX_NODES], dn[FE_MAX_NODES][3], j[3][3];

    for (int k = 0; k < 3; k++)
        xi[k] = f->xi0[k] + s[0] * f->txi[0][k] + s[1] * f->txi[1][k];
    fe_basis(m->type, 2, xi, n, dn);
    mesh_map(m, m->facet[f->number].cell, n, (const double(*)[3])dn, x, j);
}

static void face(const mesh *m, outer_facet *f)
{
    const mesh_facet *g = &m->facet[f->number];
    const int32_t *cell = m->cell + (int64_t)g->cell * m->type->n_node;
    const int *node = m->type->facet[g->local];
    double centre[3] = {0}, size = 0;

    for (int k = 0; k < m->dim; k++) {
        f->x0[k] = m->x[(int64_t)cell[node[0]] * m->dim + k];
        f->xi0[k] = m->type->x[node[0]][k];
        for (int i = 0; i < f->n; i++) {
            f->t[i][k] = m->x[(int64_t)cell[node[i + 1]] * m->dim + k] - f->x0[k];
            f->txi[i][k] = m->type->x[node[i + 1]][k] - f->xi0[k];
        }
        for (int i = 0; i < m->type->n_node; i++)
            centre[k] += m->x[(int64_t)cell[i] * m->dim + k] / m->type->n_node;
        centre[k] -= f->x0[k];
    }
    if (m->dim == 2) {
        f->normal[0] = f->t[0][1];
        f->normal[1] = -f->t[0][0];
    }
    for (int k = 0; m->dim == 3 && k < 3; k++) {
        int p = (k + 1) % 3, q = (k + 2) % 3;

        f->normal[k] = f->t[0][p] * f->t[1][q] - f->t[0][q] * f->t[1][p];
    }
    size = sqrt(dot(f->normal, f->normal, 3));
    size = dot(centre, f->normal, m->dim) > 0 ? -size : size;
    for (int k = 0; k < 3; k++) {
        f->normal[k] /= size;
        f->low[k] = INFINITY, f->high[k] = -INFINITY;
    }
    for (int i = 0; i < m->type->facet_nodes; i++) {
        const double *x = m->x + (int64_t)cell[node[i]] * m->dim;
        double off = 0;

        for (int k = 0; k < m->dim; k++) {
            f->low[k] = fmin(f->low[k], x[k]);
            f->high[k] = fmax(f->high[k], x[k]);
            off += (x[k] - f->x0[k]) * f->normal[k];
        }
        f->bulge = fmax(f->bulge, 2 * fabs(off));
    }
    for (int k = 0; k < m->dim; k++) {
        f->low[k] -= f->bulge;
        f->high[k] += f->bulge;
    }
}

static int by_low(const void *a, const void *b)
{
    const outer_facet *p = a, *q = b;

    return p->low[0] != q->low[0] ? (p->low[0] > q->low[0]) - (p->low[0] < q->low[0]) : p->number - q->number;
}

int outer_facets(const description *d, const mesh *m, arena *memory, outer_facet **list, double *widest, error *err)
{
    uint64_t periodic = 0;
    uint8_t *on, *symmetric;

    for (int i = 0; i < m->n_period; i++)
        periodic |= (uint64_t)1 << m->period[i][0] | (uint64_t)1 << m->period[i][1];
    ARENA_NEW(memory, on, m->n_facet + 1, err);
    ARENA_NEW(memory, symmetric, m->n_facet + 1, err);
    for (int i = 0; i < d->n_line; i++) {
        if (!d->line[i].symmetry)
            continue;
        describe_facets(d, m, i, on);
        for (int64_t f = 0; f < m->n_facet; f++)
            symmetric[f] |= on[f];
    }
    ARENA_NEW(memory, *list, m->n_facet + 1, err);
    *widest = 0;
    for (int64_t i = 0; i < m->n_facet; i++) {
        outer_facet *f = &(*list)[i];

        *f = (outer_facet){.number = (int32_t)i,
                           .name = -1,
                           .periodic = (m->facet[i].names & periodic) != 0,
                           .symmetric = symmetric[i],
                           .n = m->dim - 1};
        for (int k = m->n_name - 1; k >= 0; k--)
            f->name = m->facet[i].names >> k & 1 ? k : f->name;
        face(m, f);
        *widest = fmax(*widest, f->high[0] - f->low[0]);
    }
    qsort(*list, (size_t)m->n_facet, sizeof **list, by_low);
    return 0;
}

/* Window of the facet's coordinates that a ball can touch; 0: none. */
static int window(const outer_facet *f, const double *x, double radius, double (*w)[2])
{
    double r[3], g[2][2] = {{1, 0}, {0, 1}}, b[2] = {0}, det;

    for (int k = 0; k < 3; k++)
        r[k] = x[k] - f->x0[k];
    for (int i = 0; i < f->n; i++) {
        b[i] = dot(r, f->t[i], 3);
        for (int j = 0; j < f->n; j++)
            g[i][j] = dot(f->t[i], f->t[j], 3);
    }
    det = g[0][0] * g[1][1] - g[0][1] * g[1][0];
    for (int i = 0; i < 2; i++) {
        double at = (g[1 - i][1 - i] * b[i] - g[i][1 - i] * b[1 - i]) / det;
        double half = (radius + f->bulge) * sqrt(g[1 - i][1 - i] / det) * 1.05;

        w[i][0] = fmax(0, at - half);
        w[i][1] = fmin(1, at + half);
        if (i >= f->n)
            w[i][0] = w[i][1] = 0;
        if (!(w[i][0] <= w[i][1]))
            return 0;
    }
    return 1;
}

/* The least level on the facet, at x. */
static double least_level(const mesh *m, const outer_facet *f, const solid *b, double *x)
{
    const int n = f->n == 1 ? GRID_2D : GRID_3D, rows = f->n == 1 ? 1 : n;
    double w[2][2], best = INFINITY, s[2] = {0};

    if (!window(f, b->at.x, b->shape->radius, w))
        return INFINITY;
    for (int zoom = 0; zoom < ZOOMS; zoom++) {
        for (int i = 0; i < n; i++)
            for (int j = 0; j < rows; j++) {
                double to[2] = {w[0][0] + (w[0][1] - w[0][0]) * i / (n - 1), 0}, at[3] = {0}, v;

                if (rows > 1)
                    to[1] = w[1][0] + (w[1][1] - w[1][0]) * j / (rows - 1);
                if (m->type->simplex && to[0] + to[1] > 1)
                    to[1] = fmax(0, 1 - to[0]);
                place(m, f, to, at);
                v = solid_level(b, at);
                if (v < best) {
                    best = v;
                    memcpy(s, to, sizeof s);
                    memcpy(x, at, sizeof at);
                }
            }
        for (int k = 0; k < f->n; k++) {
            double half = WINDOW * (w[k][1] - w[k][0]) / (n - 1);

            w[k][0] = fmax(0, s[k] - half);
            w[k][1] = fmin(1, s[k] + half);
        }
    }
    return best;
}

static double against(const void *ctx, const double *x)
{
    return -dot(ctx, x, 3);
}

double outer_reach(const mesh *m, const outer_facet *f, const solid *b)
{
    const shape *s = b->shape;
    double x[3] = {0}, far[3], level = dot(f->x0, f->normal, 3), size = 0, most;

    for (int k = 0; k < m->dim; k++)
        size = fmax(size, fmax(fabs(b->at.x[k]), fabs(f->x0[k])));
    most = dot(b->at.x, f->normal, 3) + solid_support(b, f->normal) - level + f->bulge;
    most += s->kind == SHAPE_DISTANCE ? 1e-3 * s->radius : 0; /* its support may be one of points of the surface */
    if (most <= 1e-12 * s->radius + 8 * 2.2e-16 * size || least_level(m, f, b, x) > -surface_slack(s))
        return 0;
    return fmax(-surface_least(b, against, f->normal, 1, far) - dot(x, f->normal, 3), 0);
}
