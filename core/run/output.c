/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The files of a run: fields, probes, lines, forces, the log and the summary. */
#include "base/text.h"
#include "run/run.h"

#include "io/vtu.h"
#include "space/locate.h"

#include <fcntl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

static const char axis[] = "xyz", velocity_name[] = "uvw";

/* Column names of a field's components: u, v, w for the velocity; name, or name_x, for others. */
static int component_names(const space_field *f, const char *prefix, char (*name)[96])
{
    for (int k = 0; k < f->n_comp; k++)
        if (f->n_comp == 1)
            snprintf(name[k], 96, "%s%s", prefix, f->name);
        else if (strcmp(f->name, "u") == 0)
            snprintf(name[k], 96, "%s%c", prefix, velocity_name[k]);
        else
            snprintf(name[k], 96, "%s%s_%c", prefix, f->name, axis[k]);
    return f->n_comp;
}

typedef struct columns {
    int n, room;
    char (*name)[96], (*unit)[32];
} columns;

static char (*more(columns *c, int n, const char *unit))[96]
{
    while (c->n + n > c->room) {
        c->room = 2 * c->room + 64;
        c->name = realloc(c->name, (size_t)c->room * sizeof *c->name);
        c->unit = realloc(c->unit, (size_t)c->room * sizeof *c->unit);
        if (!c->name || !c->unit)
            return NULL;
    }
    for (int i = 0; i < n; i++)
        snprintf(c->unit[c->n + i], sizeof *c->unit, "%s", unit);
    c->n += n;
    return c->name + c->n - n;
}

static int open_table(run *r, table *t, const char *file, columns *c, text *units, error *err)
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
    free(c->name);
    free(c->unit);
    *c = (columns){0};
    return status;
}

/* Columns of one boundary: fx, fy[, fz], torque (2D) or tx, ty, tz, and other reactions by name. */
static int force_columns(const problem *p, const char *boundary, columns *c)
{
    for (int f = 0; f < p->space.n_field; f++) {
        const space_field *g = &p->space.field[f];
        char(*name)[96];
        int n_torque = p->dim == 2 ? 1 : 3;

        if (!g->reaction || g->support != PF_ON_MESH)
            continue;
        name = more(c, g->n_comp, g->reaction_unit);
        for (int k = 0; name && k < g->n_comp; k++)
            if (g->n_comp == 1)
                snprintf(name[k], 96, "%.40s.%s", boundary, g->reaction);
            else
                snprintf(name[k], 96, "%.40s.%c%c", boundary, g->reaction[0], axis[k]);
        if (g->n_comp == 1 || !name)
            continue;
        name = more(c, n_torque, "N m");
        for (int k = 0; name && k < n_torque; k++)
            if (p->dim == 2)
                snprintf(name[k], 96, "%.40s.torque", boundary);
            else
                snprintf(name[k], 96, "%.40s.t%c", boundary, axis[k]);
    }
    return c->name != NULL;
}

static int open_tables(run *r, text *units, error *err)
{
    problem *p = r->p;
    const problem_output *o = &p->output;
    columns c = {0};
    char(*name)[96];

    if (o->n_force) {
        name = more(&c, 1, "s");
        if (!name)
            return error_memory(err, "forces.csv", 0);
        strcpy(*name, "t");
        for (int i = 0; i < o->n_force; i++)
            if (!force_columns(p, o->force_name[i], &c))
                return error_memory(err, "forces.csv", 0);
        TRY(open_table(r, &r->forces, "forces.csv", &c, units, err));
    }
    if (o->n_probe) {
        name = more(&c, 1, "s");
        if (!name)
            return error_memory(err, "probes.csv", 0);
        strcpy(*name, "t");
        for (int i = 0; i < o->n_probe; i++) {
            char prefix[60];

            snprintf(prefix, sizeof prefix, "%.50s.", o->probe[i].name);
            for (int f = 0; f < p->space.n_field; f++) {
                name = more(&c, p->space.field[f].n_comp, p->space.field[f].unit);
                if (!name)
                    return error_memory(err, "probes.csv", 0);
                component_names(&p->space.field[f], prefix, name);
            }
        }
        TRY(open_table(r, &r->probes, "probes.csv", &c, units, err));
    }
    return 0;
}

static int locate_probes(run *r, error *err)
{
    problem *p = r->p;
    const problem_output *o = &p->output;

    ARENA_NEW(&p->memory, r->probe_at, o->n_probe + 1, err);
    for (int i = 0; i < o->n_probe; i++) {
        r->probe_at[i] = locate_point(&p->mesh, &p->grid, o->probe[i].x);
        if (r->probe_at[i].cell < 0)
            return error_set(err, ERR_CASE, "%s:%d: output: probe \"%s\" at %s lies outside the mesh",
                             o->block->file, o->block->line, o->probe[i].name, text_point(o->probe[i].x, p->dim).s);
    }
    return 0;
}

static int locate_lines(run *r, error *err)
{
    problem *p = r->p;
    const problem_output *o = &p->output;

    ARENA_NEW(&p->memory, r->line_at, o->n_line + 1, err);
    for (int i = 0; i < o->n_line; i++) {
        const line_probe *q = &o->line[i];

        ARENA_NEW(&p->memory, r->line_at[i], q->n, err);
        for (int k = 0; k < q->n; k++) {
            double x[3];

            for (int d = 0; d < 3; d++)
                x[d] = q->from[d] + (q->to[d] - q->from[d]) * k / (q->n - 1);
            r->line_at[i][k] = locate_point(&p->mesh, &p->grid, x);
        }
    }
    return 0;
}

/* The case as it was understood, with plugin versions, for the archive. */
static int write_case(run *r, error *err)
{
    const problem *p = r->p;
    char path[4600];
    text t = {0};
    int status;

    text_add(&t, "{\n  \"case\": ");
    text_json(&t, p->c->title ? p->c->title : "");
    text_add(&t, ",\n  \"file\": ");
    text_json(&t, p->c->path);
    text_add(&t,
             ",\n  \"plugflow\": \"%s\",\n  \"dimension\": %d,\n  \"cells\": %lld,\n  \"cell\": \"%s\",\n  "
             "\"parameters\": {",
             PF_VERSION, p->dim, (long long)p->mesh.n_cell, p->mesh.type->name);
    for (int i = 0; i < p->c->n_param; i++) {
        text_add(&t, "%s", i ? ", " : "");
        text_json(&t, p->c->param[i].name);
        text_add(&t, ": ");
        text_json(&t, p->c->param[i].value);
    }
    text_add(&t, "},\n  \"terms\": [");
    for (int i = 0; i < p->n_use; i++) {
        const term_use *u = &p->use[i];

        text_add(&t, "%s\n    {\"term\": \"%s.%s\", \"version\": \"%s\", \"parameters\": {", i ? "," : "",
                 u->plugin->d.name, u->term->name, u->plugin->d.version);
        for (uint32_t k = 0; k < u->term->n_param; k++) {
            const pf_param *q = &u->term->param[k];
            const char *at = (const char *)u->params + q->offset;

            text_add(&t, "%s\"%s\": ", k ? ", " : "", q->name);
            if (q->type == PF_T_REAL) {
                text_number(&t, *(const double *)(const void *)at);
            } else if (q->type == PF_T_VECTOR) {
                for (int d = 0; d < p->dim; d++) {
                    text_add(&t, d ? ", " : "[");
                    text_number(&t, ((const double *)(const void *)at)[d]);
                }
                text_add(&t, "]");
            } else {
                text_add(&t, "%d", *(const int *)(const void *)at);
            }
        }
        text_add(&t, "}}");
    }
    text_add(&t, "\n  ],\n  \"source\": ");
    text_json(&t, p->c->n_source ? p->c->source[0].text : "");
    text_add(&t, "\n}\n");
    snprintf(path, sizeof path, "%s/case.json", r->dir);
    status = t.failed ? error_memory(err, path, 0) : file_write(path, t.s, t.n, err);
    text_free(&t);
    return status;
}

/* What the case adds to fields in files, at the nodes (the pressure without rho g.x gets it back). */
static int make_offset(run *r, error *err)
{
    problem *p = r->p;

    ARENA_NEW(&p->memory, r->offset, p->space.n_dof, err);
    ARENA_NEW(&p->memory, r->shown, p->space.n_dof, err);
    for (int f = 0; f < p->space.n_field; f++)
        for (int64_t c = 0; p->has_offset[f] && c < p->mesh.n_node; c++) {
            double x[3] = {0}, v[VALUE_MAX] = {0};

            if (p->space.first[f][c] < 0)
                continue;
            memcpy(x, p->mesh.x + c * p->dim, (size_t)p->dim * sizeof *x);
            TRY(value_at(&p->offset[f], x, p->time.start, v, err));
            memcpy(r->offset + p->space.first[f][c], v, (size_t)p->space.field[f].n_comp * sizeof *v);
        }
    return 0;
}

static const double *shown(run *r)
{
    for (int64_t d = 0; d < r->p->space.n_dof; d++)
        r->shown[d] = r->p->x[d] + r->offset[d];
    return r->shown;
}

int output_open(run *r, error *err)
{
    char path[4600];
    text units = {0};
    int status;

    TRY(make_offset(r, err));
    TRY(locate_lines(r, err));
    TRY(locate_probes(r, err)); /* before anything of an earlier run goes */
    TRY(file_make_dir(r->dir, err));
    TRY(file_clean_run(r->dir, err));
    TRY(write_case(r, err));
    snprintf(path, sizeof path, "%s/run.jsonl", r->dir);
    TRY(file_write(path, "", 0, err));
    r->log_fd = open(path, O_WRONLY | O_APPEND);
    if (r->log_fd < 0)
        return error_set(err, ERR_IO, "%s: cannot be opened", path);
    text_add(&units, "{");
    status = open_tables(r, &units, err);
    if (!status)
        status = particles_open(r, err);
    for (int f = 0; f < r->p->space.n_field; f++)
        text_add(&units, "%s\n  \"%s\": \"%s\"", units.n > 1 ? "," : "", r->p->space.field[f].name,
                 r->p->space.field[f].unit);
    text_add(&units, "\n}\n");
    snprintf(path, sizeof path, "%s/units.json", r->dir);
    if (!status)
        status = units.failed ? error_memory(err, path, 0) : file_write(path, units.s, units.n, err);
    text_free(&units);
    return status;
}

/* How many facets at each node prescribe the field: of this boundary in mine, of all in all. */
static void count_facets(const problem *p, int boundary, int f, int n_local, uint8_t *mine, uint8_t *all)
{
    const mesh *m = &p->mesh;

    for (int64_t k = 0; k < m->n_facet; k++) {
        int prescribes = 0, here = (int)(m->facet[k].names >> boundary & 1);

        for (int i = 0; i < p->n_line; i++)
            prescribes |= p->line[i].facet && p->line[i].facet[k] && p->line[i].has_value[f];
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
    uint8_t *mine = calloc((size_t)(3 * m->n_node), 1), *all = mine + m->n_node, *seen = all + m->n_node;
    double torque[3] = {0}, sum[3] = {0};

    if (mine)
        count_facets(p, boundary, f, n_local, mine, all);
    for (int32_t node = 0; mine && node < m->n_node; node++) {
        const double *res = r->residual + (mine[node] ? s->first[f][node] : 0);
        int32_t carrier = mine[node] ? s->dof_node[s->first[f][node]] : 0; /* periodic ends are one node */
        double share = all[node] > mine[node] ? (double)mine[node] / all[node] : 1, d[3] = {0}, q[3] = {0};

        if (!mine[node] || seen[carrier]++)
            continue;
        for (int a = 0; a < n_comp; a++) {
            q[a] = -share * res[a];
            sum[a] += q[a];
            d[a] = n_comp > 1 ? m->x[(int64_t)node * m->dim + a] - about[a] : 0;
        }
        torque[0] += d[1] * q[2] - d[2] * q[1];
        torque[1] += d[2] * q[0] - d[0] * q[2];
        torque[2] += d[0] * q[1] - d[1] * q[0];
    }
    free(mine);
    for (int a = 0; a < n_comp; a++)
        *out++ = sum[a];
    if (n_comp > 1)
        for (int a = m->dim == 2 ? 2 : 0; a < 3; a++)
            *out++ = torque[a];
    return out;
}

int output_series(run *r, double t, error *err)
{
    const problem *p = r->p;
    const problem_output *o = &p->output;
    double *row = malloc((size_t)(r->forces.n_column + r->probes.n_column + 1) * sizeof *row), *at = row;
    int status = row ? 0 : error_memory(err, "tables", 0);

    if (!status && o->n_force) {
        *at++ = t;
        for (int i = 0; i < o->n_force; i++)
            for (int f = 0; f < p->space.n_field; f++)
                if (p->space.field[f].reaction && p->space.field[f].support == PF_ON_MESH)
                    at = reaction(r, o->force[i].boundary, f, o->force[i].about, at);
        status = table_add(&r->forces, row, err);
    }
    if (!status && o->n_probe) {
        const double *x = shown(r);

        at = row;
        *at++ = t;
        for (int i = 0; i < o->n_probe; i++)
            for (int f = 0; f < p->space.n_field; f++) {
                locate_value(&p->space, &r->probe_at[i], f, x, at, NULL);
                at += p->space.field[f].n_comp;
            }
        status = table_add(&r->probes, row, err);
    }
    free(row);
    return status;
}

int output_fields(run *r, double t, error *err)
{
    char path[4600], name[40];
    double start = solve_seconds();

    if (r->n_file == r->room) {
        int room = 2 * r->room + 16;
        char **file = realloc(r->file, (size_t)room * sizeof *file);
        double *time = realloc(r->file_time, (size_t)room * sizeof *time);

        r->file = file ? file : r->file;
        r->file_time = time ? time : r->file_time;
        if (!file || !time)
            return error_memory(err, "list of files", 0);
        r->room = room;
    }
    snprintf(name, sizeof name, "fields_%05d.vtu", r->n_file);
    snprintf(path, sizeof path, "%s/%s", r->dir, name);
    TRY(vtu_write(path, &r->p->space, r->p->output.field, r->p->output.n_field, shown(r),
                  r->p->time.unsteady ? t : NAN, err));
    r->file[r->n_file] = strdup(name);
    if (!r->file[r->n_file])
        return error_memory(err, "list of files", 0);
    r->file_time[r->n_file++] = t;
    snprintf(path, sizeof path, "%s/fields.pvd", r->dir);
    TRY(vtu_write_pvd(path, (const char *const *)r->file, r->file_time, r->n_file, err));
    TRY(particles_outline(r, err));
    r->result->seconds_output += solve_seconds() - start;
    return 0;
}

int output_lines(run *r, double t, error *err)
{
    const problem *p = r->p;
    const double *x = shown(r);
    char path[4600];

    if (p->output.n_line) {
        snprintf(path, sizeof path, "%s/lines", r->dir);
        TRY(file_make_dir(path, err));
    }
    for (int i = 0; i < p->output.n_line; i++) {
        const line_probe *q = &p->output.line[i];
        text s = {0};
        int status;

        text_add(&s, "t");
        for (int d = 0; d < p->dim; d++)
            text_add(&s, ",%c", axis[d]);
        for (int f = 0; f < p->space.n_field; f++) {
            char name[3][96];

            for (int k = 0, n = component_names(&p->space.field[f], "", name); k < n; k++)
                text_add(&s, ",%s", name[k]);
        }
        text_add(&s, "\n");
        for (int k = 0; k < q->n; k++) {
            text_number(&s, t);
            for (int d = 0; d < p->dim; d++) {
                text_add(&s, ",");
                text_number(&s, q->from[d] + (q->to[d] - q->from[d]) * k / (q->n - 1));
            }
            for (int f = 0; f < p->space.n_field; f++) {
                double v[VALUE_MAX] = {NAN, NAN, NAN};

                if (r->line_at[i][k].cell >= 0)
                    locate_value(&p->space, &r->line_at[i][k], f, x, v, NULL);
                for (int c = 0; c < p->space.field[f].n_comp; c++) {
                    text_add(&s, ",");
                    if (isfinite(v[c]))
                        text_number(&s, v[c]); /* outside the mesh: an empty cell */
                }
            }
            text_add(&s, "\n");
        }
        snprintf(path, sizeof path, "%s/lines/%s.csv", r->dir, q->name);
        status = s.failed ? error_memory(err, path, 0) : file_write(path, s.s, s.n, err);
        text_free(&s);
        TRY(status);
    }
    return 0;
}

int output_event(run *r, const char *event, const char *fields_json, error *err)
{
    char path[4600], stamp[40];
    time_t now = time(NULL);
    struct tm tm;
    text s = {0};
    int status;

    gmtime_r(&now, &tm);
    strftime(stamp, sizeof stamp, "%Y-%m-%dT%H:%M:%SZ", &tm);
    text_add(&s, "{\"event\": \"%s\", \"time\": \"%s\"%s%s}\n", event, stamp, *fields_json ? ", " : "",
             fields_json);
    snprintf(path, sizeof path, "%s/run.jsonl", r->dir);
    status = s.failed ? error_memory(err, path, 0) : file_append(r->log_fd, path, s.s, s.n, err);
    text_free(&s);
    return status;
}

void output_close(run *r)
{
    table_destroy(&r->forces);
    table_destroy(&r->probes);
    table_destroy(&r->particles);
    for (int i = 0; i < r->n_body_file; i++)
        free(r->body_file[i]);
    free(r->body_file);
    for (int i = 0; i < r->n_file; i++)
        free(r->file[i]);
    free(r->file);
    free(r->file_time);
    text_free(&r->results);
    if (r->log_fd > 0)
        close(r->log_fd);
}
