/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Parameters and inputs: random, all different, in their ranges, the same in every run. */
#include "term/bench.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Draws with random parameters besides the defaults, at least; and at most, however many branches there are. */
enum { DRAWS = 4, MOST_DRAWS = 16, TRIES = 20 };
/* A range beyond this is none that numbers are drawn from. */
#define WIDE 1e6

int bench_has_range(const bench *k)
{
    for (uint32_t i = 0; i < k->t->n_in; i++)
        if (k->t->in[i].min < k->t->in[i].max)
            return 1;
    return 0;
}

/* A number in [low, high], which may be as good as open. */
static double within(bench *k, double low, double high)
{
    if (low > -WIDE && high < WIDE)
        return bench_number(k, low + 1e-3 * (high - low), high - 1e-3 * (high - low));
    if (low > -WIDE)
        return low + bench_number(k, 0.3, 2.5) * fmax(1, fabs(low));
    if (high < WIDE)
        return high - bench_number(k, 0.3, 2.5) * fmax(1, fabs(high));
    return bench_number(k, -1, 1);
}

/* Scalars that are no gradients are positive, as temperatures and viscosities are. */
static void random_inputs(bench *k, int all)
{
    for (uint32_t i = 0; i < k->t->n_in; i++) {
        const pf_slot *s = &k->t->in[i];

        for (int c = 0; (all || term_is_unknown(s)) && c < bench_components(k, s); c++) {
            for (int l = 0; l < BENCH_N; l++)
                k->in[i][c * BENCH_LD + l] = s->min < s->max         ? within(k, s->min, s->max)
                                             : s->shape == PF_SCALAR ? bench_number(k, 0.5, 2.5)
                                                                     : bench_number(k, -1, 1);
            bench_repeat(k->in[i] + c * BENCH_LD);
        }
    }
}

void bench_random_inputs(bench *k)
{
    random_inputs(k, 1);
}

void bench_random_state(bench *k)
{
    random_inputs(k, 0);
}

/* A state that a field has now and then whatever it is: zero, or a number below. */
void bench_put_state(bench *k, int negative)
{
    for (uint32_t i = 0; i < k->t->n_in; i++) {
        const pf_slot *s = &k->t->in[i];
        const int ranged = s->min < s->max, changes = negative ? s->shape == PF_SCALAR : 1;

        if (!(term_slot_field(s) || s->eval == PF_STATE) || !changes || (ranged && s->min >= 0) ||
            (ranged && !negative && s->max <= 0))
            continue;
        for (int j = 0; j < bench_components(k, s) * BENCH_LD; j++)
            if (j % BENCH_LD < BENCH_N)
                k->in[i][j] = !negative ? 0
                              : ranged  ? within(k, s->min, fmin(s->max, 0))
                                        : -bench_number(k, 0.5, 2.5);
        for (int c = 0; c < bench_components(k, s); c++)
            bench_repeat(k->in[i] + c * BENCH_LD);
    }
}

void bench_put_param(bench *k, const pf_param *p, const double *v)
{
    char *at = (char *)k->params + p->offset;
    int whole = (int)*v;

    if (p->type == PF_T_REAL || p->type == PF_T_VECTOR)
        memcpy(at, v, (size_t)(p->type == PF_T_REAL ? 1 : k->dim) * sizeof *v);
    else
        memcpy(at, &whole, sizeof whole);
}

/* Defaults; what is required or zero gets a number inside its range, all different. */
static void default_params(bench *k)
{
    term_defaults(k->t, k->params);
    for (uint32_t i = 0; i < k->t->n_param; i++) {
        const pf_param *p = &k->t->param[i];
        double v = 1.25 + 0.5 * i, vec[3] = {0.3, -0.7, 0.9};

        if (p->min < p->max)
            v = v < p->min ? p->min : v > p->max ? 0.5 * (fmax(p->min, -1e6) + p->max) : v;
        if (p->type == PF_T_INT && p->min < p->max)
            v = v < p->max ? ceil(v) : p->max;
        if (p->type == PF_T_VECTOR)
            bench_put_param(k, p, vec);
        else if ((p->type == PF_T_REAL && p->dflt == 0) || (p->type <= PF_T_INT && (p->flags & PF_REQUIRED)))
            bench_put_param(k, p, &v);
    }
}

static int branches(const pf_param *p)
{
    int n = 0;

    if (p->type == PF_T_BOOL)
        return 2;
    while (p->type == PF_T_CHOICE && p->choice[n])
        n++;
    return n ? n : 1;
}

/* All combinations of branches, if they are not too many. */
int bench_draws(const bench *k)
{
    int n = 1;

    for (uint32_t i = 0; i < k->t->n_param && n < MOST_DRAWS; i++)
        n *= branches(&k->t->param[i]);
    n = n > MOST_DRAWS ? MOST_DRAWS : n;
    return !k->t->n_param ? 1 : n > DRAWS ? n + 1 : DRAWS + 1;
}

/* A number near the default where there is one, else anywhere in the range. */
static double random_param(bench *k, const pf_param *p)
{
    const int ranged = p->min < p->max, whole = p->type == PF_T_INT;
    double low = ranged ? p->min : -INFINITY, high = ranged ? p->max : INFINITY, v;

    if (whole) {
        low = fmax(low, fmin(p->dflt, high) - 3), high = fmin(high, fmax(p->dflt, low) + 3);
        return fmin(floor(bench_number(k, low, high + 1)), high);
    }
    if (p->type == PF_T_REAL && p->dflt != 0 &&
        !(ranged && low > -WIDE && high < WIDE && high < 100 * fabs(p->dflt)))
        v = p->dflt * exp(bench_number(k, -1.1, 1.1));
    else if (ranged)
        v = within(k, low, high);
    else
        v = bench_number(k, 0.3, 2.5);
    return fmin(fmax(v, low), high);
}

/* Branch of parameter i in a draw: all combinations one after the other, from that of the defaults on; where there
 * are more than draws, every branch of each at least. */
static int branch(const bench *k, uint32_t i, int draw)
{
    const pf_param *p = &k->t->param[i];
    int stride = 1, first = p->dflt >= 0 && p->dflt < branches(p) ? (int)p->dflt : 0;

    for (uint32_t j = 0; j < i; j++)
        stride *= stride < MOST_DRAWS ? branches(&k->t->param[j]) : 1;
    return (first + (stride < MOST_DRAWS ? draw / stride : draw + draw / branches(p) * (int)i)) % branches(p);
}

/* Another number of this parameter alone: random, an end of its range, or a large one. */
void bench_put_other(bench *k, const pf_param *p, int n)
{
    double v[3] = {random_param(k, p), bench_number(k, -1, 1), bench_number(k, -1, 1)};

    if (p->type == PF_T_BOOL || p->type == PF_T_CHOICE)
        *v = n % branches(p);
    else if (p->min < p->max && n < 2 && fabs(n ? p->max : p->min) < WIDE)
        *v = n ? p->max : p->min;
    else if (!(p->min < p->max) && n == 0)
        *v *= 1e4;
    else if (!(p->min < p->max) && n == 1)
        *v = 1e-9;
    bench_put_param(k, p, v);
}

static void say_param(bench *k, const pf_param *p, const double *v)
{
    size_t n = strlen(k->drawn);

    if (p->type == PF_T_CHOICE)
        snprintf(k->drawn + n, sizeof k->drawn - n, "%s%s = \"%s\"", n ? ", " : " -- with ", p->name,
                 p->choice[(int)*v]);
    else
        snprintf(k->drawn + n, sizeof k->drawn - n, "%s%s = %.4g", n ? ", " : " -- with ", p->name, *v);
}

static void draw_params(bench *k, int draw)
{
    *k->drawn = 0;
    for (uint32_t i = 0; i < k->t->n_param; i++) {
        const pf_param *p = &k->t->param[i];
        double v[3] = {random_param(k, p), bench_number(k, -1, 1), bench_number(k, -1, 1)};

        if (p->type == PF_T_BOOL || p->type == PF_T_CHOICE)
            *v = branch(k, i, draw);
        bench_put_param(k, p, v);
        say_param(k, p, v);
    }
}

int bench_params(bench *k, int draw)
{
    char why[200];

    k->draw = draw;
    *k->drawn = 0;
    if (draw == 0) {
        default_params(k);
        return 1;
    }
    for (int i = 0; i < TRIES; i++) {
        draw_params(k, draw);
        if (!k->t->check || k->t->check(k->params, why, sizeof why) == 0)
            return 1;
    }
    return 0;
}
