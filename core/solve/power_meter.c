/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "solve/power_meter.h"

#include "solve/vector.h"
#include "space/corners.h"
#include "space/evaluate.h"

#include <string.h>

static int is_velocity(const field_spec *f)
{
    if (f->support == PF_ON_PARTICLE)
        return fields_moves_bodies(f);
    return f->support == PF_ON_MESH && f->shape == PF_VECTOR && f->reaction && strcmp(f->reaction, "force") == 0;
}

int power_meter_create(power_meter *m, const assembly *a, error *err)
{
    memset(m, 0, sizeof *m);
    m->space = a->space;
    m->n_use = a->n_use;
    ARENA_NEW(&m->memory, m->now.use, m->n_use + 1, err);
    ARENA_NEW(&m->memory, m->last, m->n_use + 1, err);
    ARENA_NEW(&m->memory, m->held, m->n_use + 1, err);
    ARENA_NEW(&m->memory, m->work, m->n_use + 1, err);
    for (int f = 0; f < a->space->n_field; f++)
        m->now.fields |= is_velocity(&a->space->field[f]) ? 1u << f : 0;
    return 0;
}

void power_meter_destroy(power_meter *m)
{
    arena_free(&m->memory);
    memset(m, 0, sizeof *m);
}

assembly_power *power_meter_ask(power_meter *m)
{
    return m ? &m->now : NULL;
}

/* Whether the field is not zero all over a facet. */
static int flows(const space *s, int field, const mesh_facet *f, const double *x)
{
    const mesh *m = s->mesh;
    int any = 0;

    for (int i = 0; i < m->type->facet_nodes; i++)
        for (int k = 0; k < m->dim; k++) {
            int32_t node = m->cell[(int64_t)f->cell * m->type->n_node + m->type->facet[f->local][i]];

            any |= x[s->first[field][node] + k] != 0;
        }
    return any;
}

/* 1/2 |u|^2 u . n at a point of a cell. */
static double flux(const space *s, int field, const double *x, int64_t cell, const double *xi, const double *n)
{
    double u[VALUE_MAX] = {0}, square = 0, through = 0;

    space_evaluate(s, field, x, cell, xi, &(point_values){.value = u});
    for (int a = 0; a < s->mesh->dim; a++) {
        square += u[a] * u[a];
        through += u[a] * n[a];
    }
    return 0.5 * square * through;
}

/* Its integral over the boundary. */
static int carry(const space *s, int field, const double *x, double *sum, error *err)
{
    const mesh *m = s->mesh;
    fe_rule rule = {0};
    double tangent[2][3];
    int orient = 0, local = -1;

    for (int64_t f = 0; f < m->n_facet; f++) {
        if (!flows(s, field, &m->facet[f], x))
            continue;
        if (m->facet[f].local != local) /* facets are sorted by it */
            TRY(fe_rule_facet(m->type, m->facet[f].local, m->type->simplex && m->dim == 3 ? 5 : 7, &rule, tangent,
                              &orient, err));
        local = m->facet[f].local;
        for (int q = 0; q < rule.n; q++) {
            double at[3] = {0}, ds[3];

            facet_element(m, f, rule.x[q], (const double(*)[3])tangent, orient, at, ds);
            *sum += rule.w[q] * flux(s, field, x, m->facet[f].cell, rule.x[q], ds);
        }
    }
    return 0;
}

/* The same over the surfaces of bodies that cut through cells. */
static double sweep(const space *s, int field, const double *x, const body_points *b)
{
    double sum = 0;

    for (int64_t i = 0; b && i < b->n_surface * SURFACE_POINTS; i++)
        if (b->surface_weight[i] != 0)
            sum += b->surface_weight[i] * flux(s, field, x, s->attached_cell[b->surface[i / SURFACE_POINTS]],
                                               b->surface_ref[i], b->surface_normal[i]);
    return sum;
}

int power_meter_read(power_meter *m, const double *x, const double *reaction, const body_points *bodies, error *err)
{
    double *to = m ? m->now.use[m->n_use] : NULL;

    if (!m)
        return 0;
    memset(to, 0, sizeof *m->now.use);
    for (int f = 0; f < m->space->n_field; f++) {
        if (!(m->now.fields >> f & 1))
            continue;
        to[METER_PRESCRIBED] += vector_prescribed_dot(m->space, f, reaction, x);
        if (m->space->field[f].support != PF_ON_MESH)
            continue;
        TRY(carry(m->space, f, x, &to[METER_CARRIED], err));
        to[METER_SWEPT] += sweep(m->space, f, x, bodies);
    }
    return 0;
}

void power_meter_hold(power_meter *m, double dt)
{
    if (!m)
        return;
    for (int i = 0; i <= m->n_use; i++)
        for (int k = 0; k < POWERS; k++)
            m->held[i][k] = dt * m->now.use[i][k];
    m->holds = 1;
}

void power_meter_drop(power_meter *m)
{
    if (m)
        m->holds = 0;
}

void power_meter_accept(power_meter *m, int order, double dt)
{
    if (!m)
        return;
    for (int i = 0; i <= m->n_use; i++)
        for (int k = 0; k < POWERS; k++) {
            double before = order == 1 || !m->has_last ? m->now.use[i][k] : m->last[i][k];

            if (m->holds)
                m->work[i][k] += m->held[i][k] + 0.5 * dt * m->now.use[i][k];
            else
                m->work[i][k] += 0.5 * dt * (before + m->now.use[i][k]);
            m->last[i][k] = m->now.use[i][k];
        }
    m->has_last = 1;
    m->holds = 0;
}
