/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What terms show: evaluated when a row or a file is due, at the solution as the equations see it (a reduced
 * pressure without its hydrostatic part), with rates by the scheme of the last step. */
#include "run/showing.h"

#include "solve/shown.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct showing {
    shown shown;
    int evaluated, projected; /* of the solution that r->x is */
    int rated;                /* some term reads rates        */
    double *dot, *history;    /* [n_dof] */
    double *row;              /* of integrals.csv */
    moving_frame frame;       /* paths of rates near moving bodies; memory is that of now */
};

/* --- the terms --- */

/* Whether a term on all cells reads a field that is in the fluid only. */
static int is_of_fluid(const problem *p, const term_use *u)
{
    int of_fluid = 0;

    for (uint32_t k = 0; k < u->term->n_in && p->bodies.n; k++) {
        int f = term_slot_field(&u->term->in[k]) ? space_find_field(&p->space, u->term->in[k].field) : -1;

        of_fluid |= f >= 0 && p->bodies.fluid_only[f];
    }
    return of_fluid;
}

/* A rate near bodies that move comes along their paths, which only fields whose equation has a rate have. */
static int check_rates(const problem *p, const term_use *u, error *err)
{
    for (uint32_t k = 0; k < u->term->n_in; k++) {
        const pf_slot *slot = &u->term->in[k];
        int f = slot->eval == PF_DOT ? space_find_field(&p->space, slot->field) : -1;

        if (f >= 0 && describe_moves(&p->description) && p->bodies.fluid_only[f] &&
            !(bodies_rated(&p->bodies) >> f & 1))
            return error_set(err, ERR_CASE,
                             "term %s.%s reads d/dt of \"%s\", which near bodies that move is known only where an "
                             "equation has it; no term of the case does",
                             u->plugin->d.name, u->term->name, slot->field);
    }
    return 0;
}

static int make_shown(run *r, showing *s, error *err)
{
    problem *p = r->p;
    description *d = &p->description;
    assembly_spec spec[PF_PAIR + 2] = {{0}};
    term_use *on[PF_PAIR + 1][DESCRIBE_MAX_TERMS];
    int n = 0, n_on[PF_PAIR + 1] = {0};
    uint8_t *all;

    for (int i = 0; i < d->shown.n; i++) {
        term_use *u = &d->shown.use[i];
        int where = u->where == PF_CELL && is_of_fluid(p, u) ? PF_FLUID : u->where;

        if (u->replaced)
            continue;
        where = where == PF_FLUID && d->n_body == 0 ? PF_CELL : where;
        on[where][n_on[where]++] = u;
        s->rated |= shown_needs_step(u->term);
        TRY(check_rates(p, u, err));
    }
    ARENA_NEW(&r->memory, all, p->mesh.n_facet + 1, err);
    memset(all, 1, (size_t)p->mesh.n_facet);
    for (int where = PF_CELL; where <= PF_PAIR; where++) {
        const cut_rule *cut = &p->bodies.cut;

        if (!n_on[where])
            continue;
        spec[n++] = (assembly_spec){.where = where,
                                    .use = on[where],
                                    .n_use = n_on[where],
                                    .facet_on = all,
                                    .rule = where == PF_SOLID ? cut : NULL};
        if (where == PF_FLUID) { /* whole cells, and then cut ones */
            spec[n] = spec[n - 1];
            spec[n++].rule = cut;
        }
    }
    TRY(shown_create(&s->shown, &p->space, &d->shown_fields, spec, n, p->n_thread, err));
    s->shown.assembly.walls = p->bodies.has_walls ? &p->bodies.walls : NULL;
    return 0;
}

int showing_open(run *r, error *err)
{
    showing *s;

    if (r->p->description.shown.n == 0)
        return 0;
    ARENA_NEW(&r->memory, s, 1, err);
    r->showing = s;
    ARENA_NEW(&r->memory, s->dot, r->p->space.n_dof, err);
    ARENA_NEW(&r->memory, s->history, r->p->space.n_dof, err);
    return make_shown(r, s, err);
}

void showing_close(run *r)
{
    if (r->showing)
        shown_destroy(&r->showing->shown);
}

void showing_forget(run *r)
{
    if (r->showing)
        r->showing->evaluated = r->showing->projected = 0;
}

/* --- their values --- */

/* Rates of the last step: those of its scheme, near moving bodies along their paths. */
static void take_rates(const run *r, assembly_state *at)
{
    problem *p = r->p;
    const state *s = &p->state;
    showing *w = r->showing;
    const bdf b = bdf_of(s->n_history > 1 ? r->stepper->order : 1, s->dt_previous, s->dt_before);

    at->shift = b.shift;
    at->old = s->before;
    for (int64_t i = 0; i < s->n_dof; i++) {
        w->history[i] = b.c[0] * s->before[i] + b.c[1] * s->before2[i];
        w->dot[i] = b.shift * s->x[i] + w->history[i];
    }
    if (p->bodies.n) {
        const moving_frame *f =
            bodies_paths(&p->bodies, p->bodies.now, b.order, b.c, (const double *[]){s->before, s->before2},
                         (const pose *[]){s->pose_before, s->pose_before2}, w->history);

        if (f) {
            w->frame = *f;
            w->frame.before = NULL;
            at->frame = &w->frame;
        }
    }
}

static int evaluate(run *r, error *err)
{
    problem *p = r->p;
    showing *s = r->showing;
    assembly_state at = {.t = r->taken,
                         .dt = p->state.dt_previous,
                         .x = r->x,
                         .dot = s->dot,
                         .old = r->x,
                         .kept = p->state.kept,
                         .fluid = (const double(*)[6])p->state.fluid,
                         .bodies = problem_points(p)};

    if (s->evaluated)
        return 0;
    if (s->rated && p->state.n_history > 0)
        take_rates(r, &at);
    TRY(shown_evaluate(&s->shown, at, err));
    if (p->bodies.n)
        TRY(bodies_check(&p->bodies, err)); /* paths asked for their levels */
    s->evaluated = 1;
    return 0;
}

int showing_look(run *r, const assembly_state *at, error *err)
{
    return r->showing ? shown_evaluate(&r->showing->shown, *at, err) : 0;
}

/* Whether a term has nothing to say yet: it reads rates, and no step has been made. */
static int is_early(const run *r, const term_use *u)
{
    return r->p->description.time.unsteady && r->p->state.n_history == 0 && shown_needs_step(u->term);
}

/* --- tables --- */

/* [name of the line.]prefix slot[_component] */
static void name_columns(const shown_integral *q, const char *prefix, char (*name)[96], const char **unit)
{
    const field_spec like = {.name = q->slot->name, .n_comp = q->n_comp, .shape = (int)q->slot->shape};

    char full[80];

    snprintf(full, sizeof full, "%.24s%s%s", q->use->label ? q->use->label : "", q->use->label ? "." : "", prefix);
    output_components(&like, full, name);
    for (int k = 0; k < q->n_comp; k++)
        unit[k] = q->slot->unit;
}

/* Number of a boundary whose integrals are wanted. */
static int boundary(const run *r, int i)
{
    const output_spec *o = &r->p->description.output;

    return o->n_integral < 0 ? i : mesh_find_name(&r->p->mesh, o->integral[i]);
}

static int n_boundary(const run *r)
{
    const output_spec *o = &r->p->description.output;

    return o->n_integral < 0 ? r->p->mesh.n_name : o->n_integral;
}

/* Columns of integrals.csv behind t: name and unit, or (name NULL) the values. */
static int list_columns(const run *r, char (*name)[96], const char **unit, double *value)
{
    const shown *s = &r->showing->shown;
    int n = 0;

    for (int i = 0; i < s->n_integral; i++) {
        const shown_integral *q = &s->integral[i];

        for (int b = 0; b < (q->per == SHOWN_BOUNDARY ? n_boundary(r) : q->per == SHOWN_WHOLE); b++) {
            const int of = q->per == SHOWN_BOUNDARY ? boundary(r, b) : 0;
            char prefix[50] = "";

            if (q->per == SHOWN_BOUNDARY)
                snprintf(prefix, sizeof prefix, "%.48s.", r->p->mesh.name[of]);
            if (name)
                name_columns(q, prefix, name + n, unit + n);
            for (int k = 0; value && k < q->n_comp; k++)
                value[n + k] = is_early(r, q->use) ? NAN : q->value[of * q->n_comp + k];
            n += q->n_comp;
        }
    }
    return n;
}

static int count_columns(const run *r)
{
    const shown *s = &r->showing->shown;
    int n = 0;

    for (int i = 0; i < s->n_integral; i++)
        n += s->integral[i].n_comp *
             (s->integral[i].per == SHOWN_BOUNDARY ? n_boundary(r) : s->integral[i].per == SHOWN_WHOLE);
    return n;
}

static void add_unit(text *units, const char *name, const char *unit, int first)
{
    text_add(units, "%s", first ? "" : ", ");
    text_json(units, name);
    text_add(units, ": ");
    text_json(units, unit);
}

static int plan_bodies(const run *r, text *units, error *err)
{
    char name[SHOWING_MOST_COLUMNS][96];
    const char *unit[SHOWING_MOST_COLUMNS];
    int n = showing_body_columns(r, SHOWING_MOST_COLUMNS, name, unit);

    if (n > SHOWING_MOST_COLUMNS)
        return error_set(err, ERR_CASE, "terms give %d columns of particles.csv, at most %d are possible", n,
                         SHOWING_MOST_COLUMNS);
    if (n)
        text_add(units, "%s\n  \"particles.csv\": {", units->n > 1 ? "," : "");
    for (int i = 0; i < n; i++)
        add_unit(units, name[i], unit[i], i == 0);
    if (n)
        text_add(units, "}");
    return 0;
}

int showing_plan(run *r, text *units, error *err)
{
    const int n = r->showing ? count_columns(r) : 0;
    char path[4600], (*name)[96];
    const char **unit, **column;

    if (!r->showing)
        return 0;
    TRY(plan_bodies(r, units, err));
    if (n == 0)
        return 0;
    ARENA_NEW(&r->memory, r->showing->row, n + 1, err);
    ARENA_NEW(&r->memory, name, n + 1, err);
    ARENA_NEW(&r->memory, unit, n + 1, err);
    ARENA_NEW(&r->memory, column, n + 1, err);
    strcpy(name[0], "t");
    unit[0] = "s";
    list_columns(r, name + 1, unit + 1, NULL);
    text_add(units, "%s\n  \"integrals.csv\": {", units->n > 1 ? "," : "");
    for (int i = 0; i <= n; i++) {
        column[i] = name[i];
        add_unit(units, name[i], unit[i], i == 0);
    }
    text_add(units, "}");
    snprintf(path, sizeof path, "%s/integrals.csv", r->dir);
    return table_create(&r->integrals, path, column, n + 1, err);
}

int showing_row(run *r, double t, error *err)
{
    if (!r->integrals.n_column)
        return 0;
    TRY(evaluate(r, err));
    r->showing->row[0] = t;
    list_columns(r, NULL, NULL, r->showing->row + 1);
    return table_add(&r->integrals, r->showing->row, err);
}

int showing_body_columns(const run *r, int most, char (*name)[96], const char **unit)
{
    const shown *s = r->showing ? &r->showing->shown : NULL;
    int n = 0;

    for (int i = 0; s && i < s->n_integral; i++)
        if (s->integral[i].per == SHOWN_BODY) {
            if (n + s->integral[i].n_comp <= most)
                name_columns(&s->integral[i], "", name + n, unit + n);
            n += s->integral[i].n_comp;
        }
    return n;
}

double *showing_body_row(run *r, int body, double *row, error *err)
{
    const shown *s = r->showing ? &r->showing->shown : NULL;

    for (int i = 0; s && i < s->n_integral; i++) {
        const shown_integral *q = &s->integral[i];

        if (q->per != SHOWN_BODY)
            continue;
        if (evaluate(r, err))
            return NULL;
        for (int k = 0; k < q->n_comp; k++)
            *row++ = is_early(r, q->use) ? NAN : q->value[body * q->n_comp + k];
    }
    return row;
}

/* --- fields --- */

int showing_fields(const run *r, const field_spec **f)
{
    *f = r->showing ? r->showing->shown.space.field : NULL;
    return r->showing ? r->showing->shown.space.n_field : 0;
}

int showing_take(run *r, error *err)
{
    showing *s = r->showing;

    if (!s || s->projected || s->shown.space.n_field == 0)
        return 0;
    TRY(evaluate(r, err));
    TRY(shown_project(&s->shown, err));
    for (int64_t d = 0; d < s->shown.space.n_dof; d++)
        if (is_early(r, s->shown.field[s->shown.space.dof_field[d]].use))
            s->shown.x[d] = NAN;
    s->projected = 1;
    return 0;
}

void showing_value(const run *r, int field, const located *at, const body_place *in, double *v)
{
    const shown *s = &r->showing->shown;
    const int where = s->field[field].where;

    locate_value(&s->space, at, field, s->x, v, NULL);
    for (int k = 0; k < s->space.field[field].n_comp; k++)
        if (in ? where == PF_FLUID : where == PF_SOLID)
            v[k] = NAN;
}

vtu_more showing_file(const run *r)
{
    const output_spec *o = &r->p->description.output;
    vtu_more more = {0};

    if (!r->showing)
        return more;
    more = (vtu_more){
        .space = &r->showing->shown.space, .field = o->shown, .n_field = o->n_shown, .x = r->showing->shown.x};
    for (int f = 0; f < more.space->n_field; f++) {
        more.empty |= r->showing->shown.field[f].where == PF_FLUID ? 1u << f : 0;
        more.empty_outside |= r->showing->shown.field[f].where == PF_SOLID ? 1u << f : 0;
    }
    return more;
}

const double *showing_mean(const run *r, int field)
{
    return r->showing->shown.field[field].mean;
}
