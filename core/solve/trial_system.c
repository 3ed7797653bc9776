/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The systems on which solvers are tried: made as full matrices, so that what is expected of a solver comes by
 * another way than that of its rows and columns. */
#include "solve/trial.h"

#include "base/random.h"
#include "solve/vector.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Of the squares of the elements, in each direction, and between them: [0, 1], second order (v) and first (p). */
static const double
    MASS[3][3] = {{4 / 30., 2 / 30., -1 / 30.}, {2 / 30., 16 / 30., 2 / 30.}, {-1 / 30., 2 / 30., 4 / 30.}},
    STIFF[3][3] = {{7 / 3., -8 / 3., 1 / 3.}, {-8 / 3., 16 / 3., -8 / 3.}, {1 / 3., -8 / 3., 7 / 3.}},
    WIND[3][3] = {{-1 / 2., 2 / 3., -1 / 6.}, {-2 / 3., 0, 2 / 3.}, {1 / 6., -2 / 3., 1 / 2.}}, /* v v' */
    SLOPE[3][2] = {{-5 / 6., -1 / 6.}, {2 / 3., -2 / 3.}, {1 / 6., 5 / 6.}},                    /* v' p */
    MEAN[3][2] = {{1 / 6., 0}, {1 / 3., 1 / 3.}, {0, 1 / 6.}};                                  /* v p */

static const pf_row_field OF_SCALAR[] = {{.name = "q", .n_comp = 1, .order = 1}};
static const pf_row_field OF_FLOW[] = {{.name = "u", .n_comp = 2, .order = 2},
                                       {.name = "p", .n_comp = 1, .order = 1}};

static const char *const NAME[N_TRIAL] = {"symmetric, positive definite",
                                          "unsymmetric",
                                          "saddle point",
                                          "saddle point, unsymmetric",
                                          "saddle point with a free constant",
                                          "saddle point, one value held"};

/* A grid of nodes, and the rows of each: those of v (one, or two of a velocity) and of p; -1: there are none. */
typedef struct grid {
    int n, flow, elements;
    int32_t (*row)[3];
} grid;

const char *trial_name(enum trial_kind kind)
{
    return NAME[kind];
}

static int is_open(enum trial_kind kind)
{
    return kind == TRIAL_STOKES || kind == TRIAL_OSEEN;
}

static int has_row(const trial *t, const grid *g, int i, int j, int c)
{
    const int last = g->n - 1, outflow = is_open(t->kind) && i == last && j > 0 && j < last;

    if (!g->flow)
        return c == 0;
    return c == 2 ? i % 2 == 0 && j % 2 == 0 : outflow || (i > 0 && i < last && j > 0 && j < last);
}

/* Rows and the nodes that they belong to. */
static int number_rows(trial *t, grid *g, error *err)
{
    const int nodes = g->n * g->n;
    int64_t *node, n = 0, group = 0;

    ARENA_NEW(&t->memory, g->row, nodes, err);
    ARENA_NEW(&t->memory, node, nodes + 1, err);
    ARENA_NEW(&t->memory, t->place, nodes, err);
    ARENA_NEW(&t->memory, t->field_of, 3 * nodes, err);
    ARENA_NEW(&t->memory, t->comp_of, 3 * nodes, err);
    for (int at = 0; at < nodes; at++) {
        const int i = at % g->n, j = at / g->n;
        const int64_t first = n;

        for (int c = 0; c < 3; c++) {
            g->row[at][c] = has_row(t, g, i, j, c) ? (int32_t)n : -1;
            if (g->row[at][c] < 0)
                continue;
            t->field_of[n] = c == 2;
            t->comp_of[n++] = (uint8_t)(c % 2);
        }
        if (n == first)
            continue;
        t->place[group][0] = i;
        t->place[group][1] = j;
        node[++group] = n;
    }
    t->a = (pf_csr){.n = n, .n_node = group, .node = node};
    return 0;
}

/* Nodes i and j of a line share an element. */
static int share(int i, int j)
{
    const int low = i < j ? i : j, high = i < j ? j : i;

    return (high + 1) / 2 - 1 <= low / 2;
}

static int couples(const trial *t, int flow, int64_t g, int64_t h)
{
    const int32_t *a = t->place[g], *b = t->place[h];

    return flow ? share(a[0], b[0]) && share(a[1], b[1]) : abs(a[0] - b[0]) + abs(a[1] - b[1]) <= 1;
}

/* All rows of a node have the columns of all nodes that it couples with. */
static int make_pattern(trial *t, int flow, error *err)
{
    const pf_csr *a = &t->a;
    int64_t *row, *col, *shift, k = 0;
    int32_t *shared;

    ARENA_NEW(&t->memory, row, a->n + 1, err);
    ARENA_NEW(&t->memory, shift, a->n, err);
    ARENA_NEW(&t->memory, col, 80 * a->n, err);
    ARENA_NEW(&t->memory, shared, 80 * a->n, err);
    for (int64_t g = 0; g < a->n_node; g++)
        for (int64_t r = a->node[g]; r < a->node[g + 1]; r++) {
            row[r] = k;
            shift[r] = row[a->node[g]] - k;
            for (int64_t h = 0; h < a->n_node; h++)
                for (int64_t c = a->node[h]; couples(t, flow, g, h) && c < a->node[h + 1]; c++) {
                    shared[k] = (int32_t)c;
                    col[k++] = c;
                }
        }
    row[a->n] = k;
    ARENA_NEW(&t->memory, t->value, k, err);
    ARENA_NEW(&t->memory, t->kept, k, err);
    t->a.row = row;
    t->a.value = t->value;
    t->shared = t->a;
    t->a.col = col;
    t->shared.shared_col = shared;
    t->shared.shared_shift = shift;
    return 0;
}

/* Nodes between vertices, as the kernel tells of them. */
static int find_parents(trial *t, const grid *g, const int32_t *group_of, error *err)
{
    int64_t *start;
    int32_t *node;
    double *weight;

    ARENA_NEW(&t->memory, start, t->a.n_node + 1, err);
    ARENA_NEW(&t->memory, node, 4 * t->a.n_node, err);
    ARENA_NEW(&t->memory, weight, 4 * t->a.n_node, err);
    for (int64_t m = 0; m < t->a.n_node; m++) {
        const int x = t->place[m][0], y = t->place[m][1], wide = x % 2, high = y % 2;

        start[m + 1] = start[m];
        for (int k = 0; g->flow && (wide || high) && k < 4; k++) {
            const int i = x + (k % 2 ? wide : -wide), j = y + (k / 2 ? high : -high);

            if ((k % 2 && !wide) || (k / 2 && !high) || group_of[j * g->n + i] < 0)
                continue;
            node[start[m + 1]] = group_of[j * g->n + i];
            weight[start[m + 1]++] = 1. / ((1 + wide) * (1 + high));
        }
    }
    t->unknowns.parent = start;
    t->unknowns.parent_node = node;
    t->unknowns.parent_weight = weight;
    return 0;
}

static int describe(trial *t, const grid *g, error *err)
{
    const int64_t n_node = t->a.n_node;
    int32_t *group_of;
    uint8_t *kind, *idle;
    double *x;

    ARENA_NEW(&t->memory, group_of, g->n * g->n, err);
    ARENA_NEW(&t->memory, kind, n_node, err);
    ARENA_NEW(&t->memory, idle, t->a.n, err);
    ARENA_NEW(&t->memory, x, 2 * n_node, err);
    memset(group_of, 0xff, (size_t)(g->n * g->n) * sizeof *group_of);
    for (int64_t m = 0; m < n_node; m++) {
        group_of[t->place[m][1] * g->n + t->place[m][0]] = (int32_t)m;
        for (int c = 0; c < 2; c++)
            x[2 * m + c] = t->place[m][c] / (g->n - 1.);
    }
    t->unknowns = (pf_unknowns){.size = sizeof t->unknowns,
                                .dim = 2,
                                .n_field = g->flow ? 2 : 1,
                                .field = g->flow ? OF_FLOW : OF_SCALAR,
                                .field_of = t->field_of,
                                .comp_of = t->comp_of,
                                .kind = kind,
                                .x = x,
                                .idle = idle,
                                .weight = t->weights};
    t->a.unknowns = t->shared.unknowns = &t->unknowns;
    return find_parents(t, g, group_of, err);
}

static void add(trial *t, int32_t row, int32_t col, double v)
{
    if (row >= 0 && col >= 0)
        t->full[row * t->a.n + col] += v;
}

/* Five points of  -lap q + wind . grad q + own q,  differences against the wind. */
static void fill_scalar(trial *t, const grid *g, enum trial_values values)
{
    const double wind = t->kind == TRIAL_CONVECTION ? 1.5 : 0, own[] = {0.01, 1, 0.02};
    /* to the left, the right, below, above */
    const int turned = values == TRIAL_FAR;
    const double part[4] = {1 + (turned ? 0 : wind), 1 + (turned ? 2 * wind : 0), 1 + (turned ? wind : 0),
                            1 + (turned ? 0 : wind)};

    for (int at = 0; at < g->n * g->n; at++) {
        const int i = at % g->n, j = at / g->n;
        const int to[4] = {at - 1, at + 1, at - g->n, at + g->n},
                  there[4] = {i > 0, i<g->n - 1, j> 0, j < g->n - 1};

        add(t, g->row[at][0], g->row[at][0], own[values]);
        for (int k = 0; k < 4; k++) {
            add(t, g->row[at][0], g->row[at][0], part[k]);
            if (there[k])
                add(t, g->row[at][0], g->row[to[k]][0], -part[k]);
        }
    }
}

/* One element: viscosity, a uniform wind, the pressure and the divergence. */
static void fill_element(trial *t, const grid *g, int first, enum trial_values values)
{
    static const double viscosity[] = {1, 4, 1.1}, speed[] = {10, -40, 12};
    const double h = 1. / g->elements, nu = viscosity[values], wind = t->kind == TRIAL_OSEEN ? speed[values] : 0;

    for (int a = 0; a < 9; a++) {
        const int i = a % 3, j = a / 3;
        const int32_t *row = g->row[first + j * g->n + i];

        for (int b = 0; b < 9; b++) {
            const int k = b % 3, l = b / 3;
            const double v = nu * (STIFF[i][k] * MASS[j][l] + MASS[i][k] * STIFF[j][l]) +
                             wind * h * (WIND[i][k] * MASS[j][l] + 0.5 * MASS[i][k] * WIND[j][l]);

            for (int c = 0; c < 2; c++)
                add(t, row[c], g->row[first + l * g->n + k][c], v);
        }
        for (int b = 0; b < 4; b++) {
            const int k = b % 2, l = b / 2;
            const int32_t p = g->row[first + 2 * l * g->n + 2 * k][2];
            const double d[2] = {h * SLOPE[i][k] * MEAN[j][l], h * MEAN[i][k] * SLOPE[j][l]};

            for (int c = 0; c < 2; c++) {
                add(t, row[c], p, -d[c]);
                add(t, p, row[c], d[c]);
            }
        }
    }
}

/* What the integral of each pressure function is; a value that is held gets the equation p = 0. */
static int close_pressure(trial *t, error *err)
{
    const int64_t n = t->a.n;
    int64_t pin = n - 1;

    ARENA_NEW(&t->memory, t->weight, n, err);
    for (int64_t m = 0; m < t->a.n_node; m++) {
        const int64_t r = t->a.node[m + 1] - 1;
        const int side = t->place[t->a.n_node - 1][0];
        const double x = t->place[m][0] % side ? 2 : 1, y = t->place[m][1] % side ? 2 : 1;

        t->weight[r] = t->field_of[r] == 1 ? x * y : 0;
    }
    t->unknowns.free_fields = 1u << 1;
    t->weights[1] = t->weight;
    for (int64_t r = 0; t->kind == TRIAL_HELD && r < n; r++)
        t->full[r * n + pin] = t->full[pin * n + r] = r == pin;
    return 0;
}

void trial_fill(trial *t)
{
    for (int64_t r = 0; r < t->a.n; r++)
        for (int64_t k = t->a.row[r]; k < t->a.row[r + 1]; k++)
            t->value[k] = t->kept[k] = t->full[r * t->a.n + t->a.col[k]];
}

void trial_spoil(trial *t)
{
    for (int64_t k = 0; k < t->a.row[t->a.n]; k++)
        t->value[k] = NAN;
}

int trial_create(trial *t, enum trial_kind kind, int side, enum trial_values values, error *err)
{
    const int flow = kind >= TRIAL_STOKES;
    grid g = {.n = flow ? 2 * side + 1 : 2 * side, .flow = flow, .elements = side};
    unsigned long long seed = RANDOM_SEED;

    memset(t, 0, sizeof *t);
    t->kind = kind;
    TRY(number_rows(t, &g, err));
    TRY(make_pattern(t, flow, err));
    TRY(describe(t, &g, err));
    ARENA_NEW(&t->memory, t->full, t->a.n * t->a.n, err);
    ARENA_NEW(&t->memory, t->x, t->a.n, err);
    ARENA_NEW(&t->memory, t->b, t->a.n, err);
    if (!flow)
        fill_scalar(t, &g, values);
    for (int e = 0; flow && e < side * side; e++)
        fill_element(t, &g, 2 * (e / side) * g.n + 2 * (e % side), values);
    if (kind >= TRIAL_ENCLOSED)
        TRY(close_pressure(t, err));
    for (int64_t i = 0; i < t->a.n; i++)
        t->x[i] = 2 * random_next(&seed) - 1;
    trial_multiply(t, 0, t->x, t->b);
    trial_fill(t);
    return 0;
}

void trial_multiply(const trial *t, int transposed, const double *x, double *y)
{
    const int64_t n = t->a.n, along = transposed ? n : 1, down = transposed ? 1 : n;

    for (int64_t i = 0; i < n; i++) {
        y[i] = 0;
        for (int64_t j = 0; j < n; j++)
            y[i] += t->full[i * down + j * along] * x[j];
    }
}

double trial_residual(const trial *t, const trial *with, int transposed, const double *x)
{
    const int64_t n = t->a.n;
    double sum = 0;

    for (int64_t i = 0; i < n; i++) {
        double r = t->b[i];

        for (int64_t j = 0; j < n; j++)
            r -= with->full[transposed ? j * n + i : i * n + j] * x[j];
        sum += r * r;
    }
    return sqrt(sum) / vector_norm(n, t->b);
}

void trial_destroy(trial *t)
{
    arena_free(&t->memory);
    memset(t, 0, sizeof *t);
}
