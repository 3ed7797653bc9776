/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * describe.h -- what the two forms of `plugflow describe` share: the keys of a plugin, each once, and names. */
#ifndef CLI_DESCRIBE_H
#define CLI_DESCRIBE_H

#include "base/text.h"
#include "cli/cli.h"

/* Where in a case a key stands. */
enum key_place { KEY_OF_TERM, KEY_OF_FLUID, KEY_OF_BOUNDARY, KEY_OF_BODY };

typedef struct described_key {
    enum key_place place;
    const char *name, *unit, *doc;
    struct text standard, range; /* "required", "0.1"; "0 to 1", "a or b", "" */
    struct text terms;           /* "storage, advection"                      */
} described_key;

typedef struct described_keys {
    int n;
    described_key *key;
} described_keys;

/* Keys of a plugin, or of its term `only`; the same key of several terms is one, unless they mean it differently.
 */
int describe_keys(described_keys *l, const term_plugin *p, const char *only, error *err);
/* Keys of solve { solver = ... }. */
int describe_solver_keys(described_keys *l, const pf_solver *s, error *err);
void describe_keys_free(described_keys *l);

/* "complex step", "bodies, once each", "of each body". */
const char *describe_derivative(const pf_term *t);
const char *describe_points(const pf_term *t);
const char *describe_support(const pf_field *f);
/* "value of u", "property viscosity", "data". */
void describe_slot(text *t, const pf_slot *s);
/* Flags in words, each after `before`. */
void describe_flags(text *t, const pf_term *term, const char *before);

/* --- describe_find.c --- */

/* The file that is meant: a path, the name of a plugin of any kind, or PLUGIN.TERM. */
int describe_find(registry *r, const char *operand, const term_file **file, const char **term, error *err);

/* --- describe_markdown.c --- */

/* describe --markdown NAME on stdout; with --all into the folder, one file for each plugin of the first folder that
 * is looked in. */
int describe_markdown(const cli *o, registry *r, error *err);

#endif
