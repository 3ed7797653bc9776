/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Values of cases: numbers, vectors, and functions f(x, y[, z], t) that return them. */
#include "case/case.h"

#include <lauxlib.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct lua_value {
    case_file *c;
    const case_block *b;
    const char *key;
    int n, dim, whole; /* whole: one function returns all components */
    int truth;         /* the function may return true or false: 1 or 0 */
    int ref[VALUE_MAX];
    double constant[VALUE_MAX];
} lua_value;

/* Puts the function and the point before what went wrong. */
static int say_where(const lua_value *v, const double *x, double t, error *err)
{
    return error_prefix(err, "%s:%d: function \"%s\" at %s, t = %.6g: ", v->b->file, v->b->line, v->key,
                        text_point(x, v->dim == 3 ? 3 : 2).s, t);
}

/* Calls function `ref`; n results (or a table of n) to out. */
static int call(const lua_value *v, int ref, int n, const double *x, double t, double *out, error *err)
{
    lua_State *l = v->c->lua;
    int base = lua_gettop(l), status, in_table;

    lua_rawgeti(l, LUA_REGISTRYINDEX, ref);
    for (int k = 0; k < v->dim; k++)
        lua_pushnumber(l, x[k]);
    lua_pushnumber(l, t);
    status = case_call(v->c, v->key, v->dim + 1, n, err);
    in_table = !status && lua_istable(l, base + 1);
    for (int k = 0; k < n && !status; k++) {
        if (in_table)
            lua_rawgeti(l, base + 1, k + 1);
        else
            lua_pushvalue(l, base + 1 + k);
        out[k] = v->truth && lua_isboolean(l, -1) ? lua_toboolean(l, -1) : lua_tonumber(l, -1);
        if ((lua_type(l, -1) != LUA_TNUMBER && !(v->truth && lua_isboolean(l, -1))) || !isfinite(out[k]))
            status = error_set(err, ERR_CASE, "it must return %d number%s, result %d is %s", n, n > 1 ? "s" : "",
                               k + 1, lua_type(l, -1) == LUA_TNUMBER ? "not finite" : luaL_typename(l, -1));
        lua_pop(l, 1);
    }
    lua_settop(l, base);
    return status ? say_where(v, x, t, err) : 0;
}

static int evaluate(const void *ctx, const double *x, double t, double *out, error *err)
{
    const lua_value *v = ctx;

    if (v->whole)
        return call(v, v->ref[0], v->n, x, t, out, err);
    for (int k = 0; k < v->n; k++) {
        out[k] = v->constant[k];
        if (v->ref[k] != LUA_NOREF)
            TRY(call(v, v->ref[k], 1, x, t, &out[k], err));
    }
    return 0;
}

/* A component of the table on top of the stack that is a number but none that can be used; 0: none. */
static int bad_number(lua_State *l, int n)
{
    for (int k = 1; lua_istable(l, -1) && k <= n; k++) {
        int type = lua_rawgeti(l, -1, k), bad = type == LUA_TNUMBER && !isfinite(lua_tonumber(l, -1));

        lua_pop(l, 1);
        if (bad)
            return k;
    }
    return 0;
}

/* In which order the components of a tensor stand; of a vector nobody asks. */
static const char *order_of(int n, int dim)
{
    if (dim == 2)
        return n == 3 ? " {xx, xy, yy}" : n == 4 ? " {xx, xy, yx, yy}" : "";
    return n == 6 ? " {xx, xy, xz, yy, yz, zz}" : n == 9 ? " {xx, xy, xz, yx, yy, yz, zx, zy, zz}" : "";
}

static int expected(case_file *c, const case_block *b, const char *key, int n, int dim)
{
    lua_State *l = c->lua;
    int bad = bad_number(l, n);

    if (n == 1)
        case_wrong(c, b, key, "%s: \"%s\": expected a number or a function, got %s", b->kind, key,
                   lua_type(l, -1) == LUA_TNUMBER ? "a number that is not finite" : luaL_typename(l, -1));
    else if (bad)
        case_wrong(c, b, key, "%s: \"%s\": component %d is not a finite number", b->kind, key, bad);
    else
        case_wrong(c, b, key,
                   "%s: \"%s\": expected %d components%s in braces (numbers, functions or free) or a function that "
                   "returns %d "
                   "numbers, got %s%s",
                   b->kind, key, n, order_of(n, dim), n, luaL_typename(l, -1),
                   lua_istable(l, -1) && (int)lua_rawlen(l, -1) != n ? " of another length" : "");
    lua_pop(l, 1);
    return -1;
}

/* Notes what the function on top of the stack may depend on: one that takes x, y[, z] alone is steady. */
static void note_function(lua_State *l, int dim, value *out)
{
    lua_Debug ar;

    lua_pushvalue(l, -1);
    lua_getinfo(l, ">u", &ar);
    out->f = evaluate;
    out->of_time |= ar.isvararg || ar.nparams > dim;
}

/* One component from the top of the stack: number, function or free. */
static int component(lua_State *l, lua_value *v, value *out, int k)
{
    v->ref[k] = LUA_NOREF;
    if (lua_type(l, -1) == LUA_TNUMBER && isfinite(lua_tonumber(l, -1))) {
        out->constant[k] = v->constant[k] = lua_tonumber(l, -1);
        lua_pop(l, 1);
    } else if (lua_isfunction(l, -1)) {
        note_function(l, v->dim, out);
        v->ref[k] = luaL_ref(l, LUA_REGISTRYINDEX);
    } else if (lua_islightuserdata(l, -1)) {
        out->free[k] = 1;
        lua_pop(l, 1);
    } else {
        lua_pop(l, 1);
        return 0;
    }
    return 1;
}

/* The value on top of the stack, with nothing read of it; NULL: no memory, and it is popped. */
static lua_value *make(case_file *c, const case_block *b, const char *key, int n, int dim, value *out)
{
    lua_value *v = arena_alloc(&c->memory, 1, sizeof *v);
    const char *name = v ? arena_strdup(&c->memory, key) : NULL;

    if (!name) {
        c->no_memory = 1;
        lua_pop(c->lua, 1);
        return NULL;
    }
    *v = (lua_value){.c = c, .b = b, .key = name, .n = n, .dim = dim};
    *out = (value){.n = n, .ctx = v};
    return v;
}

int case_value(case_file *c, const case_block *b, const char *key, int n, int dim, value *out)
{
    lua_State *l = c->lua;
    lua_value *v = make(c, b, key, n, dim, out);

    if (!v)
        return -1;
    if (lua_isfunction(l, -1)) {
        v->whole = 1;
        note_function(l, dim, out);
        v->ref[0] = luaL_ref(l, LUA_REGISTRYINDEX);
        return 1;
    }
    if (n == 1) {
        lua_pushvalue(l, -1);
        if (!component(l, v, out, 0))
            return expected(c, b, key, n, dim);
        lua_pop(l, 1);
        return 1;
    }
    if (!lua_istable(l, -1) || (int)lua_rawlen(l, -1) != n)
        return expected(c, b, key, n, dim);
    for (int k = 0; k < n; k++) {
        lua_rawgeti(l, -1, k + 1);
        if (!component(l, v, out, k))
            return expected(c, b, key, n, dim);
    }
    lua_pop(l, 1);
    return 1;
}

int case_condition(case_file *c, const case_block *b, const char *key, int dim, value *out)
{
    lua_State *l = c->lua;
    lua_value *v;

    if (!lua_isfunction(l, -1)) {
        case_wrong(c, b, key,
                   "%s \"%s\": \"%s\": expected a function of place that says true or false, as in %s = "
                   "function(x, y%s) return x < 0.5 end, got %s",
                   b->kind, b->name ? b->name : "", key, key, dim == 3 ? ", z" : "", luaL_typename(l, -1));
        lua_pop(l, 1);
        return -1;
    }
    v = make(c, b, key, 1, dim, out);
    if (!v)
        return -1;
    v->whole = v->truth = 1;
    note_function(l, dim, out);
    v->ref[0] = luaL_ref(l, LUA_REGISTRYINDEX);
    return 1;
}
