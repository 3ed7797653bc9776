/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * assemble.h -- from terms at points to a residual vector and a matrix.
 *
 * Cells go through in batches of 8, one a SIMD lane.  Of a batch, the fields are interpolated at
 * the points of all its cells; every term adds its coefficients at the points; then, once,
 *
 *     r_i += sum_q w B_i^T s,      K_ij += sum_q w B_i^T D B_j,      B = (value, gradient)
 *
 * is formed and scattered (where a term asks for it, B_j of trial functions has a Laplacian too).  Arrays over
 * points are [component][n_q * 8], lane = q * 8 + cell. */
#ifndef ASSEMBLE_ASSEMBLE_H
#define ASSEMBLE_ASSEMBLE_H

#include "assemble/tensor.h"
#include "base/value.h"
#include "particle/particle.h"
#include "space/locate.h"
#include "space/space.h"
#include "term/term.h"

enum {
    ASSEMBLE_MAX_INPUTS = 64,
    ASSEMBLE_MAX_TESTS = 16,
    ASSEMBLE_MAX_USES = 32,
    ASSEMBLE_PAD = 3,
    SURFACE_POINTS = 16,
    ASSEMBLE_CELL_DEGREE = 5,
    ASSEMBLE_MAX_LAWS = 8,
    ASSEMBLE_MAX_CHAINS = 24,
    SLAB_ROUNDS = 2,            /* of slabs that run at once */
    ELEMENT_MOST_ENTRIES = 1024 /* of an element vector */
};

/* Two bodies near each other, or a body and a wall. */
typedef struct near_pair {
    int64_t group;                   /* of their carriers (space.h)                        */
    int32_t particle, other;         /* the first of the two; the other, -1: a wall */
    double gap, h, at[3], normal[3]; /* normal: from the other to the first; at: in the middle of the gap */
    double size[2], density[2];      /* of each; of a wall infinite and 0 */
    double other_centre[3];          /* of the image that is near; of a wall 0 */
    int32_t cell; /* that the middle of the gap lies in, -1: none; its reference coordinates there */
    double ref[3];
} near_pair;

/* The bodies at one instant, as the assembly needs them: points and weights of the classes that follow them, and
 * the unknowns that are off.  Weights are of the reference cell, [n][points of the cut rule]. */
typedef struct body_points {
    int stamp;                /* another one for every placement of the bodies, never 0   */
    const solid *body;        /* [n_body]                                                 */
    const double *density;    /* [n_body] kg/m^3                                          */
    const uint8_t *idle;      /* [n_dof] 1: in the matrix, but off now (identity row)     */
    const double (*shift)[3]; /* of attached pairs: from the body to its image there       */
    const uint8_t *off;       /* [n_cell] not 0: a body is near, and may cover a part of it */
    int64_t n_pair;
    const near_pair *pair;
    double pair_size, pair_h; /* largest size of a body and of a cell, m: what the reach of terms goes by */
    int64_t n_solid, n_cut;   /* attached pairs (space.h) covered; cells cut by a surface  */
    const int32_t *solid, *cut;
    const double *solid_weight, *cut_weight; /* inside of the body; outside of all bodies */
    int64_t n_surface;                       /* pieces of surface with SURFACE_POINTS points each       */
    const int32_t *surface;                  /* the attached pair of each                               */
    const double (*surface_ref)[3],
        (*surface_normal)[3];     /* of each point: reference coordinates; out of the fluid */
    const double *surface_weight; /* ds; 0 for points that fill up                         */
    const double *curvature;      /* of each point, see pf_batch; NULL: no term may read it */
    int64_t n_tie;                /* cells with too little fluid, tied to their roots       */
    const int64_t *tie;           /* group of the carriers of both                          */
    const int32_t *tie_cell;
    const double *tie_weight;
    const double *integral[SPACE_MAX_FIELDS]; /* [n_dof] of each basis function over the fluid; NULL: not known */
    const double (*tie_ref)[3];               /* [n_tie][points of a cell] reference coordinates in the root */
} body_points;

/* Near moving bodies history comes along paths that follow the body, not from the place itself:
 *
 *     du/dt = shift u + history - w . grad u,    w the velocity of the path in the sense of the time scheme. */
typedef struct moving_frame {
    int stamp;           /* another one whenever bodies or history are others  */
    const uint8_t *cell; /* [n_cell] 1: there may be points with w != 0 in it */
    uint32_t fields;     /* bit f: field f has its history along the paths     */
    const double *u;     /* [n_dof] history at places */
    int one_thread;      /* `at` must not run on two at once */
    void *ctx;
    /* At point x of a cell: w [dim]; history of each such field, one after the other.  0: w = 0. */
    int (*at)(void *ctx, int64_t cell, const double *x, double *w, double *history);
    /* Where the point of this body (-1: of the fluid) that is at x now was at the end of the last step: the cell
     * and the place in it.  0: here.  BEFORE_BESIDE: x is not of the body (the fluid), what is beside it was there.
     * NULL: memory is of this instant.
     */
    int (*before)(void *ctx, int64_t cell, const double *x, int body, located *then);
} moving_frame;

enum { BEFORE_MOVED = 1, BEFORE_BESIDE = 2 };

/* One distinct quantity at the points: (field, eval), data of one use, a key of the bodies, or a property. */
typedef struct plan_input {
    int field; /* -1: data, a key, a property, or memory: */
    int kept;  /* its number (space/kept.h), or -1 */
    uint32_t eval;
    int n_comp;
    size_t at; /* offset in units of n_q v8 */
    const value *data;
    const double *key;    /* [n_body][n_comp] */
    v8 *table;            /* data that is a function: [batch][n_comp][n_q] */
    const term_use *law;  /* who publishes it */
    const double *number; /* a property that nobody publishes: the number of a term */
    int frozen;           /* PF_PAIR: a field on the mesh, at the last step in the middle of the gap */
} plan_input;

/* What of a basis function.  Laplacians are of trial functions only.  On pairs the value is what differs
 * (PF_DEFECT), and there are the values of the first body and of the other alone; in bad cells (PF_CUT) it is what
 * differs, too, and there are trial functions of their own. */
enum basis_kind { BASIS_VALUE, BASIS_GRAD, BASIS_LAPLACE, BASIS_FIRST, BASIS_OTHER, BASIS_OWN, BASIS_KINDS };

/* Rows of workspace.basis: value, d/dx, d/dy, d/dz, Laplacian, own value; on pairs what differs, first, other. */
enum { FIRST_ROW = 1, OTHER_ROW = 2, LAPLACE_ROW = 4, OWN_ROW = 5, BASIS_ROWS = 6, TEST_ROWS = 4 };

/* One distinct (field, kind) of test or trial functions. */
typedef struct plan_basis {
    int field;
    enum basis_kind kind;
    int n_comp;
    size_t at;
} plan_basis;

typedef struct plan_use {
    term_use *use;
    int number;                /* of the use in all classes, see assembly.use     */
    int inside;                /* index into input[]: acts where that is above 0; -1: everywhere */
    int in[TERM_MAX_SLOTS];    /* index into input[]                            */
    int out[TERM_MAX_SLOTS];   /* index into test[]; -1: memory, which enters no equation */
    int kept[TERM_MAX_SLOTS];  /* of such an output: index into input[] of what was kept before; else -1 */
    int equations;             /* some output enters an equation */
    int trial[TERM_MAX_SLOTS]; /* index into trial[], -1 where no unknown        */
    int slope[TERM_MAX_SLOTS]; /* of du/dt in the fluid: its gradient there, for the moving frame; else -1 */
    int varies;                /* it takes a property that depends on unknowns */
} plan_use;

/* A publisher of properties, evaluated before the terms; its inputs and outputs are all among input[]. */
typedef struct plan_law {
    const term_use *use;
    int in[TERM_MAX_SLOTS], out[TERM_MAX_SLOTS];
} plan_law;

/* d property / d unknown: [component of the property][component of the slot], by way of other properties, too. */
typedef struct plan_chain {
    int property, unknown; /* index into input[] */
    const pf_slot *slot;   /* the unknown, as the publisher takes it */
    int trial, slope;      /* as in plan_use */
    size_t at;             /* in workspace.chain, units of n_q v8 */
} plan_chain;

/* Where the unknowns of an item stand in its element vector and matrix: carrier by carrier as in its group, and
 * there field by field and component by component as in the matrix, so that the columns of a carrier lie together.
 */
typedef struct element_layout {
    int n, width;                       /* entries; columns of the element matrix: n up to whole vectors     */
    int *at[SPACE_MAX_FIELDS];          /* [n_basis] first entry of each basis function, NULL: not used      */
    uint8_t *field, *carrier;           /* [n] of each entry; the carrier by its number in the group         */
    uint32_t coupled[SPACE_MAX_FIELDS]; /* bit g: rows of the field may have columns of field g      */
} element_layout;

/* Rows of a body that a slab sums on its own (shares.c): at a->share_sum + at first the residual, by entry of the
 * element vector, then the matrix, whose rows of a carrier lie in one piece. */
typedef struct body_share {
    int32_t carrier;
    int64_t at, first_value, n_value;
} body_share;

/* Cells or facets with the same terms on them. */
typedef struct assembly_class {
    int where;
    int64_t n_item;
    int32_t *cell, *facet;
    int64_t *group; /* of each item: the carriers that it adds to (see space.h)       */
    element_layout layout;
    int32_t *dof;          /* [n_item][layout.n] unknown of each entry, -1: none (a wall)    */
    const near_pair *pair; /* PF_PAIR: of each item */
    int serial;            /* one slab                                                      */
    int32_t *source;       /* of each item: its number where items come from, as in body_points */
    int n_share;
    body_share *share;
    int32_t *share_of;      /* [slab][n_body] 1 + number of the share, 0: adds directly; NULL: no shares */
    int follows;            /* items come with the bodies */
    const double *weight;   /* of such items: reference weights, [n_item][n_q]                 */
    const double (*ref)[3]; /* of such items: [n_item][n_q], see body_points */
    const double (*normal)[3];
    const uint8_t *off; /* PF_FLUID, whole cells: [n_cell] 1: this cell is none            */
    int64_t n_batch;
    int64_t *batch; /* first item of each batch, [n_batch + 1]                  */
    int n_slab;     /* in each round */
    int64_t *slab;  /* first batch of each slab, [SLAB_ROUNDS * n_slab + 2]; the last range is done by one thread */
    int64_t *first_fresh; /* of each batch, [n_batch + 1], in: */
    int32_t *fresh;       /* nodes that no earlier batch has; NULL: not all nodes of the mesh are in some batch */
    int n_q;
    int n_basis[3];  /* basis functions of a field of each order on an item: of two cells, two bodies */
    fe_rule rule[6]; /* [0], or one per local facet                              */
    double tangent[6][2][3];
    int orient[6];
    tensor_rule
        *tensor; /* points and bases are products of those on a line: sums by tensor.c; NULL: they are not */
    int32_t *place[SPACE_MAX_FIELDS][SPACE_MAX_FIELDS]; /* of such a class: see tensor_matrix; NULL: no coupling */
    double *n_ref[6][3]; /* [order][q][i], basis of order 1 and 2 at the points       */
    double (*dn_ref[6][3])[3];
    double (*d2n_ref[6][3])[FE_SECOND]; /* where Laplacians are asked for, else NULL; order 2 is the mapping's */

    int n_use, n_input, n_test, n_trial, n_law, n_chain;
    plan_use use[ASSEMBLE_MAX_USES];
    plan_law law[ASSEMBLE_MAX_LAWS]; /* a law after those whose properties it takes */
    plan_chain chain[ASSEMBLE_MAX_CHAINS];
    plan_input input[ASSEMBLE_MAX_INPUTS];
    plan_basis test[ASSEMBLE_MAX_TESTS], trial[ASSEMBLE_MAX_TESTS];
    size_t block[ASSEMBLE_MAX_TESTS][ASSEMBLE_MAX_TESTS]; /* offset of D block, SIZE_MAX: no coupling */
    size_t in_size, test_size, block_size, out_size, jac_size, room_size, scratch_size, chain_size, product_size;
    int order_used[3], grad_used[3], laplace_used[3], own_used[3];
    int any_laplace, any_metric, any_kept; /* any_kept: some term reads or keeps memory */
    double *kept_weight; /* [n_q][points of space.kept] of the values at a cell's points; NULL: n_q are these */
    int kept_stamp;      /* of the moving frame that these values come along: */
    int64_t *kept_at;    /* [n_batch] where in `kept` those of a batch are, -1: they rest */
    v8 *kept;            /* of each memory input [n_comp][n_q] */
    arena kept_memory;
    int any_body_data, any_wall; /* some term may read what 1.4 has of bodies; has PF_WALL_DISTANCE: */
    v8 *wall;                    /* [n_batch][n_q] distances from walls, once the items are known */
    int wall_ready;
    arena wall_memory; /* of those of cells and facets */
    double data_time;
    int data_ready;
    int frame_stamp;   /* of the moving frame whose values these are: */
    int64_t *frame_at; /* [n_batch] where in `frame` those of a batch are, -1: nowhere           */
    v8 *frame;         /* w [dim][n_q], then of each field of the frame its history [n_comp][n_q] */
    arena frame_memory;
    arena item_memory; /* what changes with the bodies                               */
} assembly_class;

typedef struct assembly {
    const space *space;
    int n_thread, n_class;
    assembly_class *class_;
    struct workspace *work; /* [n_thread] */
    double *share_sum;      /* see body_share */
    int64_t share_room;
    arena share_memory;
    int n_use; /* terms, each once, also those on points of several classes */
    term_use **use;
    const body_points *bodies;   /* of the last evaluation; NULL: none */
    int bodies_stamp;            /* of those that the classes have their items from */
    const struct wall *walls;    /* where wall distances are from; NULL: there are none */
    int clears;                  /* batches of the first class zero the rows that they come to first */
    uint8_t *none_idle;          /* [n_dof] zero */
    const uint8_t *idle;         /* [n_dof] of the last evaluation */
    int32_t *row_of, *column_of; /* [n_dof] of the matrix that is formed: row; column within those of its carrier;
                                    -1: the unknown is prescribed, or off now */
    arena memory;
} assembly;

/* What a class is made of. */
typedef struct assembly_spec {
    int where;               /* enum pf_where                                           */
    const uint8_t *facet_on; /* PF_FACET: [mesh->n_facet] 1 = the facet belongs to it   */
    const cut_rule *rule;    /* PF_SOLID, PF_FLUID in cut cells: the points             */
    int n_use;
    term_use **use;
} assembly_spec;

/* Kinds of terms beside the flags of the interface. */
enum {
    ASSEMBLE_COUPLING = 1 << 30, /* on points of bodies, with a field of the mesh: what bodies and fluid exchange */
    ASSEMBLE_CONTACT = 1 << 29,  /* on pairs */
    ASSEMBLE_INERTIA = 1 << 28   /* d/dt of a field on its own test function */
};

/* The power of a term: its rows, each times its own unknown, added up. */
enum {
    POWER_ALL,     /* of the term as it is                                                      */
    POWER_REST,    /* without rates: 0 in the place of every d/dt; of a term without any the same */
    POWER_KINETIC, /* the energy whose rate is the other part: half the power with each unknown in the place of its
                    * rate, less POWER_REST */
    POWERS
};

typedef struct assembly_power {
    uint32_t fields;       /* bit f: rows of field f count     */
    double (*use)[POWERS]; /* [assembly.n_use]                 */
} assembly_power;

/* What shown terms of a class give.  Items stand in the order of where they come from (assembly_class.source),
 * which hangs on no number of threads. */
typedef struct shown_class {
    int field[ASSEMBLE_MAX_TESTS]; /* of each output: the field of `to` that it is projected on, -1: its integral */
    int at[ASSEMBLE_MAX_TESTS];    /* of an integral: its first column in `sum`                       */
    int width, projects;           /* columns; whether any is projected                              */
    int64_t *item;                 /* [n_item] number in the class                                     */
    double *sum;                   /* [n_item][width] integrals over the item                         */
    double *mass; /* [n_item][n (n+1) / 2] integrals of products of vertex functions, upper half; NULL: !projects */
    double *measure; /* [n_item] */
} shown_class;

/* Where it goes.  The owner fills in `to` and the first two lines of each class. */
typedef struct assembly_shown {
    const space *to;     /* fields of order 1 that are projected                                   */
    double *load;        /* [to->n_dof] integrals of the quantities times the vertex functions      */
    shown_class *class_; /* [n_class] */
    arena memory;        /* of what the items have                                         */
} assembly_shown;

/* Sees what every term is given, after it was evaluated, from the thread that did it. */
typedef struct assembly_watch {
    void (*look)(void *ctx, const term_use *use, const pf_batch *b, const double *const *in);
    void *ctx;
} assembly_watch;

/* Where the unknowns stand; all vectors have n_dof entries. */
typedef struct assembly_state {
    double t, dt, shift;
    const double *x, *dot, *old;
    const double *kept;        /* memory at the end of the last step (space/kept.h); NULL: all zero */
    const double (*fluid)[6];  /* [n_body] force (3) and torque (3; 2D: the first) of the fluid at the end of the
                                * last  step; NULL: 0 */
    const body_points *bodies; /* NULL: there are none */
    const moving_frame *frame; /* NULL: all history is at a place */
    double faded;              /* part of the terms with PF_CONTINUATION that is left out: 0 none, 1 all of them */
    uint32_t only;             /* not 0: only terms with one of these flags, or of one of these kinds */
    assembly_power *power;     /* NULL: nobody asks */
    struct assembly_shown *shown; /* of assembly_show */
    const assembly_watch *watch;  /* NULL: nobody looks */
} assembly_state;

int assembly_create(assembly *a, const space *s, const assembly_spec *spec, int n_spec, int n_thread, error *err);

/* residual[n_dof] (of all unknowns, fixed ones too: their rows are reactions) and, unless NULL,
 * value[nnz] of the matrix over free unknowns; both are overwritten, and so is the power.  With `diagnose` every
 * term's output, and with a matrix its derivatives, are checked for NaN and infinity and the first culprit is
 * named. ERR_PLUGIN or ERR_CONVERGE (err->retry) if a term fails. */
int assembly_run(assembly *a, const assembly_state *s, double *residual, double *value, int diagnose, error *err);

/* Evaluates an assembly of shown terms; to s->shown.  ERR_PLUGIN if a term fails, or gives NaN or infinity at a
 * point that has a weight: it is named. */
int assembly_show(assembly *a, const assembly_state *s, error *err);
/* The memory that terms keep at the end of a step, of its solution; kept[space->kept.n_value] holds that of its
 * start, and is overwritten where a term keeps something.  Errors as assembly_run. */
int assembly_keep(assembly *a, const assembly_state *s, double *kept, error *err);

void assembly_destroy(assembly *a);

#endif
