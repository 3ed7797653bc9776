/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "levels.h"
#include "galerkin.h"

#include <math.h>
#include <string.h>

enum { COARSEST = 500 }; /* blocks */

/* The block of a field at a node that holds components part * b and on, or -1. */
static int32_t block_at(const split *s, int64_t group, int field, int part)
{
    const pf_unknowns *u = s->a->unknowns;

    for (int64_t r = s->a->node[group]; r < s->a->node[group + 1]; r++)
        if (u->field_of[r] == field && s->block[r] >= 0 && u->comp_of[r] / s->b == part)
            return s->block[r];
    return -1;
}

/* Any row of a block. */
static int64_t some_row(const split *s, int32_t i)
{
    int c = 0;

    while (s->row_of[(int64_t)i * s->b + c] < 0)
        c++;
    return s->row_of[(int64_t)i * s->b + c];
}

/* Velocities from linear functions: vertices and what is no node stay, other nodes lie between their parents. */
static void from_vertices(levels *l)
{
    const split *s = l->s;
    const pf_unknowns *u = s->a->unknowns;
    sparse *q = &l->prolong;
    int32_t *coarse;

    TAKE(&l->memory, coarse, s->f.n + 1);
    TAKE(&l->memory, q->row, s->f.n + 1);
    TAKE(&l->memory, q->col, (int64_t)s->f.n * 8 + 1);
    TAKE(&l->memory, q->value, (int64_t)s->f.n * 8 + 1);
    if (l->memory.failed)
        return;
    q->n = s->f.n;
    for (int32_t i = 0; i < s->f.n; i++)
        coarse[i] = u->parent[s->group[i] + 1] == u->parent[s->group[i]] ? q->n_col++ : -1;
    for (int32_t i = 0; i < s->f.n; i++) {
        int64_t g = s->group[i], n = q->row[i], row = some_row(s, i);

        if (coarse[i] >= 0) {
            q->col[n] = coarse[i];
            q->value[n++] = 1;
        }
        for (int64_t k = u->parent[g]; coarse[i] < 0 && k < u->parent[g + 1]; k++) {
            int32_t from = block_at(s, u->parent_node[k], u->field_of[row], u->comp_of[row] / s->b);

            if (from < 0 || coarse[from] < 0)
                continue;
            q->col[n] = coarse[from];
            q->value[n++] = u->parent_weight[k];
        }
        q->row[i + 1] = n;
    }
}

/* Places of the next level that take part: those that some place of this one is interpolated from. */
static void activate(const sparse *prolong, const uint8_t *fine, int b, uint8_t *coarse)
{
    for (int32_t i = 0; i < prolong->n; i++)
        for (int64_t k = prolong->row[i]; k < prolong->row[i + 1]; k++)
            for (int c = 0; c < b; c++)
                coarse[(int64_t)prolong->col[k] * b + c] |= fine[(int64_t)i * b + c];
}

/* Columns of a row ascend, as the factorisation expects. */
static void sort_row(block_matrix *a, int32_t i)
{
    int bb = a->b * a->b;

    for (int64_t k = a->row[i] + 1; k < a->row[i + 1]; k++) {
        int32_t col = a->col[k];
        int64_t to = k;
        float block[9];

        memcpy(block, a->value + k * bb, (size_t)bb * sizeof *block);
        for (; to > a->row[i] && a->col[to - 1] > col; to--) {
            a->col[to] = a->col[to - 1];
            memcpy(a->value + to * bb, a->value + (to - 1) * bb, (size_t)bb * sizeof *block);
        }
        a->col[to] = col;
        memcpy(a->value + to * bb, block, (size_t)bb * sizeof *block);
    }
}

/* Places that do not take part get a row and a column of the identity. */
static void close_level(velocity_level *l)
{
    int b = l->a.b;

    for (int32_t i = 0; i < l->a.n; i++) {
        sort_row(&l->a, i);
        for (int64_t k = l->a.row[i]; k < l->a.row[i + 1]; k++) {
            float *at = l->a.value + k * b * b;

            l->a.diagonal[i] = l->a.col[k] == i ? k : l->a.diagonal[i];
            for (int e = 0; e < b * b; e++)
                if (!l->active[(int64_t)i * b + e % b] || !l->active[(int64_t)l->a.col[k] * b + e / b])
                    at[e] = l->a.col[k] == i && e % b == e / b;
        }
    }
}

/* Mean of the diagonals of the blocks: what aggregates are made by. */
static void take_scalar(const velocity_level *l, sparse *t, pool *p)
{
    const block_matrix *a = &l->a;
    int b = a->b;

    *t = (sparse){.n = a->n, .n_col = a->n, .row = a->row, .col = a->col};
    TAKE(p, t->value, a->row[a->n] + 1);
    for (int64_t k = 0; !p->failed && k < a->row[a->n]; k++)
        for (int c = 0; c < b; c++)
            t->value[k] += a->value[k * b * b + c * b + c] / (double)b;
}

/* Prolongation from aggregates; the last `n_kept` blocks stay what they are. */
static void from_aggregates(velocity_level *l, int32_t n_kept, double strength, pool *p)
{
    pool scratch = {0};
    uint8_t *mine;
    sparse t, q;

    TAKE(&scratch, mine, l->a.n + 1);
    take_scalar(l, &t, &scratch);
    p->failed |= scratch.failed;
    if (p->failed) {
        pool_free(&scratch);
        return;
    }
    memset(mine, 1, (size_t)(l->a.n - n_kept));
    aggregate(&t, mine, strength, &q, &scratch);
    l->prolong = (sparse){.n = l->a.n, .n_col = q.n_col + n_kept};
    TAKE(p, l->prolong.row, l->a.n + 1);
    if (!scratch.failed)
        TAKE(p, l->prolong.col, q.row[q.n] + n_kept + 1);
    if (!scratch.failed)
        TAKE(p, l->prolong.value, q.row[q.n] + n_kept + 1);
    p->failed |= scratch.failed;
    for (int32_t i = 0; i < l->a.n && !p->failed; i++) {
        int64_t n = l->prolong.row[i];

        for (int64_t k = q.row[i]; i < l->a.n - n_kept && k < q.row[i + 1]; k++) {
            l->prolong.col[n] = q.col[k];
            l->prolong.value[n++] = q.value[k];
        }
        if (i >= l->a.n - n_kept) {
            l->prolong.col[n] = q.n_col + i - (l->a.n - n_kept);
            l->prolong.value[n++] = 1;
        }
        l->prolong.row[i + 1] = n;
    }
    pool_free(&scratch);
}

static int factor_coarse(levels *l)
{
    const block_matrix *a = &l->level[l->n_level - 1].a;
    int b = a->b;
    int64_t n = (int64_t)a->n * b, at = 0;
    sparse t = {.n = (int32_t)n, .n_col = (int32_t)n};

    if (n > INT32_MAX)
        return PF_SOLVER_MEMORY;
    TAKE(&l->memory, t.row, n + 1);
    TAKE(&l->memory, t.col, a->row[a->n] * b * b + 1);
    TAKE(&l->memory, t.value, a->row[a->n] * b * b + 1);
    TAKE(&l->memory, l->coarse_x, n + 1);
    TAKE(&l->memory, l->coarse_b, n + 1);
    if (l->memory.failed)
        return PF_SOLVER_MEMORY;
    for (int64_t i = 0; i < n; i++) {
        for (int64_t k = a->row[i / b]; k < a->row[i / b + 1]; k++)
            for (int c = 0; c < b; c++) {
                t.col[at] = a->col[k] * b + c;
                t.value[at++] = a->value[k * b * b + c * b + i % b];
            }
        t.row[i + 1] = at;
    }
    return coarse_factor(&l->coarse, &t, &l->memory);
}

/* The level that `prolong` comes from, of the matrix a. */
static void next_level(levels *l, const block_matrix *a, const uint8_t *active, sparse *prolong, sparse *restrict_)
{
    velocity_level *n = &l->level[l->n_level++];
    pool *p = &l->memory;
    int b = a->b;

    sparse_transpose(prolong, restrict_, p);
    TAKE(p, n->active, (int64_t)prolong->n_col * b + 1);
    TAKE(p, n->x, (int64_t)prolong->n_col * b + 1);
    TAKE(p, n->b, (int64_t)prolong->n_col * b + 1);
    TAKE(p, n->r, (int64_t)prolong->n_col * b + 1);
    if (p->failed)
        return;
    activate(prolong, active, b, n->active);
    galerkin(a, active, prolong, restrict_, l->s->n_thread, &n->a, p);
    if (!p->failed)
        close_level(n);
}

static void factor_level(velocity_level *l, pool *p)
{
    l->a.n_part = 1;
    TAKE(p, l->a.part, 2);
    if (p->failed)
        return;
    l->a.part[1] = l->a.n;
    ilu_create(&l->factors, &l->a, p);
    if (!p->failed)
        ilu_factor(&l->factors, 1);
}

int levels_create(levels *l, const split *s, const options *o)
{
    int32_t n_kept = 0;

    memset(l, 0, sizeof *l);
    l->s = s;
    l->o = o;
    for (int32_t i = s->f.n - 1; i >= 0 && s->a->unknowns->kind[s->group[i]] != PF_ROWS_OF_NODE; i--)
        n_kept++;
    TAKE(&l->memory, l->r, (int64_t)s->f.n * s->b);
    from_vertices(l);
    if (!l->memory.failed)
        next_level(l, &s->f, s->active, &l->prolong, &l->restrict_);
    while (!l->memory.failed && l->n_level < LEVELS_MOST) {
        velocity_level *n = &l->level[l->n_level - 1];

        if (n->a.n <= COARSEST)
            break;
        from_aggregates(n, n_kept, o->strength, &l->memory);
        if (l->memory.failed || n->prolong.n_col == n_kept || n->prolong.n_col > 0.8 * n->a.n)
            break;
        next_level(l, &n->a, n->active, &n->prolong, &n->restrict_);
        if (!l->memory.failed)
            factor_level(n, &l->memory);
    }
    return l->memory.failed ? PF_SOLVER_MEMORY : factor_coarse(l);
}

void levels_destroy(levels *l)
{
    coarse_destroy(&l->coarse);
    pool_free(&l->memory);
    memset(l, 0, sizeof *l);
}

/* y = q x, with the same share for all places of a block, of those that are active. */
static void apply_shares(const sparse *q, int b, int n_thread, const uint8_t *active, const float *x, float *y)
{
#pragma omp parallel for num_threads(n_thread) if (q->row[q->n] > THREADED) schedule(static)
    for (int32_t i = 0; i < q->n; i++)
        for (int c = 0; c < b; c++) {
            double v = 0;

            for (int64_t k = q->row[i]; k < q->row[i + 1]; k++)
                v += q->value[k] * x[(int64_t)q->col[k] * b + c];
            y[(int64_t)i * b + c] = !active || active[(int64_t)i * b + c] ? (float)v : 0;
        }
}

/* One iteration by the incomplete factors: where convection prevails over viscosity Gauss-Seidel diverges. */
static void relax(const velocity_level *l, int n_thread)
{
    int64_t n = (int64_t)l->a.n * l->a.b;

    block_multiply(&l->a, n_thread, l->x, l->r);
    for (int64_t i = 0; i < n; i++)
        l->r[i] = l->b[i] - l->r[i];
    ilu_solve(&l->factors, 1, l->r, l->r);
    for (int64_t i = 0; i < n; i++)
        l->x[i] += l->r[i];
}

static void solve_coarse(levels *l, const velocity_level *n)
{
    int64_t size = (int64_t)n->a.n * n->a.b;

    for (int64_t i = 0; i < size; i++)
        l->coarse_b[i] = n->b[i];
    coarse_solve(&l->coarse, l->coarse_b, l->coarse_x);
    for (int64_t i = 0; i < size; i++)
        n->x[i] = (float)l->coarse_x[i];
}

void levels_correct(levels *l, const float *q, float *u)
{
    const split *s = l->s;
    int b = s->b, last = l->n_level - 1;

    for (int64_t i = 0; i < (int64_t)s->f.n * b; i++)
        l->r[i] = s->active[i] ? q[i] : 0;
    apply_shares(&l->restrict_, b, s->n_thread, l->level[0].active, l->r, l->level[0].b);
    for (int k = 0; k < last; k++)
        apply_shares(&l->level[k].restrict_, b, s->n_thread, l->level[k + 1].active, l->level[k].b,
                     l->level[k + 1].b);
    solve_coarse(l, &l->level[last]);
    for (int k = last - 1; k >= 0; k--) {
        apply_shares(&l->level[k].prolong, b, s->n_thread, l->level[k].active, l->level[k + 1].x, l->level[k].x);
        for (int m = 0; m < l->o->sweeps; m++)
            relax(&l->level[k], s->n_thread);
    }
    apply_shares(&l->prolong, b, s->n_thread, s->active, l->level[0].x, u);
}
