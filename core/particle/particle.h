/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * particle.h -- rigid bodies: shape, place, motion, and the part of each cell that they cover. */
#ifndef PARTICLE_PARTICLE_H
#define PARTICLE_PARTICLE_H

#include "base/arena.h"
#include "base/error.h"
#include "base/value.h"
#include "mesh/mesh.h"

enum shape_kind { SHAPE_ELLIPSOID, SHAPE_BOX, SHAPE_CYLINDER, SHAPE_SUPERELLIPSOID, SHAPE_DISTANCE };

/* A body in its own frame, centroid at the origin. */
typedef struct shape {
    int kind, dim;
    double half[3];      /* semi-axes, half edges, or {radius, radius, half length} (axis z) */
    double exponent[2];  /* superellipsoid: |x/a|^e0 + |y/b|^e0, then with z: e1              */
    value distance;      /* SHAPE_DISTANCE: signed distance, negative inside                  */
    double centre[3];    /* SHAPE_DISTANCE: centroid in the frame of `distance`               */
    double radius;       /* of a ball round the origin that holds it                          */
    double thickness;    /* smallest width, for the resolution                                */
    double volume;       /* area in 2D                                                        */
    double moment[3][3]; /* int x_i x_j over the body                                         */
} shape;

/* Fills volume, moments and radius; by formula, or by quadrature for general shapes. */
int shape_measure(shape *s, error *err);
/* Negative inside; not a distance in general. */
double shape_level(const shape *s, const double *body_x);
/* Its gradient: by formula, or by central differences. */
void shape_slope(const shape *s, const double *body_x, double *g);
/* Largest extent from the centre in direction n (unit vector of the body's frame); of general shapes the radius. */
double shape_support(const shape *s, const double *n);
/* Whether the surface has no edges and the level no kinks near it. */
int shape_is_smooth(const shape *s);

/* Where a body is and how it is turned. */
typedef struct pose {
    double x[3];  /* centroid, m                                  */
    double angle; /* 2D: of its x axis, rad                       */
    double q[4];  /* 3D: unit quaternion, scalar part first       */
} pose;

/* Turns by the rotation vector (rad); 2D: its last component. */
void pose_turn(pose *at, int dim, const double *rotation);

/* A shape at a pose. */
typedef struct solid {
    const shape *shape;
    pose at;
    double axes[3][3]; /* columns: the body's axes */
} solid;

solid solid_at(const shape *s, const pose *at);
/* Coordinates in the body's own frame of a point of space. */
void solid_own(const solid *b, const double *x, double *own);
/* Level at a point of space, and its gradient there. */
double solid_level(const solid *b, const double *x);
void solid_slope(const solid *b, const double *x, double *g);
/* Largest extent from the centre in direction n (unit vector of space). */
double solid_support(const solid *b, const double *n);

/* --- cells near a point: a grid of buckets, built once (search.c) --- */
typedef struct cell_grid {
    int dim, n[3];
    double low[3], width[3];
    int64_t *start; /* [n buckets + 1] */
    int32_t *cell;
    double *box;   /* [n_cell][2][3] bounds of cells */
    int32_t *seen; /* [n_cell] mark of the last query that listed the cell */
    int32_t query;
    arena memory;
} cell_grid;

int cell_grid_create(cell_grid *g, const mesh *m, error *err);
/* Cells whose box meets the ball, ascending; *list has room for m->n_cell. Returns their number. */
int64_t cell_grid_ball(cell_grid *g, const double *x, double radius, int32_t *list);
void cell_grid_destroy(cell_grid *g);

/* --- covered part of cells (cut.c) --- */

enum { CUT_MAX_POINTS = 125 };

/* Fixed points on the reference cell on which the covered part of any cell is integrated:
 * w_q = int_covered L_q, L_q the Lagrange polynomials (degree 4 a direction, or in all on simplices),
 * so that products of two basis functions are integrated as exactly as the covered part is known. */
typedef struct cut_rule {
    const fe_cell *type;
    int n;
    double x[CUT_MAX_POINTS][3];
    double whole[CUT_MAX_POINTS]; /* reference weights of the whole cell */
    double *inverse;              /* simplices: inverse Vandermonde matrix, [n][n] */
    arena memory;
} cut_rule;

int cut_rule_create(cut_rule *r, const fe_cell *type, error *err);
void cut_rule_destroy(cut_rule *r);

/* Receives points of the part of a cell inside a body (weights of the reference cell) and, unless NULL, of
 * its surface (n ds, n out of the body). */
typedef struct implicit_sink {
    void *ctx;
    void (*inside)(void *ctx, const double *xi, double weight);
    void (*surface)(void *ctx, const double *xi, const double *x, const double *nds);
} implicit_sink;

/* Feeds the sink (implicit.c); 1 if the whole cell is inside. */
int implicit_cell(const mesh *m, int32_t cell, const solid *b, const implicit_sink *sink);

/* Weights w[rule.n] (reference measure) of the part of the cell inside the particle; 0 if there is
 * none, 2 if the whole cell is inside, else 1.  surface: see implicit_sink; NULL: not needed. */
int cut_cell(const cut_rule *r, const mesh *m, int32_t cell, const solid *b, double *w,
             void (*surface)(void *ctx, const double *xi, const double *x, const double *nds), void *ctx);

/* Multiplies the weights of a body that lies inside the mesh by 1 + c0 + c.r + r.C.r so that volume,
 * centroid and second moments are exact.  n cells with weights, shift: of the body's image in each of them;
 * fraction: of the body inside the domain. */
int cut_correct(const cut_rule *r, const mesh *m, const solid *b, const int32_t *cell, const double (*shift)[3],
                double *w, int64_t n, double fraction, error *err);

#endif
