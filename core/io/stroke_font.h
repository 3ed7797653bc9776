/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * stroke_font.h -- text drawn as lines, the same on every machine whichever fonts it has.
 * Strings are UTF-8: ASCII, the letters of Latin-1 and a few signs; others become a box. */
#ifndef IO_STROKE_FONT_H
#define IO_STROKE_FONT_H

#include <cairo.h>

/* Within a string: what follows is an index, an exponent, or on the line again. */
#define STROKE_SUB   "\001"
#define STROKE_SUPER "\002"
#define STROKE_LINE  "\003"

/* Height of capitals for text of the size 1 (the size is that of the em). */
#define STROKE_CAPITAL 0.7

/* Length of the text. */
double stroke_text_length(const char *s, double size);

/* Draws the text from its base line's start (x, y), in the source set in cr, turned by angle
 * (radians, clockwise as seen).  weight 1 is the usual thickness of the strokes. */
void stroke_text_draw(cairo_t *cr, const char *s, double x, double y, double size, double angle, double weight);

#endif
