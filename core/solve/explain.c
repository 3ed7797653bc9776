/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What a user needs to know when numbers fail: who returned what is not finite, and which unknowns a singular
 * matrix leaves open. */
#include "base/text.h"
#include "solve/solve.h"
#include "solve/vector.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct unknown_name {
    char s[200];
} unknown_name;

/* "p at (0.5, 0.2)", "u[1] at (0.5, 0.2)", "T_xy at (0, 1)", "U[2] of particle 3", "Phi". */
static unknown_name name_of(const space *s, int64_t dof)
{
    const field_spec *f = &s->field[s->dof_field[dof]];
    int64_t carrier = s->dof_node[dof];
    unknown_name n;
    double x[3];
    int at = snprintf(n.s, sizeof n.s, "%.60s", f->name);

    if (term_is_tensor((uint32_t)f->shape))
        at += snprintf(n.s + at, sizeof n.s - (size_t)at, "_%s",
                       term_component((uint32_t)f->shape, f->n_comp, s->dof_comp[dof]));
    else if (f->n_comp > 1)
        at += snprintf(n.s + at, sizeof n.s - (size_t)at, "[%d]", s->dof_comp[dof] + 1);
    if (space_place(s, carrier, x))
        snprintf(n.s + at, sizeof n.s - (size_t)at, " at %s", text_point(x, s->mesh->dim).s);
    else if (carrier > s->mesh->n_node)
        snprintf(n.s + at, sizeof n.s - (size_t)at, " of particle %lld",
                 (long long)(carrier - s->mesh->n_node - 1));
    return n;
}

/* No term is to blame: names the first row that is not finite. */
static int name_row(const newton_system *s, error *err)
{
    const space *sp = s->space;

    for (int64_t i = 0; i < sp->n_free; i++) {
        double residual = s->residual[sp->dof_of[i]];

        if (!isfinite(residual))
            return error_set(err, ERR_CONVERGE,
                             "the residual of %s is %g, though what the terms return is finite: numbers overflow",
                             name_of(sp, sp->dof_of[i]).s, residual);
        for (int64_t k = sp->row[i]; k < sp->row[i + 1]; k++)
            if (!isfinite(s->linear.value[k]))
                return error_set(
                    err, ERR_CONVERGE,
                    "the derivative of the equation of %s by %s is %g, though what the terms return is finite: "
                    "numbers overflow",
                    name_of(sp, sp->dof_of[i]).s, name_of(sp, sp->dof_of[space_column(sp, i, k)]).s,
                    s->linear.value[k]);
    }
    return error_set(err, ERR_CONVERGE, "the residual is finite, but too large to be measured: numbers overflow");
}

int explain_nan(newton_system *s, const newton_time *time, const double *x, error *err)
{
    int status = system_evaluate(s, time, x, 1, 1, err);

    if (!status)
        status = name_row(s, err);
    err->retry = time->history != NULL; /* a smaller step may avoid it */
    return status;
}

int explain_is_finite(const newton_system *s)
{
    const space *sp = s->space;
    int finite = 1;

    for (int64_t k = 0; k < sp->row[sp->n_free]; k++)
        finite &= isfinite(s->linear.value[k]) != 0;
    for (int64_t i = 0; i < sp->n_free; i++)
        finite &= isfinite(s->rhs[i]) != 0;
    return finite;
}

/* First unknown that no equation contains (which: 0), or whose equation contains no unknown (1); their number. */
static int64_t find_empty(newton_system *s, int which, int64_t *first)
{
    const space *sp = s->space;
    double *most = s->work;
    int64_t n = 0;

    memset(most, 0, (size_t)sp->n_free * sizeof *most);
    for (int64_t i = 0; i < sp->n_free; i++)
        for (int64_t k = sp->row[i]; k < sp->row[i + 1]; k++) {
            double *m = &most[which ? i : space_column(sp, i, k)];

            *m = fmax(*m, fabs(s->linear.value[k]));
        }
    for (int64_t i = sp->n_free - 1; i >= 0; i--)
        if (most[i] == 0) {
            *first = sp->dof_of[i];
            n++;
        }
    return n;
}

/* A field, or a component of one, to which a constant may be added; its index, or -1. */
static int find_constant(newton_system *s, int *component)
{
    const space *sp = s->space;
    double *sum = s->work, *size = s->trial;

    for (int f = 0; f < sp->n_field; f++)
        for (*component = 0; *component < sp->field[f].n_comp; ++*component) {
            for (int64_t i = 0; i < sp->n_free; i++) {
                sum[i] = size[i] = 0;
                for (int64_t k = sp->row[i]; k < sp->row[i + 1]; k++) {
                    int64_t d = sp->dof_of[space_column(sp, i, k)];

                    if (sp->dof_field[d] == f && sp->dof_comp[d] == *component) {
                        sum[i] += s->linear.value[k];
                        size[i] += fabs(s->linear.value[k]);
                    }
                }
            }
            if (vector_norm(sp->n_free, sum) < 1e-9 * vector_norm(sp->n_free, size))
                return f;
        }
    return -1;
}

/* Which unknowns the matrix leaves open. */
static void explain_open(newton_system *s, error *err)
{
    static const char *const what[] = {"no equation contains ", "no unknown stands in the equation of "};
    const space *sp = s->space;
    size_t at = strlen(err->text), room = sizeof err->text - at;
    int64_t first, n;
    int f, component;

    for (int which = 0; which < 2; which++) {
        n = find_empty(s, which, &first);
        if (n > 1)
            snprintf(err->text + at, room,
                     ": %s%s and %lld other unknowns; is a term or a boundary condition missing?", what[which],
                     name_of(sp, first).s, (long long)(n - 1));
        else if (n)
            snprintf(err->text + at, room, ": %s%s; is a term or a boundary condition missing?", what[which],
                     name_of(sp, first).s);
        if (n)
            return;
    }
    f = find_constant(s, &component);
    if (f >= 0 && sp->field[f].n_comp > 1)
        snprintf(err->text + at, room,
                 ": %s[%d] is fixed only up to a constant; is a boundary condition for %s missing?",
                 sp->field[f].name, component + 1, sp->field[f].name);
    else if (f >= 0)
        snprintf(err->text + at, room,
                 ": %s is fixed only up to a constant; is a boundary condition for %s missing?", sp->field[f].name,
                 sp->field[f].name);
    else
        snprintf(
            err->text + at, room,
            ": all unknowns have equations and stand in some, but some combination of unknowns is left open; is "
            "a coefficient zero, or a boundary condition missing?");
}

void explain_singular(newton_system *s, error *err)
{
    const char *said = s->linear.said;
    size_t at;

    explain_open(s, err);
    at = strlen(err->text);
    if (*said)
        snprintf(err->text + at, sizeof err->text - at, " (linear solver %s: %s)", linear_solver(&s->linear)->name,
                 said);
}
