/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * colour_map.h -- values to colours, such that equal steps of the value look like equal steps. */
#ifndef IO_COLOUR_MAP_H
#define IO_COLOUR_MAP_H

typedef struct colour_map {
    double low, high; /* values of the first and the last colour                 */
    int diverging;    /* white at zero, blue below, red above                    */
} colour_map;

/* The map of the range: diverging if the range lies on both sides of zero, neither side being
 * shorter than a quarter of the other. */
colour_map colour_map_of(double low, double high);

/* Red, green and blue in 0..1; values out of range take the colour of the end. */
void colour_map_rgb(const colour_map *m, double value, double rgb[3]);

#endif
