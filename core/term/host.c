/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What plugins may call: the report of a point that cannot be computed. */
#include "term/term.h"

#include <stdarg.h>
#include <stdio.h>

#ifndef PF_VERSION
#define PF_VERSION "0"
#endif

static int host_fail(const pf_batch *b, uint32_t lane, int status, const char *fmt, ...)
{
    term_report *r = b->kernel;
    char why[700], at[100] = "";
    va_list ap;

    if (!r || r->status)
        return status;
    va_start(ap, fmt);
    vsnprintf(why, sizeof why, fmt, ap);
    va_end(ap);
    if (b->x && lane < b->ld && b->dim == 3)
        snprintf(at, sizeof at, " at x = (%.6g, %.6g, %.6g)", b->x[lane], b->x[b->ld + lane],
                 b->x[2 * b->ld + lane]);
    else if (b->x && lane < b->ld)
        snprintf(at, sizeof at, " at x = (%.6g, %.6g)", b->x[lane], b->x[b->ld + lane]);
    r->status = status;
    snprintf(r->text, sizeof r->text, "term %s.%s%s, t = %.6g: %s", r->plugin, r->term, at, b->t, why);
    return status;
}

const pf_host term_host = {
    .size = sizeof(pf_host),
    .major = PF_ABI_MAJOR,
    .minor = PF_ABI_MINOR,
    .sizes = PF_SIZES,
    .version = PF_VERSION,
    .fail = host_fail,
};
