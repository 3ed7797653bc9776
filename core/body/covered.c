/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The cells that each body covers or cuts: weights of the part inside, corrected to the body's exact moments, and
 * the points of its surface. */
#include "body/body.h"

#include "base/text.h"

#include <math.h>
#include <string.h>

solid body_image(const bodies *b, const placement *p, int64_t attached)
{
    solid image = p->body[b->space->attached_particle[attached]];

    for (int i = 0; i < 3; i++)
        image.at.x[i] += b->envelope.shift[attached][i];
    return image;
}

/* Volume of the covered parts from `first` on, by the mean size of each cell. */
static double covered_volume(const bodies *b, const placement *p, int64_t first)
{
    const mesh *m = b->space->mesh;
    double volume = 0;

    for (int64_t i = first; i < p->n_covered; i++)
        for (int j = 0; j < b->cut.n; j++)
            volume += p->covered_weight[i * b->cut.n + j] / m->type->measure *
                      pow(m->h[b->space->attached_cell[p->covered[i]]], m->dim);
    return volume;
}

/* Part of body k that lies inside the domain: 1, or where symmetry planes go through its centre a half, a quarter
 * or an eighth; 0 for unknown, where the covered volume is another one. */
static double inside_part(const bodies *b, const solid *body, double volume)
{
    int which[DESCRIBE_MAX_PLANES];
    double fraction = pow(0.5, symmetry_planes_at(b->plane, b->n_plane, body, which));

    return fabs(volume / (fraction * body->shape->volume) - 1) > 0.05 ? 0 : fraction;
}

/* Cuts the cells attached to body k, from attached pair *a on. */
static int cut_body(const bodies *b, placement *p, int k, int64_t *a, error *err)
{
    const space *s = b->space;
    int64_t first = p->n_covered, n;
    arena scratch = {0};
    double(*shift)[3], volume;
    int32_t *cell;
    int status;

    for (; *a < s->n_attached && s->attached_particle[*a] == k; ++*a) {
        solid here = body_image(b, p, *a);
        enum cut_cover cover;

        if (!envelope_near(b, p, *a, 0))
            continue;
        surface_begin(&p->surface, (int32_t)*a);
        p->surface.curved = b->is_curved ? &here : NULL;
        TRY(cut_cell(&b->cut, s->mesh, s->attached_cell[*a], &here, p->covered_weight + p->n_covered * b->cut.n,
                     b->has_surface || b->shows_surface ? surface_add : NULL, &p->surface, &cover, err));
        surface_end(&p->surface);
        if (cover != CUT_NONE) {
            p->covers_all[p->n_covered] = cover == CUT_WHOLE;
            p->covered[p->n_covered++] = (int32_t)*a;
        }
    }
    if (p->surface.failed)
        return error_memory(err, "pieces of surface", 0);
    n = p->n_covered - first;
    volume = covered_volume(b, p, first);
    if (volume < 1e-9 * b->spec[k].shape.volume)
        return error_set(
            err, ERR_CONVERGE,
            "particle %d has left the domain: its centre is at %s; for a body that may, stop earlier, or "
            "make the boundary periodic",
            k, text_point(p->body[k].at.x, s->mesh->dim).s);
    ARENA_NEW(&scratch, cell, n + 1, err);
    shift = arena_alloc(&scratch, (size_t)n + 1, sizeof *shift);
    for (int64_t i = 0; shift && i < n; i++) {
        cell[i] = s->attached_cell[p->covered[first + i]];
        memcpy(shift[i], b->envelope.shift[p->covered[first + i]], sizeof *shift);
    }
    status = shift ? cut_correct(&b->cut, s->mesh, &p->body[k], cell, (const double(*)[3])shift,
                                 p->covered_weight + first * b->cut.n, n, inside_part(b, &p->body[k], volume), err)
                   : error_memory(err, "covered cells", 24.0 * (double)n);
    arena_free(&scratch);
    return status;
}

int covered_cut(const bodies *b, placement *p, error *err)
{
    int64_t n = b->space->n_attached, a = 0;

    ARENA_NEW(&p->memory, p->covered, n + 1, err);
    ARENA_NEW(&p->memory, p->covers_all, n + 1, err);
    ARENA_NEW(&p->memory, p->covered_weight, n * b->cut.n + 1, err);
    for (int k = 0; k < b->n; k++)
        TRY(cut_body(b, p, k, &a, err));
    return 0;
}
