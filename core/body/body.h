/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * body.h -- where the bodies are, and what follows from it.
 *
 * `bodies` is what stays while they move: their description, the search grid, the quadrature of cut cells, and the
 * envelope, that is the cells attached to each body.  A `placement` is the bodies at one instant: their poses, the
 * cells they cover and cut, their surfaces, ties, near pairs and idle unknowns.  It is immutable once made, and
 * whoever assembles says with which placement, so that a residual is never formed with new centres and old weights.
 *
 * What an evaluation costs elsewhere is not known here: bodies_place() says what changed, and the caller decides
 * what becomes of matrix and factors. */
#ifndef BODY_BODY_H
#define BODY_BODY_H

#include "assemble/assemble.h"
#include "base/warning.h"
#include "describe/describe.h"
#include "mesh/box_grid.h"
#include "mesh/cell_grid.h"
#include "mesh/wall.h"
#include "space/conditions.h"
#include "space/locate.h"
#include "space/space.h"

/* What bodies do to a cell. */
enum cover {
    COVER_NONE = 0,  /* no body is near                                                  */
    COVER_PART = 1,  /* a body is near and may cover a part of the cell                   */
    COVER_WHOLE = 2, /* a body covers all of it                                          */
    COVER_TIED = 3   /* the same, but a piece of its surface lies there: the cell takes part, tied to a root */
};

/* Pieces of surface in cells, SURFACE_POINTS points each (see body_points). */
typedef struct surface_list {
    int64_t n, room;
    int n_last;          /* points of the last, unfinished piece */
    int32_t now;         /* attached pair that is being cut      */
    const solid *curved; /* its body, where some term may read the curvature of the surface; NULL: none does */
    int failed;          /* memory ran out                       */
    int32_t *attached;
    double (*ref)[SURFACE_POINTS][3], (*normal)[SURFACE_POINTS][3], (*weight)[SURFACE_POINTS],
        (*curvature)[SURFACE_POINTS];
} surface_list;

/* Bad cells (too little fluid) and the roots that they are tied to. */
typedef struct tie_list {
    int64_t n, room, ref_room;
    int64_t n_rootless; /* bad cells without a root */
    int n_point;        /* of a cell                */
    int32_t *cell;      /* [n] the bad one          */
    int64_t *group;     /* [n] see space.h          */
    double *weight;     /* [n] shares of one cell add up to 1 */
    double (*ref)[3];   /* [n][n_point] points of the bad cell in reference coordinates of the root */
} tie_list;

typedef struct placement {
    int stamp;   /* another one for every placement, never 0   */
    solid *body; /* [n_body] */
    int64_t n_covered;
    int32_t *covered;       /* attached pairs whose body covers the cell or a part of it    */
    uint8_t *covers_all;    /* of each of them: all of the cell                            */
    double *covered_weight; /* [n_covered][points of the cut rule] of the part inside      */
    uint8_t *cover;         /* [n_cell] enum cover                                         */
    int64_t n_near;
    int32_t *near_cell; /* cells with cover                                            */
    int64_t n_cut;
    int32_t *cut_cell;   /* of them: those with COVER_PART                              */
    int32_t *cut_of;     /* [n_cell] their numbers                                      */
    double *cut_weight;  /* [n_cut][points of the cut rule] of the part outside of all bodies  */
    int32_t *covered_by; /* [n_cell] an attached pair of one of the bodies near such a cell    */
    surface_list surface;
    tie_list tie;
    int64_t n_pair;
    near_pair *pair;                    /* bodies near each other or a wall */
    double *integral[SPACE_MAX_FIELDS]; /* [n_dof] of each basis function over the fluid, of scalars of the mesh */
    uint8_t *idle;                      /* [n_dof] 1: off, see body_points */
    body_points points;                 /* all of it as the assembly reads it */
    arena memory;
} placement;

/* Cells attached to bodies while each stays within a margin of where it was. */
typedef struct envelope {
    int stamp;           /* another one for each                                     */
    double (*centre)[3]; /* [n_body] when the cells were attached                     */
    double ring;         /* in sizes of a cell: near enough to a body for the points of cut cells */
    double (*shift)[3];  /* [space.n_attached] from the body to its image there       */
    int32_t *first_tie;  /* [n_cell] first tie of a bad cell in space.tie, or -1      */
    int32_t *next_tie;   /* [space.n_tie] next tie of the same cell                   */
    int64_t next_tie_room;
    double margin;           /* of the attached cells, in sizes of a cell */
    int restricted;          /* some field has its unknowns at them only  */
    int32_t (*neighbour)[6]; /* [n_cell] cells that share a facet, -1: no more; NULL: there are no ties */
    long made;               /* how often cells were attached */
    arena memory;
} envelope;

enum { PATHS_MAX_LEVELS = 3, PATHS_REACH = 8 /* cells */ };

/* A body's image now and at the levels of history (paths.c). */
typedef struct moving_body {
    solid here;
    int moves, round;
    double way[PATHS_MAX_LEVELS][3];     /* of its centre since then */
    double then[PATHS_MAX_LEVELS][3][3]; /* its axes then; those of now if it is round: paths do not turn with it */
    double turned[3][3];                 /* its axes at the latest level */
} moving_body;

typedef struct body_paths {
    moving_frame frame;
    int levels;
    double c[PATHS_MAX_LEVELS];        /* coefficients of the time scheme            */
    const double *u[PATHS_MAX_LEVELS]; /* unknowns of the levels                     */
    int n;
    moving_body *body; /* [n_body * n_image] */
    box_grid near;     /* of them: which may matter at a point; no boxes: unknown */
    int32_t *all;      /* their numbers */
    uint8_t *cell;     /* [n_cell] near one that moves */
    uint8_t *seen;     /* [n_carrier] room             */
} body_paths;

typedef struct bodies {
    int n; /* bodies */
    const body_spec *spec;
    double *density; /* [n] */
    const description *description;
    const conditions *conditions;
    space *space;
    warning_list *warnings;
    int field_velocity, field_spin; /* of the bodies, or -1 */
    int shows_surface;              /* some term whose results are shown acts on surfaces */
    int has_surface, has_ties, has_pairs, any_fluid_only;
    int fluid_only[SPACE_MAX_FIELDS]; /* fields with equations in the fluid only */
    const cell_grid *grid;
    cut_rule cut;
    double *integral[SPACE_MAX_FIELDS]; /* [n_dof] of each basis function over all cells, of scalars of the mesh */
    double *cut_basis;                  /* second-order basis at the points of the cut rule */
    double *whole, *inside; /* [n_node] int phi_i^2 over the domain and over bodies; NULL: no field is restricted */
    int n_image;            /* images of a body by the periods of the mesh: 1, 3, 9, 27 */
    double image[27][3];    /* their shifts; the first is zero */
    double h_mean;          /* of the cells */
    double pair_range;      /* gap up to which some term acts on pairs */
    double pair_size, h_most; /* largest size of a body and of a cell, m */
    int is_curved;            /* some term may read the curvature of surfaces */
    int has_walls;
    wall walls;  /* boundaries where a vector field of the mesh is prescribed */
    int n_plane; /* symmetry planes */
    symmetry_plane plane[DESCRIBE_MAX_PLANES];
    envelope envelope;
    body_paths paths;
    placement *now;     /* the last one made */
    int stamp;          /* of the last one made */
    int32_t *near_cell; /* [n_cell] room for a search */
    long patterns;      /* placements that took another pattern of the matrix */
    long rootless;      /* placements in which some bad cell had no root */
    double seconds;     /* spent here */
    arena memory;
} bodies;

/* What a new placement changed for the matrix. */
enum placement_change {
    PLACEMENT_SAME,   /* nothing: all bodies stand           */
    PLACEMENT_MOVED,  /* values                              */
    PLACEMENT_PATTERN /* the groups of the space, so its pattern, too */
};

/* Refuses placements at the start that cannot be (places.c): what is wrong is collected in the case, doubtful ones
 * are warnings.  The mesh has its periodic boundaries; of a box without a map one cell is enough.  ERR_MEMORY. */
int bodies_check_places(const description *d, const mesh *m, const cell_grid *grid, error *err);
/* Finds what stays, and places the bodies where they start. */
int bodies_create(bodies *b, const description *d, space *s, const cell_grid *grid, const conditions *c,
                  warning_list *w, error *err);
void bodies_destroy(bodies *b);
/* b->now = the bodies at these poses [n].  ERR_CONVERGE if one has left the domain. */
int bodies_place(bodies *b, const pose *at, enum placement_change *change, error *err);
/* The error that a function `distance` of a body raised where its level was asked for since it was placed, or 0. */
int bodies_check(const bodies *b, error *err);
/* Zeroes unknowns that a placement leaves no equation: scalars of the fluid, and fields inside of bodies. */
void bodies_clear(const bodies *b, const placement *p, double *x);

/* --- motion (motion.c) --- */

/* Marks the unknowns of bodies that do not move by themselves. */
void bodies_hold(const bodies *b);
/* Prescribed and held velocities and spins at time t into x. */
int bodies_prescribe(const bodies *b, double t, double *x, error *err);
/* Velocities and spins at the start into x. */
int bodies_start(const bodies *b, double t, double *x, error *err);
/* to = from, moved for dt by the mean of the velocities in u0 and u1 [n_dof]; both [n]. */
void bodies_move(const bodies *b, const pose *from, double dt, const double *u0, const double *u1, pose *to);
/* Velocity of body k at a place, for its pose and the unknowns x. */
void bodies_velocity(const bodies *b, const pose *at, const double *x, int k, const double *place, double *v);
/* Unknowns of a body: first of its velocity (spin = 0) or angular velocity (1), or -1. */
int64_t bodies_dof(const bodies *b, int k, int spin);

/* --- fluid inside and outside of bodies --- */

/* Field of the mesh that is the bodies' motion inside of them, or -1; and the same if its equations hold in the
 * fluid only, so that it has to be given that value. */
int bodies_rigid_field(const bodies *b);
int bodies_moved_field(const bodies *b);
/* Idle unknowns of that field become the motion of the body that covers them (fill.c). */
int bodies_fill(const bodies *b, const placement *p, double *x, error *err);
/* Points of the part of a cell where a field has a meaning: the whole cell, or what is outside of the bodies for a
 * field of the fluid only; returns `whole`, or `own` filled. */
const fe_rule *bodies_points(const bodies *b, const placement *p, int field, int64_t cell, const fe_rule *whole,
                             fe_rule *own);
/* Body (with its image's shift, unless NULL) that holds the point x of a cell, or -1. */
int bodies_at(const bodies *b, const placement *p, int64_t cell, const double *x, double *shift);

/* --- how far a step may go (step_limit.c) --- */

enum { BODIES_MOST_CELLS = 3 }; /* that a step may carry a body: what the paths of history allow */
enum too_far { FAR_NOT, FAR_CELLS, FAR_WALL, FAR_BODY };

/* Whether a step from one set of poses to another carries a body by more than BODIES_MOST_CELLS cells, or by more
 * than the gap to the wall or body that it moves towards; then why says which and by how much. */
enum too_far bodies_too_far(const bodies *b, const pose *from, const pose *to, char *why, size_t n);

/* --- paths (paths.c) --- */

/* Bit f: some term has du/dt of field f. */
uint32_t bodies_rated(const bodies *b);
/* Paths that history comes along near bodies, history = sum over levels of c[l] u[l]; level l when the bodies were
 * at then[l].  NULL: all history stays at its place.  Valid until the next call. */
const moving_frame *bodies_paths(bodies *b, const placement *now, int levels, const double *c,
                                 const double *const *u, const pose *const *then, const double *history);
/* The fields of the fluid that have history extrapolated to now, sum over levels of c[l] u[l], along the same
 * paths: into x [n_dof] at the nodes near bodies that move; elsewhere x stays. */
void bodies_extrapolate(bodies *b, const placement *now, int levels, const double *c, const double *const *u,
                        const pose *const *then, double *x);

/* --- between the files of this folder --- */

/* After the first placement: a warning if bodies separate the fluid, ERR_CASE if the flow does not feel one
 * (parts.c). */
int parts_check(const bodies *b, error *err);

/* Which of n symmetry planes go through the body's centre: how many (symmetry.c). */
int symmetry_planes_at(const symmetry_plane *plane, int n, const solid *b, int *which);
/* The body of an attached pair, at the place of its image there. */
solid body_image(const bodies *b, const placement *p, int64_t attached);
int envelope_create(bodies *b, error *err);
int envelope_holds(const bodies *b, const pose *at);
/* Whether the cell of an attached pair is within so many sizes of a cell of where the body is now. */
int envelope_near(const bodies *b, const placement *p, int64_t attached, double margin);
int envelope_attach(bodies *b, const pose *at, error *err);
/* Covered cells and pieces of surface. */
int covered_cut(const bodies *b, placement *p, error *err);
int share_weights(const bodies *b, placement *p, error *err);
/* The integrals of basis functions over all cells, and over the fluid. */
int share_integrals_create(bodies *b, error *err);
int share_integrals(const bodies *b, placement *p, error *err);
/* Part of a cell that is fluid. */
double share_fluid(const bodies *b, const placement *p, int32_t cell);
void surface_begin(surface_list *s, int32_t attached);
void surface_add(void *list, const double *xi, const double *x, const double *nds);
void surface_end(surface_list *s);
/* *fresh = 1: some tie is new to the space. */
int ties_make(bodies *b, placement *p, int *fresh, error *err);
int active_create(bodies *b, error *err);
void active_set(const bodies *b, placement *p);
enum { PAIRS_MOST_WALLS = 8 }; /* that a body can be near to at one place */

/* A wall near a body. */
typedef struct wall_gap {
    double gap, normal[3]; /* normal: into the domain */
    int64_t cell;          /* before the wall */
    int boundary;          /* its name in the mesh, or -1 */
} wall_gap;

int pairs_create(bodies *b, error *err);
/* b->walls, if there are any. */
int pairs_find_walls(bodies *b, error *err);
/* Walls with a gap to the body below range; list has room for PAIRS_MOST_WALLS. */
int pairs_walls(const bodies *b, const solid *q, double range, wall_gap *list, int *n, error *err);
/* Distance from y to the nearest image of x, and the unit vector n along it. */
double pairs_separation(const bodies *b, const double *x, const double *y, double *n);
int pairs_link(bodies *b, const pose *at, double drift, error *err);
int pairs_find(const bodies *b, placement *p, error *err);
int paths_create(bodies *b, error *err);
/* The bodies' images at these levels, and the cells near those that move; 0: there are none. */
int paths_take(bodies *b, const placement *now, int levels, const double *c, const double *const *u,
               const pose *const *then);
/* path_bodies.c.  Where the path through x was at each level: x - way; 0: it rests. */
int paths_find(const body_paths *t, const double *x, double reach, double way[PATHS_MAX_LEVELS][3]);
/* How far the point of a body that is at x now has come since level l. */
void paths_travelled(const moving_body *b, int l, const double *x, double *d);
/* The body that moves in which x is, or NULL. */
const moving_body *paths_below(const body_paths *t, const double *x);
/* Lists which bodies may matter where, for a reach of at most this. */
void paths_list(body_paths *t, int dim, double reach);
int paths_at(void *bodies_, int64_t cell, const double *x, double *w, double *history); /* see moving_frame */
int paths_before(void *bodies_, int64_t cell, const double *x, int body, located *then);
void placements_destroy(bodies *b);

#endif
