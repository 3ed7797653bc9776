/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * check.h -- what the checks of a description share. */
#ifndef TERM_CHECK_H
#define TERM_CHECK_H

#include "term/term.h"

/* What a message is about. */
typedef struct check_subject {
    const char *path, *term;
} check_subject;

int check_wrong(error *err, const check_subject *s, const char *fmt, ...) __attribute__((format(printf, 3, 4)));
/* Letters, digits and _, a letter first. */
int check_is_name(const char *s);
/* All slots of a term, and what it is with them (check_slots.c). */
int check_slots(const term_plugin *p, const pf_term *t, const check_subject *s, error *err);
/* The keys of all terms of a plugin (check_keys.c). */
int check_keys(const term_plugin *p, const char *path, error *err);

#endif
