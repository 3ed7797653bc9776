/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Properties: a quantity m at a point that one term publishes and others take.  It is computed once a batch, before
 * the terms, with its derivatives by the unknowns x behind it, also by way of other properties n:
 *
 *     dm/dx = d m/d x + sum_n  d m/d n  dn/dx,        and of a term that takes it   D += d out/d m  dm/dx.
 *
 * Where nobody publishes it, it is a number of the term's own, which inputs.c spreads over the lanes. */
#include "base/process.h"
#include "base/text.h"
#include "assemble/batch.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* to[rows][cols] += a[rows][n] b[n][cols] at each lane. */
static void add_product(const double *restrict a, const double *restrict b, int rows, int n, int cols, size_t ld,
                        double *restrict to)
{
    for (int r = 0; r < rows; r++)
        for (int k = 0; k < n; k++)
            for (int c = 0; c < cols; c++)
                for (size_t i = 0; i < ld; i++)
                    to[(size_t)(r * cols + c) * ld + i] +=
                        a[(size_t)(r * n + k) * ld + i] * b[(size_t)(k * cols + c) * ld + i];
}

static double *chain_at(const assembly_class *c, const plan_chain *chain, const workspace *w)
{
    return (double *)(w->chain + chain->at * (size_t)c->n_q);
}

const double *properties_product(const assembly_class *c, const plan_chain *chain, const double *jac, int n_out,
                                 int dim, workspace *w)
{
    const int n = c->input[chain->property].n_comp, cols = term_components(chain->slot->shape, dim);
    const size_t ld = (size_t)c->n_q * PF_LANES;

    memset(w->product, 0, (size_t)(n_out * cols) * ld * sizeof(double));
    add_product(jac, chain_at(c, chain, w), n_out, n, cols, ld, (double *)w->product);
    return (const double *)w->product;
}

/* Whether a point counts: those that fill up a batch, or lie in bodies, have no weight. */
static int counts(const workspace *w, size_t lane)
{
    return ((const double *)w->w)[lane] != 0;
}

/* The same, and the term at hand acts there. */
static int acts(const workspace *w, size_t lane)
{
    return counts(w, lane) && (!w->masked || w->mask[lane]);
}

static int report(const pf_batch *b, const term_use *law, int status, const char *property, const char *is,
                  double v, size_t lane, const char *expected, workspace *w)
{
    const double x[3] = {b->x[lane], b->x[b->ld + lane], b->dim == 3 ? b->x[2 * b->ld + lane] : 0};

    w->report = (term_report){.plugin = law->plugin->d.name, .term = law->term->name, .status = status};
    snprintf(w->report.text, sizeof w->report.text, "term %s.%s: \"%s\" %s %g at x = %s, t = %.6g%s",
             w->report.plugin, w->report.term, property, is, v, text_point(x, (int)b->dim).s, b->t, expected);
    return status;
}

int properties_fit(const assembly_class *c, const plan_use *p, const pf_batch *b, workspace *w)
{
    const pf_term *t = p->use->term;

    for (uint32_t k = 0; k < t->n_in; k++) {
        const pf_slot *s = &t->in[k];
        const plan_input *in = &c->input[p->in[k]];
        const double *restrict v = (const double *)(w->in + in->at * (size_t)c->n_q);
        const size_t n = (size_t)in->n_comp * b->ld;
        int out = 0;

        if (!in->law || s->min >= s->max)
            continue;
        for (size_t i = 0; i < n; i++)
            out |= !(v[i] >= s->min && v[i] <= s->max);
        for (size_t i = 0; out && i < n; i++)
            if (!(v[i] >= s->min && v[i] <= s->max) && acts(w, i % b->ld)) {
                char expected[200];

                snprintf(expected, sizeof expected, "; %s.%s takes it from %g to %g", p->use->plugin->d.name,
                         t->name, s->min, s->max);
                return report(b, in->law, PF_RETRY, s->field, "is", v[i], i % b->ld, expected, w);
            }
    }
    return 0;
}

/* Whether a number of an output, or of its derivatives, is none. */
static int find_nan(const pf_batch *b, const term_use *law, const pf_slot *out, const double *v, size_t n,
                    const char *is, workspace *w)
{
    for (size_t i = 0; i < n; i++)
        if (!isfinite(v[i]) && counts(w, i % b->ld))
            return report(b, law, PF_FAIL, out->field, is, v[i], i % b->ld, "", w);
    return 0;
}

/* Derivatives of a law at the points, added to the chains of its outputs. */
static int add_chains(const assembly_class *c, const plan_law *l, int dim, int diagnose, const pf_batch *b,
                      const double *const *in, workspace *w)
{
    const pf_term *t = l->use->term;
    double *jac[TERM_MAX_SLOTS * TERM_MAX_SLOTS], *at = (double *)w->jac;
    const size_t ld = b->ld;

    for (uint32_t o = 0; o < t->n_out; o++)
        for (uint32_t k = 0; k < t->n_in; k++) {
            jac[o * t->n_in + k] = term_is_derived(&t->in[k]) ? at : NULL;
            at += (size_t)(term_components(t->out[o].shape, dim) * term_components(t->in[k].shape, dim)) * ld;
        }
    memset(w->jac, 0, (size_t)(at - (double *)w->jac) * sizeof(double));
    TRY(term_jacobian(t, l->use->how, b, in, jac, w->room));
    for (uint32_t o = 0; o < t->n_out; o++) {
        const int rows = c->input[l->out[o]].n_comp;

        for (uint32_t k = 0; k < t->n_in; k++) {
            const int n = term_components(t->in[k].shape, dim);

            if (!jac[o * t->n_in + k])
                continue;
            if (diagnose && find_nan(b, l->use, &t->out[o], jac[o * t->n_in + k], (size_t)(rows * n) * ld,
                                     "has a derivative that is", w))
                return PF_FAIL;
            for (int i = 0; i < c->n_chain; i++) {
                const plan_chain *to = &c->chain[i], *from;

                if (to->property != l->out[o])
                    continue;
                for (size_t j = 0; to->unknown == l->in[k] && j < (size_t)(rows * n) * ld; j++)
                    chain_at(c, to, w)[j] += jac[o * t->n_in + k][j];
                for (from = c->chain; from < to; from++)
                    if (from->property == l->in[k] && from->unknown == to->unknown)
                        add_product(jac[o * t->n_in + k], chain_at(c, from, w), rows, n,
                                    term_components(to->slot->shape, dim), ld, chain_at(c, to, w));
            }
        }
    }
    return 0;
}

static int evaluate_law(const assembly_class *c, const assembly_state *s, const plan_law *l, int64_t batch,
                        int with_matrix, int diagnose, pf_batch *b, workspace *w)
{
    const pf_term *t = l->use->term;
    const size_t nq = (size_t)c->n_q;
    const double *in[TERM_MAX_SLOTS];
    double *out[TERM_MAX_SLOTS];
    int status;

    for (uint32_t k = 0; k < t->n_in; k++)
        in[k] = (double *)(w->in + c->input[l->in[k]].at * nq);
    for (uint32_t o = 0; o < t->n_out; o++)
        out[o] = (double *)(w->in + c->input[l->out[o]].at * nq);
    b->params = l->use->params;
    b->metric = t->flags & PF_METRIC ? (double *)w->metric : NULL;
    b->wall_distance = t->flags & PF_WALL_DISTANCE ? (double *)(c->wall + batch * c->n_q) : NULL;
    w->report = (term_report){.plugin = l->use->plugin->d.name, .term = t->name};
    status = t->residual(b, in, out);
    if (!status && s->watch)
        s->watch->look(s->watch->ctx, l->use, b, in);
    for (uint32_t o = 0; o < t->n_out && !status && diagnose; o++)
        status = find_nan(b, l->use, &t->out[o], out[o], (size_t)c->input[l->out[o]].n_comp * b->ld, "is", w);
    if (!status && with_matrix)
        status = add_chains(c, l, (int)b->dim, diagnose, b, in, w);
    if (status && !w->report.status)
        snprintf(w->report.text, sizeof w->report.text, "term %s.%s returned %d without saying why",
                 w->report.plugin, w->report.term, status);
    if (status)
        w->report.status = status;
    return status;
}

int properties_evaluate(const assembly_class *c, const assembly_state *s, int64_t batch, int with_matrix,
                        int diagnose, pf_batch *b, workspace *w)
{
    if (with_matrix && c->n_law)
        memset(w->chain, 0, c->chain_size * (size_t)c->n_q * sizeof(v8));
    for (int i = 0; i < c->n_law; i++) {
        const plan_law *l = &c->law[i];
        int status;

        process_enter(l->use->plugin->d.name, l->use->term->name, "property", c->cell[c->batch[batch]]);
        status = evaluate_law(c, s, l, batch, with_matrix && c->chain_size, diagnose, b, w);
        process_leave();
        if (status)
            return status;
    }
    return 0;
}
