/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Statements: what is computed once a point has a name of its own, sums are loops, and a component is an assignment
 * inside of loops over its indices. */
#include "weak/form.h"

#include <string.h>

static void indent(text *t, int depth)
{
    text_add(t, "%*s", 4 * depth, "");
}

/* No index of e comes from outside of it. */
static int is_closed(const expr *e, const int *bound, int n_bound)
{
    int own[16], n_own = n_bound < 15 ? n_bound : 15;

    for (int i = 0; i < n_own; i++)
        own[i] = bound[i];
    if (e->kind == X_SUM)
        own[n_own++] = e->index[0] / 3;
    for (int k = 0; k < 2 && e->index[k] >= 0; k++) {
        int found = 0;

        for (int i = 0; i < n_own; i++)
            found |= own[i] == e->index[k] / 3;
        if (!found)
            return 0;
    }
    for (int i = 0; i < e->n; i++)
        if (!is_closed(e->arg[i], own, n_own))
            return 0;
    return 1;
}

static int is_known(const names *n, const expr *e)
{
    for (int i = 0; i < n->n_known; i++)
        if (index_same(n->known[i], e))
            return 1;
    return 0;
}

/* A name for e, like `like` and new. */
static const char *new_name(form *f, names *n, const expr *e, const char *like)
{
    const char *name = like;
    int taken = 1;

    for (int k = 2; taken; k++) {
        taken = form_named(f, name) && !(e->kind == X_CALL && e->symbol);
        for (int i = 0; i < n->n_known; i++)
            taken |= strcmp(n->name[i], name) == 0;
        if (taken)
            name = form_text(f, "%s_%d", like, k);
    }
    if (n->n_known == PRINT_MAX / 2)
        form_fail(f, -1, "the form is too long; give names to its parts or make two terms of it");
    n->known[n->n_known] = e;
    n->name[n->n_known++] = name;
    return name;
}

static const char *name_of(const expr *e)
{
    static const char *const of[][2] = {{"sqrt", "root"},     {"pow", "power"},   {"exp", "exponential"},
                                        {"log", "logarithm"}, {"sin", "sine"},    {"cos", "cosine"},
                                        {"max", "larger"},    {"min", "smaller"}, {"fabs", "size"}};

    if (e->kind == X_SUM)
        return "sum";
    if (e->symbol)
        return e->symbol->name;
    for (size_t i = 0; i < sizeof of / sizeof *of; i++)
        if (strcmp(e->call, of[i][0]) == 0)
            return of[i][1];
    return "value";
}

static void emit_sums(form *f, names *n, const expr *e, const char *type, int depth, text *t);
static int has_sum(const names *n, const expr *e);

/* type sum = 0;  EACH (k) sum += body; */
static void emit_sum(form *f, names *n, const expr *e, const char *type, int depth, text *t)
{
    const int n_known = n->n_known, n_index = n->n_index;
    const expr *body = e;
    const char *name;
    int inner;
    text loop = {0};

    for (inner = depth; body->kind == X_SUM; body = body->arg[0], inner++) {
        const char *index = print_index_name(n, body->index[0]);

        indent(&loop, inner);
        text_add(&loop, "EACH (%s)", index);
        if (body->arg[0]->kind == X_SUM)
            text_add(&loop, "\n");
    }
    name = new_name(f, n, e, name_of(e));
    indent(t, depth);
    text_add(t, "%s %s = 0;\n\n%s%s\n", type, name, loop.s ? loop.s : "", has_sum(n, body) ? " {" : "");
    text_free(&loop);
    emit_sums(f, n, body, type, inner, t);
    indent(t, inner);
    text_add(t, "%s += ", name);
    print_expr(n, body, t);
    text_add(t, ";\n");
    if (n->n_known > n_known + 1) {
        indent(t, inner - 1);
        text_add(t, "}\n");
    }
    n->n_known = n_known + 1;
    n->n_index = n_index;
}

static int has_sum(const names *n, const expr *e)
{
    if (is_known(n, e))
        return 0;
    if (e->kind == X_SUM)
        return 1;
    for (int i = 0; i < e->n; i++)
        if (has_sum(n, e->arg[i]))
            return 1;
    return 0;
}

/* The sums in e that have no name yet. */
static void emit_sums(form *f, names *n, const expr *e, const char *type, int depth, text *t)
{
    if (is_known(n, e))
        return;
    if (e->kind == X_SUM) {
        emit_sum(f, n, e, type, depth, t);
        return;
    }
    for (int i = 0; i < e->n; i++)
        emit_sums(f, n, e->arg[i], type, depth, t);
}

void emit_once(form *f, names *n, const expr *e, const char *type, text *t)
{
    if (is_known(n, e) || (e->kind == X_SUM && !is_closed(e, NULL, 0)))
        return;
    if (e->kind != X_SUM)
        for (int i = 0; i < e->n; i++)
            emit_once(f, n, e->arg[i], type, t);
    if (e->kind == X_SUM) {
        emit_sum(f, n, e, type, 2, t);
    } else if (e->kind == X_CALL && is_closed(e, NULL, 0)) {
        text value = {0};

        print_expr(n, *e->call ? e : e->arg[0], &value);
        indent(t, 2);
        text_add(t, "const %s %s = %s;\n", type, new_name(f, n, e, name_of(e)), value.s ? value.s : "");
        text_free(&value);
    }
}

void emit_assignment(form *f, names *n, const char *target, const int *at, int n_at, const char *op, const expr *e,
                     const char *type, text *t)
{
    const int n_known = n->n_known, n_index = n->n_index, braces = has_sum(n, e), own_lanes = n_known == 0;
    const int from = own_lanes ? 1 : 2;
    int depth = from;

    for (int k = 0; k < n_at; k++) {
        int before = 0;

        for (int l = 0; l < k; l++)
            before |= at[l] / 3 == at[k] / 3;
        if (before)
            continue;
        indent(t, depth++);
        text_add(t, "EACH (%s)\n", print_index_name(n, at[k]));
    }
    if (own_lanes) {
        indent(t, depth++);
        text_add(t, "LANES (i)\n");
    }
    if (braces) {
        if (depth > from) {
            t->n--; /* the line end */
            text_add(t, " {\n");
        }
        emit_sums(f, n, e, type, depth, t);
    }
    indent(t, depth);
    text_add(t, "%s", target);
    for (int k = 0; k < n_at; k++)
        text_add(t, at[k] % 3 ? "[(%s + %d) %% 3]" : "[%s]", print_index_name(n, at[k]), at[k] % 3);
    text_add(t, "[i] %s ", op);
    print_expr(n, e, t);
    text_add(t, ";\n");
    if (braces && depth > from) {
        indent(t, depth - 1);
        text_add(t, "}\n");
    }
    n->n_known = n_known;
    n->n_index = n_index;
}
