/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Meshes as read from files, places in cells, sizes and orientation of cells. */
#include "mesh/mesh.h"

#include "base/dense.h"
#include "base/order.h"
#include "base/text.h"

#include <plugflow/mesh.h>

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MEASURE_DEGREE = 5, MOST_NODES = INT32_MAX / 4, MOST_CELLS = INT32_MAX / 8 };

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
    return dense_determinant((const double(*)[3])j);
}

/* Whether all nodes lie where those of a box do, as exactly as their coordinates can say. */
static int is_box(const mesh *m, int64_t cell)
{
    const int32_t *node = m->cell + cell * m->type->n_node;

    for (int k = 0; k < m->dim; k++) {
        double low = m->x[(int64_t)node[0] * m->dim + k];
        double high = m->x[(int64_t)node[m->type->n_node - 1] * m->dim + k];
        double bound = 4 * DBL_EPSILON * fmax(fabs(low), fabs(high));

        for (int i = 0; i < m->type->n_node; i++) {
            double at = 0.5 * ((1 - m->type->x[i][k]) * low + (1 + m->type->x[i][k]) * high);

            if (!(fabs(m->x[(int64_t)node[i] * m->dim + k] - at) <= bound))
                return 0;
        }
    }
    return 1;
}

/* mesh_place in a box. */
static double place_in_box(const mesh *m, int64_t cell, const double *xi, double x[3], double j[3][3])
{
    const int32_t *node = m->cell + cell * m->type->n_node;
    double det = 1;

    for (int k = 0; k < 3; k++) {
        double low = k < m->dim ? m->x[(int64_t)node[0] * m->dim + k] : 0;
        double high = k < m->dim ? m->x[(int64_t)node[m->type->n_node - 1] * m->dim + k] : 0;

        for (int b = 0; b < 3; b++)
            j[k][b] = 0;
        x[k] = k < m->dim ? 0.5 * (low + high) + 0.5 * (high - low) * xi[k] : 0;
        j[k][k] = k < m->dim ? 0.5 * (high - low) : 1;
        det *= j[k][k];
    }
    return det;
}

double mesh_place(const mesh *m, int64_t cell, const double *xi, double x[3], double j[3][3])
{
    double n[FE_MAX_NODES], dn[FE_MAX_NODES][3];

    if (m->is_box && m->is_box[cell])
        return place_in_box(m, cell, xi, x, j);
    fe_basis(m->type, 2, xi, n, dn);
    return mesh_map(m, cell, n, (const double(*)[3])dn, x, j);
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
    ARENA_NEW(&m->memory, m->is_box, m->n_cell, err);
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
        m->is_box[e] = (uint8_t)(!c->simplex && is_box(m, e));
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

static void sort_vertices(facet_key *k, int n)
{
    qsort(k->vertex, (size_t)n, sizeof *k->vertex, order_int32);
}

/* Facets that only one cell has are boundary; key: room for all facets of all cells, the first *n are found. */
static void find_outer(const mesh *m, facet_key *key, int64_t *n)
{
    const fe_cell *c = m->type;
    int64_t all = m->n_cell * c->n_facet;

    for (int64_t e = 0, i = 0; e < m->n_cell; e++)
        for (int f = 0; f < c->n_facet; f++, i++) {
            key[i] = (facet_key){.vertex = {-1, -1, -1, -1}, .cell = (int32_t)e, .local = f};
            for (int v = 0; v < c->facet_vertices; v++)
                key[i].vertex[v] = m->cell[e * c->n_node + c->facet[f][v]];
            sort_vertices(&key[i], c->facet_vertices);
        }
    qsort(key, (size_t)all, sizeof *key, by_vertices);
    *n = 0;
    for (int64_t i = 0; i < all; i++) {
        if (i + 1 < all && by_vertices(&key[i], &key[i + 1]) == 0)
            i++;
        else
            key[(*n)++] = key[i];
    }
}

/* Attaches the file's names to the boundary facets. */
static int name_facets(const mesh *m, const pf_mesh_data *data, const char *source, facet_key *key, int64_t n,
                       error *err)
{
    int n_vertex = m->type->facet_vertices;

    for (int64_t i = 0; i < data->n_facet; i++) {
        facet_key wanted = {.vertex = {-1, -1, -1, -1}}, *found;

        if (data->facet_name[i] < 0 || data->facet_name[i] >= data->n_name)
            return error_set(err, ERR_MESH, "%s: facet %lld has name number %d of %d", source, (long long)i,
                             data->facet_name[i], data->n_name);
        for (int v = 0; v < n_vertex; v++) {
            int64_t node = data->facet[i * n_vertex + v];

            if (node < 0 || node >= m->n_node)
                return error_set(err, ERR_MESH, "%s: facet %lld refers to node %lld of %lld", source, (long long)i,
                                 (long long)node, (long long)m->n_node);
            wanted.vertex[v] = (int32_t)node;
        }
        sort_vertices(&wanted, n_vertex);
        found = bsearch(&wanted, key, (size_t)n, sizeof *key, by_vertices);
        if (!found)
            return error_set(err, ERR_MESH,
                             "%s: boundary \"%s\" has a facet inside the mesh; name outer facets only", source,
                             data->name[data->facet_name[i]]);
        found->names |= (uint64_t)1 << data->facet_name[i];
    }
    return 0;
}

static int find_boundary(mesh *m, const pf_mesh_data *data, const char *source, arena *room, error *err)
{
    facet_key *key;

    ARENA_NEW(room, key, m->n_cell * m->type->n_facet, err);
    find_outer(m, key, &m->n_facet);
    TRY(name_facets(m, data, source, key, m->n_facet, err));
    ARENA_NEW(&m->memory, m->facet, m->n_facet, err);
    for (int64_t i = 0; i < m->n_facet; i++)
        m->facet[i] = (mesh_facet){key[i].cell, key[i].local, key[i].names};
    qsort(m->facet, (size_t)m->n_facet, sizeof *m->facet, by_local);
    return 0;
}

/* Whether what the reader returned is of sane size, and all there. */
static int check_data(const pf_mesh_data *data, const fe_cell *type, const char *source, error *err)
{
    if (!type || type->dim != (int)data->dim)
        return error_set(err, ERR_MESH, "%s: the reader returned an unknown cell type %u", source, data->type);
    if (data->n_node < 1 || data->n_cell < 1 || data->n_node > MOST_NODES || data->n_cell > MOST_CELLS)
        return error_set(err, ERR_MESH,
                         "%s: %lld cells and %lld nodes; a mesh needs at least one cell, and this build numbers at "
                         "most %d cells and %d nodes",
                         source, (long long)data->n_cell, (long long)data->n_node, MOST_CELLS, MOST_NODES);
    if (data->n_name < 0 || data->n_name > MESH_MAX_NAMES)
        return error_set(err, ERR_MESH, "%s: %d boundary names, at most %d are possible", source, data->n_name,
                         MESH_MAX_NAMES);
    if (data->n_facet < 0 || (data->n_facet > 0 && (int)data->facet_vertices != type->facet_vertices))
        return error_set(err, ERR_MESH, "%s: the reader returned %lld facets of %u vertices; those of a %s have %d",
                         source, (long long)data->n_facet, data->facet_vertices, type->name, type->facet_vertices);
    if (!data->x || !data->cell || !data->reference || (data->n_facet > 0 && (!data->facet || !data->facet_name)) ||
        (data->n_name > 0 && !data->name))
        return error_set(err, ERR_MESH, "%s: the reader returned sizes without arrays", source);
    for (int64_t i = 0; i < data->n_node * (int64_t)data->dim; i++)
        if (!isfinite(data->x[i]))
            return error_set(err, ERR_MESH, "%s: a coordinate of node %lld is not a finite number", source,
                             (long long)(i / data->dim));
    return 0;
}

/* order[i]: which of the reader's nodes is node i of the cell, by their reference coordinates. */
static int match_nodes(const pf_mesh_data *data, const fe_cell *type, const char *source, int *order, error *err)
{
    for (int i = 0; i < type->n_node; i++) {
        order[i] = -1;
        for (int k = 0; k < type->n_node; k++) {
            double d = 0;

            for (int a = 0; a < type->dim; a++)
                d += fabs(data->reference[k * type->dim + a] - type->x[i][a]);
            order[i] = d < 1e-6 ? k : order[i];
        }
        if (order[i] < 0)
            return error_set(err, ERR_MESH, "%s: the reader's %s has no node at (%g, %g, %g)", source, type->name,
                             type->x[i][0], type->x[i][1], type->x[i][2]);
    }
    return 0;
}

int mesh_create_from_data(const pf_mesh_data *data, const char *source, mesh *m, error *err)
{
    int order[FE_MAX_NODES], status;
    arena room = {0};

    memset(m, 0, sizeof *m);
    TRY(check_data(data, fe_cell_of((int)data->type), source, err));
    m->dim = (int)data->dim;
    m->type = fe_cell_of((int)data->type);
    m->n_node = data->n_node;
    m->n_cell = data->n_cell;
    ARENA_NEW(&m->memory, m->x, m->n_node * m->dim, err);
    memcpy(m->x, data->x, (size_t)(m->n_node * m->dim) * sizeof *m->x);
    TRY(match_nodes(data, m->type, source, order, err));
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
    status = find_boundary(m, data, source, &room, err);
    arena_free(&room);
    return status;
}
