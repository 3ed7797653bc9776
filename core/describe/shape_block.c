/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * shape = disk{...} of a body: the table that the prelude makes of it. */
#include "describe/describe.h"

#include <math.h>
#include <string.h>

static const char *const shape_kinds[] = {"ellipsoid", "box", "cylinder", "superellipsoid", "distance", NULL};

static void read_exponents(description *d, reader *r, const case_block *b, shape *s)
{
    const int n = d->dim - 1;

    s->exponent[0] = s->exponent[1] = 2;
    reader_vector(r, "exponent", "of a superellipsoid", 2, s->exponent);
    for (int k = 0; k < n; k++)
        if (!(s->exponent[k] >= 1)) {
            case_wrong(d->c, b, "shape", "shape: exponents of a superellipsoid must be at least 1, %g is not",
                       s->exponent[k]);
            return;
        }
}

/* The dimension that the shape is for. */
static int check_dim(description *d, reader *r, const case_block *b)
{
    const char *name = "", *other = "";
    int dim = d->dim;

    reader_string(r, "name", "of the function that made the shape", &name);
    reader_string(r, "other", "what takes its place in the other dimension", &other);
    reader_integer(r, "dim", "dimension that the shape is for", 2, 3, &dim);
    if (dim != d->dim)
        case_wrong(d->c, b, "shape", "shape: %s{} is a shape in %dD, the mesh is %dD; use %s", name, dim, d->dim,
                   other);
    return dim == d->dim;
}

/* Volume, moments and reach; a shape that has none is a mistake of the case, a warning if they are not exact. */
static int measure(description *d, const case_block *b, shape *s, error *err)
{
    int status = shape_measure(s, &d->memory, err);

    if (status == ERR_CASE && !shape_check(s, NULL)) { /* an error of the function names its line itself */
        case_wrong(d->c, b, "shape", "shape: %s", err->text);
        return 0;
    }
    if (!status && s->accuracy > 1e-4)
        warning_add(
            d->warnings,
            "%s:%d: shape: volume and moments of inertia of the body are known to %.1g only, its surface has "
            "edges or is thin against half; a smaller box round it (half = ...) helps",
            b->file, b->line, s->accuracy);
    return status;
}

int describe_shape(description *d, const case_block *b, shape *s, error *err)
{
    const int before = d->c->n_wrong;
    const case_block *inner;
    double half[3] = {0};
    reader r;

    memset(s, 0, sizeof *s);
    s->dim = d->dim;
    TRY(describe_inner(d, b, "shape", &inner, err));
    reader_open(&r, d->c, inner, "shape");
    if (!reader_has(&r, "kind")) {
        case_wrong(d->c, b, "shape",
                   "shape: a plain table has no shape; write the function that makes it, as in shape = %s { radius "
                   "= 0.1 }",
                   d->dim == 2 ? "disk" : "sphere");
        return 0;
    }
    if (!check_dim(d, &r, b))
        return 0;
    reader_choice(&r, "kind", "shape; use disk{}, sphere{}, ellipse{}, box{} ...", shape_kinds, &s->kind);
    if (!reader_required(&r, "half", reader_vector(&r, "half", "half widths, m", d->dim, half)))
        return 0;
    for (int k = 0; k < d->dim; k++) {
        s->half[k] = half[k];
        if (!(half[k] > 0)) {
            case_wrong(d->c, b, "shape", "shape: widths must be positive, %g is not", half[k]);
            break;
        }
    }
    read_exponents(d, &r, b, s);
    if (s->kind == SHAPE_DISTANCE)
        reader_required(
            &r, "distance",
            describe_value(&r, "distance", "signed distance, function of x, y[, z]", 1, d->dim, &s->distance));
    if (s->kind == SHAPE_CYLINDER && d->dim == 2)
        case_wrong(d->c, b, "shape", "shape: a cylinder needs three dimensions; in 2D use disk{} or rectangle{}");
    reader_close(&r);
    return d->c->n_wrong == before ? measure(d, b, s, err) : 0;
}
