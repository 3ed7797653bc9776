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

/* What the rows of some fields (NULL: of all) add up with these sizes of the unknowns: row[i] = (|J| size)_i, 0 for
 * dummies (NULL: not wanted), and might[i], what the row would make of its unknown if nothing balanced it, 0 where
 * the diagonal all but vanishes. */
static void add_up(const newton_system *s, const int *of, const double *size, double *might, double *row)
{
    const space *sp = s->space;
    const double *a = s->linear.value;

#pragma omp parallel for num_threads(s->assembly.n_thread) if (sp->row[sp->n_free] >= VECTOR_THREADED)             \
    schedule(static)
    for (int64_t i = 0; i < sp->n_free; i++) {
        const int64_t end = sp->row[i + 1], d = sp->dof_of[i];
        double sum = 0, diagonal = 0, largest = 0;

        if (of && !of[sp->dof_field[d]])
            continue;
        for (int64_t k = sp->row[i]; k < end; k++) {
            double v = fabs(a[k]);

            sum += v * size[space_column(sp, i, k)];
            largest = v > largest ? v : largest;
            diagonal = space_column(sp, i, k) == i ? v : diagonal;
        }
        might[i] = diagonal > 1e-8 * largest ? (sum + fabs(s->residual[d])) / diagonal : 0;
        if (row)
            row[i] = is_dummy(s, i) ? 0 : sum;
    }
}

/* Sizes with a step, and with what they might be where that is not NULL and their field vanishes; none counts for
 * less than the mean of its field. */
static void enlarge(const newton_system *s, const double *size, const double *step, const double *might,
                    const int *vanishes, double *grown)
{
    const space *sp = s->space;
    double mean[SPACE_MAX_FIELDS];
    int64_t n[SPACE_MAX_FIELDS];

    for (int64_t i = 0; i < sp->n_free; i++)
        grown[i] =
            size[i] + (step ? fabs(step[i]) : 0) + (might && vanishes[sp->dof_field[sp->dof_of[i]]] ? might[i] : 0);
    vector_count(sp, n);
    vector_squares_free(sp, grown, mean);
    for (int f = 0; f < sp->n_field; f++)
        mean[f] = n[f] ? sqrt(mean[f] / (double)n[f]) : 0;
    for (int64_t i = 0; i < sp->n_free; i++)
        grown[i] = fmax(grown[i], mean[sp->dof_field[sp->dof_of[i]]]);
}

/* Fields below what they might be, to round-off; how many. */
static int find_below(const space *sp, const double *size, const double *might, int *below)
{
    double most[SPACE_MAX_FIELDS], most_might[SPACE_MAX_FIELDS];
    int n = 0;

    vector_largest_free(sp, size, most);
    vector_largest_free(sp, might, most_might);
    for (int f = 0; f < sp->n_field; f++) {
        below[f] = most[f] < VANISHES * most_might[f];
        n += below[f];
    }
    return n;
}

/* As a rule one pass over the matrix: sizes with the step are larger, so a field that is not below what it might be
 * by them is not by those without. */
void scale_fields(newton_system *s, const double *x, const double *step, double *scale)
{
    const space *sp = s->space;
    double *size = s->scale, *grown = s->trial, *might = s->rhs, *row = s->work, most[SPACE_MAX_FIELDS];
    int below[SPACE_MAX_FIELDS];

    for (int64_t i = 0; i < sp->n_free; i++)
        size[i] = fabs(x[sp->dof_of[i]]);
    enlarge(s, size, step, NULL, NULL, grown);
    add_up(s, NULL, grown, might, row);
    if (find_below(sp, size, might, below)) {
        add_up(s, below, size, might, NULL);
        if (find_below(sp, size, might, below)) {
            enlarge(s, size, step, might, below, grown);
            add_up(s, NULL, grown, might, row);
        }
    }
    vector_largest_free(sp, size, most);
    vector_squares_free(sp, row, scale);
    for (int f = 0; f < sp->n_field; f++) {
        s->vanishes[f] = below[f] || most[f] == 0;
        scale[f] = sqrt(scale[f]);
    }
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
