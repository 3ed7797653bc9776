/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * forces.csv and probes.csv: a row a step, or one wherever they are due. */
#include "run/run.h"
#include "run/showing.h"

#include "base/list.h"

#include "space/locate.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct columns {
    int n, room;
    char (*name)[96], (*unit)[32];
    int failed; /* memory ran out */
} columns;

static void columns_free(columns *c)
{
    free(c->name);
    free(c->unit);
    *c = (columns){0};
}

static char (*more(columns *c, int n, const char *unit))[96]
{
    if (c->n + n > c->room) {
        int room = 2 * c->room + n + 64;
        void *name = realloc(c->name, (size_t)room * sizeof *c->name), *units;

        c->name = name ? name : c->name;
        units = realloc(c->unit, (size_t)room * sizeof *c->unit);
        c->unit = units ? units : c->unit;
        c->failed |= !name || !units;
        if (!name || !units)
            return NULL;
        c->room = room;
    }
    for (int i = 0; i < n; i++)
        snprintf(c->unit[c->n + i], sizeof *c->unit, "%s", unit);
    c->n += n;
    return c->name + c->n - n;
}

static int plan_table(run *r, table *t, const char *file, columns *c, text *units, error *err)
{
    char path[4600];
    const char **name = calloc((size_t)c->n, sizeof *name);
    int status;

    if (!name)
        return error_memory(err, file, 0);
    snprintf(path, sizeof path, "%s/%s", r->dir, file);
    text_add(units, "%s\n  \"%s\": {", units->n > 1 ? "," : "", file);
    for (int i = 0; i < c->n; i++) {
        name[i] = c->name[i];
        text_add(units, "%s", i ? ", " : "");
        text_json(units, c->name[i]);
        text_add(units, ": \"%s\"", c->unit[i]);
    }
    text_add(units, "}");
    status = table_create(t, path, name, c->n, err);
    free(name);
    columns_free(c);
    return status;
}

/* Columns of one boundary: fx, fy[, fz], torque (2D) or tx, ty, tz, and other reactions by name; of a tensor fxx,
 * fxy, ... */
static void force_columns(const problem *p, const char *boundary, columns *c)
{
    for (int f = 0; f < p->space.n_field; f++) {
        const field_spec *g = &p->space.field[f];
        char(*name)[96];
        int n_torque = p->description.dim == 2 ? 1 : 3;

        if (!g->reaction || g->support != PF_ON_MESH)
            continue;
        name = more(c, g->n_comp, g->reaction_unit);
        for (int k = 0; name && k < g->n_comp; k++)
            if (g->n_comp == 1)
                snprintf(name[k], 96, "%.40s.%s", boundary, g->reaction);
            else
                snprintf(name[k], 96, "%.40s.%c%s", boundary, g->reaction[0],
                         term_component((uint32_t)g->shape, g->n_comp, k));
        if (g->shape != PF_VECTOR || !name)
            continue;
        name = more(c, n_torque, "N m");
        for (int k = 0; name && k < n_torque; k++)
            if (p->description.dim == 2)
                snprintf(name[k], 96, "%.40s.torque", boundary);
            else
                snprintf(name[k], 96, "%.40s.t%c", boundary, "xyz"[k]);
        name = p->description.output.coefficient > 0 ? more(c, g->n_comp, "1") : NULL;
        for (int k = 0; name && k < g->n_comp; k++)
            snprintf(name[k], 96, "%.40s.c%c", boundary, "xyz"[k]);
    }
}

static int plan_forces(run *r, columns *c, text *units, error *err)
{
    const output_spec *o = &r->p->description.output;
    char(*name)[96] = more(c, 1, "s");

    if (name)
        strcpy(*name, "t");
    for (int i = 0; i < o->n_force && !c->failed; i++)
        force_columns(r->p, o->force[i], c);
    if (c->failed)
        return error_memory(err, "forces.csv", 0);
    ARENA_NEW(&r->memory, r->facet_count, 3 * r->p->mesh.n_node, err);
    return plan_table(r, &r->forces, "forces.csv", c, units, err);
}

static int plan_probes(run *r, columns *c, text *units, error *err)
{
    const problem *p = r->p;
    const output_spec *o = &p->description.output;
    const field_spec *shown;
    const int n_shown = showing_fields(r, &shown);
    char(*name)[96] = more(c, 1, "s");

    if (name)
        strcpy(*name, "t");
    for (int i = 0; i < o->n_probe; i++) {
        char prefix[60];

        snprintf(prefix, sizeof prefix, "%.50s.", o->probe[i].name);
        for (int f = 0; f < p->space.n_field; f++) {
            name = output_has_columns(&p->space.field[f])
                       ? more(c, p->space.field[f].n_comp, p->space.field[f].unit)
                       : NULL;
            if (name)
                output_components(&p->space.field[f], prefix, name);
        }
        for (int f = 0; f < n_shown; f++) {
            name = more(c, shown[f].n_comp, shown[f].unit);
            if (name)
                output_components(&shown[f], prefix, name);
        }
        for (int f = 0; f < p->space.kept.n; f++) {
            const field_spec *g = &p->space.kept.field[f];

            name = g->support == PF_AT_POINTS ? more(c, g->n_comp, g->unit) : NULL;
            if (name)
                output_components(g, prefix, name);
        }
        name = p->bodies.n ? more(c, 1, "1") : NULL;
        if (name)
            snprintf(*name, sizeof *name, "%sbody", prefix);
    }
    return c->failed ? error_memory(err, "probes.csv", 0) : plan_table(r, &r->probes, "probes.csv", c, units, err);
}

int tables_plan(run *r, text *units, error *err)
{
    const output_spec *o = &r->p->description.output;
    columns c = {0};
    int status = o->n_force ? plan_forces(r, &c, units, err) : 0;

    columns_free(&c);
    if (!status && o->n_probe)
        status = plan_probes(r, &c, units, err);
    columns_free(&c);
    return status;
}

int tables_locate(run *r, error *err)
{
    problem *p = r->p;
    const output_spec *o = &p->description.output;

    ARENA_NEW(&r->memory, r->probe_at, o->n_probe + 1, err);
    for (int i = 0; i < o->n_probe; i++) {
        r->probe_at[i] = locate_point(&p->mesh, &p->grid, o->probe[i].x);
        if (r->probe_at[i].cell < 0)
            return error_set(err, ERR_CASE, "%s:%d: output: probe \"%s\" at %s lies outside the mesh",
                             o->block->file, o->block->line, o->probe[i].name,
                             text_point(o->probe[i].x, p->description.dim).s);
    }
    return 0;
}

/* How many facets at each node prescribe the field: of this boundary in mine, of all in all. */
static void count_facets(const problem *p, int boundary, int f, int n_local, uint8_t *mine, uint8_t *all)
{
    const mesh *m = &p->mesh;

    for (int64_t k = 0; k < m->n_facet; k++) {
        int prescribes = 0, here = (int)(m->facet[k].names >> boundary & 1);

        for (int i = 0; i < p->description.n_line; i++)
            prescribes |= p->conditions.facet[i][k] && p->description.line[i].has_value[f];
        for (int i = 0; (prescribes || here) && i < n_local; i++) {
            int32_t node =
                m->cell[(int64_t)m->facet[k].cell * m->type->n_node + m->type->facet[m->facet[k].local][i]];

            mine[node] = (uint8_t)(mine[node] + here);
            all[node] = (uint8_t)(all[node] + prescribes);
        }
    }
}

/* Reactions of a field on a boundary: minus the residual of the rows that it holds; where boundaries meet that both
 * prescribe the field, each takes a part by its number of facets there. */
static double *reaction(const run *r, int boundary, int f, const double *about, double *out)
{
    const problem *p = r->p;
    const mesh *m = &p->mesh;
    const space *s = &p->space;
    int n_comp = s->field[f].n_comp,
        n_local = s->field[f].order == 2 ? m->type->facet_nodes : m->type->facet_vertices;
    uint8_t *mine = r->facet_count, *all = mine + m->n_node, *seen = all + m->n_node;
    double torque[3] = {0}, sum[VALUE_MAX] = {0};
    int turns = s->field[f].shape == PF_VECTOR;

    memset(mine, 0, (size_t)(3 * m->n_node));
    count_facets(p, boundary, f, n_local, mine, all);
    for (int32_t node = 0; node < m->n_node; node++) {
        const double *res = r->stepper->reaction[REACTION_ALL] + (mine[node] ? s->first[f][node] : 0);
        int32_t carrier = mine[node] ? s->dof_node[s->first[f][node]] : 0; /* periodic ends are one node */
        double share = all[node] > mine[node] ? (double)mine[node] / all[node] : 1, d[3] = {0}, q[VALUE_MAX] = {0};

        if (!mine[node] || seen[carrier]++)
            continue;
        for (int a = 0; a < n_comp; a++) {
            q[a] = -share * res[a];
            sum[a] += q[a];
        }
        for (int a = 0; turns && a < m->dim; a++)
            d[a] = m->x[(int64_t)node * m->dim + a] - about[a];
        torque[0] += d[1] * q[2] - d[2] * q[1];
        torque[1] += d[2] * q[0] - d[0] * q[2];
        torque[2] += d[0] * q[1] - d[1] * q[0];
    }
    for (int a = 0; a < n_comp; a++)
        *out++ = sum[a];
    if (turns)
        for (int a = m->dim == 2 ? 2 : 0; a < 3; a++)
            *out++ = torque[a];
    for (int a = 0; turns && p->description.output.coefficient > 0 && a < n_comp; a++)
        *out++ = p->description.output.coefficient * sum[a];
    return out;
}

/* Values at the probes. */
static int add_probes(run *r, double t, double *row, error *err)
{
    const problem *p = r->p;
    const output_spec *o = &p->description.output;
    const field_spec *shown;
    const int n_shown = showing_fields(r, &shown);
    double *at = row;

    TRY(showing_take(r, err));
    *at++ = t;
    for (int i = 0; i < o->n_probe; i++) {
        const body_place *in = inside_place(r, o->probe[i].x);

        for (int f = 0; f < p->space.n_field; f++) {
            if (!output_has_columns(&p->space.field[f]))
                continue;
            locate_value(&p->space, &r->probe_at[i], f, r->shown, at, NULL);
            inside_value(r, in, f, o->probe[i].x, at);
            at += p->space.field[f].n_comp;
        }
        for (int f = 0; f < n_shown; at += shown[f++].n_comp)
            showing_value(r, f, &r->probe_at[i], in, at);
        for (int f = 0; f < p->space.kept.n; f++)
            if (p->space.kept.field[f].support == PF_AT_POINTS) {
                kept_value(&p->space.kept, f, p->state.kept, r->probe_at[i].cell, r->probe_at[i].xi, at);
                at += p->space.kept.field[f].n_comp;
            }
        if (p->bodies.n)
            *at++ = in ? in->body : -1;
    }
    return table_add(&r->probes, row, err);
}

static int add_forces(run *r, double t, double *row, error *err)
{
    const problem *p = r->p;
    const output_spec *o = &p->description.output;
    double *at = row;

    *at++ = t;
    for (int i = 0; i < o->n_force; i++)
        for (int f = 0; f < p->space.n_field; f++)
            if (p->space.field[f].reaction && p->space.field[f].support == PF_ON_MESH)
                at = reaction(r, mesh_find_name(&p->mesh, o->force[i]), f, o->about, at);
    return table_add(&r->forces, row, err);
}

int tables_add(run *r, double t, error *err)
{
    const output_spec *o = &r->p->description.output;
    double *row = malloc((size_t)(r->forces.n_column + r->probes.n_column + 1) * sizeof *row);
    int status = row ? 0 : error_memory(err, "tables", 0);

    if (!status && o->n_force && !r->before_steps)
        status = add_forces(r, t, row, err);
    if (!status && o->n_probe)
        status = add_probes(r, t, row, err);
    if (!status)
        status = showing_row(r, t, err);
    if (!status)
        status = problem_table_add(r, t, err);
    free(row);
    TRY(status);
    if (r->before_steps)
        return 0;
    LIST_ROOM(r->time, r->n_time, &r->time_room, err);
    r->time[r->n_time++] = t;
    return 0;
}

int tables_start(run *r, error *err)
{
    int status;

    r->before_steps = 1;
    status = tables_add(r, r->p->description.time.start, err);
    if (!status)
        status = particles_write(r, r->p->description.time.start, err);
    r->before_steps = 0;
    return status;
}
