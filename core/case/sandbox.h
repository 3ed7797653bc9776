/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * sandbox.h -- between the files of this folder: Lua as cases see it.  Each file uses only those before it:
 *
 *     limits     memory, instructions, signals; errors with the line of the case
 *     source     files that are read
 *     library    what is left of Lua's library; print and random numbers of our own
 *     declare    case "...", param(...), mesh {...}, term "..." {...}: what the lines of a case leave
 *     sandbox    all of them put together, with prelude.lua
 *     case, value, reader    what the kernel sees (case.h)                                                       */
#ifndef CASE_SANDBOX_H
#define CASE_SANDBOX_H

#include "case/case.h"

/* --- limits.c --- */

/* A fresh state of Lua with its limits in c->lua. */
int limits_open(case_file *c, error *err);
case_file *limits_case(lua_State *l);
/* What Lua has on top of its stack after a call or a load that ended with this status. */
int limits_failure(case_file *c, int status, error *err);
/* Raises an error of Lua that begins with "file:line: " of the line of the case that is being run. */
int limits_raise(lua_State *l, const char *fmt, ...) __attribute__((format(printf, 2, 3)));
/* The level of Lua's stack that runs a line of the case: fills *ar ("Sl") and returns 1; 0 if none does.
 * *by_prelude (may be NULL): a line of the prelude stands between. */
int limits_line(lua_State *l, lua_Debug *ar, int *by_prelude);

/* --- source.c --- */

/* Reads a file and leaves it, compiled, on the Lua stack.  ERR_IO, ERR_CASE (syntax), ERR_MEMORY. */
int source_load(case_file *c, const char *path, error *err);
/* Which of c->source is this file; the case itself if none is. */
int source_find(const case_file *c, const char *file);

/* --- library.c, declare.c: these raise errors of Lua --- */

void library_open(lua_State *l);
/* From now on a global that is not there is an error. */
void library_close(lua_State *l);
void declare_open(lua_State *l);
/* After the case has run, kind i of block: its name if the case assigned to it instead of calling it (and where),
 * "" if not, NULL behind the last kind. */
const char *declare_overwritten(const case_file *c, int i, int *source, int *line);

/* --- sandbox.c --- */

int sandbox_open(case_file *c, error *err);
extern const char *const sandbox_prelude[]; /* lines of prelude.lua, NULL at the end */

#endif
