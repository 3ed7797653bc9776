/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "support/small_system.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <string.h>

void small_make(small_system *f, const pf_solver *solver, uint32_t flags, const char *fields,
                const pf_term *const *terms)
{
    static const pf_field field[] = {{.name = "a", .shape = PF_SCALAR, .order = 1},
                                     {.name = "b", .shape = PF_SCALAR, .order = 1},
                                     {.name = "w", .shape = PF_VECTOR, .order = 1}};
    mesh_box box = {.dim = 2, .high = {1, 1}, .n = {3, 3}};
    term_use *use[SMALL_MAX_USES];
    assembly_spec spec = {.where = PF_CELL, .use = use};
    int status;

    memset(f, 0, sizeof *f);
    status = registry_create(&f->r, NULL, 0, &f->err) || mesh_create_box(&box, &f->m, &f->err) ||
             mesh_measure(&f->m, &f->err);
    if (!status && !solver)
        status = registry_solver(&f->r, "solver_umfpack", &solver, &f->err);
    for (int i = 0; i < 3 && !status; i++)
        if (strchr(fields, *field[i].name))
            status = fields_add(&f->fields, 2, &field[i], "test", &f->err);
    status = status || space_number(&f->s, &f->fields, &f->m, 0, &f->err) || space_constrain(&f->s, &f->err);
    f->plugin.d.name = "test";
    for (; terms[spec.n_use]; spec.n_use++) {
        int i = spec.n_use;

        f->term[i] = *terms[i];
        f->term[i].flags = flags;
        f->number[i] = (small_numbers){1, 1};
        f->use[i] = (term_use){
            .plugin = &f->plugin,
            .term = &f->term[i],
            .where = PF_CELL,
            .params = &f->number[i],
        };
        use[i] = &f->use[i];
    }
    if (status || system_create(&f->sys, &f->s, &spec, 1, &(linear_choice){.direct = solver}, 1, &f->err))
        fail_msg("%s", f->err.text);
    assert_true(f->s.n_dof <= SMALL_MAX_DOFS);
}

void small_destroy(small_system *f)
{
    system_destroy(&f->sys);
    registry_destroy(&f->r);
    space_destroy(&f->s);
    mesh_destroy(&f->m);
}

int small_solve(small_system *f, const newton_options *o)
{
    return newton_solve(&f->sys, &(newton_time){0}, o, f->x, &f->report, &f->err);
}

void small_set(small_system *f, double v)
{
    for (int64_t d = 0; d < f->s.n_dof; d++)
        f->x[d] = v;
}

void assert_near(double v, double expected, double tolerance)
{
    if (!(fabs(v - expected) <= tolerance))
        fail_msg("%.17g, expected %.17g to %g", v, expected, tolerance);
}

void assert_said(const char *text, const char *part)
{
    if (!strstr(text, part))
        fail_msg("\"%s\" does not say \"%s\"", text, part);
}

void assert_field(const small_system *f, const char *name, double expected)
{
    for (int64_t d = 0; d < f->s.n_dof; d++)
        if (strcmp(f->s.field[f->s.dof_field[d]].name, name) == 0)
            assert_near(f->x[d], expected, 1e-9);
}
