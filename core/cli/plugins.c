/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * plugflow plugins. */
#include "cli/cli.h"

#include <stdio.h>

int cli_plugins(const cli *o, error *err)
{
    static registry r;
    int refused = 0;

    TRY(registry_create(&r, o->plugin, o->n_plugin, err));
    TRY(registry_scan(&r, err));
    for (int i = 0; i < r.n_file; i++) {
        const term_file *f = &r.file[i];

        if (f->refused) {
            refused++;
            continue;
        }
        if (f->plugin.path) {
            printf("%-16s %-8s %s\n%-16s terms:", f->plugin.d.name, f->plugin.d.version, f->path, "");
            for (uint32_t k = 0; k < f->plugin.d.n_term; k++)
                printf(" %s", f->plugin.term[k].name);
            printf("\n");
        } else if (f->solver) {
            printf("%-16s %-8s %s\n%-16s linear solver: %s\n", f->solver->name, f->solver->version, f->path, "",
                   f->solver->doc);
        } else {
            printf("%-16s %-8s %s\n%-16s reads meshes:", f->mesh_reader->name, f->mesh_reader->version, f->path,
                   "");
            for (const char *const *s = f->mesh_reader->suffix; *s; s++)
                printf(" %s", *s);
            printf("\n");
        }
    }
    printf("\nlooked in:\n");
    for (int i = 0; i < r.n_dir; i++)
        printf("  %s\n", r.dir[i]);
    if (refused)
        printf("refused:\n");
    for (int i = 0; i < r.n_file; i++)
        if (r.file[i].refused)
            printf("  %s\n", r.file[i].refused);
    registry_destroy(&r);
    return 0;
}
