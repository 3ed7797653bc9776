/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Whether a plugin's description makes sense.  Nothing of it is used before it passed. */
#include "term/term.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

int term_components(uint32_t shape, int dim)
{
    switch (shape) {
    case PF_SCALAR:
        return 1;
    case PF_VECTOR:
        return dim;
    case PF_TENSOR:
        return dim * dim;
    case PF_SPIN:
        return dim == 2 ? 1 : 3;
    default:
        return 0;
    }
}

int term_is_unknown(const pf_slot *s)
{
    return s->eval != PF_OLD && s->eval != PF_DATA;
}

int term_stores(const pf_term *t, const char *field)
{
    for (uint32_t k = 0; k < t->n_in; k++)
        for (uint32_t o = 0; o < t->n_out && t->in[k].eval == PF_DOT; o++)
            if (t->out[o].eval == PF_VALUE && strcmp(t->out[o].field, t->in[k].field) == 0 &&
                (!field || strcmp(field, t->in[k].field) == 0))
                return 1;
    return 0;
}

static int holds(const pf_slot *slot, uint32_t n, const char *field, uint32_t eval)
{
    for (uint32_t i = 0; i < n; i++)
        if (slot[i].eval == eval && strcmp(slot[i].field, field) == 0)
            return 1;
    return 0;
}

int term_diffuses(const pf_term *t, const char *field)
{
    return holds(t->in, t->n_in, field, PF_GRAD) && holds(t->out, t->n_out, field, PF_GRAD) &&
           !holds(t->in, t->n_in, field, PF_LAPLACE);
}

uint32_t term_slot_shape(uint32_t eval, uint32_t field_shape)
{
    switch (eval) {
    case PF_GRAD:
        return field_shape == PF_SCALAR ? PF_VECTOR : field_shape == PF_VECTOR ? PF_TENSOR : 0;
    case PF_DIV:
        return field_shape == PF_VECTOR ? PF_SCALAR : 0;
    default:
        return field_shape;
    }
}

const char *term_where_name(uint32_t where)
{
    static const char *const name[] = {"",           "PF_CELL", "PF_FLUID",    "PF_SOLID", "PF_FACET",
                                       "PF_SURFACE", "PF_CUT",  "PF_PARTICLE", "PF_PAIR"};

    return where <= PF_PAIR ? name[where] : "";
}

const char *term_eval_name(uint32_t eval)
{
    static const char *const name[] = {"",          "value", "gradient", "divergence", "d/dt",
                                       "old value", "data",  "defect",   "Laplacian"};

    return eval <= PF_LAPLACE ? name[eval] : "";
}

const pf_field *term_field(const term_plugin *p, const char *name)
{
    for (uint32_t i = 0; name && i < p->d.n_field; i++)
        if (strcmp(p->d.field[i].name, name) == 0)
            return &p->d.field[i];
    return NULL;
}

/* Copies n structs of `stride` bytes into structs of `size` bytes; what is missing is zero. */
static void *adopt_array(arena *memory, const void *from, uint32_t n, uint32_t stride, size_t size)
{
    char *to = arena_alloc(memory, n ? n : 1, size);

    for (uint32_t i = 0; to && i < n; i++)
        memcpy(to + i * size, (const char *)from + (size_t)i * stride, stride < size ? stride : size);
    return to;
}

static int is_name(const char *s)
{
    if (!s || !((*s >= 'a' && *s <= 'z') || (*s >= 'A' && *s <= 'Z')))
        return 0;
    for (; *s; s++)
        if (!((*s >= 'a' && *s <= 'z') || (*s >= 'A' && *s <= 'Z') || (*s >= '0' && *s <= '9') || *s == '_'))
            return 0;
    return 1;
}

struct subject {
    const char *path, *term;
};

static int wrong(error *err, const struct subject *s, const char *fmt, ...) __attribute__((format(printf, 3, 4)));

static int wrong(error *err, const struct subject *s, const char *fmt, ...)
{
    char why[600];
    va_list ap;

    va_start(ap, fmt);
    vsnprintf(why, sizeof why, fmt, ap);
    va_end(ap);
    return error_set(err, ERR_PLUGIN, "plugin %s%s%s: %s", s->path, s->term ? ", term " : "",
                     s->term ? s->term : "", why);
}

/* On pairs of cells or bodies only differences have a meaning, and nowhere else. */
static int check_defect(const pf_slot *slot, const pf_field *f, uint32_t where, const struct subject *s, error *err)
{
    int pairs = where == PF_CUT || where == PF_PAIR;
    uint32_t support = where == PF_CUT ? PF_ON_MESH : PF_ON_PARTICLE;

    if (slot->eval == PF_DEFECT && !pairs)
        return wrong(err, s, "slot \"%s\" asks for PF_DEFECT, which only PF_CUT and PF_PAIR points have",
                     slot->name);
    if (pairs && slot->eval != PF_DEFECT)
        return wrong(err, s, "slot \"%s\": on %s points fields are there as PF_DEFECT only", slot->name,
                     term_where_name(where));
    if (pairs && f->support != support)
        return wrong(err, s, "slot \"%s\": on %s points fields %s are possible", slot->name, term_where_name(where),
                     where == PF_CUT ? "on the mesh" : "on particles");
    return 0;
}

static int check_slots(const term_plugin *p, const pf_slot *slot, uint32_t n, uint32_t where, int is_out,
                       const struct subject *s, error *err)
{
    const char *side = is_out ? "output" : "input";

    for (uint32_t i = 0; i < n; i++) {
        const pf_field *f = term_field(p, slot[i].field);

        if (!is_name(slot[i].name))
            return wrong(err, s, "%s slot %u has no proper name (letters, digits, _)", side, i);
        for (uint32_t k = 0; k < i; k++)
            if (strcmp(slot[k].name, slot[i].name) == 0)
                return wrong(err, s, "two %s slots are called \"%s\"", side, slot[i].name);
        if (is_out && slot[i].eval == PF_LAPLACE)
            return wrong(
                err, s,
                "output slot \"%s\": PF_LAPLACE is for input slots; of a test function there are PF_VALUE, "
                "PF_GRAD and PF_DIV",
                slot[i].name);
        if (slot[i].eval < PF_VALUE || slot[i].eval > PF_LAPLACE ||
            (is_out && slot[i].eval != PF_VALUE && slot[i].eval != PF_GRAD && slot[i].eval != PF_DIV &&
             slot[i].eval != PF_DEFECT))
            return wrong(err, s, "%s slot \"%s\": eval %u is not possible there", side, slot[i].name, slot[i].eval);
        if (slot[i].shape < PF_SCALAR || slot[i].shape > PF_SPIN)
            return wrong(err, s, "%s slot \"%s\": unknown shape %u", side, slot[i].name, slot[i].shape);
        if (slot[i].eval == PF_DATA)
            continue;
        if (!f)
            return wrong(
                err, s,
                "%s slot \"%s\" uses field \"%s\", an undeclared dependency: add it to the plugin's field list "
                "(several plugins may declare the same field)",
                side, slot[i].name, slot[i].field ? slot[i].field : "(none)");
        if (term_slot_shape(slot[i].eval, f->shape) != slot[i].shape)
            return wrong(err, s, "%s slot \"%s\": the %s of field \"%s\" has another shape than the slot says",
                         side, slot[i].name, term_eval_name(slot[i].eval), f->name);
        TRY(check_defect(&slot[i], f, where, s, err));
        if (f->support != PF_ON_MESH && f->support != PF_IN_PARTICLES && slot[i].eval != PF_VALUE &&
            slot[i].eval != PF_DOT && slot[i].eval != PF_OLD && slot[i].eval != PF_DEFECT)
            return wrong(err, s, "%s slot \"%s\": field \"%s\" does not live on the mesh and has no %s", side,
                         slot[i].name, f->name, term_eval_name(slot[i].eval));
    }
    return 0;
}

/* What came with 1.3: where it is possible, and that older versions of plugflow refuse the plugin. */
static int check_second(const term_plugin *p, const pf_term *t, const struct subject *s, error *err)
{
    const char *what = t->flags & PF_METRIC ? "PF_METRIC" : NULL;

    if ((t->flags & PF_METRIC) && (t->where == PF_CUT || t->where == PF_PAIR))
        return wrong(err, s, "has PF_METRIC, but %s points lie in no single element and have no metric",
                     term_where_name(t->where));
    for (uint32_t k = 0; k < t->n_in; k++)
        if (t->in[k].eval == PF_LAPLACE)
            what = "PF_LAPLACE";
    if (what && p->d.min_minor < 3)
        return wrong(err, s,
                     "uses %s of plugin interface 1.3, which older ones do not have; set .min_minor = 3 in "
                     "its pf_plugin",
                     what);
    return 0;
}

static int check_param(const pf_term *t, const pf_param *p, const struct subject *s, error *err)
{
    static const uint32_t bytes[] = {0, sizeof(double), sizeof(int), sizeof(int), sizeof(int), 3 * sizeof(double)};
    int n_choice = 0;

    if (!is_name(p->name))
        return wrong(err, s, "a parameter has no proper name (letters, digits, _)");
    if (!p->doc || !p->unit)
        return wrong(err, s, "parameter \"%s\" lacks a unit (\"1\" if it has none) or a line of doc", p->name);
    if (p->type < PF_T_REAL || p->type > PF_T_VECTOR)
        return wrong(err, s, "parameter \"%s\" has unknown type %u", p->name, p->type);
    if ((size_t)p->offset + bytes[p->type] > t->params_bytes)
        return wrong(err, s, "parameter \"%s\" at offset %u lies outside the %u bytes of params", p->name,
                     p->offset, t->params_bytes);
    if (p->type == PF_T_CHOICE) {
        while (p->choice && p->choice[n_choice])
            n_choice++;
        if (!(p->dflt >= 0 && p->dflt < n_choice))
            return wrong(err, s, "parameter \"%s\": default %g is none of its %d choices", p->name, p->dflt,
                         n_choice);
        return 0;
    }
    if (!isfinite(p->dflt) ||
        (p->min < p->max && !(p->flags & PF_REQUIRED) && (p->dflt < p->min || p->dflt > p->max)))
        return wrong(err, s, "parameter \"%s\": default %g lies outside its own range [%g, %g]", p->name, p->dflt,
                     p->min, p->max);
    return 0;
}

static int check_term(const term_plugin *p, const pf_term *t, const struct subject *s, error *err)
{
    if (!is_name(t->name))
        return wrong(err, s, "a term has no proper name (letters, digits, _)");
    if (!t->doc || !t->cite)
        return wrong(err, s, "lacks doc (its weak form) or cite (where the equation stands)");
    if (t->where < PF_CELL || t->where > PF_PAIR)
        return wrong(err, s, "acts on unknown points, where = %u", t->where);
    if (t->where == PF_PARTICLE)
        return wrong(err, s, "acts on %s points, which this version does not feed yet", term_where_name(t->where));
    if (!t->residual)
        return wrong(err, s, "has no residual function");
    if (t->n_out == 0 || !t->out || (t->n_in && !t->in) || (t->n_param && !t->param))
        return wrong(err, s, "has no output, or a count without its array");
    TRY(check_slots(p, t->in, t->n_in, t->where, 0, s, err));
    TRY(check_slots(p, t->out, t->n_out, t->where, 1, s, err));
    TRY(check_second(p, t, s, err));
    for (uint32_t i = 0; i < t->n_param; i++) {
        TRY(check_param(t, &t->param[i], s, err));
        for (uint32_t k = 0; k < i; k++)
            if (strcmp(t->param[k].name, t->param[i].name) == 0)
                return wrong(err, s, "two parameters are called \"%s\"", t->param[i].name);
    }
    for (uint32_t i = 0; i < t->n_example; i++) {
        const pf_example *e = &t->example[i];
        const char *name = e->name ? e->name : "";

        if (e->dim != 2 && e->dim != 3)
            return wrong(err, s, "example \"%s\" has dimension %u; 2 or 3 is possible", name, e->dim);
        if (!e->name || (t->n_in && !e->in) || !e->out)
            return wrong(err, s, "example \"%s\" lacks its values or its name", name);
    }
    if (t->flags & PF_BY_BOUNDARY) {
        int n_data = 0;

        for (uint32_t i = 0; i < t->n_in; i++)
            n_data += t->in[i].eval == PF_DATA;
        if (t->where != PF_FACET || n_data != 1)
            return wrong(err, s, "has PF_BY_BOUNDARY, so it must act on PF_FACET and have one PF_DATA slot");
    }
    return 0;
}

static int check_header(const pf_plugin *d, const struct subject *s, error *err)
{
    const size_t least = offsetof(pf_plugin, field) + sizeof d->field;

    if (d->major != PF_ABI_MAJOR)
        return wrong(err, s,
                     "built for plugin interface %u.%u, this plugflow has %u.%u; rebuild it against this version",
                     d->major, d->minor, PF_ABI_MAJOR, PF_ABI_MINOR);
    if (d->min_minor > PF_ABI_MINOR)
        return wrong(err, s, "needs plugin interface %u.%u or later, this plugflow has %u.%u; update plugflow",
                     d->major, d->min_minor, PF_ABI_MAJOR, PF_ABI_MINOR);
    if (d->size < least)
        return wrong(err, s, "its pf_plugin has %u bytes, at least %zu are needed; set .size = sizeof(pf_plugin)",
                     d->size, least);
    if (d->sizes != PF_SIZES)
        return wrong(err, s, "built with other type sizes (%#x, here %#x): another machine or compiler mode",
                     d->sizes, PF_SIZES);
    if (!is_name(d->name))
        return wrong(err, s, "has no proper name (letters, digits, _)");
    if (!d->version || !d->license)
        return wrong(err, s, "lacks a version or a license");
    if (d->n_term == 0 || !d->term)
        return wrong(err, s, "describes no term");
    if (d->n_field && (!d->field || d->field_size < offsetof(pf_field, reaction)))
        return wrong(err, s, "has %u fields but field_size = %u; set .field_size = sizeof(pf_field)", d->n_field,
                     d->field_size);
    return 0;
}

static int check_fields(const term_plugin *p, const struct subject *s, error *err)
{
    for (uint32_t i = 0; i < p->d.n_field; i++) {
        const pf_field *f = &p->d.field[i];

        if (!is_name(f->name))
            return wrong(err, s, "a field has no proper name (letters, digits, _)");
        if (f->shape != PF_SCALAR && f->shape != PF_VECTOR &&
            !(f->shape == PF_SPIN && f->support == PF_ON_PARTICLE))
            return wrong(err, s, "field \"%s\" must be PF_SCALAR or PF_VECTOR", f->name);
        if (f->support > PF_IN_PARTICLES || (f->support % 3 == PF_ON_MESH && f->order != 1 && f->order != 2))
            return wrong(err, s, "field \"%s\": order %u, support %u; order 1 or 2 on the mesh is possible",
                         f->name, f->order, f->support);
        for (uint32_t k = 0; k < i; k++)
            if (strcmp(p->d.field[k].name, f->name) == 0)
                return wrong(err, s, "two fields are called \"%s\"", f->name);
    }
    return 0;
}

int term_adopt(const pf_plugin *d, const char *path, arena *memory, term_plugin *out, error *err)
{
    struct subject s = {path, NULL};
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
            return wrong(err, &s, "term %u has %u bytes, at least %zu are needed; set .size = sizeof(pf_term)", i,
                         from ? from->size : 0, least);
        memcpy(t, from, from->size < sizeof *t ? from->size : sizeof *t);
        s.term = t->name;
        if ((t->n_in || t->n_out) && t->slot_size < offsetof(pf_slot, unit))
            return wrong(err, &s, "slot_size = %u; set .slot_size = sizeof(pf_slot)", t->slot_size);
        if (t->n_param && t->param_size < sizeof(pf_param))
            return wrong(err, &s, "param_size = %u; set .param_size = sizeof(pf_param)", t->param_size);
        if (t->n_example && t->example_size < sizeof(pf_example))
            return wrong(err, &s, "example_size = %u; set .example_size = sizeof(pf_example)", t->example_size);
        if (t->n_in > TERM_MAX_SLOTS || t->n_out > TERM_MAX_SLOTS)
            return wrong(err, &s, "%u input slots and %u output slots, at most %d of each are possible", t->n_in,
                         t->n_out, TERM_MAX_SLOTS);
        if ((t->n_in && !t->in) || !t->out || (t->n_param && !t->param) || (t->n_example && !t->example))
            return wrong(err, &s, "has no output, or a count without its array");
        t->in = adopt_array(memory, from->in, t->n_in, t->slot_size, sizeof(pf_slot));
        t->out = adopt_array(memory, from->out, t->n_out, t->slot_size, sizeof(pf_slot));
        t->param = adopt_array(memory, from->param, t->n_param, t->param_size, sizeof(pf_param));
        t->example = adopt_array(memory, from->example, t->n_example, t->example_size, sizeof(pf_example));
        if (!t->in || !t->out || !t->param || !t->example)
            return error_memory(err, "plugin", 0);
        TRY(check_term(out, t, &s, err));
        for (uint32_t k = 0; k < i; k++)
            if (strcmp(out->term[k].name, t->name) == 0)
                return wrong(err, &s, "two terms have this name");
    }
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
