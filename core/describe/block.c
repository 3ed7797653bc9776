/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What the readers of all blocks share: tables within a block, values without `free`, warnings with a line. */
#include "describe/describe.h"

#include <lauxlib.h>

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

int describe_inner(description *d, const case_block *b, const char *kind, const case_block **inner, error *err)
{
    case_block *own;

    ARENA_NEW(&d->memory, own, 1, err);
    *own = (case_block){.kind = kind, .file = b->file, .line = b->line};
    own->ref = luaL_ref(d->c->lua, LUA_REGISTRYINDEX);
    *inner = own;
    return 0;
}

int describe_value(reader *r, const char *key, const char *doc, int n, int dim, value *v)
{
    int status = reader_value(r, key, doc, n, dim, v);

    for (int k = 0; status > 0 && k < n; k++)
        if (v->free[k]) {
            case_wrong(r->c, r->b, key,
                       "%s: \"%s\": free leaves a component open to the equations where boundary{} prescribes the "
                       "others; here every component needs a number or a function",
                       r->what, key);
            return -1;
        }
    return status;
}

void describe_warn(description *d, const case_block *b, const char *key, const char *fmt, ...)
{
    char why[1000];
    va_list ap;

    va_start(ap, fmt);
    vsnprintf(why, sizeof why, fmt, ap);
    va_end(ap);
    warning_add(d->warnings, "%s:%d: %s", b->file, case_line(d->c, b, key), why);
}

int describe_numbers(lua_State *l, double *v, int most)
{
    lua_Unsigned n = lua_istable(l, -1) ? lua_rawlen(l, -1) : 0;
    int ok = lua_istable(l, -1) && n <= (lua_Unsigned)most;

    for (int i = 0; ok && i < (int)n; i++) {
        ok = lua_rawgeti(l, -1, i + 1) == LUA_TNUMBER && isfinite(lua_tonumber(l, -1));
        v[i] = lua_tonumber(l, -1);
        lua_pop(l, 1);
    }
    return ok ? (int)n : -1;
}

int describe_corners(reader *r, const char *key, const char *doc, double *low, double *high, int *dim)
{
    lua_State *l = r->c->lua;
    double *corner[2] = {low, high};
    int n[2] = {0, 0}, status = reader_table(r, key, doc), corners;

    *dim = 0;
    if (status <= 0)
        return status;
    corners = (int)lua_rawlen(l, -1);
    for (int i = 0; i < 2; i++) {
        lua_rawgeti(l, -1, i + 1);
        n[i] = describe_numbers(l, corner[i], 3);
        lua_pop(l, 1);
    }
    lua_pop(l, 1);
    if (corners != 2 || n[0] != n[1] || (n[0] != 2 && n[0] != 3)) {
        case_wrong(r->c, r->b, key,
                   "%s: \"%s\": expected two corners of 2 or 3 finite numbers, as in {{0, 0}, {1, 1}}", r->what,
                   key);
        return -1;
    }
    *dim = n[0];
    for (int k = 0; k < n[0]; k++)
        if (!(low[k] < high[k])) {
            case_wrong(r->c, r->b, key, "%s: \"%s\": the second corner must lie beyond the first, %g is not > %g",
                       r->what, key, high[k], low[k]);
            return -1;
        }
    return 1;
}
