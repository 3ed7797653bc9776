/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * warning.h -- what is doubtful but no error.  Whoever finds something adds a warning; the run (run/) says each one
 * on stderr, in run.jsonl and in summary.json. */
#ifndef BASE_WARNING_H
#define BASE_WARNING_H

typedef struct warning_list {
    int n, room;
    char **text;
    int lost; /* warnings for which there was no memory */
} warning_list;

/* Adds a warning, unless the same one is there. */
void warning_add(warning_list *l, const char *fmt, ...) __attribute__((format(printf, 2, 3)));
void warning_free(warning_list *l);

#endif
