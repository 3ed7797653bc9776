/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Round numbers for axes and text. */
#include "io/picture_parts.h"
#include "io/stroke_font.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int count(double low, double high, double step, double *first)
{
    double slack = 1e-9 * (high - low) / step, i = ceil(low / step - slack);

    *first = i * step;
    return (int)(floor(high / step + slack) - i) + 1;
}

void axis_ticks(picture_axis *a, double low, double high, int target, int most)
{
    static const double multiple[4] = {1, 2, 2.5, 5};
    double base = pow(10, floor(log10(high - low))), best = INFINITY, size = fmax(fabs(low), fabs(high));

    *a = (picture_axis){.low = low, .high = high};
    for (int k = -1; k <= 0; k++)
        for (int m = 0; m < 4; m++) {
            double step = multiple[m] * base * (k ? 0.1 : 1), first;
            int n = count(low, high, step, &first);
            double score = abs(n - target) + (m == 2 ? 0.6 : 0); /* 2.5 needs a digit more */

            if (n >= 1 && n <= most && score < best) {
                best = score;
                a->first = first;
                a->step = step;
                a->n = n;
            }
        }
    if (!a->n)
        return;
    if ((size >= 1e5 || size < 1e-2) && (a->step > 1e-4 * size || size >= 1e7))
        a->power = (int)floor(log10(size) + 1e-9);
    while (a->decimals < 15) {
        double s = a->step * pow(10, a->decimals - a->power);

        if (fabs(s - round(s)) < 1e-6 * s && s > 0.5)
            break;
        a->decimals++;
    }
}

/* The sign of a number is as long as a plus; the hyphen is not. */
static void put_minus(char *s, size_t size)
{
    static const char minus[3] = {'\xe2', '\x88', '\x92'};
    size_t n = strlen(s);

    if (s[0] == '-' && n + 3 <= size) {
        memmove(s + 3, s + 1, n);
        memcpy(s, minus, 3);
    }
}

void axis_label(const picture_axis *a, int i, char *s, size_t size)
{
    double v = (a->first + i * a->step);

    if (fabs(v) < 1e-9 * a->step)
        v = 0;
    snprintf(s, size, "%.*f", a->decimals, v * pow(10, -a->power));
    put_minus(s, size);
}

void axis_factor(const picture_axis *a, char *s, size_t size)
{
    s[0] = 0;
    if (a->n && a->power)
        snprintf(s, size,
                 "\xc3\x97"
                 "10" STROKE_SUPER "%s%d" STROKE_LINE,
                 a->power < 0 ? "\xe2\x88\x92" : "", abs(a->power));
}

void axis_number(double v, char *s, size_t size)
{
    char digits[48], *e;
    int power;

    snprintf(digits, sizeof digits, "%.6g", v);
    e = strchr(digits, 'e');
    power = e ? atoi(e + 1) : 0;
    if (e)
        *e = 0;
    put_minus(digits, sizeof digits);
    if (!e)
        snprintf(s, size, "%s", digits);
    else
        snprintf(s, size,
                 "%s\xc3\x97"
                 "10" STROKE_SUPER "%s%d" STROKE_LINE,
                 digits, power < 0 ? "\xe2\x88\x92" : "", abs(power));
}
