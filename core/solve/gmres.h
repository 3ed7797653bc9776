/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * gmres.h -- flexible GMRES (Saad 1993), right preconditioned, without restart. */
#ifndef SOLVE_GMRES_H
#define SOLVE_GMRES_H

#include "base/arena.h"
#include "base/error.h"

#include <plugflow/solver.h>

enum { GMRES_MOST = 200 };

/* A system of n equations.  The residual is measured by |scale r|; scale NULL: 1. */
typedef struct gmres {
    const pf_csr *a; /* with shared columns */
    int n_thread;
    const double *scale;
    int (*apply)(void *ctx, const double *b, double *x, error *err); /* x = about A^-1 b */
    void (*multiply)(void *ctx, const double *x,
                     double *y); /* y = about A x inside of the iteration; NULL: A itself */
    /* Projections of a singular system, unless NULL: of residuals, of solutions, in place. */
    void (*project)(void *ctx, double *rows);
    void (*level)(void *ctx, double *x);
    void *ctx;
    double *r;                                 /* [n] b - A x of the last solve */
    double *v[GMRES_MOST + 1], *z[GMRES_MOST]; /* made when they are needed */
    double (*h)[GMRES_MOST + 1];               /* columns of the Hessenberg matrix */
    arena memory;
} gmres;

/* From x = 0, at most `limit` iterations; *reached = |b - A x| / |b|, *n_iteration: how many it took. */
int gmres_solve(gmres *g, const double *b, double *x, double tol, int limit, double *reached, int *n_iteration,
                error *err);
/* y = A x */
void gmres_multiply(const gmres *g, const double *x, double *y);
void gmres_destroy(gmres *g);

#endif
