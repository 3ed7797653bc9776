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

size_t text_utf8(const char *s, size_t n)
{
    static const struct {
        unsigned char mask, lead; /* first byte & mask == lead */
        unsigned long lowest;     /* shorter forms exist below */
    } form[] = {{0x80, 0x00, 0}, {0xe0, 0xc0, 0x80}, {0xf0, 0xe0, 0x800}, {0xf8, 0xf0, 0x10000}};
    const unsigned char *u = (const unsigned char *)s;

    for (size_t k = 0; k < sizeof form / sizeof *form && k < n; k++) {
        unsigned long code = u[0] & (unsigned char)~form[k].mask;

        if ((u[0] & form[k].mask) != form[k].lead)
            continue;
        for (size_t i = 1; i <= k; i++) {
            if ((u[i] & 0xc0) != 0x80)
                return 0;
            code = code << 6 | (u[i] & 0x3f);
        }
        return code < form[k].lowest || code > 0x10ffff || (code >= 0xd800 && code <= 0xdfff) ? 0 : k + 1;
    }
    return 0;
}

void text_json_bytes(text *t, const char *s, size_t n)
{
    size_t plain = 0; /* bytes before s that go as they are */

    text_add(t, "\"");
    while (n > 0) {
        size_t size = text_utf8(s, n);
        int special = size == 0 || (unsigned char)*s < 0x20 || *s == '"' || *s == '\\';

        if (special) {
            text_add(t, "%.*s", (int)plain, s - plain);
            plain = 0;
        }
        if (size == 0)
            text_add(t, "\xef\xbf\xbd");
        else if ((unsigned char)*s < 0x20)
            text_add(t, "\\u%04x", (unsigned)*s);
        else if (special)
            text_add(t, "\\%c", *s);
        else
            plain += size;
        s += size ? size : 1;
        n -= size ? size : 1;
    }
    text_add(t, "%.*s\"", (int)plain, s - plain);
}

void text_json(text *t, const char *s)
{
    text_json_bytes(t, s, strlen(s));
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
        return n > m ? n : m;
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
    int length = (int)strlen(name), best = length < 3 ? length : length / 3 + 1; /* less than this is a slip */

    for (size_t i = 0; i < n; i++) {
        int d = text_distance(name, candidate[i]);

        if (d < best && strcmp(name, candidate[i]) != 0) {
            best = d;
            nearest = candidate[i];
        }
    }
    return nearest;
}

hint_text text_hint(const char *near)
{
    hint_text h = {""};

    if (near)
        snprintf(h.s, sizeof h.s, "; did you mean \"%.200s\"?", near);
    return h;
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
