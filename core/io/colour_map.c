/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Two maps.  The sequential one is viridis, as ten of its colours with a cubic through them.
 * The diverging one is a pair of straight lines in the OKLab space: lightness falls and
 * chroma grows from white to either end at constant hue, the same on both sides. */
#include "io/colour_map.h"

#include <math.h>

colour_map colour_map_of(double low, double high)
{
    double below = -low, above = high;

    return (colour_map){low, high, fmin(below, above) > 0.25 * fmax(below, above)};
}

static double clamp(double v, double low, double high)
{
    return v < low ? low : v > high ? high : v;
}

/* s in 0..1; Catmull-Rom cubics, the outer ones with the outer colour repeated. */
static void viridis(double s, double rgb[3])
{
    static const double c[10][3] = {{68, 1, 84},    {72, 40, 120},  {62, 74, 137},  {49, 104, 142}, {38, 130, 142},
                                    {31, 158, 137}, {53, 183, 121}, {109, 205, 89}, {180, 222, 44}, {253, 231, 37}};
    int i = (int)clamp(floor(9 * s), 0, 8);
    const double *p = c[i > 0 ? i - 1 : 0], *q = c[i], *r = c[i + 1], *e = c[i < 8 ? i + 2 : 9];
    double t = 9 * s - i;

    for (int k = 0; k < 3; k++) {
        double a = 2 * q[k], b = r[k] - p[k], d = 2 * p[k] - 5 * q[k] + 4 * r[k] - e[k],
               f = e[k] - p[k] + 3 * (q[k] - r[k]);

        rgb[k] = clamp(0.5 * (a + t * (b + t * (d + t * f))) / 255, 0, 1);
    }
}

/* OKLab to sRGB. */
static void oklab(double lightness, double a, double b, double rgb[3])
{
    static const double to_lms[3][2] = {
        {0.3963377774, 0.2158037573}, {-0.1055613458, -0.0638541728}, {-0.0894841775, -1.2914855480}};
    static const double to_rgb[3][3] = {{4.0767416621, -3.3077115913, 0.2309699292},
                                        {-1.2684380046, 2.6097574011, -0.3413193965},
                                        {-0.0041960863, -0.7034186147, 1.7076147010}};
    double lms[3];

    for (int k = 0; k < 3; k++)
        lms[k] = pow(lightness + to_lms[k][0] * a + to_lms[k][1] * b, 3);
    for (int k = 0; k < 3; k++) {
        double v = clamp(to_rgb[k][0] * lms[0] + to_rgb[k][1] * lms[1] + to_rgb[k][2] * lms[2], 0, 1);

        rgb[k] = v <= 0.0031308 ? 12.92 * v : 1.055 * pow(v, 1 / 2.4) - 0.055;
    }
}

/* s in -1..1. */
static void diverging(double s, double rgb[3])
{
    static const double blue[2] = {-0.030, -0.135}, red[2] = {0.150, 0.065}; /* a, b at the ends */
    const double *end = s < 0 ? blue : red;
    double m = fabs(s);

    oklab(0.975 - 0.535 * m, end[0] * m, end[1] * m, rgb);
}

void colour_map_rgb(const colour_map *m, double value, double rgb[3])
{
    value = clamp(value, m->low, m->high);
    if (m->diverging)
        diverging(value / fmax(-m->low, m->high), rgb);
    else
        viridis(m->high > m->low ? (value - m->low) / (m->high - m->low) : 0, rgb);
}
