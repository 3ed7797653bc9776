/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * space.h -- fields, the map from nodes to unknowns, and constraints.
 *
 * A carrier is what unknowns hang on: a mesh node or, after those, the problem as a whole, then the
 * particles.  A group is a set of carriers whose unknowns couple: the nodes of a cell (and the problem),
 * or a cell and a particle near it, or an extra list of carriers: two particles, two cells.
 * A carrier's unknowns are numbered consecutively, field by field, component by component
 * ("interleaved by node").  Unknowns are numbered twice: all of them ("dof", 0..n_dof-1) and
 * those that no Dirichlet condition fixes ("free", 0..n_free-1), which make up the matrix.
 * Today all unknowns are owned by this process. */
#ifndef SPACE_SPACE_H
#define SPACE_SPACE_H

#include "base/arena.h"
#include "base/error.h"
#include "mesh/mesh.h"

#include <plugflow/plugin.h>

#include <stdint.h>

enum { SPACE_MAX_FIELDS = 16 };

typedef struct space_field {
    const char *name, *unit, *doc, *reaction, *reaction_unit;
    const char *declared_by; /* plugin that declared it first */
    const char *constrains;  /* restricted fields: the field they hold, or NULL */
    int shape;
    int n_comp;
    int order;   /* 0 (off the mesh), 1 or 2      */
    int support; /* enum pf_support               */
} space_field;

typedef struct space {
    mesh *mesh;
    int n_field;
    space_field field[SPACE_MAX_FIELDS];

    int n_particle, any_problem;
    int64_t n_attached; /* pairs of a cell and a particle near it                     */
    int32_t *attached_cell, *attached_particle;
    int64_t n_extra;      /* extra groups, and the carriers of each                     */
    int64_t *extra_first; /* [n_extra + 1] */
    int32_t *extra_carrier;
    int64_t n_carrier; /* mesh nodes + 1                                             */
    int cell_carriers; /* carriers of a cell: its nodes, then the problem if needed  */
    int64_t n_dof, n_free;
    int32_t *first[SPACE_MAX_FIELDS]; /* [n_carrier] first dof of the field there, or -1           */
    uint8_t *dof_field, *dof_comp;    /* [n_dof]                                                    */
    int32_t *dof_node;                /* [n_dof] carrier                                            */
    uint8_t *idle;                    /* [n_dof] 1: in the matrix, but off now (identity row)       */
    uint8_t *fixed;                   /* [n_dof] 1: prescribed by a Dirichlet condition             */
    int32_t *free_of;                 /* [n_dof] or -1                                              */
    int32_t *dof_of;                  /* [n_free]                                                   */
    int64_t *node_free;               /* [n_carrier + 1] first free unknown of each carrier         */
    int64_t *row_node;                /* free unknowns grouped by carrier, [n_row_node + 1]         */
    int64_t n_row_node;

    /* Matrix pattern over free unknowns; all unknowns of two carriers of one cell couple. */
    int64_t *row, *col;  /* [n_free + 1], [row[n_free]]                                */
    int32_t *pair;       /* of each group [size^2]: offset of carrier j's columns in
                            the rows of carrier i, or -1                               */
    int64_t *extra_pair; /* [n_extra] where those of the extra groups start */
    arena memory, pattern_memory;
} space;

/* Adds a field, or checks that it agrees with the one of this name. */
int space_add_field(space *s, int dim, const pf_field *f, const char *plugin, error *err);
int space_find_field(const space *s, const char *name); /* index or -1 */

/* Numbers all unknowns (after all fields are known). */
int space_number(space *s, mesh *m, error *err);

/* Numbers free unknowns and builds the pattern (after `fixed` is set); may be called again. */
int space_constrain(space *s, error *err);

/* Number of groups: cells, then pairs of cell and particle, then the extra ones. */
int64_t space_groups(const space *s);
/* Number of carriers of a group, and each: master node, the problem, the particle; -1 if it has none there. */
int space_group_size(const space *s, int64_t group);
int32_t space_carrier(const space *s, int64_t group, int i);
/* The part of `pair` of this group, [size][size]. */
const int32_t *space_pair(const space *s, int64_t group);
/* Node of the mesh that carries the unknowns of a node: itself, or its master on a periodic boundary. */
int32_t space_master(const space *s, int32_t node);

void space_destroy(space *s);

#endif
