/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The source of a plugin with one term: of test function w the output is d form / d w, as the form is linear in w;
 * of that the derivatives by the unknowns are the Jacobian. */
#include "weak/form.h"

#include <string.h>

/* A component of an output, and its derivatives. */
typedef struct output {
    const symbol *test;
    int at[2];
    const expr *value;
} output;

typedef struct block {
    const output *out;
    const symbol *in;
    int at[4], n_at; /* the indices of the block: of the output, of the input */
    const expr *value;
} block;

typedef struct sheet {
    form *f;
    output output[FORM_MAX_SYMBOLS];
    block block[FORM_MAX_SYMBOLS];
    int n_output, n_block, n_in;
} sheet;

/* The outputs; a test function that drops out is none. */
static void take_outputs(sheet *s, const expr *whole)
{
    form *f = s->f;
    int n = 0;

    for (int i = 0; i < f->n_symbol; i++) {
        output *o = &s->output[s->n_output];

        f->symbol[n++] = f->symbol[i];
        if (f->symbol[i]->kind != SYM_TEST)
            continue;
        *o = (output){.test = f->symbol[i], .at = {index_new(f), index_new(f)}};
        o->value = differentiate(f, whole, o->test, o->at[0], o->at[1]);
        if (index_is_number(o->value, 0))
            n--;
        else
            s->n_output++;
    }
    f->n_symbol = n;
    if (s->n_output == 0)
        form_fail(f, -1, "the form is zero, whatever the fields are");
}

static void take_derivatives(sheet *s)
{
    form *f = s->f;

    for (int o = 0; o < s->n_output; o++)
        for (int i = 0; i < f->n_symbol; i++) {
            block *b = &s->block[s->n_block];
            const output *out = &s->output[o];

            if (f->symbol[i]->kind != SYM_SLOT || !f->symbol[i]->moves)
                continue;
            *b = (block){.out = out, .in = f->symbol[i]};
            for (int k = 0; k < out->test->rank; k++)
                b->at[b->n_at++] = out->at[k];
            b->at[b->n_at] = index_new(f);
            b->at[b->n_at + 1] = index_new(f);
            b->value = differentiate(f, out->value, b->in, b->at[b->n_at], b->at[b->n_at + 1]);
            b->n_at += b->in->rank;
            if (!index_is_number(b->value, 0) && ++s->n_block == FORM_MAX_SYMBOLS)
                form_fail(f, -1, "the form has too many unknowns for its test functions; make two terms of it");
        }
}

/* Whether there is a slot in it, also one of the step before: the Jacobian of a linear term has none. */
static int moves(const expr *e)
{
    int m = e->kind == X_SYMBOL && e->symbol->kind == SYM_SLOT && !e->symbol->is_property;

    for (int i = 0; i < e->n; i++)
        m |= moves(e->arg[i]);
    return m;
}

static int is_mentioned(const expr *e, const symbol *s)
{
    int m = e->symbol == s;

    for (int i = 0; i < e->n; i++)
        m |= is_mentioned(e->arg[i], s);
    return m;
}

/* A key is one if the form has it, or a property whose number it is. */
static int is_needed(const form *f, const expr *whole, const symbol *s)
{
    int needed = is_mentioned(whole, s);

    for (int i = 0; i < f->n_symbol; i++)
        needed |= f->symbol[i]->key == s && is_mentioned(whole, f->symbol[i]);
    return needed;
}

/* Leaves out slots that are named only inside of others, as u in grad(u), and keys that nothing needs. */
static void leave_out_unused(form *f, const expr *whole)
{
    symbol *kept[FORM_MAX_SYMBOLS];
    int n = 0;

    for (int i = 0; i < f->n_symbol; i++)
        if (f->symbol[i]->kind == SYM_PART || f->symbol[i]->kind == SYM_POINT || is_needed(f, whole, f->symbol[i]))
            kept[n++] = f->symbol[i];
    memcpy(f->symbol, kept, (size_t)n * sizeof *kept);
    f->n_symbol = n;
}

/* "HEAD(entry, entry)" of the symbols of these kinds. */
static void list(const form *f, const char *head, unsigned kinds, text *t)
{
    const char *between = "";

    text_add(t, "%s(", head);
    for (int i = 0; i < f->n_symbol; i++)
        if (kinds >> f->symbol[i]->kind & 1) {
            text_add(t, "%s%s", between, f->symbol[i]->entry);
            between = ", ";
        }
    text_add(t, ")");
}

static int n_keys(const form *f)
{
    int n = 0;

    for (int i = 0; i < f->n_symbol; i++)
        n += f->symbol[i]->kind == SYM_REAL || f->symbol[i]->kind == SYM_VECTOR;
    return n;
}

/* The keys of the term's line, which the Jacobian needs, too. */
static void emit_keys(const form *f, text *t)
{
    int left = n_keys(f);

    if (left)
        text_add(t, "/* Name, unit, what it is; complete units and texts, ranges where there are any. */\n#define "
                    "KEYS \\\n");
    for (int i = 0; i < f->n_symbol && left; i++)
        if (f->symbol[i]->kind == SYM_REAL || f->symbol[i]->kind == SYM_VECTOR)
            text_add(t, "    %s%s\n", f->symbol[i]->entry, --left ? ", \\" : "\n");
}

/* What the outputs do not depend on: 0. */
static void emit_depends(const sheet *s, text *t)
{
    const form *f = s->f;
    int n = 0;

    text_add(t, "     .depends = (const uint8_t[]){");
    for (int o = 0; o < s->n_output; o++)
        for (int i = 0; i < f->n_symbol; i++) {
            int found = !f->symbol[i]->moves;

            if (f->symbol[i]->kind != SYM_SLOT)
                continue;
            for (int k = 0; k < s->n_block; k++)
                found |= s->block[k].out == &s->output[o] && s->block[k].in == f->symbol[i];
            text_add(t, "%s%d", n++ ? ", " : "", found);
        }
    text_add(t, "},\n");
}

static void emit_term(const sheet *s, text *t)
{
    const form *f = s->f;
    int nonlinear = 0, n_unknown = 0;

    for (int i = 0; i < s->n_block; i++)
        nonlinear |= !s->block[i].in->is_property && moves(s->block[i].value);
    for (int i = 0; i < f->n_symbol; i++)
        n_unknown += f->symbol[i]->kind == SYM_SLOT && f->symbol[i]->moves;
    text_add(t, "TERM(%s, %s, ", f->request->name, f->request->where);
    list(f, "IN", 1u << SYM_SLOT, t);
    list(f, ", OUT", 1u << SYM_TEST, t);
    text_add(t, ",\n     ");
    text_add(t, "PARAMS(%s),\n", n_keys(f) ? "KEYS" : "");
    if (!nonlinear || f->only_3d)
        text_add(t, "     .flags = %s%s%s,\n", nonlinear ? "" : "PF_LINEAR", nonlinear || !f->only_3d ? "" : " | ",
                 f->only_3d ? "PF_ONLY_3D" : "");
    if (s->n_block && s->n_block < n_unknown * s->n_output)
        emit_depends(s, t);
    if (s->n_block)
        text_add(t, "     .jacobian = %s_jacobian,\n", f->request->name);
    text_add(t, "     .doc = \"%s\", .cite = \"say from where\")\n", f->request->form);
}

/* LANES round all that follows, if there is anything that is computed once a point. */
static void open_lanes(const names *n, text *once, text *t)
{
    text_add(t, n->n_known ? "{\n    LANES (i) {\n%s\n" : "{\n", once->s);
    text_free(once);
}

static void close_lanes(const names *n, text *t)
{
    text_add(t, n->n_known ? "    }\n}\n" : "}\n");
}

static void emit_residual(sheet *s, text *t)
{
    names n = {.f = s->f};
    text once = {0};

    for (int o = 0; o < s->n_output; o++)
        emit_once(s->f, &n, s->output[o].value, "NUM", &once);
    open_lanes(&n, &once, t);
    for (int o = 0; o < s->n_output; o++)
        emit_assignment(s->f, &n, s->output[o].test->name, s->output[o].at, s->output[o].test->rank, "=",
                        s->output[o].value, "NUM", t);
    close_lanes(&n, t);
}

/* One addend of a block; its deltas are no factors but places. */
static void emit_addend(form *f, names *n, const block *b, const expr *e, const char *op, text *t)
{
    int at[4];

    memcpy(at, b->at, sizeof at);
    for (int again = 1; again;) {
        const expr *factor = e->kind == X_DELTA ? e : NULL, *others = index_number(f, 1);

        for (int k = 0; e->kind == X_MUL && k < e->n; k++)
            if (!factor && e->arg[k]->kind == X_DELTA)
                factor = e->arg[k];
            else
                others = index_mul(f, others, e->arg[k]);
        again = factor != NULL;
        if (!factor)
            continue;
        /* the later index is the input's */
        for (int k = 0; k < b->n_at; k++) {
            const int first = factor->index[0] / 3 < factor->index[1] / 3;

            at[k] = index_moved(at[k], factor->index[first], factor->index[!first]);
        }
        e = factor->index[0] / 3 < factor->index[1] / 3
                ? index_replace(f, others, factor->index[1], factor->index[0])
                : index_replace(f, others, factor->index[0], factor->index[1]);
    }
    emit_assignment(f, n, form_text(f, "d%s_d%s", b->out->test->name, b->in->name), at, b->n_at, op, e, "double",
                    t);
}

static void emit_jacobian(sheet *s, text *t)
{
    form *f = s->f;
    names n = {.f = f};
    text once = {0};

    text_add(t, "\nJACOBIAN(%s, ", f->request->name);
    list(f, "IN", 1u << SYM_SLOT, t);
    text_add(t, ", PARAMS(%s),\n         BLOCKS(", n_keys(f) ? "KEYS" : "");
    for (int i = 0; i < s->n_block; i++)
        text_add(t, "%sBLOCK(%s, %s)", i ? ", " : "", s->block[i].out->test->entry, s->block[i].in->entry);
    text_add(t, "))\n");
    for (int i = 0; i < s->n_block; i++)
        emit_once(f, &n, s->block[i].value, "double", &once);
    open_lanes(&n, &once, t);
    for (int i = 0; i < s->n_block; i++) {
        const expr *e = index_spread(f, s->block[i].value);
        const int n_addend = e->kind == X_ADD && index_has_delta(e, -1) ? e->n : 1;

        for (int k = 0; k < n_addend; k++)
            emit_addend(f, &n, &s->block[i], n_addend > 1 ? e->arg[k] : e, n_addend > 1 ? "+=" : "=", t);
    }
    close_lanes(&n, t);
}

static void emit_plugin(const form *f, text *t)
{
    const char *between = "";

    text_add(t, "\nPLUGIN(%s, \"%s\", FIELDS(", f->request->name, f->request->name);
    for (int i = 0; i < f->n_field; i++) {
        int used = 0;

        for (int k = 0; k < f->n_symbol; k++)
            used |= f->symbol[k]->field == &f->field[i];
        if (used && f->field[i].order)
            text_add(t, "%sFIELD(%s, \"1\", \"%s\", .order = %d)", between, f->field[i].name, f->field[i].name,
                     f->field[i].order);
        else if (used)
            text_add(t, "%s%s", between, f->field[i].name);
        between = used ? ", " : between;
    }
    text_add(t, "), TERMS(%s), .author = \"\")\n#include PF_TWIN\n", f->request->name);
}

/* Where to break a line: before column 112, after a comma or before an operator, not inside of a string; 0:
 * nowhere. */
static size_t break_at(const char *line, size_t n)
{
    enum { WIDTH = 112 };
    size_t at = 0, in_string = 0;

    for (size_t k = strspn(line, " ") + 1; k < n && k <= WIDTH && n > WIDTH; k++) {
        in_string ^= line[k] == '"';
        if (!in_string && line[k] == ' ' && (line[k - 1] == ',' || strchr("+-*/?:", line[k + 1])))
            at = k;
    }
    return *line == '#' ? 0 : at;
}

static void wrap(const char *line, size_t n, text *t)
{
    const int from = (int)strspn(line, " ") + 4;

    for (size_t cut; (cut = break_at(line, n)) > 0; line += cut + 1, n -= cut + 1)
        text_add(t, "%.*s\n%*s", (int)cut, line, from, "");
    text_add(t, "%.*s\n", (int)n, line);
}

void emit_source(form *f, const tree *t, text *source)
{
    sheet *s = form_room(f, 1, sizeof *s);
    const expr *whole = lower(f, t, -1, -1);
    text draft = {0};

    s->f = f;
    leave_out_unused(f, whole);
    take_outputs(s, whole);
    take_derivatives(s);
    text_add(&draft, "/* %s\n *\n *     %s\n *\n * Written by plugflow new --weak; yours to change. */\n",
             f->request->name, f->request->form);
    if (strcmp(f->request->where, "PF_SOLID") == 0 && (form_named(f, "rho") || form_named(f, "density")))
        text_add(&draft, "/* The density here is the fluid's; that of the body is b->density[i]. */\n");
    text_add(&draft, "#include <plugflow/term.h>\n\n");
    for (int i = 0; i < f->n_field; i++)
        if (f->field[i].order)
            text_add(&draft, "#define PF_SHAPE_%s %s\n\n", f->field[i].name,
                     f->field[i].rank ? "VECTOR" : "SCALAR");
    emit_keys(f, &draft);
    emit_term(s, &draft);
    emit_residual(s, &draft);
    if (s->n_block)
        emit_jacobian(s, &draft);
    emit_plugin(f, &draft);
    for (const char *line = draft.s; line && *line; line += strcspn(line, "\n") + 1)
        wrap(line, strcspn(line, "\n"), source);
    text_free(&draft);
}
