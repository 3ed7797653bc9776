/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/error.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

int error_set(error *err, int code, const char *fmt, ...)
{
    va_list ap;

    if (!err)
        return code;
    err->code = code;
    err->retry = 0;
    va_start(ap, fmt);
    vsnprintf(err->text, sizeof err->text, fmt, ap);
    va_end(ap);
    return code;
}

int error_prefix(error *err, const char *fmt, ...)
{
    char rest[sizeof err->text];
    va_list ap;
    int n;

    if (!err)
        return 0;
    memcpy(rest, err->text, sizeof rest);
    va_start(ap, fmt);
    n = vsnprintf(err->text, sizeof err->text, fmt, ap);
    va_end(ap);
    if (n >= 0 && (size_t)n < sizeof err->text)
        snprintf(err->text + n, sizeof err->text - (size_t)n, "%s", rest);
    return err->code;
}

int error_memory(error *err, const char *what, double bytes)
{
    return error_set(err, ERR_MEMORY, "out of memory: %s needs %.3g MB", what, bytes / 1e6);
}
