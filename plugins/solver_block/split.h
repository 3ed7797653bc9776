/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * split.h -- the matrix in blocks of velocity and pressure:
 *
 *     | F  G | u     velocities, bodies and all else but the pressure, in blocks of dim unknowns
 *     | D  C | p     C: zero but for the ties of badly cut cells
 */
#ifndef SOLVER_BLOCK_SPLIT_H
#define SOLVER_BLOCK_SPLIT_H

#include "parts.h"

typedef struct split {
    const pf_csr *a;    /* valid during analysis, set-up and update only */
    int64_t n;          /* its rows                         */
    int b;              /* size of the blocks: dim            */
    int pressure;       /* its field                          */
    int32_t n_p;        /* pressures                          */
    int32_t *block;     /* [n] of each row: its block, or -1 - its pressure                     */
    uint8_t *slot;      /* [n] place in the block                                               */
    int32_t *row_of;    /* [f.n][b] row of the matrix at each place, or -1                      */
    int32_t *row_of_p;  /* [n_p]                                                               */
    int32_t *group;     /* [f.n] node (pf_csr) that a block belongs to                          */
    uint8_t *is_global; /* [f.n] of a body or of the problem: coupled with many nodes */
    uint8_t *active;    /* [f.n][b] there is an unknown, and it is not idle                     */
    uint8_t *active_p;  /* [n_p]                                                               */
    block_matrix f;
    float *inverse_diagonal; /* [f.n][b] of F; 1 where nothing is active                      */
    /* G by rows of blocks, D by pressures; b numbers an entry. */
    int64_t *g_row, *d_row;
    int32_t *g_col, *d_col;
    float *g, *d;
    sparse c;
    int n_thread;
    int32_t **where; /* [n_thread][f.n + n_p] room */
    int gauge;       /* a constant pressure changes nothing */
} split;

/* 0: the system has the form; else why says why not. */
int split_fits(const pf_csr *a, int *pressure, const char **why);
/* Pattern, for a fixed number of threads. */
void split_analyze(split *s, const pf_csr *a, int pressure, int n_thread, pool *p);
/* Values. */
void split_fill(split *s, const pf_csr *a);
/* v = scale G p (of active pressures), q = D v (0 where none is active). */
void split_gradient(const split *s, const double *p, double scale, float *v);
void split_divergence(const split *s, const float *v, double *q);

#endif
