/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * watched.h -- code of plugins in a child process: it may crash, end the process or never come back, and is named.
 */
#ifndef CLI_WATCHED_H
#define CLI_WATCHED_H

#include "base/error.h"

/* What the child and its parent share. */
typedef struct watched {
    volatile int done;  /* the child came to its end */
    volatile int slow;  /* a call took too long      */
    int passed, failed; /* checks                    */
    char in[400];       /* "term momentum.stress, residual"; "" between calls */
} watched;

/* Runs work(w, arg, err) in a child.  What it returns, or an error that says in which call it ended. */
int watched_run(int (*work)(watched *w, void *arg, error *err), void *arg, const char *subject, watched *out,
                error *err);
/* In the child: a call of a plugin begins (`what`: "residual"), or is over (NULL).  One that takes too long ends
 * the child. */
void watched_enter(watched *w, const char *subject, const char *what);

#endif
