/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Quadrature on the part of a cell inside a body and on the body's surface in the cell, for bodies
 * given by a level function.
 *
 * In a box where the level is monotone in one direction, lines along it cross the surface at most once:
 * Gauss points on the piece inside, a surface point at the crossing.  The lines stand on Gauss points of
 * the remaining directions, split where the surface passes through the box's lower or upper side, so that
 * what is integrated there is smooth (Saye 2015, SIAM J. Sci. Comput. 37:A993).  A box without such a
 * direction is halved; what is left at the last level is inside or outside by its Gauss points.
 * Simplices are boxes collapsed (Duffy). */
#include "particle/implicit.h"

#include <math.h>
#include <string.h>

/* A direction serves for lines if the slope along it is at least this part of the whole. */
#define MONOTONE 0.4

enum { WRONG = 2, DEPTH_2D = 5, DEPTH_3D = 4 };

/* Gauss points of a box that is inside (test = 0), or of those that are. */
static void fill(implicit_work *w, const implicit_box *b, int test)
{
    const int n = IMPLICIT_ALONG;
    double c[3] = {0};

    for (int q = 0; q < (w->dim == 2 ? n * n : n * n * n); q++) {
        int i[3] = {q % n, q / n % n, q / (n * n)};
        double weight = 1;

        for (int k = 0; k < w->dim; k++) {
            double half = 0.5 * (b->high[k] - b->low[k]);

            c[k] = b->low[k] + half * (1 + w->rule->along_x[i[k]]);
            weight *= half * w->rule->along_w[i[k]];
        }
        if (test && implicit_level(w, c) >= 0)
            w->partly = 1;
        else
            implicit_emit(w, c, weight);
    }
}

/* How well a direction serves, over several points: the least part of the slope along it, 0 if it vanishes or
 * changes its sign somewhere. */
typedef struct direction {
    double share, sum; /* of all points                         */
    int sign, known;   /* of the slope so far; WRONG: it changes */
} direction;

static void judge(direction *d, double part, double size)
{
    int here = part > 0 ? 1 : part < 0 ? -1 : 0;

    if (isnan(part)) /* a collapsed corner says nothing */
        return;
    if (here && d->sign && d->sign != here)
        d->sign = WRONG;
    else if (here)
        d->sign = here;
    d->share = d->sign == WRONG || !here ? 0 : fmin(d->known ? d->share : 1, fabs(part) / size);
    d->sum += fabs(part);
    d->known = 1;
}

/* At the last level: a direction in which the level does not change its sense, though it may rest (at an edge). */
static int last_resort(const direction *by, int dim)
{
    int best = -1;

    for (int k = 0; k < dim; k++)
        if (by[k].sign && by[k].sign != WRONG && (best < 0 || by[k].sum > by[best].sum))
            best = k;
    return best;
}

static double known(double part)
{
    return isnan(part) ? 0 : part;
}

/* Over 3^dim points of the box: the level in the middle, how much it may change from there, the directions. */
typedef struct survey {
    double centre, reach;
    direction by[3];
} survey;

static survey look(const implicit_work *w, const implicit_box *b)
{
    survey s = {0};
    double most[3] = {0};

    for (int q = 0; q < (w->dim == 2 ? 9 : 27); q++) {
        int i[3] = {q % 3, q / 3 % 3, q / 9};
        double c[3] = {0}, g[3], by_x[3], part[3] = {0};

        for (int k = 0; k < w->dim; k++)
            c[k] = b->low[k] + 0.5 * i[k] * (b->high[k] - b->low[k]);
        implicit_slope(w, c, g, by_x, part);
        if (q == (w->dim == 2 ? 4 : 13))
            s.centre = implicit_level(w, c);
        for (int k = 0; k < w->dim; k++) {
            most[k] = fmax(most[k], fabs(g[k]) * (b->high[k] - b->low[k]));
            judge(&s.by[k], part[k], hypot(hypot(known(part[0]), known(part[1])), known(part[2])));
        }
    }
    for (int k = 0; k < w->dim; k++)
        s.reach += 0.6 * most[k];
    return s;
}

/* For lines along k in 3D: the direction j in which, on the sides low and high of k that the surface crosses, the
 * level is monotone; *share: how well, infinite if it crosses neither. */
static int inner_direction(const implicit_work *w, const implicit_box *b, int k, double *share)
{
    const int d[2] = {(k + 1) % 3, (k + 2) % 3};
    double least[2] = {INFINITY, INFINITY};

    for (int side = 0; side < 2; side++) {
        direction by[2] = {{0}};
        double reach[2] = {0}, centre = 0;

        for (int q = 0; q < 9; q++) {
            double c[3], g[3], by_x[3], part[3];

            c[k] = side ? b->high[k] : b->low[k];
            for (int i = 0; i < 2; i++)
                c[d[i]] = b->low[d[i]] + 0.5 * (i ? q / 3 : q % 3) * (b->high[d[i]] - b->low[d[i]]);
            implicit_slope(w, c, g, by_x, part);
            if (q == 4)
                centre = implicit_level(w, c);
            for (int i = 0; i < 2; i++) {
                reach[i] = fmax(reach[i], fabs(g[d[i]]) * (b->high[d[i]] - b->low[d[i]]));
                judge(&by[i], part[d[i]], hypot(known(part[d[0]]), known(part[d[1]])));
            }
        }
        for (int i = 0; i < 2 && fabs(centre) <= 0.6 * (reach[0] + reach[1]); i++)
            least[i] = fmin(least[i], by[i].share);
    }
    *share = fmax(least[0], least[1]);
    return least[1] > least[0] ? d[1] : d[0];
}

static void divide(implicit_work *w, const implicit_box *b, int depth);

static void integrate(implicit_work *w, const implicit_box *b, int depth)
{
    survey s = look(w, b);
    int k = 0, j = 0, again = depth < (shape_is_smooth(w->b->shape) ? 0 : 2);
    double share = INFINITY;

    if (fabs(s.centre) > s.reach) {
        if (s.centre < 0)
            fill(w, b, 0);
        else
            w->partly = 1;
        return;
    }
    for (int i = 1; i < w->dim; i++)
        k = s.by[i].share > s.by[k].share ? i : k;
    if (w->dim == 3)
        j = inner_direction(w, b, k, &share);
    if (again || ((s.by[k].share < MONOTONE || share < MONOTONE / 2) && depth < w->most_depth)) {
        divide(w, b, depth);
        return;
    }
    if (s.by[k].share == 0 && (k = last_resort(s.by, w->dim)) < 0) {
        fill(w, b, 1);
        return;
    }
    if (w->dim == 3 && j == k)
        j = (k + 1) % 3;
    if (w->dim == 2)
        implicit_sweep(w, b, (double[3]){0}, k, 1 - k, 1);
    else
        implicit_sweep_planes(w, b, k, j, 3 - k - j);
}

static void divide(implicit_work *w, const implicit_box *b, int depth)
{
    for (int q = 0; q < 1 << w->dim; q++) {
        implicit_box part = *b;

        for (int k = 0; k < w->dim; k++) {
            double middle = 0.5 * (b->low[k] + b->high[k]);

            if (q >> k & 1)
                part.low[k] = middle;
            else
                part.high[k] = middle;
        }
        integrate(w, &part, depth + 1);
    }
}

/* Whether the mapping of the cell is affine; then it is kept. */
static int find_affine(implicit_work *w)
{
    const mesh *m = w->m;
    const fe_cell *t = m->type;
    double zero[3] = {0}, j[3][3], size = m->h[w->cell];

    mesh_place(m, w->cell, zero, w->x0, j);
    memcpy(w->j, j, sizeof j);
    for (int i = 0; i < t->n_node; i++)
        for (int a = 0; a < m->dim; a++) {
            double x = w->x0[a];

            for (int b = 0; b < m->dim; b++)
                x += j[a][b] * t->x[i][b];
            if (fabs(x - m->x[(int64_t)m->cell[(int64_t)w->cell * t->n_node + i] * m->dim + a]) > 1e-12 * size)
                return 0;
        }
    return 1;
}

int implicit_rule_create(implicit_rule *r, int dim, error *err)
{
    r->n_across = dim == 2 ? 6 : 4;
    TRY(fe_gauss(IMPLICIT_ALONG, r->along_x, r->along_w, err));
    return fe_gauss(r->n_across, r->across_x, r->across_w, err);
}

int implicit_cell(const implicit_rule *r, const mesh *m, int32_t cell, const solid *b, const implicit_sink *sink,
                  int *whole, error *err)
{
    implicit_work w = {.rule = r, .m = m, .b = b, .sink = sink, .dim = m->dim, .cell = cell};
    implicit_box unit = {{0}, {1, 1, 1}};

    w.most_depth = m->dim == 2 ? DEPTH_2D : DEPTH_3D;
    if (!shape_is_smooth(b->shape)) /* edges are cut off at the last level */
        w.most_depth += m->dim == 2 ? 3 : 1;
    w.size = m->h[cell];
    w.affine = find_affine(&w);
    integrate(&w, &unit, 0);
    *whole = !w.partly;
    return shape_check(b->shape, err);
}
