/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Terms whose results are shown, on an assembly of their own: which output goes where, and the sums over cells,
 * facets and bodies. */
#include "solve/shown.h"

#include <math.h>
#include <string.h>

int shown_needs_step(const pf_term *t)
{
    for (uint32_t k = 0; k < t->n_in; k++)
        if (t->in[k].eval == PF_DOT || t->in[k].eval == PF_OLD)
            return 1;
    return 0;
}

/* The integral that this output of a term adds to: one for all classes that the term is on. */
static int find_integral(shown *p, const term_use *use, const pf_slot *slot, error *err)
{
    const mesh *m = p->from->mesh;
    shown_integral *to = &p->integral[p->n_integral];
    const uint32_t where = use->term->where;

    for (int i = 0; i < p->n_integral; i++)
        if (p->integral[i].use == use && p->integral[i].slot == slot)
            return i;
    if (p->n_integral == SHOWN_MOST)
        return -error_set(err, ERR_PLUGIN, "more than %d integrals are shown", SHOWN_MOST);
    *to = (shown_integral){.use = use,
                           .slot = slot,
                           .per = where == PF_FACET                       ? SHOWN_BOUNDARY
                                  : where == PF_CELL || where == PF_FLUID ? SHOWN_WHOLE
                                                                          : SHOWN_BODY,
                           .n_comp = term_components(slot->shape, m->dim)};
    to->n = to->per == SHOWN_BOUNDARY ? m->n_name : to->per == SHOWN_BODY ? p->from->n_particle : 1;
    to->value = arena_alloc(&p->memory, (size_t)(to->n * to->n_comp) + 1, sizeof *to->value);
    return to->value ? p->n_integral++ : -error_memory(err, "integrals", 0);
}

/* Where the outputs of a class go. */
static int direct(shown *p, const assembly_class *c, shown_class *to, error *err)
{
    for (int u = 0; u < c->n_use; u++)
        for (uint32_t o = 0; o < c->use[u].use->term->n_out; o++) {
            const pf_slot *slot = &c->use[u].use->term->out[o];
            int t = c->use[u].out[o], f = slot->eval == PF_SHOW ? space_find_field(&p->space, slot->name) : -1;

            to->field[t] = f;
            to->projects |= f >= 0;
            to->at[t] = to->width;
            if (f >= 0)
                p->field[f] = (shown_field){.use = c->use[u].use, .where = c->where};
            else if (find_integral(p, c->use[u].use, slot, err) < 0)
                return err->code;
            else
                to->width += c->test[t].n_comp;
        }
    return 0;
}

int shown_create(shown *p, const space *from, const field_list *fields, const assembly_spec *spec, int n_spec,
                 int n_thread, error *err)
{
    memset(p, 0, sizeof *p);
    p->from = from;
    TRY(space_number(&p->space, fields, from->mesh, 0, err));
    TRY(assembly_create(&p->assembly, from, spec, n_spec, n_thread, err));
    ARENA_NEW(&p->memory, p->x, p->space.n_dof + 1, err);
    ARENA_NEW(&p->memory, p->out.load, p->space.n_dof + 1, err);
    ARENA_NEW(&p->memory, p->out.class_, n_spec + 1, err);
    p->out.to = &p->space;
    for (int k = 0; k < n_spec; k++)
        TRY(direct(p, &p->assembly.class_[k], &p->out.class_[k], err));
    return 0;
}

void shown_destroy(shown *p)
{
    assembly_destroy(&p->assembly);
    space_destroy(&p->space);
    arena_free(&p->out.memory);
    arena_free(&p->memory);
    memset(p, 0, sizeof *p);
}

/* --- sums --- */

/* The body of an item of a class on bodies. */
static int body_of(const assembly *a, const assembly_class *c, int64_t item)
{
    if (c->where == PF_PAIR)
        return c->pair[c->source[item]].particle;
    return a->space->attached_particle[c->group[item] - space_attached_group(a->space, 0)];
}

/* Adds what an item has of an integral to the values that it belongs to.  Items come in the order that they have
 * whatever the number of threads, and this is the only place that sums them. */
static void add_item(const shown *p, const assembly_class *c, int64_t item, const double *part, shown_integral *to)
{
    const mesh *m = p->from->mesh;
    uint64_t names = 1;
    int first = 0;

    if (to->per == SHOWN_BOUNDARY)
        names = m->facet[c->source[item]].names;
    else if (to->per == SHOWN_BODY)
        first = body_of(&p->assembly, c, item);
    for (int i = first; names; i++, names >>= 1)
        for (int k = 0; names & 1 && k < to->n_comp; k++)
            to->value[i * to->n_comp + k] += part[k];
}

static void add_class(shown *p, int k)
{
    const assembly_class *c = &p->assembly.class_[k];
    const shown_class *s = &p->out.class_[k];

    for (int u = 0; u < c->n_use; u++)
        for (uint32_t o = 0; o < c->use[u].use->term->n_out; o++) {
            const pf_slot *slot = &c->use[u].use->term->out[o];
            const int t = c->use[u].out[o];
            shown_integral *to = p->integral;

            if (s->field[t] >= 0)
                continue;
            while (to->use != c->use[u].use || to->slot != slot)
                to++;
            for (int64_t i = 0; i < c->n_item; i++)
                add_item(p, c, s->item[i], s->sum + i * s->width + s->at[t], to);
        }
}

/* Vertex functions add up to one, so that loads add up to the integral. */
static void take_means(shown *p)
{
    const space *s = &p->space;

    for (int f = 0; f < s->n_field; f++) {
        double measure = 0, sum[9] = {0};

        for (int k = 0; k < p->assembly.n_class; k++)
            for (int64_t i = 0;
                 p->assembly.class_[k].where == p->field[f].where && i < p->assembly.class_[k].n_item; i++)
                measure += p->out.class_[k].measure[i];
        for (int64_t d = 0; d < s->n_dof; d++)
            if (s->dof_field[d] == f)
                sum[s->dof_comp[d]] += p->out.load[d];
        for (int k = 0; k < s->field[f].n_comp; k++)
            p->field[f].mean[k] = sum[k] / measure;
    }
}

int shown_evaluate(shown *p, assembly_state at, error *err)
{
    at.shown = &p->out;
    TRY(assembly_show(&p->assembly, &at, err));
    for (int i = 0; i < p->n_integral; i++)
        memset(p->integral[i].value, 0, (size_t)(p->integral[i].n * p->integral[i].n_comp) * sizeof(double));
    for (int k = 0; k < p->assembly.n_class; k++)
        add_class(p, k);
    take_means(p);
    return 0;
}

int shown_project(shown *p, error *err)
{
    for (int where = PF_CELL; where <= PF_SOLID; where++)
        TRY(project_fields(p, where, err));
    return 0;
}
