/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Whether the terms that are on determine their fields: a viscosity where the stress needs one, a density where
 * there is a time derivative, something that fixes the level of a field in a steady case. */
#include "describe/describe.h"

#include <lauxlib.h>

#include <string.h>

static int is_on_cells(const term_use *u)
{
    return u->where == PF_CELL || u->where == PF_FLUID;
}

/* The first slot that holds `eval` (0: anything) of a field, or NULL. */
static const pf_slot *slot_of(const pf_slot *slot, uint32_t n, const char *field, uint32_t eval)
{
    for (uint32_t i = 0; i < n; i++)
        if (term_slot_field(&slot[i]) && strcmp(slot[i].field, field) == 0 && (eval == 0 || slot[i].eval == eval))
            return &slot[i];
    return NULL;
}

int describe_field_is_balanced(const description *d, int f)
{
    const char *name = d->fields.f[f].name;

    for (int i = 0; i < d->n_use; i++) {
        const pf_term *t = d->use[i].term;

        for (uint32_t o = 0; is_on_cells(&d->use[i]) && o < t->n_out; o++)
            for (uint32_t k = 0; k < t->n_in; k++)
                if (term_slot_field(&t->in[k]) && strcmp(t->in[k].field, name) == 0 &&
                    term_slot_field(&t->out[o]) && strcmp(t->out[o].field, name) == 0 &&
                    (!t->depends || t->depends[o * t->n_in + k]))
                    return 1;
    }
    return d->incomplete;
}

/* The block that gives the term this number as zero, or NULL. */
static const case_block *zero_of(const description *d, int use, const char *name)
{
    const case_block *block[2] = {d->use_block[use], case_find(d->c, "fluid", 0)};
    lua_State *l = d->c->lua;

    for (int i = 0; i < 2; i++) {
        int type, zero;

        if (!block[i] || block[i]->ref == LUA_NOREF)
            continue;
        lua_rawgeti(l, LUA_REGISTRYINDEX, block[i]->ref);
        type = lua_getfield(l, -1, name);
        zero = type == LUA_TNUMBER && lua_tonumber(l, -1) == 0;
        lua_pop(l, 2);
        if (type != LUA_TNIL)
            return zero ? block[i] : NULL;
    }
    return NULL;
}

/* Whether another plugin's term diffuses the field. */
static int is_diffused(const description *d, const char *field, const term_plugin *but)
{
    for (int i = 0; i < d->n_use; i++) {
        if (d->use[i].plugin != but && is_on_cells(&d->use[i]) && term_diffuses(d->use[i].term, field))
            return 1;
    }
    return 0;
}

/* A viscous stress, in the fluid or on surfaces, with viscosity 0. */
static void check_viscosity(const description *d)
{
    for (int i = 0; i < d->n_use; i++) {
        const term_use *u = &d->use[i];
        const pf_param *q = describe_param(u, "viscosity");
        const case_block *b = q ? zero_of(d, i, "viscosity") : NULL;
        int stress = u->where == PF_SURFACE || u->where == PF_CUT;

        for (uint32_t o = 0; b && is_on_cells(u) && o < u->term->n_out; o++)
            stress |=
                term_diffuses(u->term, u->term->out[o].field) && !is_diffused(d, u->term->out[o].field, u->plugin);
        if (b && stress)
            case_wrong(d->c, b, "viscosity",
                       "%s%s%s%s: \"viscosity\" (%s, %s) is 0; it must be positive: nothing else dissipates, so a "
                       "flow is not "
                       "determined",
                       b->kind, b->name ? " \"" : "", b->name ? b->name : "", b->name ? "\"" : "", q->doc, q->unit);
    }
}

/* A time derivative with density 0. */
static void check_density(const description *d)
{
    for (int i = 0; i < d->n_use; i++) {
        const term_use *u = &d->use[i];
        const pf_param *q = describe_param(u, "density");
        const case_block *b = q && is_on_cells(u) && d->time.unsteady ? zero_of(d, i, "density") : NULL;
        int rate = 0;

        for (uint32_t k = 0; b && k < u->term->n_in; k++)
            rate |= u->term->in[k].eval == PF_DOT;
        if (rate)
            case_wrong(d->c, b, "density",
                       "%s%s%s%s: \"density\" (%s, %s) is 0; with time{} it must be positive. A flow without "
                       "inertia is density "
                       "= 1 and term \"%s\" { without = {\"%s\", ...} }",
                       b->kind, b->name ? " \"" : "", b->name ? b->name : "", b->name ? "\"" : "", q->doc, q->unit,
                       u->plugin->d.name, u->term->name);
    }
}

static int is_prescribed(const description *d, int f)
{
    for (int i = 0; i < d->n_line; i++) {
        const boundary_line *l = &d->line[i];

        if (l->has_value[f] || (l->symmetry && d->fields.f[f].shape == PF_VECTOR))
            return 1;
    }
    return 0;
}

/* Whether a term tells a field from the same field plus a constant: it has its value alone, or acts on bodies. */
static int has_level(const description *d, const char *field)
{
    for (int i = 0; i < d->n_use; i++) {
        const pf_term *t = d->use[i].term;
        int value = slot_of(t->in, t->n_in, field, PF_VALUE) != NULL;
        int slope = slot_of(t->in, t->n_in, field, PF_GRAD) || slot_of(t->in, t->n_in, field, PF_DIV) ||
                    slot_of(t->in, t->n_in, field, PF_LAPLACE);

        if ((t->flags & PF_BY_BOUNDARY) || !slot_of(t->in, t->n_in, field, 0))
            continue;
        if (!is_on_cells(&d->use[i]) || (value && !slope))
            return 1;
    }
    return 0;
}

/* Fields that a steady case leaves open: u and u + constant solve it alike. */
static void check_level(const description *d)
{
    for (int f = 0; f < d->fields.n && !d->time.unsteady; f++) {
        const field_spec *g = &d->fields.f[f];
        int flux = 0;

        for (int i = 0; i < d->n_line; i++)
            for (int k = 0; k < d->line[i].n_flux; k++)
                flux |= slot_of(d->line[i].flux[k]->term->in, d->line[i].flux[k]->term->n_in, g->name, 0) != NULL;
        if (g->support != PF_ON_MESH || !describe_field_is_balanced(d, f) || is_prescribed(d, f) || flux ||
            has_level(d, g->name))
            continue;
        case_wrong(
            d->c, NULL, NULL,
            "nothing determines \"%s\" (%s): it is prescribed on no boundary, and a steady case does not start "
            "from anything; prescribe it on some boundary, as in boundary \"left\" { %s = %s }, or add time {}",
            g->name, g->doc, g->name,
            term_is_tensor((uint32_t)g->shape) ? "function(x, y) ... end"
            : g->n_comp == 1                   ? "0"
            : g->n_comp == 2                   ? "{1, 0}"
                                               : "{1, 0, 0}");
    }
}

/* A parameter that terms share, but that one of them was given another value of. */
static void check_shared(const description *d)
{
    for (int i = 0; i < d->n_use; i++)
        for (uint32_t k = 0; k < d->use[i].term->n_param; k++) {
            const pf_param *q = &d->use[i].term->param[k], *other = NULL;
            double a, b;

            if (!(q->flags & PF_SHARED) || q->type != PF_T_REAL)
                continue;
            memcpy(&a, (const char *)d->use[i].params + q->offset, sizeof a);
            for (int j = 0; j < i && !other; j++) {
                other = describe_param(&d->use[j], q->name);
                if (d->use[i].inside && d->use[j].inside) /* each has its own part of the domain */
                    other = NULL;
                if (!other || other->type != PF_T_REAL || !(other->flags & PF_SHARED))
                    continue;
                memcpy(&b, (const char *)d->use[j].params + other->offset, sizeof b);
                if (a != b) {
                    warning_add(d->warnings,
                                "\"%s\" is %g in %s.%s and %g in %s.%s: the same fluid has two; give it "
                                "in fluid{} alone",
                                q->name, b, d->use[j].plugin->d.name, d->use[j].term->name, a,
                                d->use[i].plugin->d.name, d->use[i].term->name);
                    return;
                }
            }
        }
}

static int is_given(const value *v)
{
    int given = v->f != NULL;

    for (int i = 0; i < v->n; i++)
        given |= v->constant[i] != 0;
    return given;
}

/* Whether two terms act on the same rows, so that data of one name is the same thing. */
static int share_rows(const term_use *a, const term_use *b)
{
    for (uint32_t o = 0; o < a->term->n_out; o++)
        if (slot_of(b->term->out, b->term->n_out, a->term->out[o].field, 0))
            return 1;
    return 0;
}

/* Data that one of two terms was given, and not the other that has the same key. */
static void check_data(const description *d, const term_use *with, const term_use *without)
{
    for (uint32_t k = 0; k < with->term->n_in; k++)
        for (uint32_t j = 0; j < without->term->n_in; j++) {
            const pf_slot *a = &with->term->in[k], *b = &without->term->in[j];

            if (a->eval == PF_DATA && b->eval == PF_DATA && a->shape == b->shape && strcmp(a->name, b->name) == 0 &&
                with->data[k] && without->data[j] && is_given(with->data[k]) && !is_given(without->data[j]))
                warning_add(d->warnings,
                            "%s.%s has \"%s\", and %s.%s, which takes the same, has not: give it on both lines",
                            with->plugin->d.name, with->term->name, a->name, without->plugin->d.name,
                            without->term->name);
        }
}

static void check_all_data(const description *d)
{
    for (int i = 0; i < d->n_use; i++)
        for (int k = 0; k < d->n_use; k++)
            if (is_on_cells(&d->use[i]) && is_on_cells(&d->use[k]) && share_rows(&d->use[i], &d->use[k]))
                check_data(d, &d->use[i], &d->use[k]);
}

/* A body with a prescribed motion stands in a steady case. */
static void check_motion(const description *d)
{
    for (int k = 0; !d->time.unsteady && k < d->n_body; k++)
        if (d->body[k].motion == BODY_PRESCRIBED) {
            warning_add(
                d->warnings,
                "%s:%d: particle %d has a prescribed motion, but the case is steady: it stays where it is, and "
                "the velocity is that of its surface; add time {}, or say motion = \"fixed\"",
                d->body[k].block->file, d->body[k].block->line, k);
            return;
        }
}

/* Bodies may cover all of a cell, or all but a sliver: then a value of the cell has no equation, or hardly one. */
static void check_cells(const description *d)
{
    for (int f = 0; f < d->fields.n; f++)
        if (d->n_body && d->fields.f[f].support == PF_ON_MESH && d->fields.f[f].order == 0) {
            case_wrong(d->c, d->body[0].block, NULL,
                       "\"%s\" (%s) has one value a cell (order 0), which is not possible in a case with bodies: "
                       "declare it with order 1 in plugin \"%s\"",
                       d->fields.f[f].name, d->fields.f[f].doc, d->fields.f[f].declared_by);
            return;
        }
}

void describe_check_terms(const description *d)
{
    if (d->incomplete)
        return;
    check_shared(d);
    check_all_data(d);
    check_motion(d);
    check_cells(d);
    check_viscosity(d);
    check_density(d);
    if (d->c->n_error == 0 && d->n_line > 0) /* else that is what is wrong first */
        check_level(d);
}
