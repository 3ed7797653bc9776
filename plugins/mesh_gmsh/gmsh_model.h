/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * gmsh_model.h -- a Gmsh model on its way to a mesh.  gmsh_model.c opens, meshes and picks the
 * cells, gmsh_arrays.c renumbers them; both run in the child process that mesh_gmsh.c starts. */
#ifndef GMSH_MODEL_H
#define GMSH_MODEL_H

#include <stddef.h>
#include <stdint.h>

enum { MAX_NODES = 27, TEXT = 1024, MAX_TYPES = 32, MAX_COUNT = INT32_MAX };

/* What goes through the pipe, followed by x, cell, facet, facet_name, names (each ended by 0). */
typedef struct wire {
    int32_t status;
    uint32_t dim, type, n_local, facet_vertices;
    int64_t n_node, n_cell, n_facet, n_name, n_text;
    double reference[MAX_NODES * 3];
    char text[TEXT];
} wire;

typedef struct node {
    size_t tag;
    int64_t number; /* in the mesh handed out, -1 = not used by a cell */
    double x[3];
} node;

/* The mesh while it is built in the child. */
typedef struct build {
    const char *path;
    wire *w;
    node *node; /* ascending tags */
    size_t n_all;
    double *x;
    int64_t *cell, *facet, cell_room, facet_room;
    int32_t *facet_name;
    char *names;
    int gmsh_type; /* of the cells */
} build;

typedef struct kind {
    int type, order, n_node, n_primary;
    char name[48];
    int64_t count;
} kind;

/* The model of b->path, meshed in dimension dim (0: its highest), with cells of one type. */
int model_open(build *b, int dim);
/* Its nodes, cells and named boundaries as arrays. */
int model_read_nodes(build *b);
int model_read_cells(build *b);
int model_read_boundaries(build *b);

/* Sets status and text of b->w; returns the status. */
int model_fail(build *b, int status, const char *fmt, ...) __attribute__((format(printf, 3, 4)));
/* PF_MESH_BAD with Gmsh's own words. */
int model_gmsh_failed(build *b, const char *what, const char *advice);
int model_has_suffix(const char *path, const char *suffix);
/* n objects, at least one, zeroed; NULL when there are too many. */
void *model_array(int64_t n, size_t size);

/* Name, order and sizes of an element type; local (may be NULL) gets its nodes' coordinates. */
int model_properties(int type, kind *k, double *local);

/* Elements of one entity: f(b, type, node tags, number of tags, arg) for each type there. */
typedef int element_fn(build *b, int type, const size_t *tag, size_t n_tag, void *arg);

int model_each_type(build *b, int dim, int entity, element_fn *f, void *arg);
/* f on all entities that hold cells: those in a physical group, or all when there is no group. */
int model_each_cell_entity(build *b, element_fn *f, void *arg);

#endif
