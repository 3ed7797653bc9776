/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Which unknowns have an equation now.  A restricted field (PF_IN_PARTICLES: a multiplier) lives at the nodes i
 * that bodies really cover, int over the bodies of phi_i^2 > TAU int over the domain of phi_i^2 (numerics 4); one
 * that holds no other field, as the temperature of bodies, on all cells that bodies reach into; a field with
 * equations in the fluid only on cells that have some.  The others are idle. */
#include "body/body.h"

#include <math.h>
#include <string.h>

#define TAU 0.1

static int is_restricted(const space *s, int f)
{
    return s->field[f].support == PF_IN_PARTICLES;
}

int active_create(bodies *b, error *err)
{
    const mesh *m = b->space->mesh;
    const fe_cell *c = m->type;
    int any = 0;
    fe_rule rule;

    for (int f = 0; f < b->space->n_field; f++)
        any |= is_restricted(b->space, f);
    if (!any)
        return 0;
    TRY(fe_rule_cell(c, 5, &rule, err));
    ARENA_NEW(&b->memory, b->whole, m->n_node, err);
    ARENA_NEW(&b->memory, b->inside, m->n_node, err);
    for (int q = 0; q < rule.n; q++) {
        double n[FE_MAX_NODES], dn[FE_MAX_NODES][3];

        fe_basis(c, 2, rule.x[q], n, dn);
        for (int64_t e = 0; e < m->n_cell; e++)
            for (int i = 0; i < c->n_node; i++)
                b->whole[space_carrier(b->space, e, i)] +=
                    rule.w[q] / c->measure * pow(m->h[e], m->dim) * n[i] * n[i];
    }
    return 0;
}

/* b->inside: integral over the bodies of phi_i^2 for the nodes near them. */
static void inside_norms(const bodies *b, const placement *p)
{
    const space *s = b->space;
    const fe_cell *c = s->mesh->type;

    for (int64_t a = 0; a < s->n_attached; a++)
        for (int i = 0; i < c->n_node; i++)
            b->inside[space_carrier(s, space_attached_group(s, a), i)] = 0;
    for (int64_t k = 0; k < p->n_covered; k++)
        for (int i = 0; i < c->n_node; i++) {
            double sum = 0;

            for (int q = 0; q < b->cut.n; q++) {
                double basis = b->cut_basis[q * c->n_node + i];

                sum += p->covered_weight[k * b->cut.n + q] * basis * basis;
            }
            b->inside[space_carrier(s, space_attached_group(s, p->covered[k]), i)] +=
                sum / c->measure * pow(s->mesh->h[s->attached_cell[p->covered[k]]], s->mesh->dim);
        }
}

/* Restricted unknowns: off where bodies cover too little, or where what they hold is prescribed. */
static void restrict_fields(const bodies *b, placement *p)
{
    const space *s = b->space;

    for (int f = 0; f < s->n_field; f++) {
        int holds = s->field[f].constrains ? space_find_field(s, s->field[f].constrains) : -1;

        for (int64_t a = 0; is_restricted(s, f) && s->field[f].constrains && a < s->n_attached; a++)
            for (int i = 0; i < s->mesh->type->n_node; i++) {
                int32_t node = space_carrier(s, space_attached_group(s, a), i);
                int64_t d = s->first[f][node], u = holds >= 0 ? s->first[holds][node] : -1;

                for (int k = 0; d >= 0 && k < s->field[f].n_comp; k++)
                    p->idle[d + k] = !(b->inside[node] > TAU * b->whole[node]) || (u >= 0 && s->fixed[u + k]);
            }
    }
}

static void set_idle(const space *s, placement *p, int f, int64_t attached, uint8_t idle)
{
    for (int i = 0; i < s->mesh->type->n_node; i++) {
        int64_t d = s->first[f][space_carrier(s, space_attached_group(s, attached), i)];

        for (int k = 0; d >= 0 && k < s->field[f].n_comp; k++)
            p->idle[d + k] = idle;
    }
}

/* Fields of the bodies' own: on at all nodes of cells that bodies reach into. */
static void fill_bodies(const space *s, placement *p)
{
    for (int f = 0; f < s->n_field; f++) {
        if (!is_restricted(s, f) || s->field[f].constrains)
            continue;
        for (int64_t a = 0; a < s->n_attached; a++)
            set_idle(s, p, f, a, 1);
        for (int64_t k = 0; k < p->n_covered; k++)
            set_idle(s, p, f, p->covered[k], 0);
    }
}

/* Unknowns of the fluid: off on cells that a body covers, on again where a cell with fluid has them, too. */
static void leave_fluid(const bodies *b, placement *p)
{
    const space *s = b->space;

    for (int active = 0; active < 2; active++)
        for (int64_t a = 0; a < s->n_attached; a++)
            for (int i = 0; i < s->mesh->type->n_node && (p->cover[s->attached_cell[a]] != COVER_WHOLE) == active;
                 i++)
                for (int f = 0; f < s->n_field; f++) {
                    int64_t d =
                        b->fluid_only[f] ? s->first[f][space_carrier(s, space_attached_group(s, a), i)] : -1;

                    for (int k = 0; d >= 0 && k < s->field[f].n_comp; k++)
                        p->idle[d + k] = !active;
                }
}

void active_set(const bodies *b, placement *p)
{
    if (b->whole) {
        inside_norms(b, p);
        restrict_fields(b, p);
        fill_bodies(b->space, p);
    }
    if (b->any_fluid_only)
        leave_fluid(b, p);
}

void bodies_clear(const bodies *b, const placement *p, double *x)
{
    const space *s = b->space;

    for (int64_t d = 0; d < s->n_dof; d++) {
        const field_spec *f = &s->field[s->dof_field[d]];

        if ((s->fixed[d] & SPACE_AWAY) || (p->idle[d] && (f->support == PF_IN_PARTICLES || f->n_comp == 1)))
            x[d] = 0;
    }
}
