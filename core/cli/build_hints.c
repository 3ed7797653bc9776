/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What compilers say of some mistakes in a plugin is about the macros of term.h; in its words: */
#include "cli/build.h"

#include <regex.h>
#include <stdio.h>

static const struct hint {
    const char *pattern; /* of what gcc or clang says, on one line */
    int is_error;        /* the plugin is of no use, though it compiles */
    const char *text;
} hints[] = {
    {"PF_NUMBER_I.* requires|PF_SLOT_ENTRY_I.* requires|too few arguments provided to function-like macro", 0,
     "a slot in IN or OUT is none that term.h knows: standard ones go by their names (u, grad_u, p, T, ...; out: "
     "v, "
     "grad_v, q, s, ...), those of a new field by #define PF_SHAPE_salt SCALAR and VALUE(salt), GRAD(salt), "
     "TEST(salt, "
     "w); others are DATA, PROPERTY, BODY_KEY, STATE, SHOW, INTEGRAL"},
    {"conflicting type qualifiers for .{1,3}(b|in|out|params)[^a-z0-9_]|redefinition of (parameter "
     ")?.{1,3}b[^a-z0-9_]",
     0, "a key or a slot is called as what every block has (b is the batch): give it another name"},
    {"function .{1,3}PF_EACH_|PF_EACH_[A-Za-z_].*(undeclared|expected)|expected .*PF_EACH_", 0,
     "a list is too long: a term has up to 12 slots IN, 12 OUT and 32 keys, a plugin 16 fields; make it two terms, "
     "or one "
     "VECTOR of three keys"},
    {"[A-Za-z0-9_]_complex.{1,3} used but never defined|[A-Za-z0-9_]_complex.{1,3} has internal linkage but is not "
     "defined|undefined (symbol|reference).*_complex",
     1, "the last line of the file is missing: #include PF_TWIN"},
    {"shadows a parameter|shadows a previous local|shadows a local", 0,
     "two things have one name where a line above says \"shadows\": inside EACH (a) the key or slot a is hidden, "
     "the "
     "index is used; rename one"},
};

int build_hints(const char *said)
{
    int error = 0;

    for (size_t i = 0; i < sizeof hints / sizeof *hints; i++) {
        regex_t r;

        if (regcomp(&r, hints[i].pattern, REG_EXTENDED | REG_NOSUB | REG_NEWLINE) != 0)
            continue;
        if (regexec(&r, said, 0, NULL, 0) == 0) {
            fprintf(stderr, "plugflow: hint: %s\n", hints[i].text);
            error |= hints[i].is_error;
        }
        regfree(&r);
    }
    return error;
}
