/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * output{} of a case. */
#include "describe/describe.h"

#include <lauxlib.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

static void read_fields(description *d, reader *r)
{
    output_spec *o = &d->output;
    const char *list[TERM_MAX_FIELDS], *name[TERM_MAX_FIELDS];
    int n, status = reader_strings(r, "fields", "fields to write", TERM_MAX_FIELDS, list, &n);

    for (int f = 0; f < d->fields.n; f++) {
        name[f] = d->fields.f[f].name;
        if (status <= 0 && d->fields.f[f].support == PF_ON_MESH)
            o->field[o->n_field++] = f;
    }
    for (int i = 0; status > 0 && i < n; i++) {
        int f = fields_find(&d->fields, list[i]);
        const char *near = text_nearest(list[i], name, (size_t)d->fields.n);

        if (f >= 0 && d->fields.f[f].support == PF_ON_MESH)
            o->field[o->n_field++] = f;
        else
            case_wrong(d->c, r->b, "fields", "output: there is no field \"%s\"%s%s%s", list[i],
                       near ? "; did you mean \"" : "", near ? near : "", near ? "\"?" : "");
    }
}

/* Reads n numbers under `key` of the table on top of the stack. */
static int point(description *d, const char *key, double *x)
{
    lua_State *l = d->c->lua;
    int ok;

    if (key)
        lua_getfield(l, -1, key);
    else
        lua_pushvalue(l, -1);
    ok = lua_istable(l, -1) && (int)lua_rawlen(l, -1) == d->dim;
    for (int k = 0; ok && k < d->dim; k++) {
        lua_rawgeti(l, -1, k + 1);
        ok = lua_type(l, -1) == LUA_TNUMBER;
        x[k] = lua_tonumber(l, -1);
        lua_pop(l, 1);
    }
    lua_pop(l, 1);
    return ok;
}

static int is_name(const char *s)
{
    return *s && s[strspn(s, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_")] == 0 &&
           strlen(s) < 40;
}

static int proper_name(description *d, reader *r, const char *key, const char **name, int n, int most)
{
    lua_State *l = d->c->lua;

    if (lua_type(l, -2) != LUA_TSTRING || !is_name(lua_tostring(l, -2)) || n == most) {
        case_wrong(d->c, r->b, key,
                   "output: %s: every entry needs a name of its own (letters, digits, _), at most %d", key, most);
        return 0;
    }
    *name = arena_strdup(&d->memory, lua_tostring(l, -2));
    return *name != NULL;
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

static void read_probes(description *d, reader *r)
{
    output_spec *o = &d->output;
    lua_State *l = d->c->lua;

    if (reader_table(r, "probes", "points: name = {x, y[, z]}") > 0) {
        lua_pushnil(l);
        while (lua_next(l, -2)) {
            probe_spec *q = &o->probe[o->n_probe];

            if (proper_name(d, r, "probes", &q->name, o->n_probe, DESCRIBE_MAX_PROBES)) {
                if (point(d, NULL, q->x))
                    o->n_probe++;
                else
                    case_wrong(d->c, r->b, "probes", "output: probe \"%s\" needs %d coordinates in braces", q->name,
                               d->dim);
            }
            lua_pop(l, 1);
        }
        lua_pop(l, 1);
        SORT_BY_NAME(o->probe, o->n_probe)
    }
    if (reader_table(r, "lines", "lines: name = { from = {...}, to = {...}, points = n }") > 0) {
        lua_pushnil(l);
        while (lua_next(l, -2)) {
            line_spec *q = &o->line[o->n_line];

            if (proper_name(d, r, "lines", &q->name, o->n_line, DESCRIBE_MAX_PROBES)) {
                int ok = lua_istable(l, -1) && point(d, "from", q->from) && point(d, "to", q->to);

                q->n = 101;
                if (ok && lua_getfield(l, -1, "points") == LUA_TNUMBER)
                    q->n = (int)lua_tonumber(l, -1);
                if (ok)
                    lua_pop(l, 1);
                if (ok && q->n >= 2 && q->n <= 10000000)
                    o->n_line++;
                else
                    case_wrong(
                        d->c, r->b, "lines",
                        "output: line \"%s\" needs from and to (%d coordinates each), and points of 2 or more",
                        q->name, d->dim);
            }
            lua_pop(l, 1);
        }
        lua_pop(l, 1);
        SORT_BY_NAME(o->line, o->n_line)
    }
}

void describe_output(description *d)
{
    output_spec *o = &d->output;
    int n = 0;
    reader r;

    o->block = case_find(d->c, "output", 0);
    reader_open(&r, d->c, o->block, "output");
    o->every = 1;
    if (d->time.unsteady && d->time.step > 0) /* about twenty files, after whole steps */
        o->every = d->time.step * fmax(1, ceil((d->time.stop - d->time.start) / d->time.step / 20 - 1e-9));
    reader_number(&r, "every", "time between two files of fields, s", 1e-300, 1e300, &o->every);
    read_fields(d, &r);
    read_probes(d, &r);
    reader_strings(&r, "forces", "boundaries whose force (and other reactions) is wanted", MESH_MAX_NAMES, o->force,
                   &n);
    for (int i = 0; i < n; i++)
        for (int k = 0; k < i; k++)
            if (o->force[i] && strcmp(o->force[i], o->force[k]) == 0)
                case_wrong(d->c, r.b, "forces", "output: forces: \"%s\" stands there twice", o->force[i]);
    o->n_force = n;
    reader_vector(&r, "about", "point that torques refer to", d->dim, o->about);
    reader_close(&r);
}
