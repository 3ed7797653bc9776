/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Volume, centroid, second moments and reach of a shape.
 *
 * With e the exponent of x and y and f that of z, a superellipsoid has (Dirichlet's integrals, G = Gamma)
 *
 *     2D   V = 4 a b G(1+1/e)^2 / G(1+2/e),       int x^2 = 4/3 a^3 b G(1+3/e) G(1+1/e) / G(1+4/e),
 *     3D   V = 2 c V_2D G(1+1/f) G(1+2/f) / G(1+3/f),
 *          int x^2 = 2 c (int x^2)_2D G(1+1/f) G(1+4/f) / G(1+5/f),
 *          int z^2 = 2/3 c^3 V_2D G(1+3/f) G(1+2/f) / G(1+5/f):
 *
 * its section at z is the superellipse, smaller by (1 - |z/c|^f)^(1/f). */
#include "particle/particle.h"

#include <gsl/gsl_sf_gamma.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Gamma(1 + n / e) */
static double g(double n, double e)
{
    return gsl_sf_gamma(1 + n / e);
}

static void measure_superellipsoid(shape *s)
{
    const double *h = s->half, e = s->exponent[0], f = s->exponent[1];
    double area = 4 * h[0] * h[1] * g(1, e) * g(1, e) / g(2, e);
    double second = 4.0 / 3 * h[0] * h[1] * g(3, e) * g(1, e) / g(4, e), along = 1;

    s->volume = area;
    if (s->dim == 3) {
        s->volume = 2 * h[2] * area * g(1, f) * g(2, f) / g(3, f);
        s->moment[2][2] = 2.0 / 3 * h[2] * h[2] * h[2] * area * g(3, f) * g(2, f) / g(5, f);
        along = 2 * h[2] * g(1, f) * g(4, f) / g(5, f);
    }
    for (int k = 0; k < 2; k++)
        s->moment[k][k] = h[k] * h[k] * second * along;
}

static void measure_formula(shape *s)
{
    const double *h = s->half;
    double part = s->kind == SHAPE_BOX ? 3 : s->dim == 2 ? 4 : 5; /* int x^2 = V h^2 / part */

    if (s->kind == SHAPE_ELLIPSOID)
        s->volume = s->dim == 2 ? M_PI * h[0] * h[1] : 4 * M_PI / 3 * h[0] * h[1] * h[2];
    else if (s->kind == SHAPE_BOX)
        s->volume = s->dim == 2 ? 4 * h[0] * h[1] : 8 * h[0] * h[1] * h[2];
    else
        s->volume = 2 * M_PI * h[0] * h[0] * h[2];
    for (int k = 0; k < s->dim; k++)
        s->moment[k][k] = s->volume * h[k] * h[k] / (s->kind == SHAPE_CYLINDER ? (k < 2 ? 4 : 3) : part);
}

/* --- general shapes: by the quadrature of implicit.c on a mesh over the box --- */

/* The mesh is a little larger than the box, so that no surface lies on its outer faces. */
#define LARGER 1.0437
/* Changes from mesh to mesh, relative: small enough; part of the body outside of its box that is a mistake. */
#define CLOSE 1e-8
#define OVER  1e-4

enum { COARSE_2D = 16, FINE_2D = 64, COARSE_3D = 5, FINE_3D = 10 };

/* Integrals over a body about the origin of its distance function, and points of its surface. */
typedef struct body_integral {
    const shape *shape;
    const mesh *m;
    int32_t cell;
    double volume, over; /* over: of the part outside of the box */
    double first[3], second[3][3];
    double (*surface)[3];
    int64_t n, room;
    int failed; /* memory ran out */
} body_integral;

static void add_inside(void *ctx, const double *xi, double weight)
{
    body_integral *b = ctx;
    double x[3], j[3][3], w = weight * mesh_place(b->m, b->cell, xi, x, j);
    int over = 0;

    b->volume += w;
    for (int i = 0; i < b->shape->dim; i++) {
        over |= fabs(x[i]) > b->shape->half[i];
        b->first[i] += w * x[i];
        for (int k = 0; k < b->shape->dim; k++)
            b->second[i][k] += w * x[i] * x[k];
    }
    b->over += over ? w : 0;
}

static void add_surface(void *ctx, const double *xi, const double *x, const double *nds)
{
    body_integral *b = ctx;

    (void)xi, (void)nds;
    if (b->n == b->room) {
        int64_t room = 2 * b->room + 1024;
        double(*more)[3] = realloc(b->surface, (size_t)room * sizeof *more);

        if (!more) {
            b->failed = 1;
            return;
        }
        b->surface = more;
        b->room = room;
    }
    memcpy(b->surface[b->n++], x, sizeof *b->surface);
}

static int add_cells(body_integral *b, const implicit_rule *rule, error *err)
{
    solid here = solid_at(b->shape, &(pose){.q = {1}});
    int whole;

    for (b->cell = 0; b->cell < b->m->n_cell; b->cell++)
        TRY(implicit_cell(rule, b->m, b->cell, &here, &(implicit_sink){b, add_inside, add_surface}, &whole, err));
    return b->failed ? error_memory(err, "surface of a shape", 24.0 * (double)b->room) : 0;
}

/* Integrates over n cells in each direction; b->surface goes to the caller in any case. */
static int integrate(const shape *s, const implicit_rule *rule, int n, body_integral *b, error *err)
{
    mesh_box box = {.dim = s->dim, .n = {n, n, n}};
    mesh m;
    int status;

    for (int k = 0; k < s->dim; k++) {
        box.high[k] = LARGER * s->half[k];
        box.low[k] = -box.high[k];
    }
    free(b->surface);
    *b = (body_integral){.shape = s, .m = &m};
    status = mesh_create_box(&box, &m, err);
    if (!status)
        status = mesh_measure(&m, err);
    if (!status)
        status = add_cells(b, rule, err);
    mesh_destroy(&m);
    return status;
}

/* How much of volume (relative), centroid and second moments (in sizes of the body) changed. */
static double change(const body_integral *a, const body_integral *b, double radius)
{
    double v = b->volume, d = fabs(a->volume - v) / v;

    if (!(v > 0)) /* too thin to be seen yet */
        return INFINITY;
    for (int i = 0; i < 3; i++) {
        d = fmax(d, fabs(a->first[i] - b->first[i]) / (v * radius));
        for (int j = 0; j < 3; j++)
            d = fmax(d, fabs(a->second[i][j] - b->second[i][j]) / (v * radius * radius));
    }
    return d;
}

static int keep_surface(shape *s, const body_integral *b, arena *memory, error *err)
{
    double(*support)[3];

    ARENA_NEW(memory, support, b->n, err);
    for (int64_t i = 0; i < b->n; i++)
        for (int k = 0; k < s->dim; k++)
            support[i][k] = b->surface[i][k] - s->centre[k];
    s->support = (const double(*)[3])support;
    s->n_support = b->n;
    return 0;
}

static int take(shape *s, const body_integral *b, arena *memory, error *err)
{
    if (!(b->volume > 0) || b->n == 0)
        return error_set(err, ERR_CASE,
                         "the distance function is nowhere negative inside the box of its shape, or everywhere");
    if (b->over > OVER * b->volume)
        return error_set(
            err, ERR_CASE,
            "the body of a distance function reaches over its box: %.2g of its volume lies outside; give "
            "larger half widths (half = ...)",
            b->over / b->volume);
    s->volume = b->volume;
    for (int k = 0; k < s->dim; k++) {
        s->centre[k] = b->first[k] / b->volume;
        s->radius += fabs(s->centre[k]);
    }
    for (int i = 0; i < s->dim; i++)
        for (int j = 0; j < s->dim; j++)
            s->moment[i][j] = b->second[i][j] - s->volume * s->centre[i] * s->centre[j];
    return keep_surface(s, b, memory, err);
}

/* A level that depends on more than the place has no surface, and a search on it no end. */
static int is_repeatable(const shape *s)
{
    for (int k = 0; k < 16; k++) {
        double x[3] = {0};

        for (int i = 0; i < s->dim; i++) /* spread over the box */
            x[i] = s->half[i] * (2 * fmod(0.5 + k * (i == 0 ? 0.618034 : i == 1 ? 0.754878 : 0.569840), 1) - 1);
        if (shape_level(s, x) != shape_level(s, x))
            return 0;
    }
    return 1;
}

static int measure_distance(shape *s, arena *memory, error *err)
{
    int fine = s->dim == 2 ? FINE_2D : FINE_3D;
    body_integral coarser = {0}, b = {0};
    implicit_rule rule;
    int status;

    ARENA_NEW(memory, s->fault, 1, err);
    memset(s->centre, 0, sizeof s->centre);
    if (!is_repeatable(s) && !shape_check(s, NULL))
        return error_set(err, ERR_CASE,
                         "distance gives two values at one point; it may depend on nothing but the point");
    TRY(implicit_rule_create(&rule, s->dim, err));
    s->accuracy = INFINITY;
    status = integrate(s, &rule, s->dim == 2 ? COARSE_2D : COARSE_3D, &coarser, err);
    for (int n = 2 * (s->dim == 2 ? COARSE_2D : COARSE_3D); !status && n <= fine && s->accuracy > CLOSE; n *= 2) {
        status = integrate(s, &rule, n, &b, err);
        s->accuracy = change(&coarser, &b, s->radius);
        coarser.volume = b.volume;
        memcpy(coarser.first, b.first, sizeof b.first);
        memcpy(coarser.second, b.second, sizeof b.second);
    }
    if (!status)
        status = take(s, &b, memory, err);
    free(coarser.surface);
    free(b.surface);
    return status;
}

int shape_measure(shape *s, arena *memory, error *err)
{
    s->radius = s->accuracy = 0;
    for (int k = 0; k < s->dim; k++)
        s->radius += s->half[k] * s->half[k];
    s->radius = s->kind == SHAPE_ELLIPSOID ? fmax(s->half[0], fmax(s->half[1], s->dim == 3 ? s->half[2] : 0))
                                           : sqrt(s->radius);
    if (s->kind == SHAPE_CYLINDER)
        s->radius = hypot(s->half[0], s->half[2]);
    s->thickness = 2 * fmin(s->half[0], s->dim == 3 ? fmin(s->half[1], s->half[2]) : s->half[1]);
    memset(s->moment, 0, sizeof s->moment);
    if (s->kind == SHAPE_DISTANCE)
        return measure_distance(s, memory, err);
    for (int i = 0; s->kind == SHAPE_SUPERELLIPSOID && i < s->dim - 1; i++)
        if (!(s->exponent[i] >= 1 && isfinite(s->exponent[i])))
            return error_set(err, ERR_CASE, "the exponents of a superellipsoid must be at least 1, %s is %g",
                             i ? "exponent_z" : "exponent", s->exponent[i]);
    if (s->kind == SHAPE_SUPERELLIPSOID)
        measure_superellipsoid(s);
    else
        measure_formula(s);
    return 0;
}
