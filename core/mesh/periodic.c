/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Periodic boundaries: pairs whose nodes are one, shifted by a period, and points brought back by whole periods. */
#include "mesh/mesh.h"

#include "base/order.h"
#include "base/text.h"
#include "mesh/box_grid.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Two nodes are one if they differ by less, in sizes of the boundary. */
#define SAME 1e-6

/* Nodes on a boundary, each once, ascending. */
static int boundary_nodes(const mesh *m, int name, arena *room, int32_t **node, int64_t *n, error *err)
{
    int64_t k = 0;

    for (int64_t f = 0; f < m->n_facet; f++)
        k += m->facet[f].names >> name & 1 ? m->type->facet_nodes : 0;
    ARENA_NEW(room, *node, k, err);
    k = 0;
    for (int64_t f = 0; f < m->n_facet; f++)
        for (int i = 0; (m->facet[f].names >> name & 1) && i < m->type->facet_nodes; i++)
            (*node)[k++] =
                m->cell[(int64_t)m->facet[f].cell * m->type->n_node + m->type->facet[m->facet[f].local][i]];
    qsort(*node, (size_t)k, sizeof **node, order_int32);
    *n = 0;
    for (int64_t i = 0; i < k; i++)
        if (i == 0 || (*node)[i] != (*node)[i - 1])
            (*node)[(*n)++] = (*node)[i];
    return 0;
}

static void bounds(const mesh *m, const int32_t *node, int64_t n, double *centre, double *size)
{
    *size = 0;
    for (int k = 0; k < m->dim; k++) {
        double low = INFINITY, high = -INFINITY;

        for (int64_t i = 0; i < n; i++) {
            low = fmin(low, m->x[(int64_t)node[i] * m->dim + k]);
            high = fmax(high, m->x[(int64_t)node[i] * m->dim + k]);
        }
        centre[k] = 0.5 * (low + high);
        *size = fmax(*size, high - low);
    }
}

/* The nodes of a side, each with a box round it. */
static int grid_of(const mesh *m, const int32_t *node, int64_t n, double size, box_grid *g, error *err)
{
    const double margin = SAME * size;

    TRY(box_grid_create(g, m->dim, n, err));
    for (int64_t i = 0; i < n; i++)
        for (int k = 0; k < m->dim; k++) {
            double x = m->x[(int64_t)node[i] * m->dim + k];

            g->box[i][0][k] = x - margin;
            g->box[i][1][k] = x + margin;
        }
    return box_grid_build(g, size / pow((double)n, 1.0 / (m->dim - 1)), err);
}

/* The box that x lies in, and nearest to its middle; -1: none. */
static int64_t nearest(const box_grid *g, const double *x)
{
    double least = INFINITY;
    int64_t n, best = -1;
    const int32_t *list = box_grid_at(g, x, &n);

    for (int64_t i = 0; i < n; i++) {
        double d = 0, margin = 0;

        for (int k = 0; k < g->dim; k++) {
            const double low = g->box[list[i]][0][k], high = g->box[list[i]][1][k];

            d = fmax(d, fabs(x[k] - 0.5 * (low + high)));
            margin = 0.5 * (high - low);
        }
        if (d < least && d <= margin) {
            least = d;
            best = list[i];
        }
    }
    return best;
}

static int32_t root(const mesh *m, int32_t node)
{
    while (m->master[node] != node)
        node = m->master[node];
    return node;
}

/* x: a node without partner, or NULL. */
static int no_match(const mesh *m, const int name[2], const int64_t n[2], const double *x, error *err)
{
    return error_set(
        err, ERR_MESH,
        "boundary { periodic = {\"%s\", \"%s\"} }: their nodes do not match (%lld and %lld nodes%s%s); "
        "both sides need the same facets, shifted",
        m->name[name[0]], m->name[name[1]], (long long)n[0], (long long)n[1], x ? "; no partner has that at " : "",
        x ? text_point(x, m->dim).s : "");
}

/* The two sides of a pair. */
typedef struct sides {
    int name[2];
    int64_t n[2];
    int32_t *node[2];
    double centre[2][3], size[2];
    box_grid grid; /* of the second */
    uint8_t *used; /* [n[1]] found as a partner */
    arena memory;
} sides;

static int find_sides(const mesh *m, sides *s, error *err)
{
    for (int i = 0; i < 2; i++) {
        TRY(boundary_nodes(m, s->name[i], &s->memory, &s->node[i], &s->n[i], err));
        bounds(m, s->node[i], s->n[i], s->centre[i], &s->size[i]);
    }
    if (s->n[0] != s->n[1] || s->n[0] == 0)
        return no_match(m, s->name, s->n, NULL, err);
    ARENA_NEW(&s->memory, s->used, s->n[1], err);
    return grid_of(m, s->node[1], s->n[1], s->size[0], &s->grid, err);
}

/* Makes each node of the first side one with that of the second that lies a period further. */
static int join(mesh *m, sides *s, const double *period, error *err)
{
    for (int64_t i = 0; i < s->n[0]; i++) {
        const double *from = m->x + (int64_t)s->node[0][i] * m->dim;
        double x[3] = {0};
        int64_t found;
        int32_t p, q;

        for (int k = 0; k < m->dim; k++)
            x[k] = from[k] + period[k];
        found = nearest(&s->grid, x);
        if (found < 0 || s->used[found]++)
            return no_match(m, s->name, s->n, from, err);
        p = root(m, s->node[0][i]);
        q = root(m, s->node[1][found]);
        m->master[p > q ? p : q] = p > q ? q : p;
    }
    for (int64_t i = 0; i < m->n_node; i++) /* a master has a lower number: its own is known */
        m->master[i] = m->master[m->master[i]];
    return 0;
}

int mesh_make_periodic(mesh *m, int a, int b, error *err)
{
    double *period = m->period_vector[m->n_period], *at = m->period_at[m->n_period];
    sides s = {.name = {a, b}};
    int status;

    if (m->n_period == MESH_MAX_NAMES)
        return error_set(err, ERR_MESH, "more than %d pairs of periodic boundaries", MESH_MAX_NAMES);
    if (!m->master) {
        ARENA_NEW(&m->memory, m->master, m->n_node, err);
        for (int64_t i = 0; i < m->n_node; i++)
            m->master[i] = (int32_t)i;
    }
    status = find_sides(m, &s, err);
    for (int k = 0; k < m->dim && !status; k++) {
        at[k] = s.centre[0][k];
        period[k] = s.centre[1][k] - s.centre[0][k];
    }
    if (!status)
        status = join(m, &s, period, err);
    arena_free(&s.memory);
    box_grid_destroy(&s.grid);
    TRY(status);
    m->period[m->n_period][0] = a;
    m->period[m->n_period++][1] = b;
    return 0;
}

/* Takes whole periods off x: along each as many as lie between `from` and x, rounded down after adding `half`. */
static void take_periods(const mesh *m, double *x, const double (*from)[3], double half)
{
    for (int k = 0; k < m->n_period; k++) {
        double along = 0, size = 0;

        for (int i = 0; i < m->dim; i++) {
            along += (x[i] - (from ? from[k][i] : 0)) * m->period_vector[k][i];
            size += m->period_vector[k][i] * m->period_vector[k][i];
        }
        for (int i = 0; i < m->dim; i++)
            x[i] -= floor(along / size + half) * m->period_vector[k][i];
    }
}

void mesh_wrap(const mesh *m, double *x)
{
    take_periods(m, x, m->period_at, 0);
}

void mesh_nearest(const mesh *m, double *d)
{
    take_periods(m, d, NULL, 0.5);
}

int mesh_images(const mesh *m, double shift[MESH_MAX_IMAGES][3])
{
    int n = 1;

    memset(shift[0], 0, sizeof shift[0]);
    for (int k = 0; k < m->n_period && k < 3; k++) {
        int before = n;

        for (int sign = -1; sign <= 1; sign += 2)
            for (int i = 0; i < before; i++, n++)
                for (int c = 0; c < 3; c++)
                    shift[n][c] = shift[i][c] + sign * m->period_vector[k][c];
    }
    return n;
}
