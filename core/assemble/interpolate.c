/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A field at the points of a batch from its nodal values. */
#include "assemble/batch.h"

#include <string.h>

/* Reference derivatives of a component to those by place, d/dx_k = sum_b dxi_b/dx_k d/dxi_b. */
static void slope(const workspace *w, int dim, int nq, int k, const v8 *restrict ref, v8 *restrict to, int add)
{
    for (int b = 0; b < dim; b++) {
        const v8 *restrict inverse = w->inverse + (b * dim + k) * nq;

        if (w->boxes && b != k)
            continue;
        for (int q = 0; q < nq; q++) {
            v8 part = (w->boxes ? w->scale[k] : inverse[q]) * ref[b * nq + q];

            to[q] = add ? to[q] + part : part;
        }
        add = 1;
    }
}

static void interpolate_product(const assembly_class *c, const field_spec *f, uint32_t eval, workspace *w, v8 *to)
{
    int dim = c->tensor->dim, nq = c->n_q, n = c->n_basis[f->order];
    v8 *ref = w->reference;

    for (int a = 0; a < f->n_comp; a++) {
        v8 *value[TENSOR_KINDS] = {to + a * nq};
        v8 *slopes[TENSOR_KINDS] = {NULL, ref, ref + nq, dim == 3 ? ref + 2 * nq : NULL};
        int grad = eval == PF_GRAD, div = eval == PF_DIV;

        tensor_values(c->tensor, f->order, w->dof + a * n, grad || div ? slopes : value, w->stages);
        for (int k = 0; grad && k < dim; k++)
            slope(w, dim, nq, k, ref, to + (a * dim + k) * nq, 0);
        if (div)
            slope(w, dim, nq, a, ref, to, a > 0);
    }
}

void interpolate(const assembly_class *c, const field_spec *f, int dim, uint32_t eval, workspace *w, v8 *to)
{
    int grad = eval == PF_GRAD, div = eval == PF_DIV, nq = c->n_q, width = c->n_basis[f->order];
    int n = c->where == PF_CUT && eval != PF_DEFECT ? width / 2 : width; /* the first half: of the bad cell */
    int alone = c->where == PF_PAIR && eval != PF_DEFECT;
    int first = eval == PF_LAPLACE ? LAPLACE_ROW
                : alone            ? (eval == PF_OTHER ? OTHER_ROW : FIRST_ROW)
                : grad || div      ? 1
                                   : 0,
        last = grad || div ? dim : first;

    if (c->tensor) {
        interpolate_product(c, f, eval, w, to);
        return;
    }
    memset(to, 0, (size_t)((div ? 1 : grad ? dim * f->n_comp : f->n_comp) * nq) * sizeof *to);
    for (int a = 0; a < f->n_comp; a++)
        for (int k = first; k <= last; k++) {
            v8 *restrict out = to + (grad ? (a * dim + k - 1) * nq : div ? 0 : a * nq);

            if (div && k != a + 1)
                continue;
            for (int i = 0; i < n; i++) {
                v8 u = w->dof[a * width + i];
                const v8 *restrict b = w->basis[f->order][k] + i * nq;

                for (int q = 0; q < nq; q++)
                    out[q] += u * b[q];
            }
        }
}
