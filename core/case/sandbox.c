/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Lua for case files: text only, an allow-list of functions, capped memory, a budget of
 * instructions, sorted pairs and seeded random numbers, so that a case means the same in every run. */
#include "base/random.h"
#include "case/case.h"

#include <lauxlib.h>
#include <lualib.h>

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LUA_BYTES = 1 << 30, HOOK_EVERY = 1000, BUDGET_THOUSANDS = 200000 };

static const char case_key = 'c';

static case_file *case_of(lua_State *l)
{
    case_file *c;

    lua_rawgetp(l, LUA_REGISTRYINDEX, &case_key);
    c = lua_touserdata(l, -1);
    lua_pop(l, 1);
    return c;
}

static void *allocate(void *ud, void *p, size_t old, size_t size)
{
    case_file *c = ud;

    if (!p)
        old = 0;
    if (size == 0) {
        free(p);
        c->lua_bytes -= old;
        return NULL;
    }
    if (size > old && c->lua_bytes + (size - old) > LUA_BYTES)
        return NULL;
    p = realloc(p, size);
    if (p)
        c->lua_bytes += size - old;
    return p;
}

static void budget_hook(lua_State *l, lua_Debug *ar)
{
    case_file *c = case_of(l);

    lua_getinfo(l, "Sl", ar);
    c->last_line = ar->currentline;
    if (--c->budget > 0)
        return;
    lua_sethook(l, budget_hook, LUA_MASKCOUNT, 1);
    luaL_error(l, "%s:%d: the case runs for too long (%d million steps); is there an endless loop?", ar->short_src,
               ar->currentline, BUDGET_THOUSANDS / 1000);
}

void case_allow(case_file *c)
{
    c->budget = BUDGET_THOUSANDS;
}

/* --- functions of cases --- */

static case_block *add_block(lua_State *l, const char *kind, const char *name)
{
    case_file *c = case_of(l);
    case_block *b = &c->block[c->n_block];
    lua_Debug ar;

    if (c->n_block == CASE_MAX_BLOCKS)
        luaL_error(l, "more than %d blocks in a case", CASE_MAX_BLOCKS);
    *b = (case_block){.kind = kind, .ref = LUA_NOREF, .file = c->path, .name = NULL};
    if (name && !(b->name = arena_strdup(&c->memory, name)))
        luaL_error(l, "out of memory");
    for (int level = 1; lua_getstack(l, level, &ar); level++) {
        lua_getinfo(l, "Sl", &ar);
        if (ar.currentline > 0 && ar.source[0] == '@') {
            b->line = ar.currentline;
            b->file = arena_strdup(&c->memory, ar.source + 1);
            break;
        }
    }
    c->n_block++;
    return b;
}

/* term "name" {...}: the second call gives the table. */
static int fill_block(lua_State *l)
{
    case_file *c = case_of(l);
    case_block *b = &c->block[lua_tointeger(l, lua_upvalueindex(1))];

    luaL_checktype(l, 1, LUA_TTABLE);
    lua_settop(l, 1);
    b->ref = luaL_ref(l, LUA_REGISTRYINDEX);
    return 0;
}

/* kind "name" {...}  or  kind {...}; upvalues: kind, 1 = takes a name, 2 = table only, 3 = function */
static int constructor(lua_State *l)
{
    const char *kind = lua_tostring(l, lua_upvalueindex(1));
    int form = (int)lua_tointeger(l, lua_upvalueindex(2));
    case_block *b;

    if (form == 1 && lua_type(l, 1) == LUA_TSTRING) {
        b = add_block(l, kind, lua_tostring(l, 1));
        lua_pushinteger(l, b - case_of(l)->block);
        lua_pushcclosure(l, fill_block, 1);
        return 1;
    }
    if (form == 3 ? !lua_isfunction(l, 1) : !lua_istable(l, 1))
        return luaL_error(l, "%s: expected %s, got %s", kind,
                          form == 3   ? "a function"
                          : form == 1 ? "a name in quotes or a table"
                                      : "a table in braces",
                          luaL_typename(l, 1));
    b = add_block(l, kind, NULL);
    lua_settop(l, 1);
    b->ref = luaL_ref(l, LUA_REGISTRYINDEX);
    return 0;
}

static int set_title(lua_State *l)
{
    case_file *c = case_of(l);

    c->title = arena_strdup(&c->memory, luaL_checkstring(l, 1));
    return 0;
}

static int add_param(lua_State *l)
{
    case_file *c = case_of(l);
    const char *name = luaL_checkstring(l, 1);
    case_param *p = &c->param[c->n_param];

    luaL_checkany(l, 2);
    if (c->n_param == CASE_MAX_SETS)
        return luaL_error(l, "more than %d parameters", CASE_MAX_SETS);
    for (int i = 0; i < c->n_param; i++)
        if (strcmp(c->param[i].name, name) == 0)
            return luaL_error(l, "param: \"%s\" is there already", name);
    c->n_param++;
    p->name = arena_strdup(&c->memory, name);
    p->doc = arena_strdup(&c->memory, luaL_optstring(l, 3, ""));
    snprintf(p->dflt, sizeof p->dflt, "%.60s", luaL_tolstring(l, 2, NULL));
    lua_pop(l, 1);
    lua_pushvalue(l, 2);
    for (int i = 0; i < c->n_set; i++)
        if (strcmp(c->set[i].name, name) == 0) {
            const char *v = c->set[i].value;

            c->set[i].used = 1;
            lua_pop(l, 1);
            if (lua_isboolean(l, 2) && (strcmp(v, "true") == 0 || strcmp(v, "false") == 0))
                lua_pushboolean(l, *v == 't');
            else if (lua_type(l, 2) == LUA_TNUMBER && lua_stringtonumber(l, v) == 0)
                return luaL_error(l, "--set %s=%s: expected a number", name, v);
            else if (lua_type(l, 2) == LUA_TSTRING)
                lua_pushstring(l, v);
            else if (lua_type(l, 2) != LUA_TNUMBER)
                return luaL_error(l, "--set %s=%s: expected a %s", name, v, luaL_typename(l, 2));
        }
    snprintf(p->value, sizeof p->value, "%.60s", luaL_tolstring(l, -1, NULL));
    lua_pop(l, 1);
    return 1;
}

static int include_file(lua_State *l)
{
    case_file *c = case_of(l);
    const char *name = luaL_checkstring(l, 1), *slash = strrchr(c->path, '/');
    char path[4096];
    error err = {0};

    snprintf(path, sizeof path, "%.*s%s", *name == '/' || !slash ? 0 : (int)(slash - c->path + 1), c->path, name);
    lua_settop(l, 0);
    if (sandbox_run(c, path, &err))
        return luaL_error(l, "%s", err.text);
    return lua_gettop(l);
}

static int print_line(lua_State *l)
{
    case_file *c = case_of(l);

    for (int i = 1, n = lua_gettop(l); i <= n; i++) {
        text_add(&c->printed, "%s%s", i > 1 ? "\t" : "", luaL_tolstring(l, i, NULL));
        lua_pop(l, 1);
    }
    text_add(&c->printed, "\n");
    return 0;
}

/* math.random as in Lua, but the same in every run. */
static int random_number(lua_State *l)
{
    case_file *c = case_of(l);
    double u;

    u = random_next(&c->random);
    if (lua_gettop(l) == 0) {
        lua_pushnumber(l, u);
    } else {
        lua_Integer low = lua_gettop(l) > 1 ? luaL_checkinteger(l, 1) : 1;
        lua_Integer high = luaL_checkinteger(l, lua_gettop(l) > 1 ? 2 : 1);

        luaL_argcheck(l, low <= high, 1, "interval is empty");
        lua_pushinteger(l, low + (lua_Integer)(u * (double)(high - low + 1)));
    }
    return 1;
}

static int seed_random(lua_State *l)
{
    case_of(l)->random = random_start((unsigned long long)luaL_checkinteger(l, 1));
    return 0;
}

static int undefined(lua_State *l)
{
    const char *name[256], *near;
    const char *wanted = lua_type(l, 2) == LUA_TSTRING ? lua_tostring(l, 2) : "?";
    size_t n = 0;

    lua_pushnil(l);
    while (lua_next(l, 1)) {
        lua_pop(l, 1);
        if (lua_type(l, -1) == LUA_TSTRING && n < 256)
            name[n++] = lua_tostring(l, -1);
    }
    near = text_nearest(wanted, name, n);
    return luaL_error(l, near ? "\"%s\" is not defined; did you mean \"%s\"?" : "\"%s\" is not defined", wanted,
                      near);
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

static void allow(lua_State *l)
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
    lua_getglobal(l, "math");
    lua_pushcfunction(l, random_number);
    lua_setfield(l, -2, "random");
    lua_pushcfunction(l, seed_random);
    lua_setfield(l, -2, "randomseed");
    lua_pop(l, 1);
    lua_pushcfunction(l, print_line);
    lua_setglobal(l, "print");
}

static void define(lua_State *l)
{
    static const struct {
        const char *kind;
        int form;
    } kinds[] = {{"mesh", 2},     {"fluid", 2},     {"term", 1},  {"boundary", 1}, {"initial", 2},
                 {"time", 2},     {"output", 2},    {"exact", 2}, {"solve", 2},    {"results", 3},
                 {"particle", 2}, {"particles", 2}, {"offset", 2}};

    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        lua_pushstring(l, kinds[i].kind);
        lua_pushinteger(l, kinds[i].form);
        lua_pushcclosure(l, constructor, 2);
        lua_setglobal(l, kinds[i].kind);
    }
    lua_pushcfunction(l, set_title);
    lua_setglobal(l, "case");
    lua_pushcfunction(l, add_param);
    lua_setglobal(l, "param");
    lua_pushcfunction(l, include_file);
    lua_setglobal(l, "include");
    lua_pushlightuserdata(l, (void *)&case_key);
    lua_setglobal(l, "free");
}

static int protect_globals(lua_State *l)
{
    lua_pushglobaltable(l);
    lua_newtable(l);
    lua_pushcfunction(l, undefined);
    lua_setfield(l, -2, "__index");
    lua_setmetatable(l, -2);
    return 0;
}

static int open_libraries(lua_State *l)
{
    allow(l);
    define(l);
    if (luaL_loadbufferx(l, case_prelude, strlen(case_prelude), "=prelude", "t") != LUA_OK)
        return lua_error(l);
    lua_call(l, 0, 0);
    return protect_globals(l);
}

int sandbox_open(case_file *c, error *err)
{
    c->lua = lua_newstate(allocate, c);
    if (!c->lua)
        return error_memory(err, "Lua", 0);
    c->budget = BUDGET_THOUSANDS;
    c->random = RANDOM_SEED;
    lua_pushlightuserdata(c->lua, c);
    lua_rawsetp(c->lua, LUA_REGISTRYINDEX, &case_key);
    lua_pushcfunction(c->lua, open_libraries);
    if (lua_pcall(c->lua, 0, 0, 0) != LUA_OK)
        return error_set(err, ERR_CASE, "Lua does not start: %s", lua_tostring(c->lua, -1));
    lua_sethook(c->lua, budget_hook, LUA_MASKCOUNT, HOOK_EVERY);
    return 0;
}

static char *read_source(case_file *c, const char *path, size_t *n, error *err)
{
    FILE *f = fopen(path, "rb");
    char *s = NULL;
    long size = -1;

    if (f && fseek(f, 0, SEEK_END) == 0)
        size = ftell(f);
    if (!f || size < 0 || size > 16 << 20) {
        error_set(err, f ? ERR_CASE : ERR_IO, "%s: %s", path,
                  !f ? strerror(errno) : "this is no case file (a folder, or larger than 16 MB)");
        if (f)
            fclose(f);
        return NULL;
    }
    rewind(f);
    s = arena_alloc(&c->memory, (size_t)size + 1, 1);
    *n = s ? fread(s, 1, (size_t)size, f) : 0;
    fclose(f);
    if (!s)
        error_memory(err, path, (double)size);
    return s;
}

int sandbox_run(case_file *c, const char *path, error *err)
{
    char chunk[4100];
    size_t n;
    char *s = read_source(c, path, &n, err);
    int base = lua_gettop(c->lua), status;

    if (!s)
        return err->code;
    if (c->n_source == CASE_MAX_SOURCES)
        return error_set(err, ERR_CASE, "%s: more than %d files in a case", path, CASE_MAX_SOURCES);
    c->source[c->n_source].file = arena_strdup(&c->memory, path);
    c->source[c->n_source++].text = s;
    snprintf(chunk, sizeof chunk, "@%s", path);
    status = luaL_loadbufferx(c->lua, s, n, chunk, "t");
    if (status == LUA_OK)
        status = lua_pcall(c->lua, 0, LUA_MULTRET, 0);
    if (status == LUA_ERRMEM)
        error_set(err, ERR_CASE, "%s: near line %d: the case needs more than %d MB", path, c->last_line,
                  LUA_BYTES >> 20);
    else if (status != LUA_OK)
        error_set(err, ERR_CASE, "%s",
                  lua_tostring(c->lua, -1) ? lua_tostring(c->lua, -1) : "error without a message");
    if (status != LUA_OK) {
        lua_settop(c->lua, base);
        return ERR_CASE;
    }
    return 0;
}
