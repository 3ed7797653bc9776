/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * results(function(r) ... return { cd = ... } end) of a case: derived numbers for the summary.
 *
 *     r.t                    times of the rows of forces.csv and probes.csv
 *     r.series["wall.fx"]    a column of those, as a list;  r.last["wall.fx"] its last value
 *     r.last["p0.fx"]        columns of particles.csv, by number of the body
 *     r.mean.u[1]            mean of a field's component over the domain
 *     r.errors.u             { l2, h1, l2_exact } of fields with an exact solution             */
#include "run/run.h"

#include <lauxlib.h>
#include <lua.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void push_table(lua_State *l, const table *t, int series, int last)
{
    for (int c = 1; c < t->n_column; c++) {
        lua_createtable(l, (int)t->n_row, 0);
        for (long i = 0; i < t->n_row; i++) {
            lua_pushnumber(l, t->row[i * t->n_column + c]);
            lua_rawseti(l, -2, (int)i + 1);
        }
        lua_setfield(l, series, t->column[c]);
        if (t->n_row) {
            lua_pushnumber(l, t->row[(t->n_row - 1) * t->n_column + c]);
            lua_setfield(l, last, t->column[c]);
        }
    }
}

/* Columns of particles.csv as p<id>.<name>: "p0.fx". */
static void push_particles(lua_State *l, const table *t, int series, int last)
{
    int n = 0;

    while (n < t->n_row && (int)t->row[n * t->n_column + 1] == n)
        n++;
    for (int id = 0; id < n; id++)
        for (int c = 2; c < t->n_column; c++) {
            char name[120];

            snprintf(name, sizeof name, "p%d.%.100s", id, t->column[c]);
            lua_newtable(l);
            for (long i = id, k = 1; i < t->n_row; i += n, k++) {
                lua_pushnumber(l, t->row[i * t->n_column + c]);
                lua_rawseti(l, -2, k);
            }
            lua_setfield(l, series, name);
            lua_pushnumber(l, t->row[(t->n_row - n + id) * t->n_column + c]);
            lua_setfield(l, last, name);
        }
}

/* A column that is not there: an error that lists those that are. */
static int no_column(lua_State *l)
{
    text t = {0};

    lua_pushnil(l);
    while (lua_next(l, 1)) {
        lua_pop(l, 1);
        text_add(&t, "%s%s", t.n ? ", " : "", lua_tostring(l, -1));
    }
    lua_pushfstring(l, "results: there is no column \"%s\"; there are: %s", luaL_tolstring(l, 2, NULL),
                    t.s ? t.s : "none");
    text_free(&t);
    luaL_where(l, 1);
    lua_insert(l, -2);
    lua_concat(l, 2);
    return lua_error(l);
}

static void guard_columns(lua_State *l)
{
    lua_newtable(l);
    lua_pushcfunction(l, no_column);
    lua_setfield(l, -2, "__index");
    lua_setmetatable(l, -2);
}

static void push_errors(lua_State *l, const run_result *q)
{
    lua_newtable(l);
    for (int i = 0; i < q->n_error; i++) {
        lua_newtable(l);
        lua_pushnumber(l, q->error_norm[i].l2);
        lua_setfield(l, -2, "l2");
        lua_pushnumber(l, q->error_norm[i].h1);
        lua_setfield(l, -2, "h1");
        lua_pushnumber(l, q->error_norm[i].l2_exact);
        lua_setfield(l, -2, "l2_exact");
        lua_setfield(l, -2, q->error_norm[i].name);
    }
}

/* Means of the fields on the mesh over the whole domain, as lists of components. */
static void push_means(lua_State *l, const run *r)
{
    const problem *p = r->p;
    error err;

    lua_newtable(l);
    for (int f = 0; f < p->space.n_field; f++) {
        double mean[VALUE_MAX];

        if (p->space.field[f].support != PF_ON_MESH)
            continue;
        if (norms_mean(r, f, mean, &err))
            luaL_error(l, "%s", err.text);
        lua_newtable(l);
        for (int c = 0; c < p->space.field[f].n_comp; c++) {
            lua_pushnumber(l, mean[c]);
            lua_rawseti(l, -2, c + 1);
        }
        lua_setfield(l, -2, p->space.field[f].name);
    }
}

static void push_argument(lua_State *l, const run *r)
{
    const table *any = r->forces.n_column ? &r->forces : r->probes.n_column ? &r->probes : &r->particles;
    long every = any == &r->particles && r->p->bodies.n ? r->p->bodies.n : 1;

    lua_newtable(l);
    lua_newtable(l);
    for (long i = 0; i < any->n_row / every; i++) {
        lua_pushnumber(l, any->row[i * every * any->n_column]);
        lua_rawseti(l, -2, (int)i + 1);
    }
    lua_setfield(l, -2, "t");
    lua_newtable(l);
    lua_newtable(l);
    push_table(l, &r->forces, lua_gettop(l) - 1, lua_gettop(l));
    push_table(l, &r->probes, lua_gettop(l) - 1, lua_gettop(l));
    push_particles(l, &r->particles, lua_gettop(l) - 1, lua_gettop(l));
    guard_columns(l);
    lua_setfield(l, -3, "last");
    guard_columns(l);
    lua_setfield(l, -2, "series");
    push_means(l, r);
    lua_setfield(l, -2, "mean");
    push_errors(l, r->result);
    lua_setfield(l, -2, "errors");
    lua_pushnumber(l, r->p->description.time.step);
    lua_setfield(l, -2, "dt");
}

/* Protected: all of it allocates. */
static int push_and_call(lua_State *l)
{
    const run *r = lua_touserdata(l, 1);

    lua_rawgeti(l, LUA_REGISTRYINDEX, case_find(r->p->description.c, "results", 0)->ref);
    push_argument(l, r);
    lua_call(l, 1, 1);
    return 1;
}

static int by_key(const void *a, const void *b)
{
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

int results_evaluate(run *r, error *err)
{
    const case_block *b = case_find(r->p->description.c, "results", 0);
    lua_State *l = r->p->description.c->lua;
    const char *key[256];
    int n = 0;

    if (!b)
        return 0;
    lua_settop(l, 0);
    lua_pushcfunction(l, push_and_call);
    lua_pushlightuserdata(l, r);
    case_allow(r->p->description.c);
    if (lua_pcall(l, 1, 1, 0) != LUA_OK)
        return error_set(err, ERR_CASE, "%s", lua_tostring(l, -1) ? lua_tostring(l, -1) : "results: error");
    if (!lua_istable(l, -1))
        return error_set(err, ERR_CASE, "%s:%d: results: the function must return a table of numbers, got %s",
                         b->file, b->line, luaL_typename(l, -1));
    lua_pushnil(l);
    while (lua_next(l, 1) && n < 256) {
        if (lua_type(l, -2) == LUA_TSTRING && lua_type(l, -1) == LUA_TNUMBER)
            key[n++] = lua_tostring(l, -2);
        lua_pop(l, 1);
    }
    qsort(key, (size_t)n, sizeof *key, by_key);
    for (int i = 0; i < n; i++) {
        lua_getfield(l, 1, key[i]);
        text_add(&r->results, "%s", i ? ", " : "");
        text_json(&r->results, key[i]);
        text_add(&r->results, ": ");
        text_number(&r->results, lua_tonumber(l, -1));
        lua_pop(l, 1);
    }
    lua_settop(l, 0);
    return 0;
}
