/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * new.h -- what plugflow new writes. */
#ifndef CLI_NEW_H
#define CLI_NEW_H

#include "cli/cli.h"
#include "weak/weak.h"

typedef struct new_plugin {
    const char *name, *where, *form; /* form NULL: the term is not from a weak form */
    int bodies;                      /* how many the case needs                     */
    weak_result weak;
} new_plugin;

/* --- new_text.c --- */
/* A case in which the term acts. */
void new_case(const new_plugin *n, text *t);
void new_readme(const new_plugin *n, text *t);
/* Terms on bodies and pairs of them. */
void new_body_source(const new_plugin *n, text *t);

#endif
