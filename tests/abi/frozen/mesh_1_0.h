/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * mesh.h -- what a plugin that reads meshes offers.  One exported symbol: pf_mesh_entry.
 * Cells are of second order: their nodes hold the geometry, straight or curved. */
#ifndef PLUGFLOW_MESH_H
#define PLUGFLOW_MESH_H

#include <stddef.h>
#include <stdint.h>

#define PF_MESH_MAJOR 1u

enum pf_cell_type { PF_TRI6 = 1, PF_QUAD9 = 2, PF_TET10 = 3, PF_HEX27 = 4 };

/* A mesh as read.  Arrays belong to the reader until its release().  Every cell and facet
 * lists its nodes with the reference coordinates of node i in reference[i*dim..]: quads and
 * hexes on [-1,1]^dim, triangles and tets on the unit simplex, so that no node order needs to be agreed. */
typedef struct pf_mesh_data {
    uint32_t size, dim, type; /* enum pf_cell_type                                */
    int64_t n_node, n_cell, n_facet;
    const double *x;         /* [n_node][dim], m                                 */
    const int64_t *cell;     /* [n_cell][nodes of the type]                      */
    const double *reference; /* [nodes of the type][dim]                         */
    const int64_t *facet;    /* [n_facet][facet_vertices]: vertices of named boundary facets */
    uint32_t facet_vertices;
    const int32_t *facet_name; /* [n_facet] index into name[]                      */
    int32_t n_name;
    const char *const *name; /* names of boundaries                              */
    void *owner;
} pf_mesh_data;

enum pf_mesh_status {
    PF_MESH_OK = 0,
    PF_MESH_BAD = 1,     /* the file or its content is wrong   */
    PF_MESH_NO_FILE = 2, /* it cannot be opened                */
    PF_MESH_MEMORY = 3
};

typedef struct pf_mesh_reader {
    uint32_t size, major, sizes;
    const char *name, *version;
    const char *const *suffix; /* ".msh", ".geo", NULL */
    int (*read)(const char *path, int dim /* 0: as the file says */, pf_mesh_data *out, char *err, size_t nerr);
    void (*release)(pf_mesh_data *);
} pf_mesh_reader;

typedef const pf_mesh_reader *pf_mesh_entry_fn(char *err, size_t nerr);
#endif
