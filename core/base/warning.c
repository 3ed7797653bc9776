/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Warnings, each once, in the order in which they came. */
#include "base/warning.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void warning_add(warning_list *l, const char *fmt, ...)
{
    char line[2000];
    va_list ap;

    va_start(ap, fmt);
    vsnprintf(line, sizeof line, fmt, ap);
    va_end(ap);
    for (int i = 0; i < l->n; i++)
        if (strcmp(l->text[i], line) == 0)
            return;
    if (l->n == l->room) {
        char **more = realloc(l->text, (size_t)(2 * l->room + 8) * sizeof *more);

        if (!more) {
            l->lost++;
            return;
        }
        l->text = more;
        l->room = 2 * l->room + 8;
    }
    l->text[l->n] = strdup(line);
    if (l->text[l->n])
        l->n++;
    else
        l->lost++;
}

void warning_free(warning_list *l)
{
    for (int i = 0; i < l->n; i++)
        free(l->text[i]);
    free(l->text);
    memset(l, 0, sizeof *l);
}
