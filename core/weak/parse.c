/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Reading a form.
 *
 *     form    = { name "=" sum ";" } sum
 *     sum     = ["-"] product { ("+" | "-") product }
 *     product = power { ("*" | "/") power }
 *     power   = operand [ ("^" | "**") ["-"] operand ]
 *     operand = number | name | name "(" sum { "," sum } ")" | "(" sum ")"                          */
#include "weak/form.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_DEPTH = 200 };

typedef struct reader {
    form *f;
    const char *at;
    int depth;
} reader;

static tree *parse_sum(reader *r);

static int column(const reader *r)
{
    return (int)(r->at - r->f->request->form);
}

static void skip_blanks(reader *r)
{
    while (isspace((unsigned char)*r->at))
        r->at++;
}

/* Takes s if it is what comes next. */
static int take(reader *r, const char *s)
{
    skip_blanks(r);
    if (strncmp(r->at, s, strlen(s)) != 0)
        return 0;
    r->at += strlen(s);
    return 1;
}

static void expect(reader *r, const char *s, int opened)
{
    if (!take(r, s))
        form_fail(r->f, column(r), "expected \"%s\"%s", s, opened >= 0 ? " of a bracket that was opened" : "");
}

static const char *take_name(reader *r)
{
    const char *s = r->at;

    while (isalnum((unsigned char)*r->at) || *r->at == '_')
        r->at++;
    return form_text(r->f, "%.*s", (int)(r->at - s > 60 ? 60 : r->at - s), s);
}

static tree *parse_operand(reader *r)
{
    tree *t, *arg[3];
    int n = 0, from;

    skip_blanks(r);
    from = column(r);
    if (++r->depth > MAX_DEPTH)
        form_fail(r->f, from, "brackets nested deeper than %d", MAX_DEPTH);
    if (isdigit((unsigned char)*r->at) || *r->at == '.') {
        char *end;

        t = tree_new(r->f, "number", from, NULL, NULL);
        t->number = strtod(r->at, &end);
        if (end == r->at)
            form_fail(r->f, from, "expected a number");
        if (!isfinite(t->number))
            form_fail(r->f, from, "the number is too large");
        r->at = end;
    } else if (isalpha((unsigned char)*r->at)) {
        const char *name = take_name(r);

        if (take(r, "(")) {
            do {
                if (n == 3)
                    form_fail(r->f, column(r), "%s has too many arguments", name);
                arg[n++] = parse_sum(r);
            } while (take(r, ","));
            expect(r, ")", from);
            t = meaning_of_call(r->f, name, from, arg, n);
        } else {
            t = meaning_of_name(r->f, name, from);
        }
    } else if (take(r, "(")) {
        t = parse_sum(r);
        expect(r, ")", from);
    } else {
        form_fail(r->f, from, *r->at ? "expected a name, a number or \"(\"" : "the form ends too early");
    }
    r->depth--;
    return t;
}

static tree *parse_power(reader *r)
{
    tree *t = parse_operand(r);

    skip_blanks(r);
    if (take(r, "**") || take(r, "^")) {
        const int from = column(r) - 1, negative = take(r, "-");
        tree *arg[2] = {t, parse_operand(r)};

        if (negative)
            arg[1] = meaning_of_operator(r->f, "neg", from, arg[1], NULL);
        t = meaning_of_call(r->f, "pow", from, arg, 2);
    }
    return t;
}

static tree *parse_product(reader *r)
{
    tree *t = parse_power(r);

    for (;;) {
        int from, times;

        skip_blanks(r);
        from = column(r);
        times = take(r, "*");
        if (!times && !take(r, "/"))
            return t;
        t = meaning_of_operator(r->f, times ? "*" : "/", from, t, parse_power(r));
    }
}

static tree *parse_sum(reader *r)
{
    int from, plus;
    tree *t;

    skip_blanks(r);
    from = column(r);
    t = take(r, "-") ? meaning_of_operator(r->f, "neg", from, parse_product(r), NULL) : parse_product(r);
    for (;;) {
        skip_blanks(r);
        from = column(r);
        plus = take(r, "+");
        if (!plus && !take(r, "-"))
            return t;
        t = meaning_of_operator(r->f, plus ? "+" : "-", from, t, parse_product(r));
    }
}

/* name = sum ;   1 if there was one */
static int parse_part(reader *r)
{
    const char *before, *name;
    symbol *s;
    int from;

    skip_blanks(r);
    before = r->at;
    from = column(r);
    if (!isalpha((unsigned char)*r->at))
        return 0;
    name = take_name(r);
    if (!take(r, "=")) {
        r->at = before;
        return 0;
    }
    if (form_field(r->f, name) || form_named(r->f, name))
        form_fail(r->f, from, "\"%s\" has a meaning already; give the part another name", name);
    form_check_name(r->f, name, from);
    s = form_symbol(r->f, SYM_PART, name, 0);
    s->column = from;
    s->part = parse_sum(r);
    s->rank = s->part->rank;
    if (s->part->degree)
        form_fail(r->f, from, "a part has no test function");
    expect(r, ";", -1);
    return 1;
}

tree *parse_form(form *f)
{
    reader r = {.f = f, .at = f->request->form};
    tree *t;

    while (parse_part(&r))
        continue;
    t = parse_sum(&r);
    skip_blanks(&r);
    if (*r.at)
        form_fail(f, column(&r), "expected the end, or + or - and one more addend");
    for (int i = 0; i < f->n_symbol; i++)
        if (f->symbol[i]->kind == SYM_PART && !f->symbol[i]->is_used)
            form_fail(f, f->symbol[i]->column, "the part \"%s\" is not used; leave it out", f->symbol[i]->name);
    if (t->rank != 0)
        form_fail(f, 0, "the form is a %s; it must be a scalar: dot or inner with a test function",
                  t->rank == 1 ? "vector" : "tensor");
    if (t->degree != 1)
        form_fail(f, 0, "the form has no test function (v of u, q of p, s of T, test(c) of any field c)");
    return t;
}
