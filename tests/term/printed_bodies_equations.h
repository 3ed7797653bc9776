/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * printed_bodies_equations.h -- the integrands of appendix B.4-B.9 and B.16-B.45 (and A.2-A.5, see B.1),
 * each as it is printed, for printed_bodies.c.
 *
 * In 2D w, g_z, omega_x, omega_y and all derivatives along z are zero. */
#ifndef PRINTED_BODIES_EQUATIONS_H
#define PRINTED_BODIES_EQUATIONS_H

#include "printed_bodies.h"
#include "printed_shapes.h"

/* What the integrands are made of at one point. */
typedef struct point {
    double phi[PRINTED_NODES], phi_x[PRINTED_NODES], phi_y[PRINTED_NODES], phi_z[PRINTED_NODES];
    double psi[PRINTED_NODES], psi_x[PRINTED_NODES], psi_y[PRINTED_NODES], psi_z[PRINTED_NODES];
    double u, u_x, u_y, u_z, v, v_x, v_y, v_z, w, w_x, w_y, w_z, u_old, v_old, w_old;
    double p, p_x, p_y, p_z;
    double lx, lx_x, lx_y, lx_z, ly, ly_x, ly_y, ly_z, lz, lz_x, lz_y, lz_z;
    double u_P, v_P, w_P, u_P_old, v_P_old, w_P_old, omega_x, omega_y, omega_z;
    double x, y, z, x_P, y_P, z_P;
    double rho, rho_P, mu, alpha, g_x, g_y, g_z, dt;
    double weight;
} point;

/* --- B.1: A.2-A.5 --- */

static double R_C(const point *q, int i)
{
    return q->psi[i] * (q->u_x + q->v_y + q->w_z);
}

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

/* --- residuals of momentum --- */

/* B.4 */
static double R_Mx(const point *q, int i)
{
    return q->rho * q->phi[i] * ((q->u - q->u_old) / q->dt + q->u * q->u_x + q->v * q->u_y + q->w * q->u_z) +
           q->phi_x[i] * (-q->p + 2 * q->mu * q->u_x) + q->phi_y[i] * q->mu * (q->u_y + q->v_x) +
           q->phi_z[i] * q->mu * (q->w_x + q->u_z) - q->phi[i] * q->rho * q->g_x - q->phi[i] * q->alpha * q->lx -
           q->mu * (q->phi_x[i] * q->lx_x + q->phi_y[i] * q->lx_y + q->phi_z[i] * q->lx_z);
}

/* B.5 */
static double R_My(const point *q, int i)
{
    return q->rho * q->phi[i] * ((q->v - q->v_old) / q->dt + q->u * q->v_x + q->v * q->v_y + q->w * q->v_z) +
           q->phi_x[i] * q->mu * (q->v_x + q->u_y) + q->phi_y[i] * (-q->p + 2 * q->mu * q->v_y) +
           q->phi_z[i] * q->mu * (q->v_z + q->w_y) - q->phi[i] * q->rho * q->g_y - q->phi[i] * q->alpha * q->ly -
           q->mu * (q->phi_x[i] * q->ly_x + q->phi_y[i] * q->ly_y + q->phi_z[i] * q->ly_z);
}

/* B.6 */
static double R_Mz(const point *q, int i)
{
    return q->rho * q->phi[i] * ((q->w - q->w_old) / q->dt + q->u * q->w_x + q->v * q->w_y + q->w * q->w_z) +
           q->phi_x[i] * q->mu * (q->w_x + q->u_z) + q->phi_y[i] * q->mu * (q->v_z + q->w_y) +
           q->phi_z[i] * (-q->p + 2 * q->mu * q->w_z) - q->phi[i] * q->rho * q->g_z - q->phi[i] * q->alpha * q->lz -
           q->mu * (q->phi_x[i] * q->lz_x + q->phi_y[i] * q->lz_y + q->phi_z[i] * q->lz_z);
}

/* --- B.7 --- */

static double dR_Mx_du(const point *q, int i, int j)
{
    return q->rho * q->phi[i] * q->phi[j] / q->dt +
           q->rho * q->phi[i] *
               (q->phi[j] * q->u_x + q->u * q->phi_x[j] + q->v * q->phi_y[j] + q->w * q->phi_z[j]) +
           q->phi_x[i] * 2 * q->mu * q->phi_x[j] + q->phi_y[i] * q->mu * q->phi_y[j] +
           q->phi_z[i] * q->mu * q->phi_z[j];
}

static double dR_Mx_dv(const point *q, int i, int j)
{
    return q->rho * q->phi[i] * q->phi[j] * q->u_y + q->phi_y[i] * q->mu * q->phi_x[j];
}

static double dR_Mx_dw(const point *q, int i, int j)
{
    return q->rho * q->phi[i] * q->phi[j] * q->u_z + q->phi_z[i] * q->mu * q->phi_x[j];
}

static double dR_Mx_dP(const point *q, int i, int j)
{
    return -q->phi_x[i] * q->psi[j];
}

/* --- B.8 --- */

static double dR_My_du(const point *q, int i, int j)
{
    return q->rho * q->phi[i] * q->phi[j] * q->v_x + q->phi_x[i] * q->mu * q->phi_y[j];
}

static double dR_My_dv(const point *q, int i, int j)
{
    return q->rho * q->phi[i] * q->phi[j] / q->dt +
           q->rho * q->phi[i] *
               (q->phi[j] * q->v_y + q->u * q->phi_x[j] + q->v * q->phi_y[j] + q->w * q->phi_z[j]) +
           q->phi_x[i] * q->mu * q->phi_x[j] + q->phi_y[i] * 2 * q->mu * q->phi_y[j] +
           q->phi_z[i] * q->mu * q->phi_z[j];
}

static double dR_My_dw(const point *q, int i, int j)
{
    return q->rho * q->phi[i] * q->phi[j] * q->v_z + q->phi_z[i] * q->mu * q->phi_y[j];
}

static double dR_My_dP(const point *q, int i, int j)
{
    return -q->phi_y[i] * q->psi[j];
}

/* --- B.9 --- */

static double dR_Mz_du(const point *q, int i, int j)
{
    return q->rho * q->phi[i] * q->phi[j] * q->w_x + q->phi_x[i] * q->mu * q->phi_z[j];
}

static double dR_Mz_dv(const point *q, int i, int j)
{
    return q->rho * q->phi[i] * q->phi[j] * q->w_y + q->phi_y[i] * q->mu * q->phi_z[j];
}

static double dR_Mz_dw(const point *q, int i, int j)
{
    return q->rho * q->phi[i] * q->phi[j] / q->dt +
           q->rho * q->phi[i] *
               (q->phi[j] * q->w_z + q->u * q->phi_x[j] + q->v * q->phi_y[j] + q->w * q->phi_z[j]) +
           q->phi_x[i] * q->mu * q->phi_x[j] + q->phi_y[i] * q->mu * q->phi_y[j] +
           q->phi_z[i] * 2 * q->mu * q->phi_z[j];
}

static double dR_Mz_dP(const point *q, int i, int j)
{
    return -q->phi_z[i] * q->psi[j];
}

/* dR_Mx/dlambda_x of B.7 = dR_My/dlambda_y of B.8 = dR_Mz/dlambda_z of B.9 */
static double dR_M_dlambda(const point *q, int i, int j)
{
    return -q->phi[i] * q->alpha * q->phi[j] -
           q->mu * (q->phi_x[i] * q->phi_x[j] + q->phi_y[i] * q->phi_y[j] + q->phi_z[i] * q->phi_z[j]);
}

/* --- residuals of lambda: _f in Omega_f, _P in Omega_P --- */

/* B.16 */
static double R_lambda_x_f(const point *q, int i)
{
    return q->lx * q->phi[i];
}

static double R_lambda_x_P(const point *q, int i)
{
    return (q->u - q->u_P) * q->phi[i] - (q->omega_y * (q->z - q->z_P) - q->omega_z * (q->y - q->y_P)) * q->phi[i];
}

/* B.17 */
static double R_lambda_y_f(const point *q, int i)
{
    return q->ly * q->phi[i];
}

static double R_lambda_y_P(const point *q, int i)
{
    return (q->v - q->v_P) * q->phi[i] - (q->omega_z * (q->x - q->x_P) - q->omega_x * (q->z - q->z_P)) * q->phi[i];
}

/* B.18 */
static double R_lambda_z_f(const point *q, int i)
{
    return q->lz * q->phi[i];
}

static double R_lambda_z_P(const point *q, int i)
{
    return (q->w - q->w_P) * q->phi[i] - (q->omega_x * (q->y - q->y_P) - q->omega_y * (q->x - q->x_P)) * q->phi[i];
}

/* B.19 in Omega_f, B.20 in Omega_P */
static double phi_phi(const point *q, int i, int j)
{
    return q->phi[i] * q->phi[j];
}

/* B.21 */
static double dR_lambda_dU(const point *q, int i, int j)
{
    return (void)j, -q->phi[i];
}

/* B.22 */
static double dR_lambda_x_domega_y(const point *q, int i, int j)
{
    return (void)j, -q->phi[i] * (q->z - q->z_P);
}

/* B.23 */
static double dR_lambda_x_domega_z(const point *q, int i, int j)
{
    return (void)j, q->phi[i] * (q->y - q->y_P);
}

/* B.24 */
static double dR_lambda_y_domega_z(const point *q, int i, int j)
{
    return (void)j, -q->phi[i] * (q->x - q->x_P);
}

/* B.25 */
static double dR_lambda_y_domega_x(const point *q, int i, int j)
{
    return (void)j, q->phi[i] * (q->z - q->z_P);
}

/* B.26 */
static double dR_lambda_z_domega_x(const point *q, int i, int j)
{
    return (void)j, -q->phi[i] * (q->y - q->y_P);
}

/* B.27 */
static double dR_lambda_z_domega_y(const point *q, int i, int j)
{
    return (void)j, q->phi[i] * (q->x - q->x_P);
}

/* --- rigid bodies --- */

/* B.28 */
static double R_u(const point *q, int i)
{
    return (void)i,
           (q->rho_P - q->rho) * (q->u_P - q->u_P_old) / q->dt - q->rho_P * q->g_x + q->p_x + q->alpha * q->lx;
}

/* B.29 */
static double R_v(const point *q, int i)
{
    return (void)i,
           (q->rho_P - q->rho) * (q->v_P - q->v_P_old) / q->dt - q->rho_P * q->g_y + q->p_y + q->alpha * q->ly;
}

/* B.30 */
static double R_w(const point *q, int i)
{
    return (void)i,
           (q->rho_P - q->rho) * (q->w_P - q->w_P_old) / q->dt - q->rho_P * q->g_z + q->p_z + q->alpha * q->lz;
}

/* B.31 */
static double R_omega_x(const point *q, int i)
{
    return (void)i, q->omega_x - 0.5 * (q->w_y - q->v_z);
}

/* B.32 */
static double R_omega_y(const point *q, int i)
{
    return (void)i, q->omega_y - 0.5 * (q->u_z - q->w_x);
}

/* B.33 */
static double R_omega_z(const point *q, int i)
{
    return (void)i, q->omega_z - 0.5 * (q->v_x - q->u_y);
}

/* B.34 */
static double dR_U_dU(const point *q, int i, int j)
{
    return (void)i, (void)j, (q->rho_P - q->rho) * 1 / q->dt;
}

/* B.35 */
static double dR_U_dlambda(const point *q, int i, int j)
{
    return (void)i, q->alpha * q->phi[j];
}

/* B.36 */
static double dR_u_dp(const point *q, int i, int j)
{
    return (void)i, q->psi_x[j];
}

/* B.37 */
static double dR_v_dp(const point *q, int i, int j)
{
    return (void)i, q->psi_y[j];
}

/* B.38 */
static double dR_w_dp(const point *q, int i, int j)
{
    return (void)i, q->psi_z[j];
}

/* B.39 */
static double dR_omega_domega(const point *q, int i, int j)
{
    return (void)q, (void)i, (void)j, 1;
}

/* B.40, B.43, B.44: with which derivative, the table says */
static double half_phi_x(const point *q, int i, int j)
{
    return (void)i, 0.5 * q->phi_x[j];
}

static double half_phi_y(const point *q, int i, int j)
{
    return (void)i, 0.5 * q->phi_y[j];
}

static double half_phi_z(const point *q, int i, int j)
{
    return (void)i, 0.5 * q->phi_z[j];
}

/* B.41, B.42, B.45 */
static double minus_half_phi_x(const point *q, int i, int j)
{
    return (void)i, -0.5 * q->phi_x[j];
}

static double minus_half_phi_y(const point *q, int i, int j)
{
    return (void)i, -0.5 * q->phi_y[j];
}

static double minus_half_phi_z(const point *q, int i, int j)
{
    return (void)i, -0.5 * q->phi_z[j];
}

/* --- tables: domain, row, column; what is not there is zero --- */

static double (*const residual[BODIES_DOMAINS][BODIES_COMPONENTS])(const point *, int) = {
    [BODIES_OMEGA] = {[BODIES_U] = R_Mx, [BODIES_V] = R_My, [BODIES_W] = R_Mz, [BODIES_P] = R_C},
    [BODIES_OMEGA_F] = {[BODIES_LX] = R_lambda_x_f, [BODIES_LY] = R_lambda_y_f, [BODIES_LZ] = R_lambda_z_f},
    [BODIES_OMEGA_P] = {[BODIES_LX] = R_lambda_x_P,
                        [BODIES_LY] = R_lambda_y_P,
                        [BODIES_LZ] = R_lambda_z_P,
                        [BODIES_UP] = R_u,
                        [BODIES_VP] = R_v,
                        [BODIES_WP] = R_w,
                        [BODIES_OX] = R_omega_x,
                        [BODIES_OY] = R_omega_y,
                        [BODIES_OZ] = R_omega_z},
};

static double (*const entry[BODIES_DOMAINS][BODIES_COMPONENTS][BODIES_COMPONENTS])(const point *, int, int) =
    {
        [BODIES_OMEGA] =
            {
                [BODIES_U] = {dR_Mx_du, dR_Mx_dv, dR_Mx_dw, dR_Mx_dP, [BODIES_LX] = dR_M_dlambda},
                [BODIES_V] = {dR_My_du, dR_My_dv, dR_My_dw, dR_My_dP, [BODIES_LY] = dR_M_dlambda},
                [BODIES_W] = {dR_Mz_du, dR_Mz_dv, dR_Mz_dw, dR_Mz_dP, [BODIES_LZ] = dR_M_dlambda},
                [BODIES_P] = {dR_C_du, dR_C_dv, dR_C_dw},
            },
        [BODIES_OMEGA_F] =
            {
                [BODIES_LX] = {[BODIES_LX] = phi_phi},
                [BODIES_LY] = {[BODIES_LY] = phi_phi},
                [BODIES_LZ] = {[BODIES_LZ] = phi_phi},
            },
        [BODIES_OMEGA_P] =
            {
                [BODIES_LX] = {[BODIES_U] = phi_phi,
                               [BODIES_UP] = dR_lambda_dU,
                               [BODIES_OY] = dR_lambda_x_domega_y,
                               [BODIES_OZ] = dR_lambda_x_domega_z},
                [BODIES_LY] = {[BODIES_V] = phi_phi,
                               [BODIES_VP] = dR_lambda_dU,
                               [BODIES_OZ] = dR_lambda_y_domega_z,
                               [BODIES_OX] = dR_lambda_y_domega_x},
                [BODIES_LZ] = {[BODIES_W] = phi_phi,
                               [BODIES_WP] = dR_lambda_dU,
                               [BODIES_OX] = dR_lambda_z_domega_x,
                               [BODIES_OY] = dR_lambda_z_domega_y},
                [BODIES_UP] = {[BODIES_UP] = dR_U_dU, [BODIES_LX] = dR_U_dlambda, [BODIES_P] = dR_u_dp},
                [BODIES_VP] = {[BODIES_VP] = dR_U_dU, [BODIES_LY] = dR_U_dlambda, [BODIES_P] = dR_v_dp},
                [BODIES_WP] = {[BODIES_WP] = dR_U_dU, [BODIES_LZ] = dR_U_dlambda, [BODIES_P] = dR_w_dp},
                [BODIES_OX] = {[BODIES_OX] = dR_omega_domega,
                               [BODIES_V] = half_phi_z,        /* B.40 */
                               [BODIES_W] = minus_half_phi_y}, /* B.41 */
                [BODIES_OY] = {[BODIES_OY] = dR_omega_domega,
                               [BODIES_U] = minus_half_phi_z, /* B.42 */
                               [BODIES_W] = half_phi_x},      /* B.43 */
                [BODIES_OZ] = {[BODIES_OZ] = dR_omega_domega,
                               [BODIES_U] = half_phi_y,        /* B.44 */
                               [BODIES_V] = minus_half_phi_x}, /* B.45 */
            },
};

#endif
