/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The integrands of appendix A.2-A.6 and A.10-A.15, each as it is printed, and their sum over
 * cells and Gauss points.  In 2D w, g_z and all derivatives along z are zero. */
#include "printed_formulas.h"
#include "printed_shapes.h"

#include <stdlib.h>
#include <string.h>

/* What the integrands are made of at one point. */
typedef struct point {
    double phi[PRINTED_NODES], phi_x[PRINTED_NODES], phi_y[PRINTED_NODES], phi_z[PRINTED_NODES];
    double psi[PRINTED_NODES];
    double u, v, w, p, u_old, v_old, w_old;
    double u_x, u_y, u_z, v_x, v_y, v_z, w_x, w_y, w_z;
    double rho, mu, g_x, g_y, g_z, dt;
    double weight;
} point;

/* --- residuals --- */

/* A.2 */
static double R_C(const point *q, int i)
{
    return q->psi[i] * (q->u_x + q->v_y + q->w_z);
}

/* A.10 */
static double R_mx(const point *q, int i)
{
    return q->rho * q->phi[i] * ((q->u - q->u_old) / q->dt + q->u * q->u_x + q->v * q->u_y + q->w * q->u_z) +
           q->phi_x[i] * (-q->p + 2 * q->mu * q->u_x) + q->phi_y[i] * q->mu * (q->u_y + q->v_x) +
           q->phi_z[i] * q->mu * (q->w_x + q->u_z) - q->phi[i] * q->rho * q->g_x;
}

/* A.11 */
static double R_my(const point *q, int i)
{
    return q->rho * q->phi[i] * ((q->v - q->v_old) / q->dt + q->u * q->v_x + q->v * q->v_y + q->w * q->v_z) +
           q->phi_x[i] * q->mu * (q->u_y + q->v_x) + q->phi_y[i] * (-q->p + 2 * q->mu * q->v_y) +
           q->phi_z[i] * q->mu * (q->v_z + q->w_y) - q->phi[i] * q->rho * q->g_y;
}

/* A.12 */
static double R_mz(const point *q, int i)
{
    return q->rho * q->phi[i] * ((q->w - q->w_old) / q->dt + q->u * q->w_x + q->v * q->w_y + q->w * q->w_z) +
           q->phi_x[i] * q->mu * (q->w_x + q->u_z) + q->phi_y[i] * q->mu * (q->v_z + q->w_y) +
           q->phi_z[i] * (-q->p + 2 * q->mu * q->w_z) - q->phi[i] * q->rho * q->g_z;
}

/* --- A.3-A.6 --- */

static double dR_C_du(const point *q, int i, int j)
{
    return q->psi[i] * q->phi_x[j];
}

static double dR_C_dv(const point *q, int i, int j)
{
    return q->psi[i] * q->phi_y[j];
}

static double dR_C_dw(const point *q, int i, int j)
{
    return q->psi[i] * q->phi_z[j];
}

static double dR_C_dP(const point *q, int i, int j)
{
    (void)q, (void)i, (void)j;
    return 0;
}

/* --- A.13 --- */

static double dR_mx_du(const point *q, int i, int j)
{
    return q->rho * q->phi[i] * q->phi[j] / q->dt +
           q->rho * q->phi[i] *
               (q->phi[j] * q->u_x + q->u * q->phi_x[j] + q->v * q->phi_y[j] + q->w * q->phi_z[j]) +
           q->phi_x[i] * 2 * q->mu * q->phi_x[j] + q->phi_y[i] * q->mu * q->phi_y[j] +
           q->phi_z[i] * q->mu * q->phi_z[j];
}

static double dR_mx_dv(const point *q, int i, int j)
{
    return q->rho * q->phi[i] * q->phi[j] * q->u_y + q->phi_y[i] * q->mu * q->phi_x[j];
}

static double dR_mx_dw(const point *q, int i, int j)
{
    return q->rho * q->phi[i] * q->phi[j] * q->u_z + q->phi_z[i] * q->mu * q->phi_x[j];
}

static double dR_mx_dP(const point *q, int i, int j)
{
    return -q->phi_x[i] * q->psi[j];
}

/* --- A.14 --- */

static double dR_my_du(const point *q, int i, int j)
{
    return q->rho * q->phi[i] * q->phi[j] * q->v_x + q->phi_x[i] * q->mu * q->phi_y[j];
}

static double dR_my_dv(const point *q, int i, int j)
{
    return q->rho * q->phi[i] * q->phi[j] / q->dt +
           q->rho * q->phi[i] *
               (q->phi[j] * q->v_y + q->u * q->phi_x[j] + q->v * q->phi_y[j] + q->w * q->phi_z[j]) +
           q->phi_x[i] * q->mu * q->phi_x[j] + q->phi_y[i] * 2 * q->mu * q->phi_y[j] +
           q->phi_z[i] * q->mu * q->phi_z[j];
}

static double dR_my_dw(const point *q, int i, int j)
{
    return q->rho * q->phi[i] * q->phi[j] * q->v_z + q->phi_z[i] * q->mu * q->phi_y[j];
}

static double dR_my_dP(const point *q, int i, int j)
{
    return -q->phi_y[i] * q->psi[j];
}

/* --- A.15 --- */

static double dR_mz_du(const point *q, int i, int j)
{
    return q->rho * q->phi[i] * q->phi[j] * q->w_x + q->phi_x[i] * q->mu * q->phi_z[j];
}

static double dR_mz_dv(const point *q, int i, int j)
{
    return q->rho * q->phi[i] * q->phi[j] * q->w_y + q->phi_y[i] * q->mu * q->phi_z[j];
}

static double dR_mz_dw(const point *q, int i, int j)
{
    return q->rho * q->phi[i] * q->phi[j] / q->dt +
           q->rho * q->phi[i] *
               (q->phi[j] * q->w_z + q->u * q->phi_x[j] + q->v * q->phi_y[j] + q->w * q->phi_z[j]) +
           q->phi_x[i] * q->mu * q->phi_x[j] + q->phi_y[i] * q->mu * q->phi_y[j] +
           q->phi_z[i] * 2 * q->mu * q->phi_z[j];
}

static double dR_mz_dP(const point *q, int i, int j)
{
    return -q->phi_z[i] * q->psi[j];
}

/* --- tables: row, column --- */

static double (*const residual[PRINTED_COMPONENTS])(const point *, int) = {R_mx, R_my, R_mz, R_C};

static double (*const entry[PRINTED_COMPONENTS][PRINTED_COMPONENTS])(const point *, int, int) = {
    {dR_mx_du, dR_mx_dv, dR_mx_dw, dR_mx_dP},
    {dR_my_du, dR_my_dv, dR_my_dw, dR_my_dP},
    {dR_mz_du, dR_mz_dv, dR_mz_dw, dR_mz_dP},
    {dR_C_du, dR_C_dv, dR_C_dw, dR_C_dP},
};

const char *const printed_row_name[PRINTED_COMPONENTS] = {"R_mx", "R_my", "R_mz", "R_C"};

const char *const printed_entry_name[PRINTED_COMPONENTS][PRINTED_COMPONENTS] = {
    {"dR_mx/du", "dR_mx/dv", "dR_mx/dw", "dR_mx/dP"},
    {"dR_my/du", "dR_my/dv", "dR_my/dw", "dR_my/dP"},
    {"dR_mz/du", "dR_mz/dv", "dR_mz/dw", "dR_mz/dP"},
    {"dR_C/du", "dR_C/dv", "dR_C/dw", "dR_C/dP"},
};

/* --- the sum over cells and points --- */

static void cross(const double *a, const double *b, double *c)
{
    for (int k = 0; k < 3; k++)
        c[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

/* phi, psi and derivatives in space at point k of the cell with these nodes.  With t_b = dx/ds_b,
 * det = t_0 . (t_1 x t_2) and grad s_0 = t_1 x t_2 / det, cyclically; in 2D t_2 = e_z. */
static void place(const printed_cell *c, const mesh *m, const int32_t *node, int k, point *q)
{
    double dphi[PRINTED_NODES][3], t[3][3] = {{0}}, grad_s[3][3], det;

    printed_phi(c, c->s[k], q->phi, dphi);
    printed_psi(c, c->s[k], q->psi);
    for (int i = 0; i < c->n_phi; i++)
        for (int b = 0; b < c->dim; b++)
            for (int a = 0; a < c->dim; a++)
                t[b][a] += dphi[i][b] * m->x[(int64_t)node[i] * m->dim + a];
    if (c->dim == 2)
        t[2][2] = 1;
    for (int b = 0; b < 3; b++)
        cross(t[(b + 1) % 3], t[(b + 2) % 3], grad_s[b]);
    det = t[0][0] * grad_s[0][0] + t[0][1] * grad_s[0][1] + t[0][2] * grad_s[0][2];
    for (int i = 0; i < c->n_phi; i++) {
        const double *d = dphi[i];

        q->phi_x[i] = (d[0] * grad_s[0][0] + d[1] * grad_s[1][0] + d[2] * grad_s[2][0]) / det;
        q->phi_y[i] = (d[0] * grad_s[0][1] + d[1] * grad_s[1][1] + d[2] * grad_s[2][1]) / det;
        q->phi_z[i] = (d[0] * grad_s[0][2] + d[1] * grad_s[1][2] + d[2] * grad_s[2][2]) / det;
    }
    q->weight = c->weight[k] * det;
}

/* Sum of shape[i] values[node[i]]. */
static double at(int n, const double *shape, const double *values, const int32_t *node)
{
    double sum = 0;

    for (int i = 0; i < n; i++)
        sum += shape[i] * values[node[i]];
    return sum;
}

static void interpolate(const printed_cell *c, const printed_state *s, const int32_t *node, point *q)
{
    const double *u = s->now[PRINTED_U], *v = s->now[PRINTED_V], *w = s->now[PRINTED_W];
    int n = c->n_phi;

    q->u = at(n, q->phi, u, node);
    q->u_x = at(n, q->phi_x, u, node);
    q->u_y = at(n, q->phi_y, u, node);
    q->u_z = at(n, q->phi_z, u, node);
    q->v = at(n, q->phi, v, node);
    q->v_x = at(n, q->phi_x, v, node);
    q->v_y = at(n, q->phi_y, v, node);
    q->v_z = at(n, q->phi_z, v, node);
    q->u_old = at(n, q->phi, s->old[PRINTED_U], node);
    q->v_old = at(n, q->phi, s->old[PRINTED_V], node);
    q->w = q->w_x = q->w_y = q->w_z = q->w_old = 0;
    if (c->dim == 3) {
        q->w = at(n, q->phi, w, node);
        q->w_x = at(n, q->phi_x, w, node);
        q->w_y = at(n, q->phi_y, w, node);
        q->w_z = at(n, q->phi_z, w, node);
        q->w_old = at(n, q->phi, s->old[PRINTED_W], node);
    }
    q->p = 0;
    for (int i = 0; i < c->n_psi; i++)
        q->p += q->psi[i] * s->now[PRINTED_P][node[c->psi_node[i]]];
}

/* Node of shape function i of a component. */
static int32_t node_of(const printed_cell *c, const int32_t *node, int component, int i)
{
    return node[component == PRINTED_P ? c->psi_node[i] : i];
}

static int count(const printed_cell *c, int component)
{
    return component == PRINTED_P ? c->n_psi : component < c->dim ? c->n_phi : 0;
}

static void add_point(const printed_cell *c, const int32_t *node, const point *q, printed_blocks *b)
{
    for (int row = 0; row < PRINTED_COMPONENTS; row++)
        for (int i = 0; i < count(c, row); i++) {
            int64_t at_row = node_of(c, node, row, i);

            b->r[row][at_row] += q->weight * residual[row](q, i);
            for (int col = 0; col < PRINTED_COMPONENTS; col++)
                for (int j = 0; j < count(c, col); j++)
                    b->j[row][col][at_row * b->n + node_of(c, node, col, j)] +=
                        q->weight * entry[row][col](q, i, j);
        }
}

void printed_assemble(const mesh *m, const printed_fluid *f, const printed_state *s, printed_blocks *b)
{
    point q = {.rho = f->rho, .mu = f->mu, .g_x = f->g[0], .g_y = f->g[1], .g_z = f->g[2], .dt = f->dt};
    printed_cell c;

    printed_cell_make(m->dim, m->type->simplex, &c);
    for (int64_t e = 0; e < m->n_cell; e++)
        for (int k = 0; k < c.n_point; k++) {
            const int32_t *node = m->cell + e * c.n_phi;

            place(&c, m, node, k, &q);
            interpolate(&c, s, node, &q);
            add_point(&c, node, &q, b);
        }
}

int printed_blocks_create(printed_blocks *b, int64_t n)
{
    int failed = 0;

    memset(b, 0, sizeof *b);
    b->n = n;
    for (int row = 0; row < PRINTED_COMPONENTS; row++) {
        failed |= !(b->r[row] = calloc((size_t)n, sizeof(double)));
        for (int col = 0; col < PRINTED_COMPONENTS; col++)
            failed |= !(b->j[row][col] = calloc((size_t)(n * n), sizeof(double)));
    }
    if (failed)
        printed_blocks_destroy(b);
    return failed ? -1 : 0;
}

void printed_blocks_destroy(printed_blocks *b)
{
    for (int row = 0; row < PRINTED_COMPONENTS; row++) {
        free(b->r[row]);
        for (int col = 0; col < PRINTED_COMPONENTS; col++)
            free(b->j[row][col]);
    }
    memset(b, 0, sizeof *b);
}
