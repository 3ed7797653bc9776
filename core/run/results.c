/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The function in results(...) of a case: its argument as tables of Lua, and the call.  All that touches Lua runs
 * within one protected call. */
#include "run/results.h"

#include <lauxlib.h>

enum { MOST_LISTED = 100 };

static const char asked_wrongly = 'a'; /* its address: key in Lua's registry, true after a name that is not there */

/* --- the argument --- */

/* A name that is not there: an error in the case's line that lists those that are.  Upvalue: how it begins. */
static int no_such_name(lua_State *l)
{
    const char *begin = lua_tostring(l, lua_upvalueindex(1)), *wanted = luaL_tolstring(l, 2, NULL), **name;
    luaL_Buffer list;
    hint_text hint;
    size_t n;

    lua_pushboolean(l, 1);
    lua_rawsetp(l, LUA_REGISTRYINDEX, &asked_wrongly);
    name = results_names(l, 1, &n);
    hint = text_hint(text_nearest(wanted, name, n));
    luaL_buffinit(l, &list);
    for (size_t i = 0; i < n && i < MOST_LISTED; i++) {
        luaL_addstring(&list, i ? ", " : "");
        luaL_addstring(&list, name[i]);
    }
    if (n > MOST_LISTED)
        luaL_addstring(&list, ", ...");
    luaL_pushresult(&list);
    return luaL_error(l, "results: %s \"%s\"%s there are: %s", begin, wanted, *hint.s ? hint.s : ";",
                      n ? lua_tostring(l, -1) : "none");
}

/* Lets the table on top complain about names that it has not. */
static void guard(lua_State *l, const char *begin)
{
    lua_createtable(l, 0, 1);
    lua_pushstring(l, begin);
    lua_pushcclosure(l, no_such_name, 1);
    lua_setfield(l, -2, "__index");
    lua_setmetatable(l, -2);
}

static void push_list(lua_State *l, const results_column *column)
{
    lua_createtable(l, (int)column->n, 0);
    for (long i = 0; i < column->n; i++) {
        lua_pushnumber(l, column->first[i * column->stride]);
        lua_rawseti(l, -2, i + 1);
    }
}

static void push_columns(lua_State *l, const results_input *in)
{
    lua_createtable(l, 0, in->n_column); /* series */
    lua_createtable(l, 0, in->n_column); /* last   */
    for (int k = 0; k < in->n_column; k++) {
        const results_column *column = &in->column[k];

        push_list(l, column);
        lua_setfield(l, -3, column->name);
        if (column->n) {
            lua_pushnumber(l, column->first[(column->n - 1) * column->stride]);
            lua_setfield(l, -2, column->name);
        }
    }
    guard(l, "there is no column");
    lua_setfield(l, -3, "last");
    guard(l, "there is no column");
    lua_setfield(l, -2, "series");
}

static void push_means(lua_State *l, const results_input *in)
{
    lua_newtable(l);
    for (int k = 0; k < in->n_mean; k++) {
        lua_newtable(l);
        for (int i = 0; i < in->mean[k].n_comp; i++) {
            lua_pushnumber(l, in->mean[k].mean[i]);
            lua_rawseti(l, -2, i + 1);
        }
        guard(l, "r.mean has a list of components, without");
        lua_setfield(l, -2, in->mean[k].name);
    }
    guard(l, "r.mean has no field");
}

static void push_norms(lua_State *l, const results_input *in)
{
    lua_newtable(l);
    for (int k = 0; k < in->n_norm; k++) {
        lua_newtable(l);
        lua_pushnumber(l, in->norm[k].l2);
        lua_setfield(l, -2, "l2");
        lua_pushnumber(l, in->norm[k].h1);
        lua_setfield(l, -2, "h1");
        lua_pushnumber(l, in->norm[k].l2_exact);
        lua_setfield(l, -2, "l2_exact");
        guard(l, "r.errors has no norm");
        lua_setfield(l, -2, in->norm[k].name);
    }
    guard(l, "r.errors has no field with an exact solution called");
}

static void push_input(lua_State *l, const results_input *in)
{
    lua_newtable(l);
    push_list(l, &in->t);
    lua_setfield(l, -2, "t");
    push_columns(l, in);
    push_means(l, in);
    lua_setfield(l, -2, "mean");
    push_norms(l, in);
    lua_setfield(l, -2, "errors");
    lua_pushnumber(l, in->dt);
    lua_setfield(l, -2, "dt");
    guard(l, "r has no part called");
}

/* --- the call --- */

typedef struct call {
    case_file *c;
    const results_input *in;
    text *json; /* NULL: what the function returns does not matter */
} call;

static int call_function(lua_State *l)
{
    const call *k = lua_touserdata(l, 1);

    lua_pushboolean(l, 0);
    lua_rawsetp(l, LUA_REGISTRYINDEX, &asked_wrongly);
    lua_rawgeti(l, LUA_REGISTRYINDEX, case_find(k->c, "results", 0)->ref);
    push_input(l, k->in);
    lua_call(l, 1, 1);
    if (k->json) {
        results_put(l, k->c, k->json);
    } else if (!lua_istable(l, -1) && !lua_isnil(l, -1)) { /* whatever the numbers are: no table of results */
        text none = {0};

        lua_pushboolean(l, 1);
        lua_rawsetp(l, LUA_REGISTRYINDEX, &asked_wrongly);
        results_put(l, k->c, &none);
    }
    return 0;
}

static int call_protected(case_file *c, const results_input *in, text *json, error *err)
{
    call k = {c, in, json};

    lua_pushcfunction(c->lua, call_function);
    lua_pushlightuserdata(c->lua, &k);
    return case_call(c, "results", 1, 0, err);
}

int results_call(case_file *c, const results_input *in, text *json, error *err)
{
    size_t before = json->n;
    int status;

    if (!case_find(c, "results", 0))
        return 0;
    status = call_protected(c, in, json, err);
    if (status && json->s) {
        json->n = before;
        json->s[before] = 0;
    }
    return status;
}

/* The call with ones; what of it stays is undone. */
static int call_with_ones(case_file *c, const results_input *ones, error *err)
{
    unsigned long long random = c->random;
    size_t printed = c->printed.n, bytes = c->printed_bytes;
    error wrong_here;
    int status = call_protected(c, ones, NULL, &wrong_here), named;

    c->random = random;
    c->printed_bytes = bytes;
    c->printed.n = printed;
    if (c->printed.s)
        c->printed.s[printed] = 0;
    lua_rawgetp(c->lua, LUA_REGISTRYINDEX, &asked_wrongly);
    named = lua_toboolean(c->lua, -1);
    lua_pop(c->lua, 1);
    lua_gc(c->lua, LUA_GCCOLLECT);
    if (status > ERR_SIGNAL || (status && named))
        return error_set(err, status, "%s", wrong_here.text);
    return 0;
}

int results_check(case_file *c, const results_input *in, error *err)
{
    static const double one[] = {1, 1, 1};
    const results_column ones = {.first = one, .stride = 1, .n = sizeof one / sizeof *one};
    results_input dry = *in;
    arena memory = {0};
    int status = 0;

    if (!case_find(c, "results", 0))
        return 0;
    dry.t = ones;
    dry.dt = 1;
    dry.column = arena_alloc(&memory, (size_t)in->n_column + 1, sizeof *dry.column);
    dry.mean = arena_alloc(&memory, (size_t)in->n_mean + 1, sizeof *dry.mean);
    dry.norm = arena_alloc(&memory, (size_t)in->n_norm + 1, sizeof *dry.norm);
    if (!dry.column || !dry.mean || !dry.norm)
        status = error_memory(err, "results", 0);
    for (int k = 0; !status && k < in->n_column; k++) {
        dry.column[k] = ones;
        dry.column[k].name = in->column[k].name;
    }
    for (int k = 0; !status && k < in->n_mean; k++)
        dry.mean[k] = (results_mean){
            .name = in->mean[k].name, .n_comp = in->mean[k].n_comp, .mean = {1, 1, 1, 1, 1, 1, 1, 1, 1}};
    for (int k = 0; !status && k < in->n_norm; k++)
        dry.norm[k] = (results_norm){.name = in->norm[k].name, .l2 = 1, .h1 = 1, .l2_exact = 1};
    if (!status)
        status = call_with_ones(c, &dry, err);
    arena_free(&memory);
    return status;
}
