/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * particle {} and particles {} of a case: where the bodies are. */
#include "base/random.h"
#include "describe/describe.h"

#include <string.h>

enum { MOST_TRIES = 200000 };

static int add_body(description *d, const body_spec *q, error *err)
{
    if ((d->n_body & (d->n_body - 1)) == 0) {
        body_spec *more;

        ARENA_NEW(&d->memory, more, 2 * d->n_body + 1, err);
        if (d->n_body)
            memcpy(more, d->body, (size_t)d->n_body * sizeof *more);
        d->body = more;
    }
    d->body[d->n_body++] = *q;
    return 0;
}

static int read_one(description *d, const case_block *b, error *err)
{
    const int before = d->c->n_wrong;
    body_spec q = {.block = b};
    int at;
    reader r;

    reader_open(&r, d->c, b, "particle");
    at = reader_vector(&r, "at", "place of the centroid, m", d->dim, q.start.x);
    TRY(describe_body(d, &r, &q, err));
    reader_required(&r, "at", at);
    reader_close(&r);
    return d->c->n_wrong == before ? add_body(d, &q, err) : 0;
}

/* What particles {} says beside the bodies themselves. */
typedef struct many {
    int n, seed;
    double gap, low[3], high[3]; /* of the box that holds them */
} many;

static int read_many(description *d, const case_block *b, many *m, body_spec *q, error *err)
{
    int n, inside, dim;
    reader r;

    *m = (many){.seed = 1};
    reader_open(&r, d->c, b, "particles");
    n = reader_integer(&r, "n", "how many", 1, 100000, &m->n);
    reader_integer(&r, "seed", "of the random places", 0, 1000000000, &m->seed);
    reader_number(&r, "gap", "smallest distance between two bodies, m", 0, 1e30, &m->gap);
    inside = describe_corners(&r, "inside", "box to fill: {{x, y[, z]}, {x, y[, z]}}", m->low, m->high, &dim);
    if (dim && dim != d->dim)
        case_wrong(d->c, b, "inside", "particles: \"inside\": corners of %d numbers in a case in %dD", dim, d->dim);
    TRY(describe_body(d, &r, q, err));
    reader_required(&r, "n", n);
    reader_required(&r, "inside", inside);
    reader_close(&r);
    return 0;
}

static int is_periodic_side(const description *d, const char *name)
{
    for (int i = 0; i < d->n_line; i++)
        for (int s = 0; s < 2; s++)
            if (d->line[i].periodic[s] && strcmp(d->line[i].periodic[s], name) == 0)
                return 1;
    return 0;
}

/* The box to fill against a mesh that is one; 0 if it is wrong. */
static int check_inside(const description *d, const case_block *b, const many *m, const shape *s)
{
    const mesh_box *box = &d->mesh.box;

    for (int k = 0; k < d->dim; k++) {
        const double slack = 1e-9 * (box->high[k] - box->low[k]);

        if (m->high[k] - m->low[k] < 2 * s->radius) {
            case_wrong(d->c, b, "inside", "particles: a body is up to %g wide, the box \"inside\" only %g",
                       2 * s->radius, m->high[k] - m->low[k]);
            return 0;
        }
        if (describe_is_box(d) && (m->low[k] < box->low[k] - slack || m->high[k] > box->high[k] + slack) &&
            !is_periodic_side(d, mesh_box_side(2 * k))) {
            case_wrong(d->c, b, "inside",
                       "particles: \"inside\" reaches from %s to %s, out of the mesh, which reaches from %s to %s",
                       text_point(m->low, d->dim).s, text_point(m->high, d->dim).s, text_point(box->low, d->dim).s,
                       text_point(box->high, d->dim).s);
            return 0;
        }
    }
    return 1;
}

/* 0 if the place is too near to a body that is there. */
static int is_free(const description *d, const body_spec *q, double gap)
{
    for (int i = 0; i < d->n_body; i++) {
        double d2 = 0, reach = d->body[i].shape.radius + q->shape.radius + gap;

        for (int k = 0; k < d->dim; k++)
            d2 += (d->body[i].start.x[k] - q->start.x[k]) * (d->body[i].start.x[k] - q->start.x[k]);
        if (d2 < reach * reach)
            return 0;
    }
    return 1;
}

/* particles { n, shape, density, inside = {{...}, {...}}, gap, seed }: places at random, without overlap. */
static int place_many(description *d, const case_block *b, error *err)
{
    const int before = d->c->n_wrong, first = d->n_body;
    body_spec q = {.block = b};
    unsigned long long state;
    int tries = 0;
    many m;

    TRY(read_many(d, b, &m, &q, err));
    if (d->c->n_wrong != before || !check_inside(d, b, &m, &q.shape))
        return 0;
    state = random_start((unsigned long long)m.seed);
    while (d->n_body < first + m.n) {
        if (++tries > MOST_TRIES) {
            case_wrong(d->c, b, NULL,
                       "particles: only %d of %d bodies find a place; take fewer, smaller ones, or a larger box",
                       d->n_body - first, m.n);
            break;
        }
        for (int k = 0; k < d->dim; k++)
            q.start.x[k] =
                m.low[k] + q.shape.radius + (m.high[k] - m.low[k] - 2 * q.shape.radius) * random_next(&state);
        if (is_free(d, &q, m.gap))
            TRY(add_body(d, &q, err));
    }
    return 0;
}

int describe_bodies(description *d, error *err)
{
    const case_block *b;

    TRY(describe_body_keys(d, err));
    for (int k = 0; (b = case_find(d->c, "particle", k)); k++)
        TRY(read_one(d, b, err));
    for (int k = 0; (b = case_find(d->c, "particles", k)); k++)
        TRY(place_many(d, b, err));
    return describe_hand_out_keys(d, err);
}
