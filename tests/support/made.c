/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "support/made.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

double made_field(const double *x)
{
    return 2 + 3 * x[0] - x[1] + 0.5 * x[2];
}

void made_create(made *k, int dim, int simplex, int n)
{
    static const pf_field u = {.name = "u", .unit = "m/s", .shape = PF_VECTOR, .order = 2};
    static const pf_field p = {.name = "p", .unit = "Pa", .shape = PF_SCALAR, .order = 1};
    mesh_box b = {.dim = dim, .simplex = simplex, .high = {1, 1, 1}, .n = {n, n, n}};
    error err;

    memset(k, 0, sizeof *k);
    assert_int_equal(mesh_create_box(&b, &k->m, &err), 0);
    assert_int_equal(mesh_measure(&k->m, &err), 0);
    assert_int_equal(fields_add(&k->fields, dim, &u, "test", &err), 0);
    assert_int_equal(fields_add(&k->fields, dim, &p, "test", &err), 0);
    assert_int_equal(space_number(&k->s, &k->fields, &k->m, 0, &err), 0);
    k->body = malloc((size_t)k->m.n_node * sizeof *k->body);
    k->x = calloc((size_t)k->s.n_dof, sizeof *k->x);
    assert_non_null(k->body);
    assert_non_null(k->x);
}

void made_destroy(made *k)
{
    free(k->body);
    free(k->x);
    space_destroy(&k->s);
    mesh_destroy(&k->m);
    arena_free(&k->memory);
}

void made_add(made *k, int kind, double a, double b, double c, const double *at, int moves)
{
    shape *s = &k->shapes[k->n];
    pose place = {.q = {1}};
    error err;

    *s = (shape){.kind = kind, .dim = k->m.dim, .half = {a, b, c}};
    memcpy(place.x, at, (size_t)k->m.dim * sizeof *at);
    assert_int_equal(shape_measure(s, &k->memory, &err), 0);
    k->bodies[k->n] = (vtp_body){.id = k->n, .moves = moves, .at = solid_at(s, &place), .velocity = {1, 2, 0}};
    k->n++;
}

double made_level(const vtp_body *b, const double *x)
{
    return solid_level(&b->at, x);
}

void made_fill(made *k, double inside, double depth)
{
    for (int64_t i = 0; i < k->m.n_node; i++) {
        double x[3] = {0}, p;

        memcpy(x, k->m.x + i * k->m.dim, (size_t)k->m.dim * sizeof *x);
        k->body[i] = -1;
        for (int b = 0; b < k->n; b++)
            if (made_level(&k->bodies[b], x) < -depth)
                k->body[i] = b;
        p = made_field(x);
        k->x[k->s.first[0][i]] = k->body[i] < 0 ? p : inside;
        if (k->s.first[1][i] >= 0)
            k->x[k->s.first[1][i]] = p;
    }
}

const char *made_write(made *k, const char *folder, int told)
{
    static char path[500];
    const vtu_bodies bodies = {k->body, 1u << 1};
    char vtp[500];
    error err;

    snprintf(vtp, sizeof vtp, "%s/particles_00000.vtp", folder);
    snprintf(path, sizeof path, "%s/fields_00000.vtu", folder);
    assert_int_equal(vtp_write(vtp, k->m.dim, k->bodies, k->n, NULL, 0, &err), 0);
    assert_int_equal(vtu_write(path, &k->s, (const int[]){0, 1}, 2, k->x, NAN, told ? &bodies : NULL, &err), 0);
    return path;
}
