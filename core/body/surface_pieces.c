/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Points of surface as cells are cut, in pieces of SURFACE_POINTS: one item of the assembly each. */
#include "body/body.h"

#include "base/list.h"

#include <math.h>
#include <string.h>

/* Room for one more piece. */
static int make_room(surface_list *s, error *err)
{
    int64_t room[4] = {s->room, s->room, s->room, s->room};

    LIST_ROOM(s->ref, s->n, &room[0], err);
    LIST_ROOM(s->normal, s->n, &room[1], err);
    LIST_ROOM(s->weight, s->n, &room[2], err);
    LIST_ROOM(s->curvature, s->n, &room[3], err);
    LIST_ROOM(s->attached, s->n, &s->room, err);
    return 0;
}

void surface_begin(surface_list *s, int32_t attached)
{
    s->now = attached;
    s->n_last = 0;
}

void surface_add(void *list, const double *xi, const double *x, const double *nds)
{
    surface_list *s = list;
    double size = sqrt(nds[0] * nds[0] + nds[1] * nds[1] + nds[2] * nds[2]);
    error ignored; /* see failed */

    if (!(size > 0) || s->failed)
        return;
    if (s->n_last == 0) {
        s->failed = make_room(s, &ignored) != 0;
        if (s->failed)
            return;
        s->attached[s->n] = s->now;
        memset(s->weight[s->n], 0, sizeof *s->weight);
    }
    for (int i = s->n_last; i < SURFACE_POINTS; i++) { /* what is not overwritten fills up */
        s->curvature[s->n][i] = i > s->n_last ? s->curvature[s->n][s->n_last]
                                : s->curved   ? solid_curvature(s->curved, x)
                                              : 0;
        for (int k = 0; k < 3; k++) {
            s->ref[s->n][i][k] = xi[k];
            s->normal[s->n][i][k] = -nds[k] / size; /* out of the fluid */
        }
    }
    s->weight[s->n][s->n_last] = size;
    if (++s->n_last == SURFACE_POINTS)
        surface_end(s);
}

void surface_end(surface_list *s)
{
    s->n += s->n_last > 0;
    s->n_last = 0;
}
