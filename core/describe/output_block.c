/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * output{} of a case. */
#include "describe/describe.h"

#include <lauxlib.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A field that cannot be written, with what can. */
static void no_field(description *d, registry *plugins, reader *r, const char *wrong)
{
    const char *name[2 * TERM_MAX_FIELDS], *term = describe_who_shows(plugins, wrong);
    int n = 0, f = fields_find(&d->fields, wrong);
    text list = {0};

    for (int i = 0; i < d->fields.n + d->shown_fields.n; i++) {
        const field_spec *g = i < d->fields.n ? &d->fields.f[i] : &d->shown_fields.f[i - d->fields.n];

        if (g->support == PF_ON_MESH) {
            name[n++] = g->name;
            text_add(&list, "%s%s (%s)", n > 1 ? ", " : "", g->name, g->doc);
        }
    }
    if (f >= 0 && d->fields.f[f].support == PF_ON_PARTICLE)
        case_wrong(
            d->c, r->b, "fields",
            "output: fields: \"%s\" (%s) is in particles.csv without being asked for; fields of the mesh: %s",
            wrong, d->fields.f[f].doc, list.s ? list.s : "none");
    else if (f >= 0)
        case_wrong(d->c, r->b, "fields",
                   "output: fields: \"%s\" (%s) is not a field of the mesh%s; fields of the mesh: %s", wrong,
                   d->fields.f[f].doc,
                   d->fields.f[f].support == PF_ON_PROBLEM ? "; it is in problem.csv without being asked for" : "",
                   list.s ? list.s : "none");
    else if (term)
        case_wrong(d->c, r->b, "fields",
                   "output: there is no field \"%s\"; there are: %s; the line term \"%s\" {} shows it", wrong,
                   list.s ? list.s : "none", term);
    else if (!d->incomplete)
        case_wrong(d->c, r->b, "fields", "output: there is no field \"%s\"%s; there are: %s", wrong,
                   text_hint(text_nearest(wrong, name, (size_t)n)).s, list.s ? list.s : "none");
    text_free(&list);
}

static void read_fields(description *d, registry *plugins, reader *r)
{
    output_spec *o = &d->output;
    const char *list[TERM_MAX_FIELDS];
    int n, status = reader_strings(r, "fields", "fields to write", TERM_MAX_FIELDS, list, &n);

    for (int f = 0; status <= 0 && f < d->fields.n; f++)
        if (d->fields.f[f].support == PF_ON_MESH)
            o->field[o->n_field++] = f;
    for (int f = 0; status <= 0 && f < d->shown_fields.n; f++)
        o->shown[o->n_shown++] = f;
    o->kept = status <= 0 ? ~0u : 0;
    for (int i = 0; status > 0 && i < n; i++) {
        int f = fields_find(&d->fields, list[i]), shown = fields_find(&d->shown_fields, list[i]), twice = 0;

        for (int k = 0; k < i; k++)
            twice |= strcmp(list[k], list[i]) == 0;
        if (twice)
            case_wrong(d->c, r->b, "fields", "output: fields: \"%s\" stands there twice", list[i]);
        else if (fields_find(&d->kept, list[i]) >= 0)
            o->kept |= 1u << fields_find(&d->kept, list[i]);
        else if (f >= 0 && d->fields.f[f].support == PF_ON_MESH)
            o->field[o->n_field++] = f;
        else if (shown >= 0)
            o->shown[o->n_shown++] = shown;
        else
            no_field(d, plugins, r, list[i]);
    }
}

static int is_name(const char *s)
{
    return *s && s[strspn(s, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_")] == 0 &&
           strlen(s) < 40;
}

/* Name of the entry whose key and value are on top of the Lua stack; *name = NULL if it has none of its own. */
static int proper_name(description *d, reader *r, const char *key, const char **name, int n, error *err)
{
    lua_State *l = d->c->lua;

    *name = NULL;
    if (lua_type(l, -2) != LUA_TSTRING || !is_name(lua_tostring(l, -2)) ||
        strlen(lua_tostring(l, -2)) != lua_rawlen(l, -2)) {
        case_wrong(d->c, r->b, key,
                   "output: %s: every entry needs a name of its own (letters, digits, _), as in %s = "
                   "{ wake = {...} }",
                   key, key);
        return 0;
    }
    if (n == DESCRIBE_MAX_PROBES) {
        case_wrong(d->c, r->b, key, "output: %s: more than %d entries", key, DESCRIBE_MAX_PROBES);
        return 0;
    }
    *name = arena_strdup(&d->memory, lua_tostring(l, -2));
    return *name ? 0 : error_memory(err, "output", 0);
}

/* Tables of Lua have no order: sort by name, so that columns come in the same order in every run. */
#define SORT_BY_NAME(list, n)                                                                                      \
    for (int i_ = 1; i_ < (n); i_++)                                                                               \
        for (int k_ = i_; k_ > 0 && strcmp((list)[k_ - 1].name, (list)[k_].name) > 0; k_--) {                      \
            __typeof__((list)[0]) swap_ = (list)[k_];                                                              \
                                                                                                                   \
            (list)[k_] = (list)[k_ - 1];                                                                           \
            (list)[k_ - 1] = swap_;                                                                                \
        }

static int read_probes(description *d, reader *r, error *err)
{
    output_spec *o = &d->output;
    lua_State *l = d->c->lua;

    if (reader_table(r, "probes", "points: name = {x, y[, z]}") <= 0)
        return 0;
    lua_pushnil(l);
    while (lua_next(l, -2)) {
        probe_spec q = {0};

        TRY(proper_name(d, r, "probes", &q.name, o->n_probe, err));
        if (q.name && describe_numbers(l, q.x, 3) != d->dim)
            case_wrong(d->c, r->b, q.name, "output: probe \"%s\" needs %d coordinates in braces", q.name, d->dim);
        else if (q.name)
            o->probe[o->n_probe++] = q;
        lua_pop(l, 1);
    }
    lua_pop(l, 1);
    SORT_BY_NAME(o->probe, o->n_probe)
    return 0;
}

/* name = { from = {...}, to = {...}, points = n }, on top of the Lua stack (and left there). */
static int read_line(description *d, const case_block *b, line_spec *q, int *ok, error *err)
{
    const int before = d->c->n_wrong;
    const case_block *inner;
    char *what;
    int from, to;
    reader r;

    *ok = 0;
    q->n = 101;
    if (!lua_istable(d->c->lua, -1)) {
        case_wrong(d->c, b, q->name, "output: line \"%s\": expected { from = {...}, to = {...}, points = n }",
                   q->name);
        return 0;
    }
    ARENA_NEW(&d->memory, what, strlen(q->name) + 20, err);
    sprintf(what, "output: line \"%s\"", q->name);
    lua_pushvalue(d->c->lua, -1);
    TRY(describe_inner(d, b, "output", &inner, err));
    reader_open(&r, d->c, inner, what);
    from = reader_vector(&r, "from", "where it begins, m", d->dim, q->from);
    to = reader_vector(&r, "to", "where it ends, m", d->dim, q->to);
    reader_integer(&r, "points", "how many values", 2, 10000000, &q->n);
    reader_required(&r, "from", from);
    reader_required(&r, "to", to);
    reader_close(&r);
    if (from > 0 && to > 0 && memcmp(q->from, q->to, sizeof q->to) == 0)
        case_wrong(d->c, b, q->name, "%s begins where it ends; a point is a probe", what);
    *ok = d->c->n_wrong == before;
    return 0;
}

static int read_lines(description *d, reader *r, error *err)
{
    output_spec *o = &d->output;
    lua_State *l = d->c->lua;

    if (reader_table(r, "lines", "lines: name = { from = {...}, to = {...}, points = n }") <= 0)
        return 0;
    lua_pushnil(l);
    while (lua_next(l, -2)) {
        line_spec q = {0};
        int ok = 0;

        TRY(proper_name(d, r, "lines", &q.name, o->n_line, err));
        if (q.name)
            TRY(read_line(d, r->b, &q, &ok, err));
        if (ok)
            o->line[o->n_line++] = q;
        lua_pop(l, 1);
    }
    lua_pop(l, 1);
    SORT_BY_NAME(o->line, o->n_line)
    return 0;
}

/* Columns of bodies are p0.x, p1.x ... */
static void check_name(const description *d, const case_block *b, const char *what, const char *name)
{
    char *end;

    if (d->n_body && name && *name == 'p' && name[1] >= '0' && name[1] <= '9' &&
        strtol(name + 1, &end, 10) < d->n_body && *end == 0)
        case_wrong(d->c, b, what, "output: %s: \"%s\" is what results call a particle; take another name", what,
                   name);
}

/* Times between files of fields and between rows of tables. */
static void read_every(description *d, reader *r)
{
    output_spec *o = &d->output;
    const double length = d->time.stop - d->time.start, step = d->time.step;

    o->every = 1;
    if (d->time.tolerance > 0 && length > 0)
        o->every = length / 20;
    else if (d->time.unsteady && step > 0) /* about twenty files, after whole steps */
        o->every = step * fmax(1, ceil(length / step / 20 - 1e-9));
    reader_number(r, "every", "time between two files of fields, s", 1e-300, 1e300, &o->every);
    reader_number(r, "tables_every", "time between two rows of the tables, s; else there is one a step", 1e-300,
                  1e300, &o->tables_every);
    if (d->time.unsteady && d->time.tolerance == 0 && step > 0 && o->every < 1e-6 * step)
        case_wrong(d->c, o->block, "every",
                   "output: every = %g is much shorter than a step of %g; it must be at least "
                   "a millionth of it",
                   o->every, step);
    if (d->time.tolerance > 0 && length > 0 && o->every < 1e-9 * length)
        case_wrong(d->c, o->block, "every", "output: every = %g would make %.3g files", o->every,
                   length / o->every);
    if (d->time.unsteady && length > 0 && o->tables_every > 0 && o->tables_every < 1e-9 * length)
        case_wrong(d->c, o->block, "tables_every", "output: tables_every = %g would make %.3g rows",
                   o->tables_every, length / o->tables_every);
}

/* Boundaries whose integrals are wanted: those that stand there, else all. */
static void read_integrals(description *d, reader *r)
{
    output_spec *o = &d->output;
    int n = 0, status = reader_strings(r, "integrals", "boundaries whose integrals are wanted, else all",
                                       MESH_MAX_NAMES, o->integral, &n);

    o->n_integral = status > 0 ? n : -1;
    for (int i = 0; i < n; i++)
        for (int k = 0; k < i; k++)
            if (o->integral[i] && o->integral[k] && strcmp(o->integral[i], o->integral[k]) == 0)
                case_wrong(d->c, r->b, "integrals", "output: integrals: \"%s\" stands there twice", o->integral[i]);
    if (status > 0 && !describe_shows(d, PF_FACET) && !d->incomplete)
        case_wrong(d->c, r->b, "integrals",
                   "output: integrals: no term of the case gives an integral over boundaries; term "
                   "\"show.flow_rate\" {} is one that does");
}

/* A number that coefficients are made with. */
static double positive(reader *r, const char *key, const char *doc)
{
    double v = 1;

    reader_required(r, key, reader_number(r, key, doc, 1e-100, 1e100, &v));
    return v;
}

/* coefficients = { density, velocity, length (in 3D area) }: forces in units of half the dynamic pressure on it. */
static int read_coefficients(description *d, reader *r, error *err)
{
    const case_block *inner;
    double density, velocity, size;
    reader own;

    if (reader_table(r, "coefficients",
                     "coefficients of forces: { density = ..., velocity = ..., length = ... }") <= 0)
        return 0;
    TRY(describe_inner(d, r->b, "output", &inner, err));
    reader_open(&own, d->c, inner, "output: coefficients");
    density = positive(&own, "density", "of the fluid, kg/m^3");
    velocity = positive(&own, "velocity", "of the stream, m/s");
    size = d->dim == 2 ? positive(&own, "length", "across the stream, m")
                       : positive(&own, "area", "across the stream, m^2");
    reader_close(&own);
    d->output.coefficient = 2 / (density * velocity * velocity * size);
    return 0;
}

int describe_output(description *d, registry *plugins, error *err)
{
    output_spec *o = &d->output;
    int n = 0;
    reader r;

    o->block = case_find(d->c, "output", 0);
    reader_open(&r, d->c, o->block, "output");
    read_every(d, &r);
    read_fields(d, plugins, &r);
    read_integrals(d, &r);
    TRY(read_coefficients(d, &r, err));
    TRY(read_probes(d, &r, err));
    TRY(read_lines(d, &r, err));
    reader_strings(&r, "forces", "boundaries whose force (and other reactions) is wanted", MESH_MAX_NAMES, o->force,
                   &n);
    for (int i = 0; i < n; i++)
        for (int k = 0; k < i; k++)
            if (o->force[i] && strcmp(o->force[i], o->force[k]) == 0)
                case_wrong(d->c, r.b, "forces", "output: forces: \"%s\" stands there twice", o->force[i]);
    o->n_force = n;
    for (int i = 0; i < n; i++)
        check_name(d, r.b, "forces", o->force[i]);
    for (int i = 0; i < o->n_probe; i++)
        check_name(d, r.b, "probes", o->probe[i].name);
    reader_vector(&r, "about", "point that torques refer to", d->dim, o->about);
    reader_close(&r);
    return 0;
}
