/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * From a file and options to a figure: which plane, the labels, and the bytes, which are made in memory and written
 * at once. */
#include "io/picture.h"
#include "base/text.h"
#include "io/file.h"
#include "io/picture_parts.h"
#include "io/stroke_font.h"

#include <cairo-svg.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The plane; a plane in the domain's own end face is moved inwards by what nobody sees. */
static int choose_view(const vtu_file *v, const picture_options *o, picture_view *view, error *err)
{
    double low = INFINITY, high = -INFINITY, a[3], b[3], nudge;
    char axis = o->slice_axis ? o->slice_axis : 'z';

    *view = (picture_view){.dim = v->dim, .across = {0, 1}, .normal = 2};
    if (v->dim == 2 && o->slice_axis)
        return error_set(err, ERR_USAGE, "fields in two dimensions are drawn whole; leave out the slice at %c",
                         axis);
    if (v->dim == 2)
        return 0;
    if (axis < 'x' || axis > 'z')
        return error_set(err, ERR_USAGE, "the plane's axis '%c' is none of x, y and z", axis);
    view->normal = axis - 'x';
    view->across[0] = view->normal == 0 ? 1 : 0;
    view->across[1] = view->normal == 2 ? 1 : 2;
    for (size_t c = 0; c < v->n_cell; c++) {
        patch_box(v, c, a, b);
        low = fmin(low, a[view->normal]);
        high = fmax(high, b[view->normal]);
    }
    view->at = isnan(o->slice_at) ? 0.5 * (low + high) : o->slice_at;
    nudge = 1e-6 * (high - low);
    view->near = 1e-9 * (high - low);
    if (!(view->at >= low - nudge && view->at <= high + nudge))
        return error_set(err, ERR_USAGE, "the plane %c = %g lies outside of the domain, which has %c = %g to %g",
                         axis, view->at, axis, low, high);
    view->named = fabs(view->at) < 1e-9 * (high - low) ? 0 : view->at;
    view->at = fmax(low + nudge, fmin(high - nudge, view->at));
    return 0;
}

/* Largest finite value of the array, without sign. */
static double largest(const vtu_array *a)
{
    double most = 0;

    for (size_t i = 0; i < a->n; i++) {
        double v = fabs(vtu_number(a, i));

        most = isfinite(v) && v > most ? v : most;
    }
    return most;
}

/* Ends of the colours.  Where the field is constant but for rounding, by the size that it has
 * elsewhere, its noise is not drawn out: it gets a range around it. */
static int choose_range(const picture_options *o, const picture_raster *r, const vtu_array *field, double range[2],
                        error *err)
{
    double size = largest(field);

    range[0] = o->low;
    range[1] = o->high;
    if (range[0] < range[1] && isfinite(range[1] - range[0]))
        return 0;
    if (!(r->low <= r->high))
        return error_set(err, ERR_IO, "the field '%s' has no finite value here", field->name);
    if (!(size < 1e200))
        return error_set(err, ERR_IO, "the field '%s' has values up to %g", field->name, size);
    range[0] = r->low;
    range[1] = r->high;
    if (size < 1e-200) {
        range[0] = 0;
        range[1] = 1;
    } else if (!(r->high - r->low > 1e-11 * size)) {
        range[0] -= 0.05 * size;
        range[1] += 0.05 * size;
    }
    return 0;
}

/* Appends (" (unit)"), powers like ^2 and ^-1 raised. */
static void add_unit(text *t, const char *unit)
{
    if (!unit[0] || !strcmp(unit, "1"))
        return;
    text_add(t, " (");
    while (*unit) {
        size_t n = unit[0] == '^' ? 1 + (unit[1] == '-') : 0, digits = n ? strspn(unit + n, "0123456789") : 0;

        if (digits) {
            text_add(t, STROKE_SUPER "%s%.*s" STROKE_LINE, n == 2 ? "\xe2\x88\x92" : "", (int)digits, unit + n);
            unit += n + digits;
        } else {
            text_add(t, "%c", *unit++);
        }
    }
    text_add(t, ")");
}

static void add_plain(text *t, const char *s)
{
    for (; *s; s++)
        text_add(t, "%c", (unsigned char)*s < ' ' ? ' ' : *s);
}

static int keep(text *t, char *s, size_t size, error *err)
{
    int failed = t->failed;

    snprintf(s, size, "%s", t->s ? t->s : "");
    text_free(t);
    return failed ? error_memory(err, "labels", (double)size) : 0;
}

static int label_bar(const picture_field *f, picture_text *labels, error *err)
{
    const char *bar = f->component == PICTURE_MAGNITUDE && f->colour->components > 1 ? "|" : "";
    text t = {0};

    text_add(&t, "%s", bar);
    add_plain(&t, f->colour->name);
    text_add(&t, "%s", bar);
    if (f->component < PICTURE_MAGNITUDE)
        text_add(&t, STROKE_SUB "%s" STROKE_LINE, picture_component(f));
    add_unit(&t, f->colour->unit);
    return keep(&t, labels->bar, sizeof labels->bar, err);
}

static int label_axes(const vtu_file *v, const picture_view *view, picture_text *labels, error *err)
{
    for (int k = 0; k < 2; k++) {
        text t = {0};

        text_add(&t, "%c", 'x' + view->across[k]);
        add_unit(&t, v->point.unit[0] ? v->point.unit : "m");
        TRY(keep(&t, k ? labels->y : labels->x, sizeof labels->x, err));
    }
    return 0;
}

static int label_title(const vtu_file *v, const picture_view *view, const char *title, picture_text *labels,
                       error *err)
{
    char number[64];
    text t = {0};

    add_plain(&t, title ? title : "");
    if (v->dim == 3) {
        axis_number(view->named, number, sizeof number);
        text_add(&t, "%s%c = %s m", t.n ? ",  " : "", 'x' + view->normal, number);
    }
    if (v->has_time) {
        axis_number(v->time, number, sizeof number);
        text_add(&t, "%st = %s %s", t.n ? ",  " : "", number, v->time_unit[0] ? v->time_unit : "s");
    }
    return keep(&t, labels->title, sizeof labels->title, err);
}

/* The bytes of the figure. */
typedef struct sink {
    unsigned char *bytes;
    size_t n, room;
} sink;

static cairo_status_t sink_write(void *to, const unsigned char *bytes, unsigned n)
{
    sink *s = to;

    if (s->room - s->n < n) {
        size_t room = 2 * s->room + n;
        unsigned char *more = realloc(s->bytes, room);

        if (!more)
            return CAIRO_STATUS_NO_MEMORY;
        s->bytes = more;
        s->room = room;
    }
    memcpy(s->bytes + s->n, bytes, n);
    s->n += n;
    return CAIRO_STATUS_SUCCESS;
}

static cairo_status_t draw_into(sink *s, const picture_content *c, int svg)
{
    double w = c->figure->width, h = c->figure->height;
    cairo_surface_t *surface = svg ? cairo_svg_surface_create_for_stream(sink_write, s, w, h)
                                   : cairo_image_surface_create(CAIRO_FORMAT_RGB24, (int)w, (int)h);
    cairo_t *cr;
    cairo_status_t status;

    if (svg && !cairo_surface_status(surface))
        cairo_svg_surface_set_document_unit(surface, CAIRO_SVG_UNIT_PX);
    cr = cairo_create(surface);
    figure_draw(cr, c);
    status = cairo_status(cr);
    if (!status && !svg)
        status = cairo_surface_write_to_png_stream(surface, sink_write, s);
    cairo_destroy(cr);
    cairo_surface_finish(surface); /* an SVG is written here */
    if (!status)
        status = cairo_surface_status(surface);
    cairo_surface_destroy(surface);
    return status;
}

static int save(const picture_content *c, int svg, const char *path, error *err)
{
    sink s = {0};
    cairo_status_t drawn = draw_into(&s, c, svg);
    int status;

    if (drawn)
        status = error_set(err, drawn == CAIRO_STATUS_NO_MEMORY ? ERR_MEMORY : ERR_IO, "%s: cannot be drawn: %s",
                           path, cairo_status_to_string(drawn));
    else
        status = file_write(path, s.bytes, s.n, err);
    free(s.bytes);
    return status;
}

/* The raster: detail values a side for each of the frame's pixels. */
static int fill_frame(const vtu_file *v, const picture_view *view, const picture_field *f, const picture_content *c,
                      int detail, picture_raster *r, arena *a, error *err)
{
    const picture_outline *outline = c->outline;
    const picture_figure *g = c->figure;

    r->w = (int)g->w * detail;
    r->h = (int)g->h * detail;
    r->left = outline->low[0];
    r->top = outline->high[1];
    r->scale[0] = r->w / (outline->high[0] - outline->low[0]);
    r->scale[1] = r->h / (outline->high[1] - outline->low[1]);
    r->n_value = f->arrow ? 3 : 1;
    TRY(bodies_cover(c->bodies, r, a, err));
    return raster_make(v, view, f, r, a, err);
}

/* The frame's size hangs on the labels of the colours, their range on the values in the
 * frame: so the values are taken twice if the first guess of the frame does not fit. */
static int compose(const vtu_file *v, const picture_options *o, const picture_view *view, const picture_field *f,
                   picture_content *c, int detail, arena *a, error *err)
{
    const picture_outline *outline = c->outline;
    int width = o->width ? o->width : 1200;
    double range[2] = {0, 1};
    picture_figure *g;
    picture_raster *r;

    ARENA_NEW(a, g, 1, err);
    ARENA_NEW(a, r, 1, err);
    c->figure = g;
    c->raster = r;
    figure_place(g, c->text, outline->low, outline->high, range, width);
    TRY(fill_frame(v, view, f, c, detail, r, a, err));
    TRY(choose_range(o, r, f->colour, range, err));
    c->map = colour_map_of(range[0], range[1]);
    figure_place(g, c->text, outline->low, outline->high, range, width);
    if (r->w != (int)g->w * detail || r->h != (int)g->h * detail) {
        TRY(fill_frame(v, view, f, c, detail, r, a, err));
    }
    return 0;
}

/* The values that are drawn: up to the surfaces of bodies. */
static int extend_fields(const vtu_file *v, picture_field *f, vtu_array room[2], arena *a, error *err)
{
    TRY(extend_into_bodies(v, f->colour, &room[0], a, err));
    if (f->arrow)
        TRY(extend_into_bodies(v, f->arrow, &room[1], a, err));
    f->colour = &room[0];
    f->arrow = f->arrow ? &room[1] : NULL;
    return 0;
}

static int draw_file(const vtu_file *v, const char *vtu_path, const char *title, const picture_options *o, int svg,
                     const char *path, error *err)
{
    picture_view view;
    picture_field f = {0};
    picture_text labels;
    picture_outline outline;
    picture_bodies bodies = {0};
    picture_content c = {.text = &labels, .outline = &outline, .bodies = &bodies, .arrows = o->lines};
    vtu_array room[2];
    arena a = {0};
    int status;

    TRY(picture_choose(v, o, &f, err));
    TRY(choose_view(v, o, &view, err));
    TRY(label_bar(&f, &labels, err));
    TRY(label_axes(v, &view, &labels, err));
    TRY(label_title(v, &view, title, &labels, err));
    TRY(outline_make(v, &view, &outline, err));
    status = bodies_read(vtu_path, &view, v->has_time ? v->time : INFINITY, &bodies, &a, err);
    if (!status)
        status = extend_fields(v, &f, room, &a, err);
    if (!status)
        status = compose(v, o, &view, &f, &c, svg && o->width <= 4000 ? 2 : 1, &a, err);
    if (!status)
        status = save(&c, svg, path, err);
    outline_free(&outline);
    arena_free(&a);
    return status;
}

int picture_draw(const char *vtu_path, const char *title, const picture_options *o, const char *out_path,
                 error *err)
{
    static const picture_options usual = {.slice_at = NAN};
    vtu_file v;
    size_t n = strlen(out_path);
    int svg = n > 4 && !strcmp(out_path + n - 4, ".svg"), png = n > 4 && !strcmp(out_path + n - 4, ".png");
    int status;

    o = o ? o : &usual;
    if (!svg && !png)
        return error_set(err, ERR_USAGE, "%s: a picture's name ends in .png or .svg", out_path);
    if (o->width && (o->width < 200 || o->width > 10000))
        return error_set(err, ERR_USAGE, "a picture of %d pixels width; possible are 200 to 10000", o->width);
    TRY(vtu_open(&v, vtu_path, err));
    status = draw_file(&v, vtu_path, title, o, svg, out_path, err);
    if (status == ERR_USAGE)
        error_prefix(err, "%s: ", vtu_path);
    vtu_close(&v);
    return status;
}
