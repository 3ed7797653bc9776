/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Nodes, cells and boundary facets of a Gmsh model as contiguous arrays.
 *
 * Nodes are numbered in the order in which cells use them; nodes of no cell are left out. */
#include "gmsh_model.h"

#include <plugflow/mesh.h>

#include <gmshc.h>

#include <math.h>
#include <stdlib.h>
#include <stdio.h>
#include <string.h>

static int no_memory(build *b, const char *what, int64_t n)
{
    return model_fail(b, PF_MESH_MEMORY, "no memory for %lld %s", (long long)n, what);
}

static int by_tag(const void *a, const void *b)
{
    size_t s = ((const node *)a)->tag, t = ((const node *)b)->tag;

    return (s > t) - (s < t);
}

int model_read_nodes(build *b)
{
    size_t *tag = NULL, n = 0, nx = 0, np = 0;
    double *x = NULL, *p = NULL;
    int err = 0;

    gmshModelMeshGetNodes(&tag, &n, &x, &nx, &p, &np, -1, -1, 0, 0, &err);
    if (err || n < 1 || nx / 3 != n)
        return model_gmsh_failed(b, "its nodes cannot be read", "write the file again");
    if (n > MAX_COUNT)
        return model_fail(b, PF_MESH_BAD, "has %zu nodes, too many", n);
    b->node = model_array((int64_t)n, sizeof *b->node);
    b->x = model_array((int64_t)n * b->w->dim, sizeof *b->x);
    if (!b->node || !b->x)
        return no_memory(b, "nodes", (int64_t)n);
    for (size_t i = 0; i < n; i++)
        b->node[i] = (node){tag[i], -1, {x[3 * i], x[3 * i + 1], x[3 * i + 2]}};
    b->n_all = n;
    qsort(b->node, n, sizeof *b->node, by_tag);
    gmshFree(tag);
    gmshFree(x);
    gmshFree(p);
    return 0;
}

static node *find_node(const build *b, size_t tag)
{
    node wanted = {.tag = tag};

    return bsearch(&wanted, b->node, b->n_all, sizeof wanted, by_tag);
}

/* Sign of the Jacobian at the first corner; Gmsh's corners 1, next and 4 lie along x, y, z of it. */
static int orientation(const build *b, const int64_t *cell)
{
    int next = b->w->type == PF_TRI6 || b->w->type == PF_TET10 ? 2 : 3, dim = (int)b->w->dim;
    int corner[3] = {1, next, next + 1};
    double e[3][3] = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}}, det;

    for (int k = 0; k < dim; k++)
        for (int a = 0; a < dim; a++)
            e[k][a] = b->x[cell[corner[k]] * dim + a] - b->x[cell[0] * dim + a];
    if (dim == 2)
        e[0][2] = e[1][2] = 0;
    det = e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) - e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
          e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
    return (det > 0) - (det < 0);
}

/* Swaps x and y of the reference cell: node i goes where its mirror image is. */
static void mirror(const build *b, int64_t *cell)
{
    const wire *w = b->w;
    int64_t old[MAX_NODES];

    memcpy(old, cell, w->n_local * sizeof *old);
    for (uint32_t i = 0; i < w->n_local; i++)
        for (uint32_t j = 0; j < w->n_local; j++) {
            const double *p = w->reference + i * w->dim, *q = w->reference + j * w->dim;

            if (fabs(p[0] - q[1]) + fabs(p[1] - q[0]) + (w->dim == 3 ? fabs(p[2] - q[2]) : 0) < 1e-6)
                cell[j] = old[i];
        }
}

static int add_cells(build *b, int type, const size_t *tag, size_t n_tag, void *arg)
{
    wire *w = b->w;
    int64_t first = w->n_cell, n = (int64_t)(n_tag / w->n_local), n_negative = 0;

    (void)arg;
    if (type != b->gmsh_type || n > b->cell_room - first)
        return model_fail(b, PF_MESH_BAD, "its cells changed while they were read");
    for (int64_t i = 0; i < n * w->n_local; i++) {
        node *p = find_node(b, tag[i]);

        if (!p)
            return model_fail(b, PF_MESH_BAD, "a cell refers to node %zu, which is not in the file", tag[i]);
        if (p->number < 0) {
            p->number = w->n_node++;
            memcpy(b->x + p->number * w->dim, p->x, w->dim * sizeof *p->x);
        }
        b->cell[first * w->n_local + i] = p->number;
    }
    w->n_cell += n;
    for (int64_t e = first; e < w->n_cell; e++)
        n_negative += orientation(b, b->cell + e * w->n_local) < 0;
    for (int64_t e = first; n_negative == n && e < w->n_cell; e++)
        mirror(b, b->cell + e * w->n_local);
    return 0;
}

/* A 2D mesh lies in a plane z = const; all coordinates are finite. */
static int check_nodes(build *b)
{
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY}, size;

    for (size_t i = 0; i < b->n_all; i++)
        for (int k = 0; b->node[i].number >= 0 && k < 3; k++) {
            if (!isfinite(b->node[i].x[k]))
                return model_fail(b, PF_MESH_BAD, "node %zu has a coordinate that is not finite", b->node[i].tag);
            low[k] = fmin(low[k], b->node[i].x[k]);
            high[k] = fmax(high[k], b->node[i].x[k]);
        }
    size = fmax(high[0] - low[0], high[1] - low[1]);
    if (b->w->dim == 2 && !(high[2] - low[2] <= 1e-9 * size))
        return model_fail(b, PF_MESH_BAD,
                          "is a surface in space (z from %g to %g); a 2D mesh must lie in a plane z = const, "
                          "a 3D mesh needs volume cells (gmsh -3, and a Physical Volume if there are groups)",
                          low[2], high[2]);
    return 0;
}

int model_read_cells(build *b)
{
    b->cell = model_array(b->cell_room * b->w->n_local, sizeof *b->cell);
    if (!b->cell)
        return no_memory(b, "cells", b->cell_room);
    if (model_each_cell_entity(b, add_cells, NULL))
        return b->w->status;
    return check_nodes(b);
}

typedef struct boundary {
    int32_t index;
    const char *name;
} boundary;

static int add_facets(build *b, int type, const size_t *tag, size_t n_tag, void *arg)
{
    const boundary *on = arg;
    wire *w = b->w;
    kind k;
    int64_t n;

    if (model_properties(type, &k, NULL) || k.n_node < 1 || k.n_primary != (int)w->facet_vertices)
        return model_fail(b, PF_MESH_BAD, "a boundary has facets of type %s, which do not fit the cells", k.name);
    n = (int64_t)(n_tag / (size_t)k.n_node);
    if (w->n_facet + n > b->facet_room) {
        int64_t room = 2 * (w->n_facet + n);
        int64_t *facet = room > MAX_COUNT ? NULL : reallocarray(b->facet, (size_t)room, 4 * sizeof *facet);
        int32_t *names = facet ? reallocarray(b->facet_name, (size_t)room, sizeof *names) : NULL;

        b->facet = facet ? facet : b->facet;
        if (!names)
            return no_memory(b, "boundary facets", room);
        b->facet_name = names;
        b->facet_room = room;
    }
    for (int64_t i = 0; i < n; i++, w->n_facet++)
        for (uint32_t v = 0; v < w->facet_vertices; v++) {
            const node *p = find_node(b, tag[i * k.n_node + v]);

            if (!p || p->number < 0)
                return model_fail(b, PF_MESH_BAD,
                                  "boundary \"%s\" has a facet that belongs to no cell; name only the "
                                  "boundary of the meshed region",
                                  on->name);
            b->facet[w->n_facet * w->facet_vertices + v] = p->number;
            b->facet_name[w->n_facet] = on->index;
        }
    return 0;
}

/* The group's name, new or known; a new one lies at names + n_text until it is counted. */
static int find_name(build *b, int tag, boundary *on)
{
    char *name = NULL, text[256], *names;
    int err = 0;

    gmshModelGetPhysicalName((int)b->w->dim - 1, tag, &name, &err);
    if (err || !name || !*name)
        snprintf(text, sizeof text, "boundary_%d", tag);
    else
        snprintf(text, sizeof text, "%s", name);
    gmshFree(name);
    on->name = b->names;
    for (on->index = 0; on->index < b->w->n_name; on->index++, on->name += strlen(on->name) + 1)
        if (strcmp(on->name, text) == 0)
            return 0;
    names = realloc(b->names, (size_t)b->w->n_text + sizeof text);
    if (!names)
        return no_memory(b, "boundary names", b->w->n_name + 1);
    b->names = names;
    on->name = strcpy(names + b->w->n_text, text);
    return 0;
}

int model_read_boundaries(build *b)
{
    int *group = NULL, *entity = NULL, err = 0, dim = (int)b->w->dim - 1;
    size_t n_group = 0, n_entity = 0;

    gmshModelGetPhysicalGroups(&group, &n_group, dim, &err);
    for (size_t g = 0; g + 1 < n_group; g += 2) {
        boundary on;

        if (find_name(b, group[g + 1], &on))
            return b->w->status;
        gmshModelGetEntitiesForPhysicalGroup(dim, group[g + 1], &entity, &n_entity, &err);
        for (size_t i = 0; i < n_entity && !err; i++)
            if (model_each_type(b, dim, entity[i], add_facets, &on))
                return b->w->status;
        gmshFree(entity);
        entity = NULL;
        if (on.index == b->w->n_name) {
            b->w->n_name++;
            b->w->n_text += (int64_t)strlen(on.name) + 1;
        }
    }
    gmshFree(group);
    return err ? model_gmsh_failed(b, "its physical groups cannot be read", "write the file again") : 0;
}
