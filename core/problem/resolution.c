/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A warning where no cell comes near to resolving the flow that is prescribed: the cell Reynolds number
 *
 *     Re_h = rho |u| h / mu
 *
 * of the smallest cell with the largest speed on the boundary.  Newton's method may well converge there, to numbers
 * that have little to do with a flow. */
#include "problem/problem.h"

#include <math.h>
#include <string.h>

/* Steady laminar benchmarks are computed with up to some hundred. */
#define MOST_CELL_REYNOLDS 1000

static int has_slot(const pf_slot *slot, uint32_t n, const char *field, uint32_t eval)
{
    for (uint32_t i = 0; i < n; i++)
        if (slot[i].eval == eval && strcmp(slot[i].field, field) == 0)
            return 1;
    return 0;
}

/* 0: it is none, or a property that another term publishes, and so another one everywhere. */
static double number_of(const term_use *u, const char *name)
{
    const pf_param *q = describe_param(u, name);
    double v = 0;

    for (uint32_t k = 0; k < u->term->n_in; k++)
        if (u->law[k] && strcmp(u->term->in[k].field, name) == 0)
            return 0;
    if (q && q->type == PF_T_REAL)
        memcpy(&v, (const char *)u->params + q->offset, sizeof v);
    return v;
}

int problem_carries(const term_use *u, const char *field)
{
    const pf_term *t = u->term;
    int slopes = has_slot(t->in, t->n_in, field, PF_GRAD) || has_slot(t->in, t->n_in, field, PF_DIV);

    return u->where <= PF_FLUID && !(t->flags & PF_LINEAR) && has_slot(t->in, t->n_in, field, PF_VALUE) && slopes &&
           t->n_out == 1 && has_slot(t->out, t->n_out, field, PF_VALUE);
}

void problem_numbers(const description *d, const char *field, double *density, double *viscosity)
{
    *density = *viscosity = 0;
    for (int i = 0; i < d->n_use; i++) {
        const term_use *u = &d->use[i];
        const pf_term *t = u->term;

        if (u->where > PF_FLUID || !has_slot(t->in, t->n_in, field, PF_GRAD))
            continue;
        if (problem_carries(u, field))
            *density = fmax(*density, number_of(u, "density"));
        if (term_diffuses(t, field))
            *viscosity += number_of(u, "viscosity");
    }
}

/* The largest prescribed speed of a field at time t. */
static int prescribed_speed(const problem *p, int field, double t, double *x, double *speed, error *err)
{
    const space *s = &p->space;

    memset(x, 0, (size_t)s->n_dof * sizeof *x);
    TRY(conditions_values(&p->conditions, s, t, x, err));
    for (int64_t c = 0; c < s->mesh->n_node; c++) {
        double v = 0;

        for (int k = 0; s->first[field][c] >= 0 && k < s->field[field].n_comp; k++)
            v += pow(x[s->first[field][c] + k], 2);
        *speed = fmax(*speed, sqrt(v));
    }
    return 0;
}

int problem_check_resolution(problem *p, error *err)
{
    const description *d = &p->description;
    double h = INFINITY, *x;

    for (int64_t e = 0; e < p->mesh.n_cell; e++)
        h = fmin(h, p->mesh.h[e]);
    ARENA_NEW(&p->memory, x, p->space.n_dof, err);
    for (int f = 0; f < d->fields.n; f++) {
        double density, viscosity, speed = 0;

        if (d->fields.f[f].shape != PF_VECTOR || d->fields.f[f].support != PF_ON_MESH)
            continue;
        problem_numbers(d, d->fields.f[f].name, &density, &viscosity);
        if (!(density > 0 && viscosity > 0))
            continue;
        TRY(prescribed_speed(p, f, d->time.start, x, &speed, err));
        if (d->time.unsteady)
            TRY(prescribed_speed(p, f, d->time.stop, x, &speed, err));
        if (density * speed * h / viscosity > MOST_CELL_REYNOLDS)
            warning_add(
                &p->warnings,
                "the Reynolds number of the smallest cells is %.2g (density %g, speed %.3g, size %.3g, viscosity "
                "%g): no scale at which this flow dissipates is resolved, so a result has little to do with it; "
                "refine the mesh, or see whether the numbers are right",
                density * speed * h / viscosity, density, speed, h, viscosity);
    }
    return 0;
}
