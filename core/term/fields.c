/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Fields that plugins declare: several may declare the same one, and must agree. */
#include "term/term.h"

#include <string.h>

int fields_find(const field_list *l, const char *name)
{
    for (int i = 0; i < l->n; i++)
        if (strcmp(l->f[i].name, name) == 0)
            return i;
    return -1;
}

int fields_moves_bodies(const field_spec *f)
{
    const int spin = f->shape == PF_SPIN;

    return f->support == PF_ON_PARTICLE && (spin || f->shape == PF_VECTOR) &&
           (strcmp(f->unit, spin ? "rad/s" : "m/s") == 0 || f->constrains);
}

int fields_add(field_list *l, int dim, const pf_field *f, const char *plugin, error *err)
{
    int i = fields_find(l, f->name);
    field_spec *g = &l->f[i < 0 ? 0 : i];
    int order = f->support == PF_ON_MESH || f->support == PF_IN_PARTICLES ? (int)f->order : 0;

    if (i >= 0) {
        if (g->shape != (int)f->shape || g->order != order || g->support != (int)f->support)
            return error_set(
                err, ERR_PLUGIN,
                "field \"%s\": plugin \"%s\" declares it as %s of order %d, plugin \"%s\" as %s of order %d; "
                "one of them needs another name for its field",
                f->name, g->declared_by, term_shape_name((uint32_t)g->shape), g->order, plugin,
                term_shape_name(f->shape), order);
        if (!g->constrains)
            g->constrains = f->constrains;
        return 0;
    }
    if (l->n == TERM_MAX_FIELDS)
        return error_set(err, ERR_PLUGIN, "field \"%s\" of plugin \"%s\": more than %d fields", f->name, plugin,
                         TERM_MAX_FIELDS);
    l->f[l->n++] = (field_spec){
        .name = f->name,
        .unit = f->unit ? f->unit : "1",
        .doc = f->doc ? f->doc : "",
        .reaction = f->reaction,
        .reaction_unit = f->reaction_unit ? f->reaction_unit : "",
        .declared_by = plugin,
        .constrains = f->constrains,
        .shape = (int)f->shape,
        .n_comp = term_components(f->shape, dim),
        .order = order,
        .support = (int)f->support,
    };
    return 0;
}
