/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Element vectors and matrices of 8 cells at a time.
 *
 *     r_i^a    = sum_q w sum_e B_i^e s^{a e}               e = value, d/dx, d/dy, d/dz
 *     K_ij^ab  = sum_q w sum_e B_i^e sum_f D^{a e, b f} B_j^f       f may be the Laplacian too
 *
 * Entries of D that no term filled (most of them in Navier-Stokes) are skipped.  The inner loop keeps a 3 x 3 tile
 * of K in registers. */
#include "assemble/batch.h"

#include <string.h>

static int find_basis(const plan_basis *list, int n, int field, enum basis_kind kind)
{
    for (int i = 0; i < n; i++)
        if (list[i].field == field && list[i].kind == kind)
            return i;
    return -1;
}

void element_vector(const assembly *a, const assembly_class *c, int field, workspace *w)
{
    const field_spec *f = &a->space->field[field];
    const int *at = c->layout.at[field];
    int dim = a->space->mesh->dim, nq = c->n_q, n = c->n_basis[f->order];

    if (c->tensor) {
        int value = find_basis(c->test, c->n_test, field, BASIS_VALUE);
        int grad = find_basis(c->test, c->n_test, field, BASIS_GRAD);

        element_vector_tensor(c, field, f, value < 0 ? NULL : w->test + c->test[value].at * (size_t)nq,
                              grad < 0 ? NULL : w->test + c->test[grad].at * (size_t)nq, w);
        return;
    }
    for (enum basis_kind kind = BASIS_VALUE; kind < BASIS_KINDS; kind++) {
        int t = find_basis(c->test, c->n_test, field, kind), grad = kind == BASIS_GRAD;

        for (int e = 0; t >= 0 && e < f->n_comp * (grad ? dim : 1); e++) {
            const v8 *restrict s = w->test + (c->test[t].at + (size_t)e) * (size_t)nq;
            const v8 *basis = w->basis[f->order][assemble_row(kind) + (grad ? e % dim : 0)];

            for (int i = 0; i < n; i++) {
                const v8 *restrict b = basis + i * nq;
                v8 sum = {0};

                for (int q = 0; q < nq; q++)
                    sum += w->w[q] * b[q] * s[q];
                w->vec[at[i] + (grad ? e / dim : e)] += sum;
            }
        }
    }
}

/* Test functions of one field and trial functions of another, by kind; -1: not used. */
typedef struct basis_pair {
    int test[BASIS_KINDS], trial[BASIS_KINDS];
} basis_pair;

/* Non-zero entries of D between component a of the rows and b of the columns: d[e][f]. */
static int coefficients(const assembly_class *c, const basis_pair *p, int a, int b, int dim, const workspace *w,
                        const v8 *d[TEST_ROWS][BASIS_ROWS])
{
    int any = 0;

    memset(d, 0, TEST_ROWS * sizeof d[0]);
    for (enum basis_kind ge = BASIS_VALUE; ge < BASIS_KINDS; ge++)
        for (enum basis_kind gf = BASIS_VALUE; p->test[ge] >= 0 && gf < BASIS_KINDS; gf++) {
            int t = p->test[ge], r = p->trial[gf];

            if (r < 0 || c->block[t][r] == SIZE_MAX)
                continue;
            for (int e = 0; e < (ge == BASIS_GRAD ? dim : 1); e++)
                for (int f = 0; f < (gf == BASIS_GRAD ? dim : 1); f++) {
                    int row = ge == BASIS_GRAD ? a * dim + e : a, col = gf == BASIS_GRAD ? b * dim + f : b;
                    size_t entry = c->block[t][r] + (size_t)(row * c->trial[r].n_comp + col);

                    if (!w->filled[entry])
                        continue;
                    d[assemble_row(ge) + e][assemble_row(gf) + f] = w->block + entry * (size_t)c->n_q;
                    any = 1;
                }
        }
    return any;
}

/* g[e][j][q] = w sum_f D^{e f} B_j^f for three columns j. */
static void strip(const v8 *d[TEST_ROWS][BASIS_ROWS], v8 *const *basis, int j0, int nq, int dim, const v8 *w, v8 *g)
{
    for (int e = 0; e <= dim; e++) {
        int used[BASIS_ROWS], n = 0;

        for (int f = 0; f < BASIS_ROWS; f++)
            if (d[e][f])
                used[n++] = f;
        for (int j = 0; j < 3; j++) {
            v8 *restrict to = g + (e * 3 + j) * nq;

            for (int k = 0; k < n; k++) {
                const v8 *restrict de = d[e][used[k]], *restrict b = basis[used[k]] + (j0 + j) * nq;

                for (int q = 0; q < nq; q++)
                    to[q] = k == 0 ? w[q] * de[q] * b[q] : to[q] + w[q] * de[q] * b[q];
            }
        }
    }
}

/* Where a block of K goes: entry (i, j) to k[row[i] + column[j]]. */
typedef struct block_place {
    v8 *k;
    int n_row, n_col, width;
    const int *row, *column;
} block_place;

/* A 3 x 3 tile of K: sum_e sum_q B_i^e g_j^e. */
static void tile(const int *row_used, v8 *const *basis, int i0, int j0, int nq, int dim, const v8 *g,
                 const block_place *to)
{
    v8 s[3][3] = {{{0}}};

    for (int e = 0; e <= dim; e++) {
        const v8 *restrict b = basis[e] + i0 * nq, *restrict h = g + e * 3 * nq;

        if (!row_used[e])
            continue;
        for (int q = 0; q < nq; q++) {
            v8 b0 = b[q], b1 = b[nq + q], b2 = b[2 * nq + q];
            v8 g0 = h[q], g1 = h[nq + q], g2 = h[2 * nq + q];

            s[0][0] += b0 * g0, s[0][1] += b0 * g1, s[0][2] += b0 * g2;
            s[1][0] += b1 * g0, s[1][1] += b1 * g1, s[1][2] += b1 * g2;
            s[2][0] += b2 * g0, s[2][1] += b2 * g1, s[2][2] += b2 * g2;
        }
    }
    for (int i = 0; i < 3 && i0 + i < to->n_row; i++)
        for (int j = 0; j < 3 && j0 + j < to->n_col; j++)
            to->k[to->row[i0 + i] * to->width + to->column[j0 + j]] = s[i][j];
}

static void clear_block(const block_place *to)
{
    for (int i = 0; i < to->n_row; i++)
        for (int j = 0; j < to->n_col; j++)
            to->k[to->row[i] * to->width + to->column[j]] = (v8){0};
}

static void block_by_tiles(const v8 *d[TEST_ROWS][BASIS_ROWS], const field_spec *rf, const field_spec *cf, int dim,
                           int nq, const block_place *to, workspace *w)
{
    int row_used[TEST_ROWS];

    for (int e = 0; e < TEST_ROWS; e++) {
        row_used[e] = 0;
        for (int f = 0; f < BASIS_ROWS; f++)
            row_used[e] |= d[e][f] != NULL;
    }
    for (int j = 0; j < to->n_col; j += 3) {
        strip(d, w->basis[cf->order], j, nq, dim, w->w, w->g);
        for (int i = 0; i < to->n_row; i += 3)
            tile(row_used, w->basis[rf->order], i, j, nq, dim, w->g, to);
    }
}

static void field_block(const assembly *as, const assembly_class *c, int row_field, int col_field, workspace *w)
{
    const field_spec *rf = &as->space->field[row_field], *cf = &as->space->field[col_field];
    const element_layout *p = &c->layout;
    int dim = as->space->mesh->dim;
    basis_pair pair;

    for (enum basis_kind e = BASIS_VALUE; e < BASIS_KINDS; e++) {
        pair.test[e] = find_basis(c->test, c->n_test, row_field, e);
        pair.trial[e] = find_basis(c->trial, c->n_trial, col_field, e);
    }
    for (int a = 0; a < rf->n_comp; a++)
        for (int b = 0; b < cf->n_comp; b++) {
            const v8 *d[TEST_ROWS][BASIS_ROWS];
            block_place to = {.k = w->mat + a * p->width + b,
                              .n_row = c->n_basis[rf->order],
                              .n_col = c->n_basis[cf->order],
                              .width = p->width,
                              .row = p->at[row_field],
                              .column = p->at[col_field]};

            if (!coefficients(c, &pair, a, b, dim, w, d))
                clear_block(&to);
            else if (c->tensor)
                element_matrix_tensor(c, rf->order, cf->order, d, c->place[row_field][col_field], to.k, w);
            else
                block_by_tiles(d, rf, cf, dim, c->n_q, &to, w);
        }
}

void element_matrix(const assembly *a, const assembly_class *c, int field, workspace *w)
{
    for (int g = 0; g < a->space->n_field; g++)
        if (c->layout.coupled[field] >> g & 1)
            field_block(a, c, field, g, w);
}
