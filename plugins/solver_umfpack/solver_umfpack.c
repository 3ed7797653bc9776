/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Sparse LU by UMFPACK (T. A. Davis, Algorithm 832, 2004), symmetric strategy.
 *
 * The fill-reducing order comes from METIS on the graph of mesh nodes (all unknowns of a node
 * as one); CHOLMOD counts the fill it gives, so that memory is known before the factorisation.
 * The matrix comes by rows, UMFPACK wants columns: it factors A^T and solves with UMFPACK_At. */
#include <plugflow/solver.h>

#include <cholmod.h>
#include <metis.h>
#include <umfpack.h>

#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Above this many operations a factorisation gains from threads in BLAS. */
#define THREADED_FLOPS 1e10
/* Entries of L + U to bytes, with UMFPACK's working space; measured. */
#define BYTES_PER_ENTRY (1.3 * 8)

typedef struct umfpack {
    int n_thread;
    pf_csr a;
    void *symbolic, *numeric;
    double flops;
    double control[UMFPACK_CONTROL];
} umfpack;

static int fail(char *err, size_t nerr, int status, const char *what, double umf)
{
    snprintf(err, nerr, "%s (UMFPACK status %g)", what, umf);
    return status;
}

static void blas_threads(int n)
{
    void (*set)(int);
    void *symbol = dlsym(RTLD_DEFAULT, "openblas_set_num_threads");

    memcpy(&set, &symbol, sizeof set);
    if (set)
        set(n);
}

/* Order of the nodes by METIS; perm[k] = k-th node to eliminate. */
static int order_nodes(const pf_csr *a, idx_t *perm)
{
    idx_t n = (idx_t)a->n_node, *start = NULL, *to = NULL, *inverse = NULL, options[METIS_NOPTIONS];
    int64_t *node_of = malloc((size_t)a->n * sizeof *node_of), edges = 0;
    int ok = 0;

    for (int64_t g = 0; node_of && g < n; g++)
        for (int64_t r = a->node[g]; r < a->node[g + 1]; r++)
            node_of[r] = g;
    start = malloc(((size_t)n + 1) * sizeof *start);
    inverse = malloc((size_t)n * sizeof *inverse);
    for (int pass = 0; pass < 2 && node_of && start && inverse; pass++) {
        edges = 0;
        for (int64_t g = 0; g < n; g++) {
            int64_t r = a->node[g], last = g;

            start[g] = (idx_t)edges;
            for (int64_t k = a->row[r]; k < a->row[r + 1]; k++) {
                int64_t h = node_of[a->col[k]];

                if (h == g || (h == last && k > a->row[r]))
                    continue;
                last = h;
                if (pass)
                    to[edges] = (idx_t)h;
                edges++;
            }
        }
        start[n] = (idx_t)edges;
        if (!pass && !(to = malloc((size_t)(edges > 0 ? edges : 1) * sizeof *to)))
            break;
    }
    if (to) {
        METIS_SetDefaultOptions(options);
        options[METIS_OPTION_SEED] = 1;
        ok = METIS_NodeND(&n, start, to, NULL, options, perm, inverse) == METIS_OK;
    }
    free(node_of);
    free(start);
    free(to);
    free(inverse);
    return ok;
}

/* Called by UMFPACK.  info = {longest column of L, entries of L, operations}. */
static int order_unknowns(SuiteSparse_long n, SuiteSparse_long n_col, SuiteSparse_long symmetric,
                          SuiteSparse_long *ap, SuiteSparse_long *ai, SuiteSparse_long *perm, void *arg,
                          double info[3])
{
    const umfpack *u = arg;
    const pf_csr *a = &u->a;
    idx_t *node = malloc((size_t)a->n_node * sizeof *node);
    cholmod_common cm;
    cholmod_sparse m = {0};
    cholmod_factor *l = NULL;
    int ok = n == a->n && n == n_col && symmetric && node && order_nodes(a, node);

    (void)ap;
    (void)ai;
    for (int64_t k = 0, at = 0; ok && k < a->n_node; k++)
        for (int64_t r = a->node[node[k]]; r < a->node[node[k] + 1]; r++)
            perm[at++] = r;
    free(node);
    if (!ok)
        return 0;
    cholmod_l_start(&cm);
    cm.nmethods = 1;
    cm.method[0].ordering = CHOLMOD_GIVEN;
    cm.supernodal = CHOLMOD_SIMPLICIAL;
    m.nrow = m.ncol = (size_t)n;
    m.nzmax = (size_t)a->row[n];
    m.p = (void *)a->row;
    m.i = (void *)a->col;
    m.stype = 1;
    m.itype = CHOLMOD_LONG;
    m.xtype = CHOLMOD_PATTERN;
    m.dtype = CHOLMOD_DOUBLE;
    m.sorted = m.packed = 1;
    l = cholmod_l_analyze_p(&m, perm, NULL, 0, &cm);
    if (l) {
        memcpy(perm, l->Perm, (size_t)n * sizeof *perm);
        info[0] = 0;
        for (int64_t k = 0; k < n; k++)
            info[0] = ((SuiteSparse_long *)l->ColCount)[k] > info[0] ? (double)((SuiteSparse_long *)l->ColCount)[k]
                                                                     : info[0];
        info[1] = cm.lnz;
        info[2] = cm.fl;
    }
    ok = l != NULL;
    cholmod_l_free_factor(&l, &cm);
    cholmod_l_finish(&cm);
    return ok;
}

static int create(void **self, int n_thread, char *err, size_t nerr)
{
    umfpack *u = calloc(1, sizeof *u);

    *self = u;
    if (!u)
        return fail(err, nerr, PF_SOLVER_MEMORY, "out of memory", 0);
    u->n_thread = n_thread;
    umfpack_dl_defaults(u->control);
    u->control[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_SYMMETRIC;
    u->control[UMFPACK_ORDERING] = UMFPACK_ORDERING_METIS;
    u->control[UMFPACK_SINGLETONS] = 0;
    u->control[UMFPACK_IRSTEP] = 0;
    blas_threads(1);
    return PF_SOLVER_OK;
}

static int analyze(void *self, const pf_csr *pattern, pf_solver_cost *cost, char *err, size_t nerr)
{
    umfpack *u = self;
    double info[UMFPACK_INFO];
    SuiteSparse_long status;

    umfpack_dl_free_numeric(&u->numeric);
    umfpack_dl_free_symbolic(&u->symbolic);
    u->a = *pattern;
    status = umfpack_dl_fsymbolic(pattern->n, pattern->n, pattern->row, pattern->col, NULL, order_unknowns, u,
                                  &u->symbolic, u->control, info);
    if (status != UMFPACK_OK)
        return fail(err, nerr, status == UMFPACK_ERROR_out_of_memory ? PF_SOLVER_MEMORY : PF_SOLVER_ERROR,
                    "analysis of the matrix failed", (double)status);
    if (info[UMFPACK_STRATEGY_USED] != UMFPACK_STRATEGY_SYMMETRIC)
        return fail(err, nerr, PF_SOLVER_ERROR, "UMFPACK did not take the symmetric strategy",
                    info[UMFPACK_STRATEGY_USED]);
    cost->fill = info[UMFPACK_SYMMETRIC_LUNZ];
    cost->flops = info[UMFPACK_SYMMETRIC_FLOPS];
    cost->bytes = BYTES_PER_ENTRY * cost->fill;
    u->flops = cost->flops;
    return PF_SOLVER_OK;
}

static int setup(void *self, const pf_csr *matrix, char *err, size_t nerr)
{
    umfpack *u = self;
    SuiteSparse_long status;

    u->a = *matrix;
    umfpack_dl_free_numeric(&u->numeric);
    blas_threads(u->flops > THREADED_FLOPS ? u->n_thread : 1);
    status =
        umfpack_dl_numeric(matrix->row, matrix->col, matrix->value, u->symbolic, &u->numeric, u->control, NULL);
    blas_threads(1);
    if (status == UMFPACK_WARNING_singular_matrix)
        return fail(err, nerr, PF_SOLVER_SINGULAR, "the matrix is singular", (double)status);
    if (status != UMFPACK_OK)
        return fail(err, nerr, status == UMFPACK_ERROR_out_of_memory ? PF_SOLVER_MEMORY : PF_SOLVER_ERROR,
                    status == UMFPACK_ERROR_out_of_memory ? "out of memory while factoring"
                                                          : "factorisation failed",
                    (double)status);
    return PF_SOLVER_OK;
}

static int solve(void *self, const double *b, double *x, char *err, size_t nerr)
{
    umfpack *u = self;
    SuiteSparse_long status =
        umfpack_dl_solve(UMFPACK_At, u->a.row, u->a.col, u->a.value, x, b, u->numeric, u->control, NULL);

    return status == UMFPACK_OK ? PF_SOLVER_OK
                                : fail(err, nerr, PF_SOLVER_ERROR, "solution failed", (double)status);
}

static void destroy(void *self)
{
    umfpack *u = self;

    umfpack_dl_free_numeric(&u->numeric);
    umfpack_dl_free_symbolic(&u->symbolic);
    free(u);
}

static const pf_solver solver = {
    .size = sizeof(pf_solver),
    .major = PF_SOLVER_MAJOR,
    .name = "solver_umfpack",
    .version = "1.0",
    .doc = "sparse LU (UMFPACK, symmetric strategy, METIS on the node graph)",
    .create = create,
    .analyze = analyze,
    .setup = setup,
    .solve = solve,
    .destroy = destroy,
};

__attribute__((visibility("default"))) const pf_solver *pf_solver_entry(char *err, size_t nerr);

const pf_solver *pf_solver_entry(char *err, size_t nerr)
{
    (void)err, (void)nerr;
    return &solver;
}
