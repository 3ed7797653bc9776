/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Whether the slots of a term make sense where it acts. */
#include "term/check.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

int check_is_name(const char *s)
{
    if (!s || !((*s >= 'a' && *s <= 'z') || (*s >= 'A' && *s <= 'Z')))
        return 0;
    for (; *s; s++)
        if (!((*s >= 'a' && *s <= 'z') || (*s >= 'A' && *s <= 'Z') || (*s >= '0' && *s <= '9') || *s == '_'))
            return 0;
    return 1;
}

int check_wrong(error *err, const check_subject *s, const char *fmt, ...)
{
    char why[600];
    va_list ap;

    va_start(ap, fmt);
    vsnprintf(why, sizeof why, fmt, ap);
    va_end(ap);
    return error_set(err, ERR_PLUGIN, "plugin %s%s%s: %s", s->path, s->term ? ", term " : "",
                     s->term ? s->term : "", why);
}

/* What a slot may hold besides fields and data: where, and what it needs of its own description. */
static int check_special(const pf_slot *slot, uint32_t where, int is_out, const check_subject *s, error *err)
{
    const int on_body = where == PF_SOLID || where == PF_SURFACE || where == PF_PARTICLE || where == PF_PAIR;
    const int shown = slot->eval == PF_SHOW || slot->eval == PF_INTEGRAL, key = slot->eval == PF_BODY_KEY;

    if (shown != is_out && slot->eval != PF_PROPERTY)
        return check_wrong(err, s, "%s slot \"%s\": %s is for %s slots", is_out ? "output" : "input", slot->name,
                           term_eval_name(slot->eval), is_out ? "input" : "output");
    if (!shown && !check_is_name(slot->field))
        return check_wrong(err, s, "slot \"%s\" does not say which %s: set its field to the name", slot->name,
                           term_eval_name(slot->eval));
    if ((key && !on_body) || (slot->eval == PF_OTHER_KEY && where != PF_PAIR))
        return check_wrong(err, s, "slot \"%s\": %s points have no %s", slot->name, term_where_name(where),
                           term_eval_name(slot->eval));
    if (shown && where == PF_CUT)
        return check_wrong(err, s, "slot \"%s\": PF_CUT points have nothing to show", slot->name);
    if (shown && slot->shape > PF_SYMMETRIC)
        return check_wrong(err, s, "slot \"%s\": a gradient of a tensor cannot be shown", slot->name);
    if (slot->eval == PF_SHOW && where != PF_CELL && where != PF_FLUID && where != PF_SOLID)
        return check_wrong(err, s, "slot \"%s\": a field can be shown of points in cells, not of %s points",
                           slot->name, term_where_name(where));
    if ((key || slot->eval == PF_OTHER_KEY) && slot->shape != PF_SCALAR && slot->shape != PF_VECTOR)
        return check_wrong(err, s, "slot \"%s\": a key of bodies is PF_SCALAR or PF_VECTOR", slot->name);
    if ((is_out || key) && (!slot->unit || !slot->doc))
        return check_wrong(err, s, "slot \"%s\" lacks a unit (\"1\" if it has none) or a line of doc", slot->name);
    return 0;
}

/* Memory is of points in cells, or of bodies. */
static int check_memory(const pf_slot *slot, const pf_field *f, uint32_t where, const check_subject *s, error *err)
{
    const int kept = f->support == PF_AT_POINTS || f->support == PF_KEPT_BY_PARTICLE;
    const int in_cells = where == PF_CELL || where == PF_FLUID || where == PF_SOLID;

    if (kept != (slot->eval == PF_STATE))
        return check_wrong(err, s,
                           kept ? "slot \"%s\": field \"%s\" is memory, so the slot must be PF_STATE"
                                : "slot \"%s\" is PF_STATE, but field \"%s\" is no memory: its support is "
                                  "neither PF_AT_POINTS nor PF_KEPT_BY_PARTICLE",
                           slot->name, f->name);
    if (kept && (f->support == PF_AT_POINTS ? !in_cells : where != PF_PARTICLE))
        return check_wrong(err, s, "slot \"%s\": %s points have no memory of this support", slot->name,
                           term_where_name(where));
    return 0;
}

/* What of a field there is at such points. */
static int check_place(const pf_slot *slot, const pf_field *f, uint32_t where, const check_subject *s, error *err)
{
    const int off_mesh = f->support == PF_ON_PROBLEM || f->support == PF_ON_PARTICLE;
    const uint32_t e = slot->eval;

    if (e == PF_DEFECT && where != PF_CUT && where != PF_PAIR)
        return check_wrong(err, s, "slot \"%s\" asks for PF_DEFECT, which only PF_CUT and PF_PAIR points have",
                           slot->name);
    if (e == PF_OTHER && where != PF_PAIR)
        return check_wrong(err, s, "slot \"%s\" asks for PF_OTHER, which only PF_PAIR points have", slot->name);
    if (where == PF_CUT && (e != PF_DEFECT || f->support != PF_ON_MESH))
        return check_wrong(err, s, "slot \"%s\": on PF_CUT points fields on the mesh are there, as PF_DEFECT only",
                           slot->name);
    if (where == PF_PAIR && (f->support != PF_ON_PARTICLE || (e != PF_DEFECT && e != PF_VALUE && e != PF_OTHER)))
        return check_wrong(
            err, s,
            "slot \"%s\": on PF_PAIR points fields on particles are there, as PF_DEFECT, PF_VALUE or "
            "PF_OTHER",
            slot->name);
    if (where == PF_PARTICLE && !off_mesh)
        return check_wrong(err, s,
                           "slot \"%s\": at PF_PARTICLE points fields of particles and of the problem are there",
                           slot->name);
    if (f->support == PF_ON_MESH && f->order == 0 &&
        (e == PF_GRAD || e == PF_DIV || e == PF_LAPLACE || where == PF_CUT))
        return check_wrong(err, s, "slot \"%s\": field \"%s\" has one value a cell (order 0) and no %s", slot->name,
                           f->name, term_eval_name(e));
    if (off_mesh && e != PF_VALUE && e != PF_DOT && e != PF_OLD && e != PF_DEFECT && e != PF_OTHER)
        return check_wrong(err, s, "slot \"%s\": field \"%s\" does not live on the mesh and has no %s", slot->name,
                           f->name, term_eval_name(e));
    return 0;
}

static int check_field(const term_plugin *p, const pf_slot *slot, uint32_t where, int is_out,
                       const check_subject *s, error *err)
{
    const char *side = is_out ? "output" : "input";
    const pf_field *f = term_field(p, slot->field);
    const uint32_t e = slot->eval;

    if (is_out && e == PF_LAPLACE)
        return check_wrong(
            err, s,
            "output slot \"%s\": PF_LAPLACE is for input slots; of a test function there are PF_VALUE, "
            "PF_GRAD and PF_DIV",
            slot->name);
    if (is_out && e != PF_VALUE && e != PF_GRAD && e != PF_DIV && e != PF_DEFECT && e != PF_OTHER && e != PF_STATE)
        return check_wrong(err, s, "%s slot \"%s\": eval %u is not possible there", side, slot->name, e);
    if (!f)
        return check_wrong(
            err, s,
            "%s slot \"%s\" uses field \"%s\", an undeclared dependency: add it to the plugin's field list "
            "(several plugins may declare the same field)",
            side, slot->name, slot->field ? slot->field : "(none)");
    if (term_slot_shape(e, f->shape) != slot->shape)
        return check_wrong(err, s, "%s slot \"%s\": the %s of field \"%s\" has another shape than the slot says",
                           side, slot->name, term_eval_name(e), f->name);
    TRY(check_memory(slot, f, where, s, err));
    return e == PF_STATE ? 0 : check_place(slot, f, where, s, err);
}

static int check_list(const term_plugin *p, const pf_slot *slot, uint32_t n, uint32_t where, int is_out,
                      const check_subject *s, error *err)
{
    const char *side = is_out ? "output" : "input";

    for (uint32_t i = 0; i < n; i++) {
        if (!check_is_name(slot[i].name))
            return check_wrong(err, s, "%s slot %u has no proper name (letters, digits, _)", side, i);
        for (uint32_t k = 0; k < i; k++)
            if (strcmp(slot[k].name, slot[i].name) == 0)
                return check_wrong(err, s, "two %s slots are called \"%s\"", side, slot[i].name);
        if (slot[i].eval < PF_VALUE || slot[i].eval > PF_INTEGRAL || (is_out && slot[i].eval == PF_DATA))
            return check_wrong(err, s, "%s slot \"%s\": eval %u is not possible there", side, slot[i].name,
                               slot[i].eval);
        if (slot[i].shape < PF_SCALAR || slot[i].shape > PF_TENSOR_GRAD)
            return check_wrong(err, s, "%s slot \"%s\": unknown shape %u", side, slot[i].name, slot[i].shape);
        if (slot[i].eval != PF_DATA && (slot[i].flags & PF_REQUIRED))
            return check_wrong(err, s, "%s slot \"%s\" has PF_REQUIRED, which is for PF_DATA", side, slot[i].name);
        if (slot[i].eval == PF_DATA)
            continue;
        TRY(term_slot_field(&slot[i]) || slot[i].eval == PF_STATE ? check_field(p, &slot[i], where, is_out, s, err)
                                                                  : check_special(&slot[i], where, is_out, s, err));
    }
    return 0;
}

/* What of a later version the term uses, and that version. */
static const char *later(const pf_term *t, uint32_t *minor)
{
    const char *what = t->flags & PF_METRIC ? "PF_METRIC" : NULL;

    *minor = 3;
    for (uint32_t k = 0; k < t->n_in; k++)
        if (t->in[k].eval == PF_LAPLACE)
            what = "PF_LAPLACE";
    for (uint32_t k = 0; k < t->n_in + t->n_out; k++) {
        const pf_slot *s = k < t->n_in ? &t->in[k] : &t->out[k - t->n_in];

        if (s->eval == PF_DATA && (s->flags & PF_REQUIRED)) {
            *minor = 4;
            return "PF_REQUIRED of data";
        }
        if (s->eval > PF_LAPLACE || s->shape > PF_SPIN || (t->where == PF_PAIR && s->eval == PF_VALUE)) {
            *minor = 4;
            return s->eval > PF_LAPLACE ? term_eval_name(s->eval) : "a slot";
        }
    }
    if (t->replaces || t->init || t->done) {
        *minor = 4;
        return t->replaces ? "replaces" : "init and done";
    }
    if (t->where == PF_PARTICLE || t->flags & (PF_WALL_DISTANCE | PF_ONLY_2D | PF_ONLY_3D | PF_LAST)) {
        *minor = 4;
        return t->where == PF_PARTICLE ? "PF_PARTICLE" : "a flag";
    }
    return what;
}

/* One kind of output; nothing that older versions of plugflow would misread. */
static int check_whole(const term_plugin *p, const pf_term *t, const check_subject *s, error *err)
{
    const enum term_kind kind = term_kind(t);
    uint32_t minor;
    const char *what = later(t, &minor);

    if ((t->flags & PF_METRIC) && (t->where == PF_CUT || t->where == PF_PAIR || t->where == PF_PARTICLE))
        return check_wrong(err, s, "has PF_METRIC, but %s points lie in no single element and have no metric",
                           term_where_name(t->where));
    if (what && p->d.min_minor < minor)
        return check_wrong(err, s,
                           "uses %s of plugin interface 1.%u, which older ones do not have; set .min_minor = %u in "
                           "its pf_plugin",
                           what, minor, minor);
    for (uint32_t o = 0; o < t->n_out; o++) {
        const uint32_t e = t->out[o].eval;
        const int fits = kind == TERM_PUBLISHES ? e == PF_PROPERTY
                         : kind == TERM_SHOWS   ? e == PF_SHOW || e == PF_INTEGRAL
                                                : 1;

        if (!fits)
            return check_wrong(
                err, s,
                "output \"%s\" is %s beside outputs of another kind: equations, properties and what is "
                "shown are terms of their own",
                t->out[o].name, term_eval_name(e));
    }
    if (kind == TERM_SHOWS && (t->flags & PF_BY_BOUNDARY))
        return check_wrong(err, s, "has PF_BY_BOUNDARY, but what is shown is so of all boundaries");
    if (kind == TERM_PUBLISHES && t->where != PF_CELL && t->where != PF_FLUID && t->where != PF_SOLID)
        return check_wrong(
            err, s,
            "publishes a property, so it must act on PF_CELL, PF_FLUID (it is evaluated wherever a term "
            "asks for it) or PF_SOLID");
    return 0;
}

int check_slots(const term_plugin *p, const pf_term *t, const check_subject *s, error *err)
{
    TRY(check_list(p, t->in, t->n_in, t->where, 0, s, err));
    TRY(check_list(p, t->out, t->n_out, t->where, 1, s, err));
    return check_whole(p, t, s, err);
}
