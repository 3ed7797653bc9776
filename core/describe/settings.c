/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * time{}, solve{}, initial{}, exact{} and offset{} of a case. */
#include "describe/describe.h"

#include <lua.h>

#include <string.h>

/* A field that lives on bodies: they say themselves how they start. */
static void refuse_of_bodies(description *d, reader *r, const field_spec *f)
{
    if (!reader_note(r, f->name, f->doc))
        return;
    if (strcmp(r->what, "initial") == 0)
        case_wrong(d->c, r->b, f->name,
                   "initial: \"%s\" (%s) is of the bodies, each of which has its own: particle { %s = ... }",
                   f->name, f->doc, f->shape == PF_SPIN ? "spin" : "velocity");
    else
        case_wrong(d->c, r->b, f->name,
                   "%s: \"%s\" (%s) is of the bodies; here only fields of the mesh have a meaning", r->what,
                   f->name, f->doc);
}

static void read_fields(description *d, const char *kind, value *v, int *has)
{
    reader r;

    reader_open(&r, d->c, case_find(d->c, kind, 0), kind);
    r.noun = "field";
    for (int f = 0; f < d->fields.n; f++)
        if (d->fields.f[f].support != PF_ON_PARTICLE ||
            (v == d->initial && f != describe_motion(d, 0) && f != describe_motion(d, 1)))
            has[f] = describe_value(&r, d->fields.f[f].name, d->fields.f[f].doc, d->fields.f[f].n_comp, d->dim,
                                    &v[f]) > 0;
    if (v == d->initial)
        describe_initial_kept(d, &r);
    for (int f = 0; f < d->fields.n; f++)
        if (d->fields.f[f].support == PF_ON_PARTICLE && !has[f] && reader_has(&r, d->fields.f[f].name) &&
            !reader_asked(&r, d->fields.f[f].name))
            refuse_of_bodies(d, &r, &d->fields.f[f]);
    if (!d->incomplete)
        reader_close(&r);
}

static void check_time(description *d, const case_block *b, const time_spec *t)
{
    const double length = t->stop - t->start;

    const char *end = t->steady > 0 ? "at_most" : "stop";

    if (!(length > 0))
        case_wrong(d->c, b, end, "time: %s = %g is not after start = %g", end, t->stop, t->start);
    else if (t->step > length * (1 + 1e-9))
        case_wrong(d->c, b, "step", "time: step = %g is longer than the whole run, from start = %g to %s = %g",
                   t->step, t->start, end, t->stop);
    else if (t->tolerance == 0 && length / t->step > 1e9)
        case_wrong(d->c, b, "step", "time: %.3g steps are too many; is the step (%g) right?", length / t->step,
                   t->step);
}

/* stop = T, or stop = "steady" with at_most = T.  1 if it is known then. */
static int read_stop(description *d, reader *r)
{
    static const char *const word[] = {"steady", NULL};
    time_spec *t = &d->time;
    int which = 0, status;

    if (reader_type(r, "stop") != LUA_TSTRING) {
        status = reader_number(r, "stop", "time at which the run ends, s; or \"steady\"", -1e300, 1e300, &t->stop);
        reader_required(r, "stop", status);
        for (int i = 0; i < 2; i++)
            if (reader_note(r, i ? "steady" : "at_most", "with stop = \"steady\""))
                case_wrong(d->c, r->b, i ? "steady" : "at_most", "time: \"%s\" goes with stop = \"steady\" only",
                           i ? "steady" : "at_most");
        return status > 0;
    }
    t->steady = 1e-4;
    reader_choice(r, "stop", "a number of seconds, without quotes, or", word, &which);
    reader_number(r, "steady", "relative change of the flow, within the time up to at_most, that is none", 1e-14, 1,
                  &t->steady);
    status = reader_number(r, "at_most", "time at which the run ends if the flow is not steady by then, s", -1e300,
                           1e300, &t->stop);
    reader_required(r, "at_most", status);
    return status > 0;
}

/* Part of a run that the first of the steps that choose their length takes. */
#define FIRST_STEP 1e-3

static void read_time(description *d)
{
    static const char *const scheme[] = {"bdf1", "bdf2", NULL};
    const case_block *b = case_find(d->c, "time", 0);
    time_spec *t = &d->time;
    int order = 1, step, stop, start, tolerance;
    reader r;

    if (!b)
        return;
    t->unsteady = 1;
    reader_open(&r, d->c, b, "time");
    reader_choice(&r, "scheme", "time scheme", scheme, &order);
    t->order = order + 1;
    tolerance = reader_number(&r, "tolerance", "error of velocities that steps choose their length by, relative",
                              1e-8, 0.5, &t->tolerance);
    step = reader_number(&r, "step",
                         "length of a time step, s; with tolerance = 1e-3, or another, steps choose their length, "
                         "and this is the first",
                         1e-300, 1e300, &t->step);
    stop = read_stop(d, &r);
    start = reader_number(&r, "start", "time at which the run starts, s", -1e300, 1e300, &t->start);
    reader_integer(&r, "geometry_iterations",
                   "how often bodies are placed anew within a step, with the motion found", 0, 20,
                   &t->geometry_iterations);
    if (tolerance == 0)
        reader_required(&r, "step", step);
    if (tolerance > 0 && t->order == 1)
        case_wrong(d->c, b, "scheme", "time: steps choose their length (tolerance) with scheme = \"bdf2\" only");
    reader_close(&r);
    if (step == 0 && tolerance > 0) /* short: it grows soon if it may */
        t->step = FIRST_STEP * (t->stop - t->start);
    if ((step > 0 || (step == 0 && tolerance > 0)) && stop && start >= 0)
        check_time(d, b, t);
    else if (stop && start >= 0 && t->stop <= t->start)
        case_wrong(d->c, b, "stop", "time: stop = %g is not after start = %g", t->stop, t->start);
}

/* The parameters of all terms by this name start at `from`. */
static void continue_in(description *d, const case_block *b, const char *name, double from)
{
    solve_spec *c = &d->solve;
    int found = 0;

    for (int i = 0; i < d->law.n; i++)
        if (term_publishes(d->law.use[i].term, name) >= 0) {
            case_wrong(d->c, b, "continuation",
                       "solve: continuation: \"%s\" is published by %s.%s; continue in a number of that term", name,
                       d->law.use[i].plugin->d.name, d->law.use[i].term->name);
            return;
        }
    for (int i = 0; i < d->n_use + d->law.n; i++) {
        const term_use *u = i < d->n_use ? &d->use[i] : &d->law.use[i - d->n_use];
        const pf_param *q = describe_param(u, name);
        double *at = q ? (double *)(void *)((char *)u->params + q->offset) : NULL;

        if (!q || q->type != PF_T_REAL || c->n_continued == DESCRIBE_MAX_CONTINUED)
            continue;
        found = 1;
        c->continued[c->n_continued] = at;
        c->from[c->n_continued] = from;
        c->to[c->n_continued++] = *at;
        if (!(from * *at > 0))
            case_wrong(d->c, b, "continuation",
                       "solve: continuation in \"%s\" goes from %g to %g; both must be of one sign and not zero",
                       name, from, *at);
    }
    if (!found && !d->incomplete)
        case_wrong(d->c, b, "continuation", "solve: no term has a number called \"%s\" to continue in", name);
}

/* solve { continuation = { viscosity = 0.1 } }: the parameter starts there. */
static void read_continuation(description *d, reader *r)
{
    lua_State *l = d->c->lua;

    if (reader_table(r, "continuation", "parameters of terms and where they start: { viscosity = 0.1 }") <= 0)
        return;
    lua_pushnil(l);
    while (lua_next(l, -2)) {
        if (lua_type(l, -2) == LUA_TSTRING && lua_type(l, -1) == LUA_TNUMBER)
            continue_in(d, r->b, lua_tostring(l, -2), lua_tonumber(l, -1));
        else
            case_wrong(d->c, r->b, "continuation",
                       "solve: continuation: expected parameters and where they start, as in { viscosity = 0.1 }");
        lua_pop(l, 1);
    }
    lua_pop(l, 1);
}

/* Newton's method in a time step stops when its residual is this part of the prediction's: what is left is then
 * small against the error of the step, of which the prediction's is a few. */
#define STEP_FALL 1e-3

/* What is left of a linear system in a time step, at most: what is left in one step is in the history of the next.
 * Where disks crowd, more than this grows. */
#define STEP_LINEAR 1e-5

static int read_solve(description *d, registry *plugins, error *err)
{
    solve_spec *o = &d->solve;
    reader r;

    *o = (solve_spec){.tolerance = 1e-11,
                      .max_iterations = 25,
                      .linear_tolerance = d->time.unsteady ? STEP_LINEAR : 0.1,
                      .coarse_start = -1,
                      .fall = d->time.unsteady ? STEP_FALL : 0};
    reader_open(&r, d->c, case_find(d->c, "solve", 0), "solve");
    if (reader_number(&r, "tolerance", "Newton stops when every field's residual is this small, relative", 1e-15,
                      0.1, &o->tolerance) > 0)
        o->fall = 0;
    reader_integer(&r, "max_iterations", "of Newton", 1, DESCRIBE_MAX_ITERATIONS, &o->max_iterations);
    reader_number(&r, "linear_tolerance",
                  "what GMRES with old factors may leave of a residual, at most; 0: factor every matrix", 0, 0.1,
                  &o->linear_tolerance);
    reader_string(&r, "solver",
                  "linear solver, a plugin: \"umfpack\", \"block\"; \"auto\" chooses by predicted cost",
                  &o->solver);
    if (o->solver && strcmp(o->solver, "auto") == 0)
        o->solver = NULL;
    TRY(describe_solver(d, plugins, &r, err));
    reader_bool(&r, "coarse_start", "whether a steady case on a box starts from the solution on half as many cells",
                &o->coarse_start);
    read_continuation(d, &r);
    reader_close(&r);
    return 0;
}

int describe_settings(description *d, registry *r, error *err)
{
    read_fields(d, "initial", d->initial, d->has_initial);
    read_fields(d, "exact", d->exact, d->has_exact);
    read_fields(d, "offset", d->offset, d->has_offset);
    read_time(d);
    return read_solve(d, r, err);
}
