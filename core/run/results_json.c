/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What the function in results(...) of a case returns, as JSON: all of it, or an error that names the value. */
#include "run/results.h"

#include <lauxlib.h>

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_DEPTH = 8, MOST_BYTES = 64 << 20, NAME_BYTES = 100 };

static int by_name(const void *a, const void *b)
{
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

const char **results_names(lua_State *l, int table, size_t *n)
{
    size_t room = 0;
    const char **name;

    *n = 0;
    lua_pushnil(l);
    while (lua_next(l, table)) {
        lua_pop(l, 1);
        room++;
    }
    name = lua_newuserdatauv(l, (room + 1) * sizeof *name, 0);
    lua_pushnil(l);
    while (lua_next(l, table)) {
        lua_pop(l, 1);
        if (lua_type(l, -1) == LUA_TSTRING)
            name[(*n)++] = lua_tostring(l, -1);
    }
    qsort(name, *n, sizeof *name, by_name);
    return name;
}

typedef struct writer {
    case_file *c;
    const case_block *block;
    text *json;
    char path[(MOST_DEPTH + 1) * (NAME_BYTES + 24)]; /* of the value: forces.drag[3] */
} writer;

static void put_value(lua_State *l, writer *w, int depth);

static void wrong(lua_State *l, const writer *w, const char *fmt, ...) __attribute__((format(printf, 3, 4)));
static void wrong(lua_State *l, const writer *w, const char *fmt, ...)
{
    char why[sizeof w->path + 300];
    va_list ap;

    va_start(ap, fmt);
    vsnprintf(why, sizeof why, fmt, ap);
    va_end(ap);
    lua_pushfstring(l, "%s:%d: results: %s", w->block->file, w->block->line, why);
    lua_error(l);
}

/* A value, named by its path, that cannot be a result. */
static void unfit(lua_State *l, const writer *w, const char *what)
{
    wrong(l, w,
          "\"%s\" is %s; expected a finite number, true or false, a string in UTF-8, or a list or a table of these",
          w->path, what);
}

/* The key on top of the stack is a name that JSON and a shell take without quotes. */
static void check_name(lua_State *l, const writer *w)
{
    static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.-";
    const char *s = lua_tostring(l, -1);
    size_t n = lua_rawlen(l, -1);
    char shown[41] = "";

    if (n > 0 && n <= NAME_BYTES && strspn(s, letters) == n)
        return;
    for (size_t i = 0; i < n && i + 1 < sizeof shown; i++)
        shown[i] = s[i] >= 0x20 && s[i] < 0x7f ? s[i] : '?';
    wrong(l, w, "the key \"%s\"%s%s%s is no plain name; expected letters, digits, _ . -, %d bytes at most", shown,
          *w->path ? " in \"" : "", w->path, *w->path ? "\"" : "", (int)NAME_BYTES);
}

/* How many entries the table on top has; *named: of these with a name, *last: the largest of the places 1, 2, ...
 */
static size_t count_entries(lua_State *l, const writer *w, size_t *named, lua_Integer *last)
{
    size_t n = 0, odd = 0;

    *named = 0;
    *last = 0;
    lua_pushnil(l);
    while (lua_next(l, -2)) {
        lua_pop(l, 1);
        n++;
        if (lua_type(l, -1) == LUA_TSTRING) {
            check_name(l, w);
            ++*named;
        } else if (lua_isinteger(l, -1) && lua_tointeger(l, -1) >= 1) {
            *last = lua_tointeger(l, -1) > *last ? lua_tointeger(l, -1) : *last;
        } else {
            odd++;
        }
    }
    if (odd)
        unfit(l, w, "a table with a key that is neither a name nor a place 1, 2, ...");
    return n;
}

/* The members of the table on top, without braces. */
static void put_members(lua_State *l, writer *w, int depth)
{
    size_t n, end = strlen(w->path);
    int table = lua_gettop(l);
    const char **name = results_names(l, table, &n);

    for (size_t i = 0; i < n; i++) {
        text_add(w->json, "%s", i ? ", " : "");
        text_json(w->json, name[i]);
        text_add(w->json, ": ");
        snprintf(w->path + end, sizeof w->path - end, "%s%s", end ? "." : "", name[i]);
        lua_pushstring(l, name[i]);
        lua_rawget(l, table);
        put_value(l, w, depth);
        lua_pop(l, 1);
        w->path[end] = 0;
    }
    lua_pop(l, 1);
}

static void put_table(lua_State *l, writer *w, int depth)
{
    size_t named, n, end = strlen(w->path);
    lua_Integer last;

    if (depth > MOST_DEPTH)
        wrong(l, w, "\"%s\" is a table in more than %d others; expected at most so many", w->path, (int)MOST_DEPTH);
    luaL_checkstack(l, 10, "results");
    n = count_entries(l, w, &named, &last);
    if (named > 0 && named < n)
        unfit(l, w, "a table that mixes names and places 1, 2, ...");
    if (named == 0 && last != (lua_Integer)n)
        unfit(l, w, "a list with holes");
    if (named > 0) {
        text_add(w->json, "{");
        put_members(l, w, depth);
        text_add(w->json, "}");
        return;
    }
    text_add(w->json, "[");
    for (lua_Integer i = 1; i <= last; i++) {
        text_add(w->json, "%s", i > 1 ? ", " : "");
        snprintf(w->path + end, sizeof w->path - end, "[%lld]", i);
        lua_rawgeti(l, -1, i);
        put_value(l, w, depth);
        lua_pop(l, 1);
        w->path[end] = 0;
    }
    text_add(w->json, "]");
}

static void put_string(lua_State *l, writer *w)
{
    size_t n, size;
    const char *s = lua_tolstring(l, -1, &n);

    for (size_t i = 0; i < n; i += size)
        if ((size = text_utf8(s + i, n - i)) == 0)
            unfit(l, w, "a string that is not UTF-8");
    text_json_bytes(w->json, s, n);
}

/* The value on top of the stack. */
static void put_value(lua_State *l, writer *w, int depth)
{
    char what[60];

    switch (lua_type(l, -1)) {
    case LUA_TNUMBER:
        if (!isfinite(lua_tonumber(l, -1))) {
            snprintf(what, sizeof what, "%s", isnan(lua_tonumber(l, -1)) ? "no number (nan)" : "infinite");
            unfit(l, w, what);
        } else if (lua_isinteger(l, -1)) {
            text_add(w->json, LUA_INTEGER_FMT, lua_tointeger(l, -1));
        } else {
            text_number(w->json, lua_tonumber(l, -1));
        }
        break;
    case LUA_TBOOLEAN:
        text_add(w->json, lua_toboolean(l, -1) ? "true" : "false");
        break;
    case LUA_TSTRING:
        put_string(l, w);
        break;
    case LUA_TTABLE:
        put_table(l, w, depth + 1);
        break;
    default:
        snprintf(what, sizeof what, "a %s", luaL_typename(l, -1));
        unfit(l, w, what);
    }
    if (w->json->n > MOST_BYTES)
        wrong(l, w, "more than %d MB of text with \"%s\"; return less", MOST_BYTES >> 20, w->path);
    if (w->json->failed) {
        w->c->code = ERR_MEMORY;
        wrong(l, w, "out of memory: the text of the results needs more than %.3g MB", (double)w->json->n / 1e6);
    }
}

void results_put(lua_State *l, case_file *c, text *json)
{
    writer w = {.c = c, .block = case_find(c, "results", 0), .json = json};
    lua_Integer last;
    size_t named;

    if (!lua_istable(l, -1))
        wrong(l, &w, "the function must return a table, as in { cd = 1.5 }, got %s", luaL_typename(l, -1));
    if (count_entries(l, &w, &named, &last) != named)
        wrong(l, &w, "a value without a name; expected name = value for each");
    put_members(l, &w, 0);
}
