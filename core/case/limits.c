/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * How far a case may go: memory of Lua, instructions of one call, and the signal that ends the program. */
#include "case/sandbox.h"

#include <lauxlib.h>

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What a case may hold; beyond that there is a reserve for what the kernel itself asks of Lua outside of calls
 * (names of keys), where an error could go nowhere. */
enum {
    LUA_BYTES = 1 << 30,
    RESERVE_BYTES = 1 << 26,
    HOOK_EVERY = 1000,
    BUDGET_THOUSANDS = 200000,
    LONG_THOUSANDS = 1000
};

case_file *limits_case(lua_State *l)
{
    return *(case_file **)lua_getextraspace(l);
}

static void *allocate(void *ud, void *p, size_t old, size_t size)
{
    case_file *c = ud;
    void *q = NULL;

    if (!p)
        old = 0;
    if (size == 0) {
        free(p);
        c->lua_bytes -= old;
        return NULL;
    }
    if (size <= old || c->lua_bytes + (size - old) <= c->lua_limit)
        q = realloc(p, size);
    if (q)
        c->lua_bytes += size - old;
    else
        c->refused = (case_refused){c->lua_bytes, size - old, c->lua_bytes + (size - old) > c->lua_limit};
    return q;
}

int limits_line(lua_State *l, lua_Debug *ar, int *by_prelude)
{
    int prelude = 0, found = 0;

    for (int level = 0; !found && lua_getstack(l, level, ar); level++) {
        lua_getinfo(l, "Sl", ar);
        found = ar->currentline > 0 && ar->source[0] == '@';
        prelude |= ar->currentline > 0 && !found;
    }
    if (by_prelude)
        *by_prelude = prelude;
    return found;
}

int limits_raise(lua_State *l, const char *fmt, ...)
{
    char why[1500];
    lua_Debug ar;
    va_list ap;

    va_start(ap, fmt);
    vsnprintf(why, sizeof why, fmt, ap);
    va_end(ap);
    if (limits_line(l, &ar, NULL))
        lua_pushfstring(l, "%s:%d: %s", ar.short_src, ar.currentline, why);
    else
        lua_pushstring(l, why);
    return lua_error(l);
}

static int signal_number(const case_file *c)
{
    return c->stop ? (int)*c->stop : 0;
}

static void budget_hook(lua_State *l, lua_Debug *ar)
{
    case_file *c = limits_case(l);

    c->last_line = 0;
    if (limits_line(l, ar, NULL)) {
        c->last_line = ar->currentline;
        memcpy(c->last_file, ar->short_src, sizeof c->last_file);
    }
    /* A short call lets the step go on that it belongs to; one that takes long ends at once. */
    if (signal_number(c) && c->budget < BUDGET_THOUSANDS - LONG_THOUSANDS) {
        c->code = ERR_SIGNAL + signal_number(c);
        limits_raise(l, "stopped by a signal");
    }
    if (--c->budget <= 0)
        limits_raise(l, "%s%s%s runs for too long (%d million steps in one call); is there an endless loop?",
                     c->running ? "function \"" : "the case", c->running ? c->running : "", c->running ? "\"" : "",
                     BUDGET_THOUSANDS / 1000);
}

int limits_open(case_file *c, error *err)
{
    c->lua_limit = LUA_BYTES + RESERVE_BYTES;
    c->lua = lua_newstate(allocate, c);
    if (!c->lua)
        return error_memory(err, "Lua", 0);
    *(case_file **)lua_getextraspace(c->lua) = c;
    lua_sethook(c->lua, budget_hook, LUA_MASKCOUNT, HOOK_EVERY);
    return 0;
}

static int out_of_memory(const case_file *c, error *err)
{
    char near[sizeof c->last_file + 20] = "", more[40];
    double held = (double)c->refused.held / 1e6, asked = (double)c->refused.asked;

    if (c->last_line)
        snprintf(near, sizeof near, "near %s:%d: ", c->last_file, c->last_line);
    if (asked < 1e6)
        snprintf(more, sizeof more, "%.0f bytes", asked);
    else
        snprintf(more, sizeof more, "%.4g MB", asked / 1e6);
    if (c->refused.capped)
        return error_set(err, ERR_MEMORY,
                         "%sout of memory: Lua holds %.4g MB and asked for %s more; a case may hold %.4g MB", near,
                         held, more, LUA_BYTES / 1e6);
    return error_set(err, ERR_MEMORY,
                     "%sout of memory: Lua holds %.4g MB and asked for %s more; the system has no more", near, held,
                     more);
}

int limits_failure(case_file *c, int status, error *err)
{
    const char *why = status == LUA_ERRMEM ? NULL : lua_tostring(c->lua, -1);

    status = status == LUA_ERRMEM ? out_of_memory(c, err)
                                  : error_set(err, c->code ? c->code : ERR_CASE, "%s",
                                              why ? why : "an error whose value is no text");
    lua_pop(c->lua, 1);
    return status;
}

int case_call(case_file *c, const char *name, int n_arg, int n_result, error *err)
{
    int status;

    /* A short call lets the step go on that it belongs to; one that takes long ends at once. */
    c->code = 0;
    c->running = name;
    c->budget = BUDGET_THOUSANDS;
    c->last_line = 0;
    c->lua_limit = LUA_BYTES;
    status = lua_pcall(c->lua, n_arg, n_result, 0);
    c->lua_limit = LUA_BYTES + RESERVE_BYTES;
    return status == LUA_OK ? 0 : limits_failure(c, status, err);
}
