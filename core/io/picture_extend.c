/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A field that has no values in bodies, continued a little into them, so that cells which the surface cuts can be
 * coloured right up to it.  A covered node takes the linear function that fits best, in least squares, the nodes
 * with values of all cells round it that hold fluid,
 *
 *     sum_j (f_m + g.(x_j - x_m) - f_j)^2 -> min,     C g = b,     C = <dx dx^T>,  b = <dx df>,
 *
 * <> and m: mean over these nodes.  Nodes whose neighbours determine g come first; for the others those count, too.
 * Where they still lie on a line or in a plane, conjugate gradients from g = 0 give the shortest g.  Cells in a gap
 * between bodies that hold no node of the fluid take means of neighbours. */
#include "io/picture_parts.h"

#include <math.h>
#include <string.h>

/* Sums over the nodes round a covered one, places relative to it. */
typedef struct fit {
    size_t node;
    double n, x[3], xx[3][3];
    double f[PICTURE_MAGNITUDE], fx[PICTURE_MAGNITUDE][3], low[PICTURE_MAGNITUDE],
        high[PICTURE_MAGNITUDE]; /* per component */
} fit;

typedef struct extension {
    const vtu_file *v;
    int width;        /* components of the field                           */
    double *value;    /* [n_point][width]                                  */
    uint8_t *missing; /* [n_point] covered, and without a value as yet      */
    int32_t *fit_of;  /* [n_point] or -1                                   */
    fit *fit;
    int n_fit;
} extension;

static void add_node(const extension *e, fit *t, size_t j)
{
    double d[3];

    for (int k = 0; k < 3; k++) {
        d[k] = vtu_number(&e->v->point, 3 * j + (size_t)k) - vtu_number(&e->v->point, 3 * t->node + (size_t)k);
        t->x[k] += d[k];
    }
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 3; i++)
            t->xx[k][i] += d[k] * d[i];
    for (int c = 0; c < e->width; c++) {
        double f = e->value[j * (size_t)e->width + (size_t)c];

        t->low[c] = t->n > 0 ? fmin(t->low[c], f) : f;
        t->high[c] = t->n > 0 ? fmax(t->high[c], f) : f;
        t->f[c] += f;
        for (int k = 0; k < 3; k++)
            t->fx[c][k] += f * d[k];
    }
    t->n++;
}

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Solves C g = b; directions along which the nodes hardly differ are left out. */
static void slope(const double c[3][3], const double *b, double *g)
{
    const double flat = 1e-4; /* of the trace: a hundredth in length */
    double r[3] = {b[0], b[1], b[2]}, p[3] = {b[0], b[1], b[2]}, rr = dot(r, r),
           trace = c[0][0] + c[1][1] + c[2][2];

    memset(g, 0, 3 * sizeof *g);
    for (int it = 0; it < 3 && rr > 0; it++) {
        double cp[3] = {dot(c[0], p), dot(c[1], p), dot(c[2], p)}, bend = dot(p, cp), step = rr / bend, before = rr;

        if (!(bend > flat * trace * dot(p, p)))
            return;
        for (int k = 0; k < 3; k++) {
            g[k] += step * p[k];
            r[k] -= step * cp[k];
        }
        rr = dot(r, r);
        for (int k = 0; k < 3; k++)
            p[k] = r[k] + rr / before * p[k];
    }
}

/* Mean place m and covariance of the nodes round a covered one. */
static void spread(const fit *t, double *m, double c[3][3])
{
    for (int k = 0; k < 3; k++)
        m[k] = t->x[k] / t->n;
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 3; i++)
            c[k][i] = t->xx[k][i] / t->n - m[k] * m[i];
}

/* Whether the nodes determine a gradient: they differ in each coordinate, and these are not nearly dependent. */
static int determines_slope(const fit *t, int dim)
{
    const double least = 1e-2, flat = 1e-10;
    double m[3], c[3][3], det, size;

    spread(t, m, c);
    for (int k = 0; k < dim; k++)
        if (!(c[k][k] > flat * (c[0][0] + c[1][1] + c[2][2])))
            return 0;
    if (dim == 2)
        c[2][2] = 1;
    size = c[0][0] * c[1][1] * c[2][2];
    det = c[0][0] * (c[1][1] * c[2][2] - c[1][2] * c[1][2]) - c[0][1] * (c[0][1] * c[2][2] - c[1][2] * c[0][2]) +
          c[0][2] * (c[0][1] * c[1][2] - c[1][1] * c[0][2]);
    return det > least * size;
}

/* Value of component i at the covered node; it leaves the range of the others by at most three times that range,
 * as much as a linear field does in a square. */
static double fitted(const fit *t, int i)
{
    double mean = t->f[i] / t->n, range = t->high[i] - t->low[i], m[3], c[3][3], b[3], g[3];

    spread(t, m, c);
    for (int k = 0; k < 3; k++)
        b[k] = t->fx[i][k] / t->n - mean * m[k];
    slope((const double(*)[3])c, b, g);
    return fmax(t->low[i] - 3 * range, fmin(t->high[i] + 3 * range, mean - dot(g, m)));
}

static int has_value(const extension *e, size_t j)
{
    int finite = !e->missing[j];

    for (int c = 0; c < e->width; c++)
        finite = finite && isfinite(e->value[j * (size_t)e->width + (size_t)c]);
    return finite;
}

/* Adds the nodes with values of a cell to the sums of those without. */
static void add_cell(extension *e, size_t c)
{
    size_t point[FE_MAX_NODES];
    int n = vtu_cell(e->v, c, point)->n_node;

    for (int i = 0; i < n; i++) {
        fit *t = e->missing[point[i]] ? &e->fit[e->fit_of[point[i]]] : NULL;

        for (int j = 0; t && j < n; j++)
            if (has_value(e, point[j]))
                add_node(e, t, point[j]);
    }
}

enum layer {
    DETERMINED, /* nodes of cells with fluid whose neighbours determine the gradient */
    ANY,        /* all nodes of cells with fluid                                     */
    GAPS        /* nodes of cells that lie in several bodies, by means               */
};

/* Nodes of a kind get values from their neighbours that have some; returns how many. */
static int add_layer(extension *e, enum layer kind)
{
    int n = 0;

    for (int k = 0; k < e->n_fit; k++)
        e->fit[k] = (fit){.node = e->fit[k].node};
    for (size_t c = 0; c < e->v->n_cell; c++)
        if (patch_body(e->v, c) == (kind == GAPS ? PATCH_IN_SEVERAL : PATCH_IN_FLUID))
            add_cell(e, c);
    for (int k = 0; k < e->n_fit; k++) {
        const fit *t = &e->fit[k];

        if (!e->missing[t->node] || !(t->n > 0) || (kind == DETERMINED && !determines_slope(t, e->v->dim)))
            continue;
        for (int c = 0; c < e->width; c++)
            e->value[t->node * (size_t)e->width + (size_t)c] = kind == GAPS ? t->f[c] / t->n : fitted(t, c);
        e->missing[t->node] = 0;
        n++;
    }
    return n;
}

int extend_into_bodies(const vtu_file *v, const vtu_array *field, vtu_array *to, arena *a, error *err)
{
    extension e = {.v = v, .width = field->components};

    *to = *field;
    if (!v->body.at)
        return 0;
    ARENA_NEW(a, e.value, field->n, err);
    ARENA_NEW(a, e.missing, v->n_point, err);
    ARENA_NEW(a, e.fit_of, v->n_point, err);
    for (size_t i = 0; i < field->n; i++) {
        e.value[i] = vtu_number(field, i);
        e.missing[i / (size_t)e.width] |= isnan(e.value[i]) && vtu_integer(&v->body, i / (size_t)e.width) >= 0;
    }
    for (size_t i = 0; i < v->n_point; i++)
        e.fit_of[i] = e.missing[i] ? e.n_fit++ : -1;
    if (!e.n_fit)
        return 0;
    ARENA_NEW(a, e.fit, e.n_fit, err);
    for (size_t i = 0; i < v->n_point; i++)
        if (e.missing[i])
            e.fit[e.fit_of[i]].node = i;
    while (add_layer(&e, DETERMINED) > 0)
        ;
    while (add_layer(&e, ANY) > 0)
        ;
    while (add_layer(&e, GAPS) > 0)
        ;
    to->kind = VTU_FLOAT64;
    to->at = (const unsigned char *)e.value;
    return 0;
}
