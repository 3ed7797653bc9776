/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "split.h"

#include <math.h>
#include <string.h>

int split_fits(const pf_csr *a, int *pressure, const char **why)
{
    const pf_unknowns *u = a->unknowns;
    int n = 0, vector = 0;

    *why = NULL;
    if (!u)
        *why = "nothing is known of the unknowns";
    for (int f = 0; u && f < u->n_field; f++) {
        const pf_row_field *q = &u->field[f];

        if (q->inside)
            *why = "there are multipliers inside of bodies; formulation \"sharp\" has none";
        vector |= q->order == 2 && q->n_comp == u->dim;
        if (q->order == 1 && q->n_comp == 1) {
            if (n == 0 || strcmp(q->name, "p") == 0)
                *pressure = f;
            n++;
        }
    }
    for (int64_t g = 0; !*why && g < a->n_node; g++)
        if (u->kind[g] == PF_ROWS_OF_NODE && u->field[u->field_of[a->node[g]]].order == 0)
            *why = "a field has one value a cell";
    if (!*why && (!vector || n == 0))
        *why = "there is no pair of a velocity of second order and a pressure of first order";
    else if (!*why && n > 1 && strcmp(u->field[*pressure].name, "p") != 0)
        *why = "several fields might be the pressure, and none is called \"p\"";
    return *why != NULL;
}

/* Blocks in the order of the rows: first_block of each group; a field begins a block. */
static void number_blocks(split *s, int32_t *first_block, int32_t *group_of, pool *p)
{
    const pf_csr *a = s->a;
    const pf_unknowns *u = a->unknowns;
    int32_t n = 0;

    s->n_p = 0;
    for (int64_t g = 0; g < a->n_node; g++) {
        first_block[g] = n;
        for (int64_t r = a->node[g]; r < a->node[g + 1]; r++) {
            group_of[r] = (int32_t)g;
            if (u->field_of[r] == s->pressure) {
                s->block[r] = -1 - s->n_p++;
                continue;
            }
            if (r == a->node[g] || u->field_of[r] != u->field_of[r - 1] ||
                u->comp_of[r] % s->b <= u->comp_of[r - 1] % s->b)
                n++;
            s->block[r] = n - 1;
            s->slot[r] = (uint8_t)(u->comp_of[r] % s->b);
        }
    }
    first_block[a->n_node] = n;
    s->f.n = n;
    s->f.b = s->b;
    TAKE(p, s->row_of_p, s->n_p + 1);
    for (int64_t r = 0; !p->failed && r < a->n; r++)
        if (s->block[r] < 0)
            s->row_of_p[-1 - s->block[r]] = (int32_t)r;
}

/* Whether a neighbour of the group is in a later part, or is none of the mesh. */
static int is_between(const split *s, const int32_t *group_of, const int32_t *part_of, int64_t g)
{
    const pf_csr *a = s->a;
    int64_t r = a->node[g];
    int between = a->unknowns->kind[g] != PF_ROWS_OF_NODE;

    for (int64_t k = a->row[r]; k < a->row[r + 1] && !between; k++) {
        int64_t h = group_of[pf_column(a, r, k)];

        between = a->unknowns->kind[h] == PF_ROWS_OF_NODE && part_of[h] > part_of[g];
    }
    return between;
}

/* order[block]: its number among the parts, then what lies between them, the bodies last. */
static void order_blocks(split *s, const int32_t *first_block, const int32_t *group_of, int32_t *order, pool *p)
{
    const pf_csr *a = s->a;
    int32_t *part_of, n = 0;
    uint8_t *between;

    TAKE(p, part_of, a->n_node + 1);
    TAKE(p, between, a->n_node + 1);
    if (p->failed)
        return;
    s->f.n_part = s->n_thread;
    for (int64_t g = 0; g < a->n_node; g++)
        part_of[g] = (int32_t)((double)a->row[a->node[g]] / ((double)a->row[a->n] + 1) * s->f.n_part);
    for (int64_t g = 0; g < a->n_node; g++)
        between[g] = (uint8_t)is_between(s, group_of, part_of, g);
    for (int part = 0; part <= s->f.n_part; part++) {
        s->f.part[part] = n;
        for (int64_t g = 0; g < a->n_node; g++)
            if (part < s->f.n_part ? part_of[g] == part && !between[g] : between[g])
                for (int32_t i = first_block[g]; i < first_block[g + 1]; i++)
                    order[i] = n++;
    }
}

/* Columns of the blocks of group g, in the new order: those before `limit`, or from it on. */
static int64_t add_columns(const split *s, const int32_t *first_block, const int32_t *group_of,
                           const int32_t *order, int64_t g, int32_t limit, int late, int32_t *to)
{
    const pf_csr *a = s->a;
    int64_t n = 0, last = -1;

    for (int64_t k = a->row[a->node[g]]; k < a->row[a->node[g] + 1]; k++) {
        int64_t h = group_of[pf_column(a, a->node[g], k)];

        if (h == last)
            continue;
        last = h;
        for (int32_t i = first_block[h]; i < first_block[h + 1]; i++)
            if ((order[i] >= limit) == late) {
                if (to)
                    to[n] = order[i];
                n++;
            }
    }
    return n;
}

static int64_t add_pressures(const split *s, int64_t g, int32_t *to)
{
    const pf_csr *a = s->a;
    int64_t n = 0;

    for (int64_t k = a->row[a->node[g]]; k < a->row[a->node[g] + 1]; k++)
        if (s->block[pf_column(a, a->node[g], k)] < 0) {
            if (to)
                to[n] = -1 - s->block[pf_column(a, a->node[g], k)];
            n++;
        }
    return n;
}

/* Patterns of all four blocks: pass 0 counts, pass 1 fills. */
static void find_patterns(split *s, const int32_t *first_block, const int32_t *group_of, const int32_t *order,
                          const int64_t *natural, pool *p)
{
    int32_t limit = s->f.part[s->f.n_part];

    TAKE(p, s->f.row, s->f.n + 1);
    TAKE(p, s->f.diagonal, s->f.n + 1);
    TAKE(p, s->g_row, s->f.n + 1);
    TAKE(p, s->d_row, s->n_p + 1);
    TAKE(p, s->c.row, s->n_p + 1);
    for (int pass = 0; pass < 2 && !p->failed; pass++) {
        for (int32_t i = 0; i < s->f.n; i++) {
            int64_t g = natural[i], at = s->f.row[i];
            int32_t *to = pass ? s->f.col + at : NULL;
            int64_t n = add_columns(s, first_block, group_of, order, g, limit, 0, to);

            n += add_columns(s, first_block, group_of, order, g, limit, 1, pass ? to + n : NULL);
            s->f.row[i + 1] = at + n;
            for (int64_t k = 0; pass && k < n; k++)
                s->f.diagonal[i] = to[k] == i ? at + k : s->f.diagonal[i];
            s->g_row[i + 1] = s->g_row[i] + add_pressures(s, g, pass ? s->g_col + s->g_row[i] : NULL);
        }
        for (int32_t i = 0; i < s->n_p; i++) {
            int64_t g = group_of[s->row_of_p[i]], at = s->d_row[i];
            int64_t n = add_columns(s, first_block, group_of, order, g, limit, 0, pass ? s->d_col + at : NULL);

            n += add_columns(s, first_block, group_of, order, g, limit, 1, pass ? s->d_col + at + n : NULL);
            s->d_row[i + 1] = at + n;
            s->c.row[i + 1] = s->c.row[i] + add_pressures(s, g, pass ? s->c.col + s->c.row[i] : NULL);
        }
        if (pass)
            break;
        TAKE(p, s->f.col, s->f.row[s->f.n] + 1);
        TAKE(p, s->g_col, s->g_row[s->f.n] + 1);
        TAKE(p, s->d_col, s->d_row[s->n_p] + 1);
        TAKE(p, s->c.col, s->c.row[s->n_p] + 1);
    }
}

void split_analyze(split *s, const pf_csr *a, int pressure, int n_thread, pool *p)
{
    pool scratch = {0};
    int32_t *first_block, *group_of, *order;
    int64_t *natural;

    memset(s, 0, sizeof *s);
    s->a = a;
    s->n = a->n;
    s->b = a->unknowns->dim;
    s->pressure = pressure;
    s->n_thread = n_thread;
    TAKE(p, s->block, a->n);
    TAKE(p, s->slot, a->n);
    TAKE(&scratch, first_block, a->n_node + 1);
    TAKE(&scratch, group_of, a->n);
    if (!p->failed && !scratch.failed)
        number_blocks(s, first_block, group_of, p);
    TAKE(&scratch, order, s->f.n + 1);
    TAKE(&scratch, natural, s->f.n + 1);
    TAKE(p, s->row_of, (int64_t)s->f.n * s->b + 1);
    TAKE(p, s->group, s->f.n + 1);
    TAKE(p, s->is_global, s->f.n + 1);
    TAKE(p, s->active, (int64_t)s->f.n * s->b + 1);
    TAKE(p, s->active_p, s->n_p + 1);
    TAKE(p, s->f.part, n_thread + 1);
    TAKE(p, s->where, n_thread);
    for (int t = 0; t < n_thread && !p->failed; t++)
        TAKE(p, s->where[t], (int64_t)s->f.n + s->n_p + 1);
    if (!p->failed && !scratch.failed)
        order_blocks(s, first_block, group_of, order, &scratch);
    if (!p->failed && !scratch.failed) {
        memset(s->row_of, 0xff, (size_t)s->f.n * (size_t)s->b * sizeof *s->row_of);
        for (int64_t r = 0; r < a->n; r++)
            if (s->block[r] >= 0) {
                s->block[r] = order[s->block[r]];
                natural[s->block[r]] = group_of[r];
                s->group[s->block[r]] = group_of[r];
                s->is_global[s->block[r]] = a->unknowns->kind[group_of[r]] != PF_ROWS_OF_NODE;
                s->row_of[(int64_t)s->block[r] * s->b + s->slot[r]] = (int32_t)r;
            }
    }
    if (!p->failed && !scratch.failed)
        find_patterns(s, first_block, group_of, order, natural, p);
    p->failed |= scratch.failed;
    pool_free(&scratch);
    if (p->failed)
        return;
    s->c.n = s->c.n_col = s->n_p;
    TAKE(p, s->f.value, s->f.row[s->f.n] * s->b * s->b);
    TAKE(p, s->g, s->g_row[s->f.n] * s->b);
    TAKE(p, s->d, s->d_row[s->n_p] * s->b);
    TAKE(p, s->c.value, s->c.row[s->n_p] + 1);
    TAKE(p, s->inverse_diagonal, (int64_t)s->f.n * s->b);
}

/* Entries of one row. */
static void fill_row(split *s, const pf_csr *a, int32_t i, int r, const int32_t *where)
{
    int b = s->b;
    int64_t row = s->row_of[(int64_t)i * b + r];
    float *f = s->f.value + s->f.row[i] * b * b + r, *g = s->g + s->g_row[i] * b + r;

    for (int64_t k = a->row[row]; k < a->row[row + 1]; k++) {
        int64_t j = pf_column(a, row, k);
        int32_t block = s->block[j];

        if (block >= 0)
            f[(int64_t)where[block] * b * b + s->slot[j] * b] = (float)a->value[k];
        else
            g[(int64_t)where[s->f.n - 1 - block] * b] = (float)a->value[k];
    }
}

/* The same of all three rows of a block, whose columns are the same. */
static void fill_three_rows(split *s, const pf_csr *a, int32_t i, const int32_t *where)
{
    const int32_t *row = s->row_of + (int64_t)i * 3;
    const double *v[3] = {a->value + a->row[row[0]], a->value + a->row[row[1]], a->value + a->row[row[2]]};
    const int64_t n = a->row[row[0] + 1] - a->row[row[0]];
    float *f = s->f.value + s->f.row[i] * 9, *g = s->g + s->g_row[i] * 3;

    for (int64_t k = 0; k < n; k++) {
        int64_t j = pf_column(a, row[0], a->row[row[0]] + k);
        int32_t block = s->block[j];
        float *to = block >= 0 ? f + where[block] * 9 + s->slot[j] * 3 : g + where[s->f.n - 1 - block] * 3;

        for (int r = 0; r < 3; r++)
            to[r] = (float)v[r][k];
    }
}

/* Rows of one block, of F and G. */
static void fill_block(split *s, const pf_csr *a, int32_t i, int32_t *where)
{
    int b = s->b;
    const int32_t *rows = s->row_of + (int64_t)i * b;
    int whole = b == 3 && rows[0] >= 0 && rows[1] >= 0 && rows[2] >= 0 &&
                a->row[rows[1] + 1] - a->row[rows[1]] == a->row[rows[0] + 1] - a->row[rows[0]] &&
                a->row[rows[2] + 1] - a->row[rows[2]] == a->row[rows[0] + 1] - a->row[rows[0]];
    float *diagonal = s->f.value + s->f.diagonal[i] * b * b;

    for (int64_t k = s->f.row[i]; k < s->f.row[i + 1]; k++)
        where[s->f.col[k]] = (int32_t)(k - s->f.row[i]);
    for (int64_t k = s->g_row[i]; k < s->g_row[i + 1]; k++)
        where[s->f.n + s->g_col[k]] = (int32_t)(k - s->g_row[i]);
    memset(s->f.value + s->f.row[i] * b * b, 0, (size_t)((s->f.row[i + 1] - s->f.row[i]) * b * b) * sizeof(float));
    if (whole)
        fill_three_rows(s, a, i, where);
    for (int r = 0; r < b; r++) {
        float *d = &s->inverse_diagonal[(int64_t)i * b + r];

        s->active[(int64_t)i * b + r] = rows[r] >= 0 && !a->unknowns->idle[rows[r]];
        if (rows[r] < 0)
            diagonal[r * b + r] = 1;
        else if (!whole)
            fill_row(s, a, i, r, where);
        *d = fabsf(diagonal[r * b + r]) > 1e-30F && s->active[(int64_t)i * b + r] ? 1 / diagonal[r * b + r] : 1;
    }
}

static void fill_pressure(split *s, const pf_csr *a, int32_t i, int32_t *where)
{
    int b = s->b;
    int32_t *where_p = where + s->f.n;
    int64_t row = s->row_of_p[i];

    s->active_p[i] = !a->unknowns->idle[row];
    for (int64_t k = s->d_row[i]; k < s->d_row[i + 1]; k++)
        where[s->d_col[k]] = (int32_t)(k - s->d_row[i]);
    for (int64_t k = s->c.row[i]; k < s->c.row[i + 1]; k++)
        where_p[s->c.col[k]] = (int32_t)(k - s->c.row[i]);
    for (int64_t k = a->row[row]; k < a->row[row + 1]; k++) {
        int64_t j = pf_column(a, row, k);
        int32_t block = s->block[j];

        if (block >= 0)
            s->d[(s->d_row[i] + where[block]) * b + s->slot[j]] = (float)a->value[k];
        else
            s->c.value[s->c.row[i] + where_p[-1 - block]] = a->value[k];
    }
}

void split_fill(split *s, const pf_csr *a)
{
    s->a = a;
    s->gauge = a->unknowns->free_fields >> s->pressure & 1;
#pragma omp parallel for num_threads(s->n_thread) schedule(static, 1)
    for (int t = 0; t < s->n_thread; t++) {
        int64_t n = s->f.n, m = s->n_p;

        for (int64_t i = n * t / s->n_thread; i < n * (t + 1) / s->n_thread; i++)
            fill_block(s, a, (int32_t)i, s->where[t]);
        for (int64_t i = m * t / s->n_thread; i < m * (t + 1) / s->n_thread; i++)
            fill_pressure(s, a, (int32_t)i, s->where[t]);
    }
}

void split_gradient(const split *s, const double *p, double scale, float *v)
{
    int b = s->b;

#pragma omp parallel for num_threads(s->n_thread) if (s->g_row[s->f.n] > THREADED / 3) schedule(static)
    for (int32_t i = 0; i < s->f.n; i++) {
        float sum[3] = {0};

        for (int64_t k = s->g_row[i]; k < s->g_row[i + 1]; k++)
            for (int c = 0; c < b; c++)
                sum[c] += s->g[k * b + c] * (float)(s->active_p[s->g_col[k]] ? scale * p[s->g_col[k]] : 0);
        for (int c = 0; c < b; c++)
            v[(int64_t)i * b + c] = sum[c];
    }
}

void split_divergence(const split *s, const float *v, double *q)
{
    int b = s->b;

#pragma omp parallel for num_threads(s->n_thread) if (s->g_row[s->f.n] > THREADED / 3) schedule(static)
    for (int32_t i = 0; i < s->n_p; i++) {
        double sum = 0;

        for (int64_t k = s->d_row[i]; k < s->d_row[i + 1] && s->active_p[i]; k++)
            for (int c = 0; c < b; c++)
                sum += s->d[k * b + c] * v[(int64_t)s->d_col[k] * b + c];
        q[i] = sum;
    }
}
