/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * case.h -- a case file: Lua in a sandbox, collected into blocks, read key by key.
 *
 * A case is run once; each of its lines (mesh{}, term "..." {}, ...) leaves a block.  Who needs
 * a block reads its keys with a reader, which knows for every key what it must be.  What is
 * wrong is collected, with file and line, and reported all at once by case_finish(). */
#ifndef CASE_CASE_H
#define CASE_CASE_H

#include "base/arena.h"
#include "base/error.h"
#include "base/text.h"
#include "base/value.h"

#include <lua.h>
#include <signal.h>
#include <stddef.h>

enum { CASE_MAX_BLOCKS = 256, CASE_MAX_KEYS = 96, CASE_MAX_SETS = 64, CASE_MAX_SOURCES = 16 };

typedef struct case_block {
    const char *kind; /* "mesh", "term", ...                     */
    const char *name; /* "momentum" in term "momentum" {}, or NULL */
    int ref;          /* its table (or function) in the Lua registry; LUA_NOREF if none */
    const char *file;
    int line;
    int by_prelude; /* a line of the prelude wrote it, for the case's line: particulate, fluid */
} case_block;

typedef struct case_set {
    const char *name, *value;
    int used;
} case_set;

typedef struct case_param {
    const char *name, *doc;
    char value[64], dflt[64];
} case_param;

/* Memory of Lua that was refused last, bytes; capped: by the limit of a case, not by the system. */
typedef struct case_refused {
    size_t held, asked;
    int capped;
} case_refused;

typedef struct case_file {
    const char *path, *title;
    lua_State *lua;
    size_t lua_bytes, lua_limit; /* held, and allowed now */
    case_refused refused;
    int n_block, n_set, n_param, n_source, n_error;
    int n_wrong;   /* calls of case_wrong; n_error counts each text once */
    int no_memory; /* something could not be read for lack of it          */
    case_block block[CASE_MAX_BLOCKS];
    case_set set[CASE_MAX_SETS];
    case_param param[CASE_MAX_SETS];
    struct {
        const char *file, *text;
    } source[CASE_MAX_SOURCES];
    text errors, printed;
    size_t printed_bytes; /* by print of the case */
    const char *running;  /* name of the function that is being called; NULL: the case itself */
    long budget;          /* Lua instructions left, in thousands */
    int code;             /* of the error that is on its way through Lua; 0: ERR_CASE */
    char last_file[LUA_IDSIZE];
    int last_line; /* where Lua was not long ago; 0: unknown */
    unsigned long long random;
    const volatile sig_atomic_t *stop; /* number of a signal that wants the program to end; NULL: none does */
    arena memory;
} case_file;

/* Runs the file; set[] are "NAME=VALUE" of --set.  On error the message is complete.  Once *stop (NULL: none) is
 * the number of a signal, this and every later call into the case's Lua ends with ERR_SIGNAL + *stop. */
int case_load(case_file *c, const char *path, const char *const *set, int n_set, const volatile sig_atomic_t *stop,
              error *err);
/* Calls the function that lies below n_arg arguments on the Lua stack: protected, with limits on its instructions
 * and on memory.  name: what messages call it (NULL: it is the case itself).  Leaves n_result results; on error
 * nothing. ERR_CASE with Lua's message, which has the line; ERR_MEMORY with figures; ERR_SIGNAL + n. */
int case_call(case_file *c, const char *name, int n_arg, int n_result, error *err);
/* The block of this kind, or NULL; the k-th if several may stand in a case. */
const case_block *case_find(const case_file *c, const char *kind, int k);
/* Adds to what is wrong. */
void case_wrong(case_file *c, const case_block *at, const char *key, const char *fmt, ...)
    __attribute__((format(printf, 4, 5)));
/* ERR_CASE with all that was wrong, ERR_MEMORY if something could not be read, or 0. */
int case_finish(case_file *c, error *err);
/* Line of `key =` in a block (NULL, or not found: the block's own). */
int case_line(const case_file *c, const case_block *at, const char *key);
void case_destroy(case_file *c);

/* --- reading a block (reader.c) --- */

typedef struct reader {
    case_file *c;
    const case_block *b; /* NULL: the block is absent; every key is */
    const char *what;    /* how messages call it: "fluid", "term \"momentum\"" */
    const char *noun;    /* and its keys; NULL: "key"                           */
    int n_key;
    const char *key[CASE_MAX_KEYS], *doc[CASE_MAX_KEYS];
} reader;

void reader_open(reader *r, case_file *c, const case_block *b, const char *what);
/* All readers return 1 if the key is there and right, 0 if absent (the value is left alone), -1 if
 * wrong (and reported).  low >= high: no bounds. */
int reader_number(reader *r, const char *key, const char *doc, double low, double high, double *v);
int reader_integer(reader *r, const char *key, const char *doc, int low, int high, int *v);
int reader_bool(reader *r, const char *key, const char *doc, int *v);
int reader_string(reader *r, const char *key, const char *doc, const char **v);
int reader_choice(reader *r, const char *key, const char *doc, const char *const *choice, int *v);
int reader_vector(reader *r, const char *key, const char *doc, int n, double *v);
/* A number or function (n = 1), a vector of numbers, functions and `free`, or one function. */
int reader_value(reader *r, const char *key, const char *doc, int n, int dim, value *v);
/* A function of place (and time) that returns true or false, or a number: v is 1, 0 or that number. */
int reader_condition(reader *r, const char *key, const char *doc, int dim, value *v);
/* At most `most` strings in a list; more are wrong. */
int reader_strings(reader *r, const char *key, const char *doc, int most, const char **v, int *n);
/* Leaves the value of the key on the Lua stack if it is a table (then 1) -- pop it. */
int reader_table(reader *r, const char *key, const char *doc);
int reader_has(const reader *r, const char *key);
/* Lua's type of the value (lua.h), LUA_TNIL if it is absent. */
int reader_type(const reader *r, const char *key);
/* 1 if a key stands there that no reader has asked for yet and that looks like a slip for this one (reader_close
 * will say so). */
int reader_misspelt(const reader *r, const char *key);
int reader_required(reader *r, const char *key, int status);
/* Notes a key as valid without reading it; 1 if it is there. */
int reader_note(reader *r, const char *key, const char *doc);
/* 1 if some reader has asked for the key or noted it. */
int reader_asked(const reader *r, const char *key);
/* Reports the keys that nobody asked for. */
void reader_close(reader *r);
/* Of n valid keys the one that other codes call by this name, and what differs beside the name (or NULL); or NULL
 * (alias.c). */
const char *case_alias(const char *other, const char *const *valid, int n, const char **note);

/* A Lua function or number on top of the stack as a value; pops it. */
int case_value(case_file *c, const case_block *b, const char *key, int n, int dim, value *v);
/* The same of a function that may return true or false. */
int case_condition(case_file *c, const case_block *b, const char *key, int dim, value *v);

#endif
