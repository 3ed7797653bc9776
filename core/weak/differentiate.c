/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Derivatives of expressions with respect to a component of a slot: d u_k / d u_a = delta_ka. */
#include "weak/form.h"

#include <string.h>

static const expr *call(form *f, const char *name, const expr *x)
{
    return index_call(f, name, NULL, x, NULL);
}

/* f'(x) of a function of one argument; e is f(x). */
static const expr *slope(form *f, const expr *e)
{
    const expr *x = e->arg[0], *one = index_number(f, 1), *minus = index_number(f, -1);

    if (strcmp(e->call, "sqrt") == 0)
        return index_div(f, index_number(f, 0.5), e);
    if (strcmp(e->call, "exp") == 0)
        return e;
    if (strcmp(e->call, "log") == 0)
        return index_div(f, one, x);
    if (strcmp(e->call, "sin") == 0)
        return call(f, "cos", x);
    if (strcmp(e->call, "cos") == 0)
        return index_mul(f, minus, call(f, "sin", x));
    if (strcmp(e->call, "tanh") == 0)
        return index_add(f, one, index_mul(f, minus, index_mul(f, e, e)));
    return index_select(f, x, index_number(f, 0), minus, one); /* fabs */
}

/* d x^y = y x^(y-1) dx + x^y log(x) dy */
static const expr *power(form *f, const expr *e, const expr *dx, const expr *dy)
{
    const expr *x = e->arg[0], *y = e->arg[1];
    const expr *lower = index_call(f, "pow", NULL, x, index_add(f, y, index_number(f, -1)));
    const expr *d = index_mul(f, index_mul(f, y, lower), dx);

    if (index_is_number(dy, 0))
        return d;
    return index_add(f, d, index_mul(f, index_mul(f, e, call(f, "log", x)), dy));
}

static const expr *of_call(form *f, const expr *e, const symbol *s, int i, int j)
{
    const expr *dx = differentiate(f, e->arg[0], s, i, j);
    const expr *dy = e->n > 1 ? differentiate(f, e->arg[1], s, i, j) : NULL;

    if (!*e->call) /* a part */
        return dx;
    if (index_is_number(dx, 0) && (!dy || index_is_number(dy, 0)))
        return dx;
    if (strcmp(e->call, "pow") == 0)
        return power(f, e, dx, dy);
    if (strcmp(e->call, "max") == 0)
        return index_select(f, e->arg[0], e->arg[1], dy, dx);
    if (strcmp(e->call, "min") == 0)
        return index_select(f, e->arg[1], e->arg[0], dy, dx);
    return index_mul(f, slope(f, e), dx);
}

static const expr *of_product(form *f, const expr *e, const symbol *s, int i, int j)
{
    const expr *total = index_number(f, 0);

    for (int k = 0; k < e->n; k++) {
        const expr *d = differentiate(f, e->arg[k], s, i, j);

        for (int l = 0; l < e->n; l++)
            if (l != k)
                d = l < k ? index_mul(f, e->arg[l], d) : index_mul(f, d, e->arg[l]);
        total = index_add(f, total, d);
    }
    return total;
}

const expr *differentiate(form *f, const expr *e, const symbol *s, int i, int j)
{
    const expr *zero = index_number(f, 0), *total = zero, *x, *dx;

    switch (e->kind) {
    case X_SYMBOL:
        if (e->symbol != s)
            return zero;
        total = index_number(f, 1);
        if (s->rank > 0)
            total = index_mul(f, total, index_delta(f, e->index[0], i));
        if (s->rank > 1)
            total = index_mul(f, total, index_delta(f, e->index[1], j));
        return total;
    case X_ADD:
        for (int k = 0; k < e->n; k++)
            total = index_add(f, total, differentiate(f, e->arg[k], s, i, j));
        return total;
    case X_MUL:
        return of_product(f, e, s, i, j);
    case X_DIV:
        x = index_div(f, differentiate(f, e->arg[0], s, i, j), e->arg[1]);
        dx = differentiate(f, e->arg[1], s, i, j);
        if (index_is_number(dx, 0))
            return x;
        return index_add(f, x, index_mul(f, index_mul(f, index_number(f, -1), dx), index_div(f, e, e->arg[1])));
    case X_SUM:
        return index_sum(f, e->index[0], differentiate(f, e->arg[0], s, i, j));
    case X_SELECT:
        return index_select(f, e->arg[0], e->arg[1], differentiate(f, e->arg[2], s, i, j),
                            differentiate(f, e->arg[3], s, i, j));
    case X_CALL:
        return of_call(f, e, s, i, j);
    case X_NUMBER:
    case X_DELTA:
        break;
    }
    return zero;
}
