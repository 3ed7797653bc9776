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
    double accuracy;     /* estimated error of volume (relative), centre and moments (of the body's size) */
    int64_t n_support;   /* SHAPE_DISTANCE: points of the surface */
    const double (*support)[3];
    error *fault; /* SHAPE_DISTANCE: the first error of `distance`; shared by all copies of the shape */
} shape;

/* Fills all from volume to fault, radius and thickness; memory must live as long as the shape and its copies.
 * By formula (superellipsoids by Gamma functions), so exact to round-off; of SHAPE_DISTANCE by the quadrature of
 * implicit.c on finer and finer meshes over the box, until the change, `accuracy`, is below 1e-8 or the mesh as
 * fine as is reasonable.  ERR_CASE: no inside, body larger than its box, exponent below 1, or `distance` failed. */
int shape_measure(shape *s, arena *memory, error *err);
/* Negative inside; not a distance in general.  If `distance` fails: 1, and from then on shape_check says so. */
double shape_level(const shape *s, const double *body_x);
/* Its gradient: by formula, or by central differences. */
void shape_slope(const shape *s, const double *body_x, double *g);
/* Sum of the principal curvatures of the surface at a point of it, 1/m: of a ball 2/R, of a disk 1/R; 0 where it is
 * flat.  From derivatives of the level, of superellipsoids and `distance` by differences (curvature.c). */
double shape_curvature(const shape *s, const double *body_x);
/* Whether turning leaves it where it is: a disk, a sphere. */
int shape_is_round(const shape *s);
/* The error that `distance` raised since the shape was measured, or 0: for all who used the level. */
int shape_check(const shape *s, error *err);
/* Largest extent from the centre in direction n (unit vector of the body's frame).  Of SHAPE_DISTANCE from points
 * of the surface: too small by at most 1e-4 of the radius in 2D, 1e-3 in 3D, where the surface is smooth or has
 * edges that are resolved (test_shape.c). */
double shape_support(const shape *s, const double *n);
/* Whether the surface has no edges and the level no kinks near it. */
int shape_is_smooth(const shape *s);

/* Where a body is and how it is turned. */
typedef struct pose {
    double x[3];   /* centroid, m                                  */
    double angle;  /* 2D: of its x axis, rad                       */
    double q[4];   /* 3D: unit quaternion, scalar part first       */
    double way[3]; /* of the centroid since the start, m; periodic boundaries do not show in it */
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
double solid_curvature(const solid *b, const double *x);
/* Largest extent from the centre in direction n (unit vector of space). */
double solid_support(const solid *b, const double *n);

/* --- points of a cell inside a body and on its surface (implicit.c) --- */

enum { IMPLICIT_ALONG = 5, IMPLICIT_ACROSS = 6 };

/* Gauss points on [-1, 1] for lines through a body, and for where the lines stand. */
typedef struct implicit_rule {
    int n_across;
    double along_x[IMPLICIT_ALONG], along_w[IMPLICIT_ALONG];
    double across_x[IMPLICIT_ACROSS], across_w[IMPLICIT_ACROSS];
} implicit_rule;

int implicit_rule_create(implicit_rule *r, int dim, error *err);

/* Receives points of the part of a cell inside a body (weights of the reference cell) and, unless NULL, of
 * its surface (n ds, n out of the body). */
typedef struct implicit_sink {
    void *ctx;
    void (*inside)(void *ctx, const double *xi, double weight);
    void (*surface)(void *ctx, const double *xi, const double *x, const double *nds);
} implicit_sink;

/* Feeds the sink; *whole: whether all of the cell is inside.  Fails if the level does (shape_check). */
int implicit_cell(const implicit_rule *r, const mesh *m, int32_t cell, const solid *b, const implicit_sink *sink,
                  int *whole, error *err);

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
    double gauss[5];              /* quads, hexes: the points in each direction    */
    double *inverse;              /* simplices: inverse Vandermonde matrix, [n][n] */
    implicit_rule lines;
    arena memory;
} cut_rule;

int cut_rule_create(cut_rule *r, const fe_cell *type, error *err);
void cut_rule_destroy(cut_rule *r);

/* How much of a cell a body covers. */
enum cut_cover { CUT_NONE, CUT_PART, CUT_WHOLE };

/* Weights w[rule.n] (reference measure) of the part of the cell inside the particle.  surface: see implicit_sink;
 * NULL: not needed.  Fails if the level does (shape_check). */
int cut_cell(const cut_rule *r, const mesh *m, int32_t cell, const solid *b, double *w,
             void (*surface)(void *ctx, const double *xi, const double *x, const double *nds), void *ctx,
             enum cut_cover *cover, error *err);

/* Multiplies the weights of a body that lies inside the mesh by 1 + c0 + c.r + r.C.r so that volume,
 * centroid and second moments are exact.  n cells with weights, shift: of the body's image in each of them;
 * fraction: of the body inside the domain. */
int cut_correct(const cut_rule *r, const mesh *m, const solid *b, const int32_t *cell, const double (*shift)[3],
                double *w, int64_t n, double fraction, error *err);

#endif
