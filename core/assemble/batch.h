/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * batch.h -- what the files of this folder share: the room of a thread, and the steps that a batch goes through. */
#ifndef ASSEMBLE_BATCH_H
#define ASSEMBLE_BATCH_H

#include "assemble/assemble.h"

/* What terms of interface 1.4 may read of bodies, as in pf_batch. */
typedef struct body_data {
    v8 *centre, *axes, *volume, *mass, *inertia;
    v8 *fluid_force, *fluid_torque, *other_centre, *other_axes, *other_arm, *curvature;
    int32_t *other_id;
    struct {
        const struct assembly_class *class_;
        int stamp;
        int32_t id;
        double centre[3];
    } last[PF_LANES]; /* whose data stand there, of a class with many points */
} body_data;

typedef struct workspace {
    v8 *x_node; /* [dim][nodes]                                            */
    v8 *gap, *size[2], *other_density;
    v8 *arm, *density;      /* [dim][n_q], [n_q] */
    int32_t *id;            /* [n_q][8] */
    v8 *w, *x, *normal, *h; /* [n_q], [dim][n_q], [dim][n_q], [n_q]                    */
    body_data body;
    v8 *metric; /* [dim*dim][n_q], see pf_batch; NULL: no class has it */
    /* Where the class has a tensor rule: dxi/dx [dim*dim][n_q], of a batch of boxes only its diagonal, the same at
     * all points, in scale; room for numbers at points by reference derivatives, and of the stages. */
    int boxes;
    v8 scale[3], *inverse, *reference, *stages;
    v8 *basis[3][BASIS_ROWS]; /* [order][value, d/dx, d/dy, d/dz, Laplacian, own value]: [i][n_q], i padded; NULL:
                               not used, or the class has a tensor rule */
    v8 *dof;                  /* nodal values of one field                               */
    v8 *rate;                 /* room: a field and its gradient */
    const v8 *frame;          /* w and history of this batch, see assembly_class; NULL: none */
    v8 *in, *test, *block, *out, *jac, *room;
    v8 *chain, *product; /* d property / d unknown, see plan_chain; d output / d property times that */
    uint8_t *filled;     /* [block_size] 1: some term has that entry of D; others have no value */
    v8 *g;               /* one strip of D B_j                                      */
    v8 *vec, *mat;       /* element vector and matrix, see element_layout            */
    v8 *still, *unknown; /* zeros for a rate; the unknowns as the tests take them [test_size] */
    const v8 *unknown_of[ASSEMBLE_MAX_TESTS]; /* of each test of the class: there, or among the inputs */
    double (*power)[POWERS];                  /* [assembly.n_use] */
    double *kept;                             /* [VALUE_MAX][n_q] room, where there is memory */
    void *scratch;
    uint8_t *mask; /* [8 n_q] 1: the term at hand acts there; read only if ... */
    int masked;    /* ... it does not act everywhere                          */
    term_report report;
    int64_t failed_batch;
    arena memory;
} workspace;

/* The error of a batch that failed (assembly.c). */
int report_failure(const workspace *w, const assembly_class *c, error *err);
/* Orders the items of a class by slabs, in batches (slabs.c). */
int slabs_make(assembly *a, assembly_class *c, arena *memory, error *err);
/* shares.c: which bodies' rows have copies; the copies before the slabs run; that of an item, or NULL; afterwards.
 */
int shares_find(assembly *a, assembly_class *c, arena *memory, error *err);
int shares_clear(assembly *a, assembly_class *c, int with_matrix, error *err);
const body_share *shares_at(const assembly *a, const assembly_class *c, int slab, int64_t item);
void shares_add(const assembly *a, const assembly_class *c, double *residual, double *value);
/* fresh.c: lists the nodes that each batch comes to first; zeroes the matrix but for what the batches of the first
 * class zero then, returns whether they do; zeroes the rows of the nodes that are new in a batch. */
int fresh_find(const assembly *a, assembly_class *c, arena *memory, error *err);
int fresh_begin(const assembly *a, const assembly_state *s, double *value);
void fresh_clear(const assembly *a, const assembly_class *c, int64_t batch, double *value);
/* layout.c */
int layout_create(assembly *a, assembly_class *c, error *err);
/* Finds out whether the class has a tensor rule. */
int layout_tensor(assembly *a, assembly_class *c, error *err);
/* Unknowns of the items of a class. */
int layout_items(const assembly *a, assembly_class *c, arena *memory, error *err);
/* Adds the element vectors, the element matrices of the items of a batch (scatter.c). */
void scatter_vector(const assembly *a, const assembly_class *c, int64_t batch, int slab, const workspace *w,
                    double *residual);
void scatter_matrix(const assembly *a, const assembly_class *c, int64_t batch, int slab, const workspace *w,
                    double *value);
/* Room for n items of a class, from where they come; then, when cells and groups are known, their order (items.c).
 */
int items_room(assembly_class *c, int64_t n, arena *memory, error *err);
int items_order(assembly *a, assembly_class *c, arena *memory, error *err);
/* Gives the classes that follow the bodies their items, if these are others than before (items.c). */
int items_take(assembly *a, const body_points *b, error *err);
/* slots.c: numbers in the lists of the class, negative with *err.  An input that is no property (data, key: where
 * what is no field comes from, or NULL); the same, or a property, of slot k of a term; a test or trial function;
 * trial functions of an unknown and, for a rate in the fluid, its slopes, else -1.  Then the room that a term
 * needs. */
int slots_input(assembly_class *c, const space *s, const pf_slot *slot, const value *data, const double *key,
                error *err);
int slots_find(assembly_class *c, const space *s, const term_use *use, uint32_t k, error *err);
int slots_basis(assembly_class *c, const space *s, plan_basis *list, int *n, const pf_slot *slot, error *err);
/* An output that is shown has a place of its own among the test functions, and no field. */
int slots_shown(assembly_class *c, const space *s, const pf_slot *slot, error *err);
int slots_trial(assembly_class *c, const space *s, const pf_slot *slot, int *trial, int *slope, error *err);
void slots_sizes(assembly_class *c, const pf_term *t, int dim);
int plan_create(assembly *a, assembly_class *c, const assembly_spec *spec, error *err);
/* Room for the values of the case's functions at the points of a class. */
int inputs_room(arena *memory, assembly_class *c, error *err);
int workspace_create(const assembly *a, workspace *w, error *err);
int inputs_functions(assembly *a, assembly_class *c, workspace *w, double t, error *err);
/* History along moving paths at all points near bodies; once per placement of these (history.c). */
int history_update(const assembly *a, assembly_class *c, const moving_frame *f, error *err);
/* What a term sees of the points of a class (evaluate.c); its outputs [.] in w->out, before evaluate_end, which
 * completes the report and returns the status; whether an output is none, and reports it. */
pf_batch evaluate_batch(const assembly_class *c, const assembly_state *s, int dim, workspace *w);
int evaluate_term(const assembly_class *c, const plan_use *p, int64_t batch, pf_batch *b, const double **in,
                  double **out, workspace *w);
int evaluate_end(int status, workspace *w);
int evaluate_find_nan(const pf_term *t, const pf_batch *b, double *const *out, term_report *r);
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
/* On pieces of surface (surface.c). */
void geometry_surface(const assembly *a, const assembly_class *c, int64_t batch, workspace *w);
/* The one point of bodies (PF_PARTICLE) and of pairs (body_data.c, geometry.c). */
void points_of_bodies(const assembly *a, const assembly_class *c, int64_t batch, workspace *w);
/* What a term may read of bodies beside arm, density and number: room for it; of a batch; where it stands. */
int body_data_room(size_t n_q, size_t dim, workspace *w, error *err);
void body_data_take(const assembly *a, const assembly_class *c, const assembly_state *s, int64_t batch,
                    workspace *w);
void body_data_show(const assembly_class *c, const workspace *w, pf_batch *b);
/* Distances from walls at all points of a class; once for its items (walls.c). */
int walls_update(const assembly *a, assembly_class *c, error *err);
/* Places of the nodes of the cells of a batch, to w->x_node. */
void geometry_nodes(const assembly *a, const assembly_class *c, int64_t batch, workspace *w);
/* Of a batch of boxes, in each direction. */
void boxes_sides(const assembly *a, const assembly_class *c, int64_t batch, v8 *middle, v8 *half);
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
/* properties.c.  Of a batch: what is published there and, with a matrix, w->chain.  Nonzero, with w->report, if a
 * law fails, or gives no number. */
int properties_evaluate(const assembly_class *c, const assembly_state *s, int64_t batch, int with_matrix,
                        int diagnose, pf_batch *b, workspace *w);
/* The properties that a term takes lie where it makes sense (pf_slot.min, max), at points that count. */
int properties_fit(const assembly_class *c, const plan_use *p, const pf_batch *b, workspace *w);
/* d output / d property, [n_out][components of the property], times the chain: [n_out][components of its slot]. */
const double *properties_product(const assembly_class *c, const plan_chain *chain, const double *jac, int n_out,
                                 int dim, workspace *w);
/* The field of an input that is frozen, of the pairs of a batch (properties_pairs.c). */
void properties_frozen(const assembly *a, const assembly_class *c, const assembly_state *s, int64_t batch,
                       const plan_input *in, v8 *out);
/* Adds the power of a term with outputs `out` to w->power (power.c); the outputs are overwritten. */
int power_add(const assembly_class *c, const assembly_state *s, int64_t batch, const plan_use *p, double factor,
              const pf_batch *b, const double *const *in, double *const *out, workspace *w);
void power_clear(assembly *a);
/* The sums of all threads, in their order. */
void power_sum(const assembly *a, assembly_power *power);
/* What shown terms gave at the points of a batch; not 0: NaN, see w->report.  Room beforehand (show.c). */
int show_batch(const assembly *a, const assembly_class *c, const assembly_state *s, int64_t batch, workspace *w);
int show_begin(const assembly *a, assembly_shown *to, error *err);
/* kept.c: prepares a class that has memory; values along moving paths, once per placement; of an input of a batch,
 * [n_comp][n_q]. */
int kept_place(assembly *a, assembly_class *c, error *err);
int kept_update(const assembly *a, assembly_class *c, const assembly_state *s, error *err);
void kept_values(const assembly *a, const assembly_class *c, const assembly_state *s, int64_t batch,
                 const plan_input *in, const workspace *w, v8 *out);
/* Along the paths, at the points of an item's cell that values are kept at; the polynomial nearest to values
 * v[n_comp][n_q] at the points of an item that is a part of a cell (counts, unless NULL: those that are of it),
 * `at` before being what it is where these leave it open. */
void kept_along_cell(const assembly *a, const assembly_class *c, const assembly_state *s, int f, int64_t item,
                     double *at);
void kept_nearest(const assembly *a, const assembly_class *c, int64_t item, const uint8_t *counts, int n_comp,
                  const double *v, double *at);
/* mask.c.  Finds the points of the batch on which a term acts; 0: on none.  Then, of n rows [ld] and of the
 * residual, what is left elsewhere: zero. */
int mask_take(const assembly *a, const assembly_class *c, const plan_use *p, workspace *w);
void mask_rows(const workspace *w, double *rows, size_t n, size_t ld);
int mask_residual(const pf_term *t, const pf_batch *b, const double *const *in, double *const *out,
                  const workspace *w);
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

/* First row of a kind in workspace.basis; what a term calls it. */
static inline int assemble_row(enum basis_kind kind)
{
    static const int row[BASIS_KINDS] = {0, 1, LAPLACE_ROW, FIRST_ROW, OTHER_ROW, OWN_ROW};

    return row[kind];
}

static inline uint32_t assemble_eval(const assembly_class *c, enum basis_kind kind)
{
    static const uint32_t eval[BASIS_KINDS] = {PF_VALUE, PF_GRAD, PF_LAPLACE, PF_VALUE, PF_OTHER};

    return kind == BASIS_VALUE && (c->where == PF_PAIR || c->where == PF_CUT) ? PF_DEFECT : eval[kind];
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
    if (space_of_cells(&s->field[field]))
        return type->n_node + s->any_problem;
    return type->n_node + (s->field[field].support == PF_ON_PARTICLE ? s->any_problem + s->any_cell : 0);
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
