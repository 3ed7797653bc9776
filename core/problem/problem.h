/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * problem.h -- a case made concrete: mesh, fields, terms, conditions, and what to do with them. */
#ifndef PROBLEM_PROBLEM_H
#define PROBLEM_PROBLEM_H

#include "case/case.h"
#include "mesh/cell_grid.h"
#include "mesh/mesh.h"
#include "solve/solve.h"
#include "space/space.h"
#include "term/term.h"

enum { PROBLEM_MAX_LINES = 64, PROBLEM_MAX_PROBES = 64 };

/* One boundary line of the case. */
typedef struct boundary_line {
    const case_block *block;
    const char *name; /* "*": what no other line names */
    int symmetry, natural;
    const char *periodic[2];
    int has_value[SPACE_MAX_FIELDS];
    value value[SPACE_MAX_FIELDS]; /* Dirichlet                                          */
    int n_flux;                    /* PF_BY_BOUNDARY terms that this line switches on     */
    term_use *flux[ASSEMBLE_MAX_USES];
    value flux_value[ASSEMBLE_MAX_USES];
    uint8_t *facet; /* [n_facet] 1: belongs to this line                  */
} boundary_line;

/* A set of unknowns held at values of a case. */
typedef struct dirichlet_set {
    const value *value; /* NULL: zero */
    int comp;           /* -1: all components that are not free; else this one */
    int field;
    int64_t n;
    int32_t *node;
} dirichlet_set;

typedef struct probe {
    const char *name;
    double x[3];
} probe;

typedef struct line_probe {
    const char *name;
    double from[3], to[3];
    int n;
} line_probe;

typedef struct force_output {
    int boundary;
    double about[3];
} force_output;

typedef struct problem_time {
    int unsteady, order, geometry_iterations;
    double step, stop, start;
} problem_time;

typedef struct problem_output {
    double every;
    int n_field, field[SPACE_MAX_FIELDS];
    int n_probe, n_line, n_force;
    probe probe[PROBLEM_MAX_PROBES];
    line_probe line[PROBLEM_MAX_PROBES];
    force_output force[MESH_MAX_NAMES];
    const char *force_name[MESH_MAX_NAMES];
    const case_block *block;
} problem_output;

/* An image of a body, now and at the levels of history (moving_frame.c). */
typedef struct moving_body {
    solid here;
    int moves;
    double way[2][3];     /* of its centre since then */
    double then[2][3][3]; /* its axes then */
} moving_body;

typedef struct body_paths {
    moving_frame frame;
    int levels;
    double c[2];        /* coefficients of the time scheme            */
    const double *u[2]; /* unknowns of the levels                       */
    int n;
    moving_body *body; /* [n_particle * n_image] */
    uint8_t *cell;     /* [n_cell] near one that moves             */
} body_paths;

/* Pieces of surface in cells, SURFACE_POINTS points each (see body_points). */
typedef struct surface_list {
    int64_t n, room;
    int n_last, failed; /* points of the last, unfinished piece */
    int32_t now;        /* attached pair that is being cut      */
    int32_t *attached;
    double (*ref)[3], (*normal)[3], *weight;
} surface_list;

/* Bad cells tied to roots now, and all ties that the pattern of the matrix has met. */
typedef struct tie_list {
    int64_t n, room, n_rootless;
    int32_t *cell;
    int64_t *group;
    double *weight, (*ref)[3];
    int64_t n_known, known_room;
    int32_t *first, *root; /* [n_cell] first tie of a bad cell or -1; root of each tie */
    int32_t *next;         /* next tie of the same bad cell                            */
} tie_list;

typedef struct problem {
    case_file *c;
    registry *r;
    int dim, n_thread;
    mesh_box box;          /* if the mesh is a box */
    const char *mesh_path; /* if it comes from a file */
    value mesh_map;        /* moves its nodes, if the case says so */
    int has_map;
    mesh mesh;
    space space;
    newton_system system;
    int n_use;
    term_use use[ASSEMBLE_MAX_USES];
    int n_line;
    boundary_line *line; /* [PROBLEM_MAX_LINES] */
    int n_particle;
    particle *particle;
    particle *remembered[3]; /* [n_particle] places to come back to                    */
    cell_grid grid;
    cut_rule cut;
    int n_image;           /* images of a body by the periods of the mesh: 1, 3, 9, 27   */
    double image[27][3];   /* their shifts; the first is zero                            */
    double (*shift)[3];    /* of attached pairs: of the image that is there              */
    double *envelope;      /* [n_particle][3] centre when cells were attached        */
    double *whole;         /* [n_dof] int phi_i^2 over the domain, restricted fields */
    double *inside;        /* [n_dof] the same over the bodies                       */
    double *weight;        /* of the covered cells                                   */
    int32_t *covered;      /* attached pairs that a body covers                      */
    uint8_t *whole_inside; /* of each of them: the body covers all of the cell             */
    int64_t n_covered;
    uint8_t *fluid_off; /* [n_cell] 1: a body is near and may cover a part of the cell; 2: all of it; 4: all of it,
                         * but a piece of its surface lies there and the cell takes part    */
    int64_t n_cut;
    int32_t *cut_cell, *cut_of; /* cells near bodies that leave some of them; [n_cell] their numbers */
    double *cut_weight;         /* of their part outside of all bodies                         */
    int32_t *covered_by;        /* [n_cell] attached pair of one of the bodies in such a cell  */
    int64_t n_off, off_room;
    int32_t *off_cell; /* cells with fluid_off                                        */
    int has_surface, has_ties, any_fluid_only;
    int fluid_only[SPACE_MAX_FIELDS]; /* fields with equations in the fluid only              */
    surface_list surface;
    body_paths paths;
    tie_list tie;
    int32_t *filled, n_fill; /* [n_carrier] the last round that filled the node         */
    int32_t *near_cell;      /* room for a search                                       */
    int64_t extra_room[2];   /* of the lists of extra groups in the space               */
    near_pair *pair;         /* bodies near something                                  */
    int64_t n_pair, n_link;
    unsigned walls;          /* bit k: side k of the box is a wall */
    double pair_range;       /* gap up to which pairs are looked for                   */
    double active_threshold; /* tau of the active set                                  */
    double geometry_seconds;
    float *node_share; /* [n_node] */
    double *cut_basis; /* second-order basis at the points of the cut rule       */
    double h_mean, h_max;
    int coarse_warned;
    long rootless;                      /* how often some bad cell had no root */
    long n_attach;                      /* how often cells were attached anew                     */
    arena envelope_memory, step_memory; /* until cells are attached anew; until the next cut */
    int n_dirichlet;
    dirichlet_set *dirichlet;
    value initial[SPACE_MAX_FIELDS], exact[SPACE_MAX_FIELDS];
    value offset[SPACE_MAX_FIELDS]; /* added to what is written, not to what is solved */
    int has_offset[SPACE_MAX_FIELDS];
    int has_initial[SPACE_MAX_FIELDS], has_exact[SPACE_MAX_FIELDS];
    problem_time time;
    problem_output output;
    newton_options newton;
    continuation continuation;
    const pf_solver *solver;
    double *x; /* [n_dof] the solution */
    double setup_seconds, mesh_seconds;
    arena memory;
} problem;

/* Reads everything, reports all mistakes of the case at once, then makes the mesh, numbers the
 * unknowns and plans the assembly. */
int problem_create(problem *p, case_file *c, registry *r, int n_thread, error *err);
void problem_destroy(problem *p);

/* Prescribed values at time t into x. */
int problem_dirichlet(void *problem, double t, double *x, error *err);
/* Initial values (zero where the case gives none), then the prescribed ones. */
int problem_initial(problem *p, error *err);

/* Attaches cells, cuts them, finds the active set for the places that the bodies have now; zeroes in x
 * what is off. */
int problem_cut(problem *p, double *x, error *err);
/* The body of an attached pair, at the place of its image there. */
particle problem_image(const problem *p, int64_t attached);
/* Velocity of body k at a place, with unknowns x. */
void problem_motion(const problem *p, const double *x, int k, const double *at, double *v);
/* Gives velocity unknowns without fluid the motion of the body that they lie in (fluid_part.c). */
void problem_fill(problem *p, double *x);
/* Points of the part of a cell where a field has a meaning: the whole cell, or what is outside of the bodies for a
 * field of the fluid only; returns `whole`, or `own` filled. */
const fe_rule *problem_points(const problem *p, int field, int64_t cell, const fe_rule *whole, fe_rule *own);
/* The stepper's hooks (solve.h). */
const moving_frame *problem_frame(void *problem, int levels, const double *c, const double *const *u,
                                  const double *history);
int problem_move(void *problem, enum move what, int slot, double dt, const double *u0, double *u1, error *err);
/* Unknowns of a particle: first dof of the field of this shape (PF_VECTOR, PF_SPIN), or -1. */
int64_t problem_particle_dof(const problem *p, int k, int shape);

/* --- between the files of this folder --- */

/* The part left to the fluid (fluid_part.c): room for it; weights of cut cells; surface points as cells are cut;
 * ties of bad cells (*fresh: the pattern must grow); idle unknowns; the motion of the bodies in them. */
int fluid_create(problem *p, error *err);
int fluid_weights(problem *p, error *err);
void fluid_add_surface(void *problem, const double *xi, const double *x, const double *nds);
void fluid_end_surface(problem *p);
int fluid_ties(problem *p, int *fresh, error *err);
void fluid_activate(problem *p, double *x);
double fluid_fraction(const problem *p, int32_t cell);
/* Appends an extra group of n carriers to the space. */
int fluid_add_group(problem *p, const int32_t *carrier, int n, error *err);
void fluid_forget(problem *p); /* before cells are attached anew */
void fluid_destroy(problem *p);

int problem_read_mesh(problem *p, error *err); /* reads mesh{} and finds the dimension; no mesh yet */
int problem_make_mesh(problem *p, error *err);
int problem_read_terms(problem *p, error *err);
int problem_read_boundaries(problem *p, error *err);
int problem_make_boundaries(problem *p, error *err);
/* Contacts (contacts.c): links each body to the walls, and bodies that may come near each other while none moves
 * further than drift / 2; then, of these, the pairs within pair_range. */
int problem_link(problem *p, double drift, error *err);
void problem_find_pairs(problem *p);
int problem_read_particles(problem *p, error *err);
int problem_make_particles(problem *p, error *err);
void problem_hold_particles(problem *p); /* marks the unknowns that do not move by themselves */
int problem_read_settings(problem *p, error *err);
int problem_make_outputs(problem *p, error *err);

#endif
