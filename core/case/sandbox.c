/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Lua for case files, put together: the limits, what is left of the library, the lines of cases, the prelude. */
#include "case/sandbox.h"

#include <lauxlib.h>

#include <string.h>

/* fail(text), for the prelude: an error in the line of the case that is being run. */
static int fail(lua_State *l)
{
    return limits_raise(l, "%s", luaL_checkstring(l, 1));
}

/* hint(name, list), for the prelude: "; did you mean ...?" or "". */
static int hint(lua_State *l)
{
    const char *candidate[32], *name = luaL_checkstring(l, 1);
    size_t n = 0;

    luaL_checktype(l, 2, LUA_TTABLE);
    while (n < sizeof candidate / sizeof *candidate && lua_rawgeti(l, 2, (lua_Integer)n + 1) == LUA_TSTRING) {
        candidate[n++] = lua_tostring(l, -1); /* the list keeps it */
        lua_pop(l, 1);
    }
    lua_pushstring(l, text_hint(text_nearest(name, candidate, n)).s);
    return 1;
}

static const char *next_line(lua_State *l, void *line_, size_t *n)
{
    const char *const **line = line_;

    (void)l;
    *n = **line ? strlen(**line) : 0;
    return *n ? *(*line)++ : NULL;
}

static int open_all(lua_State *l)
{
    const char *const *line = sandbox_prelude;

    library_open(l);
    declare_open(l);
    if (lua_load(l, next_line, &line, "=prelude.lua", "t") != LUA_OK)
        return lua_error(l);
    lua_pushcfunction(l, fail);
    lua_pushcfunction(l, hint);
    lua_call(l, 2, 0);
    library_close(l);
    return 0;
}

int sandbox_open(case_file *c, error *err)
{
    TRY(limits_open(c, err));
    lua_pushcfunction(c->lua, open_all);
    if (case_call(c, "prelude", 0, 0, err))
        return error_prefix(err, "Lua does not start: ");
    return 0;
}
