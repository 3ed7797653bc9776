/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * space.h -- fields, the map from nodes to unknowns, and constraints.
 *
 * A carrier is what unknowns hang on: a mesh node or, after those, the problem as a whole, then the
 * bodies, then, if some field has one value a cell, the cells.  A group is a set of carriers whose unknowns couple;
 * there are four types:
 *
 *     cell       its nodes (and the problem, and itself)
 *     attached   a cell and a body near it: the nodes, (the problem, the cell,) the body
 *     link       two bodies, or a body alone
 *     tie        a cell with too little fluid and its root: the nodes of both
 *
 * A carrier's unknowns are numbered consecutively, field by field, component by component
 * ("interleaved by node").  Unknowns are numbered twice: all of them ("dof", 0..n_dof-1) and
 * those that nothing fixes ("free", 0..n_free-1), which make up the matrix.
 * Today all unknowns are owned by this process. */
#ifndef SPACE_SPACE_H
#define SPACE_SPACE_H

#include "base/arena.h"
#include "base/error.h"
#include "mesh/mesh.h"
#include "space/kept.h"
#include "term/term.h"

#include <stdint.h>

enum { SPACE_MAX_FIELDS = TERM_MAX_FIELDS };

/* Why an unknown is not in the matrix. */
enum space_fixed {
    SPACE_PRESCRIBED = 1, /* a boundary condition, or the given motion of a body, holds it        */
    SPACE_AWAY = 2        /* of a field inside of bodies (PF_IN_PARTICLES), and no body is near    */
};

/* Which carriers couple, as the last pattern had it. */
typedef struct space_graph {
    int64_t *start;    /* [n_carrier + 1]; NULL: there is none */
    int32_t *list;     /* [start[n_carrier]] carriers with free unknowns, ascending  */
    uint8_t *spare;    /* of each: 1 only a spare pair couples them                  */
    int32_t *unknowns; /* [n_carrier] free ones                                      */
    uint8_t *special;  /* [n_carrier] 1: in some group that is no cell               */
    int64_t room, spare_room;
    arena memory;
} space_graph;

typedef struct space {
    const mesh *mesh;
    int n_field;
    const field_spec *field; /* [n_field] of the description */
    kept_fields kept;        /* memory of terms: no unknowns */

    int n_particle, any_problem, any_cell; /* some field is of the problem; has one value a cell */
    int64_t n_attached;                    /* pairs of a cell and a body near it */
    int crowded;                           /* bodies are near a large part of all cells: who attaches says so */
    int32_t *attached_cell, *attached_particle;
    int64_t n_link, link_room; /* pairs of bodies; -1: none                          */
    int32_t (*link)[2];
    int64_t n_tie, tie_room; /* pairs of cells: with too little fluid, its root    */
    int32_t (*tie)[2];
    int64_t n_spare, spare_room; /* pairs of cells that the pattern has entries for: ties may come there */
    int32_t (*spare)[2];
    int64_t n_carrier; /* mesh nodes, the problem, bodies, cells if needed */
    int cell_carriers; /* carriers of a cell: its nodes, then the problem and itself if needed, a body */
    int64_t n_dof, n_free;
    int32_t *first[SPACE_MAX_FIELDS]; /* [n_carrier] first dof of the field there, or -1           */
    uint8_t *dof_field, *dof_comp;    /* [n_dof]                                                    */
    int32_t *dof_node;                /* [n_dof] carrier                                            */
    uint8_t *fixed;                   /* [n_dof] enum space_fixed, or 0                             */
    int32_t *free_of;                 /* [n_dof] or -1                                              */
    int32_t *dof_of;                  /* [n_free]                                                   */
    int64_t *node_free;               /* [n_carrier + 1] first free unknown of each carrier         */
    int64_t *row_node;                /* free unknowns grouped by carrier, [n_row_node + 1]         */
    int64_t n_row_node;

    /* Matrix pattern over free unknowns; all unknowns of two carriers of one cell couple. */
    int64_t *row; /* [n_free + 1] */
    /* All rows of a carrier have the same columns, which are kept once: see space_column. */
    int32_t *col;
    int64_t *col_shift, n_col; /* [n_free]; entries of col */
    /* Of each group [size^2]: offset of carrier j's columns in the rows of carrier i, or -1. */
    int32_t *pair;      /* of cells */
    int32_t *more_pair; /* of attached cells, then of links */
    int32_t *tie_pair;  /* the same of ties */
    int64_t tie_pair_room;
    uint8_t *unused; /* [row[n_free]] 1: an entry that no group has, but a spare pair; NULL: there are none */
    int claims;      /* how often a tie has taken such entries  */
    space_graph graph;
    int64_t *cell_start; /* cells of each carrier, ascending */
    int32_t *cell_list;
    int outdated; /* groups have changed since the pattern was built */
    arena memory, attached_memory, pattern_memory;
} space;

/* Column of entry k of a row. */
static inline int32_t space_column(const space *s, int64_t row, int64_t k)
{
    return s->col[k + s->col_shift[row]];
}

int space_find_field(const space *s, const char *name); /* index or -1 */

/* Numbers all unknowns of these fields on a mesh with n_body bodies. */
int space_number(space *s, const field_list *fields, const mesh *m, int n_body, error *err);

/* Numbers free unknowns and builds the pattern (after `fixed` is set); may be called again. */
int space_constrain(space *s, error *err);

/* --- groups (groups.c) --- */

/* The pairs of cell and body that are near each other now (n of each); forgets all links, ties and spare entries.
 * The pattern is to be built anew.  Restricted
 * unknowns (PF_IN_PARTICLES) at their nodes enter the matrix, others leave it. */
int space_attach(space *s, const int32_t *cell, const int32_t *body, int64_t n, error *err);
/* All links come before the first tie.  b = -1: a body alone. */
int space_add_link(space *s, int a, int b, error *err);
/* *fits: the pattern has its entries; if not, it is to be built anew. */
int space_add_tie(space *s, int32_t bad, int32_t root, int *fits, error *err);
/* The next pattern will have entries for a tie of these cells, either way. */
int space_add_spare(space *s, int32_t a, int32_t b, error *err);

/* Number of groups; a cell's is its own number, those of the others: */
int64_t space_groups(const space *s);
int64_t space_attached_group(const space *s, int64_t attached);
int64_t space_link_group(const space *s, int64_t link);
int64_t space_tie_group(const space *s, int64_t tie);
/* Number of carriers of a group, and each: master node, the problem, a body; -1 if it has none there. */
int space_group_size(const space *s, int64_t group);
int32_t space_carrier(const space *s, int64_t group, int i);
int32_t space_body_carrier(const space *s, int body);
int32_t space_cell_carrier(const space *s, int64_t cell);
/* Whether a carrier has a place in the mesh, a node or the middle of a cell: x[3]. */
int space_place(const space *s, int64_t carrier, double *x);
/* 1: the field has one value a cell. */
static inline int space_of_cells(const field_spec *f)
{
    return f->support == PF_ON_MESH && f->order == 0;
}
/* Offsets of the group, [size][size]: of carrier j's columns in the rows of carrier i, or -1. */
const int32_t *space_pair(const space *s, int64_t group);
/* Length of `more_pair`. */
int64_t space_more_pairs(const space *s);
/* Node of the mesh that carries the unknowns of a node: itself, or its master on a periodic boundary. */
int32_t space_master(const space *s, int32_t node);

void space_graph_free(space_graph *g);
void space_destroy(space *s);

#endif
