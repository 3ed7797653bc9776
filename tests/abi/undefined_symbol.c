/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A plugin that calls a function which nobody has. */
#include <plugflow/plugin.h>

const pf_plugin *a_function_that_nobody_has(void);

PF_EXPORT const pf_plugin *pf_plugin_entry(const pf_host *host, char *err, size_t nerr)
{
    (void)host, (void)err, (void)nerr;
    return a_function_that_nobody_has();
}
