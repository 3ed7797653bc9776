/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * printed_bodies.h -- flow with bodies as appendix B.1-B.9 and B.16-B.45 print it.
 *
 * Residuals and Jacobians component by component, as dense blocks over the nodes of a mesh and the
 * bodies.  Where the points of Omega, Omega_f and Omega_P are is told; the integrands there, shape
 * functions and the mapping of curved cells are a second opinion on what the kernel makes of them. */
#ifndef PRINTED_BODIES_H
#define PRINTED_BODIES_H

#include "printed_formulas.h"

#include "mesh/mesh.h"

#include <stdint.h>

/* Rows and columns: at nodes u, v, w, p, lambda; of bodies u_P, v_P, w_P, omega. */
enum {
    BODIES_U,
    BODIES_V,
    BODIES_W,
    BODIES_P,
    BODIES_LX,
    BODIES_LY,
    BODIES_LZ,
    BODIES_UP,
    BODIES_VP,
    BODIES_WP,
    BODIES_OX,
    BODIES_OY,
    BODIES_OZ,
    BODIES_COMPONENTS
};

typedef struct bodies_body {
    double rho, x[3]; /* rho_P, (x_P, y_P, z_P) */
} bodies_body;

typedef struct bodies_data {
    const printed_fluid *fluid;
    double alpha;
    const bodies_body *body;
} bodies_data;

/* Values of each component at its nodes or bodies; p counts at vertices only, in 2D there are only
 * u, v, p, lambda_x, lambda_y, u_P, v_P, omega_z. */
typedef struct bodies_state {
    const double *now[BODIES_COMPONENTS], *old[BODIES_COMPONENTS];
} bodies_state;

/* Rows and columns are nodes or bodies; those without the unknown stay zero. */
typedef struct bodies_blocks {
    int64_t n[BODIES_COMPONENTS];                    /* nodes or bodies     */
    double *r[BODIES_COMPONENTS];                    /* [n[row]]            */
    double *j[BODIES_COMPONENTS][BODIES_COMPONENTS]; /* [n[row]][n[column]] */
} bodies_blocks;

enum bodies_domain { BODIES_OMEGA, BODIES_OMEGA_F, BODIES_OMEGA_P, BODIES_DOMAINS };

/* Points of a domain in one cell: in the reference cell, with weights there. */
typedef struct bodies_part {
    enum bodies_domain domain;
    int64_t cell;
    int64_t body; /* Omega_P: of this one */
    int n;
    const double (*s)[3];
    const double *weight;
} bodies_part;

/* All zero; 0, or -1 if there is no memory. */
int bodies_blocks_create(bodies_blocks *b, int64_t n_node, int64_t n_body);
void bodies_blocks_destroy(bodies_blocks *b);

/* Adds residual and Jacobian of one part. */
void bodies_add(const mesh *m, const bodies_data *d, const bodies_state *s, const bodies_part *part,
                bodies_blocks *b);

/* Whether a component exists in this dimension, and whether a Jacobian entry is printed as not zero. */
int bodies_component(int dim, int component);
int bodies_entry(int row, int col);

/* "R_Mx", "lambda_x", ... */
extern const char *const bodies_row_name[BODIES_COMPONENTS];
extern const char *const bodies_col_name[BODIES_COMPONENTS];

#endif
