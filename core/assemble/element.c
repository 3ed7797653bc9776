/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Element vectors and matrices of 8 cells at a time.
 *
 *     r_i^a    = sum_q w sum_e B_i^e s^{a e}               e = value, d/dx, d/dy, d/dz
 *     K_ij^ab  = sum_q w sum_e B_i^e sum_f D^{a e, b f} B_j^f       f may be the Laplacian too
 *
 * Entries of D that vanish at all points (most of them do in Navier-Stokes) are found and
 * skipped.  The inner loop keeps a 3 x 3 tile of K in registers. */
#include "assemble/assemble.h"

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
    int dim = a->space->mesh->dim, nq = c->n_q, n = c->n_basis[f->order];

    memset(w->vec, 0, (size_t)(f->n_comp * n) * sizeof *w->vec);
    for (int grad = 0; grad < 2; grad++) {
        int t = find_basis(c->test, c->n_test, field, grad ? BASIS_GRAD : BASIS_VALUE);

        for (int e = 0; t >= 0 && e < f->n_comp * (grad ? dim : 1); e++) {
            const v8 *restrict s = w->test + (c->test[t].at + (size_t)e) * (size_t)nq;
            const v8 *basis = w->basis[f->order][grad ? 1 + e % dim : 0];
            v8 *r = w->vec + (grad ? e / dim : e) * n;

            for (int i = 0; i < n; i++) {
                const v8 *restrict b = basis + i * nq;
                v8 sum = {0};

                for (int q = 0; q < nq; q++)
                    sum += w->w[q] * b[q] * s[q];
                r[i] += sum;
            }
        }
    }
}

static int all_zero(const v8 *d, int n)
{
    const double *x = (const double *)d;
    int any = 0;

    for (int i = 0; i < n * 8; i++)
        any |= x[i] != 0;
    return !any;
}

/* Test functions of one field and trial functions of another, by kind; -1: not used. */
typedef struct basis_pair {
    int test[BASIS_GRAD + 1], trial[BASIS_LAPLACE + 1];
} basis_pair;

/* Non-zero entries of D between component a of the rows and b of the columns: d[e][f]. */
static int coefficients(const assembly_class *c, const basis_pair *p, int a, int b, int dim, const workspace *w,
                        const v8 *d[TEST_ROWS][BASIS_ROWS])
{
    static const int first_row[] = {0, 1, LAPLACE_ROW};
    int any = 0;

    memset(d, 0, TEST_ROWS * sizeof d[0]);
    for (enum basis_kind ge = BASIS_VALUE; ge <= BASIS_GRAD; ge++)
        for (enum basis_kind gf = BASIS_VALUE; gf <= BASIS_LAPLACE; gf++) {
            int t = p->test[ge], r = p->trial[gf];

            if (t < 0 || r < 0 || c->block[t][r] == SIZE_MAX)
                continue;
            for (int e = 0; e < (ge ? dim : 1); e++)
                for (int f = 0; f < (gf == BASIS_GRAD ? dim : 1); f++) {
                    int row = ge ? a * dim + e : a, col = gf == BASIS_GRAD ? b * dim + f : b;
                    const v8 *at =
                        w->block + (c->block[t][r] + (size_t)(row * c->trial[r].n_comp + col)) * (size_t)c->n_q;

                    if (all_zero(at, c->n_q))
                        continue;
                    d[first_row[ge] + e][first_row[gf] + f] = at;
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

/* A 3 x 3 tile of K: sum_e sum_q B_i^e g_j^e. */
static void tile(const int *row_used, v8 *const *basis, int i0, int nq, int dim, const v8 *g, v8 *k, int n_col)
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
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            k[i * n_col + j] = s[i][j];
}

int element_matrix(const assembly *as, const assembly_class *c, int row_field, int col_field, workspace *w)
{
    const space *s = as->space;
    const field_spec *rf = &s->field[row_field], *cf = &s->field[col_field];
    int dim = s->mesh->dim, nq = c->n_q, coupled = 0;
    int n_row = assemble_padded(c->n_basis[rf->order]);
    int n_col = assemble_padded(c->n_basis[cf->order]);
    basis_pair p;

    for (enum basis_kind e = BASIS_VALUE; e <= BASIS_GRAD; e++)
        p.test[e] = find_basis(c->test, c->n_test, row_field, e);
    for (enum basis_kind e = BASIS_VALUE; e <= BASIS_LAPLACE; e++)
        p.trial[e] = find_basis(c->trial, c->n_trial, col_field, e);
    for (int a = 0; a < rf->n_comp; a++)
        for (int b = 0; b < cf->n_comp; b++) {
            v8 *k = w->mat + (a * cf->n_comp + b) * n_row * n_col;
            const v8 *d[TEST_ROWS][BASIS_ROWS];
            int row_used[TEST_ROWS];

            if (!coefficients(c, &p, a, b, dim, w, d)) {
                memset(k, 0, (size_t)(n_row * n_col) * sizeof *k);
                continue;
            }
            coupled = 1;
            for (int e = 0; e < TEST_ROWS; e++) {
                row_used[e] = 0;
                for (int f = 0; f < BASIS_ROWS; f++)
                    row_used[e] |= d[e][f] != NULL;
            }
            for (int j = 0; j < n_col; j += 3) {
                strip(d, w->basis[cf->order], j, nq, dim, w->w, w->g);
                for (int i = 0; i < n_row; i += 3)
                    tile(row_used, w->basis[rf->order], i, nq, dim, w->g, k + i * n_col + j, n_col);
            }
        }
    return coupled;
}
