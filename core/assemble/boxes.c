/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Points of a batch where points and bases are products of those on a line.  Most such cells are boxes with sides
 * along the axes: dxi/dx is diagonal there, and the same at all points. */
#include "assemble/batch.h"

v8 geometry_inverse(int dim, v8 j[3][3], v8 inv[3][3])
{
    v8 det;

    if (dim == 2) {
        det = j[0][0] * j[1][1] - j[0][1] * j[1][0];
        inv[0][0] = j[1][1] / det, inv[0][1] = -j[0][1] / det;
        inv[1][0] = -j[1][0] / det, inv[1][1] = j[0][0] / det;
        return det;
    }
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) {
            int p = (b + 1) % 3, q = (b + 2) % 3, r = (a + 1) % 3, t = (a + 2) % 3;

            inv[a][b] = j[p][r] * j[q][t] - j[p][t] * j[q][r]; /* cofactor of (b, a) */
        }
    det = j[0][0] * inv[0][0] + j[0][1] * inv[1][0] + j[0][2] * inv[2][0];
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++)
            inv[a][b] /= det;
    return det;
}

void boxes_sides(const assembly *a, const assembly_class *c, int64_t batch, v8 *middle, v8 *half)
{
    const mesh *m = a->space->mesh;
    int dim = m->dim, n = m->type->n_node;

    for (int l = 0; l < 8; l++) {
        const int32_t *node = m->cell + (int64_t)c->cell[assemble_item(c, batch, l)] * n;
        const double *low = m->x + (int64_t)node[0] * dim, *high = m->x + (int64_t)node[n - 1] * dim;

        for (int k = 0; k < dim; k++) {
            middle[k][l] = 0.5 * (low[k] + high[k]);
            half[k][l] = 0.5 * (high[k] - low[k]);
        }
    }
}

/* Places and weights; w->w: of the reference cell before. */
static void points_of_boxes(const assembly *a, const assembly_class *c, int64_t batch, workspace *w)
{
    int dim = a->space->mesh->dim, nq = c->n_q;
    v8 det = (v8){0} + 1, middle[3], half[3];

    boxes_sides(a, c, batch, middle, half);
    for (int k = 0; k < dim; k++) {
        w->scale[k] = 1 / half[k];
        det *= half[k];
        for (int q = 0; q < nq; q++)
            w->x[k * nq + q] = middle[k] + half[k] * c->rule[0].x[q][k];
    }
    for (int q = 0; q < nq; q++)
        w->w[q] *= det;
    for (int k = 0; c->any_metric && k < dim * dim; k++)
        for (int q = 0; q < nq; q++)
            w->inverse[k * nq + q] = k % (dim + 1) ? (v8){0} : w->scale[k / dim];
}

/* The same of cells of any shape: dx/dxi by sums over the nodes, then its inverse. */
static void points_of_cells(const assembly *a, const assembly_class *c, int64_t batch, workspace *w)
{
    const mesh *m = a->space->mesh;
    int dim = m->dim, nq = c->n_q, n = m->type->n_node;
    v8 *j = w->reference;

    for (int k = 0; k < dim; k++) {
        v8 *out[TENSOR_KINDS] = {w->x + k * nq, j + k * dim * nq, j + (k * dim + 1) * nq,
                                 dim == 3 ? j + (k * dim + 2) * nq : NULL};

        for (int l = 0; l < 8; l++) {
            const int32_t *node = m->cell + (int64_t)c->cell[assemble_item(c, batch, l)] * n;

            for (int i = 0; i < n; i++)
                w->x_node[i][l] = m->x[(int64_t)node[i] * dim + k];
        }
        tensor_values(c->tensor, 2, w->x_node, out, w->stages);
    }
    for (int q = 0; q < nq; q++) {
        v8 at[3][3], inverse[3][3];

        for (int k = 0; k < dim * dim; k++)
            at[k / dim][k % dim] = j[k * nq + q];
        w->w[q] *= geometry_inverse(dim, at, inverse);
        for (int k = 0; k < dim * dim; k++)
            w->inverse[k * nq + q] = inverse[k / dim][k % dim];
    }
}

static void metrics(const assembly_class *c, int dim, workspace *w)
{
    int nq = c->n_q;

    for (int q = 0; q < nq; q++) {
        v8 inverse[3][3];

        for (int k = 0; k < dim * dim; k++)
            inverse[k / dim][k % dim] = w->inverse[k * nq + q];
        for (int k = 0; k < dim * dim; k++)
            w->metric[k * nq + q] = metric_of(dim, 0, inverse, k / dim, k % dim);
    }
}

void geometry_tensor(const assembly *a, const assembly_class *c, int64_t batch, workspace *w)
{
    const mesh *m = a->space->mesh;
    int nq = c->n_q;
    v8 h, on;

    w->boxes = 1;
    for (int l = 0; l < 8; l++) {
        int64_t item = assemble_item(c, batch, l), cell = c->cell[item];

        h[l] = m->h[cell];
        on[l] = !c->off || !c->off[cell];
        w->boxes &= m->is_box[cell];
        for (int q = 0; c->weight && q < nq; q++)
            w->w[q][l] = c->weight[c->source[item] * nq + q];
    }
    for (int q = 0; q < nq; q++) {
        w->h[q] = h;
        if (!c->weight)
            w->w[q] = c->rule[0].w[q] * on;
    }
    if (w->boxes)
        points_of_boxes(a, c, batch, w);
    else
        points_of_cells(a, c, batch, w);
    if (c->any_metric)
        metrics(c, m->dim, w);
}
