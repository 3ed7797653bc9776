/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Lines through a box along which the level is monotone: Gauss points on their piece inside the body, a point of
 * the surface where they cross it.  They stand on Gauss points, too, split where the surface passes through the
 * sides of the box, so that what is integrated there is smooth. */
#include "particle/implicit.h"

#include "base/dense.h"

#include <math.h>

enum { MOST_ROOTS = 16, PROBES = 6 };

/* A root of the level on the line c + s e_k between a and b with values of opposite sign: Illinois. */
static double root(const implicit_work *w, double *c, int k, double a, double fa, double b, double fb)
{
    for (int i = 0, side = 0; i < 60 && fabs(b - a) > 1e-15; i++) {
        double s = (fa * b - fb * a) / (fa - fb), f;

        if (!(s > fmin(a, b) && s < fmax(a, b)))
            s = 0.5 * (a + b);
        c[k] = s;
        f = implicit_level(w, c);
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
static int add_roots(const implicit_work *w, const double *through, int k, double low, double high, double *list,
                     int n)
{
    double c[3] = {through[0], through[1], through[2]}, f[PROBES + 1], at[PROBES + 1];

    for (int i = 0; i <= PROBES; i++) {
        at[i] = c[k] = low + (high - low) * i / PROBES;
        f[i] = implicit_level(w, c);
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
        g = implicit_level(w, c);
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

void implicit_emit(const implicit_work *w, const double *c, double weight)
{
    double xi[3] = {0}, d[3][3];
    double det = implicit_reference(w, c, xi, d);

    w->sink->inside(w->sink->ctx, xi, weight * det);
}

/* Area element at a crossing: n ds = det(dx/dc) grad phi / |d phi / d c_k| dc', n out of the body. */
static void emit_surface(const implicit_work *w, const double *c, int k, double weight)
{
    double xi[3] = {0}, d[3][3], x[3] = {0}, j[3][3] = {{0}}, by_c[3], by_x[3], part[3], det, nds[3] = {0};

    if (!w->sink->surface)
        return;
    det = implicit_reference(w, c, xi, d);
    implicit_place(w, xi, x, j);
    det *= dense_determinant((const double(*)[3])j);
    implicit_slope(w, c, by_c, by_x, part);
    for (int a = 0; a < w->dim && by_c[k] != 0; a++)
        nds[a] = weight * det * by_x[a] / fabs(by_c[k]);
    w->sink->surface(w->sink->ctx, xi, x, nds);
}

/* The line through c along k, on which the level is monotone: the piece inside, the crossing. */
static void column(implicit_work *w, const implicit_box *b, double *c, int k, double weight)
{
    double low, high, from = b->low[k], to = b->high[k];

    c[k] = b->low[k];
    low = implicit_level(w, c);
    c[k] = b->high[k];
    high = implicit_level(w, c);
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
    for (int i = 0; i < IMPLICIT_ALONG; i++) {
        c[k] = 0.5 * (from + to) + 0.5 * (to - from) * w->rule->along_x[i];
        implicit_emit(w, c, weight * 0.5 * (to - from) * w->rule->along_w[i]);
    }
}

void implicit_sweep(implicit_work *w, const implicit_box *b, double *c, int k, int j, double weight)
{
    const double *x = w->rule->across_x, *gw = w->rule->across_w;
    double at[2 * MOST_ROOTS + 2];
    int n = 0;

    c[k] = b->low[k];
    n = add_roots(w, c, j, b->low[j], b->high[j], at, n);
    c[k] = b->high[k];
    n = add_roots(w, c, j, b->low[j], b->high[j], at, n);
    n = breakpoints(b->low[j], b->high[j], at, n);
    for (int s = 0; s + 1 < n; s++)
        for (int i = 0; at[s + 1] > at[s] && i < w->rule->n_across; i++) {
            c[j] = 0.5 * (at[s] + at[s + 1]) + 0.5 * (at[s + 1] - at[s]) * x[i];
            column(w, b, c, k, weight * 0.5 * (at[s + 1] - at[s]) * gw[i]);
        }
}

void implicit_sweep_planes(implicit_work *w, const implicit_box *b, int k, int j, int i)
{
    const double *x = w->rule->across_x, *gw = w->rule->across_w;
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
        for (int q = 0; at[s + 1] > at[s] && q < w->rule->n_across; q++) {
            c[i] = 0.5 * (at[s] + at[s + 1]) + 0.5 * (at[s + 1] - at[s]) * x[q];
            implicit_sweep(w, b, c, k, j, 0.5 * (at[s + 1] - at[s]) * gw[q]);
        }
}
