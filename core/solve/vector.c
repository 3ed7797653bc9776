/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Sums over unknowns and updates of vectors of them, see vector.h. */
#include "solve/vector.h"

#include <string.h>

double vector_dot(int64_t n, const double *a, const double *b)
{
    double s = 0;

    for (int64_t i = 0; i < n; i++)
        s += a[i] * b[i];
    return s;
}

double vector_norm(int64_t n, const double *a)
{
    return sqrt(vector_dot(n, a, a));
}

void vector_divide(int64_t n, double c, const double *a, double *y)
{
    for (int64_t i = 0; i < n; i++)
        y[i] = a[i] / c;
}

void vector_add(int64_t n, double c, const double *a, double *y)
{
    for (int64_t i = 0; i < n; i++)
        y[i] += c * a[i];
}

void vector_subtract(int64_t n, const double *a, double *y)
{
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

void vector_squares(const space *s, const double *dof, double *out)
{
    memset(out, 0, (size_t)s->n_field * sizeof *out);
    for (int64_t i = 0; i < s->n_free; i++) {
        int64_t d = s->dof_of[i];

        out[s->dof_field[d]] += dof[d] * dof[d];
    }
}

void vector_squares_free(const space *s, const double *free_, double *out)
{
    memset(out, 0, (size_t)s->n_field * sizeof *out);
    for (int64_t i = 0; i < s->n_free; i++)
        out[s->dof_field[s->dof_of[i]]] += free_[i] * free_[i];
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
