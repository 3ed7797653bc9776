/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * From the tree of a form to its components. */
#include "weak/form.h"

#include <math.h>
#include <string.h>

static const expr *lower_dot(form *f, const tree *t, int i, int j)
{
    const tree *a = t->arg[0], *b = t->arg[1];
    const int k = index_new(f);
    const expr *x = a->rank == 2 ? lower(f, a, i, k) : lower(f, a, k, -1);
    const expr *y = b->rank == 2 ? lower(f, b, k, a->rank == 2 ? j : i) : lower(f, b, k, -1);

    return index_sum(f, k, index_mul(f, x, y));
}

/* (a x b)_i = a_(i+1) b_(i+2) - a_(i+2) b_(i+1) */
static const expr *lower_cross(form *f, const tree *t, int i)
{
    const int p = 3 * (i / 3) + (i + 1) % 3, q = 3 * (i / 3) + (i + 2) % 3;

    return index_add(
        f, index_mul(f, lower(f, t->arg[0], p, -1), lower(f, t->arg[1], q, -1)),
        index_mul(f, index_number(f, -1), index_mul(f, lower(f, t->arg[0], q, -1), lower(f, t->arg[1], p, -1))));
}

static const expr *lower_tensor(form *f, const tree *t, int i, int j)
{
    const tree *a = t->arg[0];
    const int k = index_new(f);

    if (strcmp(t->op, "inner") == 0) {
        const int l = index_new(f);

        return index_sum(f, k, index_sum(f, l, index_mul(f, lower(f, a, k, l), lower(f, t->arg[1], k, l))));
    }
    if (strcmp(t->op, "outer") == 0)
        return index_mul(f, lower(f, a, i, -1), lower(f, t->arg[1], j, -1));
    if (strcmp(t->op, "transpose") == 0)
        return lower(f, a, j, i);
    if (strcmp(t->op, "sym") == 0)
        return index_mul(f, index_number(f, 0.5), index_add(f, lower(f, a, i, j), lower(f, a, j, i)));
    if (strcmp(t->op, "trace") == 0)
        return index_sum(f, k, lower(f, a, k, k));
    return NULL;
}

static const expr *lower_name(form *f, const tree *t, int i, int j)
{
    const symbol *s = t->symbol;

    if (s->kind == SYM_POINT && strcmp(s->name, "I") == 0)
        return index_delta(f, i, j);
    if (s->kind != SYM_PART)
        return index_symbol(f, s, i, j);
    if (s->rank)
        return lower(f, s->part, i, j);
    return index_call(f, "", s, lower(f, s->part, -1, -1), NULL);
}

static const expr *lower_quotient(form *f, const tree *t, int i, int j)
{
    const expr *below = lower(f, t->arg[1], -1, -1), *e;

    if (index_is_number(below, 0))
        form_fail(f, t->column, "division by zero");
    e = index_div(f, lower(f, t->arg[0], i, j), below);
    if (e->kind == X_NUMBER && !isfinite(e->number))
        form_fail(f, t->column, "the quotient is too large");
    return e;
}

const expr *lower(form *f, const tree *t, int i, int j)
{
    const tree *a = t->arg[0], *b = t->arg[1];
    const expr *minus = index_number(f, -1), *e;

    if (strcmp(t->op, "number") == 0)
        return index_number(f, t->number);
    if (strcmp(t->op, "name") == 0)
        return lower_name(f, t, i, j);
    if (strcmp(t->op, "neg") == 0)
        return index_mul(f, minus, lower(f, a, i, j));
    if (strcmp(t->op, "+") == 0)
        return index_add(f, lower(f, a, i, j), lower(f, b, i, j));
    if (strcmp(t->op, "-") == 0)
        return index_add(f, lower(f, a, i, j), index_mul(f, minus, lower(f, b, i, j)));
    if (strcmp(t->op, "*") == 0)
        return index_mul(f, lower(f, a, i, j), lower(f, b, i, j));
    if (strcmp(t->op, "/") == 0)
        return lower_quotient(f, t, i, j);
    if (strcmp(t->op, "dot") == 0)
        return lower_dot(f, t, i, j);
    if (strcmp(t->op, "cross") == 0)
        return lower_cross(f, t, i);
    if ((e = lower_tensor(f, t, i, j)))
        return e;
    return index_call(f, strcmp(t->op, "abs") == 0 ? "fabs" : t->op, NULL, lower(f, a, -1, -1),
                      b ? lower(f, b, -1, -1) : NULL);
}
