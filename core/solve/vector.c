/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Sums over unknowns and updates of vectors of them, see vector.h. */
#include "solve/vector.h"

#include <string.h>

/* Sums are of pieces of a size that depends on the number of entries only, added in their order: the same whatever
 * the number of threads. */
enum { PIECE = 4096, MOST_PIECES = 256 };

static int64_t piece_of(int64_t n)
{
    return n <= PIECE * MOST_PIECES ? PIECE : (n + MOST_PIECES - 1) / MOST_PIECES;
}

double vector_dot(int64_t n, const double *restrict a, const double *restrict b)
{
    const int64_t piece = piece_of(n), n_piece = (n + piece - 1) / piece;
    double part[MOST_PIECES], sum = 0;

#pragma omp parallel for if (n >= VECTOR_THREADED) schedule(static)
    for (int64_t p = 0; p < n_piece; p++) {
        const int64_t end = (p + 1) * piece < n ? (p + 1) * piece : n;
        double s = 0;

#pragma omp simd reduction(+ : s)
        for (int64_t i = p * piece; i < end; i++)
            s += a[i] * b[i];
        part[p] = s;
    }
    for (int64_t p = 0; p < n_piece; p++)
        sum += part[p];
    return sum;
}

double vector_norm(int64_t n, const double *a)
{
    return sqrt(vector_dot(n, a, a));
}

void vector_divide(int64_t n, double c, const double *a, double *y)
{
#pragma omp parallel for simd if (parallel : n >= VECTOR_THREADED) schedule(static)
    for (int64_t i = 0; i < n; i++)
        y[i] = a[i] / c;
}

void vector_add(int64_t n, double c, const double *a, double *y)
{
#pragma omp parallel for simd if (parallel : n >= VECTOR_THREADED) schedule(static)
    for (int64_t i = 0; i < n; i++)
        y[i] += c * a[i];
}

void vector_subtract(int64_t n, const double *a, double *y)
{
#pragma omp parallel for simd if (parallel : n >= VECTOR_THREADED) schedule(static)
    for (int64_t i = 0; i < n; i++)
        y[i] = a[i] - y[i];
}

void vector_negative(const space *s, const double *dof, double *free_)
{
    for (int64_t i = 0; i < s->n_free; i++)
        free_[i] = -dof[s->dof_of[i]];
}

void vector_step(const space *s, double length, const double *free_, double *dof)
{
    for (int64_t i = 0; i < s->n_free; i++)
        dof[s->dof_of[i]] += length * free_[i];
}

void vector_count(const space *s, int64_t *out)
{
    memset(out, 0, (size_t)s->n_field * sizeof *out);
    for (int64_t i = 0; i < s->n_free; i++)
        out[s->dof_field[s->dof_of[i]]]++;
}

/* Squares of value[dof_of[i]] or, of a free vector, of value[i], by field. */
static void squares(const space *s, int is_free, const double *value, double *out)
{
    const int64_t n = s->n_free, piece = piece_of(n), n_piece = (n + piece - 1) / piece;
    double part[MOST_PIECES][SPACE_MAX_FIELDS];

#pragma omp parallel for if (n >= VECTOR_THREADED) schedule(static)
    for (int64_t p = 0; p < n_piece; p++) {
        const int64_t end = (p + 1) * piece < n ? (p + 1) * piece : n;

        memset(part[p], 0, sizeof part[p]);
        for (int64_t i = p * piece; i < end; i++) {
            const double v = value[is_free ? i : s->dof_of[i]];

            part[p][s->dof_field[s->dof_of[i]]] += v * v;
        }
    }
    memset(out, 0, (size_t)s->n_field * sizeof *out);
    for (int64_t p = 0; p < n_piece; p++)
        for (int f = 0; f < s->n_field; f++)
            out[f] += part[p][f];
}

void vector_squares(const space *s, const double *dof, double *out)
{
    squares(s, 0, dof, out);
}

void vector_squares_free(const space *s, const double *free_, double *out)
{
    squares(s, 1, free_, out);
}

void vector_largest_free(const space *s, const double *free_, double *out)
{
    memset(out, 0, (size_t)s->n_field * sizeof *out);
    for (int64_t i = 0; i < s->n_free; i++) {
        int f = s->dof_field[s->dof_of[i]];

        out[f] = fmax(out[f], fabs(free_[i]));
    }
}

int vector_field_prescribed(const space *s, int field)
{
    int any = 0;

    for (int64_t d = 0; d < s->n_dof && !any; d++)
        any = s->dof_field[d] == field && s->fixed[d];
    return any;
}

double vector_field_sum(const space *s, const uint8_t *idle, int field, const double *dof)
{
    double sum = 0;

    for (int64_t d = 0; d < s->n_dof; d++)
        if (s->dof_field[d] == field && !idle[d])
            sum += dof[d];
    return sum;
}

double vector_field_dot(const space *s, const uint8_t *idle, int field, const double *a, const double *b)
{
    double sum = 0;

    for (int64_t d = 0; d < s->n_dof; d++)
        if (s->dof_field[d] == field && !idle[d])
            sum += a[d] * b[d];
    return sum;
}

void vector_field_add(const space *s, const uint8_t *idle, int field, double c, const double *a, double *y)
{
    for (int64_t d = 0; d < s->n_dof; d++)
        if (s->dof_field[d] == field && !idle[d])
            y[d] += a ? c * a[d] : c;
}

double vector_prescribed_dot(const space *s, int field, const double *a, const double *b)
{
    double sum = 0;

    for (int64_t d = 0; d < s->n_dof; d++)
        sum += s->dof_field[d] == field && s->fixed[d] == SPACE_PRESCRIBED ? a[d] * b[d] : 0;
    return sum;
}
