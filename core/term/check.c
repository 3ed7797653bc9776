/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Whether a plugin's description makes sense.  Nothing of it is used before it passed. */
#include "term/check.h"

#include <math.h>
#include <string.h>

/* Copies n structs of `stride` bytes into structs of `size` bytes; what is missing is zero. */
static void *adopt_array(arena *memory, const void *from, uint32_t n, uint32_t stride, size_t size)
{
    char *to = arena_alloc(memory, n ? n : 1, size);

    for (uint32_t i = 0; to && i < n; i++)
        memcpy(to + i * size, (const char *)from + (size_t)i * stride, stride < size ? stride : size);
    return to;
}

static int check_param(const pf_term *t, const pf_param *p, const check_subject *s, error *err)
{
    static const uint32_t bytes[] = {0, sizeof(double), sizeof(int), sizeof(int), sizeof(int), 3 * sizeof(double)};
    int n_choice = 0;

    if (!check_is_name(p->name))
        return check_wrong(err, s, "a parameter has no proper name (letters, digits, _)");
    if (!p->doc || !p->unit)
        return check_wrong(err, s, "parameter \"%s\" lacks a unit (\"1\" if it has none) or a line of doc",
                           p->name);
    if (p->type < PF_T_REAL || p->type > PF_T_VECTOR)
        return check_wrong(err, s, "parameter \"%s\" has unknown type %u", p->name, p->type);
    if ((size_t)p->offset + bytes[p->type] > t->params_bytes)
        return check_wrong(err, s, "parameter \"%s\" at offset %u lies outside the %u bytes of params", p->name,
                           p->offset, t->params_bytes);
    if (p->type == PF_T_CHOICE) {
        while (p->choice && p->choice[n_choice])
            n_choice++;
        if (!(p->dflt >= 0 && p->dflt < n_choice))
            return check_wrong(err, s, "parameter \"%s\": default %g is none of its %d choices", p->name, p->dflt,
                               n_choice);
        return 0;
    }
    if (!isfinite(p->dflt) ||
        (p->min < p->max && !(p->flags & PF_REQUIRED) && (p->dflt < p->min || p->dflt > p->max)))
        return check_wrong(err, s, "parameter \"%s\": default %g lies outside its own range [%g, %g]", p->name,
                           p->dflt, p->min, p->max);
    return 0;
}

static int check_term(const term_plugin *p, const pf_term *t, const check_subject *s, error *err)
{
    if (!check_is_name(t->name))
        return check_wrong(err, s, "a term has no proper name (letters, digits, _)");
    if (!t->doc || !t->cite)
        return check_wrong(err, s, "lacks doc (its weak form) or cite (where the equation stands)");
    if (t->where < PF_CELL || t->where > PF_PAIR)
        return check_wrong(err, s, "acts on unknown points, where = %u", t->where);
    if (t->n_param > TERM_MAX_PARAMS)
        return check_wrong(err, s, "has %u parameters, at most %d are possible", t->n_param, TERM_MAX_PARAMS);
    if (!t->residual)
        return check_wrong(err, s, "has no residual function");
    if (t->n_out == 0 || !t->out || (t->n_in && !t->in) || (t->n_param && !t->param))
        return check_wrong(err, s, "has no output, or a count without its array");
    TRY(check_slots(p, t, s, err));
    for (uint32_t i = 0; i < t->n_param; i++) {
        TRY(check_param(t, &t->param[i], s, err));
        for (uint32_t k = 0; k < i; k++)
            if (strcmp(t->param[k].name, t->param[i].name) == 0)
                return check_wrong(err, s, "two parameters are called \"%s\"", t->param[i].name);
    }
    for (uint32_t i = 0; i < t->n_example; i++) {
        const pf_example *e = &t->example[i];
        const char *name = e->name ? e->name : "";

        if (e->dim != 2 && e->dim != 3)
            return check_wrong(err, s, "example \"%s\" has dimension %u; 2 or 3 is possible", name, e->dim);
        if (!e->name || (t->n_in && !e->in) || !e->out)
            return check_wrong(err, s, "example \"%s\" lacks its values or its name", name);
    }
    if (t->flags & PF_BY_BOUNDARY) {
        int n_data = 0;

        for (uint32_t i = 0; i < t->n_in; i++)
            n_data += t->in[i].eval == PF_DATA;
        if (t->where != PF_FACET || n_data != 1)
            return check_wrong(err, s, "has PF_BY_BOUNDARY, so it must act on PF_FACET and have one PF_DATA slot");
    }
    return 0;
}

static int check_header(const pf_plugin *d, const check_subject *s, error *err)
{
    const size_t least = offsetof(pf_plugin, field) + sizeof d->field;

    if (d->major != PF_ABI_MAJOR)
        return check_wrong(
            err, s, "built for plugin interface %u.%u, this plugflow has %u.%u; rebuild it against this version",
            d->major, d->minor, PF_ABI_MAJOR, PF_ABI_MINOR);
    if (d->min_minor > PF_ABI_MINOR)
        return check_wrong(err, s,
                           "needs plugin interface %u.%u or later, this plugflow has %u.%u; update plugflow",
                           d->major, d->min_minor, PF_ABI_MAJOR, PF_ABI_MINOR);
    if (d->size < least)
        return check_wrong(err, s,
                           "its pf_plugin has %u bytes, at least %zu are needed; set .size = sizeof(pf_plugin)",
                           d->size, least);
    if (d->sizes != PF_SIZES)
        return check_wrong(err, s, "built with other type sizes (%#x, here %#x): another machine or compiler mode",
                           d->sizes, PF_SIZES);
    if (!check_is_name(d->name))
        return check_wrong(err, s, "has no proper name (letters, digits, _)");
    if (!d->version || !d->license)
        return check_wrong(err, s, "lacks a version or a license");
    if (d->n_term == 0 || !d->term)
        return check_wrong(err, s, "describes no term");
    if (d->n_field && (!d->field || d->field_size < offsetof(pf_field, reaction)))
        return check_wrong(err, s, "has %u fields but field_size = %u; set .field_size = sizeof(pf_field)",
                           d->n_field, d->field_size);
    return 0;
}

static int check_fields(const term_plugin *p, const check_subject *s, error *err)
{
    for (uint32_t i = 0; i < p->d.n_field; i++) {
        const pf_field *f = &p->d.field[i];

        if (!check_is_name(f->name))
            return check_wrong(err, s, "a field has no proper name (letters, digits, _)");
        if (f->shape != PF_SCALAR && f->shape != PF_VECTOR && f->shape != PF_TENSOR && f->shape != PF_SYMMETRIC &&
            !(f->shape == PF_SPIN && (f->support == PF_ON_PARTICLE || f->support == PF_KEPT_BY_PARTICLE)))
            return check_wrong(err, s, "field \"%s\" must be PF_SCALAR, PF_VECTOR, PF_TENSOR or PF_SYMMETRIC",
                               f->name);
        if (f->support > PF_KEPT_BY_PARTICLE || (f->support == PF_ON_MESH && f->order > 2) ||
            (f->support == PF_IN_PARTICLES && f->order != 1 && f->order != 2))
            return check_wrong(
                err, s,
                "field \"%s\": order %u, support %u; on the mesh order 1 or 2, or 0, one value a cell, "
                "is possible",
                f->name, f->order, f->support);
        if (f->support == PF_ON_MESH && f->order == 0 && p->d.min_minor < 4)
            return check_wrong(
                err, s,
                "field \"%s\" has order 0, which older ones than plugin interface 1.4 do not have; set "
                ".min_minor = 4 in its pf_plugin (or its .order, if it was left out)",
                f->name);
        for (uint32_t k = 0; k < i; k++)
            if (strcmp(p->d.field[k].name, f->name) == 0)
                return check_wrong(err, s, "two fields are called \"%s\"", f->name);
    }
    return 0;
}

int term_adopt(const pf_plugin *d, const char *path, arena *memory, term_plugin *out, error *err)
{
    check_subject s = {path, NULL};
    const size_t least = offsetof(pf_term, jacobian) + sizeof(pf_jacobian_fn *);

    TRY(check_header(d, &s, err));
    memcpy(&out->d, d, d->size < sizeof *d ? d->size : sizeof *d);
    out->d.field = adopt_array(memory, d->field, d->n_field, d->field_size, sizeof(pf_field));
    ARENA_NEW(memory, out->term, d->n_term, err);
    if (!out->d.field)
        return error_memory(err, "plugin", 0);
    TRY(check_fields(out, &s, err));
    for (uint32_t i = 0; i < d->n_term; i++) {
        const pf_term *from = d->term[i];
        pf_term *t = &out->term[i];

        s.term = NULL;
        if (!from || from->size < least)
            return check_wrong(err, &s,
                               "term %u has %u bytes, at least %zu are needed; set .size = sizeof(pf_term)", i,
                               from ? from->size : 0, least);
        memcpy(t, from, from->size < sizeof *t ? from->size : sizeof *t);
        s.term = t->name;
        if ((t->n_in || t->n_out) && t->slot_size < offsetof(pf_slot, unit))
            return check_wrong(err, &s, "slot_size = %u; set .slot_size = sizeof(pf_slot)", t->slot_size);
        if (t->n_param && t->param_size < sizeof(pf_param))
            return check_wrong(err, &s, "param_size = %u; set .param_size = sizeof(pf_param)", t->param_size);
        if (t->n_example && t->example_size < sizeof(pf_example))
            return check_wrong(err, &s, "example_size = %u; set .example_size = sizeof(pf_example)",
                               t->example_size);
        if (t->n_in > TERM_MAX_SLOTS || t->n_out > TERM_MAX_SLOTS)
            return check_wrong(err, &s, "%u input slots and %u output slots, at most %d of each are possible",
                               t->n_in, t->n_out, TERM_MAX_SLOTS);
        if ((t->n_in && !t->in) || !t->out || (t->n_param && !t->param) || (t->n_example && !t->example))
            return check_wrong(err, &s, "has no output, or a count without its array");
        t->in = adopt_array(memory, from->in, t->n_in, t->slot_size, sizeof(pf_slot));
        t->out = adopt_array(memory, from->out, t->n_out, t->slot_size, sizeof(pf_slot));
        t->param = adopt_array(memory, from->param, t->n_param, t->param_size, sizeof(pf_param));
        t->example = adopt_array(memory, from->example, t->n_example, t->example_size, sizeof(pf_example));
        if (!t->in || !t->out || !t->param || !t->example)
            return error_memory(err, "plugin", 0);
        TRY(check_term(out, t, &s, err));
        for (uint32_t k = 0; k < i; k++)
            if (strcmp(out->term[k].name, t->name) == 0)
                return check_wrong(err, &s, "two terms have this name");
    }
    TRY(check_keys(out, path, err));
    out->path = path;
    return 0;
}

void term_defaults(const pf_term *t, void *params)
{
    for (uint32_t i = 0; i < t->n_param; i++) {
        const pf_param *p = &t->param[i];
        char *at = (char *)params + p->offset;

        if (p->type == PF_T_REAL) {
            memcpy(at, &p->dflt, sizeof(double));
        } else if (p->type == PF_T_VECTOR) {
            double v[3] = {p->dflt, p->dflt, p->dflt};

            memcpy(at, v, sizeof v);
        } else {
            int v = (int)p->dflt;

            memcpy(at, &v, sizeof v);
        }
    }
}
