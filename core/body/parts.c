/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Whether bodies separate the fluid into parts, and whether each is felt by it at all. */
#include "body/body.h"

#include <stdlib.h>

static int32_t root(int32_t *of, int32_t i)
{
    while (of[i] != i)
        i = of[i] = of[of[i]];
    return i;
}

/* Parts of the mesh, cells that bodies cover left out or not; cells are connected by common nodes. */
static int count_parts(const bodies *b, const placement *p, int32_t *of)
{
    const space *s = b->space;
    const fe_cell *type = s->mesh->type;
    int n = 0;

    for (int32_t i = 0; i < s->n_carrier; i++)
        of[i] = -1;
    for (int64_t e = 0; e < s->mesh->n_cell; e++)
        for (int i = 0; (!p || p->cover[e] < COVER_WHOLE) && i < type->n_node; i++) {
            int32_t node = space_carrier(s, e, i), first = space_carrier(s, e, 0);

            if (of[node] < 0)
                of[node] = node;
            of[root(of, node)] = root(of, first);
        }
    for (int32_t i = 0; i < s->n_carrier; i++)
        n += of[i] == i;
    return n;
}

/* Whether a body has no node of a field that lives on what bodies cover. */
static int is_missed(const bodies *b, const placement *p, int k)
{
    const space *s = b->space;
    int restricted = 0;

    for (int f = 0; f < s->n_field; f++) {
        restricted |= s->field[f].support == PF_IN_PARTICLES;
        for (int64_t a = 0; s->field[f].support == PF_IN_PARTICLES && a < s->n_attached; a++)
            for (int i = 0; s->attached_particle[a] == k && i < s->mesh->type->n_node; i++) {
                int64_t d = s->first[f][space_carrier(s, space_attached_group(s, a), i)];

                if (d >= 0 && !p->idle[d])
                    return 0;
            }
    }
    return restricted;
}

int parts_check(const bodies *b, error *err)
{
    int32_t *of = malloc(((size_t)b->space->n_carrier + 1) * sizeof *of);
    int whole, left;

    if (!of)
        return error_memory(err, "parts of the fluid", 4.0 * (double)b->space->n_carrier);
    whole = count_parts(b, NULL, of);
    left = count_parts(b, b->now, of);
    free(of);
    if (left > whole)
        warning_add(
            b->warnings,
            "bodies separate the fluid into %d parts; one without an outlet has a pressure of a level of its "
            "own, which no equation fixes: forces on bodies between parts are arbitrary",
            left);
    for (int k = 0; k < b->n; k++)
        if (is_missed(b, b->now, k))
            return error_set(
                err, ERR_CASE,
                "%s:%d: particle %d is so small that it covers no node of the mesh, and the flow does not "
                "feel it; refine the mesh, or take particulate \"sharp\"",
                b->spec[k].block->file, b->spec[k].block->line, k);
    return 0;
}
