/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * solver.h -- what a linear solver plugin offers.  It only analyses, sets up and applies, once per call; the kernel
 * owns the Krylov iteration (flexible GMRES, right preconditioned), the reuse of what was set up, and every
 * residual check.  What a solver returns for a right-hand side may be exact (a factorisation) or a rough answer
 * (PF_SOLVER_APPROXIMATE), which the iteration makes good.
 * One exported symbol: pf_solver_entry. */
#ifndef PLUGFLOW_SOLVER_H
#define PLUGFLOW_SOLVER_H

#include <stddef.h>
#include <stdint.h>

#include <plugflow/plugin.h>

#define PF_SOLVER_MAJOR 1u

/* PF_ROWS_OF_NODE: or of a cell, of fields of order 0: x is its middle. */
enum pf_row_kind { PF_ROWS_OF_NODE = 0, PF_ROWS_OF_PROBLEM = 1, PF_ROWS_OF_BODY = 2 };

typedef struct pf_row_field {
    const char *name;
    int32_t n_comp;
    int32_t order;  /* 2: at all nodes of the mesh, 1: at vertices of cells, 0: off the mesh */
    int32_t inside; /* 1: lives inside of bodies only */
} pf_row_field;

/* What the unknowns are.  Rows of one node (a node of the mesh, a body) are a group, see pf_csr.  All is fixed from
 * analyze() on but what is marked *, which belongs to the values of the matrix. */
typedef struct pf_unknowns {
    uint32_t size;
    int32_t dim, n_field;
    const pf_row_field *field;   /* [n_field]                                                */
    const uint8_t *field_of;     /* [n] of each row                                          */
    const uint8_t *comp_of;      /* [n] component of the field                               */
    const uint8_t *kind;         /* [n_node] enum pf_row_kind                                */
    const double *x;             /* [n_node][dim] where a node of the mesh is; others: 0     */
    const int64_t *parent;       /* [n_node + 1] a node that is no vertex lies between vertices:         */
    const int32_t *parent_node;  /* [parent[n_node]] groups of those that have unknowns ...              */
    const double *parent_weight; /* ... and shares, by which linear functions are interpolated           */
    const uint8_t *idle;         /* * [n] 1: the row is x = 0, the column is zero            */
    uint32_t free_fields;        /* * bit f: a constant added to field f changes nothing; b is such that the ... */
    const double *const *weight; /* * ... sum of its rows vanishes; [n_field][n] shares in that sum, or NULL     */
} pf_unknowns;

/* Square sparse matrix, compressed sparse rows; columns ascend within a row. */
typedef struct pf_csr {
    int64_t n;                   /* rows                                                        */
    const int64_t *row;          /* row pointers, size n+1                                      */
    const int64_t *col;          /* column indices, size row[n]; NULL: see shared_col           */
    const double *value;         /* entries, size row[n]; NULL during analyze                   */
    int64_t n_node;              /* unknowns come in groups that share a node of the mesh ...   */
    const int64_t *node;         /* ... group g is rows node[g] .. node[g+1]-1, size n_node+1   */
    const pf_unknowns *unknowns; /* what they are; NULL: not known                       */
    /* All rows of a group have the same columns: entry k of row r stands in column shared_col[k + shared_shift[r]].
     * Only solvers with PF_SOLVER_SHARED_COLUMNS get a matrix without col. */
    const int32_t *shared_col;
    const int64_t *shared_shift; /* [n] */
} pf_csr;

static inline int64_t pf_column(const pf_csr *a, int64_t row, int64_t k)
{
    return a->col ? a->col[k] : a->shared_col[k + a->shared_shift[row]];
}

typedef struct pf_solver_cost {
    double bytes; /* memory that setup will need, predicted                       */
    double flops; /* floating-point operations of one setup                       */
    double fill;  /* entries that one solve passes over; two operations on each,
                   * twice for a factorisation (L and U)                          */
} pf_solver_cost;

enum pf_solver_status {
    PF_SOLVER_OK = 0,
    PF_SOLVER_SINGULAR = 1, /* recoverable: the matrix is singular    */
    PF_SOLVER_UNFIT = 2,    /* this solver is not for such a system; err says why.  The kernel takes another one */
    PF_SOLVER_MEMORY = -2,  /* fatal                                  */
    PF_SOLVER_ERROR = -1
};

enum pf_solver_flag {
    PF_SOLVER_SHARED_COLUMNS = 1u << 1, /* reads columns by pf_column(), which saves two fifths of the memory */
    PF_SOLVER_APPROXIMATE = 1u << 0 /* solve() gives a rough answer; the matrix is handed over as it is, singular by
                                     * its free constants.  Without this flag one value of each is held. */
};

/* Functions with err return an enum pf_solver_status and explain themselves there.  The matrix is valid during
 * analyze, setup and update only: solve and multiply must not read it. */
typedef struct pf_solver {
    uint32_t size, major, sizes;
    const char *name, *version, *doc;
    int (*create)(void **self, int n_thread, char *err, size_t nerr);
    int (*analyze)(void *self, const pf_csr *pattern, pf_solver_cost *cost, char *err, size_t nerr);
    int (*setup)(void *self, const pf_csr *matrix, char *err, size_t nerr);
    int (*solve)(void *self, const double *b, double *x, char *err, size_t nerr);
    void (*destroy)(void *self);
    uint32_t flags; /* enum pf_solver_flag; of solvers built before there were any: 0 */
    /* Both may be NULL.  update: another matrix on the same pattern; what was set up stays, and solve() goes on
     * with it.  multiply: y = A x for the last matrix of setup or update, in the solver's own precision, which is
     * enough inside of the iteration; the kernel then corrects the result by its own residual. */
    int (*update)(void *self, const pf_csr *matrix, char *err, size_t nerr);
    void (*multiply)(void *self, const double *x, double *y);
    /* Keys of solve { solver = "NAME", key = ... }, as a term describes its own, and the struct that they go in; it
     * is handed over once, before analyze.  All 0 or NULL: there are none. */
    uint32_t n_param, param_size, params_bytes;
    const pf_param *param;
    int (*configure)(void *self, const void *params, char *err, size_t nerr);
} pf_solver;

typedef const pf_solver *pf_solver_entry_fn(char *err, size_t nerr);
/* The exported symbol: the description, or NULL with the reason in err. */
PF_EXPORT const pf_solver *pf_solver_entry(char *err, size_t nerr);

/* A plugin of one solver, description and entry:
 *     PF_SOLVER(.name = "klu", .version = "1.0", .doc = "...", .create = create, ..., PF_PARAMS(struct options,
 * ...)) */
#define PF_SOLVER(...)                                                                                             \
    static const pf_solver pf_solver_here = {.size = sizeof(pf_solver),                                            \
                                             .major = PF_SOLVER_MAJOR,                                             \
                                             .sizes = PF_SIZES,                                                    \
                                             .param_size = sizeof(pf_param),                                       \
                                             __VA_ARGS__};                                                         \
                                                                                                                   \
    const pf_solver *pf_solver_entry(char *err, size_t nerr)                                                       \
    {                                                                                                              \
        (void)err, (void)nerr;                                                                                     \
        return &pf_solver_here;                                                                                    \
    }
#endif
