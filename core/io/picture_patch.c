/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Cells of second order cut into small simplices.  The points of a cell are a grid of (n+1)^dim;
 * a square of the grid has two triangles, a cube six tetrahedra, each along a path of unit
 * steps from one corner to the opposite one (Kuhn).  Those of them where i >= j >= k fill a
 * large simplex of the same kind, onto which triangles and tets are mapped:
 *
 *     quad, hex   xi = (2i/n - 1, 2j/n - 1, 2k/n - 1)
 *     triangle    xi = (i - j, j) / n
 *     tet         xi = (i - j, j - k, k) / n */
#include "io/picture_parts.h"

#include <math.h>
#include <string.h>

void patch_box(const vtu_file *v, size_t c, double low[3], double high[3])
{
    size_t point[FE_MAX_NODES];
    const fe_cell *cell = vtu_cell(v, c, point);

    for (int k = 0; k < 3; k++) {
        low[k] = INFINITY;
        high[k] = -INFINITY;
        for (int i = 0; i < cell->n_node; i++) {
            double x = vtu_number(&v->point, 3 * point[i] + (size_t)k);

            low[k] = fmin(low[k], x);
            high[k] = fmax(high[k], x);
        }
    }
}

int patch_body(const vtu_file *v, size_t c)
{
    size_t point[FE_MAX_NODES];
    int n = vtu_cell(v, c, point)->n_node, several = 0;
    int64_t first = v->body.at ? vtu_integer(&v->body, point[0]) : -1;

    for (int i = 0; i < n; i++) {
        int64_t body = v->body.at ? vtu_integer(&v->body, point[i]) : -1;

        if (body < 0)
            return PATCH_IN_FLUID;
        several |= body != first;
    }
    return several ? PATCH_IN_SEVERAL : (int)first;
}

typedef struct nodes {
    const fe_cell *cell;
    double x[FE_MAX_NODES][3], colour[FE_MAX_NODES][PICTURE_MAGNITUDE], arrow[FE_MAX_NODES][3];
} nodes;

static void nodes_read(const vtu_file *v, const picture_field *f, size_t c, nodes *d)
{
    size_t point[FE_MAX_NODES];

    d->cell = vtu_cell(v, c, point);
    for (int i = 0; i < d->cell->n_node; i++) {
        const vtu_array *a = f->colour, *b = f->arrow;

        for (int k = 0; k < 3; k++) {
            d->x[i][k] = vtu_number(&v->point, 3 * point[i] + (size_t)k);
            d->arrow[i][k] = b ? vtu_number(b, 3 * point[i] + (size_t)k) : 0;
        }
        for (int k = 0; k < a->components; k++)
            d->colour[i][k] = vtu_number(a, point[i] * (size_t)a->components + (size_t)k);
    }
}

/* Root of the sum of squares of all components; of a symmetric tensor those off the diagonal stand for two. */
static double magnitude(const double *u, int n)
{
    double sum = 0;

    for (int k = 0; k < n; k++)
        sum += (n == 6 && k > 2 ? 2 : 1) * u[k] * u[k];
    return sqrt(sum);
}

static void evaluate(const nodes *d, const picture_view *view, const picture_field *f, const double *xi,
                     picture_point *p)
{
    double n[FE_MAX_NODES], dn[FE_MAX_NODES][3], u[PICTURE_MAGNITUDE] = {0}, w[3] = {0};
    int n_comp = f->colour->components;

    memset(p, 0, sizeof *p);
    fe_basis(d->cell, 2, xi, n, dn);
    for (int i = 0; i < d->cell->n_node; i++) {
        for (int k = 0; k < 3; k++) {
            p->x[k] += n[i] * d->x[i][k];
            w[k] += n[i] * d->arrow[i][k];
        }
        for (int k = 0; k < n_comp; k++)
            u[k] += n[i] * d->colour[i][k];
    }
    if (f->component < PICTURE_MAGNITUDE)
        p->value[0] = u[f->component];
    else
        p->value[0] = n_comp == 1 ? u[0] : magnitude(u, n_comp);
    p->value[1] = w[view->across[0]];
    p->value[2] = w[view->across[1]];
}

static int in_simplex(const int at[3])
{
    return at[0] >= at[1] && at[1] >= at[2];
}

static void fill(const nodes *d, const picture_view *view, const picture_field *f, picture_patch *patch)
{
    int n = patch->n, nz = view->dim == 3 ? n : 0;
    picture_point *p = patch->point;

    for (int k = 0; k <= nz; k++)
        for (int j = 0; j <= n; j++)
            for (int i = 0; i <= n; i++, p++) {
                int at[3] = {i, j, k};
                double xi[3];

                if (d->cell->simplex && !in_simplex(at))
                    continue;
                for (int m = 0; m < 3; m++)
                    xi[m] = d->cell->simplex ? (at[m] - (m < 2 ? at[m + 1] : 0)) / (double)n
                                             : (2 * at[m] - n) / (double)n;
                evaluate(d, view, f, xi, p);
            }
}

static void between(const picture_point *a, const picture_point *b, double s, picture_point *p)
{
    for (int k = 0; k < 3; k++) {
        p->x[k] = (1 - s) * a->x[k] + s * b->x[k];
        p->value[k] = (1 - s) * a->value[k] + s * b->value[k];
    }
}

int patch_section(const picture_view *view, const picture_point *const *p, int n, picture_point section[4])
{
    const picture_point *below[4], *above[4];
    double under[4], over[4];
    int nb = 0, na = 0, m = 0;

    for (int i = 0; i < n; i++) {
        double d = p[i]->x[view->normal] - view->at;

        if (fabs(d) <= view->near) /* a face in the plane belongs to the cell below, all of it */
            d = 0;
        if (d < 0) {
            under[nb] = d;
            below[nb++] = p[i];
        } else {
            over[na] = d;
            above[na++] = p[i];
        }
    }
    for (int i = 0; i < nb; i++)
        for (int j = 0; j < na; j++) {
            int t = i % 2 ? na - 1 - j : j; /* around the quadrilateral, not across */

            between(below[i], above[t], under[i] / (under[i] - over[t]), section + m++);
        }
    return m;
}

/* The simplex from corner `at` of the grid along the steps of order. */
static void simplex(const nodes *d, const picture_view *view, const picture_patch *patch, const int at[3],
                    const int *order, picture_triangle take, void *to)
{
    const picture_point *p[4];
    picture_point s[4];
    int q[3] = {at[0], at[1], at[2]}, m = patch->n + 1;

    for (int i = 0; i <= view->dim; i++) {
        if (i)
            q[order[i - 1]]++;
        if (d->cell->simplex && !in_simplex(q))
            return;
        p[i] = patch->point + q[0] + m * (q[1] + m * q[2]);
    }
    if (view->dim == 2) {
        take(to, p[0], p[1], p[2]);
        return;
    }
    m = patch_section(view, p, 4, s);
    if (m >= 3)
        take(to, s, s + 1, s + 2);
    if (m == 4)
        take(to, s, s + 2, s + 3);
}

void patch_triangles(const vtu_file *v, const picture_view *view, const picture_field *f, size_t c, int n,
                     picture_patch *patch, picture_triangle take, void *to)
{
    static const int order[8][3] = {{0, 1, 2}, {1, 0, 2}, {0, 1, 2}, {0, 2, 1},
                                    {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    int first = view->dim == 2 ? 0 : 2, end = view->dim == 2 ? 2 : 8, nz = view->dim == 3 ? n : 1;
    nodes d;

    nodes_read(v, f, c, &d);
    patch->n = n;
    fill(&d, view, f, patch);
    for (int k = 0; k < nz; k++)
        for (int j = 0; j < n; j++)
            for (int i = 0; i < n; i++)
                for (int s = first; s < end; s++)
                    simplex(&d, view, patch, (const int[3]){i, j, k}, order[s], take, to);
}
