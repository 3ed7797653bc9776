/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The files of a case: the case itself and what it includes.  Their text is kept for messages and the archive. */
#include "case/sandbox.h"

#include <lauxlib.h>

#include <errno.h>
#include <stdio.h>
#include <string.h>

enum { MOST_BYTES = 16 << 20 };

static char *read_file(case_file *c, const char *path, size_t *n, error *err)
{
    FILE *f = fopen(path, "rb");
    char *s = NULL;
    long size = -1;

    if (f && fseek(f, 0, SEEK_END) == 0)
        size = ftell(f);
    if (!f || size < 0 || size > MOST_BYTES) {
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

int source_load(case_file *c, const char *path, error *err)
{
    char chunk[4100], *s;
    size_t n;
    int status;

    if (c->n_source == CASE_MAX_SOURCES)
        return error_set(err, ERR_CASE, "%s: more than %d files in a case", path, CASE_MAX_SOURCES);
    s = read_file(c, path, &n, err);
    if (!s)
        return err->code;
    c->source[c->n_source].text = s;
    c->source[c->n_source].file = arena_strdup(&c->memory, path);
    if (!c->source[c->n_source].file)
        return error_memory(err, path, 0);
    c->n_source++;
    snprintf(chunk, sizeof chunk, "@%s", path);
    if (n >= 3 && memcmp(s, "\xef\xbb\xbf", 3) == 0) { /* as some editors begin a file */
        s += 3;
        n -= 3;
    }
    status = luaL_loadbufferx(c->lua, s, n, chunk, "t");
    return status == LUA_OK ? 0 : limits_failure(c, status, err);
}

int source_find(const case_file *c, const char *file)
{
    int i = c->n_source - 1;

    while (i > 0 && strcmp(c->source[i].file, file) != 0)
        i--;
    return i;
}
