/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Adding element vectors and matrices to the global ones.
 *
 * A row of the element matrices of a batch has a vector of 8 lanes for every column.  Blocks of 8 x 8 are
 * transposed, so that each item has its row in one piece; what lies side by side in the matrix, too, is then added
 * as a run. */
#include "assemble/batch.h"

#include <string.h>

enum { MOST_SEGMENTS = ELEMENT_MOST_ENTRIES };

typedef double v8_anywhere __attribute__((vector_size(64), aligned(8)));
typedef double v4_anywhere __attribute__((vector_size(32), aligned(8)));
typedef double v2_anywhere __attribute__((vector_size(16), aligned(8)));

static int is_of_body(const assembly *a, const assembly_class *c, int entry)
{
    return a->space->field[c->layout.field[entry]].support == PF_ON_PARTICLE;
}

void scatter_vector(const assembly *a, const assembly_class *c, int64_t batch, int slab, const workspace *w,
                    double *residual)
{
    for (int64_t item = c->batch[batch]; item < c->batch[batch + 1]; item++) {
        const int32_t *restrict dof = c->dof + item * c->layout.n;
        const body_share *share = shares_at(a, c, slab, item);
        int l = (int)(item - c->batch[batch]);

        for (int e = 0; e < c->layout.n; e++)
            if (dof[e] >= 0)
                *(share && is_of_body(a, c, e) ? &a->share_sum[share->at + e] : &residual[dof[e]]) += w->vec[e][l];
    }
}

/* Columns of the element matrix that are columns of one carrier in the matrix, one beside the other. */
typedef struct segment {
    int from, n, carrier, column; /* column: the first, within those of the carrier */
} segment;

/* The same where these are: entries from `from` on belong to those from `to` on. */
typedef struct run {
    int from, n, to;
} run;

/* Free columns of the fields on an item. */
static int find_segments(const assembly *a, const element_layout *p, const int32_t *dof, uint32_t fields,
                         segment *list)
{
    int n = 0;

    for (int e = 0; e < p->n; e++) {
        int column = dof[e] < 0 || !(fields >> p->field[e] & 1) ? -1 : a->column_of[dof[e]];
        segment *s = n ? &list[n - 1] : NULL;

        if (column < 0)
            continue;
        if (s && s->carrier == p->carrier[e] && s->from + s->n == e && s->column + s->n == column)
            s->n++;
        else
            list[n++] = (segment){e, 1, p->carrier[e], column};
    }
    return n;
}

/* Segments in the rows of one carrier, as few runs as there are; pair: where the columns of each carrier start. */
static int find_runs(const segment *s, int n, const int32_t *pair, run *list)
{
    run *last = list - 1;

    for (int i = 0; i < n; i++) {
        int to = pair[s[i].carrier] + s[i].column;

        if (i && last->from + last->n == s[i].from && last->to + last->n == to)
            last->n += s[i].n;
        else
            *++last = (run){s[i].from, s[i].n, to};
    }
    return (int)(last - list) + 1;
}

static void transpose(const v8 *restrict in, v8 *restrict out, int stride)
{
    typedef long long i8 __attribute__((vector_size(64)));
    const i8 low = {0, 8, 2, 10, 4, 12, 6, 14}, high = {1, 9, 3, 11, 5, 13, 7, 15};
    const i8 low2 = {0, 1, 8, 9, 4, 5, 12, 13}, high2 = {2, 3, 10, 11, 6, 7, 14, 15};
    const i8 low4 = {0, 1, 2, 3, 8, 9, 10, 11}, high4 = {4, 5, 6, 7, 12, 13, 14, 15};
    v8 a[8], b[8];

    for (int k = 0; k < 8; k += 2) {
        a[k] = __builtin_shuffle(in[k], in[k + 1], low);
        a[k + 1] = __builtin_shuffle(in[k], in[k + 1], high);
    }
    for (int k = 0; k < 8; k += 4)
        for (int j = 0; j < 2; j++) {
            b[k + j] = __builtin_shuffle(a[k + j], a[k + j + 2], low2);
            b[k + j + 2] = __builtin_shuffle(a[k + j], a[k + j + 2], high2);
        }
    for (int j = 0; j < 4; j++) {
        out[j * stride] = __builtin_shuffle(b[j], b[j + 4], low4);
        out[(j + 4) * stride] = __builtin_shuffle(b[j], b[j + 4], high4);
    }
}

static inline void add_run(double *restrict to, const double *restrict from, int n)
{
    for (; n >= 8; n -= 8, to += 8, from += 8)
        *(v8_anywhere *)to += *(const v8_anywhere *)from;
    if (n & 4) {
        *(v4_anywhere *)to += *(const v4_anywhere *)from;
        to += 4, from += 4;
    }
    if (n & 2) {
        *(v2_anywhere *)to += *(const v2_anywhere *)from;
        to += 2, from += 2;
    }
    if (n & 1)
        *to += *from;
}

/* Where the rows of an item go.  Cells of a regular mesh have the same runs, which are then those of the first. */
typedef struct lane {
    const body_share *share;
    int joins; /* of the same group as the lane before, as are pieces of a surface in a cell: added to it */
    const int32_t *pair; /* of its group */
    int size, n_segment, n_run;
    int alike; /* segments as those of the first lane */
    const run *runs;
    segment segment[MOST_SEGMENTS];
    run own[MOST_SEGMENTS];
} lane;

static void start_lane(const assembly *a, const assembly_class *c, int slab, int64_t item, lane *l)
{
    l->share = shares_at(a, c, slab, item);
    l->pair = space_pair(a->space, c->group[item]);
    l->size = space_group_size(a->space, c->group[item]);
}

/* Runs in the rows of a carrier. */
static void take_runs(lane *lanes, int n_lane, int carrier)
{
    for (int l = 0; l < n_lane; l++) {
        lane *k = &lanes[l];
        const lane *first = &lanes[0];

        if (k->alike && !memcmp(k->pair + carrier * k->size, first->pair + carrier * k->size,
                                (size_t)k->size * sizeof *k->pair)) {
            k->runs = first->runs;
            k->n_run = first->n_run;
        } else {
            k->n_run = find_runs(k->segment, k->n_segment, k->pair + carrier * k->size, k->own);
            k->runs = k->own;
        }
    }
}

/* A row of all items; those that join another are added to that one's. */
static void take_row(const lane *lanes, int n_lane, const v8 *from, int n_block, v8 *row)
{
    for (int k = 0; k < n_block; k++)
        transpose(from + 8 * k, row + k, n_block);
    for (int l = n_lane - 1; l > 0; l--)
        for (int k = 0; lanes[l].joins && k < n_block; k++)
            row[(l - 1) * n_block + k] += row[l * n_block + k];
}

/* The rows of field f, all carriers. */
static void scatter_rows(const assembly *a, const assembly_class *c, int64_t batch, int f, const workspace *w,
                         lane *lanes, double *value)
{
    const space *s = a->space;
    const element_layout *p = &c->layout;
    int n_lane = (int)(c->batch[batch + 1] - c->batch[batch]), carrier = -1, width = p->width;
    int of_body = s->field[f].support == PF_ON_PARTICLE;
    const int32_t *dof = c->dof + c->batch[batch] * p->n;

    for (int l = 0; l < n_lane; l++) {
        lane *k = &lanes[l];

        k->n_segment = find_segments(a, p, dof + l * p->n, p->coupled[f], k->segment);
        k->alike = l && k->n_segment == lanes[0].n_segment && k->size == lanes[0].size &&
                   !memcmp(k->segment, lanes[0].segment, (size_t)k->n_segment * sizeof *k->segment);
    }
    for (int r = 0; r < p->n; r++) {
        v8 row[PF_LANES * ELEMENT_MOST_ENTRIES / 8];

        if (p->field[r] != f)
            continue;
        take_row(lanes, n_lane, w->mat + r * width, width / 8, row);
        if (p->carrier[r] != carrier)
            take_runs(lanes, n_lane, p->carrier[r]);
        carrier = p->carrier[r];
        for (int l = 0; l < n_lane; l++) {
            int32_t d = dof[l * p->n + r], at = d < 0 ? -1 : a->row_of[d];
            const double *from = (const double *)row + l * width;
            double *to = value;

            if (at < 0 || lanes[l].joins)
                continue;
            if (lanes[l].share && of_body)
                to = a->share_sum + lanes[l].share->at + p->n - lanes[l].share->first_value;
            for (const run *u = lanes[l].runs; u < lanes[l].runs + lanes[l].n_run; u++)
                add_run(to + s->row[at] + u->to, from + u->from, u->n);
        }
    }
}

void scatter_matrix(const assembly *a, const assembly_class *c, int64_t batch, int slab, const workspace *w,
                    double *value)
{
    lane lanes[PF_LANES];

    for (int64_t item = c->batch[batch]; item < c->batch[batch + 1]; item++) {
        start_lane(a, c, slab, item, &lanes[item - c->batch[batch]]);
        lanes[item - c->batch[batch]].joins = item > c->batch[batch] && c->group[item] == c->group[item - 1];
    }
    for (int f = 0; f < a->space->n_field; f++)
        if (c->layout.coupled[f])
            scatter_rows(a, c, batch, f, w, lanes, value);
}
