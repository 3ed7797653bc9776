/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The part of a cell inside a body (implicit.c), projected on a fixed set of points, w_q = sum_s w_s L_q(x_s), with
 * L_q of degree 4, so that a cut cell costs no more than a whole one and products of two basis functions stay
 * exact. */
#include "particle/particle.h"

#include "base/dense.h"
#include "base/text.h"

#include <plugflow/mesh.h>

#include <math.h>
#include <string.h>

enum { DEGREE = 4, MOMENTS = 10 };

/* Values at s of the Lagrange polynomials on 5 points. */
static void lagrange(const double x[5], double s, double l[5])
{
    for (int i = 0; i < 5; i++) {
        l[i] = 1;
        for (int k = 0; k < 5; k++)
            if (k != i)
                l[i] *= (s - x[k]) / (x[i] - x[k]);
    }
}

/* Monomials up to degree 4 in dim variables. */
static int monomials(int dim, const double *x, double *m)
{
    int n = 0;

    for (int c = 0; c <= (dim == 3 ? DEGREE : 0); c++)
        for (int b = 0; b + c <= DEGREE; b++)
            for (int a = 0; a + b + c <= DEGREE; a++)
                m[n++] = pow(x[0], a) * pow(x[1], b) * pow(dim == 3 ? x[2] : 0, c);
    return n;
}

/* Interpolation points: 5 Gauss points a direction, or the lattice of degree 4 of a simplex. */
static int place_points(cut_rule *r, error *err)
{
    double ignored[FE_MAX_GAUSS];
    int dim = r->type->dim;

    r->n = 0;
    TRY(fe_gauss(DEGREE + 1, r->gauss, ignored, err));
    if (!r->type->simplex) {
        for (int c = 0; c < (dim == 3 ? 5 : 1); c++)
            for (int b = 0; b < 5; b++)
                for (int a = 0; a < 5; a++, r->n++) {
                    r->x[r->n][0] = r->gauss[a];
                    r->x[r->n][1] = r->gauss[b];
                    r->x[r->n][2] = dim == 3 ? r->gauss[c] : 0;
                }
        return 0;
    }
    for (int c = 0; c <= (dim == 3 ? DEGREE : 0); c++)
        for (int b = 0; b + c <= DEGREE; b++)
            for (int a = 0; a + b + c <= DEGREE; a++, r->n++) {
                r->x[r->n][0] = a / (double)DEGREE;
                r->x[r->n][1] = b / (double)DEGREE;
                r->x[r->n][2] = c / (double)DEGREE;
            }
    ARENA_NEW(&r->memory, r->inverse, r->n * r->n, err);
    for (int i = 0; i < r->n; i++)
        monomials(dim, r->x[i], r->inverse + i * r->n);
    return dense_invert(r->n, r->inverse, err);
}

/* L_q at a point. */
static void project(const cut_rule *r, const double *x, double *l)
{
    int dim = r->type->dim;
    double m[CUT_MAX_POINTS], line[3][5];

    if (r->type->simplex) {
        monomials(dim, x, m);
        for (int q = 0; q < r->n; q++) {
            l[q] = 0;
            for (int k = 0; k < r->n; k++)
                l[q] += r->inverse[k * r->n + q] * m[k];
        }
        return;
    }
    for (int k = 0; k < dim; k++)
        lagrange(r->gauss, x[k], line[k]);
    for (int q = 0; q < r->n; q++)
        l[q] = line[0][q % 5] * line[1][q / 5 % 5] * (dim == 3 ? line[2][q / 25] : 1);
}

int cut_rule_create(cut_rule *r, const fe_cell *type, error *err)
{
    fe_rule rule;

    memset(r, 0, sizeof *r);
    r->type = type;
    TRY(place_points(r, err));
    TRY(implicit_rule_create(&r->lines, type->dim, err));
    TRY(fe_rule_cell(type, type->simplex ? 5 : 7, &rule, err));
    for (int s = 0; s < rule.n; s++) {
        double l[CUT_MAX_POINTS];

        project(r, rule.x[s], l);
        for (int q = 0; q < r->n; q++)
            r->whole[q] += rule.w[s] * l[q];
    }
    return 0;
}

void cut_rule_destroy(cut_rule *r)
{
    arena_free(&r->memory);
    memset(r, 0, sizeof *r);
}

/* Where the points of a cell go. */
typedef struct projection {
    const cut_rule *rule;
    double *w;
    int any;
    void (*surface)(void *ctx, const double *xi, const double *x, const double *nds);
    void *ctx;
} projection;

static void add_inside(void *ctx, const double *xi, double weight)
{
    projection *to = ctx;
    double l[CUT_MAX_POINTS];

    to->any |= weight > 0;
    project(to->rule, xi, l);
    for (int q = 0; q < to->rule->n; q++)
        to->w[q] += weight * l[q];
}

static void pass_surface(void *ctx, const double *xi, const double *x, const double *nds)
{
    projection *to = ctx;

    to->surface(to->ctx, xi, x, nds);
}

int cut_cell(const cut_rule *r, const mesh *m, int32_t cell, const solid *b, double *w,
             void (*surface)(void *ctx, const double *xi, const double *x, const double *nds), void *ctx,
             enum cut_cover *cover, error *err)
{
    projection to = {.rule = r, .w = w, .surface = surface, .ctx = ctx};
    implicit_sink sink = {&to, add_inside, surface ? pass_surface : NULL};
    int whole;

    memset(w, 0, (size_t)r->n * sizeof *w);
    TRY(implicit_cell(&r->lines, m, cell, b, &sink, &whole, err));
    *cover = whole ? CUT_WHOLE : to.any ? CUT_PART : CUT_NONE;
    return 0;
}

/* Position relative to the body's centre and Jacobian determinant at interpolation point q. */
static double place(const cut_rule *r, const mesh *m, int32_t cell, const solid *b, const double *shift, int q,
                    double *arm)
{
    double j[3][3], det = mesh_place(m, cell, r->x[q], arm, j);

    for (int a = 0; a < m->dim; a++)
        arm[a] -= b->at.x[a] + shift[a];
    return det;
}

/* 1, r_i, r_i r_j (i <= j), scaled by the body's radius. */
static int moments_at(int dim, const double *arm, double radius, double *m)
{
    int n = 0;

    m[n++] = 1;
    for (int i = 0; i < dim; i++)
        m[n++] = arm[i] / radius;
    for (int i = 0; i < dim; i++)
        for (int j = i; j < dim; j++)
            m[n++] = arm[i] * arm[j] / (radius * radius);
    return n;
}

/* Moments of the body less those of the weights, as moments_at has them. */
static void moments_missing(const solid *body, int dim, const double *have, double *missing)
{
    const shape *s = body->shape;
    int n = 0;

    missing[n++] = s->volume;
    for (int i = 0; i < dim; i++)
        missing[n++] = 0;
    for (int i = 0; i < dim; i++)
        for (int j = i; j < dim; j++) {
            double sum = 0;

            for (int b = 0; b < dim; b++)
                for (int c = 0; c < dim; c++)
                    sum += body->axes[i][b] * s->moment[b][c] * body->axes[j][c] / (s->radius * s->radius);
            missing[n++] = sum;
        }
    for (int i = 0; i < n; i++)
        missing[i] -= have[i];
}

int cut_correct(const cut_rule *r, const mesh *m, const solid *body, const int32_t *cell, const double (*shift)[3],
                double *w, int64_t n, double fraction, error *err)
{
    const shape *s = body->shape;
    double a[MOMENTS * MOMENTS] = {0}, c[MOMENTS], have[MOMENTS] = {0}, basis[MOMENTS], arm[3];
    int k = 1 + m->dim + m->dim * (m->dim + 1) / 2;

    for (int64_t i = 0; i < n; i++)
        for (int q = 0; q < r->n; q++) {
            double det = place(r, m, cell[i], body, shift[i], q, arm);

            moments_at(m->dim, arm, s->radius, basis);
            for (int b = 0; b < k; b++) {
                have[b] += w[i * r->n + q] * det * basis[b];
                for (int d = 0; d < k; d++)
                    a[b * k + d] += w[i * r->n + q] * det * basis[b] * basis[d];
            }
        }
    if (!(have[0] > 0))
        return error_set(err, ERR_CASE, "a body at %s lies outside the mesh", text_point(body->at.x, m->dim).s);
    if (fraction < 1) { /* cut by a symmetry plane: its volume is known, the rest is as the cells have it */
        for (int64_t i = 0; i < n * r->n; i++)
            w[i] *= fraction > 0 ? fraction * s->volume / have[0] : 1;
        return 0;
    }
    moments_missing(body, m->dim, have, c);
    if (dense_solve(k, a, c))
        return error_set(
            err, ERR_CASE,
            "the body at %s covers too little of the mesh for its moments to be found; it is %.3g wide, "
            "cells there are %.3g; take finer cells or a larger body",
            text_point(body->at.x, m->dim).s, s->thickness, n > 0 ? m->h[cell[0]] : 0);
    for (int64_t i = 0; i < n; i++)
        for (int q = 0; q < r->n; q++) {
            double f = 1;

            place(r, m, cell[i], body, shift[i], q, arm);
            moments_at(m->dim, arm, s->radius, basis);
            for (int b = 0; b < k; b++)
                f += c[b] * basis[b];
            w[i * r->n + q] *= f;
        }
    return 0;
}
