/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * kept.h -- memory of terms: values that no equation determines, but the term that keeps them.
 *
 * PF_AT_POINTS: values at the points of every cell's rule of degree 5, [cell][component][point].  At other points
 * of the cell they are those of a polynomial: on quads and hexes the product of parabolas through the points, on
 * simplices the parabola nearest to them.  PF_KEPT_BY_PARTICLE: [body][component]. */
#ifndef SPACE_KEPT_H
#define SPACE_KEPT_H

#include "base/arena.h"
#include "base/error.h"
#include "base/value.h"
#include "fe/fe.h"
#include "mesh/mesh.h"
#include "particle/particle.h"
#include "term/term.h"

enum { KEPT_DEGREE = 5, KEPT_MAX_POINTS = 27 };

typedef struct kept_fields {
    int n, n_body;
    const field_spec *field; /* [n] of the description              */
    const mesh *mesh;
    int64_t first[TERM_MAX_FIELDS], n_value; /* where each begins; length of all */
    fe_rule rule;                            /* points of a cell */
    double line[3];                          /* quads and hexes: the points in each direction */
    double *fit; /* simplices: coefficients of the monomials by values at the points, [monomial][point] */
} kept_fields;

int kept_find(const kept_fields *k, const char *name); /* index or -1 */
int kept_create(kept_fields *k, const field_list *fields, const mesh *m, int n_body, arena *memory, error *err);
/* Weights of the values at a cell's points, [rule.n], that add up to the value at xi. */
void kept_weights(const kept_fields *k, const double *xi, double *weight);
/* Where the values of a field in a cell, of a body begin. */
static inline int64_t kept_at(const kept_fields *k, int f, int64_t cell_or_body)
{
    return k->first[f] + cell_or_body * k->field[f].n_comp * (k->field[f].support == PF_AT_POINTS ? k->rule.n : 1);
}
/* Values at a point of a cell, [n_comp]. */
void kept_value(const kept_fields *k, int f, const double *kept, int64_t cell, const double *xi, double *v);
/* The polynomial that comes nearest to v[n_comp][n] at n points, of these weights, weight of values at a cell's
 * points there [n][rule.n]: at[n_comp][rule.n], its values at the cell's points, where it stays what it was before
 * as far as the n points leave it open. */
void kept_fit(const kept_fields *k, int n, const double *weights, const double *w, int n_comp, const double *v,
              double *at);
/* Values at the start, of fields that have some; of a body where it is. */
int kept_start(const kept_fields *k, const value *initial, const int *has, const pose *body, double t, double *kept,
               error *err);
/* The mean of a field over each cell, [n_cell][n_comp]. */
void kept_means(const kept_fields *k, int f, const double *kept, double *mean);

#endif
