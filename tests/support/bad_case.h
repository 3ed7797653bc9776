/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * bad_case.h -- a plain case with some lines changed, and what the program has to say about it. */
#ifndef SUPPORT_BAD_CASE_H
#define SUPPORT_BAD_CASE_H

#include <stddef.h>

/* Channel flow, eight lines: title, mesh, fluid, two terms, walls, inflow, outflow.  `edits` has lines "N TEXT":
 * line N of the case becomes TEXT; lines beyond the eighth are added. */
typedef struct bad_case {
    const char *edits;
    int code;            /* exit code of plugflow check */
    const char *says[6]; /* all of this; what begins with '!' must not be there */
} bad_case;

/* Edits for bodies: line 9, and two steps in line 19. */
#define SHARP "9 particulate \"sharp\"\n"
#define TIME  "\n19 time { step = 0.05, stop = 0.1 }"
/* A body of density 2 in line N, with these keys. */
#define BODY(N, KEYS) #N " particle { density = 2, " KEYS " }\n"
#define DISK(N, AT)   BODY(N, "shape = disk { radius = 0.2 }, at = " AT)

/* Checks all of them; the test fails with the case and what was printed. */
void check_bad_cases(const bad_case *list, size_t n, const char *file, int line);
#define assert_bad_cases(list) check_bad_cases((list), sizeof(list) / sizeof *(list), __FILE__, __LINE__)

#endif
