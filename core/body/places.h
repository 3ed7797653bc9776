/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * places.h -- where bodies may start: between the files that check it. */
#ifndef BODY_PLACES_H
#define BODY_PLACES_H

#include "body/body.h"

enum { PLACES_MOST_TOLD = 8 }; /* messages of a kind; the rest is counted */

/* The point of a body's surface (part = 1), or of the surface drawn nearer to the centre (part < 1), where f is
 * least; returns f there, at[3] the point (surface_search.c). */
double surface_least(const solid *b, double (*f)(const void *ctx, const double *x), const void *ctx, double part,
                     double *at);
/* Level below which a point counts as inside. */
double surface_slack(const shape *s);

/* A boundary facet as an obstacle (outer_facet.c). */
typedef struct outer_facet {
    int32_t number; /* of the mesh */
    int name;       /* the first of its boundaries, -1: none */
    int periodic, symmetric;
    int n;                                    /* directions in it: 1 or 2 */
    double low[3], high[3];                   /* box that holds it        */
    double x0[3], t[2][3], xi0[3], txi[2][3]; /* first vertex, ways to its neighbours, in space and reference */
    double normal[3];                         /* of the flat facet through its vertices, out of the mesh      */
    double bulge;                             /* how far it may be off that                                   */
} outer_facet;

/* All boundary facets by low[0]; *widest: the largest extent of one in x. */
int outer_facets(const description *d, const mesh *m, arena *memory, outer_facet **list, double *widest,
                 error *err);
/* How far a body reaches through the facet, along its normal; at most 0: not at all. */
double outer_reach(const mesh *m, const outer_facet *f, const solid *b);

/* What is wrong, with the lines of the case; errors are of memory. */
int overlap_check(const description *d, const mesh *m, error *err);
int within_check(const description *d, const mesh *m, const cell_grid *grid, error *err);
int symmetry_check(const description *d, const mesh *m, error *err);

#endif
