/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A font of strokes.  A glyph is a width and a path on a grid where capitals are 20 high,
 * small letters 14 and an em is 28 + 4/7:
 *
 *     M x y          start a stroke
 *     L x y          straight line
 *     Q a b x y      parabola with the control point a b
 *     H x y, V x y   quarter of an ellipse that leaves horizontally or vertically
 *
 * A stroke without length is a dot.  Accented letters are a letter and an accent. */
#include "io/stroke_font.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

typedef struct glyph {
    int width;
    const char *path;
} glyph;

enum { GAP = 5, UNKNOWN = '~' + 1, N_SIGN = 11 };

/* From ' ' to '~', then the box for what is unknown. */
static const glyph ascii[] = {
    {5, ""},
    {2, "M1 20L1 6M1 0L1 0"},
    {5, "M0 20L0 15M5 20L5 15"},
    {15, "M4 0L7 20M9 0L12 20M1 7L14 7M2 13L15 13"},
    {12, "M11 16Q10 20 6 20H1 15Q1 12 6 10Q12 8 12 5V6 0Q1 0 0 4M6 23L6 -3"},
    {18, "M16 20L2 0M8 16V4 20H0 16V4 12H8 16M18 4V14 8H10 4V14 0H18 4"},
    {14, "M14 0L3 13Q2 15 2 16V6 20H10 16Q10 13 5 11Q0 8 0 5V5 0Q11 0 13 8"},
    {2, "M1 20L1 15"},
    {5, "M5 23Q0 17 0 9Q0 1 5 -5"},
    {5, "M0 23Q5 17 5 9Q5 1 0 -5"},
    {10, "M5 20L5 10M1 18L9 12M9 18L1 12"},
    {12, "M6 3L6 15M0 9L12 9"},
    {2, "M2 1L2 0L0 -4"},
    {8, "M0 8L8 8"},
    {2, "M1 0L1 0"},
    {8, "M0 -3L8 22"},
    {12, "M12 10V6 20H0 10V6 0H12 10"},
    {12, "M2 16Q6 17 7 20L7 0"},
    {12, "M1 15V6 20H12 14Q12 11 9 8L0 0L12 0"},
    {12, "M1 16V6 20H11 15V6 11L4 11M6 11H12 6V6 0H0 4"},
    {12, "M9 0L9 20L0 6L12 6"},
    {12, "M11 20L2 20L1 11Q3 13 6 13H12 7V6 0H0 4"},
    {12, "M0 7V6 0H12 7V6 13H0 7L0 9V7 20Q10 20 11 17"},
    {12, "M0 20L12 20L4 0"},
    {12, "M11 15V6 20H1 15V6 11H11 15M12 6V6 11H0 6V6 0H12 6"},
    {12, "M12 13V6 20H0 13V6 7H12 13L12 11V5 0Q2 0 1 3"},
    {2, "M1 0L1 0M1 12L1 12"},
    {2, "M2 1L2 0L0 -4M2 12L2 12"},
    {12, "M12 16L0 9L12 2"},
    {12, "M0 12L12 12M0 6L12 6"},
    {12, "M0 16L12 9L0 2"},
    {10, "M0 16V5 20H10 15Q10 12 5 9L5 6M5 0L5 0"},
    {18, "M13 9V9 13H5 9V9 5H13 9M13 13L13 8V15 5H18 10V9 20H0 9V9 -2Q13 -2 15 0"},
    {14, "M0 0L7 20L14 0M2 7L12 7"},
    {12, "M0 0L0 20L7 20H11 15V7 11L0 11M7 11H12 6V7 0L0 0"},
    {13, "M13 15Q11 20 7 20H0 10V7 0Q11 0 13 5"},
    {13, "M0 0L0 20L5 20H13 10V5 0L0 0"},
    {11, "M11 20L0 20L0 0L11 0M0 11L9 11"},
    {11, "M11 20L0 20L0 0M0 11L9 11"},
    {14, "M13 15Q11 20 7 20H0 10V7 0Q11 0 14 3L14 9L8 9"},
    {13, "M0 0L0 20M13 0L13 20M0 11L13 11"},
    {2, "M1 0L1 20"},
    {8, "M8 20L8 6V4 0Q1 0 0 4"},
    {12, "M0 0L0 20M12 20L0 8M4 12L12 0"},
    {10, "M0 20L0 0L10 0"},
    {16, "M0 0L0 20L8 6L16 20L16 0"},
    {13, "M0 0L0 20L13 0L13 20"},
    {14, "M14 10V7 20H0 10V7 0H14 10"},
    {12, "M0 0L0 20L7 20H12 15V7 9L0 9"},
    {14, "M14 10V7 20H0 10V7 0H14 10M9 5L14 -1"},
    {12, "M0 0L0 20L7 20H12 15V7 9L0 9M6 9L12 0"},
    {12, "M11 16Q10 20 6 20H1 15Q1 12 6 10Q12 8 12 5V6 0Q1 0 0 4"},
    {12, "M6 0L6 20M0 20L12 20"},
    {12, "M0 20L0 7V6 0H12 7L12 20"},
    {14, "M0 20L7 0L14 20"},
    {20, "M0 20L5 0L10 20L15 0L20 20"},
    {13, "M0 0L13 20M0 20L13 0"},
    {14, "M0 20L7 10L14 20M7 10L7 0"},
    {12, "M0 20L12 20L0 0L12 0"},
    {5, "M5 23L0 23L0 -5L5 -5"},
    {8, "M0 22L8 -3"},
    {5, "M0 23L5 23L5 -5L0 -5"},
    {10, "M0 14L5 20L10 14"},
    {12, "M0 -3L12 -3"},
    {4, "M0 20L4 16"},
    {10, "M10 14L10 0M10 7V5 14H0 7V5 0H10 7"},
    {10, "M0 20L0 0M0 7V5 14H10 7V5 0H0 7"},
    {9, "M9 11Q8 14 5 14H0 7V5 0Q8 0 9 3"},
    {10, "M10 20L10 0M10 7V5 14H0 7V5 0H10 7"},
    {10, "M0 7L10 7V5 14H0 7V5 0Q8 0 10 3"},
    {7, "M7 20L6 20H2 16L2 0M-1 14L6 14"},
    {10, "M10 14L10 -1V5 -6Q2 -6 1 -4M10 7V5 14H0 7V5 0H10 7"},
    {10, "M0 20L0 0M0 9V5 14H10 9L10 0"},
    {2, "M1 14L1 0M1 20L1 20"},
    {3, "M3 14L3 -3V0 -6M3 20L3 20"},
    {9, "M0 20L0 0M9 14L0 5M4 9L9 0"},
    {2, "M1 20L1 0"},
    {16, "M0 14L0 0M0 10V4 14H8 10L8 0M8 10V12 14H16 10L16 0"},
    {10, "M0 14L0 0M0 9V5 14H10 9L10 0"},
    {10, "M10 7V5 14H0 7V5 0H10 7"},
    {10, "M0 14L0 -6M0 7V5 14H10 7V5 0H0 7"},
    {10, "M10 14L10 -6M10 7V5 14H0 7V5 0H10 7"},
    {6, "M0 14L0 0M0 8V6 14"},
    {9, "M8 11Q7 14 4 14H0 11Q0 8 4 7Q9 6 9 4V5 0Q1 0 0 3"},
    {6, "M2 19L2 4V6 0M-1 14L6 14"},
    {10, "M0 14L0 5V5 0H10 5M10 14L10 0"},
    {10, "M0 14L5 0L10 14"},
    {16, "M0 14L4 0L8 14L12 0L16 14"},
    {9, "M0 0L9 14M0 14L9 0"},
    {10, "M0 14L5 0M10 14L5 0L4 -3Q3 -6 0 -6"},
    {9, "M0 14L9 14L0 0L9 0"},
    {6, "M6 23Q3 23 3 19L3 13Q3 9 0 9Q3 9 3 5L3 -1Q3 -5 6 -5"},
    {2, "M1 23L1 -5"},
    {6, "M0 23Q3 23 3 19L3 13Q3 9 6 9Q3 9 3 5L3 -1Q3 -5 0 -5"},
    {12, "M0 8Q3 12 6 9Q9 6 12 10"},
    {12, "M0 0L0 20L12 20L12 0L0 0"},
};
_Static_assert(sizeof ascii / sizeof ascii[0] == UNKNOWN - ' ' + 1, "one glyph for every character");

static const struct {
    uint32_t code;
    glyph g;
} sign[N_SIGN] = {
    {0xb0, {8, "M8 16V4 20H0 16V4 12H8 16"}},                         /* degree                */
    {0xb1, {12, "M6 5L6 17M0 11L12 11M0 0L12 0"}},                    /* plus or minus         */
    {0xb2, {8, "M0 18V4 20H8 17Q8 15 6 13L0 9L8 9"}},                 /* squared               */
    {0xb3, {8, "M1 18V4 20H7 17V4 15H8 12V4 9H0 11"}},                /* cubed                 */
    {0xb5, {10, "M0 14L0 -6M0 5V5 0H10 5M10 14L10 0"}},               /* micro                 */
    {0xb7, {4, "M2 9L2 9"}},                                          /* dot                   */
    {0xd7, {12, "M1 4L11 14M1 14L11 4"}},                             /* times                 */
    {0xdf, {10, "M0 0L0 15V5 20H9 16Q9 13 5 11Q10 10 10 5V5 0L3 0"}}, /* sharp s     */
    {0x3bc, {10, "M0 14L0 -6M0 5V5 0H10 5M10 14L10 0"}},              /* mu                    */
    {0x2212, {12, "M0 9L12 9"}},                                      /* minus                 */
    {0x2013, {12, "M0 8L12 8"}},                                      /* dash                  */
};

/* Letters U+C0 to U+FF without their accents, and the accents: grave, acute, circumflex,
 * tilde, diaeresis, ring, cedilla. */
static const char latin_base[] = "AAAAAA CEEEEIIII NOOOOO  UUUUY  aaaaaa ceeeeiiii nooooo  uuuuy y";
static const char latin_accent[] = "`'^~:o ,`'^:`'^: ~`'^~:  `'^:'  `'^~:o ,`'^:`'^: ~`'^~:  `'^:' :";
_Static_assert(sizeof latin_base == 65 && sizeof latin_accent == 65, "U+C0 to U+FF");

static const glyph *accent_of(char c)
{
    static const struct {
        char c;
        glyph g;
    } accent[] = {{'`', {6, "M0 21L6 17"}},           {'\'', {6, "M6 21L0 17"}},
                  {'^', {8, "M0 17L4 21L8 17"}},      {'~', {10, "M0 18Q3 21 5 19Q7 17 10 20"}},
                  {':', {6, "M0 19L0 19M6 19L6 19"}}, {'o', {5, "M5 19V3 22H0 19V3 17H5 19"}},
                  {',', {4, "M3 0L3 -2Q3 -5 0 -5"}}};

    for (size_t i = 0; i < sizeof accent / sizeof accent[0]; i++)
        if (accent[i].c == c)
            return &accent[i].g;
    return NULL;
}

/* The glyph of the character at *s, which moves on, and the accent that belongs to it. */
static const glyph *glyph_next(const unsigned char **s, const glyph **accent, int *raise)
{
    uint32_t code = *(*s)++;
    int more = code >= 0xf0 ? 3 : code >= 0xe0 ? 2 : code >= 0xc0 ? 1 : 0;

    *accent = NULL;
    code &= more ? 0x3fu >> more : 0xffu;
    for (; more && (**s & 0xc0) == 0x80; more--)
        code = code << 6 | (*(*s)++ & 0x3fu);
    if (code >= ' ' && code <= '~')
        return ascii + (code - ' ');
    for (int i = 0; i < N_SIGN; i++)
        if (sign[i].code == code)
            return &sign[i].g;
    if (code >= 0xc0 && code <= 0xff && latin_base[code - 0xc0] != ' ') {
        *accent = accent_of(latin_accent[code - 0xc0]);
        *raise = code < 0xe0 && latin_accent[code - 0xc0] != ',' ? 6 : 0;
        return ascii + (latin_base[code - 0xc0] - ' ');
    }
    return ascii + (UNKNOWN - ' ');
}

typedef struct pen {
    cairo_t *cr;
    double x, y, unit; /* origin of the glyph and length of a grid unit           */
    double at[2];      /* on the grid                                             */
} pen;

static void curve(pen *p, const double a[2], const double b[2], const double to[2])
{
    cairo_curve_to(p->cr, p->x + a[0] * p->unit, p->y - a[1] * p->unit, p->x + b[0] * p->unit,
                   p->y - b[1] * p->unit, p->x + to[0] * p->unit, p->y - to[1] * p->unit);
}

/* A dot somewhat thicker than the strokes, or it looks faint. */
static void dot(pen *p)
{
    cairo_new_sub_path(p->cr);
    cairo_arc(p->cr, p->x + p->at[0] * p->unit, p->y - p->at[1] * p->unit, 0.35 * p->unit, 0, 6.2832);
}

static void command(pen *p, char c, const double *v)
{
    const double k = 0.5523; /* a quarter of an ellipse as a cubic */
    const double *from = p->at, *to = c == 'Q' ? v + 2 : v;
    double a[2], b[2];

    if (c == 'M')
        cairo_move_to(p->cr, p->x + v[0] * p->unit, p->y - v[1] * p->unit);
    else if (c == 'L' && v[0] == from[0] && v[1] == from[1])
        dot(p);
    else if (c == 'L')
        cairo_line_to(p->cr, p->x + v[0] * p->unit, p->y - v[1] * p->unit);
    for (int i = 0; i < 2; i++) {
        double first = c == 'Q' ? 2.0 / 3 * (v[i] - from[i]) : (c == 'H') == (i == 0) ? k * (to[i] - from[i]) : 0;
        double last = c == 'Q' ? 2.0 / 3 * (v[i] - to[i]) : (c == 'H') == (i == 0) ? 0 : k * (from[i] - to[i]);

        a[i] = from[i] + first;
        b[i] = to[i] + last;
    }
    if (c == 'Q' || c == 'H' || c == 'V')
        curve(p, a, b, to);
    p->at[0] = to[0];
    p->at[1] = to[1];
}

static void glyph_path(pen *p, const glyph *g)
{
    const char *s = g->path;

    while (*s) {
        char c = *s++;
        double v[4];

        for (int i = 0; i < (c == 'Q' ? 4 : 2); i++) {
            char *rest;

            v[i] = (double)strtol(s, &rest, 10);
            s = rest;
        }
        command(p, c, v);
    }
}

/* Walks along the text, drawing if there is a cairo context; returns the length. */
static double walk(cairo_t *cr, const char *text, double x, double y, double size)
{
    const unsigned char *s = (const unsigned char *)text;
    double start = x, unit = size * STROKE_CAPITAL / 20, scale = 1, shift = 0;
    int any = 0;

    while (*s) {
        const glyph *g, *accent;
        int raise = 0;

        if (*s <= 3) {
            scale = *s == 3 ? 1 : 0.7;
            shift = *s == 1 ? -5 * unit : *s == 2 ? 9 * unit : 0;
            s++;
            continue;
        }
        g = glyph_next(&s, &accent, &raise);
        if (cr) {
            pen p = {.cr = cr, .x = x, .y = y - shift, .unit = unit * scale};

            glyph_path(&p, g);
            p.x += 0.5 * (g->width - (accent ? accent->width : 0)) * p.unit;
            p.y -= raise * p.unit;
            if (accent)
                glyph_path(&p, accent);
        }
        x += (g->width + GAP) * unit * scale;
        any = 1;
    }
    return any ? x - start - GAP * unit * scale : 0;
}

double stroke_text_length(const char *s, double size)
{
    return walk(NULL, s, 0, 0, size);
}

void stroke_text_draw(cairo_t *cr, const char *s, double x, double y, double size, double angle, double weight)
{
    cairo_save(cr);
    cairo_translate(cr, x, y);
    cairo_rotate(cr, angle);
    cairo_new_path(cr);
    walk(cr, s, 0, 0, size);
    cairo_set_line_width(cr, weight * 0.085 * size);
    cairo_set_line_cap(cr, CAIRO_LINE_CAP_ROUND);
    cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
    cairo_stroke(cr);
    cairo_restore(cr);
}
