/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The sum of the printed integrands (printed_bodies_equations.h) over points of Omega, Omega_f and Omega_P. */
#include "printed_bodies.h"
#include "printed_bodies_equations.h"
#include "printed_shapes.h"

#include <stdlib.h>
#include <string.h>

const char *const bodies_row_name[BODIES_COMPONENTS] = {"R_Mx",       "R_My",       "R_Mz",     "R_C", "R_lambda_x",
                                                        "R_lambda_y", "R_lambda_z", "R_u",      "R_v", "R_w",
                                                        "R_omega_x",  "R_omega_y",  "R_omega_z"};

const char *const bodies_col_name[BODIES_COMPONENTS] = {
    "u", "v", "w", "P", "lambda_x", "lambda_y", "lambda_z", "u_P", "v_P", "w_P", "omega_x", "omega_y", "omega_z"};

int bodies_component(int dim, int component)
{
    return dim == 3 || !(component == BODIES_W || component == BODIES_LZ || component == BODIES_WP ||
                         component == BODIES_OX || component == BODIES_OY);
}

int bodies_entry(int row, int col)
{
    int printed = 0;

    for (int d = 0; d < BODIES_DOMAINS; d++)
        printed |= entry[d][row][col] != NULL;
    return printed;
}

/* --- one point --- */

/* Derivatives of psi in reference coordinates: products of (1 + s_k) / 2 and (1 - s_k) / 2, or L_i. */
static void slopes_of_psi(const printed_cell *c, const double *s, double (*dpsi)[3])
{
    memset(dpsi, 0, (size_t)c->n_psi * sizeof *dpsi);
    for (int i = 0; i < c->n_psi; i++)
        for (int k = 0; k < c->dim; k++) {
            dpsi[i][k] = c->simplex ? (i == 0 ? -1 : i == k + 1) : (i >> k & 1 ? 0.5 : -0.5);
            for (int other = 0; !c->simplex && other < c->dim; other++)
                if (other != k)
                    dpsi[i][k] *= (1 + (i >> other & 1 ? s[other] : -s[other])) / 2;
        }
}

static void cross(const double *a, const double *b, double *c)
{
    for (int k = 0; k < 3; k++)
        c[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

/* Derivatives in space from those in reference coordinates. */
static void in_space(int n, double (*d)[3], double (*grad_s)[3], double det, double *x, double *y, double *z)
{
    for (int i = 0; i < n; i++) {
        x[i] = (d[i][0] * grad_s[0][0] + d[i][1] * grad_s[1][0] + d[i][2] * grad_s[2][0]) / det;
        y[i] = (d[i][0] * grad_s[0][1] + d[i][1] * grad_s[1][1] + d[i][2] * grad_s[2][1]) / det;
        z[i] = (d[i][0] * grad_s[0][2] + d[i][1] * grad_s[1][2] + d[i][2] * grad_s[2][2]) / det;
    }
}

/* Place, phi, psi and derivatives in space at s in the cell with these nodes.  With t_b = dx/ds_b,
 * det = t_0 . (t_1 x t_2) and grad s_0 = t_1 x t_2 / det, cyclically; in 2D t_2 = e_z. */
static void place(const printed_cell *c, const mesh *m, const int32_t *node, const double *s, double weight,
                  point *q)
{
    double dphi[PRINTED_NODES][3], dpsi[8][3], x[3] = {0}, t[3][3] = {{0}}, grad_s[3][3], det;

    printed_phi(c, s, q->phi, dphi);
    printed_psi(c, s, q->psi);
    slopes_of_psi(c, s, dpsi);
    for (int i = 0; i < c->n_phi; i++)
        for (int a = 0; a < c->dim; a++) {
            double at = m->x[(int64_t)node[i] * m->dim + a];

            x[a] += q->phi[i] * at;
            for (int b = 0; b < c->dim; b++)
                t[b][a] += dphi[i][b] * at;
        }
    if (c->dim == 2)
        t[2][2] = 1;
    for (int b = 0; b < 3; b++)
        cross(t[(b + 1) % 3], t[(b + 2) % 3], grad_s[b]);
    det = t[0][0] * grad_s[0][0] + t[0][1] * grad_s[0][1] + t[0][2] * grad_s[0][2];
    in_space(c->n_phi, dphi, grad_s, det, q->phi_x, q->phi_y, q->phi_z);
    in_space(c->n_psi, dpsi, grad_s, det, q->psi_x, q->psi_y, q->psi_z);
    q->x = x[0];
    q->y = x[1];
    q->z = x[2];
    q->weight = weight * det;
}

/* Node of shape function i of a component, or the body. */
static int64_t slot_of(const printed_cell *c, const int32_t *node, int64_t body, int component, int i)
{
    return component >= BODIES_UP ? body : node[component == BODIES_P ? c->psi_node[i] : i];
}

static int count(const printed_cell *c, int component)
{
    return !bodies_component(c->dim, component) ? 0
           : component >= BODIES_UP             ? 1
           : component == BODIES_P              ? c->n_psi
                                                : c->n_phi;
}

/* A component of the state with its derivatives (unless NULL); zero where there is none. */
static void interpolate(const printed_cell *c, const double *const *values, int component, const int32_t *node,
                        const point *q, double *value, double *x, double *y, double *z)
{
    int p = component == BODIES_P;

    *value = 0;
    if (x)
        *x = *y = *z = 0;
    for (int i = 0; i < count(c, component); i++) {
        double at = values[component][slot_of(c, node, -1, component, i)];

        *value += (p ? q->psi : q->phi)[i] * at;
        if (x) {
            *x += (p ? q->psi_x : q->phi_x)[i] * at;
            *y += (p ? q->psi_y : q->phi_y)[i] * at;
            *z += (p ? q->psi_z : q->phi_z)[i] * at;
        }
    }
}

static void flow_at(const printed_cell *c, const bodies_state *s, const int32_t *node, point *q)
{
    const double *const *now = s->now, *const *old = s->old;

    interpolate(c, now, BODIES_U, node, q, &q->u, &q->u_x, &q->u_y, &q->u_z);
    interpolate(c, now, BODIES_V, node, q, &q->v, &q->v_x, &q->v_y, &q->v_z);
    interpolate(c, now, BODIES_W, node, q, &q->w, &q->w_x, &q->w_y, &q->w_z);
    interpolate(c, now, BODIES_P, node, q, &q->p, &q->p_x, &q->p_y, &q->p_z);
    interpolate(c, now, BODIES_LX, node, q, &q->lx, &q->lx_x, &q->lx_y, &q->lx_z);
    interpolate(c, now, BODIES_LY, node, q, &q->ly, &q->ly_x, &q->ly_y, &q->ly_z);
    interpolate(c, now, BODIES_LZ, node, q, &q->lz, &q->lz_x, &q->lz_y, &q->lz_z);
    interpolate(c, old, BODIES_U, node, q, &q->u_old, NULL, NULL, NULL);
    interpolate(c, old, BODIES_V, node, q, &q->v_old, NULL, NULL, NULL);
    interpolate(c, old, BODIES_W, node, q, &q->w_old, NULL, NULL, NULL);
}

static void body_at(int dim, const bodies_data *d, const bodies_state *s, int64_t k, point *q)
{
    const bodies_body *b = &d->body[k];

    q->rho_P = b->rho;
    q->x_P = b->x[0];
    q->y_P = b->x[1];
    q->u_P = s->now[BODIES_UP][k];
    q->v_P = s->now[BODIES_VP][k];
    q->u_P_old = s->old[BODIES_UP][k];
    q->v_P_old = s->old[BODIES_VP][k];
    q->omega_z = s->now[BODIES_OZ][k];
    if (dim == 3) {
        q->z_P = b->x[2];
        q->w_P = s->now[BODIES_WP][k];
        q->w_P_old = s->old[BODIES_WP][k];
        q->omega_x = s->now[BODIES_OX][k];
        q->omega_y = s->now[BODIES_OY][k];
    }
}

/* --- sums --- */

static void add_point(const printed_cell *c, const int32_t *node, const bodies_part *part, const point *q,
                      bodies_blocks *b)
{
    for (int row = 0; row < BODIES_COMPONENTS; row++)
        for (int i = 0; residual[part->domain][row] && i < count(c, row); i++) {
            int64_t at_row = slot_of(c, node, part->body, row, i);

            b->r[row][at_row] += q->weight * residual[part->domain][row](q, i);
            for (int col = 0; col < BODIES_COMPONENTS; col++)
                for (int j = 0; entry[part->domain][row][col] && j < count(c, col); j++)
                    b->j[row][col][at_row * b->n[col] + slot_of(c, node, part->body, col, j)] +=
                        q->weight * entry[part->domain][row][col](q, i, j);
        }
}

void bodies_add(const mesh *m, const bodies_data *d, const bodies_state *s, const bodies_part *part,
                bodies_blocks *b)
{
    const printed_fluid *f = d->fluid;
    point q = {.rho = f->rho, .mu = f->mu, .alpha = d->alpha, .dt = f->dt};
    printed_cell c;
    const int32_t *node;

    printed_cell_make(m->dim, m->type->simplex, &c);
    node = m->cell + part->cell * c.n_phi;
    q.g_x = f->g[0];
    q.g_y = f->g[1];
    q.g_z = f->g[2];
    if (part->domain == BODIES_OMEGA_P)
        body_at(m->dim, d, s, part->body, &q);
    for (int k = 0; k < part->n; k++) {
        place(&c, m, node, part->s[k], part->weight[k], &q);
        flow_at(&c, s, node, &q);
        add_point(&c, node, part, &q, b);
    }
}

int bodies_blocks_create(bodies_blocks *b, int64_t n_node, int64_t n_body)
{
    int failed = 0;

    memset(b, 0, sizeof *b);
    for (int row = 0; row < BODIES_COMPONENTS; row++)
        b->n[row] = row < BODIES_UP ? n_node : n_body;
    for (int row = 0; row < BODIES_COMPONENTS; row++) {
        failed |= !(b->r[row] = calloc((size_t)b->n[row], sizeof(double)));
        for (int col = 0; col < BODIES_COMPONENTS; col++)
            failed |= !(b->j[row][col] = calloc((size_t)(b->n[row] * b->n[col]), sizeof(double)));
    }
    if (failed)
        bodies_blocks_destroy(b);
    return failed ? -1 : 0;
}

void bodies_blocks_destroy(bodies_blocks *b)
{
    for (int row = 0; row < BODIES_COMPONENTS; row++) {
        free(b->r[row]);
        for (int col = 0; col < BODIES_COMPONENTS; col++)
            free(b->j[row][col]);
    }
    memset(b, 0, sizeof *b);
}
