/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Terms at the points of a batch: their outputs are added up per test function, their
 * derivatives per pair of test and trial function. */
#include "base/process.h"
#include "base/text.h"
#include "assemble/batch.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Factor of a term: less than 1 while it is faded in. */
static double strength(const assembly_state *s, const plan_use *p)
{
    return p->use->term->flags & PF_CONTINUATION ? 1 - s->faded : 1;
}

static void add_output(const assembly_class *c, const plan_use *p, double factor, double *const *out, int dim,
                       workspace *w)
{
    const pf_term *t = p->use->term;
    size_t ld = (size_t)c->n_q * PF_LANES;

    for (uint32_t o = 0; o < t->n_out; o++) {
        double *restrict to = (double *)(w->test + c->test[p->out[o] < 0 ? 0 : p->out[o]].at * (size_t)c->n_q);
        const double *restrict from = out[o];
        int n = p->out[o] < 0 ? 0 : t->out[o].eval == PF_DIV ? dim : term_components(t->out[o].shape, dim);

        for (int k = 0; k < n; k++) { /* q div v is q I : grad v */
            double *restrict row = to + (size_t)(t->out[o].eval == PF_DIV ? k * dim + k : k) * ld;
            const double *restrict add = from + (size_t)(t->out[o].eval == PF_DIV ? 0 : k) * ld;

            for (size_t i = 0; i < ld; i++)
                row[i] += factor * add[i];
        }
    }
}

typedef uint64_t bits __attribute__((may_alias));

/* No bit set but for signs.  Most of what is not zero shows in the first lanes. */
static int all_zero(const double *x, size_t n)
{
    const bits *b = (const bits *)x;
    uint64_t any = 0;

    for (size_t i = 0; i < PF_LANES; i++)
        any |= b[i];
    if (any << 1)
        return 0;
    for (size_t i = PF_LANES; i < n; i++)
        any |= b[i];
    return !(any << 1);
}

/* One Jacobian block, jac[oc][ic], into D[test][trial]; divergences spread over the diagonal.  Most derivatives
 * vanish, and D keeps no record of those. */
static void add_block(const pf_slot *out, const pf_slot *in, int n_trial, double factor, const double *jac, int dim,
                      size_t ld, double *block, uint8_t *filled)
{
    int oc = out->eval == PF_DIV ? dim : term_components(out->shape, dim);
    int ic = in->eval == PF_DIV ? dim : term_components(in->shape, dim);
    int jc = in->eval == PF_DIV ? 1 : ic;

    for (int a = 0; a < oc; a++)
        for (int b = 0; b < ic; b++) {
            int row = out->eval == PF_DIV ? a * dim + a : a, col = in->eval == PF_DIV ? b * dim + b : b;
            const double *restrict from =
                jac + (size_t)((out->eval == PF_DIV ? 0 : a) * jc + (in->eval == PF_DIV ? 0 : b)) * ld;
            double *restrict to = block + (size_t)(row * n_trial + col) * ld;
            uint8_t *seen = &filled[row * n_trial + col];

            if (all_zero(from, ld))
                continue;
            for (size_t i = 0; i < ld; i++)
                to[i] = *seen ? to[i] + factor * from[i] : factor * from[i];
            *seen = 1;
        }
}

/* Whether one of the n numbers of an output, or of its derivative by an input, is none: reports the first. */
static int find_nan(const pf_batch *b, const double *v, size_t n, const pf_slot *out, const pf_slot *in,
                    term_report *r)
{
    for (size_t i = 0; i < n; i++)
        if (!isfinite(v[i])) {
            size_t l = i % b->ld;
            double x[3] = {b->x[l], b->x[b->ld + l], b->dim == 3 ? b->x[2 * b->ld + l] : 0};

            r->status = PF_FAIL;
            snprintf(r->text, sizeof r->text, "term %s.%s: %s \"%s\"%s%s%s is %g at x = %s, t = %.6g", r->plugin,
                     r->term, in ? "derivative of" : "output", out->name, in ? " by \"" : "", in ? in->name : "",
                     in ? "\"" : "", v[i], text_point(x, (int)b->dim).s, b->t);
            return 1;
        }
    return 0;
}

int evaluate_find_nan(const pf_term *t, const pf_batch *b, double *const *out, term_report *r)
{
    for (uint32_t o = 0; o < t->n_out; o++)
        if (find_nan(b, out[o], (size_t)term_components(t->out[o].shape, (int)b->dim) * b->ld, &t->out[o], NULL, r))
            return 1;
    return 0;
}

static int find_nan_derivative(const pf_term *t, const pf_batch *b, double *const *jac, term_report *r)
{
    for (uint32_t o = 0; o < t->n_out; o++)
        for (uint32_t k = 0; k < t->n_in; k++) {
            int n = term_components(t->out[o].shape, (int)b->dim) * term_components(t->in[k].shape, (int)b->dim);
            const double *block = jac[o * t->n_in + k];

            if (block && find_nan(b, block, (size_t)n * b->ld, &t->out[o], &t->in[k], r))
                return 1;
        }
    return 0;
}

/* Blocks of the Jacobian that are wanted, one after the other and zero; how many numbers. */
static size_t place_blocks(const assembly_class *c, const plan_use *p, int dim, size_t ld, double *at, double **jac)
{
    const pf_term *t = p->use->term;
    size_t used = 0;

    for (uint32_t j = 0; j < t->n_out * t->n_in; j++) {
        const uint32_t k = j % t->n_in;
        const int rows = term_components(t->out[j / t->n_in].shape, dim);

        jac[j] = p->trial[k] >= 0 || c->input[p->in[k]].law ? at + used : NULL;
        used += jac[j] ? (size_t)(rows * term_components(t->in[k].shape, dim)) * ld : 0;
    }
    memset(at, 0, used * sizeof *at);
    return used;
}

/* Derivatives by properties that are numbers are not wanted, but a Jacobian by hand gives them all the same: room
 * for those; with `remove` they are taken out again. */
static void place_unwanted(const assembly_class *c, const plan_use *p, int dim, size_t ld, double *at, double **jac,
                           int remove)
{
    const pf_term *t = p->use->term;

    for (uint32_t j = 0; term_derives_by_hand(t, p->use->how) && j < t->n_out * t->n_in; j++)
        if (c->input[p->in[j % t->n_in]].number) {
            jac[j] = remove ? NULL : at;
            at += (size_t)(term_components(t->out[j / t->n_in].shape, dim) *
                           term_components(t->in[j % t->n_in].shape, dim)) *
                  ld;
        }
}

/* The derivative of output o by slot k, a property, and that of the property by the unknowns it depends on. */
static void add_chained(const assembly_class *c, const assembly_state *s, const plan_use *p, uint32_t o, uint32_t k,
                        const double *jac, int dim, workspace *w)
{
    const pf_slot *out = &p->use->term->out[o];
    const size_t nq = (size_t)c->n_q, ld = nq * PF_LANES;

    for (int i = 0; i < c->n_chain; i++) {
        const plan_chain *chain = &c->chain[i];
        const double factor = strength(s, p) * (chain->slot->eval == PF_DOT ? s->shift : 1), *product;
        size_t block = c->block[p->out[o]][chain->trial];

        if (chain->property != p->in[k] || block == SIZE_MAX || factor == 0)
            continue;
        product = properties_product(c, chain, jac, term_components(out->shape, dim), dim, w);
        add_block(out, chain->slot, c->trial[chain->trial].n_comp, factor, product, dim, ld,
                  (double *)(w->block + block * nq), w->filled + block);
        block = chain->slope >= 0 && w->frame ? c->block[p->out[o]][chain->slope] : SIZE_MAX;
        if (block != SIZE_MAX && (s->frame->fields >> c->trial[chain->slope].field & 1))
            history_jacobian(out, chain->slot, c->trial[chain->slope].n_comp, strength(s, p), product, dim, ld,
                             (const double *)w->frame, (double *)(w->block + block * nq), w->filled + block);
    }
}

static int add_jacobian(const assembly_class *c, const assembly_state *s, const plan_use *p, const pf_batch *b,
                        const double *const *in, int dim, int diagnose, workspace *w)
{
    const pf_term *t = p->use->term;
    double *jac[TERM_MAX_SLOTS * TERM_MAX_SLOTS];
    double *at = (double *)w->jac;
    const size_t ld = b->ld, used = place_blocks(c, p, dim, ld, at, jac);
    int status;

    place_unwanted(c, p, dim, ld, at + used, jac, 0);
    status = term_jacobian(t, p->use->how, b, in, jac, w->room);
    place_unwanted(c, p, dim, ld, at + used, jac, 1);
    mask_rows(w, at, used / ld, ld); /* blocks lie one after the other */
    if (!status && diagnose && find_nan_derivative(t, b, jac, &w->report))
        return PF_FAIL;
    for (uint32_t o = 0; o < t->n_out && !status; o++)
        for (uint32_t k = 0; k < t->n_in; k++) {
            double factor = strength(s, p) * (t->in[k].eval == PF_DOT ? b->shift : 1);
            size_t block;

            if (c->input[p->in[k]].law && p->out[o] >= 0)
                add_chained(c, s, p, o, k, jac[o * t->n_in + k], dim, w);
            if (p->trial[k] < 0 || p->out[o] < 0 || factor == 0)
                continue;
            block = c->block[p->out[o]][p->trial[k]];
            if (block != SIZE_MAX)
                add_block(&t->out[o], &t->in[k], c->trial[p->trial[k]].n_comp, factor, jac[o * t->n_in + k], dim,
                          ld, (double *)(w->block + block * (size_t)c->n_q), w->filled + block);
            block = p->slope[k] >= 0 && w->frame ? c->block[p->out[o]][p->slope[k]] : SIZE_MAX;
            if (block != SIZE_MAX && (s->frame->fields >> c->trial[p->slope[k]].field & 1))
                history_jacobian(&t->out[o], &t->in[k], c->trial[p->slope[k]].n_comp, strength(s, p),
                                 jac[o * t->n_in + k], dim, ld, (const double *)w->frame,
                                 (double *)(w->block + block * (size_t)c->n_q), w->filled + block);
        }
    return status;
}

/* Kinds of a term: its flags, whether it couples bodies to the fluid or to each other, whether it has inertia. */
static uint32_t kinds(const assembly *a, const plan_use *p)
{
    const pf_term *t = p->use->term;
    uint32_t k = t->flags;

    for (uint32_t i = 0; (t->where == PF_SOLID || t->where == PF_SURFACE) && i < t->n_in + t->n_out; i++) {
        const pf_slot *s = i < t->n_in ? &t->in[i] : &t->out[i - t->n_in];

        if (term_slot_field(s) && a->space->field[space_find_field(a->space, s->field)].order > 0)
            k |= ASSEMBLE_COUPLING;
    }
    k |= term_stores(t, NULL) ? ASSEMBLE_INERTIA : 0;
    return k | (t->where == PF_PAIR ? ASSEMBLE_CONTACT : 0);
}

int evaluate_any(const assembly *a, const assembly_class *c, const assembly_state *s)
{
    int any = !s->only, equations = 0;

    for (int u = 0; u < c->n_use; u++)
        any |= (kinds(a, &c->use[u]) & s->only) != 0;
    for (int u = 0; u < c->n_use; u++)
        equations |= c->use[u].equations;
    return any && equations;
}

/* What a term sees of the points of a class: what has no meaning there is NULL. */
pf_batch evaluate_batch(const assembly_class *c, const assembly_state *s, int dim, workspace *w)
{
    int on_pair = c->where == PF_PAIR, on_surface = c->where == PF_SURFACE;
    int on_particle = c->where == PF_PARTICLE,
        on_body = c->where == PF_SOLID || on_surface || on_pair || on_particle;
    uint32_t ld = (uint32_t)(c->n_q * (int)PF_LANES);
    pf_batch b = {
        .size = sizeof(pf_batch),
        .dim = (uint32_t)dim,
        .n = ld,
        .ld = ld,
        .t = s->t,
        .dt = s->dt,
        .shift = s->shift,
        .x = (double *)w->x,
        .normal = c->where == PF_FACET || on_surface || on_pair ? (double *)w->normal : NULL,
        .h = (double *)w->h,
        .arm = on_body && (!on_pair || c->any_body_data) ? (double *)w->arm : NULL,
        .density = on_body ? (double *)w->density : NULL,
        .id = on_body ? w->id : NULL,
        .gap = on_pair ? (double *)w->gap : NULL,
        .size_of = on_pair ? (double *)w->size[0] : NULL,
        .other_size = on_pair ? (double *)w->size[1] : NULL,
        .other_density = on_pair ? (double *)w->other_density : NULL,
        .scratch = w->scratch,
        .kernel = &w->report,
        .host = &term_host,
    };

    body_data_show(c, w, &b);
    return b;
}

int evaluate_term(const assembly_class *c, const plan_use *p, int64_t batch, pf_batch *b, const double **in,
                  double **out, workspace *w)
{
    const pf_term *t = p->use->term;
    double *at = (double *)w->out;

    for (uint32_t k = 0; k < t->n_in; k++)
        in[k] = (double *)(w->in + c->input[p->in[k]].at * (size_t)c->n_q);
    for (uint32_t o = 0; o < t->n_out; o++) {
        out[o] = at;
        at += (size_t)term_components(t->out[o].shape, (int)b->dim) * b->ld;
    }
    b->params = p->use->params;
    b->metric = t->flags & PF_METRIC ? (double *)w->metric : NULL;
    b->wall_distance = t->flags & PF_WALL_DISTANCE ? (double *)(c->wall + batch * c->n_q) : NULL;
    w->report = (term_report){.plugin = p->use->plugin->d.name, .term = t->name};
    process_enter(w->report.plugin, t->name, "residual", c->cell[c->batch[batch]]);
    TRY(properties_fit(c, p, b, w));
    return mask_residual(t, b, in, out, w);
}

int evaluate_end(int status, workspace *w)
{
    process_leave();
    if (status && !w->report.status)
        snprintf(w->report.text, sizeof w->report.text, "term %s.%s returned %d without saying why",
                 w->report.plugin, w->report.term, status);
    if (status)
        w->report.status = status;
    return status;
}

/* Residual and, if asked for, derivatives of one term, added to what the others gave. */
static int add_term(const assembly_class *c, const assembly_state *s, int64_t batch, const plan_use *p,
                    int with_matrix, int diagnose, pf_batch *b, workspace *w)
{
    const pf_term *t = p->use->term;
    const double *in[TERM_MAX_SLOTS];
    double *out[TERM_MAX_SLOTS];
    int dim = (int)b->dim, status = evaluate_term(c, p, batch, b, in, out, w);

    if (!status && s->watch)
        s->watch->look(s->watch->ctx, p->use, b, in);
    if (!status && diagnose && evaluate_find_nan(t, b, out, &w->report))
        status = PF_FAIL;
    if (!status) {
        add_output(c, p, strength(s, p), out, dim, w);
        if (s->power)
            status = power_add(c, s, batch, p, strength(s, p), b, in, out, w);
    }
    if (!status) {
        process_enter(w->report.plugin, t->name, "Jacobian", c->cell[c->batch[batch]]);
        if (with_matrix)
            status = add_jacobian(c, s, p, b, in, dim, diagnose, w);
    }
    return evaluate_end(status, w);
}

int evaluate_terms(const assembly *a, const assembly_class *c, const assembly_state *s, int64_t batch,
                   int with_matrix, int diagnose, workspace *w)
{
    int dim = a->space->mesh->dim;
    size_t nq = (size_t)c->n_q;
    pf_batch b = evaluate_batch(c, s, dim, w);

    memset(w->test, 0, c->test_size * nq * sizeof(v8));
    if (with_matrix)
        memset(w->filled, 0, c->block_size);
    if (s->power)
        inputs_unknowns(a, c, s, batch, w);
    TRY(properties_evaluate(c, s, batch, with_matrix, diagnose, &b, w));
    for (int u = 0; u < c->n_use; u++) {
        const plan_use *p = &c->use[u];

        if (p->equations && strength(s, p) != 0 && (!s->only || (kinds(a, p) & s->only)) && mask_take(a, c, p, w))
            TRY(add_term(c, s, batch, p, with_matrix, diagnose, &b, w));
    }
    return 0;
}
