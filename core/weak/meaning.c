/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What names and functions of a form mean, and whether what they are given has the right rank. */
#include "weak/form.h"

#include "base/text.h"

#include <string.h>

static const char *rank_name(int rank)
{
    static const char *const name[] = {"scalar", "vector", "tensor"};

    return name[rank];
}

tree *tree_new(form *f, const char *op, int column, tree *a, tree *b)
{
    tree *t = form_room(f, 1, sizeof *t);

    *t = (tree){.op = op, .column = column, .arg = {a, b}, .rank = a ? a->rank : 0, .degree = a ? a->degree : 0};
    return t;
}

static tree *of_symbol(form *f, symbol *s, int column)
{
    tree *t = tree_new(f, "name", column, NULL, NULL);

    t->symbol = s;
    t->rank = s->rank;
    t->degree = s->kind == SYM_TEST;
    return t;
}

/* How term.h writes a slot: by its name if the field is a standard one. */
static const struct evaluation {
    const char *function, *entry, *prefix, *suffix;
    int rank, moves; /* rank beside that of the field */
} evaluations[] = {{"", "VALUE", "", "", 0, 1},       {"grad", "GRAD", "grad_", "", 1, 1},
                   {"div", "DIV", "div_", "", -1, 1}, {"dt", "DOT", "", "_t", 0, 1},
                   {"old", "OLD", "old_", "", 0, 0},  {"lap", "LAPLACE", "lap_", "", 0, 1}};

/* A slot.  Those of standard fields have names in term.h, but for few that hardly occur. */
static tree *of_slot(form *f, const weak_field *field, const char *function, int is_test, int column)
{
    const struct evaluation *e = evaluations;
    const char *of = is_test ? field->test : field->name, *name;
    symbol *s;

    while (strcmp(e->function, function) != 0)
        e++;
    if (is_test && e->rank == 0 && *function)
        form_fail(f, column, "%s(%s): of a test function there are value, grad and div", function, of);
    if (field->rank + e->rank < 0)
        form_fail(f, column, "%s(%s): %s is a %s; expected a vector", function, of, of, rank_name(field->rank));
    if (strcmp(field->on, "mesh") != 0 && e->rank)
        form_fail(f, column, "%s(%s): %s lives on bodies and has none", function, of, of);
    name = form_text(f, "%s%s%s", e->prefix, of, e->suffix);
    s = form_symbol(f, is_test ? SYM_TEST : SYM_SLOT, name, field->rank + e->rank);
    s->field = field;
    s->moves = e->moves;
    s->is_rate = strcmp(function, "dt") == 0;
    s->entry =
        is_test ? form_text(f, "%s%sTEST(%s, %s)", *function ? e->entry : "", *function ? "_" : "", field->name, of)
                : form_text(f, "%s(%s)", e->entry, field->name);
    if (field->order == 0 && strcmp(function, "lap") != 0 && strcmp(field->name, "lambda") != 0)
        s->entry = s->name;
    return of_symbol(f, s, column);
}

static const weak_field *field_of_test(const form *f, const char *test)
{
    for (int i = 0; i < f->n_field; i++)
        if (strcmp(f->field[i].test, test) == 0)
            return &f->field[i];
    return NULL;
}

/* Places and the like: what the batch has. */
static symbol *of_point(form *f, const char *name)
{
    static const struct {
        const char *name, *c;
        int rank;
    } point[] = {{"x", "b->x", 1},
                 {"normal", "b->normal", 1},
                 {"arm", "b->arm", 1},
                 {"h", "b->h[i]", 0},
                 {"t", "b->t", 0},
                 {"I", "I", 2},
                 {"pi", "3.14159265358979324", 0}};

    for (size_t i = 0; i < sizeof point / sizeof *point; i++)
        if (strcmp(name, point[i].name) == 0)
            return form_symbol(f, SYM_POINT, point[i].c, point[i].rank);
    return NULL;
}

/* A property is a slot; where nobody publishes it, it is the key of that name, which the term lists, too. */
static symbol *of_property(form *f, const char *slot, const char *entry, const char *key, const char *key_entry)
{
    symbol *s = form_symbol(f, SYM_SLOT, slot, 0), *number = form_symbol(f, SYM_REAL, key, 0);

    s->entry = entry;
    s->moves = s->is_property = 1;
    s->key = number;
    number->entry = key_entry;
    return s;
}

tree *meaning_of_name(form *f, const char *name, int column)
{
    const weak_field *field = form_field(f, name), *test = field_of_test(f, name);
    symbol *s = form_named(f, name);

    if (s && s->kind == SYM_PART)
        s->is_used = 1;
    if (s && (s->kind == SYM_PART || s->kind == SYM_VECTOR || (s->kind == SYM_SLOT && !s->field)))
        return of_symbol(f, s, column);
    if (field || test)
        return of_slot(f, field ? field : test, "", !field, column);
    if ((s = of_point(f, name)))
        return of_symbol(f, s, column);
    if (strcmp(name, "rho") == 0)
        return of_symbol(f, of_property(f, "rho", "rho", "density", "DENSITY"), column);
    if (strcmp(name, "mu") == 0)
        return of_symbol(f, of_property(f, "mu", "mu", "viscosity", "VISCOSITY"), column);
    if (strcmp(name, "density") == 0 || strcmp(name, "viscosity") == 0) {
        s = form_symbol(f, SYM_REAL, name, 0);
        s->entry = *name == 'd' ? "DENSITY" : "VISCOSITY";
        return of_symbol(f, s, column);
    }
    if (strcmp(name, "g") == 0 || strcmp(name, "gravity") == 0) {
        s = form_symbol(f, SYM_VECTOR, "gravity", 1);
        s->entry = "GRAVITY";
        return of_symbol(f, s, column);
    }
    form_check_name(f, name, column);
    s = form_symbol(f, SYM_REAL, name, 0);
    s->entry = form_text(f, "REAL(%s, \"1\", \"%s\", .flags = PF_REQUIRED)", name, name);
    return of_symbol(f, s, column);
}

static const symbol *test_in(const tree *t)
{
    const symbol *s = t->symbol && t->symbol->kind == SYM_TEST ? t->symbol : NULL;

    for (int i = 0; i < 2 && !s; i++)
        s = t->arg[i] ? test_in(t->arg[i]) : NULL;
    return s;
}

static void fail_two_tests(form *f, int column, const tree *a, const tree *b)
{
    const weak_field *x = test_in(a)->field, *y = test_in(b)->field;

    form_fail(f, column,
              "a product of two test functions, %s (of %s) and %s (of %s); if one is meant as a parameter, call it "
              "otherwise",
              x->test, x->name, y->test, y->name);
}

tree *meaning_of_operator(form *f, const char *op, int column, tree *a, tree *b)
{
    tree *t = tree_new(f, op, column, a, b);

    if (!b)
        return t;
    if (strchr("+-", *op)) {
        if (a->rank != b->rank)
            form_fail(f, column, "%s %s %s: expected two of one kind", rank_name(a->rank), op, rank_name(b->rank));
        if (a->degree != b->degree)
            form_fail(f, column, "one side of \"%s\" has a test function, the other has none", op);
        return t;
    }
    if (*op == '/') {
        if (b->rank)
            form_fail(f, column, "division by a %s: expected a scalar", rank_name(b->rank));
        if (b->degree)
            form_fail(f, column, "division by a test function");
        return t;
    }
    if (a->rank && b->rank)
        form_fail(f, column, "%s * %s: expected a scalar on one side; products of others are dot, inner and cross",
                  rank_name(a->rank), rank_name(b->rank));
    if (a->degree && b->degree)
        fail_two_tests(f, column, a, b);
    t->rank = a->rank + b->rank;
    t->degree = a->degree + b->degree;
    return t;
}

/* Functions of one or two arguments; ranks: what is expected, and what comes, -1: as the first argument. */
static const struct function {
    const char *name;
    int n, rank[2], result, linear;
    const char *expected;
} functions[] = {{"inner", 2, {2, 2}, 0, 1, "two tensors, or two vectors"},
                 {"cross", 2, {1, 1}, 1, 1, "two vectors (3D)"},
                 {"outer", 2, {1, 1}, 2, 1, "two vectors"},
                 {"transpose", 1, {2}, 2, 1, "a tensor"},
                 {"trace", 1, {2}, 0, 1, "a tensor"},
                 {"sym", 1, {2}, 2, 1, "a tensor"},
                 {"sqrt", 1, {0}, 0, 0, "a scalar"},
                 {"exp", 1, {0}, 0, 0, "a scalar"},
                 {"log", 1, {0}, 0, 0, "a scalar"},
                 {"sin", 1, {0}, 0, 0, "a scalar"},
                 {"cos", 1, {0}, 0, 0, "a scalar"},
                 {"tanh", 1, {0}, 0, 0, "a scalar"},
                 {"abs", 1, {0}, 0, 0, "a scalar"},
                 {"pow", 2, {0, 0}, 0, 0, "two scalars"},
                 {"max", 2, {0, 0}, 0, 0, "two scalars"},
                 {"min", 2, {0, 0}, 0, 0, "two scalars"}};

/* dot sums over the last index of the first and the first index of the second. */
static tree *of_dot(form *f, int column, tree *a, tree *b)
{
    tree *t = tree_new(f, "dot", column, a, b);

    if (a->rank < 1 || b->rank < 1)
        form_fail(f, column, "dot(%s, %s): expected vectors or tensors", rank_name(a->rank), rank_name(b->rank));
    t->rank = a->rank + b->rank - 2;
    t->degree = a->degree + b->degree;
    if (t->degree > 1)
        fail_two_tests(f, column, a, b);
    return t;
}

/* grad, div, dt, old, lap and test are of fields. */
static tree *of_field(form *f, const char *name, int column, const tree *a)
{
    const symbol *s = strcmp(a->op, "name") == 0 ? a->symbol : NULL;

    if (s && s->kind == SYM_REAL && !s->is_property)
        form_fail(f, column, "%s(%s): expected a field; declare it with --fields %s:scalar:2", name, s->name,
                  s->name);
    if (!s || !s->field || (strcmp(s->name, s->field->name) != 0 && strcmp(s->name, s->field->test) != 0))
        form_fail(f, column, "%s(...): expected a field%s", name,
                  strcmp(name, "test") == 0 ? "" : " or a test function; of other things write out what you mean");
    if (strcmp(name, "test") == 0)
        return of_slot(f, s->field, "", 1, column);
    return of_slot(f, s->field, name, s->kind == SYM_TEST, column);
}

/* vector(b): the parameter b is a vector; data(q), data(vector(f)): a value or function of the case;
 * property(k): a quantity that another term may publish. */
static tree *of_parameter(form *f, const char *function, int column, tree *a)
{
    symbol *s = strcmp(a->op, "name") == 0 ? a->symbol : NULL;
    const int is_vector = strcmp(function, "vector") == 0, is_data = strcmp(function, "data") == 0;
    const char *slot;

    if (s && s->field)
        form_fail(f, column, "%s(%s): %s is %s %s; give it another name", function, s->name, s->name,
                  s->kind == SYM_TEST ? "the test function of" : "the field", s->field->name);
    if (s && (s->is_property || (is_data && s->kind == SYM_SLOT)))
        return a;
    if (!s || (s->kind != SYM_REAL && s->kind != SYM_VECTOR) || (s->rank && !is_vector && !is_data))
        form_fail(f, column, "%s(...): expected a name that is no field%s", function,
                  is_data ? ", or vector(name)" : "");
    slot = form_text(f, "%s_here", s->name);
    if (!is_vector && !is_data)
        return of_symbol(
            f, of_property(f, slot, form_text(f, "PROPERTY_AS(%s, %s, \"1\")", slot, s->name), s->name, s->entry),
            column);
    if (is_vector && s->kind == SYM_REAL)
        s->entry = form_text(f, "VECTOR(%s, \"1\", \"%s\")", s->name, s->name);
    else if (is_data)
        s->entry = form_text(f, "DATA(%s, %s)", s->name, s->rank ? "VECTOR" : "SCALAR");
    s->kind = is_vector ? SYM_VECTOR : SYM_SLOT;
    s->rank = a->rank = is_vector ? 1 : s->rank;
    return a;
}

tree *meaning_of_call(form *f, const char *name, int column, tree **arg, int n)
{
    static const char *const of_fields[] = {"grad", "div", "dt", "old", "lap", "test"};
    const char *names[32];
    size_t n_name = 0;
    const struct function *g = functions, *end = functions + sizeof functions / sizeof *functions;
    tree *t;

    if (n == 1 && (strcmp(name, "vector") == 0 || strcmp(name, "data") == 0 || strcmp(name, "property") == 0))
        return of_parameter(f, name, column, arg[0]);
    if (strcmp(name, "dot") == 0 && n == 2)
        return of_dot(f, column, arg[0], arg[1]);
    for (size_t i = 0; i < sizeof of_fields / sizeof *of_fields; i++) {
        if (strcmp(name, of_fields[i]) == 0 && n == 1)
            return of_field(f, name, column, arg[0]);
        names[n_name++] = of_fields[i];
    }
    for (; g < end && strcmp(g->name, name) != 0; g++)
        names[n_name++] = g->name;
    names[n_name++] = "dot";
    if (g == end)
        form_fail(f, column, "there is no function \"%s\" of %d argument%s%s", name, n, n == 1 ? "" : "s",
                  text_hint(text_nearest(name, names, n_name)).s);
    if (n != g->n)
        form_fail(f, column, "%s has %d argument%s; expected %s", name, n, n == 1 ? "" : "s", g->expected);
    if (strcmp(name, "inner") == 0 && arg[0]->rank == 1 && arg[1]->rank == 1)
        return of_dot(f, column, arg[0], arg[1]);
    for (int i = 0; i < n; i++)
        if (arg[i]->rank != g->rank[i])
            form_fail(f, column, "%s(%s%s%s): expected %s", name, rank_name(arg[0]->rank), n > 1 ? ", " : "",
                      n > 1 ? rank_name(arg[1]->rank) : "", g->expected);
    t = tree_new(f, g->name, column, arg[0], n > 1 ? arg[1] : NULL);
    t->rank = g->result;
    t->degree = arg[0]->degree + (n > 1 ? arg[1]->degree : 0);
    if (t->degree > 1 && g->linear)
        fail_two_tests(f, column, arg[0], arg[1]);
    if (t->degree > g->linear)
        form_fail(f, column, "%s of a test function: the form is not linear in it", name);
    f->only_3d |= strcmp(name, "cross") == 0;
    return t;
}
