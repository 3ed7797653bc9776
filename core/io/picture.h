/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * picture.h -- draws a field of a finished run as a figure, PNG or SVG: colours over the
 * domain or over a plane through it, axes in metres, colour bar, title. */
#ifndef IO_PICTURE_H
#define IO_PICTURE_H

#include "base/error.h"

typedef struct picture_options {
    const char *field;     /* name of a field; NULL: the first vector, else the first           */
    const char *component; /* of a vector "x", "y", "z", of a tensor "xx", "xy", ...; or "magnitude", as NULL */
    int width;             /* pixels, 200..10000, 0: 1200; a tall domain's figure is narrower   */
    double low, high;      /* values at the ends of the colours; low >= high: from the data     */
    char slice_axis;       /* 3D: the plane's normal 'x', 'y' or 'z'; 0: 'z'                    */
    double slice_at;       /* 3D: m along that axis; NAN: middle of the domain                  */
    int lines;             /* 1: arrows of the field, or of the first vector if it is a scalar  */
} picture_options;

/* Draws vtu_path, a file that a run wrote, into out_path, which must end in .png or .svg.
 * title: UTF-8, or NULL; o: NULL for the defaults above.  out_path is complete or untouched.
 * ERR_USAGE: an option does not fit the file; ERR_IO: a file cannot be read or written;
 * ERR_MEMORY. */
int picture_draw(const char *vtu_path, const char *title, const picture_options *o, const char *out_path,
                 error *err);

#endif
