/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Reading a block key by key; every key that nobody asks for is a mistake of the case. */
#include "case/case.h"

#include <lauxlib.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void reader_open(reader *r, case_file *c, const case_block *b, const char *what)
{
    *r = (reader){.c = c, .b = b, .what = what};
}

int reader_type(const reader *r, const char *key)
{
    int type;

    if (!r->b || r->b->ref == LUA_NOREF)
        return LUA_TNIL;
    lua_rawgeti(r->c->lua, LUA_REGISTRYINDEX, r->b->ref);
    lua_pushstring(r->c->lua, key);
    type = lua_rawget(r->c->lua, -2);
    lua_pop(r->c->lua, 2);
    return type;
}

int reader_has(const reader *r, const char *key)
{
    return reader_type(r, key) != LUA_TNIL;
}

/* Notes the key as valid; pushes its value if it is there. */
static int ask(reader *r, const char *key, const char *doc)
{
    lua_State *l = r->c->lua;
    int known = 0;

    for (int i = 0; i < r->n_key; i++)
        known |= strcmp(r->key[i], key) == 0;
    if (!known && r->n_key == CASE_MAX_KEYS) {
        case_wrong(
            r->c, r->b, NULL,
            "%s: the terms that are on ask for more than %d keys here, \"%s\" is one too many; switch some off",
            r->what, CASE_MAX_KEYS, key);
        return 0;
    }
    if (!known) {
        r->key[r->n_key] = key;
        r->doc[r->n_key++] = doc;
    }
    if (!reader_has(r, key))
        return 0;
    lua_rawgeti(l, LUA_REGISTRYINDEX, r->b->ref);
    lua_getfield(l, -1, key);
    lua_remove(l, -2);
    return 1;
}

int reader_asked(const reader *r, const char *key)
{
    for (int i = 0; i < r->n_key; i++)
        if (strcmp(r->key[i], key) == 0)
            return 1;
    return 0;
}

int reader_note(reader *r, const char *key, const char *doc)
{
    int there = ask(r, key, doc);

    if (there)
        lua_pop(r->c->lua, 1);
    return there;
}

static int mismatch(reader *r, const char *key, const char *doc, const char *expected)
{
    lua_State *l = r->c->lua;
    const char *got = lua_type(l, -1) == LUA_TSTRING ? "the string" : luaL_typename(l, -1);

    case_wrong(r->c, r->b, key, "%s: \"%s\" (%s): expected %s, got %s%s%s%s", r->what, key, doc, expected, got,
               lua_type(l, -1) == LUA_TSTRING ? " \"" : "",
               lua_type(l, -1) == LUA_TSTRING ? lua_tostring(l, -1) : "",
               lua_type(l, -1) == LUA_TSTRING ? "\"" : "");
    lua_pop(l, 1);
    return -1;
}

/* What a number must be, if it is none of low..high. */
static void wrong_number(reader *r, const char *key, const char *doc, double low, double high, double x)
{
    char must[100];

    if (!isfinite(x))
        snprintf(must, sizeof must, "be a finite number");
    else if (high >= 1e29 && low == 0 && x < low)
        snprintf(must, sizeof must, "not be negative");
    else if (high >= 1e29 && low > 0 && low < 1e-200 && x < low)
        snprintf(must, sizeof must, "be positive");
    else
        snprintf(must, sizeof must, "lie between %g and %g", low, high);
    case_wrong(r->c, r->b, key, "%s: \"%s\" (%s) is %g; it must %s", r->what, key, doc, x, must);
}

int reader_number(reader *r, const char *key, const char *doc, double low, double high, double *v)
{
    lua_State *l = r->c->lua;
    double x;

    if (!ask(r, key, doc))
        return 0;
    if (lua_type(l, -1) != LUA_TNUMBER)
        return mismatch(r, key, doc, "a number");
    x = lua_tonumber(l, -1);
    lua_pop(l, 1);
    if (!isfinite(x) || (low < high && (x < low || x > high))) {
        wrong_number(r, key, doc, low, high, x);
        return -1;
    }
    *v = x;
    return 1;
}

int reader_integer(reader *r, const char *key, const char *doc, int low, int high, int *v)
{
    double x;
    int status = reader_number(r, key, doc, low, high, &x);

    if (status <= 0)
        return status;
    if (x != floor(x)) {
        case_wrong(r->c, r->b, key, "%s: \"%s\" (%s) is %g; it must be a whole number", r->what, key, doc, x);
        return -1;
    }
    *v = (int)x;
    return 1;
}

int reader_bool(reader *r, const char *key, const char *doc, int *v)
{
    if (!ask(r, key, doc))
        return 0;
    if (!lua_isboolean(r->c->lua, -1))
        return mismatch(r, key, doc, "true or false");
    *v = lua_toboolean(r->c->lua, -1);
    lua_pop(r->c->lua, 1);
    return 1;
}

/* The value on top of the Lua stack is a string without zero bytes. */
static int is_text(lua_State *l)
{
    return lua_type(l, -1) == LUA_TSTRING && strlen(lua_tostring(l, -1)) == lua_rawlen(l, -1);
}

int reader_string(reader *r, const char *key, const char *doc, const char **v)
{
    if (!ask(r, key, doc))
        return 0;
    if (!is_text(r->c->lua))
        return mismatch(r, key, doc,
                        lua_type(r->c->lua, -1) == LUA_TSTRING ? "a string without zero bytes" : "a string");
    *v = arena_strdup(&r->c->memory, lua_tostring(r->c->lua, -1));
    r->c->no_memory |= !*v;
    lua_pop(r->c->lua, 1);
    return *v ? 1 : -1;
}

int reader_choice(reader *r, const char *key, const char *doc, const char *const *choice, int *v)
{
    const char *s;
    text t = {0};
    int status = reader_string(r, key, doc, &s), n = 0;

    if (status <= 0)
        return status;
    for (; choice[n]; n++) {
        if (strcmp(choice[n], s) == 0) {
            *v = n;
            text_free(&t);
            return 1;
        }
        text_add(&t, "%s\"%s\"", n ? ", " : "", choice[n]);
    }
    case_wrong(r->c, r->b, key, "%s: \"%s\" (%s): \"%s\" is not possible%s; expected one of %s", r->what, key, doc,
               s, text_hint(text_nearest(s, choice, (size_t)n)).s, t.s ? t.s : "");
    text_free(&t);
    return -1;
}

int reader_vector(reader *r, const char *key, const char *doc, int n, double *v)
{
    lua_State *l = r->c->lua;
    char expected[60];

    if (!ask(r, key, doc))
        return 0;
    snprintf(expected, sizeof expected, "%d numbers in braces", n);
    if (!lua_istable(l, -1))
        return mismatch(r, key, doc, expected);
    if ((int)lua_rawlen(l, -1) != n) {
        case_wrong(r->c, r->b, key, "%s: \"%s\" (%s): expected %d numbers, got %d", r->what, key, doc, n,
                   (int)lua_rawlen(l, -1));
        lua_pop(l, 1);
        return -1;
    }
    for (int i = 0; i < n; i++) {
        lua_rawgeti(l, -1, i + 1);
        if (lua_type(l, -1) == LUA_TNUMBER && !isfinite(lua_tonumber(l, -1))) {
            wrong_number(r, key, doc, 0, 0, lua_tonumber(l, -1));
            lua_pop(l, 2);
            return -1;
        }
        if (lua_type(l, -1) != LUA_TNUMBER) {
            int status = mismatch(r, key, doc, "numbers");

            lua_pop(l, 1);
            return status;
        }
        v[i] = lua_tonumber(l, -1);
        lua_pop(l, 1);
    }
    lua_pop(l, 1);
    return 1;
}

int reader_value(reader *r, const char *key, const char *doc, int n, int dim, value *v)
{
    if (!ask(r, key, doc))
        return 0;
    return case_value(r->c, r->b, key, n, dim, v);
}

int reader_condition(reader *r, const char *key, const char *doc, int dim, value *v)
{
    return ask(r, key, doc) ? case_condition(r->c, r->b, key, dim, v) : 0;
}

int reader_strings(reader *r, const char *key, const char *doc, int most, const char **v, int *n)
{
    lua_State *l = r->c->lua;
    lua_Unsigned there;

    *n = 0;
    if (!ask(r, key, doc))
        return 0;
    if (!lua_istable(l, -1))
        return mismatch(r, key, doc, "names in braces");
    there = lua_rawlen(l, -1);
    if (there > (lua_Unsigned)most) {
        case_wrong(r->c, r->b, key, "%s: \"%s\" (%s): expected at most %d names, got %llu", r->what, key, doc, most,
                   there);
        lua_pop(l, 1);
        return -1;
    }
    for (; *n < (int)there; ++*n) {
        lua_rawgeti(l, -1, *n + 1);
        if (!is_text(l)) {
            *n = 0;
            mismatch(r, key, doc, "names in quotes");
            lua_pop(l, 1);
            return -1;
        }
        v[*n] = arena_strdup(&r->c->memory, lua_tostring(l, -1));
        lua_pop(l, 1);
        if (!v[*n]) {
            *n = 0;
            r->c->no_memory = 1;
            lua_pop(l, 1);
            return -1;
        }
    }
    lua_pop(l, 1);
    return 1;
}

int reader_table(reader *r, const char *key, const char *doc)
{
    if (!ask(r, key, doc))
        return 0;
    if (!lua_istable(r->c->lua, -1))
        return mismatch(r, key, doc, "a table in braces");
    return 1;
}

/* The key that was meant by another name: what other codes call it, or the one that comes nearest; or NULL. */
static const char *meant(const char *name, const char *const *valid, int n, const char **note)
{
    const char *key = case_alias(name, valid, n, note);

    if (key)
        return key;
    *note = NULL;
    return text_nearest(name, valid, (size_t)n);
}

int reader_misspelt(const reader *r, const char *key)
{
    lua_State *l = r->c->lua;
    const char *note;
    int found = 0;

    if (!r->b || r->b->ref == LUA_NOREF)
        return 0;
    lua_rawgeti(l, LUA_REGISTRYINDEX, r->b->ref);
    lua_pushnil(l);
    while (lua_next(l, -2)) {
        lua_pop(l, 1);
        if (lua_type(l, -1) == LUA_TSTRING) {
            const char *other = lua_tostring(l, -1);

            found |= !reader_asked(r, other) && meant(other, &key, 1, &note) != NULL;
        }
    }
    lua_pop(l, 1);
    return found;
}

int reader_required(reader *r, const char *key, int status)
{
    if (status == 0 && !reader_misspelt(r, key)) {
        const char *doc = "";

        for (int i = 0; i < r->n_key; i++)
            doc = strcmp(r->key[i], key) == 0 ? r->doc[i] : doc;
        case_wrong(r->c, r->b, NULL, "%s: \"%s\" is missing (%s)", r->what, key, doc);
    }
    return status > 0;
}

static int by_name(const void *a, const void *b)
{
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

void reader_close(reader *r)
{
    lua_State *l = r->c->lua;
    const char *valid[CASE_MAX_KEYS], *noun = r->noun ? r->noun : "key", *note;
    text list = {0};

    if (!r->b || r->b->ref == LUA_NOREF)
        return;
    memcpy(valid, r->key, sizeof valid);
    qsort(valid, (size_t)r->n_key, sizeof *valid, by_name);
    for (int i = 0; i < r->n_key; i++)
        text_add(&list, "%s%s", i ? ", " : "", valid[i]);
    lua_rawgeti(l, LUA_REGISTRYINDEX, r->b->ref);
    lua_pushnil(l);
    while (lua_next(l, -2)) {
        const char *key, *near, *doc = "";
        int known = 0;

        lua_pop(l, 1);
        key = lua_type(l, -1) == LUA_TSTRING ? lua_tostring(l, -1) : NULL;
        for (int i = 0; key && is_text(l) && i < r->n_key; i++)
            known |= strcmp(key, r->key[i]) == 0;
        if (known)
            continue;
        if (!key) {
            case_wrong(r->c, r->b, NULL, "%s: a value without a name\n    valid %ss: %s", r->what, noun,
                       list.s ? list.s : "none");
            continue;
        }
        near = meant(key, r->key, r->n_key, &note);
        for (int i = 0; near && i < r->n_key; i++)
            doc = r->key[i] == near ? r->doc[i] : doc;
        if (near)
            case_wrong(r->c, r->b, key, "%s: unknown %s \"%s\"; did you mean \"%s\" (%s%s%s)?\n    valid %ss: %s",
                       r->what, noun, key, near, doc, note ? "; " : "", note ? note : "", noun, list.s);
        else
            case_wrong(r->c, r->b, key, "%s: unknown %s \"%s\"\n    valid %ss: %s", r->what, noun, key, noun,
                       list.s ? list.s : "none");
    }
    lua_pop(l, 1);
    text_free(&list);
}
