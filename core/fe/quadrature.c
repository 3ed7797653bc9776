/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Quadrature: products of Gauss-Legendre rules (GSL) on quads, hexes and their facets;
 * Radon's 7-point rule on triangles and Walkington's 14-point rule on tets, both of degree 5. */
#include "fe/fe.h"

#include <gsl/gsl_integration.h>
#include <math.h>
#include <string.h>

enum { MAX_DEGREE = 7 };

int fe_gauss(int n, double *x, double *w, error *err)
{
    gsl_integration_glfixed_table *table;

    if (n < 1 || n > FE_MAX_GAUSS)
        return error_set(err, ERR_USAGE, "no Gauss rule of %d points; 1 to %d are possible", n, FE_MAX_GAUSS);
    table = gsl_integration_glfixed_table_alloc((size_t)n);
    if (!table)
        return error_memory(err, "quadrature", 0);
    for (int i = 0; i < n; i++)
        gsl_integration_glfixed_point(-1, 1, (size_t)i, &x[i], &w[i], table);
    gsl_integration_glfixed_table_free(table);
    return 0;
}

static void add_point(fe_rule *r, double w, double x, double y, double z)
{
    r->x[r->n][0] = x;
    r->x[r->n][1] = y;
    r->x[r->n][2] = z;
    r->w[r->n++] = w;
}

static int rule_box(int dim, int degree, fe_rule *r, error *err)
{
    double x[FE_MAX_GAUSS], w[FE_MAX_GAUSS];
    int n = degree / 2 + 1;

    if (degree > MAX_DEGREE)
        return error_set(err, ERR_USAGE, "no quadrature of degree %d; at most %d", degree, MAX_DEGREE);
    TRY(fe_gauss(n, x, w, err));
    for (int c = 0; c < (dim > 2 ? n : 1); c++)
        for (int b = 0; b < (dim > 1 ? n : 1); b++)
            for (int a = 0; a < n; a++)
                add_point(r, w[a] * (dim > 1 ? w[b] : 1) * (dim > 2 ? w[c] : 1), x[a], dim > 1 ? x[b] : 0,
                          dim > 2 ? x[c] : 0);
    return 0;
}

/* J. Radon, Zur mechanischen Kubatur, 1948; degree 5. */
static void rule_triangle(fe_rule *r)
{
    const double s = sqrt(15.0);

    add_point(r, 9.0 / 80, 1.0 / 3, 1.0 / 3, 0);
    for (int sign = -1; sign <= 1; sign += 2) {
        double a = (6 + sign * s) / 21, w = (155 + sign * s) / 2400;

        add_point(r, w, a, a, 0);
        add_point(r, w, 1 - 2 * a, a, 0);
        add_point(r, w, a, 1 - 2 * a, 0);
    }
}

/* N. J. Walkington, Quadrature on simplices of arbitrary dimension, 2000; degree 5. */
static void rule_tet(fe_rule *r)
{
    static const double a[2] = {0.31088591926330060980, 0.092735250310891226402};
    static const double wa[2] = {0.11268792571801585080, 0.073493043116361949544};
    const double b = 0.045503704125649649492, c = 0.5 - b, wb = 0.042546020777081466438 / 6;

    for (int k = 0; k < 2; k++) {
        double w = wa[k] / 6, o = 1 - 3 * a[k];

        add_point(r, w, a[k], a[k], a[k]);
        add_point(r, w, o, a[k], a[k]);
        add_point(r, w, a[k], o, a[k]);
        add_point(r, w, a[k], a[k], o);
    }
    add_point(r, wb, b, b, c);
    add_point(r, wb, b, c, b);
    add_point(r, wb, c, b, b);
    add_point(r, wb, b, c, c);
    add_point(r, wb, c, b, c);
    add_point(r, wb, c, c, b);
}

int fe_rule_cell(const fe_cell *c, int degree, fe_rule *rule, error *err)
{
    rule->n = 0;
    if (!c->simplex)
        return rule_box(c->dim, degree, rule, err);
    if (degree > 5)
        return error_set(err, ERR_USAGE, "no quadrature of degree %d on a %s", degree, c->name);
    if (c->dim == 2)
        rule_triangle(rule);
    else
        rule_tet(rule);
    return 0;
}

/* The outward side: away from the centre of the reference cell. */
static int orientation(const fe_cell *c, int f, double t[2][3])
{
    double n[3], centre[3] = {0}, dot = 0;

    if (c->dim == 2) {
        n[0] = t[0][1], n[1] = -t[0][0], n[2] = 0;
    } else {
        n[0] = t[0][1] * t[1][2] - t[0][2] * t[1][1];
        n[1] = t[0][2] * t[1][0] - t[0][0] * t[1][2];
        n[2] = t[0][0] * t[1][1] - t[0][1] * t[1][0];
    }
    for (int i = 0; i < c->n_vertex; i++)
        for (int k = 0; k < 3; k++)
            centre[k] += c->x[c->vertex[i]][k] / c->n_vertex;
    for (int k = 0; k < 3; k++)
        dot += n[k] * (c->x[c->facet[f][0]][k] - centre[k]);
    return dot > 0 ? 1 : -1;
}

int fe_rule_facet(const fe_cell *c, int f, int degree, fe_rule *rule, double tangent[2][3], int *orient, error *err)
{
    const double *p = c->x[c->facet[f][0]], *q = c->x[c->facet[f][1]], *s = c->x[c->facet[f][c->dim - 1]];
    fe_rule r = {.n = 0};
    int simplex_facet = c->simplex && c->dim == 3;

    if (simplex_facet)
        rule_triangle(&r);
    else
        TRY(rule_box(c->dim - 1, degree, &r, err));
    memset(tangent, 0, 2 * sizeof tangent[0]);
    rule->n = r.n;
    for (int k = 0; k < 3; k++) {
        double scale = simplex_facet ? 1 : 0.5;

        tangent[0][k] = scale * (q[k] - p[k]);
        tangent[1][k] = c->dim == 3 ? scale * (s[k] - p[k]) : 0;
        for (int i = 0; i < r.n; i++) {
            double a = simplex_facet ? r.x[i][0] : 1 + r.x[i][0], b = simplex_facet ? r.x[i][1] : 1 + r.x[i][1];

            rule->x[i][k] = p[k] + a * tangent[0][k] + b * tangent[1][k];
        }
    }
    memcpy(rule->w, r.w, sizeof r.w);
    *orient = orientation(c, f, tangent);
    return 0;
}
