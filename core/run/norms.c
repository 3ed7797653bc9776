/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Errors against the exact solution that a case gives.  Gradients of the exact solution come
 * from differences of fourth order.  A field that is free up to a constant is compared with
 * zero mean on both sides. */
#include "run/run.h"

#include <math.h>
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

/* Point q of cell e: where it is, and u_h and its gradient there. */
static void at_point(const problem *p, int f, int64_t e, const fe_rule *rule, int q, point_data *d)
{
    const mesh *m = &p->mesh;
    const fe_cell *c = m->type;
    const space_field *g = &p->space.field[f];
    double n[FE_MAX_NODES], dn[FE_MAX_NODES][3], j[3][3], inv[3][3], det;
    int dim = p->dim, n_basis = fe_n_basis(c, g->order);

    fe_basis(c, 2, rule->x[q], n, dn);
    memset(d, 0, sizeof *d);
    det = mesh_map(m, e, n, (const double(*)[3])dn, d->x, j);
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) {
            int r = (b + 1) % 3, s = (b + 2) % 3, u = (a + 1) % 3, v = (a + 2) % 3;

            inv[a][b] = j[r][u] * j[s][v] - j[r][v] * j[s][u];
        }
    d->w = rule->w[q] * det;
    d->h = m->h[e];
    fe_basis(c, g->order, rule->x[q], n, dn);
    for (int i = 0; i < n_basis; i++) {
        int64_t node = g->order == 0 ? m->n_node : m->cell[e * c->n_node + (g->order == 2 ? i : c->vertex[i])];

        for (int k = 0; k < g->n_comp; k++) {
            double u = p->x[p->space.first[f][node] + k];

            d->value[k] += n[i] * u;
            for (int a = 0; a < dim; a++)
                for (int b = 0; b < dim; b++)
                    d->gradient[k * dim + a] += u * dn[i][b] * inv[b][a] / det;
        }
    }
}

int norms_of_error(const problem *p, int f, double t, double *l2, double *h1, double *exact, error *err)
{
    const mesh *m = &p->mesh;
    int n = p->space.field[f].n_comp, dim = p->dim;
    double sum = 0, grad = 0, size = 0, mean = 0, mean_exact = 0, volume = 0;
    fe_rule rule, own;

    TRY(fe_rule_cell(m->type, m->type->simplex ? 5 : 7, &rule, err));
    for (int64_t e = 0; e < m->n_cell; e++) {
        const fe_rule *part = problem_points(p, f, e, &rule, &own);

        for (int q = 0; q < part->n; q++) {
            point_data d;
            double u[VALUE_MAX], g[VALUE_MAX * 3];

            at_point(p, f, e, part, q, &d);
            TRY(value_at(&p->exact[f], d.x, t, u, err));
            TRY(exact_gradient(p, f, d.x, t, 1e-3 * d.h, g, err));
            volume += d.w;
            mean += d.w * (d.value[0] - u[0]);
            mean_exact += d.w * u[0];
            for (int k = 0; k < n; k++) {
                sum += d.w * (d.value[k] - u[k]) * (d.value[k] - u[k]);
                size += d.w * u[k] * u[k];
                for (int a = 0; a < dim; a++)
                    grad += d.w * (d.gradient[k * dim + a] - g[k * dim + a]) *
                            (d.gradient[k * dim + a] - g[k * dim + a]);
            }
        }
    }
    if (p->system.gauge.free[f]) {
        sum -= mean * mean / volume;
        size -= mean_exact * mean_exact / volume;
    }
    *l2 = sqrt(fmax(sum, 0)); /* weights of cut cells have any sign */
    *h1 = sqrt(grad);
    *exact = sqrt(fmax(size, 0));
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
                    double n[FE_MAX_NODES], dn[FE_MAX_NODES][3], x[3], j[3][3], v[3], w;

                    fe_basis(p->mesh.type, 2, p->cut.x[q], n, dn);
                    w = p->weight[k * p->cut.n + q] *
                        mesh_map(&p->mesh, s->attached_cell[a], n, (const double(*)[3])dn, x, j);
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

            at_point(p, f, e, part, q, &d);
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
