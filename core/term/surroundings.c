/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A point function that alters the process alters the results of all others. */
#include "term/surroundings.h"

#include <fcntl.h>
#include <fenv.h>
#include <float.h>
#include <locale.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static int flushes(void)
{
    volatile double least = DBL_MIN, half;

    half = least / 2;
    return half == 0;
}

void surroundings_take(surroundings *s)
{
    struct stat st = {0};
    const char *locale = setlocale(LC_ALL, NULL);

    *s = (surroundings){.rounding = fegetround(), .flushes = flushes()};
    s->folder = open(".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (stat(".", &st) == 0)
        s->device = st.st_dev, s->inode = st.st_ino;
    snprintf(s->locale, sizeof s->locale, "%s", locale ? locale : "C");
}

int surroundings_changed(const surroundings *s, char *text, size_t n)
{
    const char *locale = setlocale(LC_ALL, NULL);
    struct stat st = {0};

    if (fegetround() != s->rounding) {
        fesetround(s->rounding);
        snprintf(text, n, "changes the rounding of floating-point numbers (fesetround)");
        return 1;
    }
    if (flushes() != s->flushes) {
        snprintf(text, n, "changes how small floating-point numbers are treated (flush to zero)");
        return 1;
    }
    if (stat(".", &st) != 0 || st.st_dev != s->device || st.st_ino != s->inode) {
        if (s->folder < 0 || fchdir(s->folder) != 0)
            snprintf(text, n, "changes the working directory (chdir), and it cannot be put back");
        else
            snprintf(text, n, "changes the working directory (chdir)");
        return 1;
    }
    if (locale && strcmp(locale, s->locale) != 0) {
        snprintf(text, n, "changes the locale (setlocale, now \"%.60s\")", locale);
        setlocale(LC_ALL, s->locale);
        return 1;
    }
    return 0;
}

void surroundings_release(surroundings *s)
{
    if (s->folder >= 0)
        close(s->folder);
    s->folder = -1;
}
