/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Fields that the equations fix only up to a constant, like the pressure of an enclosed flow.
 *
 * Found on the matrix itself, on every one that is formed: field f has a free constant if no value of it is
 * prescribed and J 1_f = 0 and 1_f^T J = 0, J without the rows and columns that are off.  To round-off, but for one
 * part: where cells are cut, Gauss's theorem holds only as exactly as their quadrature, so how f couples to other
 * fields near bodies is held to NEAR_BODIES.  That is no matter of opinion: what fixes a constant there by physics,
 * an exchange with the body, say, stands in the block of f itself, and an outflow is far from most bodies.
 *
 * The equations of such a field hold only for data whose sum vanishes; the part that does not is taken out of the
 * residual in proportion to the integral of each test function, and one value is held, which leaves all equations
 * satisfied. */
#include "solve/solve.h"
#include "solve/vector.h"
#include "space/evaluate.h"

#include <math.h>
#include <string.h>

#define ROUND_OFF 1e-9
/* Relative defect near bodies with sharp surfaces: measured up to 5e-4, three cells across; an open side all of
 * whose cells are near bodies has one of the root of its share of them. */
#define NEAR_BODIES 1e-2
/* Up to here it may be either. */
#define DOUBTFUL 0.1

/* The weights in use: over the fluid where bodies are, else over whole cells. */
static const double *weights(const gauge *g, int f)
{
    return g->weight[f] ? g->weight[f] : g->whole[f];
}

/* Flags the carriers of cells near bodies, of what is tied to them, and of bodies. */
static int find_near(newton_system *s, error *err)
{
    const space *sp = s->space;
    uint8_t *near = s->gauge.near;

    if (!near)
        ARENA_NEW(&s->memory, near, sp->n_carrier, err);
    s->gauge.near = near;
    memset(near, 0, (size_t)sp->n_carrier);
    for (int64_t g = sp->mesh->n_cell; g < space_groups(sp); g++)
        for (int i = 0; i < space_group_size(sp, g); i++)
            if (space_carrier(sp, g, i) >= 0)
                near[space_carrier(sp, g, i)] = 1;
    return 0;
}

/* Relative defects of a vector of sums, that cancel if a constant is free, against the sums of absolute values. */
typedef struct closure {
    double own;        /* of the field itself    */
    double away, near; /* of others              */
} closure;

static double relative(double sum, double size)
{
    return size > 0 ? sqrt(sum / size) : 0;
}

static closure close_up(const newton_system *s, int f, const double *sum, const double *size)
{
    enum { OWN, AWAY, NEAR };
    const space *sp = s->space;
    double sums[3] = {0}, sizes[3] = {0};

    for (int64_t i = 0; i < sp->n_free; i++) {
        int64_t d = sp->dof_of[i];
        int part = sp->dof_field[d] == f ? OWN : s->gauge.near[sp->dof_node[d]] ? NEAR : AWAY;

        sums[part] += sum[i] * sum[i];
        sizes[part] += size[i] * size[i];
    }
    if (!(sizes[OWN] + sizes[AWAY] + sizes[NEAR] > 0))
        return (closure){INFINITY, INFINITY, INFINITY};
    return (closure){relative(sums[OWN], sizes[OWN]), relative(sums[AWAY], sizes[AWAY]),
                     relative(sums[NEAR], sizes[NEAR])};
}

/* 1_f^T J */
static closure close_left(newton_system *s, int f)
{
    const space *sp = s->space;
    const double *value = s->linear.value;
    double *sum = s->rhs, *size = s->scale;

    memset(sum, 0, (size_t)sp->n_free * sizeof *sum);
    memset(size, 0, (size_t)sp->n_free * sizeof *size);
    for (int64_t i = 0; i < sp->n_free; i++) {
        if (sp->dof_field[sp->dof_of[i]] != f || s->assembly.idle[sp->dof_of[i]])
            continue;
        for (int64_t k = sp->row[i]; k < sp->row[i + 1]; k++) {
            sum[space_column(sp, i, k)] += value[k];
            size[space_column(sp, i, k)] += fabs(value[k]);
        }
    }
    return close_up(s, f, sum, size);
}

/* J 1_f */
static closure close_right(newton_system *s, int f)
{
    const space *sp = s->space;
    const double *value = s->linear.value;
    double *sum = s->rhs, *size = s->scale, *one = s->work;

    for (int64_t i = 0; i < sp->n_free; i++)
        one[i] = sp->dof_field[sp->dof_of[i]] == f;
#pragma omp parallel for num_threads(s->assembly.n_thread) if (sp->row[sp->n_free] >= VECTOR_THREADED)             \
    schedule(static)
    for (int64_t i = 0; i < sp->n_free; i++) {
        double plain = 0, absolute = 0;

        for (int64_t k = sp->row[i]; k < sp->row[i + 1]; k++) {
            double v = value[k] * one[space_column(sp, i, k)];

            plain += v;
            absolute += fabs(v);
        }
        sum[i] = s->assembly.idle[sp->dof_of[i]] ? 0 : plain;
        size[i] = s->assembly.idle[sp->dof_of[i]] ? 0 : absolute;
    }
    return close_up(s, f, sum, size);
}

/* Whether the constant is free to round-off where it must be; *near: defect near bodies. */
static int is_closed(const closure *c, double *near)
{
    *near = vector_worse(c->near, *near);
    return c->own <= ROUND_OFF && c->away <= ROUND_OFF;
}

/* Defect of the constant of field f near bodies, or INFINITY where it is not free anyhow.  Rows of f are few: most
 * fields are settled by them. */
static double constant_defect(newton_system *s, int f)
{
    closure c = close_left(s, f);
    double near = 0;

    if (!is_closed(&c, &near))
        return INFINITY;
    c = close_right(s, f);
    return is_closed(&c, &near) ? near : INFINITY;
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

/* Only a scalar field of the mesh of which nothing is prescribed can have a free constant. */
static int may_be_free(const space *sp, int f)
{
    return sp->field[f].n_comp == 1 && sp->field[f].support == PF_ON_MESH && !vector_field_prescribed(sp, f);
}

int gauge_detect(newton_system *s, int *changed, error *err)
{
    space *sp = s->space;
    gauge *g = &s->gauge;
    double tolerance = g->sharp ? NEAR_BODIES : ROUND_OFF;

    *changed = g->approximate = 0;
    TRY(find_near(s, err));
    for (int f = 0; f < sp->n_field; f++) {
        double defect = may_be_free(sp, f) ? constant_defect(s, f) : INFINITY;
        int is_free = defect <= tolerance;

        g->approximate |= is_free && defect > ROUND_OFF;
        g->doubt[f] = g->sharp && defect > NEAR_BODIES && defect < DOUBTFUL ? defect : 0;
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
