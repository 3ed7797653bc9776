/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Expressions as one would write them in C. */
#include "weak/form.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { IN_SUM = 1, IN_PRODUCT = 2, IN_QUOTIENT = 3 };

static void print(names *n, const expr *e, int inside, text *t);

/* Not the name of anything else in the form. */
static int is_free(const names *n, const char *name)
{
    return !form_named(n->f, name);
}

const char *print_index_name(names *n, int index)
{
    static const char *const letters[] = {"a", "k",  "l",  "m",  "j",  "c",  "d",  "e",  "f",  "o",  "w",  "y",
                                          "z", "a1", "k1", "l1", "m1", "j1", "c1", "d1", "e1", "f1", "o1", "w1"};
    size_t next = 0;

    for (int i = 0; i < n->n_index; i++)
        if (n->index[i] == index / 3)
            return n->name[PRINT_MAX - 1 - i];
    for (int i = 0; i < n->n_index; i++)
        for (size_t k = next; k < sizeof letters / sizeof *letters; k++)
            if (strcmp(letters[k], n->name[PRINT_MAX - 1 - i]) == 0)
                next = k + 1;
    while (next + 1 < sizeof letters / sizeof *letters && !is_free(n, letters[next]))
        next++;
    n->index[n->n_index] = index / 3;
    n->name[PRINT_MAX - 1 - n->n_index] = letters[next];
    return n->name[PRINT_MAX - 1 - n->n_index++];
}

static void print_index(names *n, int index, text *t)
{
    if (index % 3)
        text_add(t, "(%s + %d) %% 3", print_index_name(n, index), index % 3);
    else
        text_add(t, "%s", print_index_name(n, index));
}

static void print_number(double v, text *t)
{
    char s[40];

    for (int digits = 15; digits <= 17; digits++) {
        snprintf(s, sizeof s, "%.*g", digits, v);
        if (strtod(s, NULL) == v)
            break;
    }
    text_add(t, "%s", s);
}

static void print_symbol(names *n, const expr *e, text *t)
{
    const symbol *s = e->symbol;
    const int is_slot = s->kind == SYM_SLOT || s->kind == SYM_TEST, at = s->kind == SYM_POINT && s->rank > 0;

    text_add(t, "%s%s", at ? "AT(" : "", s->name);
    for (int k = 0; k < 2 && e->index[k] >= 0; k++) {
        text_add(t, at ? ", " : "[");
        print_index(n, e->index[k], t);
        text_add(t, at ? "" : "]");
    }
    text_add(t, at ? ")" : is_slot ? "[i]" : "");
}

/* Whether e is printed with a minus; what is left of it is printed by print_size. */
static int is_negative(const expr *e)
{
    return e->kind == X_NUMBER ? e->number < 0 : (e->kind == X_MUL || e->kind == X_DIV) && is_negative(e->arg[0]);
}

/* Factors, with deltas as a condition: (a == k ? p[i] : 0). */
static void print_product(names *n, const expr *e, text *t)
{
    const char *between = "";
    int deltas = 0, others = 0;

    for (int k = 0; k < e->n; k++)
        if (e->arg[k]->kind == X_DELTA) {
            text_add(t, deltas++ ? " && " : "(");
            print_index(n, e->arg[k]->index[0], t);
            text_add(t, " == ");
            print_index(n, e->arg[k]->index[1], t);
        }
    text_add(t, deltas ? " ? " : "");
    for (int k = 0; k < e->n; k++)
        if (e->arg[k]->kind != X_DELTA) {
            text_add(t, "%s", between);
            print(n, e->arg[k], IN_PRODUCT, t);
            between = " * ";
            others++;
        }
    text_add(t, others ? "" : "1");
    text_add(t, deltas ? " : 0)" : "");
}

static void print_size(names *n, const expr *e, int inside, text *t)
{
    if (!is_negative(e)) {
        print(n, e, inside, t);
    } else if (e->kind == X_NUMBER) {
        print_number(-e->number, t);
    } else if (e->kind == X_DIV) {
        print_size(n, e->arg[0], IN_PRODUCT, t);
        text_add(t, " / ");
        print(n, e->arg[1], IN_QUOTIENT, t);
    } else {
        const expr size = {.kind = X_NUMBER, .number = -e->arg[0]->number, .index = {-1, -1}}, *arg[64];
        const int from = size.number == 1, number = e->n < 64 ? e->n : 64;

        for (int k = 0; k < number; k++)
            arg[k] = k ? e->arg[k] : &size;
        print_product(n, &(expr){.kind = X_MUL, .n = number - from, .arg = arg + from}, t);
    }
}

static void print_call(names *n, const expr *e, text *t)
{
    text_add(t, "%s(", e->call);
    for (int k = 0; k < e->n; k++) {
        text_add(t, k ? ", " : "");
        print(n, e->arg[k], 0, t);
    }
    text_add(t, ")");
}

static void print_select(names *n, const expr *e, text *t)
{
    static const char *const after[] = {" < ", " ? ", " : ", ")"};

    text_add(t, "(");
    for (int k = 0; k < 4; k++) {
        print(n, e->arg[k], IN_PRODUCT, t);
        text_add(t, "%s", after[k]);
    }
}

static void print_sum(names *n, const expr *e, text *t)
{
    for (int k = 0; k < e->n; k++) {
        const int minus = is_negative(e->arg[k]);

        text_add(t, minus ? (k ? " - " : "-") : (k ? " + " : ""));
        print_size(n, e->arg[k], IN_SUM, t);
    }
}

static void print(names *n, const expr *e, int inside, text *t)
{
    const int bracket = (e->kind == X_ADD && inside >= IN_PRODUCT) ||
                        ((e->kind == X_MUL || e->kind == X_DIV) && inside == IN_QUOTIENT) ||
                        (is_negative(e) && inside >= IN_PRODUCT);

    for (int i = 0; i < n->n_known; i++)
        if (index_same(n->known[i], e)) {
            text_add(t, "%s", n->name[i]);
            return;
        }
    text_add(t, bracket ? "(" : "");
    if (is_negative(e)) {
        text_add(t, "-");
        print_size(n, e, IN_PRODUCT, t);
    } else if (e->kind == X_NUMBER) {
        print_number(e->number, t);
    } else if (e->kind == X_SYMBOL) {
        print_symbol(n, e, t);
    } else if (e->kind == X_DELTA) {
        print_product(n, &(expr){.kind = X_MUL, .n = 1, .arg = &e}, t);
    } else if (e->kind == X_ADD) {
        print_sum(n, e, t);
    } else if (e->kind == X_MUL) {
        print_product(n, e, t);
    } else if (e->kind == X_DIV) {
        print(n, e->arg[0], IN_PRODUCT, t);
        text_add(t, " / ");
        print(n, e->arg[1], IN_QUOTIENT, t);
    } else if (e->kind == X_CALL && *e->call) {
        print_call(n, e, t);
    } else if (e->kind == X_CALL) {
        print(n, e->arg[0], IN_QUOTIENT, t);
    } else if (e->kind == X_SELECT) {
        print_select(n, e, t);
    }
    text_add(t, bracket ? ")" : "");
}

void print_expr(names *n, const expr *e, text *t)
{
    print(n, e, 0, t);
}
