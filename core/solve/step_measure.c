/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The error of a step, by Milne's device: what the solution differs by from an extrapolation of the same order,
 * times a known factor (Gresho and Sani 1998, 3.16).
 *
 * Nodes of cells that a body may cut are not measured: the values of those below its surface, or of cells tied to
 * others, belong to the approximation and depend on the step itself.
 *
 * A body that moves through the mesh feels it: its velocity has a roughness of the size of the error of space,
 * which no shorter step makes smaller.  So Milne's error of bodies may be a few times what that of the fluid may,
 * and beside it the error of their velocities smoothed over the last steps is held to it. */
#include "solve/step_measure.h"

#include "solve/step_control.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* Milne's error of bodies, over what is allowed: what is larger is sudden. */
#define ROUGH 5
/* Instants from which on a smooth course is known. */
enum { LEAST_PAST = 6 };

int measure_create(step_measure *m, const bodies *b, const int *vanishes, arena *memory, error *err)
{
    const space *s = b->space;
    const mesh *q = s->mesh;

    m->space = s;
    m->bodies = b;
    m->vanishes = vanishes;
    for (int k = 0; k < b->n; k++) {
        m->moves |= b->spec[k].motion != BODY_FIXED;
        m->free |= b->spec[k].motion == BODY_FREE;
    }
    m->rated = bodies_rated(b);
    ARENA_NEW(memory, m->weight, s->n_carrier, err);
    ARENA_NEW(memory, m->cut, s->n_carrier, err);
    for (int64_t c = 0; c < q->n_cell; c++)
        for (int i = 0; i < q->type->n_node; i++)
            m->weight[space_master(s, q->cell[c * q->type->n_node + i])] += pow(q->h[c], q->dim);
    return 0;
}

void measure_motion(const step_measure *m, int k, const double *x, double *v)
{
    for (int spin = 0; spin < 2; spin++) {
        int64_t d = bodies_dof(m->bodies, k, spin);
        int n = spin && m->space->mesh->dim == 2 ? 1 : m->space->mesh->dim;

        for (int i = 0; i < 3; i++)
            v[3 * spin + i] = d >= 0 && i < n && !m->space->fixed[d + i] ? x[d + i] : 0;
    }
}

void measure_place(step_measure *m)
{
    const placement *now = m->bodies->now;
    const mesh *q = m->space->mesh;

    if (m->bodies->n == 0 || m->stamp == m->bodies->stamp)
        return;
    m->stamp = m->bodies->stamp;
    memset(m->cut, 0, (size_t)m->space->n_carrier);
    for (int64_t k = 0; k < now->n_near; k++)
        for (int i = 0; i < q->type->n_node; i++)
            m->cut[space_master(m->space, q->cell[(int64_t)now->near_cell[k] * q->type->n_node + i])] = 1;
}

/* Squares of a field of the mesh and of its error, weighted. */
static void add_squares(const step_measure *m, int f, const double *x, const double *from, const uint8_t *idle,
                        double *error, double *size)
{
    const space *s = m->space;
    double volume = 0, e = 0, v = 0;

    for (int64_t c = 0; c < s->mesh->n_node; c++) {
        int64_t d = s->first[f][c];

        if (d < 0 || (idle && idle[d]) || m->cut[c])
            continue;
        volume += m->weight[c];
        for (int64_t i = d; i < d + s->field[f].n_comp; i++) {
            v += m->weight[c] * x[i] * x[i];
            e += s->fixed[i] ? 0 : m->weight[c] * (x[i] - from[i]) * (x[i] - from[i]);
        }
    }
    *size = volume > 0 ? sqrt(v / volume) : 0;
    *error = volume > 0 ? sqrt(e / volume) : 0;
}

/* Largest velocity (or that of the surface by turning) of a body and largest error. */
static void add_bodies(const step_measure *m, int f, const double *x, const double *from, double *error,
                       double *size)
{
    const bodies *b = m->bodies;

    for (int k = 0; k < b->n; k++) {
        int64_t d = m->space->first[f][space_body_carrier(m->space, k)];
        double arm = f == b->field_spin ? b->spec[k].shape.radius : 1, e = 0, v = 0;

        for (int i = 0; d >= 0 && i < m->space->field[f].n_comp; i++) {
            v += x[d + i] * x[d + i];
            e += m->space->fixed[d + i] ? 0 : (x[d + i] - from[d + i]) * (x[d + i] - from[d + i]);
        }
        *size = fmax(*size, arm * sqrt(v));
        *error = fmax(*error, arm * sqrt(e));
    }
}

/* Fields that are measured by the same velocity: that of the fluid, those of the bodies that move it. */
static int is_motion(const step_measure *m, int f)
{
    return m->bodies->n &&
           (f == m->bodies->field_velocity || f == m->bodies->field_spin || f == bodies_rigid_field(m->bodies));
}

/* Mean square, or of a field of bodies the largest value, of x - from and of x. */
static void add_field(const step_measure *m, int f, const double *x, const double *from, const uint8_t *idle,
                      double *error, double *size)
{
    *error = *size = 0;
    if (m->space->field[f].support == PF_ON_PARTICLE)
        add_bodies(m, f, x, from, error, size);
    else
        add_squares(m, f, x, from, idle, error, size);
}

double measure_relative(const step_measure *m, const double *x, const double *from, const double *least,
                        const uint8_t *idle, double rough, double *size, double *motion)
{
    double error[SPACE_MAX_FIELDS] = {0}, most = 0, worst = 0;

    for (int f = 0; f < m->space->n_field; f++) {
        double now;

        if (!(m->rated >> f & 1) && !is_motion(m, f))
            continue;
        add_field(m, f, x, from, idle, &error[f], &now);
        size[f] = fmax(size[f], now);
        if (is_motion(m, f))
            most = fmax(most, size[f]);
    }
    for (int f = 0; f < m->space->n_field; f++) {
        double of = is_motion(m, f) && m->space->field[f].support == PF_ON_PARTICLE ? most : size[f];

        if (m->space->field[f].support == PF_ON_PARTICLE)
            error[f] /= rough;
        if (error[f] > 0 && (m->rated >> f & 1) && !m->vanishes[f])
            worst = fmax(worst, error[f] / fmax(fmax(of, least ? least[f] : 0), DBL_MIN));
    }
    if (motion)
        *motion = fmax(most, DBL_MIN);
    return worst;
}

/* least[f]: what a field would grow to in `many` steps like this one and the one before, whichever changes it less.
 * One that starts from rest is not to be measured by the little that it is. */
static void growth(const step_measure *m, const state *now, double dt, const double *x, const uint8_t *idle,
                   double many, double *least)
{
    for (int f = 0; f < m->space->n_field; f++) {
        double change, before, size;

        least[f] = 0;
        if (!(m->rated >> f & 1))
            continue;
        add_field(m, f, x, now->x, idle, &change, &size);
        if (now->n_history > 0) {
            add_field(m, f, now->x, now->before, idle, &before, &size);
            change = fmin(change, before * dt / now->dt_previous);
        }
        least[f] = many * change;
    }
}

/* Orthonormal polynomials of degree 0 to 3 on the instants t [n], by Gram and Schmidt; returns the third derivative
 * of the last. */
static double polynomials(int n, const double *t, double p[4][STATE_PAST])
{
    double unit = t[0] - t[n - 1], lead = 6;

    for (int k = 0; k < 4; k++) {
        double size = 0;

        for (int i = 0; i < n; i++)
            p[k][i] = k ? p[k - 1][i] * (t[i] - t[n / 2]) / unit : 1;
        for (int j = 0; j < k; j++) {
            double dot = 0;

            for (int i = 0; i < n; i++)
                dot += p[k][i] * p[j][i];
            for (int i = 0; i < n; i++)
                p[k][i] -= dot * p[j][i];
        }
        for (int i = 0; i < n; i++)
            size += p[k][i] * p[k][i];
        for (int i = 0; i < n; i++)
            p[k][i] /= sqrt(size);
        lead /= sqrt(size);
    }
    return lead / pow(unit, 3);
}

/* Part of values v [n] along the cubic polynomial, as far as it stands out from the scatter of v about its best
 * cubic: twice the standard error is taken off. */
static double cubic_part(int n, double p[4][STATE_PAST], const double *v)
{
    double c[4] = {0}, squares = 0;

    for (int k = 0; k < 4; k++)
        for (int i = 0; i < n; i++)
            c[k] += p[k][i] * v[i];
    for (int i = 0; i < n; i++) {
        double r = v[i] - c[0] * p[0][i] - c[1] * p[1][i] - c[2] * p[2][i] - c[3] * p[3][i];

        squares += r * r;
    }
    return fmax(fabs(c[3]) - 2 * sqrt(squares / (n - 4)), 0);
}

/* Largest third derivative of the velocity of a body, or of its surface by turning. */
static double body_jerk(const step_measure *m, const state *from, double t, const double *x)
{
    const step_control *c = &from->control;
    const bodies *b = m->bodies;
    int n = c->n_past < STATE_PAST - 1 ? (int)c->n_past + 1 : STATE_PAST;
    double time[STATE_PAST] = {t}, p[4][STATE_PAST], most = 0, lead;

    if (n < LEAST_PAST)
        return 0;
    memcpy(time + 1, c->past, (size_t)(n - 1) * sizeof *time);
    lead = polynomials(n, time, p);
    for (int k = 0; k < b->n; k++) {
        double now[6], squares[2] = {0};

        measure_motion(m, k, x, now);
        for (int i = 0; i < 6; i++) {
            double v[STATE_PAST] = {now[i]}, part;

            for (int l = 1; l < n; l++)
                v[l] = from->past[k].motion[l - 1][i];
            part = cubic_part(n, p, v);
            squares[i / 3] += part * part;
        }
        most = fmax(most, lead * fmax(sqrt(squares[0]), b->spec[k].shape.radius * sqrt(squares[1])));
    }
    return most;
}

void measure_remember(const step_measure *m, state *now)
{
    step_control *c = &now->control;
    const int kept = STATE_PAST - 1;

    memmove(c->past + 1, c->past, (size_t)kept * sizeof *c->past);
    c->past[0] = now->t;
    c->n_past++;
    for (int k = 0; k < m->bodies->n; k++) {
        double(*v)[6] = now->past[k].motion;

        memmove(v + 1, v, (size_t)kept * sizeof *v);
        measure_motion(m, k, now->x, v[0]);
    }
}

static double measure_allowed(const step_measure *m, double tolerance)
{
    return m->free ? tolerance : pow(tolerance, 1.5);
}

step_error measure_first(const step_measure *m, const state *now, double tolerance, double dt, const double *x,
                         const double *from, const uint8_t *idle, double *size)
{
    double least[SPACE_MAX_FIELDS];
    step_error e;

    growth(m, now, dt, x, idle, 1 / sqrt(tolerance), least);
    e.whole = pow(measure_relative(m, x, from, least, idle, 1, size, NULL), 1.5);
    e.error = e.whole / measure_allowed(m, tolerance);
    return e;
}

step_error measure_step(const step_measure *m, const state *now, double tolerance, double dt, const double *x,
                        const double *predicted, const uint8_t *idle, double *size)
{
    double least[SPACE_MAX_FIELDS], largest;
    step_error e;

    growth(m, now, dt, x, idle, 1 / sqrt(tolerance), least);
    e.whole = control_milne(dt, now->dt_previous, now->dt_before) *
              measure_relative(m, x, predicted, least, idle, ROUGH, size, &largest);
    e.error = e.whole / measure_allowed(m, tolerance);
    if (m->free)
        e.error = fmax(e.error, control_defect(dt, now->dt_previous) * body_jerk(m, now, now->t + dt, x) / largest /
                                    measure_allowed(m, tolerance));
    return e;
}
