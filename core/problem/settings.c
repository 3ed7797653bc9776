/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * time{}, output{}, solve{}, initial{} and exact{} of a case. */
#include "problem/problem.h"

#include <lauxlib.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

static void read_fields(problem *p, const char *kind, value *v, int *has)
{
    reader r;

    reader_open(&r, p->c, case_find(p->c, kind, 0), kind);
    for (int f = 0; f < p->space.n_field; f++) {
        const space_field *g = &p->space.field[f];

        has[f] = reader_value(&r, g->name, g->doc, g->n_comp, p->dim, &v[f]) > 0;
    }
    reader_close(&r);
}

static void read_time(problem *p)
{
    static const char *const scheme[] = {"bdf1", "bdf2", NULL};
    const case_block *b = case_find(p->c, "time", 0);
    problem_time *t = &p->time;
    int order = 1;
    reader r;

    if (!b)
        return;
    t->unsteady = 1;
    reader_open(&r, p->c, b, "time");
    reader_choice(&r, "scheme", "time scheme", scheme, &order);
    t->order = order + 1;
    reader_required(&r, "step", reader_number(&r, "step", "length of a time step, s", 1e-300, 1e300, &t->step));
    reader_required(&r, "stop",
                    reader_number(&r, "stop", "time at which the run ends, s", -1e300, 1e300, &t->stop));
    reader_number(&r, "start", "time at which the run starts, s", -1e300, 1e300, &t->start);
    reader_integer(&r, "geometry_iterations",
                   "how often bodies are placed anew within a step, with the motion found", 0, 20,
                   &t->geometry_iterations);
    reader_close(&r);
    if (t->step > 0 && t->stop <= t->start)
        case_wrong(p->c, b, "stop", "time: stop = %g is not after start = %g", t->stop, t->start);
    if (t->step > 0 && (t->stop - t->start) / t->step > 1e9)
        case_wrong(p->c, b, "step", "time: %.3g steps are too many; is the step (%g) right?",
                   (t->stop - t->start) / t->step, t->step);
}

static void field_list(problem *p, reader *r)
{
    problem_output *o = &p->output;
    const char *list[SPACE_MAX_FIELDS], *name[SPACE_MAX_FIELDS];
    int n, status = reader_strings(r, "fields", "fields to write", SPACE_MAX_FIELDS, list, &n);

    for (int f = 0; f < p->space.n_field; f++) {
        name[f] = p->space.field[f].name;
        if (status <= 0 && p->space.field[f].support == PF_ON_MESH)
            o->field[o->n_field++] = f;
    }
    for (int i = 0; status > 0 && i < n; i++) {
        int f = space_find_field(&p->space, list[i]);
        const char *near = text_nearest(list[i], name, (size_t)p->space.n_field);

        if (f >= 0 && p->space.field[f].support == PF_ON_MESH)
            o->field[o->n_field++] = f;
        else
            case_wrong(p->c, r->b, "fields", "output: there is no field \"%s\"%s%s%s", list[i],
                       near ? "; did you mean \"" : "", near ? near : "", near ? "\"?" : "");
    }
}

/* Reads n numbers under `key` of the table on top of the stack. */
static int point(problem *p, const char *key, double *x)
{
    lua_State *l = p->c->lua;
    int ok;

    if (key)
        lua_getfield(l, -1, key);
    else
        lua_pushvalue(l, -1);
    ok = lua_istable(l, -1) && (int)lua_rawlen(l, -1) == p->dim;
    for (int k = 0; ok && k < p->dim; k++) {
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

static int proper_name(problem *p, reader *r, const char *key, const char **name, int n, int most)
{
    lua_State *l = p->c->lua;

    if (lua_type(l, -2) != LUA_TSTRING || !is_name(lua_tostring(l, -2)) || n == most) {
        case_wrong(p->c, r->b, key,
                   "output: %s: every entry needs a name of its own (letters, digits, _), at most %d", key, most);
        return 0;
    }
    *name = arena_strdup(&p->memory, lua_tostring(l, -2));
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

static void read_probes(problem *p, reader *r)
{
    problem_output *o = &p->output;
    lua_State *l = p->c->lua;

    if (reader_table(r, "probes", "points: name = {x, y[, z]}") > 0) {
        lua_pushnil(l);
        while (lua_next(l, -2)) {
            probe *q = &o->probe[o->n_probe];

            if (proper_name(p, r, "probes", &q->name, o->n_probe, PROBLEM_MAX_PROBES)) {
                if (point(p, NULL, q->x))
                    o->n_probe++;
                else
                    case_wrong(p->c, r->b, "probes", "output: probe \"%s\" needs %d coordinates in braces", q->name,
                               p->dim);
            }
            lua_pop(l, 1);
        }
        lua_pop(l, 1);
        SORT_BY_NAME(o->probe, o->n_probe)
    }
    if (reader_table(r, "lines", "lines: name = { from = {...}, to = {...}, points = n }") > 0) {
        lua_pushnil(l);
        while (lua_next(l, -2)) {
            line_probe *q = &o->line[o->n_line];

            if (proper_name(p, r, "lines", &q->name, o->n_line, PROBLEM_MAX_PROBES)) {
                int ok = lua_istable(l, -1) && point(p, "from", q->from) && point(p, "to", q->to);

                q->n = 101;
                if (ok && lua_getfield(l, -1, "points") == LUA_TNUMBER)
                    q->n = (int)lua_tonumber(l, -1);
                if (ok)
                    lua_pop(l, 1);
                if (ok && q->n >= 2 && q->n <= 10000000)
                    o->n_line++;
                else
                    case_wrong(
                        p->c, r->b, "lines",
                        "output: line \"%s\" needs from and to (%d coordinates each), and points of 2 or more",
                        q->name, p->dim);
            }
            lua_pop(l, 1);
        }
        lua_pop(l, 1);
        SORT_BY_NAME(o->line, o->n_line)
    }
}

static void read_output(problem *p)
{
    problem_output *o = &p->output;
    double about[3] = {0};
    int n = 0;
    reader r;

    o->block = case_find(p->c, "output", 0);
    reader_open(&r, p->c, o->block, "output");
    o->every = p->time.unsteady ? (p->time.stop - p->time.start) / 20 : 1;
    reader_number(&r, "every", "time between two files of fields, s", 1e-300, 1e300, &o->every);
    field_list(p, &r);
    read_probes(p, &r);
    reader_strings(&r, "forces", "boundaries whose force (and other reactions) is wanted", MESH_MAX_NAMES,
                   o->force_name, &n);
    for (int i = 0; i < n; i++)
        for (int k = 0; k < i; k++)
            if (o->force_name[i] && strcmp(o->force_name[i], o->force_name[k]) == 0)
                case_wrong(p->c, r.b, "forces", "output: forces: \"%s\" stands there twice", o->force_name[i]);
    o->n_force = n;
    reader_vector(&r, "about", "point that torques refer to", p->dim, about);
    for (int i = 0; i < n; i++)
        memcpy(o->force[i].about, about, sizeof about);
    reader_close(&r);
}

/* solve { continuation = { viscosity = 0.1 } }: the parameter starts there. */
static void read_continuation(problem *p, reader *r)
{
    lua_State *l = p->c->lua;
    continuation *c = &p->continuation;

    if (reader_table(r, "continuation", "parameters of terms and where they start: { viscosity = 0.1 }") <= 0)
        return;
    lua_pushnil(l);
    while (lua_next(l, -2)) {
        const char *name = lua_type(l, -2) == LUA_TSTRING ? lua_tostring(l, -2) : "";
        double from = lua_tonumber(l, -1);
        int found = 0;

        lua_pop(l, 1);
        for (int i = 0; i < p->n_use; i++)
            for (uint32_t k = 0; k < p->use[i].term->n_param; k++) {
                const pf_param *q = &p->use[i].term->param[k];
                double *at = (double *)(void *)((char *)p->use[i].params + q->offset);

                if (strcmp(q->name, name) != 0 || q->type != PF_T_REAL || c->n_parameter == 16)
                    continue;
                found = 1;
                c->parameter[c->n_parameter] = at;
                c->from[c->n_parameter] = from;
                c->to[c->n_parameter++] = *at;
                if (!(from * *at > 0))
                    case_wrong(
                        p->c, r->b, "continuation",
                        "solve: continuation in \"%s\" goes from %g to %g; both must be of one sign and not zero",
                        name, from, *at);
            }
        if (!found)
            case_wrong(p->c, r->b, "continuation", "solve: no term has a number called \"%s\" to continue in",
                       name);
    }
    lua_pop(l, 1);
}

static void read_solve(problem *p)
{
    reader r;

    p->newton =
        (newton_options){.tolerance = 1e-11, .max_iterations = 25, .linear_tolerance = p->time.unsteady ? 1e-6 : 0};
    reader_open(&r, p->c, case_find(p->c, "solve", 0), "solve");
    reader_number(&r, "tolerance", "Newton stops when every field's residual is this small, relative", 1e-15, 0.1,
                  &p->newton.tolerance);
    reader_integer(&r, "max_iterations", "of Newton", 1, NEWTON_MAX_ITERATIONS, &p->newton.max_iterations);
    reader_number(&r, "linear_tolerance", "of GMRES with old factors; 0: factor every matrix", 0, 0.1,
                  &p->newton.linear_tolerance);
    read_continuation(p, &r);
    reader_close(&r);
}

int problem_read_settings(problem *p, error *err)
{
    (void)err;
    read_fields(p, "initial", p->initial, p->has_initial);
    read_fields(p, "exact", p->exact, p->has_exact);
    read_fields(p, "offset", p->offset, p->has_offset);
    read_time(p);
    read_output(p);
    read_solve(p);
    return 0;
}

int problem_make_outputs(problem *p, error *err)
{
    problem_output *o = &p->output;

    for (int i = 0; i < o->n_force; i++) {
        o->force[i].boundary = mesh_find_name(&p->mesh, o->force_name[i]);
        for (int k = 0; k < p->mesh.n_period; k++)
            if (o->force[i].boundary >= 0 &&
                (p->mesh.period[k][0] == o->force[i].boundary || p->mesh.period[k][1] == o->force[i].boundary))
                case_wrong(p->c, o->block, "forces", "output: forces: \"%s\" is periodic; no force acts on it",
                           o->force_name[i]);
        if (o->force[i].boundary < 0) {
            const char *near =
                text_nearest(o->force_name[i], (const char *const *)p->mesh.name, (size_t)p->mesh.n_name);

            case_wrong(p->c, o->block, "forces", "output: forces: no boundary is called \"%s\"%s%s%s",
                       o->force_name[i], near ? "; did you mean \"" : "", near ? near : "", near ? "\"?" : "");
        }
    }
    return case_finish(p->c, err);
}
