/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * picture_parts.h -- what the files of the picture share: where the picture looks, its
 * boundary lines, its pixels, its figure. */
#ifndef IO_PICTURE_PARTS_H
#define IO_PICTURE_PARTS_H

#include "base/arena.h"
#include "base/error.h"
#include "io/colour_map.h"
#include "io/picture.h"
#include "io/vtp.h"
#include "io/vtu_read.h"

#include <cairo.h>

/* The plane of the picture: coordinates of space across[0] to the right and across[1] up. */
typedef struct picture_view {
    int dim;
    int across[2];
    int normal; /* 3D: the coordinate that is at on the plane */
    double at;
    double near;  /* points at most so far from it are on it  */
    double named; /* at as it was asked for, for the title    */
} picture_view;

/* A point of a subdivided cell with the values that are drawn there. */
typedef struct picture_point {
    double x[3];
    double value[3]; /* the coloured one; then the arrow's two components in the plane */
} picture_point;

/* picture_patch.c -- cells cut into small simplices. */

enum { PATCH_MAX_2D = 48, PATCH_MAX_3D = 12, PATCH_MAX_POINTS = 2401 };

enum { PICTURE_MAGNITUDE = 9 }; /* more than any component */

/* What is drawn: a component of the field, or the magnitude (of a scalar: itself). */
typedef struct picture_field {
    const vtu_array *colour, *arrow; /* arrow: NULL for none */
    int component;
} picture_field;

/* picture_choose.c -- fills f from the options; "x", "xy": what is drawn, of the magnitude "". */
int picture_choose(const vtu_file *v, const picture_options *o, picture_field *f, error *err);
const char *picture_component(const picture_field *f);

typedef struct picture_patch {
    int n;                                 /* pieces along an edge                                                */
    picture_point point[PATCH_MAX_POINTS]; /* (n+1)^dim, first coordinate fastest */
} picture_patch;

typedef void (*picture_triangle)(void *to, const picture_point *a, const picture_point *b, const picture_point *c);

/* Smallest and largest coordinates of the cell's nodes. */
void patch_box(const vtu_file *v, size_t c, double low[3], double high[3]);

/* The body that holds all nodes of the cell, or one of these. */
enum { PATCH_IN_FLUID = -1 /* a node is in no body */, PATCH_IN_SEVERAL = -2 };
int patch_body(const vtu_file *v, size_t c);

/* Cuts cell c into pieces, n along an edge, and hands out the triangles of the picture's plane:
 * the pieces in 2D, their sections in 3D. */
void patch_triangles(const vtu_file *v, const picture_view *view, const picture_field *f, size_t c, int n,
                     picture_patch *patch, picture_triangle take, void *to);

/* Section of the segments between the points (n = 3 or 4) with the plane: 0, 3 or 4 points. */
int patch_section(const picture_view *view, const picture_point *const *p, int n, picture_point section[4]);

/* picture_extend.c -- fields that have no values in bodies. */

/* *to: the field with values, instead of none, at covered nodes of cells that the surface of a body cuts, continued
 * from the nodes of the fluid; the field as it is if there are no bodies. */
int extend_into_bodies(const vtu_file *v, const vtu_array *field, vtu_array *to, arena *a, error *err);

/* picture_outline.c -- the lines where the domain ends, in the plane of the picture. */

typedef struct picture_outline {
    size_t n, room;
    double (*segment)[4]; /* from (0, 1) to (2, 3), m, size n        */
    double low[2], high[2];
} picture_outline;

int outline_make(const vtu_file *v, const picture_view *view, picture_outline *o, error *err);
void outline_free(picture_outline *o);

/* picture_raster.c -- the values at the pixels. */

typedef struct picture_raster {
    int w, h;
    double left, top; /* place of the corner, m                              */
    double scale[2];  /* pixels per metre, across and up                     */
    float *value[3];  /* as in picture_point, size w * h; NAN: outside */
    int n_value;      /* 1, or 3 with arrows                          */
    uint8_t *solid;   /* not 0: the pixel's centre lies in a body, size w * h; NULL: there are none   */
    double low, high; /* of the value coloured, in the fluid; low > high: there is none */
} picture_raster;

/* Fills r, of which w, h, left, top, scale, n_value and solid are given; the values come from a.  Cells that lie in
 * one body with all their nodes are left out. */
int raster_make(const vtu_file *v, const picture_view *view, const picture_field *f, picture_raster *r, arena *a,
                error *err);

/* picture_bodies.c -- rigid bodies of the run. */

/* A closed line round a body, or round its section. */
typedef struct picture_loop {
    size_t first, n; /* its points                              */
    int id;
    int spoke; /* 1: from the centre to the first point */
    double centre[2];
} picture_loop;

typedef struct picture_bodies {
    int n;
    picture_loop *loop;  /* [n]                                          */
    double (*point)[2];  /* m, in the plane of the picture               */
    long n_step, n_path; /* n_path: bodies a step                        */
    double (*step)[2];   /* [n_step] places of all bodies, step after step */
} picture_bodies;

/* From metres to the figure. */
typedef struct bodies_place {
    double (*x)(const void *ctx, double x), (*y)(const void *ctx, double y);
    const void *ctx;
} bodies_place;

/* The bodies beside the file of fields, and their paths up to the time; none is no error. */
int bodies_read(const char *vtu_path, const picture_view *view, double time, picture_bodies *b, arena *a,
                error *err);
void bodies_draw(cairo_t *cr, const picture_bodies *b, double em, const bodies_place *place);
/* Makes r->solid; w, h, left, top and scale are given. */
int bodies_cover(const picture_bodies *b, picture_raster *r, arena *a, error *err);

/* picture_section.c -- fills the loops of b with the sections of the surfaces of v. */
int section_make(const vtp_file *v, const picture_view *view, picture_bodies *b, arena *a, error *err);

/* picture_figure.c -- layout, axes and bar. */

typedef struct picture_text {
    char title[512], x[128], y[128], bar[192];
} picture_text;

typedef struct picture_axis {
    double low, high;
    double first, step; /* ticks first + i * step, i < n              */
    int n, decimals;
    int power; /* labels are multiples of ten to this power            */
} picture_axis;

typedef struct picture_figure {
    double em;            /* size of the text, pixels                     */
    double width, height; /* of the figure                                */
    double x, y, w, h;    /* the frame of the domain, whole pixels        */
    double bar_x, bar_y, bar_w, bar_h;
    double bar_text; /* size of the bar's name: long ones are small */
    picture_axis across, up, bar;
} picture_figure;

/* Places the domain's box low..high (m) and the colours' range into a figure of the width. */
void figure_place(picture_figure *g, const picture_text *text, const double low[2], const double high[2],
                  const double range[2], int width);

typedef struct picture_content {
    const picture_bodies *bodies;
    const picture_figure *figure;
    const picture_text *text;
    const picture_outline *outline;
    const picture_raster *raster;
    colour_map map;
    int arrows;
} picture_content;

/* Draws all of it; cr's status tells of errors. */
void figure_draw(cairo_t *cr, const picture_content *c);

/* picture_axis.c -- round numbers. */

/* Ticks at multiples of 1, 2, 2.5 or 5 times a power of ten, about target and not more than
 * most of them. */
void axis_ticks(picture_axis *a, double low, double high, int target, int most);
/* Label of tick i; what all labels are to be multiplied with, or an empty string. */
void axis_label(const picture_axis *a, int i, char *s, size_t size);
void axis_factor(const picture_axis *a, char *s, size_t size);
/* The number with at most six digits, as it is written in text. */
void axis_number(double v, char *s, size_t size);

#endif
