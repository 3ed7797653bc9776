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

static int exact_gradient(const description *p, int f, const double *x, double t, double h, double *g, error *err)
{
    static const double weight[4] = {1.0 / 12, -2.0 / 3, 2.0 / 3, -1.0 / 12}, at[4] = {-2, -1, 1, 2};
    int n = p->fields.f[f].n_comp;

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
static void at_point(const run *r, int f, int64_t e, const double *xi, double weight, point_data *d)
{
    double det;

    memset(d, 0, sizeof *d);
    space_evaluate(&r->p->space, f, r->x, e, xi,
                   &(point_values){.value = d->value, .gradient = d->gradient, .place = d->x, .det = &det});
    d->w = weight * det;
    d->h = r->p->mesh.h[e];
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
    static const double g[3] = {-0.77459666924148337704, 0, 0.77459666924148337704},
                        w[3] = {5 / 9.0, 8 / 9.0, 5 / 9.0};
    int m = (dim == 2 ? FINE_2D : FINE_3D) * GAUSS;

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

/* Sums of a norm. */
typedef struct norm_sums {
    double sum, grad, size, mean, mean_exact, volume;
} norm_sums;

static int add_point(const description *p, int f, double t, const point_data *d, norm_sums *s, error *err)
{
    double u[VALUE_MAX], g[VALUE_MAX * 3];

    TRY(value_at(&p->exact[f], d->x, t, u, err));
    TRY(exact_gradient(p, f, d->x, t, 1e-3 * d->h, g, err));
    s->volume += d->w;
    s->mean += d->w * (d->value[0] - u[0]);
    s->mean_exact += d->w * u[0];
    for (int k = 0; k < p->fields.f[f].n_comp; k++) {
        s->sum += d->w * (d->value[k] - u[k]) * (d->value[k] - u[k]);
        s->size += d->w * u[k] * u[k];
        for (int i = k * p->dim; i < (k + 1) * p->dim; i++)
            s->grad += d->w * (d->gradient[i] - g[i]) * (d->gradient[i] - g[i]);
    }
    return 0;
}

/* All cells; of a field of the fluid only, the points that are outside of the bodies; of one that lives in bodies,
 * those inside. */
static int add_cells(const run *r, int f, double t, const point_list *whole, const point_list *fine, norm_sums *s,
                     error *err)
{
    const problem *p = r->p;
    const placement *now = p->bodies.now;

    const int inside = p->space.field[f].support == PF_IN_PARTICLES;

    for (int64_t e = 0; e < p->mesh.n_cell; e++) {
        int cover = now && (inside || p->bodies.fluid_only[f]) ? now->cover[e] : COVER_NONE;
        const point_list *l = cover ? fine : whole;

        for (int q = 0; (inside ? cover != COVER_NONE : cover <= COVER_PART) && q < l->n; q++) {
            point_data d;

            at_point(r, f, e, l->x[q], l->w[q], &d);
            if (!cover || (bodies_at(&p->bodies, now, e, d.x, NULL) >= 0) == inside)
                TRY(add_point(&p->description, f, t, &d, s, err));
        }
    }
    return 0;
}

int norms_of_error(const run *r, int f, double t, double *l2, double *h1, double *exact, error *err)
{
    const problem *p = r->p;
    const mesh *m = &p->mesh;
    norm_sums s = {0};
    point_list fine = {0};
    fe_rule rule;
    int status;

    TRY(fe_rule_cell(m->type, m->type->simplex ? 5 : 7, &rule, err));
    status = fine_points(m->dim, m->type->simplex, &fine, err);
    if (!status)
        status = add_cells(r, f, t, &(point_list){rule.n, rule.x, rule.w}, &fine, &s, err);
    free(fine.x);
    free(fine.w);
    TRY(status);
    TRY(bodies_check(&p->bodies, err));
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
static void add_bodies(const run *r, double *sum, double *volume)
{
    const bodies *b = &r->p->bodies;
    const placement *now = b->now;
    const mesh *m = &r->p->mesh;

    for (int64_t k = 0; k < now->n_covered; k++) {
        int64_t a = now->covered[k];
        int body = b->space->attached_particle[a];

        for (int q = 0; q < b->cut.n; q++) {
            double x[3], j[3][3], v[3];
            double w = now->covered_weight[k * b->cut.n + q] *
                       mesh_place(m, b->space->attached_cell[a], b->cut.x[q], x, j);

            for (int i = 0; i < m->dim; i++)
                x[i] -= b->envelope.shift[a][i];
            bodies_velocity(b, &now->body[body].at, r->x, body, x, v);
            *volume += w;
            for (int i = 0; i < m->dim; i++)
                sum[i] += w * v[i];
        }
    }
}

int norms_mean(const run *r, int f, double *mean, error *err)
{
    const problem *p = r->p;
    double volume = 0;
    fe_rule rule, own;

    TRY(fe_rule_cell(p->mesh.type, 5, &rule, err));
    memset(mean, 0, (size_t)p->space.field[f].n_comp * sizeof *mean);
    for (int64_t e = 0; e < p->mesh.n_cell; e++) {
        const fe_rule *part = bodies_points(&p->bodies, p->bodies.now, f, e, &rule, &own);

        for (int q = 0; q < part->n; q++) {
            point_data d;

            at_point(r, f, e, part->x[q], part->w[q], &d);
            volume += d.w;
            for (int k = 0; k < p->space.field[f].n_comp; k++)
                mean[k] += d.w * d.value[k];
        }
    }
    if (p->bodies.now && bodies_moved_field(&p->bodies) == f)
        add_bodies(r, mean, &volume);
    for (int k = 0; k < p->space.field[f].n_comp; k++)
        mean[k] /= volume;
    return 0;
}

int norms_check(const problem *p, error *err)
{
    const description *d = &p->description;
    double x[3] = {0}, v[VALUE_MAX];

    memcpy(x, p->mesh.x, (size_t)p->mesh.dim * sizeof *x);
    for (int f = 0; f < d->fields.n; f++)
        if (d->has_exact[f])
            TRY(value_at(&d->exact[f], x, d->time.start, v, err));
    return 0;
}
