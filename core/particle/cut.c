/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The part of a cell inside a body (implicit.c), projected on a fixed set of points, w_q = sum_s w_s L_q(x_s), with
 * L_q of degree 4, so that a cut cell costs no more than a whole one and products of two basis functions stay
 * exact. */
#include "base/text.h"
#include "particle/particle.h"

#include <plugflow/mesh.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { DEGREE = 4 };

static const double gauss5[5] = {-0.90617984593866399280, -0.53846931010568309104, 0, 0.53846931010568309104,
                                 0.90617984593866399280};

/* Values at s of the Lagrange polynomials on the 5 Gauss points. */
static void lagrange(double s, double l[5])
{
    for (int i = 0; i < 5; i++) {
        l[i] = 1;
        for (int k = 0; k < 5; k++)
            if (k != i)
                l[i] *= (s - gauss5[k]) / (gauss5[i] - gauss5[k]);
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

/* Gauss-Jordan with row pivoting on [a | 1]. */
static int invert(double *a, int n)
{
    double *w = calloc((size_t)(2 * n * n), sizeof *w);

    if (!w)
        return 0;
    for (int i = 0; i < n; i++) {
        memcpy(w + i * 2 * n, a + i * n, (size_t)n * sizeof *a);
        w[i * 2 * n + n + i] = 1;
    }
    for (int i = 0; i < n; i++) {
        int best = i;

        for (int r = i + 1; r < n; r++)
            best = fabs(w[r * 2 * n + i]) > fabs(w[best * 2 * n + i]) ? r : best;
        for (int c = 0; c < 2 * n && best != i; c++) {
            double swap = w[i * 2 * n + c];

            w[i * 2 * n + c] = w[best * 2 * n + c];
            w[best * 2 * n + c] = swap;
        }
        for (int r = 0; r < n; r++) {
            double f = r == i ? 0 : w[r * 2 * n + i] / w[i * 2 * n + i];

            for (int c = 0; f != 0 && c < 2 * n; c++)
                w[r * 2 * n + c] -= f * w[i * 2 * n + c];
        }
    }
    for (int i = 0; i < n; i++)
        for (int c = 0; c < n; c++)
            a[i * n + c] = w[i * 2 * n + n + c] / w[i * 2 * n + i];
    free(w);
    return 1;
}

/* Interpolation points: 5 Gauss points a direction, or the lattice of degree 4 of a simplex. */
static int place_points(cut_rule *r, error *err)
{
    int dim = r->type->dim;

    r->n = 0;
    if (!r->type->simplex) {
        for (int c = 0; c < (dim == 3 ? 5 : 1); c++)
            for (int b = 0; b < 5; b++)
                for (int a = 0; a < 5; a++, r->n++) {
                    r->x[r->n][0] = gauss5[a];
                    r->x[r->n][1] = gauss5[b];
                    r->x[r->n][2] = dim == 3 ? gauss5[c] : 0;
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
    return invert(r->inverse, r->n) ? 0 : error_memory(err, "cut rule", 0);
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
        lagrange(x[k], line[k]);
    for (int q = 0; q < r->n; q++)
        l[q] = line[0][q % 5] * line[1][q / 5 % 5] * (dim == 3 ? line[2][q / 25] : 1);
}

int cut_rule_create(cut_rule *r, const fe_cell *type, error *err)
{
    fe_rule rule;

    memset(r, 0, sizeof *r);
    r->type = type;
    TRY(place_points(r, err));
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
             void (*surface)(void *ctx, const double *xi, const double *x, const double *nds), void *ctx)
{
    projection to = {.rule = r, .w = w, .surface = surface, .ctx = ctx};
    int whole;

    memset(w, 0, (size_t)r->n * sizeof *w);
    whole = implicit_cell(m, cell, b, &(implicit_sink){&to, add_inside, surface ? pass_surface : NULL});
    return whole ? 2 : to.any;
}

/* Position relative to the body's centre and Jacobian determinant at interpolation point q. */
static double place(const cut_rule *r, const mesh *m, int32_t cell, const solid *b, const double *shift, int q,
                    double *arm)
{
    double n[FE_MAX_NODES], dn[FE_MAX_NODES][3], j[3][3], det;

    fe_basis(r->type, 2, r->x[q], n, dn);
    det = mesh_map(m, cell, n, (const double(*)[3])dn, arm, j);
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

int cut_correct(const cut_rule *r, const mesh *m, const solid *body, const int32_t *cell, const double (*shift)[3],
                double *w, int64_t n, double fraction, error *err)
{
    const shape *s = body->shape;
    double a[10][10] = {{0}}, target[10] = {0}, have[10] = {0}, basis[10], arm[3];
    int k = 1 + m->dim + m->dim * (m->dim + 1) / 2, at = 0;

    for (int64_t i = 0; i < n; i++)
        for (int q = 0; q < r->n; q++) {
            double det = place(r, m, cell[i], body, shift[i], q, arm);

            moments_at(m->dim, arm, s->radius, basis);
            for (int b = 0; b < k; b++) {
                have[b] += w[i * r->n + q] * det * basis[b];
                for (int c = 0; c < k; c++)
                    a[b][c] += w[i * r->n + q] * det * basis[b] * basis[c];
            }
        }
    if (!(have[0] > 0))
        return error_set(err, ERR_CASE, "a body at %s lies outside the mesh", text_point(body->at.x, m->dim).s);
    if (fraction < 1) { /* cut by a symmetry plane: its volume is known, the rest is as the cells have it */
        for (int64_t i = 0; i < n * r->n; i++)
            w[i] *= fraction > 0 ? fraction * s->volume / have[0] : 1;
        return 0;
    }
    target[at++] = s->volume;
    at += m->dim;
    for (int i = 0; i < m->dim; i++)
        for (int j = i; j < m->dim; j++, at++)
            for (int b = 0; b < m->dim; b++)
                for (int c = 0; c < m->dim; c++)
                    target[at] += body->axes[i][b] * s->moment[b][c] * body->axes[j][c] / (s->radius * s->radius);
    for (int i = 0; i < k; i++)
        target[i] -= have[i];
    for (int i = 0; i < k; i++) { /* the matrix of moments is symmetric positive definite */
        for (int b = i + 1; b < k; b++) {
            double f = a[b][i] / a[i][i];

            for (int c = i; c < k; c++)
                a[b][c] -= f * a[i][c];
            target[b] -= f * target[i];
        }
    }
    for (int i = k - 1; i >= 0; i--) {
        for (int c = i + 1; c < k; c++)
            target[i] -= a[i][c] * target[c];
        target[i] /= a[i][i];
    }
    for (int64_t i = 0; i < n; i++)
        for (int q = 0; q < r->n; q++) {
            double f = 1;

            place(r, m, cell[i], body, shift[i], q, arm);
            moments_at(m->dim, arm, s->radius, basis);
            for (int b = 0; b < k; b++)
                f += target[b] * basis[b];
            w[i * r->n + q] *= f;
        }
    return 0;
}
