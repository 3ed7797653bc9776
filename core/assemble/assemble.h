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
#include "space/space.h"
#include "term/term.h"

enum {
    ASSEMBLE_MAX_INPUTS = 32,
    ASSEMBLE_MAX_TESTS = 16,
    ASSEMBLE_MAX_USES = 32,
    ASSEMBLE_PAD = 3,
    SURFACE_POINTS = 16,
    ASSEMBLE_CELL_DEGREE = 5,
    ELEMENT_MOST_ENTRIES = 512 /* of an element vector */
};

/* Two bodies near each other, or a body and a wall. */
typedef struct near_pair {
    int64_t group;                   /* of their carriers (space.h)                        */
    int32_t particle;                /* the first of the two */
    double gap, h, at[3], normal[3]; /* normal: from the other to the first; at: in the middle of the gap */
    double size[2], density[2];      /* of each; of a wall infinite and 0 */
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
    int64_t n_solid, n_cut; /* attached pairs (space.h) covered; cells cut by a surface  */
    const int32_t *solid, *cut;
    const double *solid_weight, *cut_weight; /* inside of the body; outside of all bodies */
    int64_t n_surface;                       /* pieces of surface with SURFACE_POINTS points each       */
    const int32_t *surface;                  /* the attached pair of each                               */
    const double (*surface_ref)[3],
        (*surface_normal)[3];     /* of each point: reference coordinates; out of the fluid */
    const double *surface_weight; /* ds; 0 for points that fill up                         */
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
    void *ctx;
    /* At point x of a cell: w [dim]; history of each such field, one after the other.  0: w = 0. */
    int (*at)(void *ctx, int64_t cell, const double *x, double *w, double *history);
} moving_frame;

/* One distinct quantity at the points: (field, eval), or data of one use. */
typedef struct plan_input {
    int field; /* -1: data */
    uint32_t eval;
    int n_comp;
    size_t at; /* offset in units of n_q v8 */
    const value *data;
    v8 *table; /* data that is a function: [batch][n_comp][n_q] */
} plan_input;

/* What of a basis function.  Laplacians are of trial functions only. */
enum basis_kind { BASIS_VALUE, BASIS_GRAD, BASIS_LAPLACE };

/* Rows of workspace.basis: value, d/dx, d/dy, d/dz, Laplacian. */
enum { LAPLACE_ROW = 4, BASIS_ROWS = 5, TEST_ROWS = 4 };

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
    int in[TERM_MAX_SLOTS];    /* index into input[]                            */
    int out[TERM_MAX_SLOTS];   /* index into test[]                             */
    int trial[TERM_MAX_SLOTS]; /* index into trial[], -1 where no unknown        */
    int slope[TERM_MAX_SLOTS]; /* of du/dt in the fluid: its gradient there, for the moving frame; else -1 */
} plan_use;

/* Where the unknowns of an item stand in its element vector and matrix: carrier by carrier as in its group, and
 * there field by field and component by component as in the matrix, so that the columns of a carrier lie together.
 */
typedef struct element_layout {
    int n, width;                       /* entries; columns of the element matrix: n up to whole vectors     */
    int *at[SPACE_MAX_FIELDS];          /* [n_basis] first entry of each basis function, NULL: not used      */
    uint8_t *field, *carrier;           /* [n] of each entry; the carrier by its number in the group         */
    uint32_t coupled[SPACE_MAX_FIELDS]; /* bit g: rows of the field may have columns of field g      */
} element_layout;

/* Cells or facets with the same terms on them. */
typedef struct assembly_class {
    int where;
    int64_t n_item;
    int32_t *cell, *facet;
    int64_t *group; /* of each item: the carriers that it adds to (see space.h)       */
    element_layout layout;
    int32_t *dof;           /* [n_item][layout.n] unknown of each entry, -1: none (a wall)    */
    const near_pair *pair;  /* PF_PAIR: of each item */
    int follows;            /* items come with the bodies */
    const double *weight;   /* of such items: reference weights, [n_item][n_q]                 */
    const double (*ref)[3]; /* of such items: [n_item][n_q], see body_points */
    const double (*normal)[3];
    const uint8_t *off; /* PF_FLUID, whole cells: [n_cell] 1: this cell is none            */
    int64_t n_batch;
    int64_t *batch; /* first item of each batch, [n_batch + 1]                  */
    int n_slab;
    int64_t *slab; /* first batch of each slab, [n_slab + 2]; the last range is
                      the interface, done after the slabs by one thread         */
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

    int n_use, n_input, n_test, n_trial;
    plan_use use[ASSEMBLE_MAX_USES];
    plan_input input[ASSEMBLE_MAX_INPUTS];
    plan_basis test[ASSEMBLE_MAX_TESTS], trial[ASSEMBLE_MAX_TESTS];
    size_t block[ASSEMBLE_MAX_TESTS][ASSEMBLE_MAX_TESTS]; /* offset of D block, SIZE_MAX: no coupling */
    size_t in_size, test_size, block_size, out_size, jac_size, room_size, scratch_size;
    int order_used[3], grad_used[3], laplace_used[3];
    int any_laplace, any_metric;
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
    int n_use;              /* terms, each once, also those on points of several classes */
    term_use **use;
    const body_points *bodies;   /* of the last evaluation; NULL: none */
    int bodies_stamp;            /* of those that the classes have their items from */
    uint8_t *is_box;             /* [n_cell] 1: of a mesh of quads or hexes, sides along the axes */
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

/* Where the unknowns stand; all vectors have n_dof entries. */
typedef struct assembly_state {
    double t, dt, shift;
    const double *x, *dot, *old;
    const body_points *bodies; /* NULL: there are none */
    const moving_frame *frame; /* NULL: all history is at a place */
    double faded;              /* part of the terms with PF_CONTINUATION that is left out: 0 none, 1 all of them */
    uint32_t only;             /* not 0: only terms with one of these flags, or of one of these kinds */
    assembly_power *power;     /* NULL: nobody asks */
} assembly_state;

int assembly_create(assembly *a, const space *s, const assembly_spec *spec, int n_spec, int n_thread, error *err);

/* residual[n_dof] (of all unknowns, fixed ones too: their rows are reactions) and, unless NULL,
 * value[nnz] of the matrix over free unknowns; both are overwritten, and so is the power.  With `diagnose` every
 * term's output, and with a matrix its derivatives, are checked for NaN and infinity and the first culprit is
 * named. ERR_PLUGIN or ERR_CONVERGE (err->retry) if a term fails. */
int assembly_run(assembly *a, const assembly_state *s, double *residual, double *value, int diagnose, error *err);

void assembly_destroy(assembly *a);

/* --- between the files of this folder ------------------------------------------------- */

typedef struct workspace {
    v8 *x_node; /* [dim][nodes]                                            */
    v8 *gap, *size[2], *other_density;
    v8 *arm, *density;      /* [dim][n_q], [n_q] */
    int32_t *id;            /* [n_q][8] */
    v8 *w, *x, *normal, *h; /* [n_q], [dim][n_q], [dim][n_q], [n_q]                    */
    v8 *metric;             /* [dim*dim][n_q], see pf_batch; NULL: no class has it */
    /* Where the class has a tensor rule: dxi/dx [dim*dim][n_q], of a batch of boxes only its diagonal, the same at
     * all points, in scale; room for numbers at points by reference derivatives, and of the stages. */
    int boxes;
    v8 scale[3], *inverse, *reference, *stages;
    v8 *basis[3][BASIS_ROWS]; /* [order][value, d/dx, d/dy, d/dz, Laplacian]: [i][n_q], i padded; NULL: not used, or
                               the class has a tensor rule */
    v8 *dof;                  /* nodal values of one field                               */
    v8 *rate;                 /* [3 + 9][n_q] room: a field and its gradient */
    const v8 *frame;          /* w and history of this batch, see assembly_class; NULL: none */
    v8 *in, *test, *block, *out, *jac, *room;
    uint8_t *filled;     /* [block_size] 1: some term has that entry of D; others have no value */
    v8 *g;               /* one strip of D B_j                                      */
    v8 *vec, *mat;       /* element vector and matrix, see element_layout            */
    v8 *still, *unknown; /* zeros for a rate; the unknowns as the tests take them [test_size] */
    const v8 *unknown_of[ASSEMBLE_MAX_TESTS]; /* of each test of the class: there, or among the inputs */
    double (*power)[POWERS];                  /* [assembly.n_use] */
    void *scratch;
    term_report report;
    int64_t failed_batch;
    arena memory;
} workspace;

/* Marks the cells that are boxes (boxes.c). */
int boxes_find(assembly *a, error *err);
/* layout.c */
int layout_create(assembly *a, assembly_class *c, error *err);
/* Finds out whether the class has a tensor rule. */
int layout_tensor(assembly *a, assembly_class *c, error *err);
/* Unknowns of the items of a class. */
int layout_items(const assembly *a, assembly_class *c, arena *memory, error *err);
/* Adds the element vectors, the element matrices of the items of a batch (scatter.c). */
void scatter_vector(const assembly_class *c, int64_t batch, const workspace *w, double *residual);
void scatter_matrix(const assembly *a, const assembly_class *c, int64_t batch, const workspace *w, double *value);
/* Gives the classes that follow the bodies their items, if these are others than before (items.c). */
int items_take(assembly *a, const body_points *b, error *err);
int plan_create(assembly *a, assembly_class *c, const assembly_spec *spec, error *err);
/* Room for the values of the case's functions at the points of a class. */
int inputs_room(arena *memory, assembly_class *c, error *err);
int workspace_create(const assembly *a, workspace *w, error *err);
int inputs_functions(assembly *a, assembly_class *c, workspace *w, double t, error *err);
/* History along moving paths at all points near bodies; once per placement of these (history.c). */
int history_update(const assembly *a, assembly_class *c, workspace *w, const moving_frame *f, error *err);
/* Of the batch: takes an input du/dt over to the moving paths; w->dof: nodal values of its field now. */
void history_take(const assembly *a, const assembly_class *c, const assembly_state *s, const plan_input *in,
                  workspace *w);
/* Its part of the Jacobian: d(du/dt) = shift du - w . grad du. */
void history_jacobian(const pf_slot *out, const pf_slot *in, int n_trial, double factor, const double *jac, int dim,
                      size_t ld, const double *velocity, double *block, uint8_t *filled);
/* Laplacians of basis functions at a point, one a lane: M : d^2 n - e . dn with reference derivatives, where
 * M = G G^T, G = dxi/dx, and e = G (M : d^2 x) makes up for the curvature of the mapping (second.c). */
typedef struct laplacian {
    v8 m[FE_SECOND], e[3];
} laplacian;
laplacian laplacian_of(int dim, int n_node, const v8 *x_node, const double (*d2n)[FE_SECOND], v8 inv[3][3]);
v8 laplacian_apply(const laplacian *p, int dim, const double dn[3], const double d2n[FE_SECOND]);
/* Component (a, b) of pf_batch.metric; inv = dxi/dx. */
v8 metric_of(int dim, int simplex, v8 inv[3][3], int a, int b);
void geometry_points(const assembly *a, const assembly_class *c, int64_t batch, workspace *w);
/* inv = dxi/dx of j = dx/dxi; returns the determinant of j. */
v8 geometry_inverse(int dim, v8 j[3][3], v8 inv[3][3]);
/* The same where there is a tensor rule (boxes.c): without bases, with w->boxes, w->scale or w->inverse. */
void geometry_tensor(const assembly *a, const assembly_class *c, int64_t batch, workspace *w);
/* Nodal values w->dof of a field at the points; to [components of eval][n_q]. */
void interpolate(const assembly_class *c, const field_spec *f, int dim, uint32_t eval, workspace *w, v8 *to);
void inputs_values(const assembly *a, const assembly_class *c, const assembly_state *s, int64_t batch,
                   workspace *w);
/* The unknowns that the rows of the class belong to, as their test functions enter (value or gradient). */
void inputs_unknowns(const assembly *a, const assembly_class *c, const assembly_state *s, int64_t batch,
                     workspace *w);
/* Adds the power of a term with outputs `out` to w->power (power.c); the outputs are overwritten. */
int power_add(const assembly_class *c, const assembly_state *s, int64_t batch, const plan_use *p, double factor,
              const pf_batch *b, const double *const *in, double *const *out, workspace *w);
void power_clear(assembly *a);
/* The sums of all threads, in their order. */
void power_sum(const assembly *a, assembly_power *power);
/* Whether any term of the class takes part in this state. */
int evaluate_any(const assembly *a, const assembly_class *c, const assembly_state *s);
int evaluate_terms(const assembly *a, const assembly_class *c, const assembly_state *s, int64_t batch,
                   int with_matrix, int diagnose, workspace *w);
/* All rows of the field: in the vector, and in the matrix with the columns of the fields that it may couple with.
 */
void element_vector(const assembly *a, const assembly_class *c, int field, workspace *w);
void element_matrix(const assembly *a, const assembly_class *c, int field, workspace *w);

/* Sums of element_vector and element_matrix by tensor.c (element_tensor.c): values [components][n_q] and gradients
 * of the rows, NULL: none; coefficients d[e][f] between components a and b. */
void element_vector_tensor(const assembly_class *c, int field, const field_spec *f, const v8 *value, const v8 *grad,
                           workspace *w);
void element_matrix_tensor(const assembly_class *c, int row_order, int column_order,
                           const v8 *d[TEST_ROWS][BASIS_ROWS], const int32_t *place, v8 *mat, workspace *w);

/* Item of lane l of a batch; lanes past the end repeat the last one. */
static inline int64_t assemble_item(const assembly_class *c, int64_t batch, int lane)
{
    int64_t first = c->batch[batch], last = c->batch[batch + 1] - 1, i = first + lane;

    return i < last ? i : last;
}

static inline int assemble_padded(int n)
{
    return (n + ASSEMBLE_PAD - 1) / ASSEMBLE_PAD * ASSEMBLE_PAD;
}

/* Carrier of local node i of a field on a cell (index into the cell's carriers). */
static inline int assemble_local(const space *s, int field, int i)
{
    const fe_cell *type = s->mesh->type;

    if (s->field[field].order)
        return s->field[field].order == 2 ? i : type->vertex[i];
    return type->n_node + (s->field[field].support == PF_ON_PARTICLE ? s->any_problem : 0);
}

/* The same on an item of a class: a pair lists two bodies, a bad cell and its root the nodes of both. */
static inline int assemble_item_local(const assembly_class *c, const space *s, int field, int i)
{
    int n = fe_n_basis(s->mesh->type, s->field[field].order);

    if (c->where == PF_PAIR)
        return i;
    return i < n ? assemble_local(s, field, i) : s->mesh->type->n_node + assemble_local(s, field, i - n);
}

#endif
