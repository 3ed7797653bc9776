/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The nearest point of a facet.  Along a line or an edge the squared distance is a polynomial of degree 4: all its
 * minima are found.  Inside a triangle or quadrilateral Newton's method finds the one near the best of some points;
 * a facet that bends so much that there are several is too coarse for the wall that it stands for. */
#include "mesh/facet.h"

#include <plugflow/mesh.h>

#include <gsl/gsl_poly.h>
#include <math.h>
#include <string.h>

static const double vertex_at[3][FACET_MAX_VERTICES][2] = {
    [FACET_LINE] = {{-1, 0}, {1, 0}},
    [FACET_QUAD] = {{-1, -1}, {1, -1}, {-1, 1}, {1, 1}},
    [FACET_TRIANGLE] = {{0, 0}, {1, 0}, {0, 1}},
};
static const int n_vertices[3] = {[FACET_LINE] = 2, [FACET_QUAD] = 4, [FACET_TRIANGLE] = 3};
static const int edge_of[3][4][2] = {
    [FACET_LINE] = {{0, 1}},
    [FACET_QUAD] = {{0, 1}, {0, 2}, {1, 3}, {2, 3}},
    [FACET_TRIANGLE] = {{0, 1}, {1, 2}, {2, 0}},
};
static const int n_edges[3] = {[FACET_LINE] = 1, [FACET_QUAD] = 4, [FACET_TRIANGLE] = 3};

int facet_n_vertex(const facet *f)
{
    return n_vertices[f->kind];
}

/* --- the mapping --- */

/* Coefficients of 1, s, s^2 from the values at -1, 0, 1. */
static void line_coefficients(double a, double middle, double b, double *c, int step)
{
    c[0] = middle;
    c[step] = 0.5 * (b - a);
    c[2 * step] = 0.5 * (a + b) - middle;
}

/* Coefficients of one coordinate from its values at the facet's nodes: quadrilaterals row by row. */
static void coefficients(enum facet_kind kind, const double *v, double c[3][3])
{
    double row[3][3];

    memset(c, 0, 9 * sizeof(double));
    switch (kind) {
    case FACET_LINE:
        line_coefficients(v[0], v[1], v[2], &c[0][0], 3);
        break;
    case FACET_QUAD:
        for (int j = 0; j < 3; j++)
            line_coefficients(v[3 * j], v[3 * j + 1], v[3 * j + 2], row[j], 1);
        for (int i = 0; i < 3; i++)
            line_coefficients(row[0][i], row[1][i], row[2][i], c[i], 1);
        break;
    case FACET_TRIANGLE: /* vertices, then the middles of 01, 12, 20 */
        c[0][0] = v[0];
        c[1][0] = -3 * v[0] - v[1] + 4 * v[3];
        c[0][1] = -3 * v[0] - v[2] + 4 * v[5];
        c[2][0] = 2 * v[0] + 2 * v[1] - 4 * v[3];
        c[0][2] = 2 * v[0] + 2 * v[2] - 4 * v[5];
        c[1][1] = 4 * (v[0] - v[3] + v[4] - v[5]);
        break;
    }
}

int facet_create(facet *f, const mesh *m, int64_t number, double box[2][3], error *err)
{
    static const int as_listed[FE_MAX_FACET_NODES] = {0, 1, 2, 3, 4, 5}, of_line[FE_MAX_FACET_NODES] = {0, 2, 1},
                     of_quad[FE_MAX_FACET_NODES] = {0, 4, 1, 5, 6, 7, 2, 8, 3};
    const fe_cell *type = m->type, *own = type->dim == 2 ? NULL : fe_cell_of(type->simplex ? PF_TRI6 : PF_QUAD9);
    const mesh_facet *b = &m->facet[number];
    const int *order = type->dim == 2 ? of_line : type->simplex ? as_listed : of_quad;
    double tangent[2][3];
    int outward;
    fe_rule ignored;

    TRY(fe_rule_facet(type, b->local, 1, &ignored, tangent, &outward, err));
    *f = (facet){.kind = type->dim == 2  ? FACET_LINE
                         : type->simplex ? FACET_TRIANGLE
                                         : FACET_QUAD,
                 .dim = type->dim,
                 .inward = -outward};
    for (int k = 0; k < m->dim; k++) {
        double v[FE_MAX_FACET_NODES];

        for (int i = 0; i < type->facet_nodes; i++) {
            int local = type->facet[b->local][order[i]];

            v[i] = m->x[(int64_t)m->cell[(int64_t)b->cell * type->n_node + local] * m->dim + k];
        }
        coefficients(f->kind, v, f->c[k]);
        if (own)
            fe_bernstein(own, v);
        else
            v[1] = 2 * v[1] - 0.5 * (v[0] + v[2]);
        box[0][k] = INFINITY, box[1][k] = -INFINITY;
        for (int i = 0; i < type->facet_nodes; i++) {
            box[0][k] = fmin(box[0][k], v[i]);
            box[1][k] = fmax(box[1][k], v[i]);
        }
        f->size = fmax(f->size, box[1][k] - box[0][k]);
    }
    return 0;
}

/* Place, first and second derivatives: d[0] = x, d[1] = x_s, d[2] = x_t, d[3] = x_ss, d[4] = x_st, d[5] = x_tt. */
static void derivatives(const facet *f, const double *s, double d[6][3])
{
    const double p[3] = {1, s[0], s[0] * s[0]}, dp[3] = {0, 1, 2 * s[0]}, ddp[3] = {0, 0, 2};
    const double q[3] = {1, s[1], s[1] * s[1]}, dq[3] = {0, 1, 2 * s[1]}, ddq[3] = {0, 0, 2};

    memset(d, 0, 18 * sizeof(double));
    for (int k = 0; k < f->dim; k++)
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) {
                double c = f->c[k][i][j];

                d[0][k] += c * p[i] * q[j];
                d[1][k] += c * dp[i] * q[j];
                d[2][k] += c * p[i] * dq[j];
                d[3][k] += c * ddp[i] * q[j];
                d[4][k] += c * dp[i] * dq[j];
                d[5][k] += c * p[i] * ddq[j];
            }
}

static void place(const facet *f, const double *s, double *x)
{
    memset(x, 0, 3 * sizeof *x);
    for (int k = 0; k < f->dim; k++)
        for (int i = 2; i >= 0; i--)
            x[k] = x[k] * s[0] + (f->c[k][i][2] * s[1] + f->c[k][i][1]) * s[1] + f->c[k][i][0];
}

void facet_vertex(const facet *f, int i, double *x)
{
    place(f, vertex_at[f->kind][i], x);
}

void facet_normal(const facet *f, const double *s, double *n)
{
    double d[6][3], size = 0;

    derivatives(f, s, d);
    if (f->dim == 2) {
        n[0] = d[1][1], n[1] = -d[1][0], n[2] = 0;
    } else {
        n[0] = d[1][1] * d[2][2] - d[1][2] * d[2][1];
        n[1] = d[1][2] * d[2][0] - d[1][0] * d[2][2];
        n[2] = d[1][0] * d[2][1] - d[1][1] * d[2][0];
    }
    size = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int k = 0; k < 3; k++)
        n[k] = size > 0 ? f->inward * n[k] / size : 0;
}

/* --- nearest points --- */

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double squared_distance(const facet *f, const double *s, const double *x)
{
    double at[3], r2 = 0;

    place(f, s, at);
    for (int k = 0; k < f->dim; k++)
        r2 += (at[k] - x[k]) * (at[k] - x[k]);
    return r2;
}

static double polynomial(const double *g, double u)
{
    return ((g[3] * u + g[2]) * u + g[1]) * u + g[0];
}

/* The root of the cubic g between a, where it is negative, and b, where it is not: Newton, kept between them. */
static double cubic_root(const double *g, double a, double b)
{
    double u = 0.5 * (a + b);

    for (int i = 0; i < 100 && b - a > 1e-16; i++) {
        double v = polynomial(g, u), slope = (3 * g[3] * u + 2 * g[2]) * u + g[1], next;

        if (v < 0)
            a = u;
        else
            b = u;
        next = u - v / slope;
        if (!(next > a && next < b))
            next = 0.5 * (a + b);
        if (fabs(next - u) < 1e-16)
            break;
        u = next;
    }
    return u;
}

/* Whether a point at squared distance d is nearer than one at `least`; of equal ones that inside a facet or edge
 * (`inside`: how far) counts, not that at its end. */
static int is_nearer(double d, int inside, double least, int than)
{
    return inside > than ? d <= least * (1 + 1e-15) : inside < than ? d < least * (1 - 1e-15) : d < least;
}

/* Where on [0, 1] the squared distance of x from c[0] + c[1] u + c[2] u^2 has its least value. */
static double nearest_on_curve(double c[3][3], const double *x)
{
    const double r[3] = {c[0][0] - x[0], c[0][1] - x[1], c[0][2] - x[2]};
    /* half the derivative of the squared distance */
    const double g[4] = {dot(r, c[1]), dot(c[1], c[1]) + 2 * dot(r, c[2]), 3 * dot(c[1], c[2]),
                         2 * dot(c[2], c[2])};
    double turn[2], at[4] = {0}, best = 0, least = INFINITY;
    int n = 1, inside = 0;

    for (int i = 0, m = gsl_poly_solve_quadratic(3 * g[3], 2 * g[2], g[1], &turn[0], &turn[1]); i < m; i++)
        if (turn[i] > 0 && turn[i] < 1)
            at[n++] = turn[i];
    at[n++] = 1;
    for (int i = 0; i < n; i++) {
        int crosses = i > 0 && polynomial(g, at[i - 1]) < 0 && polynomial(g, at[i]) >= 0;
        double u = crosses ? cubic_root(g, at[i - 1], at[i]) : at[i], d[3];

        for (int k = 0; k < 3; k++)
            d[k] = r[k] + (c[2][k] * u + c[1][k]) * u;
        if (is_nearer(dot(d, d), crosses, least, inside)) {
            least = dot(d, d);
            inside = crosses;
            best = u;
        }
    }
    return best;
}

static void nearest_on_edge(const facet *f, int edge, const double *x, facet_point *p)
{
    const int a = edge_of[f->kind][edge][0], b = edge_of[f->kind][edge][1];
    const double *from = vertex_at[f->kind][a], *to = vertex_at[f->kind][b];
    const double middle[2] = {0.5 * (from[0] + to[0]), 0.5 * (from[1] + to[1])};
    double at[3][3], c[3][3], y[3] = {0}, u;

    place(f, from, at[0]);
    place(f, middle, at[1]);
    place(f, to, at[2]);
    for (int k = 0; k < 3; k++) {
        y[k] = k < f->dim ? x[k] : 0;
        c[0][k] = at[0][k];
        c[1][k] = 4 * at[1][k] - 3 * at[0][k] - at[2][k];
        c[2][k] = 2 * (at[0][k] - 2 * at[1][k] + at[2][k]);
    }
    u = nearest_on_curve(c, y);
    for (int i = 0; i < 2; i++)
        p->s[i] = u < 1 ? from[i] + u * (to[i] - from[i]) : to[i];
    p->n_vertex = u > 0 && u < 1 ? (f->kind == FACET_LINE ? 0 : 2) : 1;
    p->vertex[0] = u < 1 ? a : b;
    p->vertex[1] = b;
}

static int is_within(const facet *f, const double *s, double margin)
{
    if (f->kind == FACET_TRIANGLE)
        return s[0] >= -margin && s[1] >= -margin && s[0] + s[1] <= 1 + margin;
    return fabs(s[0]) <= 1 + margin && fabs(s[1]) <= 1 + margin;
}

/* Newton's step for the squared distance; Gauss's, without the second derivatives, where that is no way down. */
static void newton_step(const facet *f, const double *s, const double *x, double *step)
{
    double d[6][3], r[3], g[2], h[3], det;

    derivatives(f, s, d);
    for (int k = 0; k < 3; k++)
        r[k] = d[0][k] - x[k];
    g[0] = dot(r, d[1]), g[1] = dot(r, d[2]);
    for (int with = 1; with >= 0; with--) {
        h[0] = dot(d[1], d[1]) + with * dot(r, d[3]);
        h[1] = dot(d[1], d[2]) + with * dot(r, d[4]);
        h[2] = dot(d[2], d[2]) + with * dot(r, d[5]);
        det = h[0] * h[2] - h[1] * h[1];
        if (h[0] > 0 && det > 1e-8 * h[0] * h[2])
            break;
    }
    step[0] = -(h[2] * g[0] - h[1] * g[1]) / det;
    step[1] = -(h[0] * g[1] - h[1] * g[0]) / det;
}

/* A minimum inside a triangle or quadrilateral; 0 if Newton leaves it. */
static int nearest_inside(const facet *f, const double *x, double *s)
{
    static const double quad[5][2] = {{0, 0}, {-.6, -.6}, {.6, -.6}, {-.6, .6}, {.6, .6}};
    static const double triangle[4][2] = {{1 / 3., 1 / 3.}, {.15, .15}, {.7, .15}, {.15, .7}};
    const double(*start)[2] = f->kind == FACET_QUAD ? quad : triangle;
    double least = INFINITY;

    for (int i = 0; i < (f->kind == FACET_QUAD ? 5 : 4); i++) {
        double d = squared_distance(f, start[i], x);

        if (d < least) {
            least = d;
            memcpy(s, start[i], sizeof start[i]);
        }
    }
    for (int i = 0; i < 40; i++) {
        double step[2], to[2], part = 1, d;

        newton_step(f, s, x, step);
        if (!isfinite(step[0]) || !isfinite(step[1]))
            return 0;
        do {
            to[0] = s[0] + part * step[0];
            to[1] = s[1] + part * step[1];
            d = squared_distance(f, to, x);
            part *= 0.5;
        } while (d > least * (1 + 1e-14) && part > 1e-6);
        memcpy(s, to, sizeof to);
        least = d;
        if (!is_within(f, s, 1))
            return 0;
        if (fmax(fabs(step[0]), fabs(step[1])) < 1e-13)
            break;
    }
    return is_within(f, s, 0);
}

void facet_nearest(const facet *f, const double *x, facet_point *p)
{
    double least = INFINITY, s[2];

    for (int e = 0; e < n_edges[f->kind]; e++) {
        facet_point on;
        double d;

        nearest_on_edge(f, e, x, &on);
        d = squared_distance(f, on.s, x);
        if (e == 0 || is_nearer(d, on.n_vertex, least, p->n_vertex)) {
            least = d;
            *p = on;
        }
    }
    if (f->kind != FACET_LINE && nearest_inside(f, x, s) && is_nearer(squared_distance(f, s, x), 3, least, 0)) {
        least = squared_distance(f, s, x);
        memcpy(p->s, s, sizeof s);
        p->n_vertex = 0;
    }
    p->distance = sqrt(least);
    place(f, p->s, p->x);
}

int facet_axis(const mesh *m, int64_t f)
{
    const int32_t *cell = m->cell + (int64_t)m->facet[f].cell * m->type->n_node;

    for (int k = 0; k < m->dim; k++) {
        double low = INFINITY, high = -INFINITY;

        for (int i = 0; i < m->type->facet_nodes; i++) {
            double x = m->x[(int64_t)cell[m->type->facet[m->facet[f].local][i]] * m->dim + k];

            low = fmin(low, x);
            high = fmax(high, x);
        }
        if (high - low < 1e-8 * m->h[m->facet[f].cell])
            return k;
    }
    return -1;
}
