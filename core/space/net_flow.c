/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * An incompressible fluid whose velocity is prescribed all round must let out what it lets in: otherwise no
 * pressure solves its equations.  The fluxes are those of the finite-element function, int u . n by facet rules. */
#include "space/conditions.h"

#include "base/text.h"
#include "mesh/facet.h"

#include <math.h>
#include <string.h>

/* Part of what flows in that round-off and sums of many terms may cost. */
#define ALLOWED 1e-6

/* The vector field whose divergence the equation of another field contains, or -1. */
static int incompressible_field(const description *d)
{
    for (int i = 0; i < d->n_use; i++)
        for (uint32_t k = 0; k < d->use[i].term->n_in; k++) {
            const pf_slot *slot = &d->use[i].term->in[k];
            int f = slot->eval == PF_DIV ? fields_find(&d->fields, slot->field) : -1;

            for (uint32_t o = 0; f >= 0 && o < d->use[i].term->n_out; o++)
                if (strcmp(d->use[i].term->out[o].field, slot->field) != 0)
                    return f;
        }
    return -1;
}

/* Whether a line leaves nothing of the normal component open on a facet. */
static int closes(const boundary_line *l, const mesh *m, int64_t facet, int field)
{
    int axis = facet_axis(m, facet), whole = l->has_value[field];

    for (int k = 0; k < m->dim; k++)
        whole &= !l->value[field].free[k];
    return whole || l->symmetry || l->periodic[0] ||
           (l->has_value[field] && axis >= 0 && !l->value[field].free[axis]);
}

int net_flow_create(conditions *c, const description *d, const space *s, error *err)
{
    const mesh *m = s->mesh;
    net_flow *flow = &c->flow;
    int64_t n = 0;

    flow->field = incompressible_field(d);
    flow->closed = flow->field >= 0 && s->field[flow->field].order == 2;
    for (int64_t f = 0; f < m->n_facet && flow->closed; f++) {
        flow->closed = 0;
        for (int i = 0; i < d->n_line; i++)
            flow->closed |= c->facet[i][f] && closes(&d->line[i], m, f, flow->field);
    }
    if (!flow->closed)
        return 0;
    for (int i = 0; i < d->n_line; i++)
        for (int64_t f = 0; f < m->n_facet; f++)
            n += c->facet[i][f] && !d->line[i].periodic[0] ? m->type->facet_nodes * m->dim : 0;
    ARENA_NEW(&c->memory, flow->first, d->n_line + 1, err);
    ARENA_NEW(&c->memory, flow->dof, n + 1, err);
    ARENA_NEW(&c->memory, flow->weight, n + 1, err);
    n = 0;
    for (int i = 0; i < d->n_line; i++) {
        flow->first[i] = n;
        flow->of_time |= d->line[i].has_value[flow->field] && d->line[i].value[flow->field].of_time;
        for (int64_t f = 0; f < m->n_facet; f++) {
            const int32_t *cell = m->cell + (int64_t)m->facet[f].cell * m->type->n_node;
            double weight[FE_MAX_FACET_NODES][3], all[3];

            if (!c->facet[i][f] || d->line[i].periodic[0])
                continue;
            TRY(facet_weights(m, f, weight, all, err));
            for (int k = 0; k < m->type->facet_nodes; k++)
                for (int a = 0; a < m->dim; a++) {
                    flow->dof[n] = s->first[flow->field][cell[m->type->facet[m->facet[f].local][k]]] + a;
                    flow->weight[n++] = weight[k][a];
                }
        }
    }
    flow->first[d->n_line] = n;
    return 0;
}

/* Fluxes of what the case says itself, by quadrature of degree 7: out of the domain through each line. */
static int given_flux(const conditions *c, const space *s, double t, double *part, error *err)
{
    const mesh *m = s->mesh;
    const description *d = c->description;

    for (int i = 0; i < d->n_line; i++)
        for (int64_t f = 0; f < m->n_facet && d->line[i].has_value[c->flow.field]; f++) {
            double tangent[2][3], ds[3];
            fe_rule rule;
            int orient;

            if (!c->facet[i][f] || d->line[i].periodic[0])
                continue;
            TRY(fe_rule_facet(m->type, m->facet[f].local, m->type->simplex && m->dim == 3 ? 5 : 7, &rule, tangent,
                              &orient, err));
            for (int q = 0; q < rule.n; q++) {
                double x[3] = {0}, v[VALUE_MAX] = {0};

                facet_element(m, f, rule.x[q], (const double(*)[3])tangent, orient, x, ds);
                TRY(value_at(&d->line[i].value[c->flow.field], x, t, v, err));
                for (int a = 0; a < m->dim; a++)
                    part[i] += rule.w[q] * ds[a] * v[a];
            }
        }
    return 0;
}

static int refuse(const conditions *c, const double *part, double total, double t, error *err)
{
    const description *d = c->description;
    text list = {0};
    int status;

    for (int i = 0; i < d->n_line; i++)
        if (part[i] != 0)
            text_add(&list, "%s\"%s\" %.6g", list.n ? ", " : "", d->line[i].name ? d->line[i].name : "?", part[i]);
    status =
        error_set(err, ERR_CASE,
                  "%s: %s is prescribed on all boundaries, but what flows in does not flow out: the net outflow is "
                  "%.6g at t = %.6g (by boundary: %s). An incompressible fluid needs an outflow: boundary \"...\" "
                  "{ natural = true }, or conditions that balance",
                  d->c->path, d->fields.f[c->flow.field].name, total, t, list.s ? list.s : "");
    text_free(&list);
    return status;
}

int net_flow_check(const conditions *c, const space *s, const double *x, double t, double *excess, error *err)
{
    const net_flow *flow = &c->flow;
    double total = 0, gross = 0, size = 0, speed = 0, given = 0, part[DESCRIBE_MAX_LINES] = {0};

    *excess = 0;
    if (!flow->closed)
        return 0;
    for (int64_t k = 0; k < flow->first[c->n_line]; k++) {
        total += flow->weight[k] * x[flow->dof[k]];
        gross += 0.5 * fabs(flow->weight[k] * x[flow->dof[k]]);
        size += fabs(flow->weight[k]);
        speed = fmax(speed, fabs(x[flow->dof[k]]));
    }
    if (fabs(total) <= 1e-13 * size * speed) /* round-off */
        return 0;
    *excess = fabs(total) / gross;
    if (*excess <= ALLOWED)
        return 0;
    TRY(given_flux(c, s, t, part, err)); /* or is it only that the mesh does not resolve what is given? */
    for (int i = 0; i < c->n_line; i++)
        given += part[i];
    if (fabs(given) <= ALLOWED * gross || fabs(given) <= 2 * fabs(given - total))
        return 0;
    return refuse(c, part, given, t, err);
}
