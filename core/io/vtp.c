/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * VTK XML poly data, written as text.  A point of the surface lies where the ray from the body's centre in
 * direction d leaves it.  In the body's axes, with its half widths a, b, c,
 *
 *     2D  d = (a cos s, b sin s)          3D  d = (a sin t cos s, b sin t sin s, c cos t),
 *
 * s and t equally spaced, multiples of 45 degrees among them: so corners of rectangles and rims of cylinders are
 * hit.  For the edges of a block (cos s, sin s) is stretched onto the square round the unit circle. */
#include "io/vtp.h"

#include "base/text.h"
#include "io/file.h"

#include <math.h>

enum { OUTLINE = 96 };

/* Bands of latitude of a surface of n bodies; a band has four triangles for each of them.  All are multiples of
 * four, so that there are circles at 45 degrees. */
static int bands_of(int n)
{
    return n <= 4 ? 48 : n <= 20 ? 36 : 24;
}

static void surface_point(const solid *p, double s, double t, double x[3])
{
    const shape *q = p->shape;
    double stretch = q->kind == SHAPE_BOX ? 1 / fmax(fabs(cos(s)), fabs(sin(s))) : 1;
    double d[3] = {stretch * sin(t) * q->half[0] * cos(s), stretch * sin(t) * q->half[1] * sin(s),
                   q->dim == 3 ? q->half[2] * cos(t) : 0};
    double size = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]), low = 0, high = 1.5 * q->radius;

    for (int i = 0; i < 50; i++) {
        double mid = 0.5 * (low + high), body[3] = {mid * d[0] / size, mid * d[1] / size, mid * d[2] / size};

        if (shape_level(q, body) < 0)
            low = mid;
        else
            high = mid;
    }
    for (int k = 0; k < 3; k++)
        x[k] = k < q->dim
                   ? p->at.x[k] + low / size * (p->axes[k][0] * d[0] + p->axes[k][1] * d[1] + p->axes[k][2] * d[2])
                   : 0;
}

static void add_array(text *t, const char *name, const char *type, int width)
{
    text_add(t, "<DataArray type=\"%s\" Name=\"%s\" NumberOfComponents=\"%d\" format=\"ascii\">\n", type, name,
             width);
}

static void end_array(text *t)
{
    text_add(t, "</DataArray>\n");
}

static void add_point(text *t, const double *x)
{
    text_add(t, "%.9g %.9g %.9g\n", x[0], x[1], x[2]);
}

static void add_surface_point(text *t, const solid *p, double s, double angle)
{
    double x[3];

    surface_point(p, s, angle, x);
    add_point(t, x);
}

static void add_points(text *t, const vtp_body *body, int n)
{
    int bands = bands_of(n);

    add_array(t, "Points", "Float64", 3);
    for (int k = 0; k < n; k++) {
        const solid *p = &body[k].at;

        if (p->shape->dim == 2) {
            add_point(t, p->at.x);
            for (int i = 0; i < OUTLINE; i++)
                add_surface_point(t, p, 2 * M_PI * i / OUTLINE, M_PI / 2);
            continue;
        }
        add_surface_point(t, p, 0, 0);
        for (int j = 1; j < bands; j++)
            for (int i = 0; i < 2 * bands; i++)
                add_surface_point(t, p, M_PI * i / bands, M_PI * j / bands);
        add_surface_point(t, p, 0, M_PI);
    }
    end_array(t);
}

/* The cells' points and where they end. */
static void add_lines(text *t, const vtp_body *body, int n)
{
    int end = 0;

    text_add(t, "<Lines>\n");
    add_array(t, "connectivity", "Int32", 1);
    for (int k = 0; k < n; k++) {
        for (int i = !body[k].moves; i <= OUTLINE; i++)
            text_add(t, "%d ", k * (OUTLINE + 1) + i);
        text_add(t, "%d\n", k * (OUTLINE + 1) + 1);
    }
    end_array(t);
    add_array(t, "offsets", "Int32", 1);
    for (int k = 0; k < n; k++)
        text_add(t, "%d\n", end += OUTLINE + 2 - (!body[k].moves));
    end_array(t);
    text_add(t, "</Lines>\n");
}

/* Points and triangles of one surface. */
static int surface_points(int bands)
{
    return 2 + (bands - 1) * 2 * bands;
}

static int surface_triangles(int bands)
{
    return 2 * (bands - 1) * 2 * bands;
}

/* Point i of circle j; circles 0 and `bands` are the poles. */
static int on_circle(int bands, int j, int i)
{
    return j == 0 ? 0 : j == bands ? surface_points(bands) - 1 : 1 + (j - 1) * 2 * bands + i % (2 * bands);
}

static void add_triangles(text *t, int n)
{
    int bands = bands_of(n);

    text_add(t, "<Polys>\n");
    add_array(t, "connectivity", "Int32", 1);
    for (int k = 0; k < n; k++)
        for (int j = 0; j < bands; j++)
            for (int i = 0; i < 2 * bands; i++) {
                int first = k * surface_points(bands), a = first + on_circle(bands, j, i),
                    b = first + on_circle(bands, j, i + 1), c = first + on_circle(bands, j + 1, i),
                    d = first + on_circle(bands, j + 1, i + 1);

                if (c != d)
                    text_add(t, "%d %d %d\n", a, c, d);
                if (a != b)
                    text_add(t, "%d %d %d\n", a, d, b);
            }
    end_array(t);
    add_array(t, "offsets", "Int32", 1);
    for (int i = 1; i <= n * surface_triangles(bands); i++)
        text_add(t, "%d\n", 3 * i);
    end_array(t);
    text_add(t, "</Polys>\n");
}

/* Numbers first.. of each body's more. */
static void add_field(text *t, const vtp_body *body, int n, int cells, const vtp_field *f, int first)
{
    add_array(t, f->name, "Float64", f->width);
    for (int k = 0; k < n * cells; k++)
        for (int i = 0; i < f->width; i++)
            text_add(t, i + 1 < f->width ? "%.9g " : "%.9g\n", body[k / cells].more[first + i]);
    end_array(t);
}

static void add_cell_data(text *t, const vtp_body *body, int n, int cells, const vtp_field *field, int n_field)
{
    int first = 0;

    text_add(t, "<CellData>\n");
    add_array(t, "id", "Int32", 1);
    for (int k = 0; k < n * cells; k++)
        text_add(t, "%d\n", body[k / cells].id);
    end_array(t);
    add_array(t, "velocity", "Float64", 3);
    for (int k = 0; k < n * cells; k++)
        add_point(t, body[k / cells].velocity);
    end_array(t);
    add_array(t, "moves", "Int32", 1);
    for (int k = 0; k < n * cells; k++)
        text_add(t, "%d\n", body[k / cells].moves != 0);
    end_array(t);
    for (int i = 0; i < n_field; first += field[i++].width)
        add_field(t, body, n, cells, &field[i], first);
    text_add(t, "</CellData>\n");
}

int vtp_write(const char *path, int dim, const vtp_body *body, int n, const vtp_field *field, int n_field,
              error *err)
{
    int points = dim == 2 ? OUTLINE + 1 : surface_points(bands_of(n));
    int cells = dim == 2 ? 1 : surface_triangles(bands_of(n)), status;
    text t = {0};

    text_add(&t,
             "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" "
             "byte_order=\"LittleEndian\">\n<PolyData>\n"
             "<Piece NumberOfPoints=\"%d\" NumberOf%s=\"%d\">\n<Points>\n",
             n * points, dim == 2 ? "Lines" : "Polys", n * cells);
    add_points(&t, body, n);
    text_add(&t, "</Points>\n");
    if (dim == 2)
        add_lines(&t, body, n);
    else
        add_triangles(&t, n);
    add_cell_data(&t, body, n, cells, field, n_field);
    text_add(&t, "</Piece>\n</PolyData>\n</VTKFile>\n");
    status = t.failed ? error_memory(err, path, (double)t.n) : file_write(path, t.s, t.n, err);
    text_free(&t);
    return status;
}
