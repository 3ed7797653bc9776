/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Sparse LU by UMFPACK (T. A. Davis, Algorithm 832, 2004), symmetric strategy.
 *
 * The fill-reducing order comes from METIS on the graph of the matrix; CHOLMOD counts the fill
 * it gives, so that memory is known before the factorisation.
 * The matrix comes by rows, UMFPACK wants columns: it factors A^T and solves with UMFPACK_At. */
#include <plugflow/solver.h>

#include <cholmod.h>
#include <metis.h>
#include <umfpack.h>

#include <dlfcn.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Above this many operations a factorisation gains from threads in BLAS. */
#define THREADED_FLOPS 1e10
/* Entries of L + U to bytes, with UMFPACK's working space; measured. */
#define BYTES_PER_ENTRY (1.3 * 8)

/* What a case may choose: solve { solver = "umfpack", ordering = "amd" }. */
typedef struct options {
    double pivot;
    int ordering;
} options;

enum { ORDER_METIS, ORDER_AMD };

typedef struct umfpack {
    int n_thread, ordering;
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

/* OpenBLAS has one number of threads for the whole process.  It is ours during a call of UMFPACK only:
 *
 *     before = blas_threads(n);  ...  blas_threads(before);
 *
 * Sets it and returns what it was; 0, and nothing else, for another BLAS and for n = 0. */
static int blas_threads(int n)
{
    int (*get)(void);
    void (*set)(int);
    void *get_symbol = dlsym(RTLD_DEFAULT, "openblas_get_num_threads");
    void *set_symbol = dlsym(RTLD_DEFAULT, "openblas_set_num_threads");
    int before;

    if (!get_symbol || !set_symbol || n <= 0)
        return 0;
    memcpy(&get, &get_symbol, sizeof get);
    memcpy(&set, &set_symbol, sizeof set);
    before = get();
    if (n != before)
        set(n);
    return before;
}

/* Neighbours of a node from which the better one of two separators is taken; in 2D they are 12 to 15, in 3D 28
 * (tetrahedra) to 60. */
#define MANY_NEIGHBOURS 20

/* Symmetric graph of the nodes, as METIS takes it. */
typedef struct node_graph {
    idx_t n, *start, *to, *weight;
    idx_t *perm;   /* [2 n] nodes in the order of elimination, and the inverse */
    idx_t *vertex; /* of each unknown                                          */
} node_graph;

/* METIS_NodeND that leaves handlers of signals as they were.
 *
 * While it runs, METIS has its own for SIGTERM and SIGABRT (GKlib, gk_sigtrap), by which it also ends itself where
 * it runs out of memory; then it puts the old ones back by signal(), which loses their flags, and as it leaves its
 * handler by longjmp, the signal may stay blocked.  A SIGTERM from outside makes it fail and would be lost: it is
 * raised again for whom it was meant.  But METIS jumps out of whatever that signal interrupts, malloc too, so a
 * program should block SIGTERM in all its threads and take it in one that waits for it; plugflow does
 * (core/cli/signals.c). To block it here is no help: then it comes to another thread, in which METIS has nowhere to
 * jump to. */
static int dissect(node_graph *g)
{
    struct sigaction on_term, on_abort;
    sigset_t blocked;
    idx_t option[METIS_NOPTIONS];
    int status;

    METIS_SetDefaultOptions(option);
    if (g->start[g->n] > MANY_NEIGHBOURS * g->n) /* then fill differs by less from case to case, and is dear */
        option[METIS_OPTION_NSEPS] = 2;
    sigaction(SIGTERM, NULL, &on_term);
    sigaction(SIGABRT, NULL, &on_abort);
    pthread_sigmask(SIG_SETMASK, NULL, &blocked);
    status = METIS_NodeND(&g->n, g->start, g->to, g->weight, option, g->perm, g->perm + g->n);
    sigaction(SIGTERM, &on_term, NULL);
    sigaction(SIGABRT, &on_abort, NULL);
    pthread_sigmask(SIG_SETMASK, &blocked, NULL);
    if (status == METIS_ERROR)
        raise(SIGTERM);
    return status == METIS_OK;
}

static void free_graph(node_graph *g)
{
    free(g->start);
    free(g->to);
    free(g->weight);
    free(g->perm);
    free(g->vertex);
}

/* Room for the graph, and which vertex each unknown is part of.  Edges are at most pairs of a node and a column of
 * one of its rows, taken once per node. */
static int open_graph(const pf_csr *a, node_graph *g)
{
    int64_t edges = 0;

    for (int64_t v = 0; v < a->n_node; v++) {
        int64_t most = 0;

        for (int64_t r = a->node[v]; r < a->node[v + 1]; r++)
            most += a->row[r + 1] - a->row[r];
        edges += most < a->n_node ? most : a->n_node;
    }
    if (a->n > IDX_MAX || edges > IDX_MAX)
        return 0;
    g->n = (idx_t)a->n_node;
    g->start = malloc(((size_t)g->n + 1) * sizeof *g->start);
    g->weight = malloc((size_t)g->n * sizeof *g->weight);
    g->perm = malloc(2 * (size_t)g->n * sizeof *g->perm);
    g->to = malloc((size_t)edges * sizeof *g->to);
    g->vertex = malloc((size_t)a->n * sizeof *g->vertex);
    if (!g->start || !g->weight || !g->perm || !g->to || !g->vertex)
        return 0;
    for (idx_t v = 0; v < g->n; v++)
        for (int64_t r = a->node[v]; r < a->node[v + 1]; r++)
            g->vertex[r] = v;
    return 1;
}

/* Two nodes are neighbours if any of their unknowns are; a node weighs as many unknowns as it has. */
static void fill_graph(const pf_csr *a, node_graph *g)
{
    idx_t *seen = g->perm, edges = 0; /* last vertex that has this one as a neighbour */

    for (idx_t v = 0; v < g->n; v++)
        seen[v] = -1;
    for (idx_t v = 0; v < g->n; v++) {
        g->start[v] = edges;
        g->weight[v] = (idx_t)(a->node[v + 1] - a->node[v]);
        seen[v] = v;
        for (int64_t k = a->row[a->node[v]]; k < a->row[a->node[v + 1]]; k++) {
            idx_t w = g->vertex[a->col[k]];

            if (seen[w] != v)
                g->to[edges++] = w;
            seen[w] = v;
        }
    }
    g->start[g->n] = edges;
}

/* Order of the unknowns by METIS on the graph of the nodes; perm[k] = k-th to eliminate.  That of the unknowns has
 * the same orders, as all unknowns of a node have the same neighbours, but is several times larger.  Returns 0 if
 * METIS finds none: no memory, too many entries for its integers. */
static int order_graph(const pf_csr *a, SuiteSparse_long *perm)
{
    node_graph g = {0};
    int ok = open_graph(a, &g);

    if (ok) {
        fill_graph(a, &g);
        for (idx_t v = 0; v < g.n; v++)
            g.perm[v] = v;
        ok = g.start[g.n] == 0 || dissect(&g);
    }
    for (int64_t v = 0, k = 0; ok && v < g.n; v++)
        for (int64_t r = a->node[g.perm[v]]; r < a->node[g.perm[v] + 1]; r++)
            perm[k++] = r;
    free_graph(&g);
    return ok;
}

/* Called by UMFPACK.  info = {longest column of L, entries of L, operations}. */
static int order_unknowns(SuiteSparse_long n, SuiteSparse_long n_col, SuiteSparse_long symmetric,
                          SuiteSparse_long *ap, SuiteSparse_long *ai, SuiteSparse_long *perm, void *arg,
                          double info[3])
{
    const umfpack *u = arg;
    const pf_csr *a = &u->a;
    cholmod_common cm;
    cholmod_sparse m = {.nrow = (size_t)n,
                        .ncol = (size_t)n,
                        .nzmax = (size_t)a->row[a->n],
                        .p = (void *)a->row,
                        .i = (void *)a->col,
                        .stype = 1,
                        .itype = CHOLMOD_LONG,
                        .xtype = CHOLMOD_PATTERN,
                        .dtype = CHOLMOD_DOUBLE,
                        .sorted = 1,
                        .packed = 1};
    cholmod_factor *l;
    int ordered;

    (void)ap;
    (void)ai;
    if (n != a->n || n != n_col || !symmetric)
        return 0;
    ordered = u->ordering == ORDER_METIS && order_graph(a, perm);
    cholmod_l_start(&cm);
    cm.nmethods = 1;
    cm.method[0].ordering = ordered ? CHOLMOD_GIVEN : CHOLMOD_AMD; /* AMD needs less memory, and leaves more fill */
    cm.supernodal = CHOLMOD_SIMPLICIAL;
    l = cholmod_l_analyze_p(&m, ordered ? perm : NULL, NULL, 0, &cm);
    if (l) {
        const SuiteSparse_long *count = l->ColCount;

        memcpy(perm, l->Perm, (size_t)n * sizeof *perm);
        info[0] = 0;
        for (int64_t k = 0; k < n; k++)
            info[0] = count[k] > info[0] ? (double)count[k] : info[0];
        info[1] = cm.lnz;
        info[2] = cm.fl;
    }
    ordered = l != NULL;
    cholmod_l_free_factor(&l, &cm);
    cholmod_l_finish(&cm);
    return ordered;
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
    u->control[UMFPACK_ORDERING] = UMFPACK_ORDERING_USER;
    u->control[UMFPACK_SINGLETONS] = 0;
    u->control[UMFPACK_IRSTEP] = 0;
    return PF_SOLVER_OK;
}

static int configure(void *self, const void *params, char *err, size_t nerr)
{
    const options *o = params;
    umfpack *u = self;

    (void)err, (void)nerr;
    u->ordering = o->ordering;
    u->control[UMFPACK_SYM_PIVOT_TOLERANCE] = o->pivot;
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
    int before;

    u->a = *matrix;
    umfpack_dl_free_numeric(&u->numeric);
    before = blas_threads(u->flops > THREADED_FLOPS ? u->n_thread : 1);
    status =
        umfpack_dl_numeric(matrix->row, matrix->col, matrix->value, u->symbolic, &u->numeric, u->control, NULL);
    blas_threads(before);
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
    const int before = blas_threads(1);
    /* the matrix may be gone: without refinement (IRSTEP = 0) it is asked for, but not read */
    SuiteSparse_long status =
        umfpack_dl_solve(UMFPACK_At, u->a.row, u->a.col, u->a.value, x, b, u->numeric, u->control, NULL);

    blas_threads(before);
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

static const char *const orderings[] = {"metis", "amd", NULL};
static const pf_param params[] = {
    {"ordering", "1", "by which the unknowns are eliminated: nested dissection, or least degree", PF_T_CHOICE, 0,
     offsetof(options, ordering), .choice = orderings},
    PF_NUMBER(options, pivot, "1", "least share of the largest entry of its column that a diagonal pivot has",
              .dflt = UMFPACK_DEFAULT_SYM_PIVOT_TOLERANCE, .min = 0, .max = 1),
};

static const pf_solver solver = {
    .size = sizeof(pf_solver),
    .major = PF_SOLVER_MAJOR,
    .name = "solver_umfpack",
    .version = "1.0",
    .doc = "sparse LU (UMFPACK, symmetric strategy, METIS)",
    .create = create,
    .analyze = analyze,
    .setup = setup,
    .solve = solve,
    .destroy = destroy,
    .n_param = sizeof params / sizeof *params,
    .param_size = sizeof *params,
    .params_bytes = sizeof(options),
    .param = params,
    .configure = configure,
};

__attribute__((visibility("default"))) const pf_solver *pf_solver_entry(char *err, size_t nerr);

const pf_solver *pf_solver_entry(char *err, size_t nerr)
{
    (void)err, (void)nerr;
    return &solver;
}
