/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The figure: title on top, the domain in a frame with its axes, the colour bar at the right.
 * The domain gets the width that the labels leave, at equal scales, but a height of at most
 * 1.1 widths; the figure then closes around what there is.  Lengths are in em of the text. */
#include "io/picture_parts.h"
#include "io/stroke_font.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double title_size = 1.15, label_gap = 0.35, tick = 0.35, edge = 0.9;

/* Longest label of the axis. */
static double labels_length(const picture_axis *a, double em)
{
    double longest = 0;
    char s[64];

    for (int i = 0; i < a->n; i++) {
        axis_label(a, i, s, sizeof s);
        longest = fmax(longest, stroke_text_length(s, em));
    }
    return longest;
}

static int whole(double v, int least, int most)
{
    return (int)fmax(least, fmin(most, floor(v)));
}

/* Size of the frame, once the lengths left and right of it are known. */
static void frame_size(picture_figure *g, double left, double right, double aspect, int width)
{
    double w = width - left - right, h = w * aspect, most = 1.1 * width;

    g->w = fmax(8, round(h > most ? most / aspect : w));
    g->h = fmax(4, round(fmin(h, most)));
}

void figure_place(picture_figure *g, const picture_text *text, const double low[2], const double high[2],
                  const double range[2], int width)
{
    double em = fmax(8, width / 56.0), aspect = (high[1] - low[1]) / (high[0] - low[0]), left = 5 * em, right, over,
           head, length[2], factor;
    int fits;

    *g = (picture_figure){.em = em, .bar_w = round(1.1 * em)};
    axis_ticks(&g->bar, range[0], range[1], 6, 9);
    right = 1.2 * em + g->bar_w + (tick + label_gap) * em + labels_length(&g->bar, em) + (0.7 + 0.9 + edge) * em;
    for (int pass = 0; pass < 2; pass++) {
        frame_size(g, left, right, aspect, width);
        fits = whole(g->h / (1.4 * em), 1, 12);
        axis_ticks(&g->up, low[1], high[1], whole(g->h / (2.2 * em), 2, 7), fits);
        left = (edge + 0.9 + 0.7 + label_gap + tick) * em + labels_length(&g->up, em);
    }
    frame_size(g, left, right, aspect, width);
    axis_ticks(&g->across, low[0], high[0], whole(g->w / (6 * em), 2, 7), whole(g->w / (3 * em), 1, 12));
    if (labels_length(&g->across, em) + 0.8 * em > g->w / fmax(1, g->across.n))
        axis_ticks(&g->across, low[0], high[0], 2, whole(g->w / (labels_length(&g->across, em) + em), 1, 12));

    g->bar_h = fmax(g->h, 9 * em);
    length[0] = stroke_text_length(text->bar, em);
    g->bar_text = em * fmin(1, (g->bar_h + 2 * em) / fmax(em, length[0]));
    length[0] *= g->bar_text / em;
    length[1] = stroke_text_length(text->y, em);
    over = ceil(0.5 * (fmax(g->bar_h, fmax(length[0], length[1])) - g->h));
    factor = g->bar.power || g->up.power ? 1.5 : 0;
    head = (text->title[0] ? 2.4 : 0.5) * em + factor * em + 0.5 * em;
    g->width =
        fmin(width, fmax(left + g->w + right, stroke_text_length(text->title, title_size * em) + 2 * edge * em));
    g->width = ceil(g->width);
    g->x = floor(0.5 * (g->width - left - g->w - right) + left);
    g->y = ceil(head + over);
    g->height = ceil(g->y + g->h + fmax(over + edge * em, (tick + label_gap + 0.7 + 0.9 + 0.7 + edge) * em));
    g->bar_x = g->x + g->w + round(1.2 * em);
    g->bar_y = round(g->y + 0.5 * (g->h - g->bar_h));
}

static void ink(cairo_t *cr)
{
    cairo_set_source_rgb(cr, 0.13, 0.13, 0.13);
}

static double across(const picture_content *c, double x)
{
    const picture_figure *g = c->figure;

    return g->x + (x - g->across.low) / (g->across.high - g->across.low) * g->w;
}

static double up(const picture_content *c, double y)
{
    const picture_figure *g = c->figure;

    return g->y + g->h - (y - g->up.low) / (g->up.high - g->up.low) * g->h;
}

static double place_x(const void *c, double x)
{
    return across(c, x);
}

static double place_y(const void *c, double y)
{
    return up(c, y);
}

/* The raster as an image of its own pixels, transparent outside of the domain. */
static cairo_surface_t *raster_image(const picture_content *c)
{
    const picture_raster *r = c->raster;
    cairo_surface_t *image = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, r->w, r->h);
    unsigned char *bytes = cairo_image_surface_get_data(image);
    size_t stride = (size_t)cairo_image_surface_get_stride(image);

    if (cairo_surface_status(image))
        return image;
    for (int j = 0; j < r->h; j++)
        for (int i = 0; i < r->w; i++) {
            double v = (double)r->value[0][(size_t)j * (size_t)r->w + (size_t)i], rgb[3];
            unsigned pixel = 0;

            if (isfinite(v)) {
                colour_map_rgb(&c->map, v, rgb);
                pixel = 0xffu << 24 | (unsigned)lround(255 * rgb[0]) << 16 | (unsigned)lround(255 * rgb[1]) << 8 |
                        (unsigned)lround(255 * rgb[2]);
            }
            memcpy(bytes + (size_t)j * stride + 4 * (size_t)i, &pixel, 4);
        }
    cairo_surface_mark_dirty(image);
    return image;
}

static void draw_raster(cairo_t *cr, const picture_content *c)
{
    const picture_figure *g = c->figure;
    cairo_surface_t *image = raster_image(c);

    cairo_save(cr);
    cairo_translate(cr, g->x, g->y);
    cairo_scale(cr, g->w / c->raster->w, g->h / c->raster->h);
    cairo_set_source_surface(cr, image, 0, 0);
    if (c->raster->w == (int)g->w)
        cairo_pattern_set_filter(cairo_get_source(cr), CAIRO_FILTER_NEAREST);
    cairo_rectangle(cr, 0, 0, c->raster->w, c->raster->h);
    cairo_fill(cr);
    cairo_restore(cr);
    cairo_surface_destroy(image);
}

static void draw_outline(cairo_t *cr, const picture_content *c)
{
    const picture_outline *o = c->outline;

    cairo_new_path(cr);
    for (size_t i = 0; i < o->n; i++) {
        const double *s = o->segment[i], *before = i ? o->segment[i - 1] : NULL;

        if (!before || before[2] != s[0] || before[3] != s[1])
            cairo_move_to(cr, across(c, s[0]), up(c, s[1]));
        cairo_line_to(cr, across(c, s[2]), up(c, s[3]));
    }
    ink(cr);
    cairo_set_line_width(cr, fmax(1, 0.07 * c->figure->em));
    cairo_set_line_cap(cr, CAIRO_LINE_CAP_ROUND);
    cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
    cairo_stroke(cr);
}

/* An arrow of (dx, dy) pixels around its middle. */
static void arrow_path(cairo_t *cr, double x, double y, double dx, double dy, double head)
{
    double length = hypot(dx, dy), a = fmin(head, 0.5 * length), ex = dx / length, ey = dy / length;
    double tip[2] = {x + 0.5 * dx, y + 0.5 * dy};

    cairo_move_to(cr, x - 0.5 * dx, y - 0.5 * dy);
    cairo_line_to(cr, tip[0], tip[1]);
    cairo_move_to(cr, tip[0] - a * (ex - 0.45 * ey), tip[1] - a * (ey + 0.45 * ex));
    cairo_line_to(cr, tip[0], tip[1]);
    cairo_line_to(cr, tip[0] - a * (ex + 0.45 * ey), tip[1] - a * (ey - 0.45 * ex));
}

static double speed_at(const picture_raster *r, size_t at)
{
    double s = hypot((double)r->value[1][at], (double)r->value[2][at]);

    return isfinite(s) && !(r->solid && r->solid[at]) ? s : 0;
}

/* Arrows on a grid, 25 along the longer side; the fastest is as long as the grid is wide. */
static void draw_arrows(cairo_t *cr, const picture_content *c)
{
    const picture_figure *g = c->figure;
    const picture_raster *r = c->raster;
    double gap = fmax(fmax(g->w, g->h) / 25, 0.8 * g->em), fastest = 0, per_pixel = r->w / g->w;
    int columns = whole(g->w / gap, 1, 1000), rows = whole(g->h / gap, 1, 1000);

    for (size_t i = 0; i < (size_t)r->w * (size_t)r->h; i++)
        fastest = fmax(fastest, speed_at(r, i));
    cairo_new_path(cr);
    for (int j = 0; j < rows; j++)
        for (int i = 0; i < columns; i++) {
            double x = (i + 0.5) * g->w / columns, y = (j + 0.5) * g->h / rows;
            size_t at = (size_t)(y * per_pixel) * (size_t)r->w + (size_t)(x * per_pixel);
            double s = speed_at(r, at), length = 0.85 * gap / fastest;

            if (s > 0.03 * fastest)
                arrow_path(cr, g->x + x, g->y + y, (double)r->value[1][at] * length,
                           -(double)r->value[2][at] * length, 0.3 * gap);
        }
    cairo_set_line_cap(cr, CAIRO_LINE_CAP_ROUND);
    cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
    cairo_set_source_rgba(cr, 1, 1, 1, 0.55);
    cairo_set_line_width(cr, 0.19 * g->em);
    cairo_stroke_preserve(cr);
    cairo_set_source_rgb(cr, 0.05, 0.05, 0.05);
    cairo_set_line_width(cr, 0.07 * g->em);
    cairo_stroke(cr);
}

static void line(cairo_t *cr, double x0, double y0, double x1, double y1)
{
    cairo_move_to(cr, x0, y0);
    cairo_line_to(cr, x1, y1);
}

/* Text with its middle at x on the base line y. */
static void text_middle(cairo_t *cr, const char *s, double x, double y, double size)
{
    stroke_text_draw(cr, s, x - 0.5 * stroke_text_length(s, size), y, size, 0, 1);
}

/* Text read upwards, its middle at y. */
static void text_upwards(cairo_t *cr, const char *s, double x, double y, double size)
{
    stroke_text_draw(cr, s, x, y + 0.5 * stroke_text_length(s, size), size, -1.5707963267948966, 1);
}

static void draw_axes(cairo_t *cr, const picture_content *c)
{
    const picture_figure *g = c->figure;
    double em = g->em, bottom = g->y + g->h, capital = STROKE_CAPITAL * em, base = bottom + (tick + label_gap) * em;
    char s[64];

    ink(cr);
    cairo_set_line_width(cr, fmax(1, 0.05 * em));
    cairo_set_line_cap(cr, CAIRO_LINE_CAP_BUTT);
    cairo_rectangle(cr, g->x, g->y, g->w, g->h);
    for (int i = 0; i < g->across.n; i++) {
        double x = across(c, g->across.first + i * g->across.step);

        line(cr, x, bottom, x, bottom + tick * em);
    }
    for (int i = 0; i < g->up.n; i++) {
        double y = up(c, g->up.first + i * g->up.step);

        line(cr, g->x - tick * em, y, g->x, y);
    }
    cairo_stroke(cr);
    for (int i = 0; i < g->across.n; i++) {
        axis_label(&g->across, i, s, sizeof s);
        text_middle(cr, s, across(c, g->across.first + i * g->across.step), base + capital, em);
    }
    for (int i = 0; i < g->up.n; i++) {
        axis_label(&g->up, i, s, sizeof s);
        stroke_text_draw(cr, s, g->x - (tick + label_gap) * em - stroke_text_length(s, em),
                         up(c, g->up.first + i * g->up.step) + 0.5 * capital, em, 0, 1);
    }
    text_middle(cr, c->text->x, g->x + 0.5 * g->w, base + 2 * capital + 0.9 * em, em);
    text_upwards(cr, c->text->y, g->x - (tick + label_gap + 0.75) * em - labels_length(&g->up, em),
                 g->y + 0.5 * g->h, em);
    axis_factor(&g->up, s, sizeof s);
    stroke_text_draw(cr, s, g->x, g->y - 0.6 * em, em, 0, 1);
    axis_factor(&g->across, s, sizeof s);
    stroke_text_draw(cr, s, g->x + g->w - stroke_text_length(s, em), base + 2 * capital + 0.9 * em, em, 0, 1);
}

/* Colours as a chain of small gradients, which every format draws without steps. */
static void bar_fill(cairo_t *cr, const picture_content *c)
{
    const picture_figure *g = c->figure;
    cairo_pattern_t *p = cairo_pattern_create_linear(0, g->bar_y + g->bar_h, 0, g->bar_y);
    const int n = 64;

    for (int i = 0; i <= n; i++) {
        double rgb[3];

        colour_map_rgb(&c->map, c->map.low + (c->map.high - c->map.low) * i / n, rgb);
        cairo_pattern_add_color_stop_rgb(p, (double)i / n, rgb[0], rgb[1], rgb[2]);
    }
    cairo_set_source(cr, p);
    cairo_pattern_destroy(p);
    cairo_rectangle(cr, g->bar_x, g->bar_y, g->bar_w, g->bar_h);
    cairo_fill(cr);
}

static void draw_bar(cairo_t *cr, const picture_content *c)
{
    const picture_figure *g = c->figure;
    double em = g->em, right = g->bar_x + g->bar_w, capital = STROKE_CAPITAL * em;
    char s[64];

    bar_fill(cr, c);
    ink(cr);
    cairo_set_line_width(cr, fmax(1, 0.05 * em));
    cairo_rectangle(cr, g->bar_x, g->bar_y, g->bar_w, g->bar_h);
    cairo_stroke(cr);
    for (int i = 0; i < g->bar.n; i++) {
        double v = g->bar.first + i * g->bar.step;
        double y = g->bar_y + g->bar_h * (1 - (v - g->bar.low) / (g->bar.high - g->bar.low));

        cairo_set_line_width(cr, fmax(1, 0.05 * em));
        line(cr, right, y, right + tick * em, y);
        cairo_stroke(cr);
        axis_label(&g->bar, i, s, sizeof s);
        stroke_text_draw(cr, s, right + (tick + label_gap) * em, y + 0.5 * capital, em, 0, 1);
    }
    text_upwards(cr, c->text->bar, right + (tick + label_gap + 0.7) * em + labels_length(&g->bar, em) + capital,
                 g->bar_y + 0.5 * g->bar_h, g->bar_text);
    axis_factor(&g->bar, s, sizeof s);
    stroke_text_draw(cr, s, g->bar_x, g->bar_y - 0.6 * em, em, 0, 1);
}

/* A title that is too long becomes smaller. */
static void draw_title(cairo_t *cr, const picture_content *c)
{
    const picture_figure *g = c->figure;
    double size = title_size * g->em, length = stroke_text_length(c->text->title, size);
    double room = g->width - 2 * edge * g->em, x = g->x + 0.5 * g->w;

    if (length > room) {
        size *= room / length;
        length = room;
    }
    x = fmax(edge * g->em + 0.5 * length, fmin(g->width - edge * g->em - 0.5 * length, x));
    text_middle(cr, c->text->title, x, (edge + 0.85) * g->em, size);
}

void figure_draw(cairo_t *cr, const picture_content *c)
{
    const picture_figure *g = c->figure;

    cairo_set_source_rgb(cr, 1, 1, 1);
    cairo_paint(cr);
    draw_raster(cr, c);
    draw_axes(cr, c);
    cairo_save(cr);
    cairo_rectangle(cr, g->x - 2, g->y - 2, g->w + 4, g->h + 4);
    cairo_clip(cr);
    if (c->arrows)
        draw_arrows(cr, c);
    if (c->bodies->n) {
        cairo_save(cr);
        cairo_rectangle(cr, c->figure->x, c->figure->y, c->figure->w, c->figure->h);
        cairo_clip(cr);
        bodies_draw(cr, c->bodies, c->figure->em, &(bodies_place){place_x, place_y, c});
        cairo_restore(cr);
    }
    draw_outline(cr, c);
    cairo_restore(cr);
    draw_bar(cr, c);
    ink(cr);
    draw_title(cr, c);
}
