/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Bodies in the picture: the outlines that lie beside the file of fields (particles_NNNNN.vtp, as a run
 * writes them), with a spoke that shows how each is turned, and the paths of their centres. */
#include "io/picture_parts.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { POINTS = 97 }; /* of a body: centre, then its outline */

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

/* Up to `time`, a point a line of particles.csv; a jump of number starts another body. */
static int read_paths(const char *path, double time, picture_bodies *b, arena *a, error *err)
{
    FILE *f = fopen(path, "r");
    char line[2000];

    for (int pass = 0; f && pass < 2; pass++) {
        b->n_step = 0;
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

int bodies_read(const char *vtu_path, double time, picture_bodies *b, arena *a, error *err)
{
    char path[4600], line[400];
    FILE *f;
    int n = 0;

    memset(b, 0, sizeof *b);
    if (!beside(vtu_path, "particles_", ".vtp", path, sizeof path) || !(f = fopen(path, "r")))
        return 0;
    while (fgets(line, sizeof line, f) && sscanf(line, "<Piece NumberOfPoints=\"%d\"", &n) != 1)
        ;
    b->n = n > 0 && n < 100000000 ? n / POINTS : 0;
    b->point = b->n ? arena_alloc(a, (size_t)b->n * POINTS, sizeof *b->point) : NULL;
    n = 0;
    while (b->point && n < b->n * POINTS && fgets(line, sizeof line, f))
        n += sscanf(line, "%lf %lf", &b->point[n][0], &b->point[n][1]) == 2;
    fclose(f);
    if (b->n && !b->point)
        return error_memory(err, path, 0);
    if (n < b->n * POINTS)
        return error_set(err, ERR_IO, "%s: the file ends early; run the case again", path);
    if (b->n && beside(vtu_path, "particles.csv", NULL, path, sizeof path))
        return read_paths(path, time, b, a, err);
    return 0;
}

/* A body that went through a periodic boundary: it moved by more than twice its size in one step. */
static int jumps(const picture_bodies *b, long i)
{
    const double(*p)[2] = (const double(*)[2])b->point + (i % b->n) * POINTS;
    double size = hypot(p[1][0] - p[0][0], p[1][1] - p[0][1]);

    return hypot(b->step[i][0] - b->step[i - b->n][0], b->step[i][1] - b->step[i - b->n][1]) > 4 * size;
}

void bodies_draw(cairo_t *cr, const picture_bodies *b, double em, const bodies_place *place)
{
    cairo_set_line_width(cr, 0.05 * em);
    cairo_set_source_rgba(cr, 1, 1, 1, 0.8);
    for (long i = 0; i < b->n_step; i++) {
        double x = place->x(place->ctx, b->step[i][0]), y = place->y(place->ctx, b->step[i][1]);

        if (i < b->n || jumps(b, i))
            continue;
        cairo_move_to(cr, place->x(place->ctx, b->step[i - b->n][0]), place->y(place->ctx, b->step[i - b->n][1]));
        cairo_line_to(cr, x, y);
    }
    cairo_stroke(cr);
    for (int k = 0; k < b->n; k++) {
        const double(*p)[2] = (const double(*)[2])b->point + k * POINTS;

        for (int i = 1; i < POINTS; i++) {
            double x = place->x(place->ctx, p[i][0]), y = place->y(place->ctx, p[i][1]);

            if (i == 1)
                cairo_move_to(cr, x, y);
            else
                cairo_line_to(cr, x, y);
        }
        cairo_close_path(cr);
        cairo_set_source_rgb(cr, 0.93, 0.93, 0.93);
        cairo_fill_preserve(cr);
        cairo_move_to(cr, place->x(place->ctx, p[0][0]), place->y(place->ctx, p[0][1]));
        cairo_line_to(cr, place->x(place->ctx, p[1][0]), place->y(place->ctx, p[1][1]));
        cairo_set_source_rgb(cr, 0.13, 0.13, 0.13);
        cairo_set_line_width(cr, 0.08 * em);
        cairo_stroke(cr);
    }
}
