/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Fields, symbols, memory and failure of a form. */
#include "weak/form.h"

#include <ctype.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

void form_fail(form *f, int column, const char *fmt, ...)
{
    char why[1000];
    va_list ap;

    va_start(ap, fmt);
    vsnprintf(why, sizeof why, fmt, ap);
    va_end(ap);
    if (column < 0)
        error_set(f->err, ERR_USAGE, "%s%s", strncmp(why, "--", 2) == 0 ? "" : "--weak: ", why);
    else
        error_set(f->err, ERR_USAGE, "--weak, column %d: %s\n  %s\n  %*s^", column + 1, why, f->request->form,
                  column, "");
    longjmp(f->failed, 1);
}

void *form_room(form *f, size_t count, size_t size)
{
    void *room = arena_alloc(&f->memory, count, size);

    if (!room) {
        error_memory(f->err, "the weak form", (double)(count * size));
        longjmp(f->failed, 1);
    }
    return room;
}

const char *form_text(form *f, const char *fmt, ...)
{
    char s[400];
    va_list ap;

    va_start(ap, fmt);
    vsnprintf(s, sizeof s, fmt, ap);
    va_end(ap);
    return strcpy(form_room(f, strlen(s) + 1, 1), s);
}

void form_check_name(form *f, const char *name, int column)
{
    static const char *const taken[] = {"auto",      "break",     "case",
                                        "char",      "const",     "continue",
                                        "default",   "do",        "double",
                                        "else",      "enum",      "extern",
                                        "float",     "for",       "goto",
                                        "if",        "inline",    "int",
                                        "long",      "register",  "return",
                                        "short",     "signed",    "sizeof",
                                        "static",    "struct",    "switch",
                                        "typedef",   "union",     "void",
                                        "while",     "restrict",  "unsigned",
                                        "volatile",  "complex",   "asm",
                                        "typeof",    "unix",      "linux",
                                        "sqrt",      "exp",       "log",
                                        "sin",       "cos",       "tan",
                                        "tanh",      "atan",      "abs",
                                        "fabs",      "pow",       "max",
                                        "min",       "creal",     "cimag",
                                        "grad",      "div",       "dt",
                                        "old",       "lap",       "test",
                                        "dot",       "inner",     "outer",
                                        "cross",     "trace",     "sym",
                                        "vector",    "data",      "property",
                                        "transpose", "i",         "b",
                                        "in",        "out",       "jac",
                                        "NUM",       "F",         "LD",
                                        "DIM",       "KEYS",      "DENSITY",
                                        "NULL",      "NAN",       "EOF",
                                        "GRAVITY",   "VISCOSITY", "INFINITY",
                                        "HUGE_VAL",  "M_PI",      "stdin",
                                        "stdout",    "stderr",    "REDUCED_PRESSURE",
                                        "uint32_t"};

    for (size_t k = 0; k < sizeof taken / sizeof *taken; k++)
        if (strcmp(taken[k], name) == 0)
            form_fail(f, column,
                      "\"%s\" is not possible as a name: C, the generated code or a function of forms has it "
                      "already; choose another one",
                      name);
    if (strncmp(name, "pf_", 3) == 0 || strncmp(name, "PF_", 3) == 0)
        form_fail(f, column, "\"%s\" is not possible as a name: pf_ and PF_ belong to plugflow", name);
}

static const weak_field standard[] = {{"u", "v", 1, 0, "mesh"},          {"p", "q", 0, 0, "mesh"},
                                      {"T", "s", 0, 0, "mesh"},          {"c", "test_c", 0, 0, "mesh"},
                                      {"phi", "test_phi", 0, 0, "mesh"}, {"U", "V", 1, 0, "particle"},
                                      {"lambda", "eta", 1, 0, "mesh"}};
enum { N_STANDARD = sizeof standard / sizeof *standard };

/* One of --fields: "tau:vector:2", or the name of a standard one. */
static void add_field(form *f, const char *s, int n)
{
    char name[40] = "", shape[40] = "";
    int order = 2, used = 0, is_vector;

    if (n >= 80 || sscanf(s, "%39[A-Za-z0-9_]%n", name, &used) != 1)
        form_fail(f, -1, "--fields \"%.*s\": expected name, or name:scalar|vector:order", n, s);
    if (used == n && form_field(f, name))
        return;
    if (used == n)
        form_fail(
            f, -1,
            "--fields: \"%s\" is not one of the standard fields u, p, T, c, phi, U, lambda; a new one is declared "
            "with its shape and order, as in %s:scalar:2",
            name, name);
    if (!isalpha((unsigned char)*name) || sscanf(s + used, ":%39[a-z]:%d", shape, &order) < 1 || order < 1 ||
        order > 2 || (strcmp(shape, "vector") != 0 && strcmp(shape, "scalar") != 0))
        form_fail(f, -1, "--fields \"%.*s\": expected name:scalar|vector:order with order 1 or 2", n, s);
    if (form_field(f, name))
        form_fail(f, -1, "--fields: \"%s\" is a standard field; leave its shape out", name);
    form_check_name(f, name, -1);
    if (f->n_field == WEAK_MAX_FIELDS)
        form_fail(f, -1, "more than %d fields", WEAK_MAX_FIELDS);
    is_vector = strcmp(shape, "vector") == 0;
    f->field[f->n_field++] =
        (weak_field){form_text(f, "%s", name), form_text(f, "test_%s", name), is_vector, order, "mesh"};
}

void form_fields(form *f)
{
    memcpy(f->field, standard, sizeof standard);
    f->n_field = N_STANDARD;
    for (const char *s = f->request->new_fields; s && *s;) {
        const int n = (int)strcspn(s, ",");

        add_field(f, s, n);
        s += n + (s[n] == ',');
    }
}

const weak_field *form_field(const form *f, const char *name)
{
    for (int i = 0; i < f->n_field; i++)
        if (strcmp(f->field[i].name, name) == 0)
            return &f->field[i];
    return NULL;
}

symbol *form_named(const form *f, const char *name)
{
    for (int i = 0; i < f->n_symbol; i++)
        if (strcmp(f->symbol[i]->name, name) == 0)
            return f->symbol[i];
    return NULL;
}

symbol *form_symbol(form *f, enum symbol_kind kind, const char *name, int rank)
{
    symbol *s = form_named(f, name);

    if (s && s->kind != kind)
        form_fail(f, -1, "\"%s\" is the name of two things; call one of them otherwise", name);
    if (s)
        return s;
    if (f->n_symbol == FORM_MAX_SYMBOLS)
        form_fail(f, -1, "more than %d names", FORM_MAX_SYMBOLS);
    s = form_room(f, 1, sizeof *s);
    *s = (symbol){.kind = kind, .name = form_text(f, "%s", name), .rank = rank};
    return f->symbol[f->n_symbol++] = s;
}
