/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A shared object whose entry function has a wrong name. */
#include <plugflow/plugin.h>

PF_EXPORT const pf_plugin *plugin_entry(const pf_host *host, char *err, size_t nerr);

PF_EXPORT const pf_plugin *plugin_entry(const pf_host *host, char *err, size_t nerr)
{
    (void)host, (void)err, (void)nerr;
    return NULL;
}
