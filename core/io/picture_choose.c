/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Which field of a file, and which of its components, a picture is made of. */
#include "base/text.h"
#include "io/picture.h"
#include "io/picture_parts.h"

#include <string.h>

static int field_unknown(const vtu_file *v, const char *name, error *err)
{
    const char *names[VTU_MAX_FIELDS];
    text list = {0};
    int status;

    for (int i = 0; i < v->n_field; i++) {
        names[i] = v->field[i].name;
        text_add(&list, "%s%s", i ? ", " : "", names[i]);
    }
    status = error_set(err, ERR_USAGE, "no field \"%s\"%s; there are: %s", name,
                       text_hint(text_nearest(name, names, (size_t)v->n_field)).s, list.s ? list.s : "none");
    text_free(&list);
    return status;
}

/* The first field with the name (NULL: any) and as many components (0: any). */
static const vtu_array *field_find(const vtu_file *v, const char *name, int components)
{
    for (int i = 0; i < v->n_field; i++)
        if ((!name || !strcmp(v->field[i].name, name)) && (!components || v->field[i].components == components))
            return v->field + i;
    return NULL;
}

/* Components of a vector and of tensors, in the order of the files. */
static const char *const component_name[3][PICTURE_MAGNITUDE] = {
    {"x", "y", "z"}, {"xx", "yy", "zz", "xy", "yz", "xz"}, {"xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"}};

/* Row of that list. */
static int kind_of(const picture_field *f)
{
    return f->colour->components == 6 ? 1 : f->colour->components == 9 ? 2 : 0;
}

const char *picture_component(const picture_field *f)
{
    return f->component < PICTURE_MAGNITUDE ? component_name[kind_of(f)][f->component] : "";
}

static int choose_component(const vtu_file *v, const char *name, picture_field *f, error *err)
{
    int n = f->colour->components, kind = kind_of(f), known = 0;

    f->component = PICTURE_MAGNITUDE;
    if (!name || strcmp(name, "magnitude") == 0)
        return 0;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < PICTURE_MAGNITUDE; k++)
            known |= component_name[i][k] && strcmp(name, component_name[i][k]) == 0;
    if (!known)
        return error_set(err, ERR_USAGE,
                         "component '%s' is none of x, y, z and magnitude (of a tensor xx, xy, ...)", name);
    if (n == 1)
        return error_set(err, ERR_USAGE, "'%s' is a scalar and has no component %s", f->colour->name, name);
    if (v->dim == 2 && strchr(name, 'z'))
        return error_set(err, ERR_USAGE, "'%s' has no component %s in two dimensions", f->colour->name, name);
    for (f->component = 0; f->component < n && strcmp(name, component_name[kind][f->component]);)
        f->component++;
    if (f->component == n)
        return error_set(err, ERR_USAGE, "'%s' is a %s and has no component %s; one is %s", f->colour->name,
                         n == 3 ? "vector" : "tensor", name, component_name[kind][0]);
    return 0;
}

int picture_choose(const vtu_file *v, const picture_options *o, picture_field *f, error *err)
{
    if (!v->n_field)
        return error_set(err, ERR_IO, "there are no fields of 1, 3, 6 or 9 components");
    f->colour = field_find(v, o->field, o->field ? 0 : 3);
    if (!f->colour && o->field)
        return field_unknown(v, o->field, err);
    if (!f->colour)
        f->colour = v->field;
    TRY(choose_component(v, o->component, f, err));
    f->arrow = f->colour->components == 3 ? f->colour : field_find(v, NULL, 3);
    if (o->lines && !f->arrow)
        return error_set(err, ERR_USAGE, "there is no vector field to draw arrows of");
    if (!o->lines)
        f->arrow = NULL;
    return 0;
}
