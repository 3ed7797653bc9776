/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * lines/NAME.csv: fields along lines, at the end of a run. */
#include "run/run.h"
#include "run/showing.h"

#include "space/locate.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static void point_of(const line_spec *q, int k, double *x)
{
    for (int d = 0; d < 3; d++)
        x[d] = q->from[d] + (q->to[d] - q->from[d]) * k / (q->n - 1);
}

int lines_locate(run *r, error *err)
{
    const output_spec *o = &r->p->description.output;

    ARENA_NEW(&r->memory, r->line_at, o->n_line + 1, err);
    for (int i = 0; i < o->n_line; i++) {
        const line_spec *q = &o->line[i];
        int outside = 0;

        ARENA_NEW(&r->memory, r->line_at[i], q->n, err);
        for (int k = 0; k < q->n; k++) {
            double x[3];

            point_of(q, k, x);
            r->line_at[i][k] = locate_point(&r->p->mesh, &r->p->grid, x);
            outside += r->line_at[i][k].cell < 0;
        }
        if (outside)
            warning_add(&r->p->warnings,
                        "%s:%d: output: line \"%s\": %d of its %d points lie outside of the mesh and "
                        "stay empty",
                        o->block->file, o->block->line, q->name, outside, q->n);
    }
    return 0;
}

static void add_header(const run *r, text *s)
{
    const problem *p = r->p;
    const field_spec *shown;
    const int n_shown = showing_fields(r, &shown);

    text_add(s, "t");
    for (int d = 0; d < p->mesh.dim; d++)
        text_add(s, ",%c", "xyz"[d]);
    for (int f = 0; f < p->space.n_field; f++) {
        char name[VALUE_MAX][96];

        for (int k = 0, n = output_components(&p->space.field[f], "", name); k < n; k++)
            text_add(s, ",%s", name[k]);
    }
    for (int f = 0; f < n_shown; f++) {
        char name[9][96];

        for (int k = 0, n = output_components(&shown[f], "", name); k < n; k++)
            text_add(s, ",%s", name[k]);
    }
    text_add(s, p->bodies.n ? ",body\n" : "\n");
}

static void add_values(const double *v, int n, text *s)
{
    for (int c = 0; c < n; c++) {
        text_add(s, ",");
        if (isfinite(v[c]))
            text_number(s, v[c]);
    }
}

/* One point; outside the mesh, and where a field has no value, an empty cell. */
static void add_point(const run *r, const located *at, const double *x, double t, text *s)
{
    const problem *p = r->p;
    const body_place *in = at->cell >= 0 ? inside_place(r, x) : NULL;
    const field_spec *shown;
    const int n_shown = showing_fields(r, &shown);

    text_number(s, t);
    for (int d = 0; d < p->mesh.dim; d++) {
        text_add(s, ",");
        text_number(s, x[d]);
    }
    for (int f = 0; f < p->space.n_field; f++) {
        double v[VALUE_MAX];

        if (!output_has_columns(&p->space.field[f]))
            continue;
        for (int c = 0; c < VALUE_MAX; c++)
            v[c] = NAN;
        if (at->cell >= 0)
            locate_value(&p->space, at, f, r->shown, v, NULL);
        if (at->cell >= 0)
            inside_value(r, in, f, x, v);
        add_values(v, p->space.field[f].n_comp, s);
    }
    for (int f = 0; f < n_shown; f++) {
        double v[9] = {NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN};

        if (at->cell >= 0)
            showing_value(r, f, at, in, v);
        add_values(v, shown[f].n_comp, s);
    }
    if (p->bodies.n && at->cell >= 0)
        text_add(s, ",%d\n", in ? in->body : -1);
    else
        text_add(s, p->bodies.n ? ",\n" : "\n");
}

int lines_write(run *r, double t, error *err)
{
    const output_spec *o = &r->p->description.output;
    char path[4600];

    if (o->n_line) {
        snprintf(path, sizeof path, "%s/lines", r->dir);
        TRY(file_make_dir(path, err));
        TRY(showing_take(r, err));
    }
    for (int i = 0; i < o->n_line; i++) {
        const line_spec *q = &o->line[i];
        text s = {0};
        int status;

        add_header(r, &s);
        for (int k = 0; k < q->n; k++) {
            double x[3];

            point_of(q, k, x);
            add_point(r, &r->line_at[i][k], x, t, &s);
        }
        snprintf(path, sizeof path, "%s/lines/%s.csv", r->dir, q->name);
        status = s.failed ? error_memory(err, path, 0) : file_write(path, s.s, s.n, err);
        text_free(&s);
        TRY(status);
    }
    return 0;
}
