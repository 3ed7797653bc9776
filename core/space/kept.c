/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Memory of terms at points of cells, and the polynomials between them. */
#include "space/kept.h"

#include "base/dense.h"

#include <string.h>

enum { MOST_MONOMIALS = 10 };

int kept_find(const kept_fields *k, const char *name)
{
    for (int f = 0; f < k->n; f++)
        if (strcmp(k->field[f].name, name) == 0)
            return f;
    return -1;
}

/* 1, x, y[, z] and their products: all of second degree. */
static int monomials(int dim, const double *x, double *m)
{
    int n = 0;

    m[n++] = 1;
    for (int i = 0; i < dim; i++)
        m[n++] = x[i];
    for (int i = 0; i < dim; i++)
        for (int j = i; j < dim; j++)
            m[n++] = x[i] * x[j];
    return n;
}

/* (V^T W V)^-1 V^T W, V: the monomials at the points. */
static int fit_parabola(kept_fields *k, arena *memory, error *err)
{
    const fe_rule *r = &k->rule;
    double a[MOST_MONOMIALS * MOST_MONOMIALS] = {0}, m[MOST_MONOMIALS];
    int n = 0;

    for (int q = 0; q < r->n; q++) {
        n = monomials(k->mesh->dim, r->x[q], m);
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n; j++)
                a[i * n + j] += r->w[q] * m[i] * m[j];
    }
    TRY(dense_invert(n, a, err));
    ARENA_NEW(memory, k->fit, n * r->n, err);
    for (int q = 0; q < r->n; q++) {
        monomials(k->mesh->dim, r->x[q], m);
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n; j++)
                k->fit[i * r->n + q] += a[i * n + j] * m[j] * r->w[q];
    }
    return 0;
}

int kept_create(kept_fields *k, const field_list *fields, const mesh *m, int n_body, arena *memory, error *err)
{
    *k = (kept_fields){.n = fields->n, .n_body = n_body, .field = fields->f, .mesh = m};
    TRY(fe_rule_cell(m->type, KEPT_DEGREE, &k->rule, err));
    for (int i = 0; i < 3; i++) /* the first direction runs fastest */
        k->line[i] = k->rule.x[i][0];
    for (int f = 0; f < k->n; f++) {
        k->first[f] = k->n_value;
        k->n_value += k->field[f].n_comp * (k->field[f].support == PF_AT_POINTS ? m->n_cell * k->rule.n : n_body);
    }
    return k->n && m->type->simplex ? fit_parabola(k, memory, err) : 0;
}

/* Of the parabola through three points. */
static void lagrange(const double *at, double x, double *l)
{
    for (int i = 0; i < 3; i++) {
        const double a = at[(i + 1) % 3], b = at[(i + 2) % 3];

        l[i] = (x - a) * (x - b) / ((at[i] - a) * (at[i] - b));
    }
}

void kept_weights(const kept_fields *k, const double *xi, double *weight)
{
    const int dim = k->mesh->dim, n = k->rule.n;
    double l[3][3], m[MOST_MONOMIALS];

    if (k->fit) {
        int n_mono = monomials(dim, xi, m);

        memset(weight, 0, (size_t)n * sizeof *weight);
        for (int i = 0; i < n_mono; i++)
            for (int q = 0; q < n; q++)
                weight[q] += m[i] * k->fit[i * n + q];
        return;
    }
    for (int d = 0; d < dim; d++)
        lagrange(k->line, xi[d], l[d]);
    for (int q = 0; q < n; q++)
        weight[q] = l[0][q % 3] * l[1][q / 3 % 3] * (dim == 3 ? l[2][q / 9] : 1);
}

void kept_value(const kept_fields *k, int f, const double *kept, int64_t cell, const double *xi, double *v)
{
    const double *of = kept + kept_at(k, f, cell);
    double weight[KEPT_MAX_POINTS];

    kept_weights(k, xi, weight);
    for (int i = 0; i < k->field[f].n_comp; i++) {
        v[i] = 0;
        for (int q = 0; q < k->rule.n; q++)
            v[i] += weight[q] * of[i * k->rule.n + q];
    }
}

/* Part of the weight of a cell that keeps what the points leave open. */
#define OPEN 1e-6

void kept_fit(const kept_fields *k, int n, const double *weights, const double *w, int n_comp, const double *v,
              double *at)
{
    const int np = k->rule.n;
    double a[KEPT_MAX_POINTS * KEPT_MAX_POINTS] = {0}, b[VALUE_MAX * KEPT_MAX_POINTS];

    for (int p = 0; p < np; p++) {
        a[p * np + p] = OPEN * k->rule.w[p];
        for (int i = 0; i < n_comp; i++)
            b[i * np + p] = OPEN * k->rule.w[p] * at[i * np + p];
    }
    for (int q = 0; q < n; q++) {
        const double *l = weights + q * np;

        for (int p = 0; w[q] > 0 && p < np; p++) {
            for (int r = 0; r <= p; r++)
                a[p * np + r] += w[q] * l[p] * l[r];
            for (int i = 0; i < n_comp; i++)
                b[i * np + p] += w[q] * l[p] * v[i * n + q];
        }
    }
    if (!dense_solve_symmetric(np, a, n_comp, b))
        memcpy(at, b, (size_t)(n_comp * np) * sizeof *at);
}

int kept_start(const kept_fields *k, const value *initial, const int *has, const pose *body, double t, double *kept,
               error *err)
{
    double v[VALUE_MAX], j[3][3];

    for (int f = 0; f < k->n; f++) {
        const int at_points = k->field[f].support == PF_AT_POINTS, n = at_points ? k->rule.n : 1;

        for (int64_t e = 0; has[f] && e < (at_points ? k->mesh->n_cell : k->n_body); e++)
            for (int q = 0; q < n; q++) {
                double x[3] = {0};

                if (at_points)
                    mesh_place(k->mesh, (int32_t)e, k->rule.x[q], x, j);
                else
                    memcpy(x, body[e].x, sizeof x);
                TRY(value_at(&initial[f], x, t, v, err));
                for (int i = 0; i < k->field[f].n_comp; i++)
                    kept[kept_at(k, f, e) + i * n + q] = v[i];
            }
    }
    return 0;
}

void kept_means(const kept_fields *k, int f, const double *kept, double *mean)
{
    const int n_comp = k->field[f].n_comp;

    for (int64_t e = 0; e < k->mesh->n_cell; e++) {
        const double *v = kept + kept_at(k, f, e);
        double size = 0, x[3], j[3][3];

        memset(mean + e * n_comp, 0, (size_t)n_comp * sizeof *mean);
        for (int q = 0; q < k->rule.n; q++) {
            double w = k->rule.w[q] * mesh_place(k->mesh, (int32_t)e, k->rule.x[q], x, j);

            size += w;
            for (int i = 0; i < n_comp; i++)
                mean[e * n_comp + i] += w * v[i * k->rule.n + q];
        }
        for (int i = 0; i < n_comp; i++)
            mean[e * n_comp + i] /= size;
    }
}
