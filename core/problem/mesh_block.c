/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * mesh{} of a case: a box, or a file. */
#include "problem/problem.h"

#include <lauxlib.h>

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* Bytes that a cell costs before anything is solved (pattern, matrix, offsets), by dimension; measured. */
static const double bytes_per_cell[4] = {0, 0, 6e3, 250e3};

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

static int read_corners(problem *p, reader *r)
{
    lua_State *l = p->c->lua;
    double *corner[2] = {p->box.low, p->box.high};
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
        case_wrong(p->c, r->b, "box",
                   "mesh: \"box\": expected two corners of 2 or 3 numbers, as in {{0, 0}, {1, 1}}");
        return -1;
    }
    p->box.dim = p->dim = n[0];
    for (int k = 0; k < n[0]; k++)
        if (!(p->box.low[k] < p->box.high[k])) {
            case_wrong(p->c, r->b, "box",
                       "mesh: \"box\": the second corner must lie beyond the first, %g is not > %g", p->box.high[k],
                       p->box.low[k]);
            return -1;
        }
    return 0;
}

/* One entry of cells: a number, or the positions of grid lines. */
static int read_ticks(problem *p, reader *r, int k)
{
    lua_State *l = p->c->lua;
    int n = lua_istable(l, -1) ? (int)lua_rawlen(l, -1) : 0;
    double size = p->box.high[k] - p->box.low[k], *tick;

    if (lua_isinteger(l, -1) ||
        (lua_type(l, -1) == LUA_TNUMBER && lua_tonumber(l, -1) == floor(lua_tonumber(l, -1)))) {
        double x = lua_tonumber(l, -1);

        p->box.n[k] = x > 1e7 ? 10000000 : (int)x;
        if (x >= 1)
            return 0;
    }
    if (n < 2 || !(tick = arena_alloc(&p->memory, (size_t)n, sizeof *tick)) || numbers(l, tick, n) != n) {
        case_wrong(
            p->c, r->b, "cells",
            "mesh: \"cells\": entry %d must be a number of cells, at least 1, or the positions of its grid lines "
            "(graded(a, b, n, ratio) and grid{a, n, b, ...} make such lists)",
            k + 1);
        return -1;
    }
    for (int i = 0; i + 1 < n; i++)
        if (!(tick[i] < tick[i + 1])) {
            case_wrong(p->c, r->b, "cells", "mesh: \"cells\": grid lines of direction %d must ascend: %g, %g",
                       k + 1, tick[i], tick[i + 1]);
            return -1;
        }
    if (fabs(tick[0] - p->box.low[k]) > 1e-9 * size || fabs(tick[n - 1] - p->box.high[k]) > 1e-9 * size) {
        case_wrong(p->c, r->b, "cells",
                   "mesh: \"cells\": grid lines of direction %d go from %g to %g, the box from %g to %g", k + 1,
                   tick[0], tick[n - 1], p->box.low[k], p->box.high[k]);
        return -1;
    }
    tick[0] = p->box.low[k];
    tick[n - 1] = p->box.high[k];
    p->box.n[k] = n - 1;
    p->box.ticks[k] = tick;
    return 0;
}

static void read_box(problem *p, reader *r)
{
    static const char *const shape[] = {"quads", "hexes", "triangles", "tets", NULL};
    lua_State *l = p->c->lua;
    int kind = 0, status;

    if (read_corners(p, r))
        p->box.dim = 0;
    if (reader_choice(r, "shape", "shape of the cells", shape, &kind) > 0 && p->box.dim &&
        kind % 2 != p->box.dim - 2)
        case_wrong(p->c, r->b, "shape", "mesh: \"shape\": a box in %dD has %s or %s", p->box.dim,
                   p->box.dim == 2 ? "quads" : "hexes", p->box.dim == 2 ? "triangles" : "tets");
    p->box.simplex = kind >= 2;
    status = reader_table(r, "cells", "number of cells in each direction");
    if (!reader_required(r, "cells", status))
        return;
    for (int k = 0; k < p->box.dim; k++) {
        lua_rawgeti(l, -1, k + 1);
        read_ticks(p, r, k);
        lua_pop(l, 1);
    }
    if (p->box.dim && (int)lua_rawlen(l, -1) != p->box.dim)
        case_wrong(p->c, r->b, "cells", "mesh: \"cells\": %d entries for a box in %dD", (int)lua_rawlen(l, -1),
                   p->box.dim);
    lua_pop(l, 1);
}

int problem_read_mesh(problem *p, error *err)
{
    const case_block *b = case_find(p->c, "mesh", 0);
    const char *file = NULL;
    reader r;

    (void)err;
    if (!b) {
        case_wrong(p->c, NULL, NULL,
                   "the case has no mesh; add a line like mesh { box = {{0, 0}, {1, 1}}, cells = {32, 32} }");
        return 0;
    }
    reader_open(&r, p->c, b, "mesh");
    if (reader_has(&r, "file")) {
        reader_string(&r, "file", "mesh file of Gmsh (.msh or .geo), relative to the case", &file);
        reader_integer(&r, "dim", "dimension of the mesh in the file", 2, 3, &p->dim);
        if (p->dim == 0)
            p->dim = 2;
        if (file) {
            const char *slash = strrchr(p->c->path, '/');
            char path[4096];

            snprintf(path, sizeof path, "%.*s%s", *file == '/' || !slash ? 0 : (int)(slash - p->c->path + 1),
                     p->c->path, file);
            p->mesh_path = arena_strdup(&p->memory, path);
        }
    } else if (reader_has(&r, "box")) {
        read_box(p, &r);
    } else {
        case_wrong(p->c, b, NULL,
                   "mesh: expected box = {{x, y}, {x, y}} with cells = {...}, or file = \"name.msh\"");
    }
    if (p->dim) {
        int status = reader_value(&r, "map", "function that moves the nodes, x, y[, z] -> x, y[, z]", p->dim,
                                  p->dim, &p->mesh_map);

        p->has_map = status > 0;
    }
    if (p->dim == 0) /* box was wrong: do not complain about its other keys */
        return 0;
    reader_close(&r);
    return 0;
}

static int read_file(problem *p, error *err)
{
    const pf_mesh_reader *reader_plugin;
    pf_mesh_data data = {.size = sizeof data};
    char why[1500] = "";
    int status;

    if (access(p->mesh_path, R_OK) != 0)
        return error_set(err, ERR_MESH, "%s:%d: mesh file %s is not there or cannot be read",
                         case_find(p->c, "mesh", 0)->file, case_find(p->c, "mesh", 0)->line, p->mesh_path);
    status = registry_mesh_reader(p->r, "mesh_gmsh", &reader_plugin, err);
    if (status) {
        error_prefix(err,
                     "mesh file %s needs the plugin that reads Gmsh files (Debian package libgmsh-dev, then ./pf "
                     "build): ",
                     p->mesh_path);
        return status;
    }
    status = reader_plugin->read(p->mesh_path, p->dim, &data, why, sizeof why);
    if (status)
        return error_set(err, status == PF_MESH_MEMORY ? ERR_MEMORY : ERR_MESH, "mesh file %s: %s", p->mesh_path,
                         why);
    if ((int)data.dim != p->dim)
        status = error_set(err, ERR_MESH, "mesh file %s is %uD; say dim = %u in mesh{}", p->mesh_path, data.dim,
                           data.dim);
    else
        status = mesh_create_from_data(&data, p->mesh_path, &p->mesh, err);
    reader_plugin->release(&data);
    return status;
}

/* Refuses meshes that cannot fit before any of them is allocated. */
static int check_size(const problem *p, error *err)
{
    double cells = p->box.simplex ? (p->dim == 2 ? 2 : 6) : 1, bytes;
    double memory = (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGESIZE);

    for (int k = 0; k < p->dim; k++)
        cells *= p->box.n[k];
    bytes = cells * bytes_per_cell[p->dim] * (p->box.simplex ? 0.3 : 1);
    if (bytes <= memory)
        return 0;
    return error_set(
        err, ERR_MEMORY,
        "mesh: %.4g cells need about %.3g GB before anything is solved, this machine has %.3g GB; take fewer "
        "cells (about %.3g fit)",
        cells, bytes / 1e9, memory / 1e9, cells * memory / bytes);
}

int problem_make_mesh(problem *p, error *err)
{
    double start = solve_seconds();

    if (p->mesh_path) {
        TRY(read_file(p, err));
    } else {
        TRY(check_size(p, err));
        TRY(mesh_create_box(&p->box, &p->mesh, err));
    }
    for (int64_t i = 0; p->has_map && i < p->mesh.n_node; i++) {
        double x[3] = {0}, y[3];

        memcpy(x, p->mesh.x + i * p->dim, (size_t)p->dim * sizeof *x);
        TRY(value_at(&p->mesh_map, x, 0, y, err));
        memcpy(p->mesh.x + i * p->dim, y, (size_t)p->dim * sizeof *x);
    }
    TRY(mesh_measure(&p->mesh, err));
    p->mesh_seconds = solve_seconds() - start;
    return 0;
}
