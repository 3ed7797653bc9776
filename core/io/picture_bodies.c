/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Bodies in the picture, from the geometry that lies beside the file of fields (particles_NNNNN.vtp): outlines in
 * 2D, with a spoke that shows how a body that moves is turned and the paths of the centres; sections in 3D. */
#include "io/picture_parts.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* fields_00012.vtu -> NAME in the same folder; 0 if it is no such file. */
static int beside(const char *vtu_path, const char *name, const char *suffix, char *path, size_t n)
{
    const char *slash = strrchr(vtu_path, '/'), *base = slash ? slash + 1 : vtu_path;
    int dir = (int)(base - vtu_path);

    if (strncmp(base, "fields_", 7) != 0 || strlen(base) < 12)
        return 0;
    if (suffix)
        snprintf(path, n, "%.*s%s%.*s%s", dir, vtu_path, name, (int)strlen(base) - 11, base + 7, suffix);
    else
        snprintf(path, n, "%.*s%s", dir, vtu_path, name);
    return 1;
}

/* Up to `time`, a point a line of particles.csv: all bodies of a step, then those of the next. */
static int read_paths(const char *path, double time, picture_bodies *b, arena *a, error *err)
{
    FILE *f = fopen(path, "r");
    char line[2000];

    for (int pass = 0; f && pass < 2; pass++) {
        b->n_step = b->n_path = 0;
        rewind(f);
        while (fgets(line, sizeof line, f)) {
            double t, id, x, y;

            if (sscanf(line, "%lf,%lf,%lf,%lf", &t, &id, &x, &y) != 4 || t > time)
                continue;
            if (pass) {
                b->step[b->n_step][0] = x;
                b->step[b->n_step][1] = y;
            }
            b->n_step++;
            b->n_path = (long)fmax((double)b->n_path, id + 1);
        }
        if (!pass && b->n_step && !(b->step = arena_alloc(a, (size_t)b->n_step, sizeof *b->step))) {
            fclose(f);
            return error_memory(err, path, 16.0 * (double)b->n_step);
        }
    }
    if (f)
        fclose(f);
    return 0;
}

/* Lines in the plane: centre, outline, its first point again; without the centre where no spoke is drawn. */
static int read_lines(const vtp_file *v, picture_bodies *b, arena *a, error *err)
{
    size_t n = 0;

    ARENA_NEW(a, b->loop, v->n_cell + 1, err);
    ARENA_NEW(a, b->point, v->first[v->n_cell] + 1, err);
    for (size_t c = 0; c < v->n_cell; c++) {
        size_t m = v->first[c + 1] - v->first[c];
        const size_t *p = v->corner + v->first[c];
        int spoke = m > 1 && p[m - 1] != p[0];
        picture_loop *l = &b->loop[b->n];

        if (m < 5)
            continue;
        *l = (picture_loop){.first = n, .n = m - 1 - (size_t)spoke, .id = v->id[c], .spoke = spoke};
        memcpy(l->centre, v->point[p[0]], sizeof l->centre);
        for (size_t i = 0; i < l->n; i++)
            memcpy(b->point[n++], v->point[p[i + (size_t)spoke]], sizeof *b->point);
        b->n++;
    }
    return 0;
}

int bodies_read(const char *vtu_path, const picture_view *view, double time, picture_bodies *b, arena *a,
                error *err)
{
    char path[4600];
    vtp_file v;

    memset(b, 0, sizeof *b);
    if (!beside(vtu_path, "particles_", ".vtp", path, sizeof path) || access(path, F_OK) != 0)
        return 0;
    TRY(vtp_read(path, &v, a, err));
    if (view->dim == 3)
        return v.polygons ? section_make(&v, view, b, a, err) : 0;
    TRY(read_lines(&v, b, a, err));
    if (b->n && beside(vtu_path, "particles.csv", NULL, path, sizeof path))
        return read_paths(path, time, b, a, err);
    return 0;
}

/* Half the larger extent of body id, m; 0 if it is not drawn. */
static double half_extent(const picture_bodies *b, long id)
{
    for (int k = 0; k < b->n; k++) {
        const picture_loop *l = &b->loop[k];
        double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};

        for (size_t i = l->first; l->id == id && i < l->first + l->n; i++)
            for (int d = 0; d < 2; d++) {
                low[d] = fmin(low[d], b->point[i][d]);
                high[d] = fmax(high[d], b->point[i][d]);
            }
        if (l->id == id)
            return 0.5 * fmax(high[0] - low[0], high[1] - low[1]);
    }
    return 0;
}

/* Lines between successive places.  A body that moved by more than twice its size in one step went through a
 * periodic boundary. */
static void draw_paths(cairo_t *cr, const picture_bodies *b, double em, const bodies_place *place)
{
    cairo_set_line_width(cr, 0.05 * em);
    cairo_set_source_rgba(cr, 1, 1, 1, 0.8);
    for (long id = 0; id < b->n_path; id++) {
        double size = half_extent(b, id);

        for (long i = id + b->n_path; i < b->n_step; i += b->n_path) {
            const double *x = b->step[i], *before = b->step[i - b->n_path];

            if (hypot(x[0] - before[0], x[1] - before[1]) > 4 * size)
                continue;
            cairo_move_to(cr, place->x(place->ctx, before[0]), place->y(place->ctx, before[1]));
            cairo_line_to(cr, place->x(place->ctx, x[0]), place->y(place->ctx, x[1]));
        }
    }
    cairo_stroke(cr);
}

static void loop_path(cairo_t *cr, const picture_bodies *b, const picture_loop *l, const bodies_place *place)
{
    for (size_t i = l->first; i < l->first + l->n; i++) {
        double x = place->x(place->ctx, b->point[i][0]), y = place->y(place->ctx, b->point[i][1]);

        if (i == l->first)
            cairo_move_to(cr, x, y);
        else
            cairo_line_to(cr, x, y);
    }
    cairo_close_path(cr);
}

void bodies_draw(cairo_t *cr, const picture_bodies *b, double em, const bodies_place *place)
{
    draw_paths(cr, b, em, place);
    for (int k = 0; k < b->n; k++) {
        const picture_loop *l = &b->loop[k];

        loop_path(cr, b, l, place);
        cairo_set_source_rgb(cr, 0.93, 0.93, 0.93);
        cairo_fill_preserve(cr);
        if (l->spoke) {
            cairo_move_to(cr, place->x(place->ctx, l->centre[0]), place->y(place->ctx, l->centre[1]));
            cairo_line_to(cr, place->x(place->ctx, b->point[l->first][0]),
                          place->y(place->ctx, b->point[l->first][1]));
        }
        cairo_set_source_rgb(cr, 0.13, 0.13, 0.13);
        cairo_set_line_width(cr, 0.08 * em);
        cairo_stroke(cr);
    }
}

static double raster_x(const void *ctx, double x)
{
    const picture_raster *r = ctx;

    return (x - r->left) * r->scale[0];
}

static double raster_y(const void *ctx, double y)
{
    const picture_raster *r = ctx;

    return (r->top - y) * r->scale[1];
}

int bodies_cover(const picture_bodies *b, picture_raster *r, arena *a, error *err)
{
    const bodies_place place = {raster_x, raster_y, r};
    cairo_surface_t *image;
    cairo_t *cr;
    cairo_status_t status;

    r->solid = NULL;
    if (!b->n)
        return 0;
    ARENA_NEW(a, r->solid, (size_t)r->w * (size_t)r->h, err);
    image = cairo_image_surface_create(CAIRO_FORMAT_A8, r->w, r->h);
    cr = cairo_create(image);
    cairo_set_antialias(cr, CAIRO_ANTIALIAS_NONE);
    for (int k = 0; k < b->n; k++) {
        loop_path(cr, b, &b->loop[k], &place);
        cairo_fill(cr);
    }
    cairo_surface_flush(image);
    status = cairo_status(cr);
    for (int j = 0; !status && j < r->h; j++)
        memcpy(r->solid + (size_t)j * (size_t)r->w,
               cairo_image_surface_get_data(image) + j * cairo_image_surface_get_stride(image), (size_t)r->w);
    cairo_destroy(cr);
    cairo_surface_destroy(image);
    return status ? error_memory(err, "picture of the bodies", (double)r->w * r->h) : 0;
}
