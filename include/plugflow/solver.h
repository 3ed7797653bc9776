/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * solver.h -- what a linear solver plugin offers.  It only analyses, factors and applies;
 * the kernel owns GMRES, the reuse of factors and every residual check.
 * One exported symbol: pf_solver_entry. */
#ifndef PLUGFLOW_SOLVER_H
#define PLUGFLOW_SOLVER_H

#include <stddef.h>
#include <stdint.h>

#define PF_SOLVER_MAJOR 1u

/* Square sparse matrix, compressed sparse rows; columns ascend within a row. */
typedef struct pf_csr {
    int64_t n;           /* rows                                                        */
    const int64_t *row;  /* row pointers, size n+1                                      */
    const int64_t *col;  /* column indices, size row[n]                                 */
    const double *value; /* entries, size row[n]; NULL during analyze                   */
    int64_t n_node;      /* unknowns come in groups that share a node of the mesh ...   */
    const int64_t *node; /* ... group g is rows node[g] .. node[g+1]-1, size n_node+1   */
} pf_csr;

typedef struct pf_solver_cost {
    double bytes; /* memory that setup will need, predicted    */
    double flops; /* floating-point operations of one setup    */
    double fill;  /* entries of the factors                    */
} pf_solver_cost;

enum pf_solver_status {
    PF_SOLVER_OK = 0,
    PF_SOLVER_SINGULAR = 1, /* recoverable: the matrix is singular    */
    PF_SOLVER_MEMORY = -2,  /* fatal                                  */
    PF_SOLVER_ERROR = -1
};

/* All functions return an enum pf_solver_status and explain themselves in err. */
typedef struct pf_solver {
    uint32_t size, major, sizes;
    const char *name, *version, *doc;
    int (*create)(void **self, int n_thread, char *err, size_t nerr);
    int (*analyze)(void *self, const pf_csr *pattern, pf_solver_cost *cost, char *err, size_t nerr);
    int (*setup)(void *self, const pf_csr *matrix, char *err, size_t nerr);
    int (*solve)(void *self, const double *b, double *x, char *err, size_t nerr);
    void (*destroy)(void *self);
} pf_solver;

typedef const pf_solver *pf_solver_entry_fn(char *err, size_t nerr);
#endif
