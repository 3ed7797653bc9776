/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The lines of a case: case "title", param(...), include "file", and those that leave a block (mesh {...},
 * term "..." {...}).  All text that a case leaves here is limited, since it lies outside of Lua's memory. */
#include "case/sandbox.h"

#include <lauxlib.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

enum form {
    TABLE,    /* mesh {...}                              */
    NAMED,    /* term "name" {...}, or boundary {...}    */
    FUNCTION, /* results(function)                       */
};

static const struct {
    const char *kind;
    enum form form;
} kinds[] = {{"mesh", TABLE},    {"fluid", TABLE},      {"term", NAMED},     {"boundary", NAMED},
             {"initial", TABLE}, {"time", TABLE},       {"output", TABLE},   {"exact", TABLE},
             {"solve", TABLE},   {"results", FUNCTION}, {"particle", TABLE}, {"particles", TABLE},
             {"offset", TABLE}};

enum { NAME_BYTES = 200, DOC_BYTES = 1000 };

/* The argument (part: what it is to the line) as text for names and messages: UTF-8 of at most so many bytes, no
 * control characters. */
static const char *plain_text(lua_State *l, int arg, const char *line, const char *part, size_t most)
{
    size_t n, size;
    const char *s = lua_tolstring(l, arg, &n);

    if (!s)
        limits_raise(l, "%s: the %s must be a string, got %s", line, part, luaL_typename(l, arg));
    if (n > most)
        limits_raise(l, "%s: the %s has %zu bytes; at most %zu are possible", line, part, n, most);
    for (size_t i = 0; i < n; i += size) {
        size = text_utf8(s + i, n - i);
        if (size == 0)
            limits_raise(l, "%s: byte %zu of the %s is not UTF-8; save the file in UTF-8", line, i + 1, part);
        if ((unsigned char)s[i] < 0x20 || s[i] == 0x7f)
            limits_raise(l, "%s: byte %zu of the %s is a control character (code %d); leave it out", line, i + 1,
                         part, s[i]);
    }
    return s;
}

static const char *keep(lua_State *l, const char *s)
{
    case_file *c = limits_case(l);

    s = arena_strdup(&c->memory, s);
    if (!s) {
        c->code = ERR_MEMORY;
        limits_raise(l, "out of memory");
    }
    return s;
}

static case_block *add_block(lua_State *l, const char *kind, const char *name)
{
    case_file *c = limits_case(l);
    case_block *b = &c->block[c->n_block];
    lua_Debug ar;

    if (c->n_block == CASE_MAX_BLOCKS)
        limits_raise(l, "more than %d blocks in a case", CASE_MAX_BLOCKS);
    *b = (case_block){.kind = kind, .ref = LUA_NOREF, .file = c->path};
    b->name = name ? keep(l, name) : NULL;
    if (limits_line(l, &ar, &b->by_prelude)) {
        b->line = ar.currentline;
        b->file = c->source[source_find(c, ar.source + 1)].file;
    }
    c->n_block++;
    return b;
}

/* term "name" {...}: the second call gives the table. */
static int fill_block(lua_State *l)
{
    case_block *b = &limits_case(l)->block[lua_tointeger(l, lua_upvalueindex(1))];

    if (!lua_istable(l, 1))
        return limits_raise(l, "%s \"%s\": expected a table in braces, got %s", b->kind, b->name,
                            luaL_typename(l, 1));
    if (b->ref != LUA_NOREF)
        return limits_raise(l, "%s \"%s\": has its table already, from line %d", b->kind, b->name, b->line);
    lua_settop(l, 1);
    b->ref = luaL_ref(l, LUA_REGISTRYINDEX);
    return 0;
}

/* kind "name" {...}  or  kind {...}; upvalue: the kind's place in the list. */
static int constructor(lua_State *l)
{
    static const char *const expected[] = {
        [TABLE] = "a table in braces", [NAMED] = "a name in quotes or a table", [FUNCTION] = "a function"};
    lua_Integer k = lua_tointeger(l, lua_upvalueindex(1));
    const char *kind = kinds[k].kind;
    case_block *b;

    if (kinds[k].form == NAMED && lua_type(l, 1) == LUA_TSTRING) {
        b = add_block(l, kind, plain_text(l, 1, kind, "name", NAME_BYTES));
        lua_pushinteger(l, b - limits_case(l)->block);
        lua_pushcclosure(l, fill_block, 1);
        return 1;
    }
    if (kinds[k].form == FUNCTION ? !lua_isfunction(l, 1) : !lua_istable(l, 1))
        return limits_raise(l, "%s: expected %s, got %s", kind, expected[kinds[k].form], luaL_typename(l, 1));
    b = add_block(l, kind, NULL);
    lua_settop(l, 1);
    b->ref = luaL_ref(l, LUA_REGISTRYINDEX);
    return 0;
}

static int set_title(lua_State *l)
{
    if (limits_case(l)->title)
        return limits_raise(l, "case: the case has a title already, \"%.80s\"", limits_case(l)->title);
    limits_case(l)->title = keep(l, plain_text(l, 1, "case", "title", NAME_BYTES));
    return 0;
}

/* Pushes the value that --set gives to a parameter whose default is argument 2 of param. */
static void push_set(lua_State *l, const case_set *s)
{
    int type = lua_type(l, 2);

    if (type == LUA_TBOOLEAN && (strcmp(s->value, "true") == 0 || strcmp(s->value, "false") == 0))
        lua_pushboolean(l, *s->value == 't');
    else if (type == LUA_TSTRING)
        lua_pushstring(l, s->value);
    else if (type != LUA_TNUMBER || lua_stringtonumber(l, s->value) == 0 || !isfinite(lua_tonumber(l, -1)))
        limits_raise(l, "--set %s=%.200s: expected %s, found \"%.200s\"; the default is %.60s", s->name, s->value,
                     type == LUA_TBOOLEAN  ? "true or false"
                     : type == LUA_TNUMBER ? "a number"
                                           : luaL_typename(l, 2),
                     s->value, luaL_tolstring(l, 2, NULL));
}

static int add_param(lua_State *l)
{
    case_file *c = limits_case(l);
    const char *name = plain_text(l, 1, "param", "name", NAME_BYTES);
    const int type = lua_type(l, 2);
    const char *doc = lua_isnoneornil(l, 3) ? "" : plain_text(l, 3, "param", "description", DOC_BYTES);
    case_param *p = &c->param[c->n_param];

    if (lua_isnone(l, 2))
        return limits_raise(l, "param: \"%s\" needs a default value", name);
    if (!*name || (type != LUA_TNUMBER && type != LUA_TSTRING && type != LUA_TBOOLEAN) ||
        (type == LUA_TNUMBER && !isfinite(lua_tonumber(l, 2))))
        return limits_raise(
            l,
            "param: \"%s\" has %s as its default; expected a name, and a finite number, a string, true "
            "or false",
            name, luaL_tolstring(l, 2, NULL));
    if (c->n_param == CASE_MAX_SETS)
        return limits_raise(l, "more than %d parameters", CASE_MAX_SETS);
    for (int i = 0; i < c->n_param; i++)
        if (strcmp(c->param[i].name, name) == 0)
            return limits_raise(l, "param: \"%s\" is there already", name);
    *p = (case_param){.name = keep(l, name), .doc = keep(l, doc)};
    c->n_param++;
    snprintf(p->dflt, sizeof p->dflt, "%.60s", luaL_tolstring(l, 2, NULL));
    lua_pushvalue(l, 2);
    for (int i = 0; i < c->n_set; i++)
        if (strcmp(c->set[i].name, name) == 0) {
            c->set[i].used = 1;
            lua_pop(l, 1);
            push_set(l, &c->set[i]);
        }
    snprintf(p->value, sizeof p->value, "%.60s", luaL_tolstring(l, -1, NULL));
    lua_pop(l, 1);
    return 1;
}

/* A part ".." of the path leads out of a folder. */
static int leads_out(const char *path)
{
    for (const char *s = path; *s; s += strcspn(s, "/"), s += *s == '/')
        if (strncmp(s, "..", 2) == 0 && (s[2] == '/' || s[2] == 0))
            return 1;
    return 0;
}

static int include_file(lua_State *l)
{
    case_file *c = limits_case(l);
    const char *name = plain_text(l, 1, "include", "path", DOC_BYTES), *slash = strrchr(c->path, '/');
    char path[4096];
    error err;

    if (*name == '/' || leads_out(name))
        return limits_raise(l,
                            "include: \"%s\" is outside of the case's folder; expected a path below it, as in "
                            "\"common.lua\" or \"parts/walls.lua\"",
                            name);
    if (snprintf(path, sizeof path, "%.*s%s", slash ? (int)(slash - c->path + 1) : 0, c->path, name) >=
        (int)sizeof path)
        return limits_raise(l, "include: the path of \"%s\" is longer than %zu bytes", name, sizeof path - 1);
    lua_settop(l, 0);
    if (source_load(c, path, &err)) {
        c->code = err.code == ERR_MEMORY ? ERR_MEMORY : 0;
        return limits_raise(l, "include: %s", err.text);
    }
    lua_call(l, 0, LUA_MULTRET);
    return lua_gettop(l);
}

void declare_open(lua_State *l)
{
    static const char address_of_free = 'f';

    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        lua_pushinteger(l, (lua_Integer)i);
        lua_pushcclosure(l, constructor, 1);
        lua_setglobal(l, kinds[i].kind);
    }
    lua_pushcfunction(l, set_title);
    lua_setglobal(l, "case");
    lua_pushcfunction(l, add_param);
    lua_setglobal(l, "param");
    lua_pushcfunction(l, include_file);
    lua_setglobal(l, "include");
    lua_pushlightuserdata(l, (void *)&address_of_free);
    lua_setglobal(l, "free");
}

/* Line of "name = ..." in a text, or 0. */
static int line_of_assignment(const char *text, const char *name)
{
    const size_t n = strlen(name);

    for (int line = 1; text; line++) {
        const char *s = text + strspn(text, " \t");

        if (strncmp(s, name, n) == 0) {
            s += n + strspn(s + n, " \t");
            if (s[0] == '=' && s[1] != '=')
                return line;
        }
        text = strchr(text, '\n');
        text = text ? text + 1 : NULL;
    }
    return 0;
}

const char *declare_overwritten(const case_file *c, int i, int *source, int *line)
{
    int type;

    *source = *line = 0;
    if (i >= (int)(sizeof kinds / sizeof *kinds))
        return NULL;
    type = lua_getglobal(c->lua, kinds[i].kind);
    lua_pop(c->lua, 1);
    if (type != LUA_TTABLE && type != LUA_TSTRING && type != LUA_TNUMBER)
        return "";
    for (int k = 0; k < c->n_source && !*line; k++) {
        *line = line_of_assignment(c->source[k].text, kinds[i].kind);
        *source = *line ? k : 0;
    }
    return kinds[i].kind;
}
