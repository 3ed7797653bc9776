/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A case opened as the options say, for the commands that need one. */
#include "base/process.h"
#include "cli/cli.h"

#include <stdio.h>
#include <string.h>

enum { CASE_SECONDS = 60 };

int cli_open(const cli *o, cli_case *k, error *err)
{
    int status;

    memset(k, 0, sizeof *k);
    cli_watchdog(CASE_SECONDS, o->operand[0]);
    status = case_load(&k->c, o->operand[0], o->set, o->n_set, &process.stop, err);
    cli_watchdog(0, "");
    if (k->c.printed.s && !o->quiet)
        fputs(k->c.printed.s, stderr);
    if (!status)
        status = registry_create(&k->r, o->plugin, o->n_plugin, err);
    if (!status)
        status = problem_create(&k->p, &k->c, &k->r, o->n_thread, err);
    if (!status)
        k->p.system.linear.memory_limit = o->memory_limit;
    return status;
}

void cli_close(cli_case *k)
{
    problem_destroy(&k->p);
    case_destroy(&k->c);
    registry_destroy(&k->r);
}
