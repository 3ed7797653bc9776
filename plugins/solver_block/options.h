/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * options.h -- what a case may choose: solve { solver = "block", sweeps = 2 }. */
#ifndef SOLVER_BLOCK_OPTIONS_H
#define SOLVER_BLOCK_OPTIONS_H

/* Row sum over diagonal of F is about 2 where inertia prevails (the mass matrix), 0 where viscosity does; below
 * this the levels are worth their cost: nu / (sigma h^2) of about one half. */
#define VISCOUS 0.12
/* Couplings below this, relative to the diagonals, are weak. */
#define STRENGTH 0.02
/* Residual to which the Laplacian of the pressure is solved: a tenth is as good as exact, a cycle alone is not, as
 * its coefficients jump at surfaces. */
#define INNER 0.1
enum { INNER_MOST = 20, SWEEPS = 1 };

typedef struct options {
    double viscous, strength, inner;
    int inner_iterations, sweeps; /* sweeps: of the smoother on each level */
} options;

#endif
