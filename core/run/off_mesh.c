/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Fields that live off the mesh, in the tables: those of bodies, beside their velocity and spin, as columns of
 * particles.csv, those of the problem in problem.csv. */
#include "run/run.h"

#include <stdio.h>
#include <stdlib.h>

int off_mesh_fields(const run *r, uint32_t support, int *list)
{
    const problem *p = r->p;
    int n = 0;

    for (int f = 0; f < p->space.n_field; f++)
        if (p->space.field[f].support == (int)support && f != p->bodies.field_velocity && f != p->bodies.field_spin)
            list[n++] = f;
    return n;
}

int off_mesh_columns(const run *r, uint32_t support, char (*name)[OFF_MESH_NAME])
{
    int list[SPACE_MAX_FIELDS], n = 0;

    for (int i = 0, fields = off_mesh_fields(r, support, list); i < fields; i++) {
        const field_spec *f = &r->p->space.field[list[i]];

        for (int k = 0; k < f->n_comp; k++, n++)
            if (f->n_comp == 1)
                snprintf(name[n], sizeof *name, "%s", f->name);
            else
                snprintf(name[n], sizeof *name, "%s_%s", f->name, term_component((uint32_t)f->shape, f->n_comp, k));
    }
    return n;
}

double *off_mesh_values(const run *r, uint32_t support, int32_t carrier, double *to)
{
    int list[SPACE_MAX_FIELDS];

    for (int i = 0, n = off_mesh_fields(r, support, list); i < n; i++)
        for (int k = 0; k < r->p->space.field[list[i]].n_comp; k++)
            *to++ = r->x[r->p->space.first[list[i]][carrier] + k];
    return to;
}

int problem_table_plan(run *r, error *err)
{
    char path[4600], name[OFF_MESH_MOST][OFF_MESH_NAME];
    const char *column[OFF_MESH_MOST + 1] = {"t"};
    int n = off_mesh_columns(r, PF_ON_PROBLEM, name);

    if (n == 0)
        return 0;
    for (int i = 0; i < n; i++)
        column[i + 1] = name[i];
    snprintf(path, sizeof path, "%s/problem.csv", r->dir);
    return table_create(&r->values, path, column, n + 1, err);
}

int problem_table_add(run *r, double t, error *err)
{
    double row[OFF_MESH_MOST + 1] = {t};

    if (r->values.n_column == 0)
        return 0;
    off_mesh_values(r, PF_ON_PROBLEM, (int32_t)r->p->mesh.n_node, row + 1);
    return table_add(&r->values, row, err);
}
