/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Fields that the equations fix only up to a constant, like the pressure of an enclosed flow.
 *
 * Found on the matrix itself, on every one that is formed: field f has a free constant if no value of it is
 * prescribed and J 1_f = 0 and 1_f^T J = 0 to round-off.  Then its equations hold only for data whose sum
 * vanishes; the part that does not is taken out of the residual in proportion to the integral
 * of each test function, and one value is held, which leaves all equations satisfied. */
#include "solve/solve.h"
#include "solve/vector.h"
#include "space/evaluate.h"

#include <math.h>
#include <string.h>

#define ROUND_OFF 1e-9

/* The weights in use: over the fluid where bodies are, else over whole cells. */
static const double *weights(const gauge *g, int f)
{
    return g->weight[f] ? g->weight[f] : g->whole[f];
}

/* How far the constant of field f is from both null spaces of the matrix: |J 1_f| / | |J| 1_f | or the same from
 * the left, the larger one.  Rows: sum over the columns of f, sum of absolute values there, norm of the rows of f.
 */
static double constant_defect(newton_system *s, int f)
{
    const space *sp = s->space;
    const double *value = s->linear.value;
    double *sum = s->rhs, *size = s->scale, *square = s->trial, *left = s->work, right_size, left_size;

    memset(left, 0, (size_t)sp->n_free * sizeof *left);
    for (int64_t i = 0; i < sp->n_free; i++) {
        int row_is_f = sp->dof_field[sp->dof_of[i]] == f;

        sum[i] = size[i] = square[i] = 0;
        if (s->assembly.idle[sp->dof_of[i]])
            continue;
        for (int64_t k = sp->row[i]; k < sp->row[i + 1]; k++) {
            double v = value[k];

            if (sp->dof_field[sp->dof_of[sp->col[k]]] == f) {
                sum[i] += v;
                size[i] += fabs(v);
            }
            if (row_is_f) {
                left[sp->col[k]] += v;
                square[i] += v * v;
            }
        }
        square[i] = sqrt(square[i]);
    }
    right_size = vector_norm(sp->n_free, size);
    left_size = vector_norm(sp->n_free, square);
    if (!(right_size > 0 && left_size > 0))
        return INFINITY;
    return vector_worse(vector_norm(sp->n_free, sum) / right_size, vector_norm(sp->n_free, left) / left_size);
}

/* The first row of the field that takes part. */
static int64_t first_row(const newton_system *s, int f)
{
    const space *sp = s->space;
    int64_t i = 0;

    while (sp->dof_field[sp->dof_of[i]] != f || s->assembly.idle[sp->dof_of[i]])
        i++;
    return i;
}

int gauge_detect(newton_system *s, int *changed, error *err)
{
    space *sp = s->space;
    gauge *g = &s->gauge;
    double tolerance = g->tolerance > 0 ? g->tolerance : ROUND_OFF;

    *changed = g->approximate = 0;
    for (int f = 0; f < sp->n_field; f++) {
        int may = sp->field[f].n_comp == 1 && sp->field[f].support == PF_ON_MESH && !vector_field_prescribed(sp, f);
        double defect = may ? constant_defect(s, f) : INFINITY;
        int is_free = defect <= tolerance;

        g->approximate |= is_free && defect > ROUND_OFF;
        *changed |= is_free != g->free[f];
        g->free[f] = is_free;
        g->defect[f] = is_free ? g->defect[f] : 0;
        g->pin[f] = is_free ? first_row(s, f) : -1;
        if (is_free && !g->whole[f]) {
            ARENA_NEW(&s->memory, g->whole[f], sp->n_dof, err);
            TRY(space_integrals(sp, f, ASSEMBLE_CELL_DEGREE, g->whole[f], err));
        }
    }
    return 0;
}

void gauge_project(newton_system *s, double *residual)
{
    const space *sp = s->space;
    gauge *g = &s->gauge;

    for (int f = 0; f < sp->n_field; f++) {
        if (!g->free[f])
            continue;
        g->volume = vector_field_sum(sp, s->assembly.idle, f, weights(g, f));
        g->defect[f] = vector_field_sum(sp, s->assembly.idle, f, residual);
        vector_field_add(sp, s->assembly.idle, f, -(g->defect[f] / g->volume), weights(g, f), residual);
    }
}

double gauge_excess(const newton_system *s, const double *scale)
{
    const space *sp = s->space;
    const gauge *g = &s->gauge;
    double largest = 0;

    for (int f = 0; f < sp->n_field; f++)
        if (g->free[f]) {
            double size = sqrt(vector_field_dot(sp, s->assembly.idle, f, weights(g, f), weights(g, f))) / g->volume;

            largest = vector_worse(fabs(g->defect[f]) * size / (scale[f] > 0 ? scale[f] : 1), largest);
        }
    return largest;
}

int gauge_tell(newton_system *s, error *err)
{
    const double *integral[SPACE_MAX_FIELDS];

    for (int f = 0; f < s->space->n_field; f++)
        integral[f] = weights(&s->gauge, f);
    return linear_tell(&s->linear, s->assembly.idle, s->gauge.free, integral, s->gauge.pin, err);
}

void gauge_use(newton_system *s, const body_points *bodies)
{
    for (int f = 0; f < s->space->n_field; f++)
        s->gauge.weight[f] = bodies ? bodies->integral[f] : NULL;
}

void gauge_zero_mean(newton_system *s, const body_points *bodies, double *x)
{
    const space *sp = s->space;

    gauge_use(s, bodies);
    for (int f = 0; f < sp->n_field; f++) {
        const double *w = weights(&s->gauge, f);

        if (s->gauge.free[f])
            vector_field_add(
                sp, s->assembly.idle, f,
                -(vector_field_dot(sp, s->assembly.idle, f, w, x) / vector_field_sum(sp, s->assembly.idle, f, w)),
                NULL, x);
    }
}
