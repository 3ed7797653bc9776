/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * time{}, solve{}, initial{}, exact{} and offset{} of a case. */
#include "describe/describe.h"

#include <lauxlib.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

static void read_fields(description *d, const char *kind, value *v, int *has)
{
    reader r;

    reader_open(&r, d->c, case_find(d->c, kind, 0), kind);
    for (int f = 0; f < d->fields.n; f++) {
        const field_spec *g = &d->fields.f[f];

        has[f] = reader_value(&r, g->name, g->doc, g->n_comp, d->dim, &v[f]) > 0;
    }
    if (!d->incomplete)
        reader_close(&r);
}

static void read_time(description *d)
{
    static const char *const scheme[] = {"bdf1", "bdf2", NULL};
    const case_block *b = case_find(d->c, "time", 0);
    time_spec *t = &d->time;
    int order = 1;
    reader r;

    if (!b)
        return;
    t->unsteady = 1;
    reader_open(&r, d->c, b, "time");
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
        case_wrong(d->c, b, "stop", "time: stop = %g is not after start = %g", t->stop, t->start);
    if (t->step > 0 && (t->stop - t->start) / t->step > 1e9)
        case_wrong(d->c, b, "step", "time: %.3g steps are too many; is the step (%g) right?",
                   (t->stop - t->start) / t->step, t->step);
}

/* solve { continuation = { viscosity = 0.1 } }: the parameter starts there. */
static void read_continuation(description *d, reader *r)
{
    lua_State *l = d->c->lua;
    solve_spec *c = &d->solve;

    if (reader_table(r, "continuation", "parameters of terms and where they start: { viscosity = 0.1 }") <= 0)
        return;
    lua_pushnil(l);
    while (lua_next(l, -2)) {
        const char *name = lua_type(l, -2) == LUA_TSTRING ? lua_tostring(l, -2) : "";
        double from = lua_tonumber(l, -1);
        int found = 0;

        lua_pop(l, 1);
        for (int i = 0; i < d->n_use; i++)
            for (uint32_t k = 0; k < d->use[i].term->n_param; k++) {
                const pf_param *q = &d->use[i].term->param[k];
                double *at = (double *)(void *)((char *)d->use[i].params + q->offset);

                if (strcmp(q->name, name) != 0 || q->type != PF_T_REAL || c->n_continued == DESCRIBE_MAX_CONTINUED)
                    continue;
                found = 1;
                c->continued[c->n_continued] = at;
                c->from[c->n_continued] = from;
                c->to[c->n_continued++] = *at;
                if (!(from * *at > 0))
                    case_wrong(
                        d->c, r->b, "continuation",
                        "solve: continuation in \"%s\" goes from %g to %g; both must be of one sign and not zero",
                        name, from, *at);
            }
        if (!found)
            case_wrong(d->c, r->b, "continuation", "solve: no term has a number called \"%s\" to continue in",
                       name);
    }
    lua_pop(l, 1);
}

static void read_solve(description *d)
{
    solve_spec *o = &d->solve;
    reader r;

    *o = (solve_spec){.tolerance = 1e-11, .max_iterations = 25, .linear_tolerance = d->time.unsteady ? 1e-6 : 0};
    reader_open(&r, d->c, case_find(d->c, "solve", 0), "solve");
    reader_number(&r, "tolerance", "Newton stops when every field's residual is this small, relative", 1e-15, 0.1,
                  &o->tolerance);
    reader_integer(&r, "max_iterations", "of Newton", 1, DESCRIBE_MAX_ITERATIONS, &o->max_iterations);
    reader_number(&r, "linear_tolerance", "of GMRES with old factors; 0: factor every matrix", 0, 0.1,
                  &o->linear_tolerance);
    read_continuation(d, &r);
    reader_close(&r);
}

void describe_settings(description *d)
{
    read_fields(d, "initial", d->initial, d->has_initial);
    read_fields(d, "exact", d->exact, d->has_exact);
    read_fields(d, "offset", d->offset, d->has_offset);
    read_time(d);
    read_solve(d);
}
