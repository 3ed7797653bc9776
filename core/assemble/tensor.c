/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Sums over the points of quads and hexes, one direction after the other.  Every stage is
 *
 *     out[outer][p][inner] = sum over t, q of  table_t[q][p] in_t[outer][q][inner]
 *
 * with all p in registers; `outer` are the directions to come, `inner` those that are done. */
#include "assemble/tensor.h"

#include "fe/fe.h"

/* What goes into a stage: up to four kinds t. */
typedef struct stage_input {
    int n;
    const double *table[4];
    const v8 *in[4];
} stage_input;

static void take(stage_input *s, const double *table, const v8 *in)
{
    if (in) {
        s->table[s->n] = table;
        s->in[s->n++] = in;
    }
}

/* place: where numbers of the last stage go in `out`; NULL: one after the other. */
static inline __attribute__((always_inline)) void stage_of(int np, const stage_input *s, int outer, int nq,
                                                           int inner, v8 *out, const int32_t *place)
{
    for (int o = 0; o < outer; o++)
        for (int x = 0; x < inner; x++) {
            v8 sum[TENSOR_PAIRS];

#pragma GCC unroll 9
            for (int p = 0; p < np; p++)
                sum[p] = (v8){0};
            for (int t = 0; t < s->n; t++) {
                const v8 *in = s->in[t] + o * nq * inner + x;
                const double *table = s->table[t];

                for (int q = 0; q < nq; q++, table += np) {
                    v8 v = in[q * inner];

#pragma GCC unroll 9
                    for (int p = 0; p < np; p++)
                        sum[p] += table[p] * v;
                }
            }
#pragma GCC unroll 9
            for (int p = 0; p < np; p++)
                out[place ? place[p * inner + x] : (o * np + p) * inner + x] = sum[p];
        }
}

static void stage(int np, const stage_input *s, int outer, int nq, int inner, v8 *out, const int32_t *place)
{
    switch (np) {
    case 1:
        stage_of(1, s, outer, nq, inner, out, place);
        break;
    case 2:
        stage_of(2, s, outer, nq, inner, out, place);
        break;
    case 3:
        stage_of(3, s, outer, nq, inner, out, place);
        break;
    case 4:
        stage_of(4, s, outer, nq, inner, out, place);
        break;
    case 5:
        stage_of(5, s, outer, nq, inner, out, place);
        break;
    case 6:
        stage_of(6, s, outer, nq, inner, out, place);
        break;
    default:
        stage_of(9, s, outer, nq, inner, out, place);
    }
}

static int power(int n, int exponent)
{
    int p = 1;

    for (int k = 0; k < exponent; k++)
        p *= n;
    return p;
}

void tensor_create(tensor_rule *r, int dim, int n, const double *x)
{
    double l[3][TENSOR_POINTS][2][TENSOR_NODES];

    r->dim = dim;
    r->n = n;
    for (int order = 0; order < 3; order++)
        for (int q = 0; q < n; q++) {
            fe_line_basis(order, x[q], l[order][q][0], l[order][q][1]);
            for (int d = 0; d < 2; d++)
                for (int i = 0; i <= order; i++) {
                    r->to_points[order][d][i * n + q] = l[order][q][d][i];
                    r->to_nodes[order][d][q * (order + 1) + i] = l[order][q][d][i];
                }
        }
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++)
            for (int t = 0; t < 4; t++)
                for (int q = 0; q < n; q++)
                    for (int i = 0; i <= a; i++)
                        for (int j = 0; j <= b; j++)
                            r->pair[a][b][t][(q * (a + 1) + i) * (b + 1) + j] =
                                l[a][q][t / 2][i] * l[b][q][t % 2][j];
}

/* The first stage of a matrix has at most 9 results of TENSOR_PAIRS n^(dim-1), the second 4 of TENSOR_PAIRS^2 n. */
size_t tensor_room(int dim, int n)
{
    size_t first = 9 * (size_t)(TENSOR_PAIRS * power(n, dim - 1));

    return first + (dim == 3 ? 4 * (size_t)(TENSOR_PAIRS * TENSOR_PAIRS * n) : 0);
}

void tensor_values(const tensor_rule *r, int order, const v8 *nodal, v8 *const out[TENSOR_KINDS], v8 *room)
{
    const double *value = r->to_points[order][0], *slope = r->to_points[order][1];
    int m = order + 1, nq = r->n, last = r->dim == 3, n = power(m, r->dim - 1) * nq, n2 = m * nq * nq;
    v8 *x[2] = {room, room + n}, *y[3] = {room + 2 * n, room + 2 * n + n2, room + 2 * n + 2 * n2};
    /* Kinds in the plane: value, d/dx, d/dy; the third direction makes d/dz of the value. */
    const int need[3] = {out[0] || (last && out[3]), out[1] != NULL, out[2] != NULL};
    const int from[3] = {0, 1, 0};

    for (int d = 0; d < 2; d++)
        if (d ? need[1] : need[0] || need[2])
            stage(nq, &(stage_input){1, {d ? slope : value}, {nodal}}, power(m, r->dim - 1), m, 1, x[d], NULL);
    for (int k = 0; k < 3; k++)
        if (need[k])
            stage(nq, &(stage_input){1, {k == 2 ? slope : value}, {x[from[k]]}}, last ? m : 1, m, nq,
                  last ? y[k] : out[k], NULL);
    for (int k = 0; last && k < 4; k++)
        if (out[k])
            stage(nq, &(stage_input){1, {k == 3 ? slope : value}, {y[k % 3]}}, 1, m, nq * nq, out[k], NULL);
}

void tensor_vector(const tensor_rule *r, int order, const v8 *const s[TENSOR_KINDS], const int *at, v8 *vec,
                   v8 *room)
{
    const double *value = r->to_nodes[order][0], *slope = r->to_nodes[order][1];
    int m = order + 1, nq = r->n, last = r->dim == 3, n = m * power(nq, r->dim - 1), n2 = m * m * nq;
    v8 *x[TENSOR_KINDS] = {NULL}, *y[TENSOR_KINDS] = {NULL};
    stage_input in;

    /* x[0]: value and d/dx, which go on alike */
    for (int k = 0; k <= r->dim; k++) {
        in.n = 0;
        take(&in, value, k == 1 ? NULL : s[k]);
        take(&in, slope, k == 0 ? s[1] : NULL);
        if (in.n) {
            x[k] = room + k * n;
            stage(m, &in, power(nq, r->dim - 1), nq, 1, x[k], NULL);
        }
    }
    for (int k = 0; k <= (last ? 3 : 0); k += 3) {
        in.n = 0;
        take(&in, value, x[k]);
        take(&in, slope, k == 0 ? x[2] : NULL);
        if (in.n && last) {
            y[k] = room + 4 * n + (k ? n2 : 0);
            stage(m, &in, nq, nq, m, y[k], NULL);
        } else if (in.n) {
            stage(m, &in, 1, nq, m, vec, at);
        }
    }
    in.n = 0;
    take(&in, value, y[0]);
    take(&in, slope, y[3]);
    if (in.n)
        stage(m, &in, 1, nq, m * m, vec, at);
}

/* Kind of the product of two basis functions, of kinds e and f, in a direction. */
static int product(int e, int f, int direction)
{
    return 2 * (e == direction + 1) + (f == direction + 1);
}

void tensor_matrix(const tensor_rule *r, int row_order, int column_order, const v8 *d[TENSOR_KINDS][TENSOR_KINDS],
                   const int32_t *place, v8 *mat, v8 *room)
{
    const double(*table)[TENSOR_POINTS * TENSOR_PAIRS] = r->pair[row_order][column_order];
    int np = (row_order + 1) * (column_order + 1), nq = r->n, last = r->dim == 3;
    stage_input first[4][4] = {{{0}}}, second[4] = {{0}}, third = {0};

    for (int e = 0; e <= r->dim; e++)
        for (int f = 0; f <= r->dim; f++)
            take(&first[last ? product(e, f, 2) : 0][product(e, f, 1)], table[product(e, f, 0)], d[e][f]);
    for (int z = 0; z < 4; z++) {
        for (int y = 0; y < 4; y++)
            if (first[z][y].n) {
                stage(np, &first[z][y], power(nq, r->dim - 1), nq, 1, room, NULL);
                take(&second[z], table[y], room);
                room += np * power(nq, r->dim - 1);
            }
        if (second[z].n && last) {
            stage(np, &second[z], nq, nq, np, room, NULL);
            take(&third, table[z], room);
            room += np * np * nq;
        }
    }
    stage(np, last ? &third : &second[0], 1, nq, power(np, r->dim - 1), mat, place);
}

int tensor_pairs(int dim, int row_order, int column_order, int k, int *i, int *j)
{
    int mr = row_order + 1, mc = column_order + 1, np = mr * mc, row = 1, column = 1;

    *i = *j = 0;
    for (int d = 0; d < dim; d++, k /= np, row *= mr, column *= mc) {
        *i += k % np / mc * row;
        *j += k % np % mc * column;
    }
    return power(np, dim);
}
