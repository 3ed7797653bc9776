/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * mesh{} of a case: a box, or a file. */
#include "describe/describe.h"

#include <lauxlib.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Numbers from the table on top of the stack; their count, or -1. */
static int numbers(lua_State *l, double *v, int most)
{
    int n = (int)lua_rawlen(l, -1);

    for (int i = 0; i < n; i++) {
        lua_rawgeti(l, -1, i + 1);
        if (i >= most || lua_type(l, -1) != LUA_TNUMBER) {
            lua_pop(l, 1);
            return -1;
        }
        v[i] = lua_tonumber(l, -1);
        lua_pop(l, 1);
    }
    return n;
}

static int read_corners(description *d, reader *r)
{
    lua_State *l = d->c->lua;
    double *corner[2] = {d->mesh.box.low, d->mesh.box.high};
    int n[2] = {0, 0};

    if (reader_table(r, "box", "corners {{x, y[, z]}, {x, y[, z]}}") <= 0)
        return -1;
    for (int i = 0; i < 2; i++) {
        lua_rawgeti(l, -1, i + 1);
        n[i] = lua_istable(l, -1) ? numbers(l, corner[i], 3) : -1;
        lua_pop(l, 1);
    }
    lua_pop(l, 1);
    if (n[0] != n[1] || (n[0] != 2 && n[0] != 3)) {
        case_wrong(d->c, r->b, "box",
                   "mesh: \"box\": expected two corners of 2 or 3 numbers, as in {{0, 0}, {1, 1}}");
        return -1;
    }
    d->mesh.box.dim = d->dim = n[0];
    for (int k = 0; k < n[0]; k++)
        if (!(d->mesh.box.low[k] < d->mesh.box.high[k])) {
            case_wrong(d->c, r->b, "box",
                       "mesh: \"box\": the second corner must lie beyond the first, %g is not > %g",
                       d->mesh.box.high[k], d->mesh.box.low[k]);
            return -1;
        }
    return 0;
}

/* One entry of cells: a number, or the positions of grid lines. */
static int read_ticks(description *d, reader *r, int k)
{
    lua_State *l = d->c->lua;
    int n = lua_istable(l, -1) ? (int)lua_rawlen(l, -1) : 0;
    double size = d->mesh.box.high[k] - d->mesh.box.low[k], *tick;

    if (lua_isinteger(l, -1) ||
        (lua_type(l, -1) == LUA_TNUMBER && lua_tonumber(l, -1) == floor(lua_tonumber(l, -1)))) {
        double x = lua_tonumber(l, -1);

        d->mesh.box.n[k] = x > 1e7 ? 10000000 : (int)x;
        if (x >= 1)
            return 0;
    }
    if (n < 2 || !(tick = arena_alloc(&d->memory, (size_t)n, sizeof *tick)) || numbers(l, tick, n) != n) {
        case_wrong(
            d->c, r->b, "cells",
            "mesh: \"cells\": entry %d must be a number of cells, at least 1, or the positions of its grid lines "
            "(graded(a, b, n, ratio) and grid{a, n, b, ...} make such lists)",
            k + 1);
        return -1;
    }
    for (int i = 0; i + 1 < n; i++)
        if (!(tick[i] < tick[i + 1])) {
            case_wrong(d->c, r->b, "cells", "mesh: \"cells\": grid lines of direction %d must ascend: %g, %g",
                       k + 1, tick[i], tick[i + 1]);
            return -1;
        }
    if (fabs(tick[0] - d->mesh.box.low[k]) > 1e-9 * size || fabs(tick[n - 1] - d->mesh.box.high[k]) > 1e-9 * size) {
        case_wrong(d->c, r->b, "cells",
                   "mesh: \"cells\": grid lines of direction %d go from %g to %g, the box from %g to %g", k + 1,
                   tick[0], tick[n - 1], d->mesh.box.low[k], d->mesh.box.high[k]);
        return -1;
    }
    tick[0] = d->mesh.box.low[k];
    tick[n - 1] = d->mesh.box.high[k];
    d->mesh.box.n[k] = n - 1;
    d->mesh.box.ticks[k] = tick;
    return 0;
}

static void read_box(description *d, reader *r)
{
    static const char *const shape[] = {"quads", "hexes", "triangles", "tets", NULL};
    lua_State *l = d->c->lua;
    int kind = 0, status;

    if (read_corners(d, r))
        d->mesh.box.dim = 0;
    if (reader_choice(r, "shape", "shape of the cells", shape, &kind) > 0 && d->mesh.box.dim &&
        kind % 2 != d->mesh.box.dim - 2)
        case_wrong(d->c, r->b, "shape", "mesh: \"shape\": a box in %dD has %s or %s", d->mesh.box.dim,
                   d->mesh.box.dim == 2 ? "quads" : "hexes", d->mesh.box.dim == 2 ? "triangles" : "tets");
    d->mesh.box.simplex = kind >= 2;
    status = reader_table(r, "cells", "number of cells in each direction");
    if (!reader_required(r, "cells", status))
        return;
    for (int k = 0; k < d->mesh.box.dim; k++) {
        lua_rawgeti(l, -1, k + 1);
        read_ticks(d, r, k);
        lua_pop(l, 1);
    }
    if (d->mesh.box.dim && (int)lua_rawlen(l, -1) != d->mesh.box.dim)
        case_wrong(d->c, r->b, "cells", "mesh: \"cells\": %d entries for a box in %dD", (int)lua_rawlen(l, -1),
                   d->mesh.box.dim);
    lua_pop(l, 1);
}

void describe_mesh(description *d)
{
    const case_block *b = case_find(d->c, "mesh", 0);
    const char *file = NULL;
    reader r;

    if (!b) {
        case_wrong(d->c, NULL, NULL,
                   "the case has no mesh; add a line like mesh { box = {{0, 0}, {1, 1}}, cells = {32, 32} }");
        return;
    }
    d->mesh.block = b;
    reader_open(&r, d->c, b, "mesh");
    if (reader_has(&r, "file")) {
        reader_string(&r, "file", "mesh file of Gmsh (.msh or .geo), relative to the case", &file);
        reader_integer(&r, "dim", "dimension of the mesh in the file", 2, 3, &d->dim);
        if (d->dim == 0)
            d->dim = 2;
        if (file) {
            const char *slash = strrchr(d->c->path, '/');
            char path[4096];

            snprintf(path, sizeof path, "%.*s%s", *file == '/' || !slash ? 0 : (int)(slash - d->c->path + 1),
                     d->c->path, file);
            d->mesh.path = arena_strdup(&d->memory, path);
        }
    } else if (reader_has(&r, "box")) {
        read_box(d, &r);
    } else {
        case_wrong(d->c, b, NULL,
                   "mesh: expected box = {{x, y}, {x, y}} with cells = {...}, or file = \"name.msh\"");
    }
    if (d->dim) {
        int status = reader_value(&r, "map", "function that moves the nodes, x, y[, z] -> x, y[, z]", d->dim,
                                  d->dim, &d->mesh.map);

        d->mesh.has_map = status > 0;
    }
    if (d->dim) /* else box was wrong: do not complain about its other keys */
        reader_close(&r);
}
