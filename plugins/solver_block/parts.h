/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * parts.h -- what the files of this plugin share: memory, sparse matrices of small blocks. */
#ifndef SOLVER_BLOCK_PARTS_H
#define SOLVER_BLOCK_PARTS_H

#include <plugflow/solver.h>

#include <stddef.h>
#include <stdint.h>

/* Memory with one owner; `failed` once there was none. */
typedef struct pool {
    void *last;
    int failed;
} pool;

void *pool_take(pool *p, int64_t count, size_t size); /* zeroed, 64-byte aligned, with 64 bytes to spare; or NULL */
void pool_free(pool *p);
#define TAKE(p, to, count) ((to) = pool_take((p), (count), sizeof *(to)))

/* Room for each thread to find columns in; NULL if there was none. */
int64_t **pool_markers(pool *p, int n_thread, int64_t n);

/* Rows of blocks b x b, in single precision, each column by column; columns ascend within a row. */
typedef struct block_matrix {
    int32_t n, b;
    int64_t *row;      /* [n + 1] */
    int32_t *col;      /* [row[n]] */
    int64_t *diagonal; /* [n] entry of each diagonal block */
    float *value;      /* [row[n]][b * b] */
    /* Rows part[k] .. part[k+1]-1, k < n_part, know nothing of each other; the rest couples them. */
    int n_part;
    int32_t *part; /* [n_part + 1] */
} block_matrix;

/* Entries of a matrix from which threads are worth their start. */
#define THREADED (1 << 17)

/* y = A x, of blocks. */
void block_multiply(const block_matrix *a, int n_thread, const float *x, float *y);

/* Sparse matrix of numbers. */
typedef struct sparse {
    int32_t n, n_col;
    int64_t *row;
    int32_t *col;
    double *value;
} sparse;

/* Rows of thread t of n_thread, which makes them in two passes: row[i+1] is a count first, then where i+1 begins.
 */
#define ROWS_OF_THREAD(i, n, t, n_thread)                                                                          \
    int32_t i = (int32_t)((int64_t)(n) * (t) / (n_thread));                                                        \
    i < (int32_t)((int64_t)(n) * ((t) + 1) / (n_thread));                                                          \
    i++
void rows_begin(int32_t n, int64_t *row);

void sparse_multiply(const sparse *a, int n_thread, const double *x, double *y);

#endif
