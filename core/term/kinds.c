/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What slots, shapes and terms are: components, names, kinds. */
#include "term/term.h"

#include <string.h>

int term_components(uint32_t shape, int dim)
{
    switch (shape) {
    case PF_SCALAR:
        return 1;
    case PF_VECTOR:
        return dim;
    case PF_TENSOR:
        return dim * dim;
    case PF_SPIN:
        return dim == 2 ? 1 : 3;
    case PF_SYMMETRIC:
        return dim * (dim + 1) / 2;
    case PF_SYMMETRIC_GRAD:
        return dim * dim * (dim + 1) / 2;
    case PF_TENSOR_GRAD:
        return dim * dim * dim;
    default:
        return 0;
    }
}

const char *term_component(uint32_t shape, int n_comp, int k)
{
    static const char *const vector[] = {"x", "y", "z"};
    static const char *const symmetric[2][6] = {{"xx", "xy", "yy"}, {"xx", "xy", "xz", "yy", "yz", "zz"}};
    static const char *const tensor[2][9] = {{"xx", "xy", "yx", "yy"},
                                             {"xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"}};

    if (n_comp == 1)
        return "";
    return shape == PF_SYMMETRIC ? symmetric[n_comp > 3][k]
           : shape == PF_TENSOR  ? tensor[n_comp > 4][k]
                                 : vector[k];
}

int term_turns_sign(uint32_t shape, int n_comp, int k, int axis)
{
    const char *name = term_component(shape, n_comp, k), normal = "xyz"[axis];

    if (shape == PF_VECTOR)
        return k == axis;
    return term_is_tensor(shape) && (name[0] == normal) != (name[1] == normal);
}

int term_is_tensor(uint32_t shape)
{
    return shape == PF_TENSOR || shape == PF_SYMMETRIC;
}

const char *term_shape_name(uint32_t shape)
{
    static const char *const name[] = {"",
                                       "scalar",
                                       "vector",
                                       "tensor",
                                       "spin",
                                       "symmetric tensor",
                                       "gradient of a symmetric tensor",
                                       "gradient of a tensor"};

    return shape <= PF_TENSOR_GRAD ? name[shape] : "";
}

int term_slot_field(const pf_slot *s)
{
    return s->eval >= PF_VALUE && s->eval <= PF_OTHER && s->eval != PF_DATA && s->eval != PF_PROPERTY &&
           s->eval != PF_BODY_KEY && s->eval != PF_OTHER_KEY;
}

int term_is_unknown(const pf_slot *s)
{
    return term_slot_field(s) && s->eval != PF_OLD;
}

int term_is_derived(const pf_slot *s)
{
    return term_is_unknown(s) || s->eval == PF_PROPERTY;
}

enum term_kind term_kind(const pf_term *t)
{
    enum term_kind kind = TERM_EQUATION;

    for (uint32_t o = 0; o < t->n_out; o++)
        kind = t->out[o].eval == PF_PROPERTY                                ? TERM_PUBLISHES
               : t->out[o].eval == PF_SHOW || t->out[o].eval == PF_INTEGRAL ? TERM_SHOWS
                                                                            : kind;
    return kind;
}

const double *term_number(const term_use *u, const pf_slot *s)
{
    for (uint32_t i = 0; i < u->term->n_param; i++) {
        const pf_param *q = &u->term->param[i];

        if (strcmp(q->name, s->field) == 0 &&
            ((q->type == PF_T_REAL && s->shape == PF_SCALAR) || (q->type == PF_T_VECTOR && s->shape == PF_VECTOR)))
            return (const double *)(const void *)((const char *)u->params + q->offset);
    }
    return NULL;
}

int term_takes(const pf_term *t, const char *property)
{
    for (uint32_t k = 0; k < t->n_in; k++)
        if (t->in[k].eval == PF_PROPERTY && strcmp(t->in[k].field, property) == 0)
            return 1;
    return 0;
}

int term_publishes(const pf_term *t, const char *property)
{
    for (uint32_t o = 0; o < t->n_out; o++)
        if (t->out[o].eval == PF_PROPERTY && strcmp(t->out[o].field, property) == 0)
            return (int)o;
    return -1;
}

int term_stores(const pf_term *t, const char *field)
{
    for (uint32_t k = 0; k < t->n_in; k++)
        for (uint32_t o = 0; o < t->n_out && t->in[k].eval == PF_DOT; o++)
            if (t->out[o].eval == PF_VALUE && strcmp(t->out[o].field, t->in[k].field) == 0 &&
                (!field || strcmp(field, t->in[k].field) == 0))
                return 1;
    return 0;
}

static int holds(const pf_slot *slot, uint32_t n, const char *field, uint32_t eval)
{
    for (uint32_t i = 0; i < n; i++)
        if (slot[i].eval == eval && strcmp(slot[i].field, field) == 0)
            return 1;
    return 0;
}

int term_diffuses(const pf_term *t, const char *field)
{
    return holds(t->in, t->n_in, field, PF_GRAD) && holds(t->out, t->n_out, field, PF_GRAD) &&
           !holds(t->in, t->n_in, field, PF_LAPLACE);
}

uint32_t term_slot_shape(uint32_t eval, uint32_t field_shape)
{
    switch (eval) {
    case PF_GRAD:
        return field_shape == PF_SCALAR      ? PF_VECTOR
               : field_shape == PF_VECTOR    ? PF_TENSOR
               : field_shape == PF_SYMMETRIC ? PF_SYMMETRIC_GRAD
               : field_shape == PF_TENSOR    ? PF_TENSOR_GRAD
                                             : 0;
    case PF_DIV:
        return field_shape == PF_VECTOR ? PF_SCALAR : 0;
    default:
        return field_shape;
    }
}

const char *term_where_name(uint32_t where)
{
    static const char *const name[] = {"",           "PF_CELL", "PF_FLUID",    "PF_SOLID", "PF_FACET",
                                       "PF_SURFACE", "PF_CUT",  "PF_PARTICLE", "PF_PAIR"};

    return where <= PF_PAIR ? name[where] : "";
}

const char *term_eval_name(uint32_t eval)
{
    static const char *const name[] = {"",
                                       "value",
                                       "gradient",
                                       "divergence",
                                       "d/dt",
                                       "old value",
                                       "data",
                                       "defect",
                                       "Laplacian",
                                       "property",
                                       "key of the body",
                                       "key of the other body",
                                       "value of the other body",
                                       "memory",
                                       "shown",
                                       "integral"};

    return eval <= PF_INTEGRAL ? name[eval] : "";
}

const pf_field *term_field(const term_plugin *p, const char *name)
{
    for (uint32_t i = 0; name && i < p->d.n_field; i++)
        if (strcmp(p->d.field[i].name, name) == 0)
            return &p->d.field[i];
    return NULL;
}
