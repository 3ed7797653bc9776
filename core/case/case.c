/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Loading a case, and collecting what is wrong with it. */
#include "case/sandbox.h"

#include <ctype.h>
#include <stdarg.h>
#include <lauxlib.h>

#include <stdio.h>
#include <string.h>

const case_block *case_find(const case_file *c, const char *kind, int k)
{
    for (int i = 0; i < c->n_block; i++)
        if (strcmp(c->block[i].kind, kind) == 0 && k-- == 0)
            return &c->block[i];
    return NULL;
}

/* Line of `key =` in the source from the block's line on; the block's own if it is not found. */
static int line_of_key(const case_file *c, const case_block *b, const char *key)
{
    const char *s = c->n_source ? c->source[source_find(c, b->file)].text : NULL, *text = s;
    size_t n = key ? strlen(key) : 0;
    int line = 1;

    for (; s && *s && line < b->line; s++)
        line += *s == '\n';
    for (; s && key && *s && line < b->line + 60; s++) {
        line += *s == '\n';
        if (strncmp(s, key, n) == 0 && (s == text || (!isalnum((unsigned char)s[-1]) && s[-1] != '_'))) {
            const char *t = s + n;

            while (*t == ' ' || *t == '\t')
                t++;
            if (*t == '=' && t[1] != '=')
                return line;
        }
    }
    return b->line;
}

void case_wrong(case_file *c, const case_block *at, const char *key, const char *fmt, ...)
{
    char why[3000];
    text line = {0};
    va_list ap;

    va_start(ap, fmt);
    vsnprintf(why, sizeof why, fmt, ap);
    va_end(ap);
    c->n_wrong++;
    if (at)
        text_add(&line, "%s:%d: %s", at->file, line_of_key(c, at, key), why);
    else
        text_add(&line, "%s: %s", c->path, why);
    if (!c->errors.s || !line.s || !strstr(c->errors.s, line.s)) { /* two terms may ask for the same key */
        text_add(&c->errors, "%s%s", c->n_error ? "\n" : "", line.s ? line.s : why);
        c->n_error++;
    }
    text_free(&line);
}

int case_line(const case_file *c, const case_block *at, const char *key)
{
    return line_of_key(c, at, key);
}

int case_finish(case_file *c, error *err)
{
    if (c->no_memory)
        return error_memory(err, c->path, 0);
    if (c->n_error == 0)
        return 0;
    return error_set(err, ERR_CASE, "%s", c->errors.s ? c->errors.s : "out of memory");
}

static int parse_sets(case_file *c, const char *const *set, int n_set, error *err)
{
    for (int i = 0; i < n_set; i++) {
        const char *eq = strchr(set[i], '=');
        char *name = arena_strdup(&c->memory, set[i]);

        if (!eq || eq == set[i])
            return error_set(err, ERR_USAGE, "--set %s: expected NAME=VALUE", set[i]);
        if (i == CASE_MAX_SETS || !name)
            return error_set(err, ERR_USAGE, "more than %d --set", CASE_MAX_SETS);
        name[eq - set[i]] = 0;
        c->set[c->n_set++] = (case_set){name, name + (eq - set[i]) + 1, 0};
    }
    return 0;
}

/* Every --set names a parameter of the case. */
static void check_sets(case_file *c)
{
    const char *name[CASE_MAX_SETS];
    text t = {0};

    for (int k = 0; k < c->n_param; k++) {
        name[k] = c->param[k].name;
        text_add(&t, "%s%s", k ? ", " : "", name[k]);
    }
    for (int i = 0; i < c->n_set; i++)
        if (!c->set[i].used)
            case_wrong(c, NULL, NULL, "--set %s=%s: the case has no parameter \"%s\"%s\n    its parameters: %s",
                       c->set[i].name, c->set[i].value, c->set[i].name,
                       text_hint(text_nearest(c->set[i].name, name, (size_t)c->n_param)).s, t.s ? t.s : "none");
    text_free(&t);
}

/* Blocks of some kinds stand once. */
static void check_once(case_file *c)
{
    static const char *const once[] = {"mesh",  "fluid", "time",    "output", "initial",
                                       "exact", "solve", "results", "offset"};

    for (size_t i = 0; i < sizeof once / sizeof *once; i++) {
        const case_block *first = case_find(c, once[i], 0), *second = case_find(c, once[i], 1);

        if (!second)
            continue;
        if (strcmp(once[i], "offset") == 0 && first->by_prelude != second->by_prelude)
            case_wrong(
                c, first->by_prelude ? second : first, NULL,
                "offset: the case has one already: with gravity in fluid{}, particulate (line %d) adds rho g.x, "
                "the hydrostatic part of the pressure, to p; leave this offset{} out",
                (first->by_prelude ? first : second)->line);
        else
            case_wrong(c, second, NULL, "%s: a second block of this kind; the first is in line %d", once[i],
                       first->line);
    }
}

/* time = {...} declares nothing. */
static void check_assigned(case_file *c)
{
    const char *kind;
    int source, line;

    for (int i = 0; (kind = declare_overwritten(c, i, &source, &line)); i++)
        if (*kind) {
            case_block *at = arena_alloc(&c->memory, 1, sizeof *at);

            c->no_memory |= !at;
            if (!at)
                return;
            *at = (case_block){.kind = kind, .ref = LUA_NOREF, .line = line, .file = c->source[source].file};
            case_wrong(c, at, NULL, "%s = ... declares nothing; write %s { ... }, without =", kind, kind);
        }
}

int case_load(case_file *c, const char *path, const char *const *set, int n_set, const volatile sig_atomic_t *stop,
              error *err)
{
    memset(c, 0, sizeof *c);
    c->stop = stop;
    c->path = arena_strdup(&c->memory, path);
    if (!c->path)
        return error_memory(err, path, 0);
    TRY(parse_sets(c, set, n_set, err));
    TRY(sandbox_open(c, err));
    TRY(source_load(c, path, err));
    TRY(case_call(c, NULL, 0, 0, err));
    check_sets(c);
    check_once(c);
    check_assigned(c);
    return 0;
}

void case_destroy(case_file *c)
{
    if (c->lua)
        lua_close(c->lua);
    text_free(&c->errors);
    text_free(&c->printed);
    arena_free(&c->memory);
    memset(c, 0, sizeof *c);
}
