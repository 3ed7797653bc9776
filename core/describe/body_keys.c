/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What particle {} has beside the kernel's own keys: keys of terms (PF_BODY_KEY), as in particle { charge = 3 },
 * and how fields of bodies start, as in particle { theta = 0.3 }. */
#include "describe/describe.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* Keys that particle {} and particles {} have of their own. */
static const char *const taken[] = {"at",    "shape",       "density", "motion", "hold", "velocity", "spin",
                                    "angle", "orientation", "n",       "seed",   "gap",  "inside"};

static int is_key(const pf_slot *s)
{
    return s->eval == PF_BODY_KEY || s->eval == PF_OTHER_KEY;
}

static body_key *find_key(description *d, const char *name)
{
    for (int i = 0; i < d->n_key; i++)
        if (strcmp(d->key[i].name, name) == 0)
            return &d->key[i];
    return NULL;
}

/* Two terms that have a key must mean the same by it. */
static void check_same(description *d, const body_key *k, const term_use *u, const pf_slot *s, const case_block *b)
{
    const char *what = k->n_comp != term_components(s->shape, d->dim)        ? "another shape"
                       : s->unit && k->unit && strcmp(s->unit, k->unit) != 0 ? "another unit"
                       : s->eval == PF_BODY_KEY && s->dflt != k->dflt        ? "another default"
                                                                             : NULL;

    if (what)
        case_wrong(
            d->c, b, NULL,
            "%s.%s and %s.%s both have the key \"%s\" of bodies, with %s: one of them has to call it otherwise",
            u->plugin->d.name, u->term->name, k->use->plugin->d.name, k->use->term->name, s->field, what);
}

static void add_key(description *d, term_use *u, const pf_slot *s, const case_block *b, error *err)
{
    const int n = term_components(s->shape, d->dim), f = fields_find(&d->fields, s->field);
    int mine = f >= 0 && d->fields.f[f].support == PF_ON_PARTICLE;
    body_key *k = find_key(d, s->field);

    for (size_t i = 0; i < sizeof taken / sizeof *taken; i++)
        mine |= strcmp(s->field, taken[i]) == 0;
    if (mine || d->n_key == DESCRIBE_MAX_KEYS) {
        case_wrong(d->c, b, NULL,
                   mine ? "%s.%s: bodies have the key \"%s\" already, with another meaning"
                        : "%s.%s: \"%s\": too "
                          "many keys of bodies",
                   u->plugin->d.name, u->term->name, s->field);
        return;
    }
    (void)err;
    if (k) {
        check_same(d, k, u, s, b);
        if (s->min < s->max) {
            k->min = k->min < k->max ? fmax(k->min, s->min) : s->min;
            k->max = k->min < k->max ? fmin(k->max, s->max) : s->max;
        }
        return;
    }
    d->key[d->n_key++] = (body_key){.name = s->field,
                                    .unit = s->unit ? s->unit : "1",
                                    .doc = s->doc ? s->doc : s->name,
                                    .use = u,
                                    .n_comp = n,
                                    .vector = s->shape != PF_SCALAR,
                                    .dflt = s->dflt,
                                    .min = s->min,
                                    .max = s->max};
}

/* f for every term that is on. */
static int each_use(description *d, int (*f)(description *, term_use *, const case_block *, int, error *), int pass,
                    error *err)
{
    for (int i = 0; i < d->n_use; i++)
        TRY(f(d, &d->use[i], d->use_block[i], pass, err));
    for (int k = 0; k < 2; k++) {
        term_list *l = k ? &d->law : &d->shown;

        for (int i = 0; i < l->n; i++)
            TRY(f(d, &l->use[i], l->block[i], pass, err));
    }
    return 0;
}

/* Keys of the first body declare; those of the other one follow. */
static int collect(description *d, term_use *u, const case_block *b, int pass, error *err)
{
    for (uint32_t k = 0; k < u->term->n_in; k++)
        if (u->term->in[k].eval == (pass ? PF_OTHER_KEY : PF_BODY_KEY))
            add_key(d, u, &u->term->in[k], b, err);
    return 0;
}

int describe_body_keys(description *d, error *err)
{
    TRY(each_use(d, collect, 0, err));
    return each_use(d, collect, 1, err);
}

/* A number, or n of them, within [low, high] each (low >= high: unbounded). */
static void read_numbers(description *d, reader *r, const char *key, const char *doc, int n, int vector, double low,
                         double high, double *v)
{
    if (!vector || n == 1) {
        reader_number(r, key, doc, low, high, v);
        return;
    }
    if (reader_vector(r, key, doc, n, v) <= 0)
        return;
    for (int i = 0; i < n && low < high; i++)
        if (v[i] < low || v[i] > high) {
            case_wrong(d->c, r->b, key, "%s: \"%s\" (%s): component %d is %g; it must lie between %g and %g",
                       r->what, key, doc, i + 1, v[i], low, high);
            return;
        }
}

static int doc_of(reader *r, const char *doc, const char *more, const char *unit, char **text, error *err)
{
    ARENA_NEW(&r->c->memory, *text, strlen(doc) + strlen(more) + strlen(unit) + 4, err);
    sprintf(*text, "%s%s%s%s", doc, more, strcmp(unit, "1") ? ", " : "", strcmp(unit, "1") ? unit : "");
    return 0;
}

/* What a case says that a term which is off would understand. */
static int find_off(description *d, term_use *u, const case_block *b, int pass, error *err)
{
    const term_plugin *p = u->plugin;
    reader *r = d->reading;

    (void)b, (void)pass, (void)err;
    for (uint32_t i = 0; i < p->d.n_term; i++)
        for (uint32_t k = 0; k < p->term[i].n_in; k++)
            if (is_key(&p->term[i].in[k]))
                describe_misplaced(d, r, p->term[i].in[k].field,
                                   "belongs to %s.%s, which is off here; term \"%s.%s\" {} switches it on",
                                   p->d.name, p->term[i].name, p->d.name, p->term[i].name);
    return 0;
}

int describe_body_extras(description *d, reader *r, body_spec *q, error *err)
{
    char *doc;

    ARENA_NEW(&d->memory, q->key, 3 * d->n_key + 1, err);
    ARENA_NEW(&d->memory, q->field, 3 * TERM_MAX_FIELDS, err);
    for (int i = 0; i < d->n_key; i++) {
        const body_key *k = &d->key[i];

        for (int c = 0; c < 3; c++)
            q->key[3 * i + c] = k->dflt;
        TRY(doc_of(r, k->doc, "", k->unit, &doc, err));
        read_numbers(d, r, k->name, doc, k->n_comp, k->vector, k->min, k->max, q->key + 3 * i);
    }
    for (int f = 0; f < d->fields.n; f++) {
        const field_spec *g = &d->fields.f[f];

        if (g->support != PF_ON_PARTICLE || f == describe_motion(d, 0) || f == describe_motion(d, 1))
            continue;
        q->has_field |= (uint32_t)reader_has(r, g->name) << f;
        TRY(doc_of(r, g->doc, " at the start", g->unit ? g->unit : "1", &doc, err));
        read_numbers(d, r, g->name, doc, g->n_comp, g->n_comp > 1, 0, 0, q->field + 3 * f);
    }
    d->reading = r;
    return each_use(d, find_off, 0, err);
}

static int hand_out(description *d, term_use *u, const case_block *b, int pass, error *err)
{
    (void)b, (void)pass, (void)err;
    for (uint32_t i = 0; i < u->term->n_in; i++)
        if (is_key(&u->term->in[i])) {
            const body_key *k = find_key(d, u->term->in[i].field);

            u->key[i] = k ? k->value : NULL;
        }
    return 0;
}

int describe_hand_out_keys(description *d, error *err)
{
    for (int i = 0; i < d->n_key; i++) {
        body_key *k = &d->key[i];

        ARENA_NEW(&d->memory, k->value, d->n_body * k->n_comp + 1, err);
        for (int j = 0; j < d->n_body; j++)
            memcpy(k->value + j * k->n_comp, d->body[j].key + 3 * i, (size_t)k->n_comp * sizeof *k->value);
    }
    return each_use(d, hand_out, 0, err);
}

/* U is what moves with the field inside of the body, omega is in rad/s: there may be other vectors and spins. */
int describe_motion(const description *d, int spin)
{
    int best = -1, rank = 0;

    for (int f = 0; f < d->fields.n; f++) {
        const field_spec *g = &d->fields.f[f];
        int mine = fields_moves_bodies(g) && g->shape == (spin ? PF_SPIN : PF_VECTOR);

        mine *= 1 + (g->constrains != NULL);
        if (mine > rank) {
            rank = mine;
            best = f;
        }
    }
    return best;
}
