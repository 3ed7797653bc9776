/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * levels.h -- coarser levels for the velocities: linear functions on the same cells, then smoothed aggregates of
 * their nodes; the bodies stay on all of them. */
#ifndef SOLVER_BLOCK_LEVELS_H
#define SOLVER_BLOCK_LEVELS_H

#include "aggregate.h"
#include "coarse.h"
#include "ilu.h"
#include "options.h"
#include "split.h"

enum { LEVELS_MOST = 12 };

typedef struct velocity_level {
    block_matrix a;
    uint8_t *active;           /* [a.n][b]; places that are not have a row of the identity */
    sparse prolong, restrict_; /* from the next level, and its transpose: the same share for all b places */
    ilu factors;               /* incomplete */
    float *x, *b, *r;          /* [a.n][b] */
} velocity_level;

typedef struct levels {
    const split *s;
    const options *o;
    sparse prolong, restrict_; /* from level 0 to the velocities */
    float *r;                  /* [n blocks][b] */
    int n_level;
    velocity_level level[LEVELS_MOST];
    coarse coarse; /* the last level, and its vectors */
    double *coarse_x, *coarse_b;
    pool memory;
} levels;

/* 0 or an enum pf_solver_status. */
int levels_create(levels *l, const split *s, const options *o);
/* u = P (coarse correction) P^T q. */
void levels_correct(levels *l, const float *q, float *u);
void levels_destroy(levels *l);

#endif
