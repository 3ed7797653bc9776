/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "solve/band.h"
#include "solve/instance.h"

#include "base/list.h"

#include <stdlib.h>
#include <string.h>

/* Part of all unknowns, and of the operations of a factorisation, above which a band does not pay. */
#define LARGEST 0.3
/* Operations of an analysis for each entry of the matrix, and of a solution for each of the factors: measured, as
 * times of a factorisation. */
#define ANALYSIS 250.0
#define SOLUTION 4.0

int band_create(band *b, const pf_solver *solver, const void *params, const space *s, int n_thread, error *err)
{
    memset(b, 0, sizeof *b);
    b->space = s;
    b->solver = solver;
    b->params = params;
    b->n_thread = n_thread;
    ARENA_NEW(&b->memory, b->then, s->mesh->n_cell, err);
    ARENA_NEW(&b->memory, b->now, s->mesh->n_cell, err);
    ARENA_NEW(&b->memory, b->cell, s->mesh->n_cell, err);
    ARENA_NEW(&b->memory, b->node, s->n_carrier, err);
    ARENA_NEW(&b->memory, b->dof_then, s->n_dof, err);
    ARENA_NEW(&b->memory, b->row, s->n_dof + 1, err);
    ARENA_NEW(&b->memory, b->node_row, s->n_carrier + 1, err);
    ARENA_NEW(&b->memory, b->unknown, s->n_dof, err);
    ARENA_NEW(&b->memory, b->number, s->n_dof, err);
    ARENA_NEW(&b->memory, b->rim, s->n_dof, err);
    ARENA_NEW(&b->memory, b->left, s->n_dof, err);
    ARENA_NEW(&b->memory, b->r, s->n_dof, err);
    ARENA_NEW(&b->memory, b->z, s->n_dof, err);
    ARENA_NEW(&b->memory, b->far_r, s->n_dof, err);
    ARENA_NEW(&b->memory, b->far_z, s->n_dof, err);
    return 0;
}

static void drop_solver(band *b)
{
    if (b->self)
        b->solver->destroy(b->self);
    b->self = NULL;
    b->ready = 0;
}

void band_destroy(band *b)
{
    drop_solver(b);
    free(b->col);
    free(b->value);
    arena_free(&b->memory);
    memset(b, 0, sizeof *b);
}

void band_place(band *b, const body_points *now)
{
    for (int64_t e = 0; e < b->space->mesh->n_cell; e++)
        b->now[e] = now->off[e] != 0;
    b->placed = 1;
    b->ready = 0;
}

void band_remember(band *b, int factors, const pf_solver_cost *cost, const pf_csr *a)
{
    b->factors = factors;
    b->placed = 0;
    drop_solver(b);
    memcpy(b->then, b->now, (size_t)b->space->mesh->n_cell);
    b->n_then = b->space->n_free;
    memcpy(b->dof_then, b->space->dof_of, (size_t)b->n_then * sizeof *b->dof_then);
    b->far = *cost;
    b->total = cost->flops + ANALYSIS * (double)a->row[a->n];
    b->flops = 0;
    b->solves = 1;
}

int band_pays(const band *b)
{
    return b->factors && b->flops * b->solves <= b->total;
}

void band_count(band *b, int applications)
{
    b->flops += applications * SOLUTION * (b->far.fill + 2 * b->cost.fill);
    b->total += b->flops;
    b->solves++;
}

/* The nodes of the cells that are marked. */
static void mark_nodes(band *b, const uint8_t *cell)
{
    const space *s = b->space;

    for (int64_t e = 0; e < s->mesh->n_cell; e++)
        for (int i = 0; cell[e] && i < s->mesh->type->n_node; i++)
            b->node[space_carrier(s, e, i)] = 1;
}

/* Carriers of the band: bodies, and the nodes of all cells that have one in common with a cell near bodies. */
static void mark_band(band *b)
{
    const space *s = b->space;

    memset(b->node, 0, (size_t)s->n_carrier);
    mark_nodes(b, b->then);
    mark_nodes(b, b->now);
    for (int64_t e = 0; e < s->mesh->n_cell; e++) {
        b->cell[e] = 0;
        for (int i = 0; i < s->mesh->type->n_node && !b->cell[e]; i++)
            b->cell[e] = b->node[space_carrier(s, e, i)];
    }
    mark_nodes(b, b->cell);
    for (int k = 0; k < s->n_particle; k++)
        b->node[space_body_carrier(s, k)] = 1;
}

/* Numbers the unknowns of the band, in the order and the groups of the matrix. */
static void number_band(band *b)
{
    const space *s = b->space;

    b->a = (pf_csr){.row = b->row, .node = b->node_row};
    memset(b->number, 0xff, (size_t)s->n_free * sizeof *b->number);
    for (int64_t c = 0; c < s->n_carrier; c++) {
        if (!b->node[c] || s->node_free[c] == s->node_free[c + 1])
            continue;
        b->node_row[b->a.n_node++] = b->a.n;
        for (int64_t i = s->node_free[c]; i < s->node_free[c + 1]; i++) {
            b->number[i] = (int32_t)b->a.n;
            b->unknown[b->a.n++] = (int32_t)i;
        }
    }
    b->node_row[b->a.n_node] = b->a.n;
}

/* Rows beside the band that have columns in it are the columns beside it that its rows have. */
static void find_rim(band *b, const pf_csr *a)
{
    enum { RIM = -2 };

    b->n_rim = 0;
    for (int64_t k = 0; k < b->a.n; k++)
        for (int64_t e = a->row[b->unknown[k]]; e < a->row[b->unknown[k] + 1]; e++) {
            int64_t j = pf_column(a, b->unknown[k], e);

            if (b->number[j] == -1) {
                b->number[j] = RIM;
                b->rim[b->n_rim++] = (int32_t)j;
            }
        }
}

/* R A R^T; its structure, too, unless it is known. */
static int take_matrix(band *b, const pf_csr *a, error *err)
{
    int64_t n = 0;

    for (int64_t k = 0; k < b->a.n; k++) {
        int64_t i = b->unknown[k], most = n + a->row[i + 1] - a->row[i];

        LIST_ROOM(b->col, most, &b->col_room, err);
        LIST_ROOM(b->value, most, &b->value_room, err);
        b->row[k] = n;
        for (int64_t e = a->row[i]; e < a->row[i + 1]; e++) {
            int32_t j = b->number[pf_column(a, i, e)];

            if (j < 0 || (b->space->unused && b->space->unused[e]))
                continue;
            b->col[n] = j;
            b->value[n++] = a->value[e];
        }
    }
    b->row[b->a.n] = n;
    b->a.col = b->col;
    b->a.value = b->value;
    return 0;
}

static int failed(const band *b, int status, const char *why, error *err)
{
    return error_set(err, status == PF_SOLVER_MEMORY ? ERR_MEMORY : ERR_CONVERGE, "linear solver %s: %s",
                     b->solver->name, why);
}

/* A solver for the band of a new placement. */
static int prepare(band *b, const pf_csr *a, error *err)
{
    char why[400] = "";
    int status;

    mark_band(b);
    number_band(b);
    b->same = b->n_then == b->space->n_free &&
              !memcmp(b->dof_then, b->space->dof_of, (size_t)b->n_then * sizeof *b->dof_then);
    if ((double)b->a.n > LARGEST * (double)a->n)
        return 0;
    find_rim(b, a);
    TRY(take_matrix(b, a, err));
    if (!b->self && (status = solver_instance(b->solver, b->params, b->n_thread, &b->self, why, sizeof why)))
        return failed(b, status, why, err);
    status = b->solver->analyze(b->self, &b->a, &b->cost, why, sizeof why);
    if (status)
        return failed(b, status, why, err);
    b->flops += ANALYSIS * (double)b->row[b->a.n];
    b->ready = b->cost.flops <= LARGEST * b->far.flops;
    return 0;
}

int band_setup(band *b, const pf_csr *a, int *done, error *err)
{
    char why[400] = "";
    int status;

    *done = 0;
    b->flops = 0;
    if (b->ready)
        TRY(take_matrix(b, a, err));
    else
        TRY(prepare(b, a, err));
    if (!b->ready)
        return 0;
    status = b->solver->setup(b->self, &b->a, why, sizeof why);
    b->flops += b->cost.flops;
    *done = status == PF_SOLVER_OK;
    return *done || status == PF_SOLVER_SINGULAR ? 0 : failed(b, status, why, err);
}

/* z += F^-1 r; what the earlier matrix did not have stays. */
static int add_far(band *b, void *far, const double *r, double *z, error *err)
{
    const space *s = b->space;
    char why[400] = "";
    int status;

    for (int64_t k = 0; !b->same && k < b->n_then; k++) {
        int32_t i = s->free_of[b->dof_then[k]];

        b->far_r[k] = i >= 0 ? r[i] : 0;
    }
    status = b->solver->solve(far, b->same ? r : b->far_r, b->far_z, why, sizeof why);
    if (status)
        return failed(b, status, why, err);
    for (int64_t k = 0; k < b->n_then; k++) {
        int64_t i = b->same ? k : s->free_of[b->dof_then[k]];

        if (i >= 0)
            z[i] += b->far_z[k];
    }
    return 0;
}

/* (r - A z) of row i */
static double left_of(const pf_csr *a, int64_t i, const double *r, const double *z)
{
    double left = r[i];

    for (int64_t e = a->row[i]; e < a->row[i + 1]; e++)
        left -= a->value[e] * z[pf_column(a, i, e)];
    return left;
}

/* z += R^T (R A R^T)^-1 of b->r */
static int add_near(band *b, double *z, error *err)
{
    char why[400] = "";
    int status = b->solver->solve(b->self, b->r, b->z, why, sizeof why);

    if (status)
        return failed(b, status, why, err);
    for (int64_t k = 0; k < b->a.n; k++)
        z[b->unknown[k]] += b->z[k];
    return 0;
}

int band_apply(band *b, const pf_csr *a, void *far, const double *r, double *z, error *err)
{
    for (int64_t k = 0; k < b->a.n; k++)
        b->r[k] = r[b->unknown[k]];
    memset(z, 0, (size_t)a->n * sizeof *z);
    TRY(add_near(b, z, err));
    memcpy(b->left, r, (size_t)a->n * sizeof *r);
    for (int64_t k = 0; k < b->a.n; k++) /* solved there */
        b->left[b->unknown[k]] = 0;
    for (int64_t k = 0; k < b->n_rim; k++)
        b->left[b->rim[k]] = left_of(a, b->rim[k], r, z);
    TRY(add_far(b, far, b->left, z, err));
    for (int64_t k = 0; k < b->a.n; k++)
        b->r[k] = left_of(a, b->unknown[k], r, z);
    return add_near(b, z, err);
}
