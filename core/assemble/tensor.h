/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * tensor.h -- sum factorisation: on quads and hexes bases and points are products of those on a line, and sums over
 * points are done one direction after the other.
 *
 * Of a basis function the kinds 0..3 are its value and its derivatives by reference coordinate; arrays over nodes
 * and points have the first direction fastest. */
#ifndef ASSEMBLE_TENSOR_H
#define ASSEMBLE_TENSOR_H

#include "base/error.h"

#include <stddef.h>
#include <stdint.h>

typedef double v8 __attribute__((vector_size(64)));

enum { TENSOR_KINDS = 4, TENSOR_POINTS = 5, TENSOR_NODES = 3, TENSOR_PAIRS = TENSOR_NODES * TENSOR_NODES };

/* Bases of order 0, 1, 2 at the points of a line, and the products of two of them.  [d]: value, derivative; of a
 * product [2 d_i + d_j]. */
typedef struct tensor_rule {
    int dim, n;                                           /* points a direction */
    double to_points[3][2][TENSOR_NODES * TENSOR_POINTS]; /* [i * n + q]                    */
    double to_nodes[3][2][TENSOR_POINTS * TENSOR_NODES];  /* [q * nodes + i]                */
    double pair[3][3][4][TENSOR_POINTS * TENSOR_PAIRS];   /* [q * pairs + i * nodes_j + j]  */
} tensor_rule;

/* v8 numbers of room that the functions below need. */
size_t tensor_room(int dim, int n);
void tensor_create(tensor_rule *r, int dim, int n, const double *x);

/* A field from its nodal values: value and reference derivatives at the points, those with out[kind] not NULL. */
void tensor_values(const tensor_rule *r, int order, const v8 *nodal, v8 *const out[TENSOR_KINDS], v8 *room);

/* sum_q sum_e B_i^e s^e for all nodes i, to vec[at[i]]; s[kind] NULL: none, but not all of
 * them. */
void tensor_vector(const tensor_rule *r, int order, const v8 *const s[TENSOR_KINDS], const int *at, v8 *vec,
                   v8 *room);

/* sum_q sum_ef B_i^e d^ef B_j^f for all pairs of nodes, to mat[place[k]] with k in the order of tensor_pairs;
 * d[e][f] NULL: none. */
void tensor_matrix(const tensor_rule *r, int row_order, int column_order, const v8 *d[TENSOR_KINDS][TENSOR_KINDS],
                   const int32_t *place, v8 *mat, v8 *room);

/* Pair k of tensor_matrix: nodes i and j.  Returns how many there are. */
int tensor_pairs(int dim, int row_order, int column_order, int k, int *i, int *j);

#endif
