/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * stabilised.h -- what tests of the terms of plugin stabilise share: a box of cells of each shape, and its residual
 * and matrix. */
#ifndef STABILISED_H
#define STABILISED_H

#include "support/opened.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const shapes[] = {"quads", "triangles", "hexes", "tets"};

enum { SHAPES = 4 };

#define CASE                                                                                                       \
    "local shape = param('shape', 'quads', 'shape of the cells')\n"                                                \
    "local solid = shape == 'hexes' or shape == 'tets'\n"                                                          \
    "mesh { box = solid and {{0, 0, 0}, {1.5, 1, 0.8}} or {{0, 0}, {1.5, 1}}, cells = solid and {4, 3, 3} or "     \
    "{5, 4}, shape = shape }\n"                                                                                    \
    "fluid { density = 1.3, viscosity = 0.07 }\n"                                                                  \
    "term 'continuity' {}\ntime { scheme = 'bdf1', step = 0.1, stop = 1 }\n"

static inline opened *open_shape(const char *text, const char *shape, const char *other)
{
    char set[64];

    snprintf(set, sizeof set, "shape=%s", shape);
    return open_text(text, (const char *[]){set, other}, other ? 2 : 1);
}

/* Residual and matrix at x, in k->p.system. */
static inline void assemble(opened *k, const double *x)
{
    newton_system *sys = &k->p.system;
    double *zero = calloc((size_t)k->p.space.n_dof, sizeof *zero);
    assembly_state at = {.x = x, .dot = zero, .old = x};

    assert_non_null(zero);
    if (assembly_run(&sys->assembly, &at, sys->residual, sys->linear.value, 1, &k->err))
        fail_msg("assembly: %s", k->err.text);
    free(zero);
}

static inline int is_velocity(const space *s, int64_t dof)
{
    return strcmp(s->field[s->dof_field[dof]].name, "u") == 0;
}

static inline double *velocity_of(const opened *k, uint64_t seed)
{
    const space *s = &k->p.space;
    double *x = malloc((size_t)s->n_dof * sizeof *x);

    assert_non_null(x);
    fill_random(x, s->n_dof, seed);
    for (int64_t i = 0; i < s->n_dof; i++)
        x[i] = is_velocity(s, i) ? x[i] : 0;
    return x;
}

/* y . J z over velocities; the matrix is assembled. */
static inline double product(const opened *k, const double *y, const double *z)
{
    const space *s = &k->p.space;
    double sum = 0;

    for (int64_t i = 0; i < s->n_free; i++)
        for (int64_t e = s->row[i]; e < s->row[i + 1]; e++)
            if (is_velocity(s, s->dof_of[i]) && is_velocity(s, s->dof_of[space_column(s, i, e)]))
                sum += y[s->dof_of[i]] * k->p.system.linear.value[e] * z[s->dof_of[space_column(s, i, e)]];
    return sum;
}

static inline void set_uniform(const space *s, const double *u, double *x)
{
    for (int64_t i = 0; i < s->n_dof; i++)
        x[i] = is_velocity(s, i) ? u[s->dof_comp[i]] : 0;
}

#endif
