/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/text.h"

#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void text_add(text *t, const char *fmt, ...)
{
    va_list ap;
    int n;

    va_start(ap, fmt);
    n = vsnprintf(NULL, 0, fmt, ap);
    va_end(ap);
    if (n < 0 || t->failed)
        return;
    if (t->n + (size_t)n + 1 > t->room) {
        size_t room = 2 * (t->n + (size_t)n + 64);
        char *s = realloc(t->s, room);

        if (!s) {
            t->failed = 1;
            return;
        }
        t->s = s;
        t->room = room;
    }
    va_start(ap, fmt);
    vsnprintf(t->s + t->n, (size_t)n + 1, fmt, ap);
    va_end(ap);
    t->n += (size_t)n;
}

void text_json(text *t, const char *s)
{
    text_add(t, "\"");
    for (; *s; s++) {
        if (*s == '"' || *s == '\\')
            text_add(t, "\\%c", *s);
        else if ((unsigned char)*s < 0x20)
            text_add(t, "\\u%04x", (unsigned)*s);
        else
            text_add(t, "%c", *s);
    }
    text_add(t, "\"");
}

void text_number(text *t, double v)
{
    char s[40];

    if (!isfinite(v)) {
        text_add(t, "null");
        return;
    }
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(s, sizeof s, "%.*g", digits, v);
        if (strtod(s, NULL) == v)
            break;
    }
    text_add(t, "%s", s);
}

void text_free(text *t)
{
    free(t->s);
    *t = (text){0};
}

int text_distance(const char *a, const char *b)
{
    enum { LONGEST = 64 };
    int d[LONGEST + 1][LONGEST + 1];
    int n = (int)strlen(a), m = (int)strlen(b);

    if (n > LONGEST || m > LONGEST)
        return LONGEST;
    for (int i = 0; i <= n; i++)
        d[i][0] = i;
    for (int j = 0; j <= m; j++)
        d[0][j] = j;
    for (int i = 1; i <= n; i++)
        for (int j = 1; j <= m; j++) {
            int x = tolower((unsigned char)a[i - 1]), y = tolower((unsigned char)b[j - 1]);
            int best = d[i - 1][j - 1] + (x != y);

            if (d[i - 1][j] + 1 < best)
                best = d[i - 1][j] + 1;
            if (d[i][j - 1] + 1 < best)
                best = d[i][j - 1] + 1;
            if (i > 1 && j > 1 && x == tolower((unsigned char)b[j - 2]) && y == tolower((unsigned char)a[i - 2]) &&
                d[i - 2][j - 2] + 1 < best)
                best = d[i - 2][j - 2] + 1;
            d[i][j] = best;
        }
    return d[n][m];
}

const char *text_nearest(const char *name, const char *const *candidate, size_t n)
{
    const char *nearest = NULL;
    int limit = (int)strlen(name) / 3, best;

    limit = limit < 1 ? 1 : limit;
    best = limit + 1;
    for (size_t i = 0; i < n; i++) {
        int d = text_distance(name, candidate[i]);

        if (d < best) {
            best = d;
            nearest = candidate[i];
        }
    }
    return nearest;
}

point_text text_point(const double *x, int dim)
{
    point_text p;

    if (dim == 3)
        snprintf(p.s, sizeof p.s, "(%.6g, %.6g, %.6g)", x[0], x[1], x[2]);
    else
        snprintf(p.s, sizeof p.s, "(%.6g, %.6g)", x[0], x[1]);
    return p;
}
