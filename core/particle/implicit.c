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
#include "particle/particle.h"

#include <math.h>
#include <string.h>

/* A direction serves for lines if the slope along it is at least this part of the whole. */
#define MONOTONE 0.4

enum { WRONG = 2, MOST_ROOTS = 16, PROBES = 6, DEPTH_2D = 5, DEPTH_3D = 4 };

typedef struct work {
    const mesh *m;
    const solid *b;
    const implicit_sink *sink;
    int dim, affine, partly, most_depth;
    int32_t cell;
    double x0[3], j[3][3]; /* of the cell, if it is affine */
    int n_gauss;           /* across the lines             */
    double size;           /* of the cell                  */
} work;

typedef struct box {
    double low[3], high[3];
} box;

static const double gauss_x[4][6] = {
    {-0.86113631159405257522, -0.33998104358485626480, 0.33998104358485626480, 0.86113631159405257522},
    {-0.90617984593866399280, -0.53846931010568309104, 0, 0.53846931010568309104, 0.90617984593866399280},
    {-0.93246951420315202781, -0.66120938646626451366, -0.23861918608319690863, 0.23861918608319690863,
     0.66120938646626451366, 0.93246951420315202781}};
static const double gauss_w[4][6] = {
    {0.34785484513745385737, 0.65214515486254614263, 0.65214515486254614263, 0.34785484513745385737},
    {0.23692688505618908751, 0.47862867049936646804, 0.56888888888888888889, 0.47862867049936646804,
     0.23692688505618908751},
    {0.17132449237917034504, 0.36076157304813860757, 0.46791393457269104739, 0.46791393457269104739,
     0.36076157304813860757, 0.17132449237917034504}};

/* --- the level in coordinates c of the unit box --- */

/* Reference coordinates of c, and their derivatives d[i][k] = d xi_i / d c_k; returns the determinant. */
static double reference(const work *w, const double *c, double *xi, double d[3][3])
{
    memset(d, 0, 9 * sizeof(double));
    if (!w->m->type->simplex) {
        for (int k = 0; k < w->dim; k++) {
            xi[k] = 2 * c[k] - 1;
            d[k][k] = 2;
        }
        return w->dim == 2 ? 4 : 8;
    }
    if (w->dim == 2) {
        xi[0] = c[0] * (1 - c[1]);
        xi[1] = c[1];
        d[0][0] = 1 - c[1], d[0][1] = -c[0], d[1][1] = 1;
        return 1 - c[1];
    }
    xi[0] = c[0] * (1 - c[1]) * (1 - c[2]);
    xi[1] = c[1] * (1 - c[2]);
    xi[2] = c[2];
    d[0][0] = (1 - c[1]) * (1 - c[2]), d[0][1] = -c[0] * (1 - c[2]), d[0][2] = -c[0] * (1 - c[1]);
    d[1][1] = 1 - c[2], d[1][2] = -c[1], d[2][2] = 1;
    return (1 - c[1]) * (1 - c[2]) * (1 - c[2]);
}

/* Place of reference coordinates; j[a][b] = d x_a / d xi_b. */
static void place(const work *w, const double *xi, double *x, double j[3][3])
{
    double n[FE_MAX_NODES], dn[FE_MAX_NODES][3];

    if (w->affine) {
        for (int a = 0; a < w->dim; a++) {
            x[a] = w->x0[a];
            for (int b = 0; b < w->dim; b++) {
                x[a] += w->j[a][b] * xi[b];
                j[a][b] = w->j[a][b];
            }
        }
        return;
    }
    fe_basis(w->m->type, 2, xi, n, dn);
    mesh_map(w->m, w->cell, n, (const double(*)[3])dn, x, j);
}

static double level(const work *w, const double *c)
{
    double xi[3] = {0}, d[3][3], x[3] = {0}, j[3][3];

    reference(w, c, xi, d);
    place(w, xi, x, j);
    return solid_level(w->b, x);
}

/* Gradient with respect to c, also to x; part[k]: along the line of c_k in space, per length (NAN where the line is
 * a point, in the corner of a collapsed box). */
static void slope(const work *w, const double *c, double *by_c, double *by_x, double *part)
{
    double xi[3] = {0}, d[3][3], x[3] = {0}, j[3][3] = {{0}};

    reference(w, c, xi, d);
    place(w, xi, x, j);
    solid_slope(w->b, x, by_x);
    for (int k = 0; k < w->dim; k++) {
        double speed = 0;

        by_c[k] = 0;
        for (int a = 0; a < w->dim; a++) {
            double along = 0; /* d x_a / d c_k */

            for (int i = 0; i < w->dim; i++)
                along += j[a][i] * d[i][k];
            by_c[k] += by_x[a] * along;
            speed += along * along;
        }
        part[k] = speed > 1e-24 * w->size * w->size ? by_c[k] / sqrt(speed) : NAN;
    }
}

/* --- lines --- */

/* A root of the level on the line c + s e_k between a and b with values of opposite sign: Illinois. */
static double root(const work *w, double *c, int k, double a, double fa, double b, double fb)
{
    for (int i = 0, side = 0; i < 60 && fabs(b - a) > 1e-15; i++) {
        double s = (fa * b - fb * a) / (fa - fb), f;

        if (!(s > fmin(a, b) && s < fmax(a, b)))
            s = 0.5 * (a + b);
        c[k] = s;
        f = level(w, c);
        if (f == 0 || fabs(f) < 1e-15)
            return s;
        if ((f > 0) == (fa > 0)) {
            a = s, fa = f;
            fb *= side == 1 ? 0.5 : 1;
            side = 1;
        } else {
            b = s, fb = f;
            fa *= side == 2 ? 0.5 : 1;
            side = 2;
        }
    }
    return 0.5 * (a + b);
}

/* Where the parabola through three equidistant values has its vertex, in steps from the middle one. */
static double vertex(const double *f)
{
    double bend = f[0] - 2 * f[1] + f[2];

    return bend != 0 ? 0.5 * (f[0] - f[2]) / bend : INFINITY;
}

/* Adds the roots of the level on the line through c along k: from changes of sign, and pairs of them from values
 * of one sign that bend towards zero. */
static int add_roots(const work *w, const double *through, int k, double low, double high, double *list, int n)
{
    double c[3] = {through[0], through[1], through[2]}, f[PROBES + 1], at[PROBES + 1];

    for (int i = 0; i <= PROBES; i++) {
        at[i] = c[k] = low + (high - low) * i / PROBES;
        f[i] = level(w, c);
    }
    for (int i = 1; i <= PROBES && n < MOST_ROOTS; i++)
        if ((f[i] > 0) != (f[i - 1] > 0))
            list[n++] = root(w, c, k, at[i - 1], f[i - 1], at[i], f[i]);
    for (int i = 1; i < PROBES && n + 1 < MOST_ROOTS; i++) {
        double s = vertex(f + i - 1), g;

        if ((f[i] > 0) != (f[i - 1] > 0) || (f[i] > 0) != (f[i + 1] > 0) || !(fabs(s) <= 1) ||
            (s == 1 && i + 1 < PROBES))
            continue;
        s = c[k] = at[i] + s * (at[i] - at[i - 1]);
        g = level(w, c);
        if ((g > 0) == (f[i] > 0))
            continue;
        list[n++] = root(w, c, k, at[i - 1], f[i - 1], s, g);
        list[n++] = root(w, c, k, s, g, at[i + 1], f[i + 1]);
    }
    return n;
}

/* Ends and roots in ascending order. */
static int breakpoints(double low, double high, double *list, int n)
{
    list[n++] = low;
    list[n++] = high;
    for (int i = 1; i < n; i++)
        for (int j = i; j > 0 && list[j] < list[j - 1]; j--) {
            double swap = list[j];

            list[j] = list[j - 1];
            list[j - 1] = swap;
        }
    return n;
}

static void emit_inside(const work *w, const double *c, double weight)
{
    double xi[3] = {0}, d[3][3];
    double det = reference(w, c, xi, d);

    w->sink->inside(w->sink->ctx, xi, weight * det);
}

/* Area element at a crossing: n ds = det(dx/dc) grad phi / |d phi / d c_k| dc', n out of the body. */
static void emit_surface(const work *w, const double *c, int k, double weight)
{
    double xi[3] = {0}, d[3][3], x[3] = {0}, j[3][3] = {{0}}, by_c[3], by_x[3], part[3], det, nds[3] = {0};

    if (!w->sink->surface)
        return;
    det = reference(w, c, xi, d);
    place(w, xi, x, j);
    det *= w->dim == 2 ? j[0][0] * j[1][1] - j[0][1] * j[1][0]
                       : j[0][0] * (j[1][1] * j[2][2] - j[1][2] * j[2][1]) -
                             j[0][1] * (j[1][0] * j[2][2] - j[1][2] * j[2][0]) +
                             j[0][2] * (j[1][0] * j[2][1] - j[1][1] * j[2][0]);
    slope(w, c, by_c, by_x, part);
    for (int a = 0; a < w->dim && by_c[k] != 0; a++)
        nds[a] = weight * det * by_x[a] / fabs(by_c[k]);
    w->sink->surface(w->sink->ctx, xi, x, nds);
}

/* The line through c along k, on which the level is monotone: the piece inside, the crossing. */
static void column(work *w, const box *b, double *c, int k, double weight)
{
    double low, high, from = b->low[k], to = b->high[k];

    c[k] = b->low[k];
    low = level(w, c);
    c[k] = b->high[k];
    high = level(w, c);
    w->partly |= low > 0 || high > 0;
    if (low > 0 && high > 0)
        return;
    if ((low > 0) != (high > 0)) {
        double s = root(w, c, k, b->low[k], low, b->high[k], high);

        c[k] = s;
        emit_surface(w, c, k, weight);
        if (low > 0)
            from = s;
        else
            to = s;
    }
    for (int i = 0; i < 5; i++) {
        c[k] = 0.5 * (from + to) + 0.5 * (to - from) * gauss_x[1][i];
        emit_inside(w, c, weight * 0.5 * (to - from) * gauss_w[1][i]);
    }
}

/* Lines along k on Gauss points of direction j, split where the surface meets the sides low and high of k. */
static void sweep(work *w, const box *b, double *c, int k, int j, double weight)
{
    const double *x = gauss_x[w->n_gauss - 4], *gw = gauss_w[w->n_gauss - 4];
    double at[2 * MOST_ROOTS + 2];
    int n = 0;

    c[k] = b->low[k];
    n = add_roots(w, c, j, b->low[j], b->high[j], at, n);
    c[k] = b->high[k];
    n = add_roots(w, c, j, b->low[j], b->high[j], at, n);
    n = breakpoints(b->low[j], b->high[j], at, n);
    for (int s = 0; s + 1 < n; s++)
        for (int i = 0; at[s + 1] > at[s] && i < w->n_gauss; i++) {
            c[j] = 0.5 * (at[s] + at[s + 1]) + 0.5 * (at[s + 1] - at[s]) * x[i];
            column(w, b, c, k, weight * 0.5 * (at[s + 1] - at[s]) * gw[i]);
        }
}

/* In 3D: sweeps on Gauss points of direction i, split where the surface meets the four edges of k and j. */
static void sweep_planes(work *w, const box *b, int k, int j, int i)
{
    const double *x = gauss_x[w->n_gauss - 4], *gw = gauss_w[w->n_gauss - 4];
    double at[4 * MOST_ROOTS + 2], c[3];
    int n = 0;

    for (int e = 0; e < 4; e++) {
        double list[MOST_ROOTS];
        int m;

        c[k] = e & 1 ? b->high[k] : b->low[k];
        c[j] = e & 2 ? b->high[j] : b->low[j];
        c[i] = b->low[i];
        m = add_roots(w, c, i, b->low[i], b->high[i], list, 0);
        for (int q = 0; q < m; q++)
            at[n++] = list[q];
    }
    n = breakpoints(b->low[i], b->high[i], at, n);
    for (int s = 0; s + 1 < n; s++)
        for (int q = 0; at[s + 1] > at[s] && q < w->n_gauss; q++) {
            c[i] = 0.5 * (at[s] + at[s + 1]) + 0.5 * (at[s + 1] - at[s]) * x[q];
            sweep(w, b, c, k, j, 0.5 * (at[s + 1] - at[s]) * gw[q]);
        }
}

/* --- boxes --- */

/* Gauss points of a box that is inside (test = 0), or of those that are. */
static void fill(work *w, const box *b, int test)
{
    double c[3] = {0};

    for (int q = 0; q < (w->dim == 2 ? 25 : 125); q++) {
        int i[3] = {q % 5, q / 5 % 5, q / 25};
        double weight = 1;

        for (int k = 0; k < w->dim; k++) {
            double half = 0.5 * (b->high[k] - b->low[k]);

            c[k] = b->low[k] + half * (1 + gauss_x[1][i[k]]);
            weight *= half * gauss_w[1][i[k]];
        }
        if (test && level(w, c) >= 0)
            w->partly = 1;
        else
            emit_inside(w, c, weight);
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

static survey look(const work *w, const box *b)
{
    survey s = {0};
    double most[3] = {0};

    for (int q = 0; q < (w->dim == 2 ? 9 : 27); q++) {
        int i[3] = {q % 3, q / 3 % 3, q / 9};
        double c[3] = {0}, g[3], by_x[3], part[3] = {0};

        for (int k = 0; k < w->dim; k++)
            c[k] = b->low[k] + 0.5 * i[k] * (b->high[k] - b->low[k]);
        slope(w, c, g, by_x, part);
        if (q == (w->dim == 2 ? 4 : 13))
            s.centre = level(w, c);
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
static int inner_direction(const work *w, const box *b, int k, double *share)
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
            slope(w, c, g, by_x, part);
            if (q == 4)
                centre = level(w, c);
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

static void divide(work *w, const box *b, int depth);

static void integrate(work *w, const box *b, int depth)
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
        sweep(w, b, (double[3]){0}, k, 1 - k, 1);
    else
        sweep_planes(w, b, k, j, 3 - k - j);
}

static void divide(work *w, const box *b, int depth)
{
    for (int q = 0; q < 1 << w->dim; q++) {
        box part = *b;

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
static int find_affine(work *w)
{
    const mesh *m = w->m;
    const fe_cell *t = m->type;
    double n[FE_MAX_NODES], dn[FE_MAX_NODES][3], zero[3] = {0}, j[3][3] = {{0}}, size = m->h[w->cell];

    fe_basis(t, 2, zero, n, dn);
    mesh_map(m, w->cell, n, (const double(*)[3])dn, w->x0, j);
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

int implicit_cell(const mesh *m, int32_t cell, const solid *b, const implicit_sink *sink)
{
    work w = {.m = m, .b = b, .sink = sink, .dim = m->dim, .cell = cell, .n_gauss = m->dim == 2 ? 6 : 4};
    box unit = {{0}, {1, 1, 1}};

    w.most_depth = m->dim == 2 ? DEPTH_2D : DEPTH_3D;
    if (!shape_is_smooth(b->shape)) /* edges are cut off at the last level */
        w.most_depth += m->dim == 2 ? 3 : 1;
    w.size = m->h[cell];
    w.affine = find_affine(&w);
    integrate(&w, &unit, 0);
    return !w.partly;
}
