/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Expressions in components, sum_k u_k grad_u_ak, kept simple as they are made: zeros and ones vanish, factors that
 * do not depend on the index of a sum stand before it, and a sum over a delta is no sum. */
#include "weak/form.h"

#include <math.h>
#include <string.h>

int index_new(form *f)
{
    return 3 * f->n_index++;
}

static expr *make(form *f, enum expr_kind kind, int n)
{
    expr *e = form_room(f, 1, sizeof *e);

    e->kind = kind;
    e->n = n;
    e->index[0] = e->index[1] = -1;
    e->arg = form_room(f, n ? (size_t)n : 1, sizeof *e->arg);
    return e;
}

const expr *index_number(form *f, double v)
{
    if (!isfinite(v))
        form_fail(f, -1, "a number that the form makes is not finite; write it out");
    expr *e = make(f, X_NUMBER, 0);

    e->number = v;
    return e;
}

const expr *index_symbol(form *f, const symbol *s, int i, int j)
{
    expr *e = make(f, X_SYMBOL, 0);

    e->symbol = s;
    e->index[0] = s->rank > 0 ? i : -1;
    e->index[1] = s->rank > 1 ? j : -1;
    return e;
}

const expr *index_delta(form *f, int i, int j)
{
    expr *e;

    if (i / 3 == j / 3)
        return index_number(f, i == j);
    e = make(f, X_DELTA, 0);
    e->index[0] = i;
    e->index[1] = j;
    return e;
}

int index_is_number(const expr *e, double v)
{
    return e->kind == X_NUMBER && e->number == v;
}

int index_same(const expr *x, const expr *y)
{
    if (x->kind != y->kind || x->n != y->n || x->symbol != y->symbol || x->number != y->number ||
        x->index[0] != y->index[0] || x->index[1] != y->index[1] ||
        (x->kind == X_CALL && strcmp(x->call, y->call) != 0))
        return 0;
    for (int i = 0; i < x->n; i++)
        if (!index_same(x->arg[i], y->arg[i]))
            return 0;
    return 1;
}

int index_in(const expr *e, int id)
{
    for (int k = 0; k < 2; k++)
        if (e->index[k] >= 0 && e->index[k] / 3 == id / 3)
            return 1;
    for (int i = 0; i < e->n; i++)
        if (index_in(e->arg[i], id))
            return 1;
    return 0;
}

int index_has_delta(const expr *e, int id)
{
    if (e->kind == X_DELTA)
        return id < 0 || index_in(e, id);
    for (int i = 0; i < e->n && e->kind != X_CALL; i++)
        if (index_has_delta(e->arg[i], id))
            return 1;
    return 0;
}

/* e = number * what. */
static double split(form *f, const expr *e, const expr **what)
{
    expr *product;

    *what = e;
    if (e->kind != X_MUL || e->arg[0]->kind != X_NUMBER)
        return 1;
    product = make(f, X_MUL, e->n - 1);
    memcpy(product->arg, e->arg + 1, (size_t)(e->n - 1) * sizeof *e->arg);
    *what = e->n == 2 ? e->arg[1] : product;
    return e->arg[0]->number;
}

/* Addends of one kind in one; a number that all have stands before the sum. */
static const expr *tidy_sum(form *f, expr *e)
{
    double *number = form_room(f, (size_t)e->n, sizeof *number), common;
    int n = 0;

    for (int i = 0; i < e->n; i++) {
        const expr *what;
        const double v = split(f, e->arg[i], &what);
        int k = 0;

        while (k < n && !index_same(e->arg[k], what))
            k++;
        e->arg[k] = what;
        number[k] = k < n ? number[k] + v : v;
        n += k == n;
    }
    e->n = 0;
    for (int k = 0; k < n; k++)
        if (number[k] != 0) {
            number[e->n] = number[k];
            e->arg[e->n++] = e->arg[k];
        }
    common = e->n ? number[0] : 1;
    for (int k = 0; k < e->n; k++)
        if (number[k] != number[0] || e->arg[k]->kind == X_NUMBER)
            common = 1;
    for (int k = 0; k < e->n; k++)
        e->arg[k] = index_mul(f, index_number(f, number[k] / common), e->arg[k]);
    if (e->n < 2)
        return e->n ? index_mul(f, index_number(f, common), e->arg[0]) : index_number(f, 0);
    return index_mul(f, index_number(f, common), e);
}

/* The addends or factors of x and y in one list; numbers are put together, in front of factors, behind addends. */
static const expr *join(form *f, enum expr_kind kind, const expr *x, const expr *y)
{
    const expr *part[2] = {x, y};
    const int is_sum = kind == X_ADD;
    double number = is_sum ? 0 : 1;
    int n = !is_sum;
    expr *e = make(f, kind, (x->kind == kind ? x->n : 1) + (y->kind == kind ? y->n : 1) + 2);

    for (int p = 0; p < 2; p++)
        for (int i = 0; i < (part[p]->kind == kind ? part[p]->n : 1); i++) {
            const expr *a = part[p]->kind == kind ? part[p]->arg[i] : part[p];

            if (a->kind != X_NUMBER)
                e->arg[n++] = a;
            else
                number = is_sum ? number + a->number : number * a->number;
        }
    if (!is_sum && number == 0)
        return index_number(f, 0);
    if (!is_sum)
        e->arg[0] = index_number(f, number);
    else if (number != 0 || n == 0)
        e->arg[n++] = index_number(f, number);
    e->n = n;
    if (!is_sum && number == 1 && n > 1) {
        e->arg++;
        e->n--;
    }
    if (e->n == 1)
        return e->arg[0];
    return is_sum ? tidy_sum(f, e) : e;
}

const expr *index_add(form *f, const expr *x, const expr *y)
{
    if (index_is_number(x, 0))
        return y;
    if (index_is_number(y, 0))
        return x;
    return join(f, X_ADD, x, y);
}

const expr *index_mul(form *f, const expr *x, const expr *y)
{
    if (index_is_number(x, 1))
        return y;
    if (index_is_number(y, 1))
        return x;
    return join(f, X_MUL, x, y);
}

const expr *index_div(form *f, const expr *x, const expr *y)
{
    int exponent;
    expr *e;

    if (index_is_number(x, 0) || index_is_number(y, 1))
        return x;
    if (y->kind == X_NUMBER && x->kind == X_NUMBER)
        return index_number(f, x->number / y->number);
    if (y->kind == X_NUMBER && frexp(y->number, &exponent) == 0.5)
        return index_mul(f, index_number(f, 1 / y->number), x);
    e = make(f, X_DIV, 2);
    e->arg[0] = x;
    e->arg[1] = y;
    return e;
}

const expr *index_call(form *f, const char *name, const symbol *part, const expr *x, const expr *y)
{
    expr *e = make(f, X_CALL, y ? 2 : 1);

    if (strcmp(name, "pow") == 0 && y->kind == X_NUMBER) {
        if (y->number == 0 || y->number == 1)
            return y->number == 0 ? index_number(f, 1) : x;
        if (y->number == 2 && (x->kind == X_SYMBOL || x->kind == X_NUMBER))
            return index_mul(f, x, x);
        if (y->number == 0.5)
            return index_call(f, "sqrt", NULL, x, NULL);
    }
    e->call = name;
    e->symbol = part;
    e->arg[0] = x;
    if (y)
        e->arg[1] = y;
    return e;
}

const expr *index_select(form *f, const expr *x, const expr *y, const expr *p, const expr *q)
{
    expr *e = make(f, X_SELECT, 4);

    if (index_same(p, q))
        return p;
    e->arg[0] = x;
    e->arg[1] = y;
    e->arg[2] = p;
    e->arg[3] = q;
    return e;
}

/* Index id, as it stands, becomes `by`; where it is shifted, so is that. */
int index_moved(int index, int id, int by)
{
    if (index < 0 || index / 3 != id / 3)
        return index;
    return 3 * (by / 3) + (by % 3 + index % 3 - id % 3 + 3) % 3;
}

const expr *index_replace(form *f, const expr *e, int id, int by)
{
    expr *to;

    if (!index_in(e, id))
        return e;
    if (e->kind == X_DELTA)
        return index_delta(f, index_moved(e->index[0], id, by), index_moved(e->index[1], id, by));
    to = make(f, e->kind, e->n);
    to->number = e->number;
    to->symbol = e->symbol;
    to->call = e->call;
    for (int k = 0; k < 2; k++)
        to->index[k] = index_moved(e->index[k], id, by);
    for (int i = 0; i < e->n; i++)
        to->arg[i] = index_replace(f, e->arg[i], id, by);
    return to;
}

/* The product of all arguments of e but one. */
static const expr *rest(form *f, const expr *e, int without)
{
    const expr *product = index_number(f, 1);

    for (int i = 0; i < e->n; i++)
        if (i != without)
            product = index_mul(f, product, e->arg[i]);
    return product;
}

static const expr *sum_of_addends(form *f, int i, const expr *sum, const expr *factor)
{
    const expr *total = index_number(f, 0);

    for (int k = 0; k < sum->n; k++)
        total = index_add(f, total, index_sum(f, i, index_mul(f, factor, sum->arg[k])));
    return total;
}

/* sum_i factor sum_k body = sum_k sum_i factor body; k gets a new name, as the factor may have it. */
static const expr *sum_inside(form *f, int i, const expr *sum, const expr *factor)
{
    const int k = index_new(f);

    return index_sum(f, k, index_sum(f, i, index_mul(f, factor, index_replace(f, sum->arg[0], sum->index[0], k))));
}

/* sum_i of a product. */
static const expr *sum_of_product(form *f, int i, const expr *body)
{
    const expr *before = index_number(f, 1), *in = before;
    expr *e;

    for (int k = 0; k < body->n; k++) {
        const expr *a = body->arg[k];

        if (a->kind == X_DELTA && index_in(a, i)) {
            const int is_first = a->index[0] / 3 == i / 3, own = a->index[!is_first], other = a->index[is_first];

            return index_replace(f, rest(f, body, k), own, other);
        }
    }
    for (int k = 0; k < body->n; k++)
        if (index_in(body->arg[k], i))
            in = index_mul(f, in, body->arg[k]);
        else
            before = index_mul(f, before, body->arg[k]);
    if (!index_is_number(before, 1))
        return index_mul(f, before, index_sum(f, i, in));
    for (int k = 0; k < body->n; k++) {
        const expr *a = body->arg[k];

        if (a->kind == X_ADD && index_has_delta(a, i))
            return sum_of_addends(f, i, a, rest(f, body, k));
        if (a->kind == X_SUM && index_has_delta(a, i))
            return sum_inside(f, i, a, rest(f, body, k));
    }
    e = make(f, X_SUM, 1);
    e->index[0] = i;
    e->arg[0] = body;
    return e;
}

const expr *index_sum(form *f, int i, const expr *body)
{
    static const symbol dim = {.kind = SYM_POINT, .name = "(double)DIM"};
    expr *e;

    if (!index_in(body, i))
        return index_mul(f, body, index_symbol(f, &dim, -1, -1));
    if (body->kind == X_DELTA)
        return index_number(f, 1);
    if (body->kind == X_ADD)
        return sum_of_addends(f, i, body, index_number(f, 1));
    if (body->kind == X_MUL)
        return sum_of_product(f, i, body);
    if (body->kind == X_SUM && index_has_delta(body, i))
        return index_sum(f, body->index[0], index_sum(f, i, body->arg[0]));
    if (body->kind == X_DIV && !index_in(body->arg[1], i))
        return index_div(f, index_sum(f, i, body->arg[0]), body->arg[1]);
    e = make(f, X_SUM, 1);
    e->index[0] = i;
    e->arg[0] = body;
    return e;
}

/* x + y, as it is: what is common stays with each. */
static const expr *append(form *f, const expr *x, const expr *y)
{
    expr *e = make(f, X_ADD, 0);

    if (index_is_number(x, 0))
        return y;
    e->arg = form_room(f, (size_t)((x->kind == X_ADD ? x->n : 1) + (y->kind == X_ADD ? y->n : 1)), sizeof *e->arg);
    for (int i = 0; i < (x->kind == X_ADD ? x->n : 1); i++)
        e->arg[e->n++] = x->kind == X_ADD ? x->arg[i] : x;
    for (int i = 0; i < (y->kind == X_ADD ? y->n : 1); i++)
        e->arg[e->n++] = y->kind == X_ADD ? y->arg[i] : y;
    return e;
}

const expr *index_spread(form *f, const expr *e)
{
    const expr *total = index_number(f, 0);

    if (!index_has_delta(e, -1))
        return e;
    if (e->kind == X_ADD)
        for (int i = 0; i < e->n; i++)
            total = append(f, total, index_spread(f, e->arg[i]));
    else if (e->kind == X_DIV && e->arg[0]->kind == X_ADD)
        for (int i = 0; i < e->arg[0]->n; i++)
            total = append(f, total, index_spread(f, index_div(f, e->arg[0]->arg[i], e->arg[1])));
    for (int k = 0; e->kind == X_MUL && k < e->n; k++) {
        const expr *a = index_has_delta(e->arg[k], -1) ? index_spread(f, e->arg[k]) : e->arg[k];

        if (a->kind != X_ADD || !index_has_delta(a, -1))
            continue;
        for (int i = 0; i < a->n; i++)
            total = append(f, total, index_spread(f, index_mul(f, rest(f, e, k), a->arg[i])));
        return total;
    }
    return index_is_number(total, 0) ? e : total;
}
