/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What is left of Lua's library: an allow-list, with print, random numbers and undefined names of our own, so
 * that a case has no way out and means the same in every run. */
#include "base/random.h"
#include "case/sandbox.h"

#include <lauxlib.h>
#include <lualib.h>

#include <string.h>

enum { MOST_PRINTED = 1000000 }; /* bytes */

/* Text goes up to MOST_PRINTED; then one line says that the rest is left out. */
static int print_line(lua_State *l)
{
    case_file *c = limits_case(l);

    if (c->printed_bytes > MOST_PRINTED)
        return 0;
    for (int i = 1, n = lua_gettop(l); i <= n; i++) {
        size_t size;
        const char *s = luaL_tolstring(l, i, &size);

        c->printed_bytes += size + 1;
        if (c->printed_bytes > MOST_PRINTED) {
            text_add(&c->printed, "%sprint: more than %d MB of text; the rest is left out\n", i > 1 ? "\n" : "",
                     MOST_PRINTED / 1000000);
            return 0;
        }
        text_add(&c->printed, "%s%s", i > 1 ? "\t" : "", s);
        lua_pop(l, 1);
    }
    text_add(&c->printed, "\n");
    return 0;
}

/* A whole number in [0, most], each as likely as the others. */
static unsigned long long random_below(case_file *c, unsigned long long most)
{
    unsigned long long mask = most, r;

    if (most < 1ULL << 53) /* u in [0, 1) has 53 bits */
        return (unsigned long long)(random_next(&c->random) * (double)(most + 1));
    for (int shift = 1; shift < 64; shift *= 2)
        mask |= mask >> shift;
    do
        r = random_bits(&c->random) & mask;
    while (r > most);
    return r;
}

static int random_number(lua_State *l)
{
    case_file *c = limits_case(l);
    int n = lua_gettop(l);

    if (n == 0) {
        lua_pushnumber(l, random_next(&c->random));
    } else {
        lua_Integer low = n > 1 ? luaL_checkinteger(l, 1) : 1, high = luaL_checkinteger(l, n > 1 ? 2 : 1);

        luaL_argcheck(l, low <= high, n > 1 ? 2 : 1, "interval is empty");
        lua_pushinteger(l,
                        (lua_Integer)((lua_Unsigned)low + random_below(c, (lua_Unsigned)high - (lua_Unsigned)low)));
    }
    return 1;
}

static int seed_random(lua_State *l)
{
    limits_case(l)->random = random_start((unsigned long long)luaL_checkinteger(l, 1));
    return 0;
}

/* A global that is not there.  The kernel, too, may come here, with the table of globals given as a block's value:
 * to it the name is just absent. */
static int undefined(lua_State *l)
{
    const char *name[256], *wanted = lua_type(l, 2) == LUA_TSTRING ? lua_tostring(l, 2) : "?";
    size_t n = 0;
    lua_Debug ar;

    if (!limits_line(l, &ar, NULL))
        return 0;
    lua_pushnil(l);
    while (lua_next(l, 1)) {
        lua_pop(l, 1);
        if (lua_type(l, -1) == LUA_TSTRING && n < sizeof name / sizeof *name)
            name[n++] = lua_tostring(l, -1);
    }
    return limits_raise(l, "\"%.200s\" is not defined%s", wanted, text_hint(text_nearest(wanted, name, n)).s);
}

static void keep_only(lua_State *l, const char *library, const char *const *keep)
{
    lua_newtable(l);
    for (int i = 0; keep[i]; i++) {
        lua_getglobal(l, library);
        lua_getfield(l, -1, keep[i]);
        lua_setfield(l, -3, keep[i]);
        lua_pop(l, 1);
    }
    lua_setglobal(l, library);
}

void library_open(lua_State *l)
{
    static const char *const math_keep[] = {"abs", "acos",       "asin", "atan", "ceil", "cos", "deg",
                                            "exp", "floor",      "fmod", "huge", "log",  "max", "maxinteger",
                                            "min", "mininteger", "modf", "pi",   "rad",  "sin", "sqrt",
                                            "tan", "tointeger",  "type", "ult",  NULL};
    static const char *const string_keep[] = {"format", "sub", "len", "upper", "lower", "byte", "char", NULL};
    static const char *const table_keep[] = {"insert", "remove", "concat", "unpack", "sort", NULL};
    static const char *const drop[] = {
        "load",         "loadfile", "dofile", "require",  "collectgarbage", "pcall", "xpcall", "getmetatable",
        "setmetatable", "rawset",   "rawget", "rawequal", "rawlen",         "warn",  "_G",     NULL};

    luaL_requiref(l, "_G", luaopen_base, 1);
    luaL_requiref(l, "math", luaopen_math, 1);
    luaL_requiref(l, "string", luaopen_string, 1);
    luaL_requiref(l, "table", luaopen_table, 1);
    lua_pop(l, 4);
    keep_only(l, "math", math_keep);
    keep_only(l, "string", string_keep);
    keep_only(l, "table", table_keep);
    /* methods of strings: the same few functions */
    lua_pushliteral(l, "");
    lua_getmetatable(l, -1);
    lua_getglobal(l, "string");
    lua_setfield(l, -2, "__index");
    lua_pop(l, 2);
    for (int i = 0; drop[i]; i++) {
        lua_pushnil(l);
        lua_setglobal(l, drop[i]);
    }
    limits_case(l)->random = RANDOM_SEED;
    lua_getglobal(l, "math");
    lua_pushcfunction(l, random_number);
    lua_setfield(l, -2, "random");
    lua_pushcfunction(l, seed_random);
    lua_setfield(l, -2, "randomseed");
    lua_pop(l, 1);
    lua_pushcfunction(l, print_line);
    lua_setglobal(l, "print");
}

void library_close(lua_State *l)
{
    lua_pushglobaltable(l);
    lua_newtable(l);
    lua_pushcfunction(l, undefined);
    lua_setfield(l, -2, "__index");
    lua_setmetatable(l, -2);
    lua_pop(l, 1);
}
