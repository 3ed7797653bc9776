/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Meshes as read from files, sizes and orientation of cells, periodic boundaries. */
#include "base/text.h"
#include "mesh/mesh.h"

#include "base/order.h"

#include <plugflow/mesh.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MEASURE_DEGREE = 5 };

int mesh_find_name(const mesh *m, const char *name)
{
    for (int i = 0; i < m->n_name; i++)
        if (strcmp(m->name[i], name) == 0)
            return i;
    return -1;
}

void mesh_destroy(mesh *m)
{
    arena_free(&m->memory);
    memset(m, 0, sizeof *m);
}

double mesh_map(const mesh *m, int64_t cell, const double *n, const double (*dn)[3], double x[3], double j[3][3])
{
    const int32_t *node = m->cell + cell * m->type->n_node;

    memset(x, 0, 3 * sizeof *x);
    memset(j, 0, 9 * sizeof(double));
    if (m->dim == 2)
        j[2][2] = 1;
    for (int i = 0; i < m->type->n_node; i++)
        for (int a = 0; a < m->dim; a++) {
            double at = m->x[(int64_t)node[i] * m->dim + a];

            x[a] += n[i] * at;
            for (int b = 0; b < m->dim; b++)
                j[a][b] += at * dn[i][b];
        }
    return j[0][0] * (j[1][1] * j[2][2] - j[1][2] * j[2][1]) - j[0][1] * (j[1][0] * j[2][2] - j[1][2] * j[2][0]) +
           j[0][2] * (j[1][0] * j[2][1] - j[1][1] * j[2][0]);
}

int mesh_measure(mesh *m, error *err)
{
    const fe_cell *c = m->type;
    double n[FE_MAX_POINTS][FE_MAX_NODES], dn[FE_MAX_POINTS][FE_MAX_NODES][3];
    fe_rule rule;

    TRY(fe_rule_cell(c, MEASURE_DEGREE, &rule, err));
    for (int q = 0; q < rule.n; q++)
        fe_basis(c, 2, rule.x[q], n[q], dn[q]);
    ARENA_NEW(&m->memory, m->h, m->n_cell, err);
    for (int64_t e = 0; e < m->n_cell; e++) {
        double volume = 0;

        for (int q = 0; q < rule.n; q++) {
            double j[3][3], at[3], det = mesh_map(m, e, n[q], (const double(*)[3])dn[q], at, j);

            if (!(det > 0))
                return error_set(err, ERR_MESH,
                                 "mesh: %s %lld is inverted or folded near %s: its Jacobian there is "
                                 "%.3g, which must be positive; move its nodes apart or refine the mesh",
                                 c->name, (long long)e, text_point(at, m->dim).s, det);
            volume += rule.w[q] * det;
        }
        m->h[e] = pow(volume, 1.0 / m->dim);
    }
    return 0;
}

/* A facet by its vertices, sorted. */
typedef struct facet_key {
    int32_t vertex[4];
    int32_t cell, local;
    uint64_t names;
} facet_key;

static int by_vertices(const void *a, const void *b)
{
    return memcmp(((const facet_key *)a)->vertex, ((const facet_key *)b)->vertex, sizeof((facet_key *)0)->vertex);
}

static int by_local(const void *a, const void *b)
{
    const mesh_facet *f = a, *g = b;

    return f->local != g->local ? f->local - g->local : (f->cell > g->cell) - (f->cell < g->cell);
}

/* All facets that only one cell has are boundary; the file's names are attached to them. */
static int find_boundary(mesh *m, const pf_mesh_data *data, const char *source, error *err)
{
    const fe_cell *c = m->type;
    int64_t n = m->n_cell * c->n_facet, n_boundary = 0;
    facet_key *key;

    ARENA_NEW(&m->memory, key, n, err);
    for (int64_t e = 0, i = 0; e < m->n_cell; e++)
        for (int f = 0; f < c->n_facet; f++, i++) {
            memset(key[i].vertex, 0xff, sizeof key[i].vertex);
            for (int v = 0; v < c->facet_vertices; v++)
                key[i].vertex[v] = m->cell[e * c->n_node + c->facet[f][v]];
            qsort(key[i].vertex, (size_t)c->facet_vertices, sizeof(int32_t), order_int32);
            key[i].cell = (int32_t)e;
            key[i].local = f;
        }
    qsort(key, (size_t)n, sizeof *key, by_vertices);
    for (int64_t i = 0; i < n; i++) {
        if (i + 1 < n && by_vertices(&key[i], &key[i + 1]) == 0)
            i++;
        else
            key[n_boundary++] = key[i];
    }
    for (int64_t i = 0; i < data->n_facet; i++) {
        facet_key wanted, *found;

        memset(wanted.vertex, 0xff, sizeof wanted.vertex);
        for (uint32_t v = 0; v < data->facet_vertices; v++)
            wanted.vertex[v] = (int32_t)data->facet[i * data->facet_vertices + v];
        qsort(wanted.vertex, data->facet_vertices, sizeof(int32_t), order_int32);
        found = bsearch(&wanted, key, (size_t)n_boundary, sizeof *key, by_vertices);
        if (!found)
            return error_set(err, ERR_MESH,
                             "%s: boundary \"%s\" has a facet inside the mesh; name outer facets only", source,
                             data->name[data->facet_name[i]]);
        found->names |= (uint64_t)1 << data->facet_name[i];
    }
    ARENA_NEW(&m->memory, m->facet, n_boundary, err);
    m->n_facet = n_boundary;
    for (int64_t i = 0; i < n_boundary; i++)
        m->facet[i] = (mesh_facet){key[i].cell, key[i].local, key[i].names};
    qsort(m->facet, (size_t)n_boundary, sizeof *m->facet, by_local);
    return 0;
}

int mesh_create_from_data(const pf_mesh_data *data, const char *source, mesh *m, error *err)
{
    int order[FE_MAX_NODES];

    memset(m, 0, sizeof *m);
    m->dim = (int)data->dim;
    m->type = fe_cell_of((int)data->type);
    if (!m->type || m->type->dim != m->dim)
        return error_set(err, ERR_MESH, "%s: the reader returned an unknown cell type %u", source, data->type);
    if (data->n_node < 1 || data->n_cell < 1 || data->n_node > INT32_MAX / 4 || data->n_cell > INT32_MAX / 8)
        return error_set(err, ERR_MESH,
                         "%s: %lld cells and %lld nodes; a mesh needs at least one cell and at most 2^29 nodes",
                         source, (long long)data->n_cell, (long long)data->n_node);
    if (data->n_name > MESH_MAX_NAMES)
        return error_set(err, ERR_MESH, "%s: %d boundary names, at most %d are possible", source, data->n_name,
                         MESH_MAX_NAMES);
    m->n_node = data->n_node;
    m->n_cell = data->n_cell;
    ARENA_NEW(&m->memory, m->x, m->n_node * m->dim, err);
    memcpy(m->x, data->x, (size_t)(m->n_node * m->dim) * sizeof *m->x);
    for (int i = 0; i < m->type->n_node; i++) {
        order[i] = -1;
        for (int k = 0; k < m->type->n_node; k++) {
            double d = 0;

            for (int a = 0; a < m->dim; a++)
                d += fabs(data->reference[k * m->dim + a] - m->type->x[i][a]);
            order[i] = d < 1e-6 ? k : order[i];
        }
        if (order[i] < 0)
            return error_set(err, ERR_MESH, "%s: the reader's %s has no node at (%g, %g, %g)", source,
                             m->type->name, m->type->x[i][0], m->type->x[i][1], m->type->x[i][2]);
    }
    ARENA_NEW(&m->memory, m->cell, m->n_cell * m->type->n_node, err);
    for (int64_t e = 0; e < m->n_cell; e++)
        for (int i = 0; i < m->type->n_node; i++) {
            int64_t node = data->cell[e * m->type->n_node + order[i]];

            if (node < 0 || node >= m->n_node)
                return error_set(err, ERR_MESH, "%s: cell %lld refers to node %lld of %lld", source, (long long)e,
                                 (long long)node, (long long)m->n_node);
            m->cell[e * m->type->n_node + i] = (int32_t)node;
        }
    m->n_name = data->n_name;
    for (int i = 0; i < m->n_name; i++)
        if (!(m->name[i] = arena_strdup(&m->memory, data->name[i])))
            return error_memory(err, "mesh names", 0);
    return find_boundary(m, data, source, err);
}

/* Nodes on a boundary, each once, ascending. */
static int boundary_nodes(mesh *m, int name, int32_t **node, int64_t *n, error *err)
{
    int64_t k = 0;

    for (int64_t f = 0; f < m->n_facet; f++)
        k += m->facet[f].names >> name & 1 ? m->type->facet_nodes : 0;
    ARENA_NEW(&m->memory, *node, k, err);
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

/* A node with its position along the boundary, for matching by sorting. */
typedef struct placed {
    int64_t key[3];
    int32_t node;
} placed;

static int by_place(const void *a, const void *b)
{
    const placed *p = a, *q = b;

    for (int k = 0; k < 3; k++)
        if (p->key[k] != q->key[k])
            return p->key[k] < q->key[k] ? -1 : 1;
    return 0;
}

static int place_nodes(mesh *m, const int32_t *node, int64_t n, const double *centre, double size, placed *out)
{
    for (int64_t i = 0; i < n; i++) {
        out[i].node = node[i];
        memset(out[i].key, 0, sizeof out[i].key);
        for (int k = 0; k < m->dim; k++)
            out[i].key[k] = llround((m->x[(int64_t)node[i] * m->dim + k] - centre[k]) / (1e-6 * size));
    }
    qsort(out, (size_t)n, sizeof *out, by_place);
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

int mesh_make_periodic(mesh *m, int a, int b, error *err)
{
    int32_t *node[2];
    int64_t n[2];
    double centre[2][3], size[2];
    placed *place[2];
    int name[2] = {a, b};

    if (!m->master) {
        ARENA_NEW(&m->memory, m->master, m->n_node, err);
        for (int64_t i = 0; i < m->n_node; i++)
            m->master[i] = (int32_t)i;
    }
    for (int s = 0; s < 2; s++) {
        TRY(boundary_nodes(m, name[s], &node[s], &n[s], err));
        bounds(m, node[s], n[s], centre[s], &size[s]);
        ARENA_NEW(&m->memory, place[s], n[s] > 0 ? n[s] : 1, err);
        place_nodes(m, node[s], n[s], centre[s], size[s] > 0 ? size[s] : 1, place[s]);
    }
    for (int64_t i = 0; i < n[0] || i < n[1]; i++)
        for (int k = 0; k < 3; k++)
            if (n[0] != n[1] || llabs(place[0][i].key[k] - place[1][i].key[k]) > 1)
                return error_set(
                    err, ERR_MESH,
                    "boundary { periodic = {\"%s\", \"%s\"} }: their nodes do not match (%lld and %lld "
                    "nodes); both sides need the same facets, shifted",
                    m->name[a], m->name[b], (long long)n[0], (long long)n[1]);
    for (int64_t i = 0; i < n[0]; i++) {
        int32_t p = place[0][i].node, q = place[1][i].node;

        while (m->master[p] != p)
            p = m->master[p];
        while (m->master[q] != q)
            q = m->master[q];
        m->master[p > q ? p : q] = p > q ? q : p;
    }
    for (int k = 0; k < m->dim; k++) {
        m->period_at[m->n_period][k] = centre[0][k];
        m->period_vector[m->n_period][k] = centre[1][k] - centre[0][k];
    }
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
