/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * mesh{} of a case: a box, or a file. */
#include "describe/describe.h"

#include <lauxlib.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MOST_CELLS = 100000000 }; /* in one direction */

/* One entry of cells that is a number of them. */
static int read_count(description *d, reader *r, int k)
{
    double x = lua_tonumber(d->c->lua, -1);

    if (!(x >= 1 && x <= MOST_CELLS && x == floor(x))) {
        case_wrong(
            d->c, r->b, "cells",
            "mesh: \"cells\": entry %d is %g; it must be a whole number of cells, 1 to %g, or the positions of "
            "grid lines",
            k + 1, x, (double)MOST_CELLS);
        return -1;
    }
    d->mesh.box.n[k] = (int)x;
    return 0;
}

static int check_ticks(description *d, reader *r, int k, const double *tick, int n)
{
    const double low = d->mesh.box.low[k], high = d->mesh.box.high[k], slack = 1e-9 * (high - low);

    for (int i = 0; i + 1 < n; i++)
        if (!(tick[i] < tick[i + 1])) {
            case_wrong(d->c, r->b, "cells", "mesh: \"cells\": grid lines of direction %d must ascend: %g, %g",
                       k + 1, tick[i], tick[i + 1]);
            return -1;
        }
    if (!d->mesh.box.dim) /* the box is wrong */
        return -1;
    if (fabs(tick[0] - low) > slack || fabs(tick[n - 1] - high) > slack) {
        case_wrong(d->c, r->b, "cells",
                   "mesh: \"cells\": grid lines of direction %d go from %g to %g, the box from %g to %g", k + 1,
                   tick[0], tick[n - 1], low, high);
        return -1;
    }
    return 0;
}

/* One entry of cells, on top of the Lua stack: a number, or the positions of grid lines. */
static int read_ticks(description *d, reader *r, int k, error *err)
{
    lua_State *l = d->c->lua;
    lua_Unsigned n = lua_istable(l, -1) ? lua_rawlen(l, -1) : 0;
    double *tick;

    if (lua_type(l, -1) == LUA_TNUMBER) {
        read_count(d, r, k);
        return 0;
    }
    if (n < 2 || n > MOST_CELLS) {
        case_wrong(
            d->c, r->b, "cells",
            "mesh: \"cells\": entry %d must be a number of cells, at least 1, or the positions of its grid lines "
            "(graded(a, b, n, ratio) and grid{a, n, b, ...} make such lists)",
            k + 1);
        return 0;
    }
    ARENA_NEW(&d->memory, tick, n, err);
    if (describe_numbers(l, tick, (int)n) < 0) {
        case_wrong(d->c, r->b, "cells", "mesh: \"cells\": grid lines of direction %d must be finite numbers",
                   k + 1);
        return 0;
    }
    if (check_ticks(d, r, k, tick, (int)n))
        return 0;
    tick[0] = d->mesh.box.low[k];
    tick[n - 1] = d->mesh.box.high[k];
    d->mesh.box.n[k] = (int)n - 1;
    d->mesh.box.ticks[k] = tick;
    return 0;
}

static int read_box(description *d, reader *r, error *err)
{
    static const char *const shape[] = {"quads", "hexes", "triangles", "tets", NULL};
    lua_State *l = d->c->lua;
    int kind = 0, status;

    status = describe_corners(r, "box", "corners {{x, y[, z]}, {x, y[, z]}}", d->mesh.box.low, d->mesh.box.high,
                              &d->dim);
    d->mesh.box.dim = status > 0 ? d->dim : 0;
    if (reader_choice(r, "shape", "shape of the cells", shape, &kind) > 0 && d->mesh.box.dim &&
        kind % 2 != d->mesh.box.dim - 2)
        case_wrong(d->c, r->b, "shape", "mesh: \"shape\": a box in %dD has %s or %s", d->mesh.box.dim,
                   d->mesh.box.dim == 2 ? "quads" : "hexes", d->mesh.box.dim == 2 ? "triangles" : "tets");
    d->mesh.box.simplex = kind >= 2;
    status = reader_table(r, "cells", "number of cells in each direction");
    if (status <= 0) {
        if (reader_has(r, "box"))
            reader_required(r, "cells", status);
        return 0;
    }
    if (d->dim == 0 && (lua_rawlen(l, -1) == 2 || lua_rawlen(l, -1) == 3))
        d->dim = (int)lua_rawlen(l, -1); /* a guess, to find what else is wrong with the case */
    if (d->dim && (int)lua_rawlen(l, -1) != d->dim)
        case_wrong(d->c, r->b, "cells",
                   "mesh: \"cells\": expected %d entries, one for each direction of the box, got %d", d->dim,
                   (int)lua_rawlen(l, -1));
    else
        for (int k = 0; k < d->dim; k++) {
            lua_rawgeti(l, -1, k + 1);
            TRY(read_ticks(d, r, k, err));
            lua_pop(l, 1);
        }
    lua_pop(l, 1);
    return 0;
}

static int read_file(description *d, reader *r, error *err)
{
    const char *file = NULL, *slash = strrchr(d->c->path, '/');
    char path[4096];

    reader_string(r, "file", "mesh file of Gmsh (.msh or .geo), relative to the case", &file);
    reader_integer(r, "dim", "dimension of the mesh in the file", 2, 3, &d->dim);
    if (d->dim == 0)
        d->dim = 2;
    if (reader_note(r, "box", "corners {{x, y[, z]}, {x, y[, z]}}")) {
        reader_note(r, "cells", "number of cells in each direction");
        reader_note(r, "shape", "shape of the cells");
        case_wrong(d->c, r->b, "box", "mesh: \"box\" and \"file\" are both given; one of the two makes the mesh");
    }
    if (!file)
        return 0;
    snprintf(path, sizeof path, "%.*s%s", *file == '/' || !slash ? 0 : (int)(slash - d->c->path + 1), d->c->path,
             file);
    d->mesh.path = arena_strdup(&d->memory, path);
    return d->mesh.path ? 0 : error_memory(err, "mesh", 0);
}

static void read_map(description *d, reader *r)
{
    d->mesh.has_map = describe_value(r, "map", "function that moves the nodes, x, y[, z] -> x, y[, z]", d->dim,
                                     d->dim, &d->mesh.map) > 0;
    if (d->mesh.has_map && !d->mesh.map.f)
        case_wrong(
            d->c, r->b, "map",
            "mesh: \"map\" must be a function of x, y[, z] that returns where the node goes; constants would "
            "bring all nodes to one place");
}

int describe_mesh(description *d, error *err)
{
    const case_block *b = case_find(d->c, "mesh", 0);
    reader r;

    if (!b) {
        case_wrong(d->c, NULL, NULL,
                   "the case has no mesh; add a line like mesh { box = {{0, 0}, {1, 1}}, cells = {32, 32} }");
        return 0;
    }
    d->mesh.block = b;
    reader_open(&r, d->c, b, "mesh");
    if (reader_has(&r, "file")) {
        TRY(read_file(d, &r, err));
    } else {
        if (!reader_has(&r, "box") && !reader_misspelt(&r, "box") && !reader_misspelt(&r, "file"))
            case_wrong(d->c, b, NULL,
                       "mesh: expected box = {{x, y}, {x, y}} with cells = {...}, or file = \"name.msh\"");
        reader_note(&r, "file", "mesh file of Gmsh (.msh or .geo), relative to the case");
        TRY(read_box(d, &r, err));
    }
    if (d->dim)
        read_map(d, &r);
    else
        reader_note(&r, "map", "function that moves the nodes");
    reader_close(&r);
    return 0;
}

int describe_is_box(const description *d)
{
    return d->mesh.box.dim > 0 && !d->mesh.path && !d->mesh.has_map;
}

int describe_moves(const description *d)
{
    int moves = 0;

    for (int k = 0; k < d->n_body && d->time.unsteady; k++)
        moves |= d->body[k].motion != BODY_FIXED;
    return moves;
}
