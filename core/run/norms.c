/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Errors against the exact solution that a case gives.  Gradients of the exact solution come
 * from differences of fourth order.  A field that is free up to a constant is compared with
 * zero mean on both sides. */
#include "run/run.h"

#include "space/evaluate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static int exact_gradient(const problem *p, int f, const double *x, double t, double h, double *g, error *err)
{
    static const double weight[4] = {1.0 / 12, -2.0 / 3, 2.0 / 3, -1.0 / 12}, at[4] = {-2, -1, 1, 2};
    int n = p->space.field[f].n_comp;

    memset(g, 0, (size_t)(n * p->dim) * sizeof *g);
    for (int k = 0; k < p->dim; k++)
        for (int s = 0; s < 4; s++) {
            double y[3] = {x[0], x[1], x[2]}, v[VALUE_MAX];

            y[k] += at[s] * h;
            TRY(value_at(&p->exact[f], y, t, v, err));
            for (int a = 0; a < n; a++)
                g[a * p->dim + k] += weight[s] * v[a] / h;
        }
    return 0;
}

typedef struct point_data {
    double w, h, x[3];
    double value[VALUE_MAX], gradient[VALUE_MAX * 3];
} point_data;

/* A point of cell e: where it is, and u_h and its gradient there. */
static void at_point(const problem *p, int f, int64_t e, const double *xi, double weight, point_data *d)
{
    double det;

    space_evaluate(&p->space, f, p->x, e, xi,
                   &(point_values){.value = d->value, .gradient = d->gradient, .place = d->x, .det = &det});
    d->w = weight * det;
    d->h = p->mesh.h[e];
}

/* Points and weights on the reference cell. */
typedef struct point_list {
    int n;
    double (*x)[3], *w;
} point_list;

enum { FINE_2D = 8, FINE_3D = 4, GAUSS = 3 }; /* sub-cells and points in each, per direction */

/* All of a cell cut fine; simplices are boxes collapsed. */
static int fine_points(int dim, int simplex, point_list *l, error *err)
{
    int m = (dim == 2 ? FINE_2D : FINE_3D) * GAUSS;
    double g[GAUSS], w[GAUSS];

    TRY(fe_gauss(GAUSS, g, w, err));
    l->n = dim == 2 ? m * m : m * m * m;
    l->x = malloc((size_t)l->n * sizeof *l->x);
    l->w = malloc((size_t)l->n * sizeof *l->w);
    if (!l->x || !l->w)
        return error_memory(err, "norms", 32.0 * l->n);
    for (int i = 0; i < l->n; i++) {
        int at[3] = {i % m, i / m % m, i / (m * m)};
        double c[3] = {0};

        l->w[i] = 1;
        for (int k = 0; k < dim; k++) {
            c[k] = (at[k] / GAUSS + 0.5 + 0.5 * g[at[k] % GAUSS]) * GAUSS / m;
            l->w[i] *= 0.5 * w[at[k] % GAUSS] * GAUSS / m * (simplex ? 1 : 2);
        }
        l->x[i][0] = simplex ? c[0] * (1 - c[1]) * (1 - c[2]) : 2 * c[0] - 1;
        l->x[i][1] = simplex ? c[1] * (1 - c[2]) : 2 * c[1] - 1;
        l->x[i][2] = simplex ? c[2] : dim == 3 ? 2 * c[2] - 1 : 0;
        l->w[i] *= simplex ? (1 - c[1]) * (dim == 3 ? (1 - c[2]) * (1 - c[2]) : 1) : 1;
    }
    return 0;
}

/* Whether a point of a cell lies inside a body. */
static int is_inside(const problem *p, int64_t cell, const double *x)
{
    const space *s = &p->space;

    for (int64_t k = 0; k < p->n_covered; k++) {
        int32_t a = p->covered[k];
        particle image;
        solid here;

        if (s->attached_cell[a] != cell)
            continue;
        image = problem_image(p, a);
        here = solid_at(&image.shape, &image.at);
        if (solid_level(&here, x) < 0)
            return 1;
    }
    return 0;
}

/* Sums of a norm. */
typedef struct norm_sums {
    double sum, grad, size, mean, mean_exact, volume;
} norm_sums;

static int add_point(const problem *p, int f, double t, const point_data *d, norm_sums *s, error *err)
{
    double u[VALUE_MAX], g[VALUE_MAX * 3];

    TRY(value_at(&p->exact[f], d->x, t, u, err));
    TRY(exact_gradient(p, f, d->x, t, 1e-3 * d->h, g, err));
    s->volume += d->w;
    s->mean += d->w * (d->value[0] - u[0]);
    s->mean_exact += d->w * u[0];
    for (int k = 0; k < p->space.field[f].n_comp; k++) {
        s->sum += d->w * (d->value[k] - u[k]) * (d->value[k] - u[k]);
        s->size += d->w * u[k] * u[k];
        for (int i = k * p->dim; i < (k + 1) * p->dim; i++)
            s->grad += d->w * (d->gradient[i] - g[i]) * (d->gradient[i] - g[i]);
    }
    return 0;
}

/* All cells; of a field of the fluid only, the points of cut cells that are outside of the bodies. */
static int add_cells(const problem *p, int f, double t, const point_list *whole, const point_list *fine,
                     norm_sums *s, error *err)
{
    for (int64_t e = 0; e < p->mesh.n_cell; e++) {
        int off = p->n_particle && p->fluid_only[f] ? p->fluid_off[e] : 0;
        const point_list *l = off ? fine : whole;

        for (int q = 0; off < 2 && q < l->n; q++) {
            point_data d;

            at_point(p, f, e, l->x[q], l->w[q], &d);
            if (!off || !is_inside(p, e, d.x))
                TRY(add_point(p, f, t, &d, s, err));
        }
    }
    for (int k = 0; k < p->n_particle; k++)
        TRY(shape_check(&p->particle[k].shape, err));
    return 0;
}

int norms_of_error(const problem *p, int f, double t, double *l2, double *h1, double *exact, error *err)
{
    const mesh *m = &p->mesh;
    norm_sums s = {0};
    point_list fine = {0};
    fe_rule rule;
    int status;

    TRY(fe_rule_cell(m->type, m->type->simplex ? 5 : 7, &rule, err));
    status = fine_points(p->dim, m->type->simplex, &fine, err);
    if (!status)
        status = add_cells(p, f, t, &(point_list){rule.n, rule.x, rule.w}, &fine, &s, err);
    free(fine.x);
    free(fine.w);
    TRY(status);
    if (p->system.gauge.free[f]) {
        s.sum -= s.mean * s.mean / s.volume;
        s.size -= s.mean_exact * s.mean_exact / s.volume;
    }
    *l2 = sqrt(fmax(s.sum, 0));
    *h1 = sqrt(s.grad);
    *exact = sqrt(fmax(s.size, 0));
    return 0;
}

/* Adds what the bodies that move a field contribute inside of them. */
static void add_bodies(const problem *p, int f, double *sum, double *volume)
{
    const space *s = &p->space;

    for (int g = 0; g < s->n_field; g++)
        if (s->field[g].support == PF_ON_PARTICLE && s->field[g].shape == PF_VECTOR && s->field[g].constrains &&
            space_find_field(s, s->field[g].constrains) == f && p->fluid_only[f])
            for (int64_t k = 0; k < p->n_covered; k++) {
                int64_t a = p->covered[k];
                int body = s->attached_particle[a];
                for (int q = 0; q < p->cut.n; q++) {
                    double x[3], j[3][3], v[3];
                    double w =
                        p->weight[k * p->cut.n + q] * mesh_place(&p->mesh, s->attached_cell[a], p->cut.x[q], x, j);

                    for (int i = 0; i < p->dim; i++)
                        x[i] -= p->shift[a][i];
                    problem_motion(p, p->x, body, x, v);
                    *volume += w;
                    for (int i = 0; i < p->dim; i++)
                        sum[i] += w * v[i];
                }
            }
}

int norms_mean(const problem *p, int f, double *mean, error *err)
{
    double volume = 0;
    fe_rule rule, own;

    TRY(fe_rule_cell(p->mesh.type, 5, &rule, err));
    memset(mean, 0, (size_t)p->space.field[f].n_comp * sizeof *mean);
    for (int64_t e = 0; e < p->mesh.n_cell; e++) {
        const fe_rule *part = problem_points(p, f, e, &rule, &own);

        for (int q = 0; q < part->n; q++) {
            point_data d;

            at_point(p, f, e, part->x[q], part->w[q], &d);
            volume += d.w;
            for (int k = 0; k < p->space.field[f].n_comp; k++)
                mean[k] += d.w * d.value[k];
        }
    }
    add_bodies(p, f, mean, &volume);
    for (int k = 0; k < p->space.field[f].n_comp; k++)
        mean[k] /= volume;
    return 0;
}
