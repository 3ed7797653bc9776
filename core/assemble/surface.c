/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Points of a batch on pieces of surface: each item has its own, by reference coordinates in its cell. */
#include "assemble/batch.h"

void geometry_nodes(const assembly *a, const assembly_class *c, int64_t batch, workspace *w)
{
    const mesh *m = a->space->mesh;
    int dim = m->dim, n = m->type->n_node;

    for (int l = 0; l < 8; l++) {
        const int32_t *node = m->cell + (int64_t)c->cell[assemble_item(c, batch, l)] * n;

        for (int i = 0; i < n; i++)
            for (int k = 0; k < dim; k++)
                w->x_node[k * n + i][l] = m->x[(int64_t)node[i] * dim + k];
    }
}

/* Place of a point of a cell, and dxi/dx there. */
static void map_point(const mesh *m, int64_t cell, const double *xi, double x[3], double inv[3][3])
{
    double j[3][3], det = mesh_place(m, cell, xi, x, j);

    for (int b = 0; b < 3; b++)
        for (int k = 0; k < 3; k++) /* j is the identity in the unused direction */
            inv[b][k] = (j[(k + 1) % 3][(b + 1) % 3] * j[(k + 2) % 3][(b + 2) % 3] -
                         j[(k + 1) % 3][(b + 2) % 3] * j[(k + 2) % 3][(b + 1) % 3]) /
                        det;
}

/* Points that each item has of its own, on a piece of surface. */
static void points_of_cells(const assembly *a, const assembly_class *c, int64_t batch, workspace *w)
{
    const mesh *m = a->space->mesh;
    const fe_cell *type = m->type;
    int dim = m->dim, nq = c->n_q;

    for (int l = 0; l < 8; l++) {
        int64_t item = assemble_item(c, batch, l), cell = c->cell[item], from = c->source[item];

        for (int q = 0; q < nq; q++) {
            const double *xi = c->ref[from * nq + q];
            double n[FE_MAX_NODES], dn[FE_MAX_NODES][3], x[3], inv[3][3];

            map_point(m, cell, xi, x, inv);
            w->w[q][l] = c->weight[from * nq + q];
            w->h[q][l] = m->h[cell];
            for (int k = 0; k < dim; k++) {
                w->x[k * nq + q][l] = x[k];
                w->normal[k * nq + q][l] = c->normal[from * nq + q][k];
            }
            for (int order = 0; order < 3; order++) {
                int n_basis = c->order_used[order] ? fe_n_basis(type, order) : 0;

                if (n_basis)
                    fe_basis(type, order, xi, n, dn);
                for (int i = 0; i < n_basis; i++) {
                    w->basis[order][0][i * nq + q][l] = n[i];
                    for (int k = 0; c->grad_used[order] && k < dim; k++)
                        w->basis[order][k + 1][i * nq + q][l] =
                            inv[0][k] * dn[i][0] + inv[1][k] * dn[i][1] + (dim == 3 ? inv[2][k] * dn[i][2] : 0);
                }
                for (int i = n_basis; n_basis && i < assemble_padded(n_basis); i++)
                    for (int k = 0; k <= dim; k++)
                        w->basis[order][k][i * nq + q][l] = 0;
            }
        }
    }
}

/* What the others leave to the end: Laplacians and metrics, lane by lane. */
static void second_on_surface(const assembly *a, const assembly_class *c, int64_t batch, workspace *w)
{
    const mesh *m = a->space->mesh;
    const fe_cell *type = m->type;
    int dim = m->dim, nq = c->n_q;

    geometry_nodes(a, c, batch, w);
    for (int l = 0; l < 8; l++)
        for (int q = 0; q < nq; q++) {
            int64_t item = assemble_item(c, batch, l);
            const double *xi = c->ref[c->source[item] * nq + q];
            double n[FE_MAX_NODES], dn[FE_MAX_NODES][3], d2n[FE_MAX_NODES][FE_SECOND], x[3], at[3][3];
            v8 inv[3][3];
            laplacian p;

            /* All lanes as if they were at the point of this one, whose result alone is kept. */
            map_point(m, c->cell[item], xi, x, at);
            for (int k = 0; k < 9; k++)
                inv[k / 3][k % 3] = (v8){0} + at[k / 3][k % 3];
            for (int k = 0; c->any_metric && k < dim * dim; k++)
                w->metric[k * nq + q][l] = metric_of(dim, type->simplex, inv, k / dim, k % dim)[l];
            if (!c->any_laplace)
                continue;
            fe_basis_second(type, 2, xi, d2n);
            p = laplacian_of(dim, type->n_node, w->x_node, (const double(*)[FE_SECOND])d2n, inv);
            for (int order = 0; order < 3; order++) {
                int n_basis = c->laplace_used[order] ? fe_n_basis(type, order) : 0;

                if (n_basis) {
                    fe_basis(type, order, xi, n, dn);
                    fe_basis_second(type, order, xi, d2n);
                }
                for (int i = 0; n_basis && i < assemble_padded(n_basis); i++)
                    w->basis[order][LAPLACE_ROW][i * nq + q][l] =
                        i < n_basis ? laplacian_apply(&p, dim, dn[i], d2n[i])[l] : 0;
            }
        }
}

/* Bases at point q of boxes, products of those on lines; xi: of each lane. */
static void basis_in_boxes(const assembly_class *c, const fe_cell *type, int q, const double *const *xi,
                           workspace *w)
{
    int dim = type->dim, nq = c->n_q;

    for (int order = 0; order < 3; order++) {
        int m = order + 1, n = c->order_used[order] ? fe_n_basis(type, order) : 0;
        v8 line[3][3], slope[3][3];

        for (int k = 0; n && k < dim; k++)
            for (int l = 0; l < 8; l++) {
                double v[3], d[3];

                fe_line_basis(order, xi[l][k], v, d);
                for (int i = 0; i < m; i++) {
                    line[k][i][l] = v[i];
                    slope[k][i][l] = d[i] * w->scale[k][l];
                }
            }
        for (int i = 0; i < n; i++) {
            v8 *const *to = w->basis[order];
            v8 x = line[0][i % m], y = line[1][i / m % m], z = dim == 3 ? line[2][i / (m * m)] : (v8){0} + 1;

            to[0][i * nq + q] = x * y * z;
            to[1][i * nq + q] = slope[0][i % m] * y * z;
            to[2][i * nq + q] = x * slope[1][i / m % m] * z;
            if (dim == 3)
                to[3][i * nq + q] = x * y * slope[2][i / (m * m)];
        }
        for (int i = n; n && i < assemble_padded(n); i++)
            for (int k = 0; k <= dim; k++)
                w->basis[order][k][i * nq + q] = (v8){0};
    }
}

/* The same as points_of_cells in boxes. */
static void points_of_boxes(const assembly *a, const assembly_class *c, int64_t batch, workspace *w)
{
    const mesh *m = a->space->mesh;
    v8 middle[3], half[3];

    boxes_sides(a, c, batch, middle, half);
    for (int k = 0; k < m->dim; k++)
        w->scale[k] = 1 / half[k];
    for (int q = 0; q < c->n_q; q++) {
        const double *xi[8];

        for (int l = 0; l < 8; l++) {
            int64_t item = assemble_item(c, batch, l), from = (int64_t)c->source[item] * c->n_q + q;

            xi[l] = c->ref[from];
            w->w[q][l] = c->weight[from];
            w->h[q][l] = m->h[c->cell[item]];
            for (int k = 0; k < m->dim; k++) {
                w->x[k * c->n_q + q][l] = middle[k][l] + half[k][l] * xi[l][k];
                w->normal[k * c->n_q + q][l] = c->normal[from][k];
            }
        }
        basis_in_boxes(c, m->type, q, xi, w);
    }
}

void geometry_surface(const assembly *a, const assembly_class *c, int64_t batch, workspace *w)
{
    int boxes = 1;

    for (int l = 0; l < 8; l++)
        boxes &= a->space->mesh->is_box[c->cell[assemble_item(c, batch, l)]];
    if (boxes)
        points_of_boxes(a, c, batch, w);
    else
        points_of_cells(a, c, batch, w);
    if (c->any_laplace || c->any_metric)
        second_on_surface(a, c, batch, w);
}
