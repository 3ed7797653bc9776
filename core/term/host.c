/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What plugins may call: the report of a point that cannot be computed. */
#include "term/term.h"

#include "base/process.h"

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

int term_start(const term_plugin *p, const pf_term *t, void *params, int dim, int n_body, int unsteady, char *why,
               size_t n)
{
    const pf_setup setup = {
        .size = sizeof setup, .dim = (uint32_t)dim, .n_body = n_body, .unsteady = unsteady, .host = &term_host};
    int status;

    if (!t->init)
        return 0;
    process_enter(p->d.name, t->name, "init", -1);
    status = t->init(params, &setup, why, n);
    process_leave();
    return status;
}

void term_end(const term_plugin *p, const pf_term *t, void *params)
{
    if (!t->done)
        return;
    process_enter(p->d.name, t->name, "done", -1);
    t->done(params);
    process_leave();
}
