/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * printed_formulas.h -- continuity and momentum as appendix A.2-A.6 and A.10-A.15 print them.
 *
 * Residuals and Jacobians component by component, as dense blocks over the nodes of a mesh: a
 * second opinion on what terms, elements and assembly of the kernel make of the same equations. */
#ifndef PRINTED_FORMULAS_H
#define PRINTED_FORMULAS_H

#include "mesh/mesh.h"

#include <stdint.h>

/* Rows and columns.  Row PRINTED_P is continuity. */
enum { PRINTED_U, PRINTED_V, PRINTED_W, PRINTED_P, PRINTED_COMPONENTS };

typedef struct printed_fluid {
    double rho, mu, g[3]; /* rho_f, mu, (g_x, g_y, g_z) */
    double dt;            /* Delta t                    */
} printed_fluid;

/* Values of u, v, w, p at the nodes, [n_node] each; p counts at vertices only, w in 3D only. */
typedef struct printed_state {
    const double *now[PRINTED_COMPONENTS], *old[PRINTED_COMPONENTS];
} printed_state;

/* Rows and columns are nodes; those without the unknown stay zero. */
typedef struct printed_blocks {
    int64_t n;                                         /* nodes      */
    double *r[PRINTED_COMPONENTS];                     /* [n]        */
    double *j[PRINTED_COMPONENTS][PRINTED_COMPONENTS]; /* [n][n]     */
} printed_blocks;

/* All zero; 0, or -1 if there is no memory. */
int printed_blocks_create(printed_blocks *b, int64_t n);
void printed_blocks_destroy(printed_blocks *b);

/* Adds residual and Jacobian of all cells of the mesh (its coordinates and connectivity). */
void printed_assemble(const mesh *m, const printed_fluid *f, const printed_state *s, printed_blocks *b);

/* "R_mx", "dR_mx/dv", ... */
extern const char *const printed_row_name[PRINTED_COMPONENTS];
extern const char *const printed_entry_name[PRINTED_COMPONENTS][PRINTED_COMPONENTS];

#endif
