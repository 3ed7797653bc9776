/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Fields that the equations fix only up to a constant, like the pressure of an enclosed flow.
 *
 * Found on the matrix itself: field f has a free constant if no value of it is prescribed and
 * J 1_f = 0 and 1_f^T J = 0 to round-off.  Then its equations hold only for data whose sum
 * vanishes; the part that does not is taken out of the residual in proportion to the integral
 * of each test function, and one value is held, which leaves all equations satisfied. */
#include "solve/solve.h"

#include <math.h>
#include <string.h>

#define ROUND_OFF 1e-9

double gauge_weights(const space *s, int field, double *weight)
{
    const mesh *m = s->mesh;
    const fe_cell *c = m->type;
    int order = s->field[field].order, n = fe_n_basis(c, order);
    fe_rule rule;
    error ignored;
    double volume = 0;

    fe_rule_cell(c, 5, &rule, &ignored);
    memset(weight, 0, (size_t)s->n_dof * sizeof *weight);
    for (int q = 0; q < rule.n; q++) {
        double g[FE_MAX_NODES], dg[FE_MAX_NODES][3], b[FE_MAX_NODES], db[FE_MAX_NODES][3];

        fe_basis(c, 2, rule.x[q], g, dg);
        fe_basis(c, order, rule.x[q], b, db);
        for (int64_t e = 0; e < m->n_cell; e++) {
            double j[3][3], at_x[3], det = mesh_map(m, e, g, (const double(*)[3])dg, at_x, j);

            volume += rule.w[q] * det;
            for (int i = 0; i < n; i++) {
                int64_t at = s->first[field][space_carrier(s, e, assemble_local(s, field, i))];

                for (int k = 0; k < s->field[field].n_comp; k++)
                    weight[at + k] += rule.w[q] * det * b[i];
            }
        }
    }
    return volume;
}

/* Whether the constant of field f is in both null spaces of the matrix. */
static int has_constant(const newton_system *s, int f)
{
    const space *sp = s->space;
    const linear *l = &s->linear;
    double tolerance = s->gauge.tolerance > 0 ? s->gauge.tolerance : ROUND_OFF;
    double *left = s->work, left_sum = 0, left_abs = 0, right_sum = 0, right_abs = 0;

    memset(left, 0, (size_t)sp->n_dof * sizeof *left);
    for (int64_t i = 0; i < sp->n_free; i++) {
        int row_is_f = sp->dof_field[sp->dof_of[i]] == f;
        double sum = 0, size = 0;

        if (s->assembly.idle[sp->dof_of[i]])
            continue;

        for (int64_t k = sp->row[i]; k < sp->row[i + 1]; k++) {
            double v = l->value[k];

            if (sp->dof_field[sp->dof_of[sp->col[k]]] == f) {
                sum += v;
                size += fabs(v);
            }
            if (row_is_f) {
                left[sp->col[k]] += v;
                left_abs += v * v;
            }
        }
        right_sum += sum * sum;
        right_abs += size * size;
    }
    for (int64_t i = 0; i < sp->n_free; i++)
        left_sum += left[i] * left[i];
    return right_abs > 0 && left_abs > 0 && sqrt(right_sum) <= tolerance * sqrt(right_abs) &&
           sqrt(left_sum) <= tolerance * sqrt(left_abs);
}

int gauge_detect(newton_system *s, error *err)
{
    space *sp = s->space;

    if (s->gauge.known)
        return 0;
    for (int f = 0; f < sp->n_field; f++) {
        int prescribed = sp->field[f].n_comp != 1 || sp->field[f].support != PF_ON_MESH;

        for (int64_t d = 0; d < sp->n_dof && !prescribed; d++)
            prescribed = sp->dof_field[d] == f && sp->fixed[d];
        s->gauge.free[f] = !prescribed && has_constant(s, f);
        if (s->gauge.free[f]) {
            ARENA_NEW(&s->memory, s->gauge.weight[f], sp->n_dof, err);
            s->gauge.volume = gauge_weights(sp, f, s->gauge.weight[f]);
        }
    }
    s->gauge.known = 1;
    return 0;
}

int gauge_holds(newton_system *s)
{
    int holds = 1;

    for (int f = 0; f < s->space->n_field; f++)
        if (s->gauge.free[f] && !has_constant(s, f))
            holds = s->gauge.free[f] = 0;
    return holds;
}

void gauge_project(newton_system *s, double *residual)
{
    const space *sp = s->space;

    for (int f = 0; f < sp->n_field; f++) {
        double sum = 0, volume = 0;

        if (!s->gauge.free[f])
            continue;
        for (int64_t d = 0; d < sp->n_dof; d++)
            if (sp->dof_field[d] == f && !s->assembly.idle[d])
                sum += residual[d], volume += s->gauge.weight[f][d];
        for (int64_t d = 0; d < sp->n_dof; d++)
            if (sp->dof_field[d] == f && !s->assembly.idle[d])
                residual[d] -= sum / volume * s->gauge.weight[f][d];
        s->gauge.defect[f] = sum;
    }
}

void gauge_pin(newton_system *s)
{
    const space *sp = s->space;
    linear *l = &s->linear;

    for (int f = 0; f < sp->n_field; f++) {
        int64_t pin = 0;

        if (!s->gauge.free[f])
            continue;
        while (sp->dof_field[sp->dof_of[pin]] != f || s->assembly.idle[sp->dof_of[pin]])
            pin++;
        for (int64_t k = sp->row[pin]; k < sp->row[pin + 1]; k++) {
            int64_t j = sp->col[k];

            l->value[k] = j == pin;
            for (int64_t m = sp->row[j]; j != pin && m < sp->row[j + 1]; m++)
                if (sp->col[m] == pin)
                    l->value[m] = 0;
        }
        s->rhs[pin] = 0;
    }
}

void gauge_zero_mean(const newton_system *s, double *x)
{
    const space *sp = s->space;

    for (int f = 0; f < sp->n_field; f++) {
        double mean = 0, volume = 0;

        if (!s->gauge.free[f])
            continue;
        for (int64_t d = 0; d < sp->n_dof; d++)
            if (sp->dof_field[d] == f && !s->assembly.idle[d]) {
                mean += s->gauge.weight[f][d] * x[d];
                volume += s->gauge.weight[f][d];
            }
        for (int64_t d = 0; d < sp->n_dof; d++)
            if (sp->dof_field[d] == f && !s->assembly.idle[d])
                x[d] -= mean / volume;
    }
}
