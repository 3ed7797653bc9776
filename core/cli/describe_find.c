/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The plugin that plugflow describe is asked for, of any kind. */
#include "cli/describe.h"

#include <stdio.h>
#include <string.h>

/* A name is mostly that of equations; a solver or a reader of meshes that has it is taken, too. */
static int find_named(registry *r, const char *name, const term_file **file, error *err)
{
    const term_plugin *p = NULL;
    const pf_solver *s = NULL;
    const pf_mesh_reader *m = NULL;
    error none = {0};

    if (registry_equation(r, name, &p, err) && registry_solver(r, name, &s, &none) &&
        registry_mesh_reader(r, name, &m, &none))
        return err->code;
    *err = (error){0};
    for (int i = 0; i < r->n_file; i++) {
        const term_file *f = &r->file[i];

        if (!f->refused && ((p && p == &f->plugin) || (s && s == f->solver) || (m && m == f->mesh_reader)))
            *file = f;
    }
    return 0;
}

int describe_find(registry *r, const char *operand, const term_file **file, const char **term, error *err)
{
    const char *dot = strchr(operand, '.');
    const size_t n = strlen(operand);
    char name[128];
    term_file *f;

    *term = NULL;
    if (n > 3 && strcmp(operand + n - 3, ".so") == 0) {
        TRY(registry_load(r, operand, &f, err));
        *file = f;
        return 0;
    }
    snprintf(name, sizeof name, "%.*s", dot ? (int)(dot - operand) : 127, operand);
    TRY(find_named(r, name, file, err));
    if (!dot)
        return 0;
    *term = dot + 1;
    for (uint32_t i = 0; (*file)->plugin.path && i < (*file)->plugin.d.n_term; i++)
        if (strcmp(*term, (*file)->plugin.term[i].name) == 0)
            return 0;
    return error_set(err, ERR_USAGE, "plugin \"%s\" has no term \"%s\"; plugflow describe %s lists its terms", name,
                     *term, name);
}
