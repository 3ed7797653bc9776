/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The folder of a run: its files opened, fields written, events logged. */
#include "run/run.h"
#include "run/showing.h"

#include "base/clock.h"
#include "base/process.h"
#include "io/vtu.h"

#include <fcntl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

/* r->offset: what the case adds to fields in files at time t, at the nodes (the pressure without rho g.x gets it
 * back). */
static int make_offset(run *r, double t, error *err)
{
    const description *d = &r->p->description;
    const mesh *m = &r->p->mesh;

    for (int f = 0; f < d->fields.n; f++)
        for (int64_t c = 0; d->has_offset[f] && c < m->n_node; c++) {
            double x[3] = {0}, v[VALUE_MAX] = {0};

            if (r->p->space.first[f][c] < 0)
                continue;
            memcpy(x, m->x + c * m->dim, (size_t)m->dim * sizeof *x);
            TRY(value_at(&d->offset[f], x, t, v, err));
            memcpy(r->offset + r->p->space.first[f][c], v, (size_t)d->fields.f[f].n_comp * sizeof *v);
        }
    return 0;
}

/* Whether what the case adds may be another at another time. */
static int offset_changes(const description *d)
{
    int changes = 0;

    for (int f = 0; f < d->fields.n; f++)
        changes |= d->has_offset[f] && d->offset[f].of_time;
    return changes;
}

int output_take(run *r, double t, error *err)
{
    if (offset_changes(&r->p->description))
        TRY(make_offset(r, t, err));
    for (int64_t d = 0; d < r->p->space.n_dof; d++)
        r->shown[d] = r->x[d] + r->offset[d];
    inside_update(r);
    showing_forget(r);
    r->taken = t;
    return 0;
}

/* units.json: the columns' and the fields'. */
static int write_units(const run *r, text *units, error *err)
{
    char path[4600];

    const field_spec *shown;
    const int n = showing_fields(r, &shown);

    for (int f = 0; f < r->p->space.n_field; f++)
        text_add(units, "%s\n  \"%s\": \"%s\"", units->n > 1 ? "," : "", r->p->space.field[f].name,
                 r->p->space.field[f].unit);
    for (int f = 0; f < n; f++)
        text_add(units, ",\n  \"%s\": \"%s\"", shown[f].name, shown[f].unit);
    for (int f = 0; f < r->p->space.kept.n; f++)
        text_add(units, ",\n  \"%s\": \"%s\"", r->p->space.kept.field[f].name, r->p->space.kept.field[f].unit);
    text_add(units, "\n}\n");
    snprintf(path, sizeof path, "%s/units.json", r->dir);
    return units->failed ? error_memory(err, path, 0) : file_write(path, units->s, units->n, err);
}

static int open_files(run *r, text *units, error *err)
{
    char path[4600];

    process.running = 1;
    TRY(file_make_dir(r->dir, err));
    TRY(file_clean_run(r->dir, err));
    TRY(output_case(r, err));
    snprintf(path, sizeof path, "%s/run.jsonl", r->dir);
    TRY(file_write(path, "", 0, err));
    r->log_fd = open(path, O_WRONLY | O_APPEND);
    if (r->log_fd < 0)
        return error_set(err, ERR_IO, "%s: cannot be opened", path);
    TRY(table_open(&r->forces, err));
    TRY(table_open(&r->probes, err));
    TRY(table_open(&r->particles, err));
    TRY(table_open(&r->integrals, err));
    TRY(table_open(&r->values, err));
    return write_units(r, units, err);
}

int output_open(run *r, error *err)
{
    text units = {0};
    int status;

    ARENA_NEW(&r->memory, r->offset, r->p->space.n_dof, err);
    ARENA_NEW(&r->memory, r->shown, r->p->space.n_dof, err);
    TRY(make_offset(r, r->p->description.time.start, err));
    TRY(inside_open(r, err));
    TRY(lines_locate(r, err));
    TRY(tables_locate(r, err));
    text_add(&units, "{");
    status = tables_plan(r, &units, err);
    if (!status)
        status = showing_plan(r, &units, err);
    if (!status)
        status = particles_plan(r, err);
    if (!status)
        status = problem_table_plan(r, err);
    if (!status)
        status =
            results_expect(r, err); /* everything is known to be right before anything of an earlier run goes */
    if (!status)
        status = open_files(r, &units, err);
    text_free(&units);
    return status;
}

/* r->file and r->file_time have room for one more. */
static int room_for_file(run *r, error *err)
{
    int room = 2 * r->room + 16;
    char **file;
    double *time;

    if (r->n_file < r->room)
        return 0;
    file = realloc(r->file, (size_t)room * sizeof *file);
    time = realloc(r->file_time, (size_t)room * sizeof *time);
    r->file = file ? file : r->file;
    r->file_time = time ? time : r->file_time;
    if (!file || !time)
        return error_memory(err, "list of files", 0);
    r->room = room;
    return 0;
}

int output_fields(run *r, double t, error *err)
{
    const output_spec *out = &r->p->description.output;
    vtu_bodies bodies = {.body = r->body_of_node, .empty = r->empty, .empty_outside = r->empty_outside};
    vtu_cells cells;
    arena memory = {0};
    int status;
    char path[4600], name[40];
    double start = clock_seconds();
    vtu_more more;

    TRY(room_for_file(r, err));
    if (out->n_shown)
        TRY(showing_take(r, err));
    more = showing_file(r);
    if (r->in_file) { /* nodes inside of bodies carry fluid for the rest of a cut cell: lines still need it */
        memcpy(r->in_file, r->shown, (size_t)r->p->space.n_dof * sizeof *r->shown);
        inside_nodes(r, r->in_file);
    }
    snprintf(name, sizeof name, "fields_%05d.vtu", r->n_file);
    snprintf(path, sizeof path, "%s/%s", r->dir, name);
    status = cell_fields(r, &cells, &memory, err);
    more.cells = &cells;
    if (!status)
        status =
            vtu_write_more(path, &r->p->space, out->field, out->n_field, r->in_file ? r->in_file : r->shown,
                           r->p->description.time.unsteady ? t : NAN, r->body_of_node ? &bodies : NULL, &more, err);
    arena_free(&memory);
    TRY(status);
    r->file[r->n_file] = strdup(name);
    if (!r->file[r->n_file])
        return error_memory(err, "list of files", 0);
    r->file_time[r->n_file++] = t;
    r->p->state.written = t;
    snprintf(path, sizeof path, "%s/fields.pvd", r->dir);
    TRY(vtu_write_pvd(path, (const char *const *)r->file, r->file_time, r->n_file, err));
    TRY(particles_outline(r, err));
    r->result->seconds_output += clock_seconds() - start;
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
    table_destroy(&r->integrals);
    table_destroy(&r->values);
    for (int i = 0; i < r->n_body_file; i++)
        free(r->body_file[i]);
    free(r->body_file);
    for (int i = 0; i < r->n_file; i++)
        free(r->file[i]);
    free(r->file);
    free(r->file_time);
    free(r->time);
    text_free(&r->results);
    arena_free(&r->memory);
    if (r->log_fd > 0)
        close(r->log_fd);
}
