/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * text.h -- strings that grow, and the name nearest to a misspelt one. */
#ifndef BASE_TEXT_H
#define BASE_TEXT_H

#include <stddef.h>

/* A string that grows; all fields zero is the empty string. */
typedef struct text {
    char *s;
    size_t n, room;
    int failed; /* memory ran out; s holds what came before */
} text;

void text_add(text *t, const char *fmt, ...) __attribute__((format(printf, 2, 3)));
/* "s" as a string of JSON, whatever bytes s has: what is not UTF-8 becomes U+FFFD, one for each byte. */
void text_json(text *t, const char *s);
void text_json_bytes(text *t, const char *s, size_t n); /* zero bytes among the n become \u0000 */
void text_number(text *t, double v); /* shortest form that reads back the same; null if not finite */
void text_free(text *t);

/* "(1, 2)" or "(1, 2, 3)"; use as text_point(x, dim).s within one expression. */
typedef struct point_text {
    char s[64];
} point_text;
point_text text_point(const double *x, int dim);

/* Bytes of the UTF-8 character at s, which n bytes follow; 0 if they do not begin with one. */
size_t text_utf8(const char *s, size_t n);

/* Damerau-Levenshtein distance without case; beyond 64 characters only a bound that it does not exceed. */
int text_distance(const char *a, const char *b);
/* The candidate nearest to name if it is near enough to be a slip, else NULL; never name itself. */
const char *text_nearest(const char *name, const char *const *candidate, size_t n);
/* "; did you mean \"near\"?", or nothing if near is NULL; use as text_hint(near).s within one expression. */
typedef struct hint_text {
    char s[256];
} hint_text;
hint_text text_hint(const char *near);

#endif
