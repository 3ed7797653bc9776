/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Points of a batch: where they are, their weights, and the basis functions there. */
#include "assemble/batch.h"

#include <math.h>
#include <string.h>

static v8 v8_sqrt(v8 a)
{
    for (int l = 0; l < 8; l++)
        a[l] = sqrt(a[l]);
    return a;
}

/* Jacobian matrix of the mapping at q, j[a][b] = dx_a / dxi_b, its inverse and determinant. */
static v8 mapping(int dim, int n_node, const v8 *x_node, const double (*dn)[3], v8 j[3][3], v8 inv[3][3])
{
    const v8 zero = {0};

    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++)
            j[a][b] = zero;
    for (int a = 0; a < dim; a++)
        for (int i = 0; i < n_node; i++)
            for (int b = 0; b < dim; b++)
                j[a][b] += x_node[a * n_node + i] * dn[i][b];
    return geometry_inverse(dim, j, inv);
}

/* Area element and outward normal of a facet from the mapped tangents. */
static v8 facet_measure(int dim, v8 j[3][3], const double tangent[2][3], int orient, v8 n[3])
{
    const v8 zero = {0};
    v8 t[2][3], size;

    for (int s = 0; s < 2; s++)
        for (int a = 0; a < 3; a++) {
            t[s][a] = zero;
            for (int b = 0; b < dim; b++)
                t[s][a] += j[a][b] * tangent[s][b];
        }
    if (dim == 2) {
        n[0] = t[0][1] * (double)orient;
        n[1] = -t[0][0] * (double)orient;
        size = v8_sqrt(n[0] * n[0] + n[1] * n[1]);
    } else {
        for (int a = 0; a < 3; a++) {
            int p = (a + 1) % 3, q = (a + 2) % 3;

            n[a] = (t[0][p] * t[1][q] - t[0][q] * t[1][p]) * (double)orient;
        }
        size = v8_sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    }
    for (int a = 0; a < dim; a++)
        n[a] /= size;
    return size;
}

/* Arm from the centre of its particle, density and number, at the points of each lane. */
static void particle_slots(const assembly *a, const assembly_class *c, int64_t batch, workspace *w)
{
    const space *s = a->space;
    int dim = s->mesh->dim, nq = c->n_q;

    for (int l = 0; l < 8; l++) {
        int64_t attached = c->group[assemble_item(c, batch, l)] - space_attached_group(s, 0);
        int32_t id = s->attached_particle[attached];
        const body_points *b = a->bodies;

        for (int q = 0; q < nq; q++) {
            for (int k = 0; k < dim; k++)
                w->arm[k * nq + q][l] = w->x[k * nq + q][l] - b->body[id].at.x[k] - b->shift[attached][k];
            w->density[q][l] = b->density[id];
            w->id[q * 8 + l] = id;
        }
    }
}

/* A pair: one point, the first body counts 1 and the other -1. */
static void points_of_pairs(const assembly *a, const assembly_class *c, int64_t batch, workspace *w)
{
    const v8 zero = {0};

    w->w[0] = zero + 1;
    for (int k = 0; k <= ASSEMBLE_PAD; k++) {
        w->basis[0][0][k] = zero + (k == 0 ? 1.0 : k == 1 ? -1.0 : 0.0);
        w->basis[0][FIRST_ROW][k] = zero + (k == 0);
        w->basis[0][OTHER_ROW][k] = zero + (k == 1);
    }
    for (int l = 0; l < 8; l++) {
        const near_pair *near = &c->pair[c->source[assemble_item(c, batch, l)]];

        w->h[0][l] = near->h;
        w->gap[0][l] = near->gap;
        for (int i = 0; i < 2; i++)
            w->size[i][0][l] = near->size[i];
        w->density[0][l] = near->density[0];
        w->other_density[0][l] = near->density[1];
        w->id[l] = near->particle;
        for (int k = 0; k < a->space->mesh->dim; k++) {
            w->x[k][l] = near->at[k];
            w->normal[k][l] = near->normal[k];
        }
    }
}

/* What properties take of a bad cell is of its own functions; those of the root have no part in it. */
static void own_basis(const assembly_class *c, int n_basis, int order, workspace *w)
{
    int nq = c->n_q, all = assemble_padded(2 * n_basis);

    for (int i = 0; c->own_used[order] && i < all * nq; i++)
        w->basis[order][OWN_ROW][i] = i < n_basis * nq ? w->basis[order][0][i] : (v8){0};
    for (int k = 1; k <= LAPLACE_ROW; k++)
        if (k == LAPLACE_ROW ? c->laplace_used[order] : c->grad_used[order] && w->basis[order][k])
            memset(w->basis[order][k] + n_basis * nq, 0, (size_t)((all - n_basis) * nq) * sizeof(v8));
}

/* The root of a bad cell: its basis at the points of the bad one, with the opposite sign. */
static void points_of_roots(const assembly *a, const assembly_class *c, int64_t batch, workspace *w)
{
    const fe_cell *type = a->space->mesh->type;
    int nq = c->n_q;

    for (int l = 0; l < 8; l++)
        for (int q = 0; q < nq; q++) {
            int64_t item = c->source[assemble_item(c, batch, l)];

            w->w[q][l] *= c->weight[item];
            for (int order = 1; order < 3; order++) {
                int n_basis = fe_n_basis(type, order);
                double n[FE_MAX_NODES], dn[FE_MAX_NODES][3];

                fe_basis(type, order, c->ref[item * nq + q], n, dn);
                for (int i = 0; c->order_used[order] && i < assemble_padded(2 * n_basis) - n_basis; i++)
                    w->basis[order][0][(n_basis + i) * nq + q][l] = i < n_basis ? -n[i] : 0;
            }
        }
    for (int order = 1; order < 3; order++)
        own_basis(c, fe_n_basis(type, order), order, w);
}

/* Values and gradients of the basis functions at point q of rule f. */
static void basis_at(const assembly_class *c, const fe_cell *type, int f, int q, v8 inv[3][3], workspace *w)
{
    const v8 zero = {0};
    int dim = type->dim, nq = c->n_q;

    for (int order = 0; order < 3; order++) {
        int n_basis = fe_n_basis(type, order);

        for (int i = 0; c->order_used[order] && i < n_basis; i++) {
            const double *dn = c->dn_ref[f][order][q * n_basis + i];

            w->basis[order][0][i * nq + q] = zero + c->n_ref[f][order][q * n_basis + i];
            for (int k = 0; c->grad_used[order] && k < dim; k++) {
                v8 g = inv[0][k] * dn[0] + inv[1][k] * dn[1];

                w->basis[order][k + 1][i * nq + q] = dim == 3 ? g + inv[2][k] * dn[2] : g;
            }
        }
        for (int i = n_basis; c->order_used[order] && i < assemble_padded(n_basis); i++)
            for (int k = 0; k <= dim; k++)
                w->basis[order][k][i * nq + q] = zero;
    }
}

/* Laplacians of the basis functions and metrics at point q of rule f. */
static void second_at(const assembly_class *c, const fe_cell *type, int f, int q, v8 inv[3][3], workspace *w)
{
    int dim = type->dim, nq = c->n_q, n_node = type->n_node;
    laplacian p;

    for (int k = 0; c->any_metric && k < dim * dim; k++)
        w->metric[k * nq + q] = metric_of(dim, type->simplex, inv, k / dim, k % dim);
    if (!c->any_laplace)
        return;
    p = laplacian_of(dim, n_node, w->x_node, (const double(*)[FE_SECOND])c->d2n_ref[f][2] + q * n_node, inv);
    for (int order = 0; order < 3; order++) {
        int n_basis = fe_n_basis(type, order);

        for (int i = 0; c->laplace_used[order] && i < assemble_padded(n_basis); i++)
            w->basis[order][LAPLACE_ROW][i * nq + q] =
                i < n_basis ? laplacian_apply(&p, dim, c->dn_ref[f][order][q * n_basis + i],
                                              c->d2n_ref[f][order][q * n_basis + i])
                            : (v8){0};
    }
}

/* Points of cells, cut or whole, and of facets, by the mapping of their cells. */
static void points_of_cells(const assembly *a, const assembly_class *c, int64_t batch, workspace *w)
{
    const mesh *m = a->space->mesh;
    const fe_cell *type = m->type;
    int dim = m->dim, nq = c->n_q, f = c->facet[c->batch[batch]];
    v8 h, on;

    geometry_nodes(a, c, batch, w);
    for (int l = 0; l < 8; l++) {
        int64_t cell = c->cell[assemble_item(c, batch, l)];

        h[l] = m->h[cell];
        on[l] = !c->off || !c->off[cell];
    }
    for (int q = 0; q < nq; q++) {
        v8 j[3][3], inv[3][3], n[3];
        v8 det =
            mapping(dim, type->n_node, w->x_node, (const double(*)[3])c->dn_ref[f][2] + q * type->n_node, j, inv);

        if (c->where == PF_FACET) {
            det = facet_measure(dim, j, c->tangent[f], c->orient[f], n);
            for (int k = 0; k < dim; k++)
                w->normal[k * nq + q] = n[k];
        }
        if (c->weight && c->where != PF_CUT)
            for (int l = 0; l < 8; l++)
                w->w[q][l] = det[l] * c->weight[c->source[assemble_item(c, batch, l)] * nq + q];
        else
            w->w[q] = det * c->rule[f].w[q] * on;
        w->h[q] = h;
        for (int k = 0; k < dim; k++) {
            v8 x = {0};

            for (int i = 0; i < type->n_node; i++)
                x += w->x_node[k * type->n_node + i] * c->n_ref[f][2][q * type->n_node + i];
            w->x[k * nq + q] = x;
        }
        basis_at(c, type, f, q, inv, w);
        if (c->any_laplace || c->any_metric)
            second_at(c, type, f, q, inv, w);
    }
    if (c->where == PF_CUT)
        points_of_roots(a, c, batch, w);
}

void geometry_points(const assembly *a, const assembly_class *c, int64_t batch, workspace *w)
{
    if (c->where == PF_PAIR)
        points_of_pairs(a, c, batch, w);
    else if (c->where == PF_PARTICLE)
        points_of_bodies(a, c, batch, w);
    else if (c->where == PF_SURFACE)
        geometry_surface(a, c, batch, w);
    else if (c->tensor)
        geometry_tensor(a, c, batch, w);
    else
        points_of_cells(a, c, batch, w);
    if (c->where == PF_SURFACE || c->where == PF_SOLID)
        particle_slots(a, c, batch, w);
}
