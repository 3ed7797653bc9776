/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * How large a residual is, field by field, and which fields depend on which.
 *
 * The scale of a field is what its rows add up before they cancel, | |J| x~ |, J the last matrix formed, x~ the
 * size of the unknowns now; a field that vanishes has the size (|J| |x|)_j / |J_jj| that nothing balancing
 * its row would give it: so a velocity that is zero in the end is measured by the forces that might have moved it.
 * J is of the iterate before, or older where the problem is linear: at the end the two differ by the last step,
 * which is small (newton.c), so that no matrix is formed only to be compared with. */
#include "solve/solve.h"
#include "solve/vector.h"

#include <math.h>
#include <string.h>

/* A field below this, relative to what its equations might make of it, is zero but for round-off. */
#define VANISHES 1e-12

/* Rows that are no equations of the problem: of unknowns that are off, and of the value that a gauge holds. */
static int is_dummy(const newton_system *s, int64_t i)
{
    int64_t d = s->space->dof_of[i];
    int f = s->space->dof_field[d];

    return s->assembly.idle[d] || (s->gauge.free[f] && s->gauge.pin[f] == i);
}

/* might[i]: what the row would make of its unknown if nothing balanced it, 0 where the diagonal all but vanishes;
 * size [n_free] of the unknowns. */
static void might_be(const newton_system *s, const double *size, double *might)
{
    const space *sp = s->space;
    const double *a = s->linear.value;

    for (int64_t i = 0; i < sp->n_free; i++) {
        double sum = fabs(s->residual[sp->dof_of[i]]), diagonal = 0, largest = 0;

        for (int64_t k = sp->row[i]; k < sp->row[i + 1]; k++) {
            double v = fabs(a[k]);

            sum += v * size[sp->col[k]];
            largest = v > largest ? v : largest;
            diagonal = sp->col[k] == i ? v : diagonal;
        }
        might[i] = diagonal > 1e-8 * largest ? sum / diagonal : 0;
    }
}

/* Adds to the sizes of unknowns what they might be if their field vanishes, and a step; none counts for less than
 * the mean of its field. */
static void enlarge(newton_system *s, const double *might, const double *step, double *size)
{
    const space *sp = s->space;
    double most[SPACE_MAX_FIELDS], most_might[SPACE_MAX_FIELDS], mean[SPACE_MAX_FIELDS];
    int64_t n[SPACE_MAX_FIELDS];

    vector_largest_free(sp, size, most);
    vector_largest_free(sp, might, most_might);
    for (int64_t i = 0; i < sp->n_free; i++) {
        int f = sp->dof_field[sp->dof_of[i]];

        size[i] += (most[f] < VANISHES * most_might[f] ? might[i] : 0) + (step ? fabs(step[i]) : 0);
    }
    vector_count(sp, n);
    vector_squares_free(sp, size, mean);
    for (int f = 0; f < sp->n_field; f++) {
        s->vanishes[f] = most[f] < VANISHES * most_might[f] || most[f] == 0;
        mean[f] = n[f] ? sqrt(mean[f] / (double)n[f]) : 0;
    }
    for (int64_t i = 0; i < sp->n_free; i++)
        size[i] = fmax(size[i], mean[sp->dof_field[sp->dof_of[i]]]);
}

void scale_fields(newton_system *s, const double *x, const double *step, double *scale)
{
    const space *sp = s->space;
    const double *a = s->linear.value;
    double *size = s->scale, *row = s->work;

    for (int64_t i = 0; i < sp->n_free; i++)
        size[i] = fabs(x[sp->dof_of[i]]);
    might_be(s, size, row);
    enlarge(s, row, step, size);
    for (int64_t i = 0; i < sp->n_free; i++) {
        double sum = 0;

        for (int64_t k = sp->row[i]; k < sp->row[i + 1]; k++)
            sum += fabs(a[k]) * size[sp->col[k]];
        row[i] = is_dummy(s, i) ? 0 : sum;
    }
    vector_squares_free(sp, row, scale);
    for (int f = 0; f < sp->n_field; f++)
        scale[f] = sqrt(scale[f]);
}

/* From the squares of a field's rows to its norm; what is not finite stays NaN, so that it cannot pass for small.
 */
static double norm_of(double squares, double scale)
{
    if (!isfinite(squares) || !isfinite(scale))
        return NAN;
    return squares > 0 ? sqrt(squares) / (scale > 0 ? scale : 1) : 0;
}

double scale_norms(const newton_system *s, const double *scale, double *norm)
{
    double largest = 0;

    vector_squares(s->space, s->residual, norm);
    for (int f = 0; f < s->space->n_field; f++) {
        norm[f] = norm_of(norm[f], scale[f]);
        largest = vector_worse(norm[f], largest);
    }
    return largest;
}

void scale_norms_free(const newton_system *s, const double *free_, const double *scale, double *norm)
{
    vector_squares_free(s->space, free_, norm);
    for (int f = 0; f < s->space->n_field; f++)
        norm[f] = norm_of(norm[f], scale[f]);
}

double scale_change(const newton_system *s, const double *x, double length)
{
    const space *sp = s->space;
    double step[SPACE_MAX_FIELDS], size[SPACE_MAX_FIELDS], largest = 0;

    vector_squares_free(sp, s->step, step);
    vector_squares(sp, x, size);
    for (int f = 0; f < sp->n_field; f++)
        if (!s->vanishes[f] && size[f] != 0 && !s->gauge.free[f] && sp->field[f].support != PF_IN_PARTICLES)
            largest = vector_worse(length * sqrt(step[f] / size[f]), largest);
    return largest;
}

uint32_t scale_waiting(const newton_system *s, const double *norm, double tolerance)
{
    int n = s->space->n_field;
    uint32_t on[SPACE_MAX_FIELDS], waits = 0; /* on[f]: fields that f depends on, directly or through others */

    memcpy(on, s->coupled, sizeof on);
    for (int m = 0; m < n; m++)
        for (int f = 0; f < n; f++)
            on[f] |= on[f] >> m & 1 ? on[m] : 0;
    for (int f = 0; f < n; f++)
        for (int g = 0; g < n; g++)
            if ((on[f] >> g & 1) && !(on[g] >> f & 1) && !(norm[g] <= tolerance))
                waits |= 1u << f;
    return waits;
}
