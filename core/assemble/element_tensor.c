/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Element vectors and matrices where points and bases are products of those on a line: coefficients are turned to
 * reference derivatives at each point, d_ref^ef = w sum_kl dxi_e/dx_k d^kl dxi_f/dx_l, and summed by tensor.c. */
#include "assemble/batch.h"

/* dxi_b/dx_k times v, into (add: onto) to. */
static void turn(const workspace *w, int dim, int nq, int b, int k, const v8 *restrict v, v8 *restrict to, int add)
{
    const v8 *restrict inverse = w->inverse + (b * dim + k) * nq;

    for (int q = 0; q < nq; q++)
        to[q] = add ? to[q] + inverse[q] * v[q] : inverse[q] * v[q];
}

static void scale(v8 factor, const v8 *restrict w, int nq, const v8 *restrict v, v8 *restrict to)
{
    for (int q = 0; q < nq; q++)
        to[q] = factor * w[q] * v[q];
}

void element_vector_tensor(const assembly_class *c, int field, const field_spec *f, const v8 *value, const v8 *grad,
                           workspace *w)
{
    int dim = c->tensor->dim, nq = c->n_q;

    for (int a = 0; a < f->n_comp; a++) {
        const v8 *s[TENSOR_KINDS] = {NULL};
        v8 *room = w->reference, *weighed = w->reference + 4 * nq;

        if (value)
            scale((v8){0} + 1, w->w, nq, value + a * nq, room);
        s[0] = value ? room : NULL;
        for (int k = 0; grad && k < dim; k++) {
            if (w->boxes) {
                scale(w->scale[k], w->w, nq, grad + (a * dim + k) * nq, room + (k + 1) * nq);
            } else {
                scale((v8){0} + 1, w->w, nq, grad + (a * dim + k) * nq, weighed);
                for (int b = 0; b < dim; b++)
                    turn(w, dim, nq, b, k, weighed, room + (b + 1) * nq, k > 0);
            }
            s[k + 1] = room + (k + 1) * nq;
        }
        if (value || grad)
            tensor_vector(c->tensor, f->order, s, c->layout.at[field], w->vec + a, w->stages);
    }
}

/* Of boxes: every coefficient by itself. */
static void to_reference_box(const workspace *w, int dim, int nq, const v8 *d[TEST_ROWS][BASIS_ROWS],
                             const v8 *ref[TENSOR_KINDS][TENSOR_KINDS])
{
    v8 *to = w->reference;

    for (int e = 0; e <= dim; e++)
        for (int f = 0; f <= dim; f++) {
            const v8 one = (v8){0} + 1;

            ref[e][f] = d[e][f] ? to : NULL;
            if (!d[e][f])
                continue;
            scale((e ? w->scale[e - 1] : one) * (f ? w->scale[f - 1] : one), w->w, nq, d[e][f], to);
            to += nq;
        }
}

/* Rows first, d_k^f to half_e^f, then columns. */
static void to_reference(const workspace *w, int dim, int nq, const v8 *d[TEST_ROWS][BASIS_ROWS],
                         const v8 *ref[TENSOR_KINDS][TENSOR_KINDS])
{
    v8 *to = w->reference, *weighed = to + 2 * TENSOR_KINDS * TENSOR_KINDS * nq;
    v8 *half[TENSOR_KINDS][TENSOR_KINDS] = {{NULL}}, *whole[TENSOR_KINDS][TENSOR_KINDS] = {{NULL}};

    for (int f = 0; f <= dim; f++)
        for (int k = 0; k <= dim; k++) {
            if (!d[k][f])
                continue;
            scale((v8){0} + 1, w->w, nq, d[k][f], weighed);
            for (int e = k > 0; e <= (k ? dim : 0); e++) {
                int add = half[e][f] != NULL;

                if (!add)
                    half[e][f] = to, to += nq;
                if (k)
                    turn(w, dim, nq, e - 1, k - 1, weighed, half[e][f], add);
                else
                    scale((v8){0} + 1, w->w, nq, d[0][f], half[0][f]);
            }
        }
    for (int e = 0; e <= dim; e++) {
        whole[e][0] = half[e][0];
        for (int l = 1; l <= dim; l++)
            for (int f = 1; half[e][l] && f <= dim; f++) {
                int add = whole[e][f] != NULL;

                if (!add)
                    whole[e][f] = to, to += nq;
                turn(w, dim, nq, f - 1, l - 1, half[e][l], whole[e][f], add);
            }
        for (int f = 0; f <= dim; f++)
            ref[e][f] = whole[e][f];
    }
}

void element_matrix_tensor(const assembly_class *c, int row_order, int column_order,
                           const v8 *d[TEST_ROWS][BASIS_ROWS], const int32_t *place, v8 *mat, workspace *w)
{
    const v8 *ref[TENSOR_KINDS][TENSOR_KINDS] = {{NULL}};

    if (w->boxes)
        to_reference_box(w, c->tensor->dim, c->n_q, d, ref);
    else
        to_reference(w, c->tensor->dim, c->n_q, d, ref);
    tensor_matrix(c->tensor, row_order, column_order, ref, place, mat, w->stages);
}
