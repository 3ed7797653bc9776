/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What second derivatives and the size of an element in each direction are at a point:
 *
 *     lap n = (G G^T) : d^2 n/dxi^2 - (G (G G^T) : d^2 x/dxi^2) . dn/dxi,     G = dxi/dx,
 *
 * and the metric G^T R G with R such that it does not depend on the numbers of the vertices. */
#include "assemble/batch.h"

laplacian laplacian_of(int dim, int n_node, const v8 *x_node, const double (*d2n)[FE_SECOND], v8 inv[3][3])
{
    static const int of[FE_SECOND][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};
    laplacian p = {{{0}}, {{0}}};
    v8 curvature[3] = {{0}};

    for (int s = 0; s < FE_SECOND; s++) {
        int k = of[s][0], l = of[s][1];

        for (int a = 0; k < dim && l < dim && a < dim; a++)
            p.m[s] += inv[k][a] * inv[l][a] * (k == l ? 1.0 : 2.0); /* xy stands for yx too */
    }
    for (int a = 0; a < dim; a++)
        for (int i = 0; i < n_node; i++)
            for (int s = 0; s < FE_SECOND; s++)
                curvature[a] += x_node[a * n_node + i] * p.m[s] * d2n[i][s];
    for (int k = 0; k < dim; k++)
        for (int a = 0; a < dim; a++)
            p.e[k] += inv[k][a] * curvature[a];
    return p;
}

v8 laplacian_apply(const laplacian *p, int dim, const double dn[3], const double d2n[FE_SECOND])
{
    v8 v = {0};

    for (int s = 0; s < FE_SECOND; s++)
        v += p->m[s] * d2n[s];
    for (int k = 0; k < dim; k++)
        v -= p->e[k] * dn[k];
    return v;
}

/* R of the regular simplex with edges of length 2: products of its edges from one vertex. */
v8 metric_of(int dim, int simplex, v8 inv[3][3], int a, int b)
{
    v8 g = {0};

    for (int k = 0; k < dim; k++)
        for (int l = 0; l < dim; l++)
            if (simplex || k == l)
                g += inv[k][a] * inv[l][b] * (!simplex ? 1.0 : k == l ? 4.0 : 2.0);
    return g;
}
